//! The constants that a step has, in double precision.
//!
//! `(model in any precision, step) => model in double precision`. A kick multiplies by half a step over a mass,
//! rounded once, and a fall adds half a step's, rounded once: what a run in single precision or in fixed point
//! moves are bodies whose masses and inertias are by a digit of single precision others than the model's. Beside
//! [`the model's own`](SceneModel::convert) they show what steps round, and not what constants do.

use dbd_kernel::body::Diagonal;
use dbd_kernel::space::Linear as _;
use dbd_kernel::{Body, F64, Geometry, Real, Vec3};
use dbd_scene::SceneModel;

/// The model in double precision whose bodies and field of gravity are those of steps of `step` \[s\] in `P`. Where
/// a precision has weights as forces, the field is the model's.
#[must_use]
pub fn as_stepped<P: Geometry>(model: &SceneModel<P>, step: f64) -> SceneModel<F64> {
    let h = P::Real::from_f64(step);
    let half = 0.5 * h.to_f64();
    let mut stepped: SceneModel<F64> = model.convert();
    for (to, body) in stepped.bodies.iter_mut().zip(&model.bodies) {
        let Diagonal { mass, inertia } = Diagonal::new(body, h);
        *to = Body::from_f64(half / mass.to_f64(), inertia.to_f64().map(|of| half / of));
    }
    if P::HAS_GRAVITY_STEP {
        for (to, &gravity) in stepped.gravity.iter_mut().zip(&model.gravity) {
            let fall = gravity * (P::Real::HALF * h);
            *to = Vec3::from_f64(fall.to_f64().map(|of| of / half));
        }
    }
    stepped
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{F32, Fixed, Leapfrog, Plant};
    use dbd_scene::widen;

    use super::*;
    use crate::chain::{Joints, model};
    use crate::kept::{Keeper, Kept};

    /// How far the constants of steps are from those of the model, each as a share of itself.
    fn changes<P: Geometry>(step: f64) -> Vec<f64> {
        let model: SceneModel<P> = model(2, Joints::Revolute).unwrap().convert();
        let (exact, stepped) = (model.convert::<F64>(), as_stepped(&model, step));
        let numbers = |model: &SceneModel<F64>| {
            let field = model.gravity.iter().map(|field| field.y);
            let bodies = model.bodies.iter();
            let bodies = bodies.flat_map(|body| [body.mass, body.inertia.x, body.inertia.z]);
            field.chain(bodies).collect::<Vec<_>>()
        };
        let pairs = numbers(&stepped).into_iter().zip(numbers(&exact));
        pairs.map(|(a, b)| (a / b - 1.0).abs()).collect()
    }

    #[test]
    fn constants_are_those_of_the_model_but_for_a_rounding_each() {
        let double = changes::<F64>(2e-5);
        assert!(double.iter().all(|change| *change < 1e-15), "{double:?}");
        let (single, fixed) = (changes::<F32>(2e-5), changes::<Fixed>(2e-5));
        for change in single.iter().chain(&fixed) {
            assert!(*change < 1.3e-7, "{single:?} {fixed:?}");
        }
        // Gravity is the first: a weight is rounded with the forces, a fall by itself.
        assert!(single[0] == 0.0 && fixed[0] > 1e-10, "{single:?} {fixed:?}");
        assert!(fixed[1..].iter().any(|change| *change > 1e-9), "{fixed:?}");
    }

    #[test]
    fn powers_of_two_round_nothing() {
        let mut model: SceneModel<Fixed> = model(2, Joints::Revolute).unwrap().convert();
        for body in &mut model.bodies {
            *body = Body::from_f64(2.0, [0.25, 0.125, 0.5]);
        }
        let step = f64::from_bits((1023 - 16) << 52);
        let stepped = as_stepped(&model, step);
        assert_eq!(stepped, model.convert());
    }

    /// A weight that were added to forces would be rounded alike for as long as they are as large, and work.
    #[test]
    fn falling_in_fixed_point_does_no_work_that_is_not_there() {
        let step = 1e-5_f32.into();
        let model: SceneModel<Fixed> = model(3, Joints::Revolute).unwrap().convert();
        let stepped = as_stepped(&model, step);
        let mut keeper = Keeper::new(&stepped, Kept::KickDriftKick, step).unwrap();
        let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
        let start = keeper.energies(&widen(plant.state())).unwrap().kept;
        let mut most = 0.0_f64;
        for _ in 0..100 {
            plant.advance(500).unwrap();
            let now = keeper.energies(&widen(plant.state())).unwrap().kept;
            most = most.max((now - start).abs());
        }
        assert!(most < 2.5e-7, "{most:e}");
    }
}
