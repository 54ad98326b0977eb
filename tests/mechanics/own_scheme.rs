//! A scheme written outside the kernel, with what the kernel offers to schemes.

use dbd_kernel::damping::Damping;
use dbd_kernel::forces::{At, DampersLeft, ExplicitDampers};
use dbd_kernel::keep::NoStorage;
use dbd_kernel::model::Terms;
use dbd_kernel::step::Stepper;
use dbd_kernel::{BodyState, Cause, F64, Geometry, Leapfrog, Plant, Real, Scheme, rotation};
use dbd_scene::SceneModel;
use dbd_tests::scene;

/// Kick–drift–kick, written once more.
#[derive(Clone, Copy)]
struct Verlet;

impl Scheme for Verlet {
    const NAME: &'static str = "verlet";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    type Memory<P: Geometry> = ();
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        1
    }

    fn stability_limit(&self) -> f64 {
        2.0
    }

    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        if !stepper.is_fresh() {
            stepper.evaluate::<DampersLeft>(At::Boundary)?;
        }
        stepper.damped_kick_forward();
        stepper.drift(stepper.step_size());
        stepper.evaluate::<DampersLeft>(At::Boundary)?;
        stepper.damped_kick_reverse();
        Ok(())
    }
}

/// The explicit midpoint rule (Runge 1895): half a step by Euler, then a whole one from the start
/// with the middle's rates.
#[derive(Clone, Copy)]
struct Midpoint;

impl Scheme for Midpoint {
    const NAME: &'static str = "midpoint";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Explicit;
    type Memory<P: Geometry> = BodyState<P>;
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        2
    }

    fn stability_limit(&self) -> f64 {
        0.0
    }

    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, BodyState<P>>,
    ) -> Result<(), Cause> {
        let half = P::Real::HALF;
        stepper.evaluate::<ExplicitDampers>(At::Boundary)?;
        stepper.each(|start, state, increment, h| {
            *start = *state;
            let (v, w) = (P::velocity(&state.velocity), P::spin(&state.angular_velocity));
            P::translate(&mut state.position, v * (half * h));
            rotation::turn_by::<P>(&mut state.orientation, w * (half * half * h));
            P::accelerate(&mut state.velocity, increment.linear * half);
            P::spin_up(&mut state.angular_velocity, increment.angular * half);
        });
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|start, state, increment, h| {
            let (v, w) = (P::velocity(&state.velocity), P::spin(&state.angular_velocity));
            *state = *start;
            P::translate(&mut state.position, v * h);
            rotation::turn_by::<P>(&mut state.orientation, w * (half * h));
            P::accelerate(&mut state.velocity, increment.linear);
            P::spin_up(&mut state.angular_velocity, increment.angular);
        });
        Ok(())
    }
}

#[test]
fn a_scheme_from_outside_has_the_bits_and_the_evaluations_of_the_kernels() {
    // With and without dampers; a fresh evaluation is kept from step to step, and dropped where a
    // load begins or ends.
    for name in ["four-bar", "cart-pendulum", "crank-slider"] {
        let model: SceneModel<F64> = scene(name).model.convert();
        let mut own = Plant::new(&model, Verlet, 1e-4).unwrap();
        let mut shipped = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        own.advance(500).unwrap();
        shipped.advance(500).unwrap();
        assert_eq!(own.hash(), shipped.hash(), "{name}");
        assert_eq!(own.evaluations(), shipped.evaluations(), "{name}");
    }
}

#[test]
fn a_scheme_from_outside_with_memory_converges_with_its_order() {
    let model: SceneModel<F64> = scene("cart-pendulum").model.convert();
    let end = |steps: u32| {
        let mut plant = Plant::new(&model, Midpoint, 0.02 / f64::from(steps)).unwrap();
        plant.advance(u64::from(steps)).unwrap();
        assert_eq!(plant.evaluations(), 2 * u64::from(steps));
        let body = plant.state().bodies[1];
        let [w, x, y, z] = body.orientation.to_f64();
        [body.position.x, body.position.y, w, x, y, z]
    };
    let apart = |a: [f64; 6], b: [f64; 6]| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let [coarse, middle, fine] = [2_048, 4_096, 8_192].map(end);
    let order = (apart(coarse, middle) / apart(middle, fine)).log2();
    assert!((order - 2.0).abs() < 0.1, "{order}");
}
