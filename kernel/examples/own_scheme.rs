//! A scheme of one's own, half a drift, a kick, half a drift: `cargo run --example own_scheme`.

use dbd_kernel::keep::NoStorage;
use dbd_kernel::model::Terms;
use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
use dbd_kernel::step::{At, Damping, ExplicitDampers, Stepper};
use dbd_kernel::{BodyIndex, Cause, Failure, Geometry, Plant, Real as _, Scheme, model};

/// Position Verlet (Tuckerman, Berne & Martyna, J. Chem. Phys. 97, 1992): symplectic, order 2, one evaluation.
#[derive(Clone, Copy)]
pub struct PositionVerlet;

impl Scheme for PositionVerlet {
    const NAME: &'static str = "position-verlet";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 1;
    const DAMPING: Damping = Damping::Explicit;
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
        let half = stepper.step_size() * P::Real::HALF;
        stepper.drift(half);
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.kick(P::Real::ONE);
        stepper.drift(half);
        Ok(())
    }
}

// A mass of 2 kg on a spring of 50 N/m, 0.1 m beyond its free length of 1 m.
const SPRING: Spring = Spring { stiffness: 50.0, damping: 0.0, free_length: 1.0 };
const MODEL_SPEC: ModelSpec = ModelSpec::new()
    .body(2.0, [0.1; 3], Start::at([1.1, 0.0, 0.0]))
    .tsda([BodyIndex::WORLD, BodyIndex(0)], [[0.0; 3]; 2], SPRING);
model!(static OSCILLATOR: F64 = MODEL_SPEC);

/// How far \[m\] it is from 1 + 0.1·cos(5 rad/s · t) after 1 s in so many steps.
pub fn error(steps: u32) -> Result<f64, Failure> {
    let plant = Plant::new(&OSCILLATOR, PositionVerlet, 1.0 / f64::from(steps));
    let Ok(mut plant) = plant else { unreachable!("the model is checked by the compiler") };
    plant.advance(u64::from(steps))?;
    Ok((plant.state().bodies[0].position.x - 1.0 - 0.1 * 5.0_f64.cos()).abs())
}

fn main() -> Result<(), Failure> {
    let [coarse, fine] = [error(100)?, error(200)?];
    println!(
        "off by {coarse:.1e} m, in half the step {fine:.1e} m: order {:.2}",
        (coarse / fine).log2()
    );
    Ok(())
}
