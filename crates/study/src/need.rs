//! Cost of the paper's scheme at an accuracy, from its measured steps.
//!
//! `points, error => cost, and its origin`: log-linear interpolation between two steps, extrapolation from the last two
//! by at most two decades of error.

use crate::point::{Machine, Point, Stepper, is_paper};

/// An error that falls with less than this power of the step does not fall.
const LEAST_ORDER: f64 = 0.5;

/// By how much the error of the last step is divided at most where none was measured.
const FURTHEST: f64 = 100.0;

/// Cost of a stepper at an accuracy.
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
    /// Beyond the extrapolation range.
    MoreThan {
        /// At the end of the extrapolation range.
        cost: f64,
    },
    /// Its error no longer falls with the step.
    Never,
    /// No step of it is stable.
    Unstable,
    /// The cost of a step is unknown.
    Uncounted,
}

/// Cost of the paper's scheme, and its precision.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperNeed {
    /// The need.
    pub need: Need,
    /// `f64`; on the target `f32` where that is cheaper or alone counted.
    pub precision: String,
}

impl Need {
    /// The cost where there is one.
    #[must_use]
    pub fn cost(self) -> Option<f64> {
        match self {
            Need::Largest { cost, .. } | Need::Between { cost } | Need::Beyond { cost, .. } => {
                Some(cost)
            }
            Need::MoreThan { .. } | Need::Never | Need::Unstable | Need::Uncounted => None,
        }
    }
}

/// Cost of the paper's scheme at an accuracy \[m\]; `None` if it is not among the points. On the
/// target, whose FPU has single precision, in the cheaper precision that reaches it, or in the counted one.
#[must_use]
pub fn paper_need(points: &[Point], machine: Machine, target: f64) -> Option<PaperNeed> {
    let of = |precision: &str| {
        let need = need_of(points, machine, target, |stepper| {
            is_paper(stepper, machine) && stepper.precision == precision
        })?;
        Some(PaperNeed { need, precision: precision.into() })
    };
    let double = of("f64");
    if machine == Machine::Host {
        return double;
    }
    let Some(single) = of("f32") else { return double };
    let Some(double) = double else { return Some(single) };
    if double.need == Need::Uncounted {
        return Some(single);
    }
    // In single precision its error stops falling, so only measured points count.
    let measured = matches!(single.need, Need::Largest { .. } | Need::Between { .. });
    let cheaper = single.need.cost() < Some(double.need.cost().unwrap_or(f64::INFINITY));
    Some(if measured && cheaper { single } else { double })
}

/// The need of one stepper, `None` where it is not among the points.
fn need_of(
    points: &[Point],
    machine: Machine,
    target: f64,
    is: impl Fn(&Stepper) -> bool,
) -> Option<Need> {
    let of: Vec<&Point> = points.iter().filter(|point| is(&point.stepper)).collect();
    if of.is_empty() {
        return None;
    }
    let usable = |cost: Option<f64>| cost.is_some_and(|cost| cost.is_finite() && cost > 0.0);
    if !of.iter().any(|point| usable(point.cost(machine))) {
        return Some(Need::Uncounted);
    }
    if !of.iter().any(|point| point.stable) {
        return Some(Need::Unstable);
    }
    let kept = |point: &&Point| point.kept(machine).map(|(cost, error)| (point.step, cost, error));
    let mut known: Vec<(f64, f64, f64)> = of.iter().filter_map(kept).collect();
    known.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some(need(&known, target))
}

