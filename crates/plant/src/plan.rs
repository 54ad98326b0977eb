//! A run in whole numbers: step, number of steps, steps per sample.
//!
//! `(step, duration, every) => plan`. Duration and sampling interval are whole multiples of the
//! step, within 1e-9 of them; nothing is ever interpolated. A given step is used as it is or rejected; a default step
//! is shortened to fit. A pure function of its arguments, in + − × ÷ and conversions to integers only, so that every
//! host plans the same run.

use miette::Diagnostic;
use thiserror::Error;

use crate::time::{display, rounded};
use dbd_scene::Scene;
use dbd_scene::fitting::{Span, WHOLE, whole};

/// The number of samples where no interval is given.
const SAMPLES: u64 = 500;

/// A run is looked at about this often, whatever its sampling interval.
const LOOKS: u64 = 1000;

/// Maximum number of steps between two checks, so that progress is visible.
const MAX_STEPS_UNSEEN: u64 = 1024;

/// Maximum number of steps: at 100 ns each they take longer than a day.
pub const MAX_STEPS: f64 = 1e12;

/// More samples than this are refused: a trace of several gigabytes.
pub const MAX_SAMPLES: u64 = 10_000_000;

/// The requested step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepRequest {
    /// \[s\] exactly this one.
    Given(f64),
    /// \[s\] a round one up to this that fits: [`Span::round_step`].
    AtMost(f64),
}

/// Request of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The step.
    pub step: StepRequest,
    /// \[s\] simulated time, > 0.
    pub duration: f64,
    /// \[s\] the sampling interval, > 0; about 500 samples if `None`.
    pub every: Option<f64>,
}

/// A run in whole numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// \[s\] the step.
    pub step: f64,
    /// \[s\] simulated time as requested.
    pub duration: f64,
    /// Steps from t = 0 to the duration, ≥ 1.
    pub steps: u64,
    /// Steps from a sample to the next, ≥ 1; the last interval may be shorter.
    pub stride: u64,
}

impl Plan {
    /// \[s\] the time after `n` steps, never accumulated.
    #[must_use]
    pub fn time(&self, n: u64) -> f64 {
        n as f64 * self.step
    }

    /// Maximum number of steps between two checks of a run: some thousand checks, independent of its samples, and
    /// enough that progress is visible.
    #[must_use]
    pub fn unseen(&self) -> u64 {
        (self.steps / LOOKS).clamp(1, MAX_STEPS_UNSEEN)
    }

    /// The number of samples, t = 0 included.
    #[must_use]
    pub fn samples(&self) -> u64 {
        1 + self.steps.div_ceil(self.stride)
    }
}

/// Why there is no such plan.
#[derive(Clone, Debug, PartialEq, Error, Diagnostic)]
pub enum PlanError {
    /// Duration or sampling interval is not a whole multiple of the step.
    #[error("{what} of {} is not a whole multiple of the step {}", display(*value), display(*step))]
    #[diagnostic(help("nearest valid values: {}", alternatives(steps, intervals)))]
    Multiple {
        /// `the duration` or `the sampling interval`.
        what: &'static str,
        /// \[s\] its value.
        value: f64,
        /// \[s\] the step.
        step: f64,
        /// \[s\] the nearest steps that fit duration and sampling interval, nearest first.
        steps: Vec<f64>,
        /// \[s\] the nearest sampling intervals that fit the step, if that suffices.
        intervals: Vec<f64>,
    },
    /// No step divides both.
    #[error(
        "no step divides both the duration {} and the sampling interval {}",
        display(*duration),
        display(*every)
    )]
    #[diagnostic(help("valid sampling intervals: {}", listed("--every", intervals)))]
    Incommensurate {
        /// \[s\] the duration.
        duration: f64,
        /// \[s\] the sampling interval.
        every: f64,
        /// \[s\] intervals nearby that divide the duration.
        intervals: Vec<f64>,
    },
    /// The sampling interval exceeds the duration.
    #[error(
        "the sampling interval {} is longer than the duration {}",
        display(*every),
        display(*duration)
    )]
    #[diagnostic(help("use at most --every {}", display(*duration)))]
    Every {
        /// \[s\] the duration.
        duration: f64,
        /// \[s\] the sampling interval.
        every: f64,
    },
    /// More than [`MAX_STEPS`].
    #[error("{} of {} exceed the maximum of {MAX_STEPS:e}", steps_text(*steps), display(*step))]
    #[diagnostic(help("{}", fewer_steps(*duration)))]
    Steps {
        /// How many.
        steps: f64,
        /// \[s\] the step.
        step: f64,
        /// \[s\] the duration.
        duration: f64,
    },
    /// More than [`MAX_SAMPLES`].
    #[error("{} samples exceed the maximum of {MAX_SAMPLES}", count(*samples))]
    #[diagnostic(help("use a longer sampling interval, for example --every {}", display(*every)))]
    Samples {
        /// Their number, a whole one.
        samples: f64,
        /// \[s\] an interval that yields about a thousand.
        every: f64,
    },
}

/// A whole number; in short form beyond the integers of an f64.
fn count(number: f64) -> String {
    if number < 1e15 { format!("{number}") } else { format!("{number:.1e}") }
}

fn steps_text(steps: f64) -> String {
    if steps.is_finite() { format!("{steps:.1e} steps") } else { "countless steps".into() }
}

