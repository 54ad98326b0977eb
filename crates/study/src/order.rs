//! Observed convergence orders, and their limits.
//!
//! `(points, facts, scene) => per point the observed order, and what limits it`. Orders come from the measured errors
//! of a stepper's ladder; the scene only determines the possible causes. A reduced order without a known cause is not
//! reported.

use dbd_kernel::damping::Damping;
use dbd_plant::Method;
use dbd_scene::Scene;

use crate::point::{Cause, Fall, Point, Stepper};

/// An observed order that lies below the stated one by more than this falls short.
const SHORT: f64 = 0.6;

/// Errors within this factor of the uncertainty of the reference solution, or of rounding, are not used for orders.
const CLEAR: f64 = 10.0;

/// Possible causes of a scene within a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Influences {
    /// It has dampers.
    pub dampers: bool,
    /// A load begins or ends, or a table has a knot.
    pub changes: bool,
}

impl Influences {
    /// Possible causes in the first `window` \[s\] of a scene.
    #[must_use]
    pub fn of(scene: &Scene, window: f64) -> Self {
        let within = |time: f64| time > 0.0 && time < window;
        let model = &scene.model;
        let loads = model.loads.iter().any(|load| within(load.from) || within(load.until));
        let tables = model.knots.iter().any(|knot| within(knot.time) || knot.slope != 0.0)
            || !model.sources.is_empty();
        Self { dampers: !model.dampers.is_empty(), changes: loads || tables }
    }
}

/// Sets the convergence of each point. `methods` has the method of each point of the kernel; errors below `uncertainty`
/// \[m\] are unknown.
pub fn describe(
    points: &mut [Point],
    methods: &[Option<Method>],
    influences: Influences,
    uncertainty: f64,
) {
    let falls: Vec<Fall> = (0..points.len())
        .map(|row| {
            let Some(method) = methods[row] else { return Fall::default() };
            let stepper = &points[row].stepper;
            let ladder = ladder(points, stepper);
            let finest = finest(&ladder).filter(|_| is_rounding(points, stepper, &ladder));
            let rounding = ladder.iter().map(|(_, error)| *error).fold(f64::INFINITY, f64::min);
            let floor = if finest.is_some() { uncertainty.max(rounding) } else { uncertainty };
            let order = order(&ladder, points[row].step, CLEAR * floor);
            let cause = order.and_then(|order| cause(order, &method, influences));
            Fall { order, stated: Some(method.orders()[0]), cause, finest }
        })
        .collect();
    points.iter_mut().zip(falls).for_each(|(point, fall)| point.fall = fall);
}

/// Whether rounding limits a stepper's ladder: double precision continues to converge.
fn is_rounding(points: &[Point], stepper: &Stepper, ladder: &[(f64, f64)]) -> bool {
    if stepper.precision == "f64" {
        return false;
    }
    let double = self::ladder(points, &Stepper { precision: "f64".into(), ..stepper.clone() });
    match (ladder.last(), double.last()) {
        (Some((_, single)), Some((_, double))) => *double < 0.5 * single,
        _ => true,
    }
}

/// Step and error of a stepper, where it has one, the largest step first.
fn ladder(points: &[Point], stepper: &Stepper) -> Vec<(f64, f64)> {
    let of = |point: &&Point| point.stepper == *stepper && point.stable && !point.lost;
    let with_error = |point: &Point| Some((point.step, point.error?));
    let mut ladder: Vec<(f64, f64)> = points.iter().filter(of).filter_map(with_error).collect();
    ladder.sort_by(|a, b| b.0.total_cmp(&a.0));
    ladder
}

/// The step of the least error, where smaller steps were tried.
fn finest(ladder: &[(f64, f64)]) -> Option<f64> {
    let (step, _) = ladder.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    (*step > ladder.last()?.0).then_some(*step)
}

/// The order from a step to the next smaller one; from the next larger one if there is none whose error exceeds `least`
/// \[m\].
fn order(ladder: &[(f64, f64)], step: f64, least: f64) -> Option<f64> {
    let known: Vec<(f64, f64)> = ladder.iter().copied().filter(|(_, e)| *e > least).collect();
    let place = known.iter().position(|(known, _)| *known == step)?;
    let [large, small] = match known.get(place + 1) {
        Some(next) => [known[place], *next],
        None => [*known.get(place.checked_sub(1)?)?, known[place]],
    };
    let order = (large.1 / small.1).ln() / (large.0 / small.0).ln();
    order.is_finite().then_some(order)
}

/// Cause of a reduced order, if any.
fn cause(order: f64, method: &Method, influences: Influences) -> Option<Cause> {
    let [undamped, damped] = method.orders().map(f64::from);
    let stated = if influences.dampers { damped } else { undamped };
    if order < stated - SHORT {
        return influences.changes.then_some(Cause::LoadsAndTables);
    }
    if order > undamped - SHORT || !influences.dampers {
        return None;
    }
    Some(match method.damping() {
        Damping::Sweeps | Damping::JointWise | Damping::Implicit => Cause::SweptDampers,
        Damping::Explicit => Cause::ExplicitDampers,
    })
}

