//! Accuracy and cost of single precision and fixed point on the target, in a sentence.
//!
//! `points => sentence`: the smallest error that a usable step of each precision reaches, and the cost of a step.

use dbd_plant::digits::significant;
use dbd_plant::time::rounded;

use crate::point::{Machine, Point};
use crate::words::{named, shown, times};

/// The precision of a single-precision FPU, and the others.
const SINGLE: &str = "f32";
const FIXED: &str = "fixed";
const DOUBLE: &str = "f64";

/// The most accurate usable point of the kernel in a precision whose cost is known.
fn best<'p>(points: &'p [Point], precision: &str) -> Option<(&'p Point, f64)> {
    let of = |point: &&Point| point.stepper.kernel && point.stepper.precision == precision;
    let known = points.iter().filter(of);
    let reached = known.filter_map(|point| Some((point, point.kept(Machine::Target)?.1)));
    reached.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Instructions of a step relative to single precision, median over the steppers with both.
fn over_single(points: &[Point], precision: &str) -> Option<f64> {
    let per_step = |point: &Point| Some(point.target_instructions? * point.step);
    let of = |point: &&Point| point.stepper.kernel && point.stepper.precision == precision;
    let mut ratios: Vec<f64> = points
        .iter()
        .filter(of)
        .filter_map(|point| {
            let mut single = point.stepper.clone();
            single.precision = SINGLE.into();
            let other = points.iter().find(|other| other.stepper == single)?;
            Some(per_step(point)? / per_step(other)?)
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied()
}

/// Sentence on f32 and fixed point; `None` if either was not counted. Errors below the uncertainty \[m\] of the
/// reference solution are not distinguished.
#[must_use]
pub fn of_precisions(points: &[Point], uncertainty: f64) -> Option<String> {
    let ((single, floor), (fixed, reached)) = (best(points, SINGLE)?, best(points, FIXED)?);
    let metres = |error: f64| match error < uncertainty {
        true => format!("less than {uncertainty:.0e}"),
        false => significant(rounded(error, 2), 2),
    };
    let mut text = format!(
        "in f32 the smallest error here is {} m ({}, step {})",
        metres(floor),
        named(&single.stepper),
        shown(single.step),
    );
    text += &match reached < floor {
        true => format!(
            "; fixed reaches {} m ({}, step {})",
            metres(reached),
            named(&fixed.stepper),
            shown(fixed.step)
        ),
        false => format!("; fixed is no more accurate, {} m", metres(reached)),
    };
    let ratio = over_single(points, FIXED)?;
    text += &format!(" at {} times the instructions of a step in f32", times(ratio));
    if let Some(ratio) = over_single(points, DOUBLE) {
        text += &format!(", f64 costs {} times", times(ratio));
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::tests::point;

    fn of(precision: &str, step: f64, per_step: f64, error: f64) -> Point {
        let mut point = point("pefrl", step, per_step / step, Some(error));
        point.stepper.precision = precision.into();
        point
    }

    #[test]
    fn the_floor_of_each_and_the_price_are_told() {
        let mut points = vec![
            of("f32", 1e-4, 1e-5, 3e-6),
            of("f32", 1e-5, 1e-5, 4e-6),
            of("fixed", 1e-4, 1.5e-5, 3e-6),
            of("fixed", 1e-5, 1.5e-5, 2.04e-8),
            of("f64", 1e-5, 4e-4, 1e-8),
        ];
        assert_eq!(
            of_precisions(&points, 1e-10).as_deref(),
            Some(
                "in f32 the smallest error here is 3e-6 m (pefrl, f32, step 100us); fixed reaches \
                 2e-8 m (pefrl, fixed, step 10us) at 1.5 times the instructions of a step in f32, f64 costs 40 times"
            )
        );
        // Unusable points do not count.
        points[3].advisable = false;
        assert!(
            of_precisions(&points, 1e-10)
                .is_some_and(|text| text.contains("fixed is no more accurate"))
        );
        points.retain(|point| point.stepper.precision != "fixed");
        assert_eq!(of_precisions(&points, 1e-10), None);
    }
}
