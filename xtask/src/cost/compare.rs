//! `cargo xtask cost --compare`: what is measured now against docs/costs.csv.
//!
//! `rows before, rows now => rows that changed, largest first, verdict`. Counts are instructions of
//! the mean, of the dearest step and with held inputs, code, model, plant and stack.

use std::fmt::Write as _;

use anyhow::{Result, bail};

use super::row::Cost;

/// No count may rise by more.
const LIMIT: f64 = 0.01;

/// The counts of a row.
fn counts(cost: &Cost) -> [(&'static str, Option<u64>); 7] {
    [
        ("instructions_mean", Some(cost.mean)),
        ("instructions_max", Some(cost.max)),
        ("instructions_held", Some(cost.held)),
        ("text_bytes", cost.text),
        ("rodata_bytes", Some(cost.model)),
        ("plant_ram_bytes", Some(cost.plant)),
        ("stack_bytes", Some(cost.stack)),
    ]
}

struct Change {
    row: String,
    count: &'static str,
    before: u64,
    now: u64,
}

impl Change {
    /// How much it rose, as a part of what it was.
    fn rise(&self) -> f64 {
        (self.now as f64 - self.before as f64) / (self.before as f64).max(1.0)
    }
}

/// What changed, in words, with the verdict in its last line.
///
/// # Errors
/// Where a count rose by more than 1 %, or a row of before is missing.
pub fn compare(before: &[Cost], now: &[Cost]) -> Result<()> {
    let (mut changes, mut compared, mut missing) = (Vec::new(), 0, Vec::new());
    for old in before {
        let Some(new) = now.iter().find(|new| new.name() == old.name()) else {
            missing.push(old.name());
            continue;
        };
        for ((count, before), (_, now)) in counts(old).into_iter().zip(counts(new)) {
            if let (Some(before), Some(now)) = (before, now) {
                compared += 1;
                changes.push(Change { row: old.name(), count, before, now });
            }
        }
    }
    changes.retain(|change| change.before != change.now);
    changes.sort_by(|a, b| b.rise().total_cmp(&a.rise()));
    println!("{}", table(&changes));
    let over = changes.iter().filter(|change| change.rise() > LIMIT).count();
    println!("{compared} counts of {} rows, {} changed, {over} by more than +1 %", now.len(), {
        changes.len()
    });
    if !missing.is_empty() {
        bail!("rows that are no longer measured: {}", missing.join(", "));
    }
    if over > 0 {
        bail!("{over} counts rose by more than 1 %");
    }
    Ok(())
}

fn table(changes: &[Change]) -> String {
    let mut text = format!(
        "{:<50} {:<18} {:>9} {:>9} {:>9}\n",
        "scene scheme precision", "count", "before", "now", "change"
    );
    for change in changes {
        let _ = writeln!(
            text,
            "{:<50} {:<18} {:>9} {:>9} {:>+7.2} %",
            change.row,
            change.count,
            change.before,
            change.now,
            100.0 * change.rise()
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cost(mean: u64) -> Cost {
        let line = format!("cost four-bar dbd f32 100000 {mean} 10000 {mean} 600 800 400");
        Cost::parse(&line).unwrap()
    }

    #[test]
    fn a_count_may_rise_by_one_per_cent_and_fall_at_will() {
        assert!(compare(&[cost(1000)], &[cost(1010)]).is_ok());
        assert!(compare(&[cost(1000)], &[cost(10)]).is_ok());
        assert!(compare(&[cost(1000)], &[cost(1011)]).is_err());
        assert!(compare(&[cost(1000)], &[]).is_err());
    }

    #[test]
    fn a_code_size_that_is_new_is_not_compared() {
        let mut sized = cost(1000);
        sized.text = Some(5000);
        assert!(compare(&[cost(1000)], &[sized.clone()]).is_ok());
        let grown = Cost { text: Some(5100), ..sized.clone() };
        assert!(compare(&[sized], &[grown]).is_err());
    }
}
