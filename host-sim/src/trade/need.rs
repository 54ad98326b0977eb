//! What the paper's scheme would cost at an accuracy, read from its measured steps.
//!
//! `points, error => cost, and how it is known`: straight between two steps in the logarithms,
//! beyond the last along the last two.

use super::advice::{is_paper, place};
use super::point::{Machine, Point, Stepper};

/// An error that falls with less than this power of the step does not fall.
const LEAST_ORDER: f64 = 0.5;

/// What a stepper costs at an accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Need {
    /// Its largest stable step is better than that already.
    Largest {
        /// Of that step.
        cost: f64,
        /// \[s\] the step.
        step: f64,
    },
    /// Between two measured steps, straight in the logarithms.
    Between {
        /// Between theirs.
        cost: f64,
    },
    /// Beyond its smallest measured step, along the last two.
    Beyond {
        /// Carried on.
        cost: f64,
        /// By which power of the step the error falls there.
        order: f64,
    },
    /// Its error does not fall any further with the step.
    Never,
    /// No step of it is both stable and known in cost.
    Unknown,
}

impl Need {
    /// The cost where there is one.
    #[must_use]
    pub fn cost(self) -> Option<f64> {
        match self {
            Need::Largest { cost, .. } | Need::Between { cost } | Need::Beyond { cost, .. } => {
                Some(cost)
            }
            Need::Never | Need::Unknown => None,
        }
    }
}

/// What the paper's scheme costs at an accuracy \[m\]; `None` where it is not among the points. On the
/// target, whose FPU has single precision, in the cheaper precision that reaches it.
#[must_use]
pub fn paper_need(points: &[Point], machine: Machine, target: f64) -> Option<Need> {
    let double = need_of(points, machine, target, is_paper)?;
    if machine == Machine::Host {
        return Some(double);
    }
    // In single precision its error stops falling, so only what was measured counts.
    let single = |stepper: &Stepper| {
        is_paper(&Stepper { precision: "f64".into(), ..stepper.clone() })
            && stepper.precision == "f32"
    };
    let cheaper = |need: &Need| {
        let measured = matches!(need, Need::Largest { .. } | Need::Between { .. });
        measured && need.cost() < Some(double.cost().unwrap_or(f64::INFINITY))
    };
    Some(need_of(points, machine, target, single).filter(cheaper).unwrap_or(double))
}

/// The need of one stepper, `None` where it is not among the points.
fn need_of(
    points: &[Point],
    machine: Machine,
    target: f64,
    is: impl Fn(&Stepper) -> bool,
) -> Option<Need> {
    let mut of = points.iter().filter(|point| is(&point.stepper)).peekable();
    of.peek()?;
    let mut known: Vec<(f64, f64, f64)> = of
        .filter_map(|point| place(point, machine).map(|(cost, error)| (point.step, cost, error)))
        .collect();
    known.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some(need(&known, target))
}

/// The need of (step, cost, error), the largest step first.
fn need(known: &[(f64, f64, f64)], target: f64) -> Need {
    let Some(&(step, cost, error)) = known.first() else { return Need::Unknown };
    if error <= target {
        return Need::Largest { cost, step };
    }
    for pair in known.windows(2) {
        let [(_, cost, error), (_, next_cost, next_error)] = pair else { continue };
        if *next_error <= target {
            // An exact result has no logarithm: its step is then what is needed.
            let share = match *next_error > 0.0 {
                true => (error / target).ln() / (error / next_error).ln(),
                false => 1.0,
            };
            return Need::Between { cost: cost * (next_cost / cost).powf(share) };
        }
    }
    let [.., (step, cost, error), (next_step, next_cost, next_error)] = known else {
        return Need::Never;
    };
    let order = (error / next_error).ln() / (step / next_step).ln();
    let rise = (next_cost / cost).ln() / (step / next_step).ln();
    if !(order >= LEAST_ORDER && rise > 0.0) {
        return Need::Never;
    }
    let cost = next_cost * (next_error / target).powf(rise / order);
    Need::Beyond { cost, order }
}

#[cfg(test)]
mod tests {
    use super::super::advice::tests::ladder;
    use super::*;

    #[test]
    fn the_paper_is_read_between_its_own_steps() {
        let points = ladder();
        let need = |target| paper_need(&points, Machine::Host, target).unwrap();
        assert_eq!(need(1e-2), Need::Largest { cost: 1e-6 / 1e-3, step: 1e-3 });
        let Need::Between { cost } = need(10_f64.powf(-4.5)) else { panic!() };
        assert!((cost / (1e-6 * 10_f64.powf(4.5)) - 1.0).abs() < 1e-12);
        let Need::Beyond { cost, order } = need(1e-8) else { panic!() };
        assert!((cost / 1e2 - 1.0).abs() < 1e-9 && (order - 1.0).abs() < 1e-12);
        // An error that does not fall is not carried on.
        let flat = [(1e-3, 1.0, 1e-5), (1e-4, 10.0, 0.9e-5)];
        assert_eq!(super::need(&flat, 1e-6), Need::Never);
        assert_eq!(super::need(&[], 1e-6), Need::Unknown);
        assert_eq!(paper_need(&points[3..], Machine::Host, 1e-3), None);
        // Single precision at a tenth of the instructions counts on the target alone.
        let mut both = points.clone();
        for mut point in points.into_iter().filter(|point| is_paper(&point.stepper)) {
            point.stepper.precision = "f32".into();
            point.target_instructions = point.target_instructions.map(|count| 0.1 * count);
            both.push(point);
        }
        let cost = |points: &[Point], machine| {
            paper_need(points, machine, 1e-4).and_then(Need::cost).unwrap()
        };
        let double = cost(&both[..both.len() - 3], Machine::Target);
        assert!((cost(&both, Machine::Target) / double - 0.1).abs() < 1e-9);
        assert!((cost(&both, Machine::Host) / cost(&both[..3], Machine::Host) - 1.0).abs() < 1e-12);
    }
}
