//! A run in whole numbers: step, number of steps, steps per sample.
//!
//! `(step, duration, every) => plan`. Duration and sampling interval are whole multiples of the
//! step, within 1e-9 of them; nothing is ever interpolated. A step that was given is taken as it
//! is or refused; one that is ours is shortened to fit. A pure function of its arguments, in
//! + − × ÷ and conversions to integers only, so that every host plans the same run.

use miette::Diagnostic;
use thiserror::Error;

use crate::fitting::{Span, WHOLE, whole};
use crate::time::{display, rounded};

/// The number of samples where no interval is given.
const SAMPLES: u64 = 500;

/// More steps than this are refused: at 100 ns each they take longer than a day.
pub const MOST_STEPS: f64 = 1e12;

/// More samples than this are refused: a trace of several gigabytes.
pub const MOST_SAMPLES: u64 = 10_000_000;

/// The step that a run is to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepRequest {
    /// \[s\] exactly this one.
    Given(f64),
    /// \[s\] this one or the longest shorter one that fits.
    AtMost(f64),
    /// \[s\] likewise, up to a third shorter where that makes it a round number.
    RoundAtMost(f64),
}

/// What a run is planned from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The step.
    pub step: StepRequest,
    /// \[s\] simulated time, > 0.
    pub duration: f64,
    /// \[s\] the sampling interval, > 0; about 500 samples where there is none.
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
    #[error("{what} of {} is not a whole multiple of the step of {}", display(*value), display(*step))]
    #[diagnostic(help("nearest that fit: {}", alternatives(steps, intervals)))]
    Multiple {
        /// `the duration` or `the sampling interval`.
        what: &'static str,
        /// \[s\] its value.
        value: f64,
        /// \[s\] the step.
        step: f64,
        /// \[s\] the nearest steps that fit duration and sampling interval, nearest first.
        steps: Vec<f64>,
        /// \[s\] the nearest sampling intervals that fit the step, where that is enough.
        intervals: Vec<f64>,
    },
    /// No step divides both.
    #[error(
        "no step divides both the duration of {} and the sampling interval of {}",
        display(*duration),
        display(*every)
    )]
    #[diagnostic(help("sampling intervals that fit: {}", listed("--every", intervals)))]
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
        "the sampling interval of {} is longer than the duration of {}",
        display(*every),
        display(*duration)
    )]
    #[diagnostic(help("an interval that fits: --every {}", display(*duration)))]
    Every {
        /// \[s\] the duration.
        duration: f64,
        /// \[s\] the sampling interval.
        every: f64,
    },
    /// More than [`MOST_STEPS`].
    #[error("{steps:.1e} steps of {} are more than {MOST_STEPS:e}", display(*step))]
    #[diagnostic(help(
        "a longer step (for example --step {}) or a shorter --duration",
        display(duration / 1e6)
    ))]
    Steps {
        /// How many.
        steps: f64,
        /// \[s\] the step.
        step: f64,
        /// \[s\] the duration.
        duration: f64,
    },
    /// More than [`MOST_SAMPLES`].
    #[error("{samples} samples are more than {MOST_SAMPLES}")]
    #[diagnostic(help("a longer sampling interval, for example --every {}", display(*every)))]
    Samples {
        /// How many.
        samples: u64,
        /// \[s\] an interval that gives about a thousand.
        every: f64,
    },
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