/// The need of (step, cost, error), the largest step first.
fn need(known: &[(f64, f64, f64)], target: f64) -> Need {
    let Some(&(step, cost, error)) = known.first() else { return Need::Never };
    if error <= target {
        return Need::Largest { cost, step };
    }
    for pair in known.windows(2) {
        let [(_, cost, error), (_, next_cost, next_error)] = pair else { continue };
        if *next_error <= target {
            // An exact result has no logarithm: its step is used.
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
    let further = next_error / target;
    let cost = next_cost * further.min(FURTHEST).powf(rise / order);
    if further > FURTHEST * (1.0 + 1e-9) {
        Need::MoreThan { cost }
    } else {
        Need::Beyond { cost, order }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advice::tests::ladder;

    /// The need in whatever precision.
    fn paper(points: &[Point], machine: Machine, target: f64) -> Need {
        paper_need(points, machine, target).unwrap().need
    }

    /// The points and the paper's scheme in single precision, at a tenth of the instructions.
    fn both(points: &[Point]) -> Vec<Point> {
        let mut both = points.to_vec();
        for point in points.iter().filter(|point| is_paper(&point.stepper, Machine::Host)) {
            let mut single = point.clone();
            single.stepper.precision = "f32".into();
            single.target_instructions = point.target_instructions.map(|count| 0.1 * count);
            both.push(single);
        }
        both
    }

    #[test]
    fn the_paper_is_read_between_its_own_steps() {
        let points = ladder();
        let need = |target| paper(&points, Machine::Host, target);
        assert_eq!(need(1e-2), Need::Largest { cost: 1e-6 / 1e-3, step: 1e-3 });
        let Need::Between { cost } = need(10_f64.powf(-4.5)) else { panic!() };
        assert!((cost / (1e-6 * 10_f64.powf(4.5)) - 1.0).abs() < 1e-12);
        let Need::Beyond { cost, order } = need(1.001e-7) else { panic!() };
        assert!((cost * 1.001e-1 - 1.0).abs() < 1e-9 && (order - 1.0).abs() < 1e-12);
        // No extrapolation beyond two decades.
        let Need::MoreThan { cost } = need(1e-9) else { panic!() };
        assert!((cost / 1e1 - 1.0).abs() < 1e-9);
        // An error that does not fall is not carried on.
        let flat = [(1e-3, 1.0, 1e-5), (1e-4, 10.0, 0.9e-5)];
        assert_eq!(super::need(&flat, 1e-6), Need::Never);
        assert_eq!(super::need(&[], 1e-6), Need::Never);
        assert_eq!(paper_need(&points[3..], Machine::Host, 1e-3), None);
    }

    #[test]
    fn single_precision_counts_on_the_target_alone() {
        let points = ladder();
        let both = both(&points);
        let cost = |points: &[Point], machine| paper(points, machine, 1e-4).cost().unwrap();
        let double = cost(&points, Machine::Target);
        assert!((cost(&both, Machine::Target) / double - 0.1).abs() < 1e-9);
        assert!((cost(&both, Machine::Host) / cost(&points, Machine::Host) - 1.0).abs() < 1e-12);
        let precision = |machine| paper_need(&both, machine, 1e-4).unwrap().precision;
        assert_eq!(
            (precision(Machine::Host), precision(Machine::Target)),
            ("f64".into(), "f32".into())
        );
    }

    #[test]
    fn what_was_not_counted_is_not_unstable() {
        let mut points = both(&ladder());
        for point in points.iter_mut().filter(|point| point.stepper.precision == "f64") {
            point.target_instructions = None;
        }
        let need = paper_need(&points, Machine::Target, 1e-4).unwrap();
        assert_eq!(need.precision, "f32");
        assert!(need.need.cost().is_some(), "{need:?}");
        for point in &mut points {
            point.target_instructions = None;
        }
        assert_eq!(paper(&points, Machine::Target, 1e-4), Need::Uncounted);
        for point in &mut points {
            (point.stable, point.error) = (false, None);
        }
        assert_eq!(paper(&points, Machine::Host, 1e-4), Need::Unstable);
        for point in &mut points {
            (point.stable, point.lost, point.error) = (true, true, Some(1.0));
        }
        assert_eq!(paper(&points, Machine::Host, 1e-4), Need::Never);
    }
}