#[cfg(test)]
mod tests {
    use dbd_plant::{DampingName, PrecisionName, SchemeName};

    use super::*;
    use crate::point::tests::point;

    const CALM: Influences = Influences { dampers: false, changes: false };
    const DAMPED: Influences = Influences { dampers: true, changes: false };
    const DRIVEN: Influences = Influences { dampers: false, changes: true };

    /// The falls of a ladder whose error is `error(step)`.
    fn falls(method: Method, influences: Influences, error: impl Fn(f64) -> f64) -> Vec<Fall> {
        let steps = [1e-3, 5e-4, 2.5e-4, 1e-4, 5e-5];
        let mut points = steps.map(|h| point(method.scheme_name(), h, 1e-6 / h, Some(error(h))));
        for point in &mut points {
            point.stepper.precision = method.precision_name().into();
        }
        describe(&mut points, &[Some(method); 5], influences, 1e-14);
        points.map(|point| point.fall).to_vec()
    }

    fn method(scheme: SchemeName, precision: PrecisionName) -> Method {
        Method::new(scheme, None, precision).unwrap()
    }

    #[test]
    fn what_limits_an_order_is_what_was_measured() {
        let pefrl = method(SchemeName::Pefrl, PrecisionName::F64);
        let leapfrog = method(SchemeName::Leapfrog, PrecisionName::F64);
        let explicit = leapfrog.with_damping(DampingName::Explicit).unwrap();
        for (method, influences, power, cause) in [
            (pefrl, CALM, 4, None),
            (pefrl, DRIVEN, 4, None),
            (pefrl, DRIVEN, 1, Some(Cause::LoadsAndTables)),
            // The cause is unknown.
            (pefrl, CALM, 1, None),
            (pefrl, DAMPED, 2, Some(Cause::SweptDampers)),
            (pefrl, DAMPED, 4, None),
            (pefrl, Influences { dampers: true, changes: true }, 1, Some(Cause::LoadsAndTables)),
            (leapfrog, DAMPED, 2, None),
            (explicit, DAMPED, 1, Some(Cause::ExplicitDampers)),
            (explicit, CALM, 2, None),
        ] {
            let falls = falls(method, influences, |h| 1e6 * h.powi(power));
            for fall in &falls {
                let order = fall.order.unwrap();
                assert!((order - f64::from(power)).abs() < 1e-9, "{method:?}: {fall:?}");
                assert_eq!(fall.cause, cause, "{method:?}, {influences:?}, {power}");
                assert_eq!((fall.finest, fall.stated), (None, Some(method.orders()[0])));
            }
        }
    }

    #[test]
    fn rounding_ends_a_ladder_in_single_precision_alone() {
        let rounded = |h: f64| 1e6 * h.powi(4) + 1e-11 / h.sqrt();
        let single = falls(method(SchemeName::Pefrl, PrecisionName::F32), DAMPED, rounded);
        assert!(single.iter().all(|fall| fall.finest == Some(1e-4)), "{single:?}");
        // With rounding no order is reported, and no damper is named as a cause.
        assert!(single[0].order.is_some_and(|order| order > 3.9), "{single:?}");
        assert!(single[2..].iter().all(|fall| fall.order.is_none()), "{single:?}");
        assert!(single.iter().all(|fall| fall.cause.is_none()), "{single:?}");
        let double = falls(method(SchemeName::Pefrl, PrecisionName::F64), DAMPED, rounded);
        assert!(double.iter().all(|fall| fall.finest.is_none()));
        // If double precision does not improve it either, it is not rounding.
        let leapfrog = method(SchemeName::Leapfrog, PrecisionName::F32);
        let flat = |h: f64| 1e-6 + 1e-9 / h;
        let of = |precision: &str| {
            [1e-3, 5e-4].map(|h| {
                let mut point = point("leapfrog", h, 1e-6 / h, Some(flat(h)));
                point.stepper.precision = precision.into();
                point
            })
        };
        let mut points: Vec<Point> = of("f32").into_iter().chain(of("f64")).collect();
        describe(&mut points, &[Some(leapfrog); 4], CALM, 1e-14);
        assert!(points.iter().all(|point| point.fall.finest.is_none()));
        points[3].error = Some(1e-8);
        describe(&mut points, &[Some(leapfrog); 4], CALM, 1e-14);
        assert_eq!(points[0].fall.finest, Some(1e-3));
        let falling = falls(method(SchemeName::Pefrl, PrecisionName::F32), DAMPED, |h| 1e6 * h * h);
        assert!(falling.iter().all(|fall| fall.finest.is_none()));
    }

    #[test]
    fn what_the_truth_is_not_known_to_has_no_order() {
        let falls = falls(method(SchemeName::Pefrl, PrecisionName::F64), CALM, |_| 5e-14);
        assert!(falls.iter().all(|fall| fall.order.is_none()));
    }
}