/// Plans a run.
///
/// # Errors
/// Where the step does not fit, or steps or samples are too many.
pub fn plan(request: &Request) -> Result<Plan, PlanError> {
    let Request { duration, every, .. } = *request;
    if let Some(every) = every.filter(|every| *every > duration * (1.0 + WHOLE)) {
        return Err(PlanError::Every { duration, every });
    }
    let span = Span::new(duration, every);
    let parts_of_ours = |limit| {
        check_steps(duration, limit)?;
        let span = span.ok_or_else(|| incommensurate(duration, every))?;
        Ok((span, span.parts_at_most(limit)))
    };
    let step = match request.step {
        StepRequest::Given(step) => step,
        StepRequest::AtMost(limit) => parts_of_ours(limit).map(|(span, parts)| span.step(parts))?,
        StepRequest::RoundAtMost(limit) => {
            parts_of_ours(limit).map(|(span, parts)| span.round_step(parts))?
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
    if plan.samples() > MOST_SAMPLES {
        let every = plan.time((steps / 1000).max(1));
        return Err(PlanError::Samples { samples: plan.samples(), every });
    }
    Ok(plan)
}

fn check_steps(duration: f64, step: f64) -> Result<(), PlanError> {
    let steps = duration / step;
    if steps <= MOST_STEPS { Ok(()) } else { Err(PlanError::Steps { steps, step, duration }) }
}

/// The multiples of `step` on either side of `time`, without the digits of rounding.
fn multiples(step: f64, time: f64) -> Vec<f64> {
    let below = (time / step) as u64;
    let counts = [below, below + 1].into_iter().filter(|count| *count > 0);
    counts.map(|count| rounded(count as f64 * step, 12)).collect()
}

fn incommensurate(duration: f64, every: Option<f64>) -> PlanError {
    let every = every.unwrap_or(duration);
    let below = (duration / every) as u64;
    let intervals = [below + 1, below].into_iter().filter(|n| *n > 0);
    let intervals = intervals.map(|n| rounded(duration / n as f64, 12)).collect();
    PlanError::Incommensurate { duration, every, intervals }
}

/// Steps per sample for about [`SAMPLES`] samples: the divisor of `steps` nearest to
/// `steps/SAMPLES` in ratio, where one lies within a factor of 2; else with a last interval that
/// is shorter.
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
mod tests {
    use super::*;

    fn given(step: f64, duration: f64, every: Option<f64>) -> Result<Plan, PlanError> {
        plan(&Request { step: StepRequest::Given(step), duration, every })
    }

    fn ours(limit: f64, duration: f64, every: Option<f64>) -> Result<Plan, PlanError> {
        plan(&Request { step: StepRequest::AtMost(limit), duration, every })
    }

    #[test]
    fn decimal_times_that_are_no_binary_multiples_count_as_whole() {
        let plan = given(2e-5, 0.5, Some(1e-3)).unwrap();
        assert_eq!(
            (plan.step.to_bits(), plan.steps, plan.stride),
            (2e-5_f64.to_bits(), 25_000, 50)
        );
        assert_eq!(plan.samples(), 501);
        let plan = given(1e-6, 3.0, Some(0.3)).unwrap();
        assert_eq!((plan.steps, plan.stride), (3_000_000, 300_000));
        // 0.1 + 0.2 is not 0.3.
        assert_eq!(given(0.1, 0.1 + 0.2, None).unwrap().steps, 3);
        assert_eq!(given(0.5, 0.5, None).unwrap().samples(), 2);
    }

    #[test]
    fn a_duration_that_is_no_multiple_of_every_ends_with_a_shorter_interval() {
        let plan = given(0.1, 1.0, Some(0.3)).unwrap();
        assert_eq!((plan.steps, plan.stride, plan.samples()), (10, 3, 5));
    }

    #[test]
    fn a_given_step_that_does_not_fit_is_refused_with_two_that_do() {
        let cases = [
            (3e-5, 0.5, None),
            (3e-5, 0.5, Some(1e-3)),
            (7.3e-4, 0.5, Some(1e-3)),
            (2e-4, 0.5, Some(1.1e-3)),
            (0.4, 1.0, Some(0.3)),
            (1.0 / 7.1, 1.0, None),
        ];
        for (step, duration, every) in cases {
            let Err(PlanError::Multiple { steps, .. }) = given(step, duration, every) else {
                panic!("{step} {duration} {every:?}");
            };
            assert_eq!(steps.len(), 2, "{step}");
            for fitting in &steps {
                let shown: crate::time::Time = display(*fitting).parse().unwrap();
                let plan = given(shown.seconds(), duration, every).unwrap();
                assert_eq!(plan.step.to_bits(), fitting.to_bits());
            }
        }
        let Err(PlanError::Multiple { steps, .. }) = given(3e-5, 0.5, Some(1e-3)) else {
            panic!();
        };
        assert_eq!(steps, [1e-3 / 33.0, 1e-3 / 34.0]);
    }

    #[test]
    fn where_only_every_does_not_fit_intervals_are_named_too() {
        let Err(PlanError::Multiple { intervals, .. }) = given(2e-5, 0.5, Some(1.234e-3)) else {
            panic!();
        };
        assert_eq!(intervals, [1.22e-3, 1.24e-3]);
        for every in intervals {
            assert!(given(2e-5, 0.5, Some(every)).is_ok());
        }
    }

    #[test]
    fn a_step_longer_than_the_duration_is_refused_with_shorter_ones() {
        let Err(PlanError::Multiple { steps, .. }) = given(0.7, 0.5, None) else { panic!() };
        assert_eq!(steps, [0.5, 0.25]);
        let every = 0.6;
        assert_eq!(given(0.1, 0.5, Some(every)), Err(PlanError::Every { duration: 0.5, every }));
    }

    #[test]
    fn our_step_is_shortened_to_fit() {
        let plan = ours(2.9e-4, 0.5, Some(1e-3)).unwrap();
        assert_eq!((plan.step, plan.stride, plan.steps), (1e-3 / 4.0, 4, 2000));
        // Every third of a millisecond into a duration of 10/3 of it: three parts at least.
        let plan = ours(1.0, 1.0, Some(0.3)).unwrap();
        assert_eq!((plan.stride, plan.steps), (3, 10));
        let plan = ours(0.04, 1.0, Some(0.3)).unwrap();
        assert_eq!((plan.stride, plan.steps), (9, 30));
        let plan = ours(3e-4, 0.5, None).unwrap();
        assert_eq!(plan.steps, 1667);
        assert!(plan.step <= 3e-4);
        assert_eq!(ours(f64::INFINITY, 2.0, None).unwrap().steps, 1);
    }

    #[test]
    fn a_round_step_is_short_to_write() {
        let round = |limit, duration, every| {
            plan(&Request { step: StepRequest::RoundAtMost(limit), duration, every }).unwrap().step
        };
        assert_eq!(round(3.91e-5, 0.5, Some(1e-3)), 3.125e-5);
        assert_eq!(round(3.91e-5, 0.5, None), 3.2e-5);
        assert_eq!(round(2.3e-5, 0.5, Some(1e-3)), 2e-5);
        assert_eq!(round(2e-5, 0.5, Some(1e-3)), 2e-5);
        assert_eq!(round(1.0, 1.0 / 3.0, None), 1.0 / 3.0);
    }

    #[test]
    fn awkward_limits_give_fitting_steps() {
        let mut limit = 1.3e-7;
        while limit < 1.0 {
            for every in [None, Some(1e-3), Some(0.011), Some(1.0 / 3.0)] {
                let plan = ours(limit, 0.7, every).unwrap();
                assert!(plan.step <= limit * (1.0 + 1e-15), "{limit} {every:?}");
                let again = given(plan.step, 0.7, every).unwrap();
                assert_eq!(again, plan);
                let end = plan.time(plan.steps);
                assert!((end - 0.7).abs() <= 0.7e-9, "{end}");
            }
            limit *= 1.618;
        }
    }

    #[test]
    fn incommensurate_intervals_name_intervals_that_fit() {
        let every = 1.2347e-3;
        let Err(PlanError::Incommensurate { intervals, .. }) = ours(1e-4, 0.5, Some(every)) else {
            panic!();
        };
        assert_eq!(intervals.len(), 2);
        for every in intervals {
            assert!(ours(1e-4, 0.5, Some(every)).is_ok());
        }
    }

    #[test]
    fn about_five_hundred_samples() {
        let strides = [
            (25_000, 50),
            (500, 1),
            (1, 1),
            (249, 1),
            (750, 2),
            (1_000, 2),
            (1_667, 4),
            (100_003, 201),
            (1 << 20, 1 << 11),
        ];
        for (steps, stride) in strides {
            assert_eq!(stride_for(steps), stride, "{steps}");
        }
        let plan = given(1.0, 100_003.0, None).unwrap();
        assert_eq!(plan.samples(), 499);
    }

    #[test]
    fn absurd_requests_are_refused_with_advice() {
        assert!(matches!(given(1e-300, 0.5, None), Err(PlanError::Steps { .. })));
        assert!(matches!(ours(1e-300, 0.5, None), Err(PlanError::Steps { .. })));
        assert!(matches!(ours(0.0, 0.5, None), Err(PlanError::Steps { .. })));
        let Err(PlanError::Samples { samples, every }) = given(1e-9, 0.5, Some(1e-9)) else {
            panic!();
        };
        assert_eq!(samples, 500_000_001);
        assert!(given(1e-9, 0.5, Some(every)).is_ok());
    }
}
