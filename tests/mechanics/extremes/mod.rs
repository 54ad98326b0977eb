//! What happens at the extremes, and what is promised there: the tables of docs/extremes.md.

mod attitude;
mod numbers;

/// A figure of rounding: one digit, for the next ones say nothing.
fn rounding(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.0e}") }
}

/// What came of a run: a figure of rounding, or the step at which the plant failed.
fn outcome(figure: Result<f64, u64>) -> String {
    match figure {
        Ok(value) => rounding(value),
        Err(step) => format!("failed at step {step}"),
    }
}