fn fewer_steps(duration: f64) -> String {
    let step = duration / 1e6;
    if step < f64::MIN_POSITIVE {
        // Parts of it are 0, or numbers of a few bits.
        return format!("use a longer duration: {} is too short to be divided", display(duration));
    }
    format!("use a longer step (for example --step {}) or a shorter --duration", display(step))
}

fn listed(option: &str, times: &[f64]) -> String {
    let times: Vec<String> = times.iter().map(|t| format!("{option} {}", display(*t))).collect();
    times.join(" or ")
}

fn alternatives(steps: &[f64], intervals: &[f64]) -> String {
    let steps = listed("--step", steps);
    if intervals.is_empty() {
        steps
    } else {
        format!("{steps}; or {}", listed("--every", intervals))
    }
}

/// \[s\] the step of a scene: the given one, else the scene's, else a round one up to `longest` \[s\] that divides
/// duration and sampling interval.
///
/// # Errors
/// If no step divides these, or too many steps are needed.
pub fn step_of(
    scene: &Scene,
    given: Option<f64>,
    longest: impl FnOnce() -> f64,
) -> Result<f64, PlanError> {
    if let Some(step) = given.or(scene.step) {
        return Ok(step);
    }
    let step = StepRequest::AtMost(longest());
    Ok(plan(&Request { step, duration: scene.duration, every: scene.every })?.step)
}

/// Plans a run.
///
/// # Errors
/// Where the step does not fit, or steps or samples are too many.
pub fn plan(request: &Request) -> Result<Plan, PlanError> {
    let Request { duration, every, .. } = *request;
    if let Some(every) = every.filter(|every| *every > duration * (1.0 + WHOLE)) {
        return Err(PlanError::Every { duration, every });
    }
    // No step fits such an interval, and its count may overflow.
    if let Some(samples) = every.map(|every| duration / every).filter(|many| *many > MAX_STEPS) {
        return Err(too_many_samples(samples, duration, request.step));
    }
    let span = Span::new(duration, every);
    let step = match request.step {
        StepRequest::Given(step) => step,
        StepRequest::AtMost(limit) => {
            check_steps(duration, limit)?;
            span.ok_or_else(|| incommensurate(duration, every))?.round_step(limit)
        }
    };
    check_steps(duration, step)?;
    let misfit = |what, value, intervals| {
        let steps = span.map_or_else(Vec::new, |span| span.nearest_steps(step));
        if steps.is_empty() {
            return incommensurate(duration, every);
        }
        PlanError::Multiple { what, value, step, steps, intervals }
    };
    let steps =
        whole(duration / step).ok_or_else(|| misfit("the duration", duration, Vec::new()))?;
    let stride = match every {
        Some(every) => whole(every / step)
            .ok_or_else(|| misfit("the sampling interval", every, multiples(step, every)))?,
        None => stride_for(steps),
    };
    let plan = Plan { step, duration, steps, stride };
    if plan.samples() > MAX_SAMPLES {
        let step = StepRequest::Given(plan.step);
        return Err(too_many_samples(plan.samples() as f64, duration, step));
    }
    Ok(plan)
}

/// With an interval of about a thousand samples, of whole steps where the step is given.
fn too_many_samples(samples: f64, duration: f64, step: StepRequest) -> PlanError {
    let every = match step {
        StepRequest::Given(step) if duration / step <= MAX_STEPS => {
            let stride = (duration / step) as u64 / 1000;
            rounded(stride.max(1) as f64 * step, 12)
        }
        _ => duration / 1000.0,
    };
    PlanError::Samples { samples, every }
}

fn check_steps(duration: f64, step: f64) -> Result<(), PlanError> {
    let steps = duration / step;
    if steps <= MAX_STEPS { Ok(()) } else { Err(PlanError::Steps { steps, step, duration }) }
}

/// The multiples of `step` on either side of `time`, without the digits of rounding.
fn multiples(step: f64, time: f64) -> Vec<f64> {
    let below = (time / step) as u64;
    let counts = [below, below.saturating_add(1)].into_iter().filter(|count| *count > 0);
    counts.map(|count| rounded(count as f64 * step, 12)).collect()
}

fn incommensurate(duration: f64, every: Option<f64>) -> PlanError {
    let every = every.unwrap_or(duration);
    let below = (duration / every) as u64;
    let intervals = [below.saturating_add(1), below].into_iter().filter(|n| *n > 0);
    let intervals = intervals.map(|n| rounded(duration / n as f64, 12)).collect();
    PlanError::Incommensurate { duration, every, intervals }
}

/// Steps per sample for about [`SAMPLES`] samples: the divisor of `steps` nearest to
/// `steps/SAMPLES` in ratio, if one lies within a factor of 2; else with a shorter last interval.
fn stride_for(steps: u64) -> u64 {
    let mut best = None;
    for intervals in SAMPLES / 2..=SAMPLES * 2 {
        if steps.is_multiple_of(intervals) {
            let ratio = intervals as f64 / SAMPLES as f64;
            let distance = if ratio < 1.0 { 1.0 / ratio } else { ratio };
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, steps / intervals));
            }
        }
    }
    best.map_or_else(|| steps.div_ceil(SAMPLES), |(_, stride)| stride).max(1)
}

#[cfg(test)]
mod tests;
