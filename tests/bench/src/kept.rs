//! The energy that a scheme keeps: what is left of its change is rounding.
//!
//! `(model, scheme, step, state) => J`. An energy swings with a motion as the scheme's order says, in any
//! precision. The scheme's own energy does not: of kick–drift–kick it is
//! `H + h²/12·d²V/dt² − h²/24·F·M⁻¹·F`, the first derivative along a free motion, and what is left is of order
//! h⁴ (Hairer, Lubich & Wanner 2006, IX.3). Semi-implicit Euler is the same half a kick later. Everything here
//! is in double precision. For models without dampers, loads and tables.

use dbd_kernel::damping::Damping;
use dbd_kernel::energy::energy;
use dbd_kernel::forces::{At, DampersLeft};
use dbd_kernel::keep::NoStorage;
use dbd_kernel::model::Terms;
use dbd_kernel::plant::{Plant, PlantError};
use dbd_kernel::step::Stepper;
use dbd_kernel::{BodyState, Cause, F64, Geometry, Real, Scheme, State};
use dbd_scene::SceneModel;

/// What the energy that a scheme keeps is computed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// Of kick–drift–kick, at the state at which a step ends.
    KickDriftKick,
    /// Of kick–drift, at the state at which a step ends.
    KickDrift,
    /// The energy itself: of a scheme of fourth order, or where dampers take it.
    Energy,
}

/// Computes the energy that a scheme keeps.
pub struct Keeper<'m> {
    model: &'m SceneModel<F64>,
    kept: Kept,
    kick: Plant<&'m SceneModel<F64>, HalfKick>,
    flights: [Plant<&'m SceneModel<F64>, Flight>; 2],
}

/// Energies of a state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// \[J\] kinetic and potential energy, of kick–drift in the middle of its kick, where velocities are
    /// those of the positions.
    pub own: f64,
    /// \[J\] the energy that the scheme keeps.
    pub kept: f64,
}

impl<'m> Keeper<'m> {
    /// For a model and a step \[s\].
    ///
    /// # Errors
    /// Where the step is not positive and finite.
    pub fn new(model: &'m SceneModel<F64>, kept: Kept, step: f64) -> Result<Self, PlantError> {
        let flight = |direction| Plant::new(model, Flight(direction), step);
        Ok(Self {
            model,
            kept,
            kick: Plant::new(model, HalfKick, step)?,
            flights: [flight(1)?, flight(-1)?],
        })
    }

    /// The energies of a state; `None` where it is none that a plant takes.
    pub fn energies(&mut self, state: &State<SceneModel<F64>>) -> Option<Energies> {
        let (model, h) = (self.model, self.kick.step_size());
        if self.kept == Kept::Energy {
            let own = energy(model, state, h).total();
            return Some(Energies { own, kept: own });
        }
        let mut start = state.clone();
        start.step = 0;
        self.kick.set_state(start.clone()).ok()?;
        self.kick.step().ok()?;
        let kicked = self.kick.state();
        // h²/4·F·M⁻¹·F: the half kick is h/2·M⁻¹·F.
        let rows = model.bodies.iter().zip(&start.bodies).zip(&kicked.bodies);
        let force: f64 = rows
            .map(|((body, before), after)| {
                let BodyState { velocity, angular_velocity, .. } = after;
                let v = *velocity - before.velocity;
                let w = *angular_velocity - before.angular_velocity;
                body.mass * v.dot(v) + w.dot(body.inertia.scale(w))
            })
            .sum();
        if self.kept == Kept::KickDrift {
            start.bodies.clone_from(&kicked.bodies);
        }
        let now = energy(model, &start, h);
        let mut bend = -2.0 * now.potential();
        for flight in &mut self.flights {
            flight.set_state(start.clone()).ok()?;
            flight.step().ok()?;
            bend += energy(model, flight.state(), h).potential();
        }
        let own = now.total();
        Some(Energies { own, kept: own + bend / 12.0 - force / 6.0 })
    }
}

/// Half a kick and nothing else.
#[derive(Clone, Copy)]
struct HalfKick;

/// A free motion by a step, forth or back, and nothing else.
#[derive(Clone, Copy)]
struct Flight(i32);

macro_rules! part_of_a_step {
    ($part:ident, $name:literal, $stepper:ident, $scheme:ident => $body:expr) => {
        impl Scheme for $part {
            const NAME: &'static str = $name;
            const ORDER: u32 = 0;
            const ORDER_DAMPED: u32 = 0;
            const DAMPING: Damping = Damping::Explicit;
            type Memory<P: Geometry> = ();
            type Storage = NoStorage;

            fn evaluations(&self) -> u32 {
                1
            }

            fn stability_limit(&self) -> f64 {
                0.0
            }

            fn step<P: Geometry, T: Terms<P>>(
                &self,
                $stepper: &mut Stepper<'_, '_, P, T, ()>,
            ) -> Result<(), Cause> {
                let $scheme = self;
                $body;
                Ok(())
            }
        }
    };
}

part_of_a_step!(HalfKick, "half-kick", stepper, _scheme => {
    stepper.evaluate::<DampersLeft>(At::Boundary)?;
    stepper.kick(P::Real::HALF);
});
part_of_a_step!(Flight, "flight", stepper, scheme => {
    stepper.drift_of_order_four(stepper.step_size() * P::Real::from_i32(scheme.0));
});

#[cfg(test)]
mod tests {
    use dbd_kernel::{Leapfrog, SemiImplicitEuler};

    use super::*;
    use crate::chain::{Joints, model};

    /// The largest changes of both energies over a swing of a chain, with a step \[s\].
    fn changes<S: Scheme>(scheme: S, kept: Kept, step: f64) -> [f64; 2] {
        let model = model(3, Joints::Revolute).unwrap();
        let mut plant = Plant::new(&model, scheme, step).unwrap();
        let mut keeper = Keeper::new(&model, kept, step).unwrap();
        let start = keeper.energies(plant.state()).unwrap();
        let mut most = [0.0_f64; 2];
        for _ in 0..200 {
            plant.advance((1e-3 / step).round() as u64).unwrap();
            let now = keeper.energies(plant.state()).unwrap();
            most[0] = most[0].max((now.own - start.own).abs());
            most[1] = most[1].max((now.kept - start.kept).abs());
        }
        most
    }

    #[test]
    fn what_a_scheme_keeps_changes_by_the_fourth_power_of_the_step() {
        for (coarse, fine) in [
            (
                changes(Leapfrog, Kept::KickDriftKick, 2e-5),
                changes(Leapfrog, Kept::KickDriftKick, 1e-5),
            ),
            (
                changes(SemiImplicitEuler, Kept::KickDrift, 2e-5),
                changes(SemiImplicitEuler, Kept::KickDrift, 1e-5),
            ),
        ] {
            let [own, kept] = [coarse[0] / fine[0], coarse[1] / fine[1]];
            assert!((3.0..6.0).contains(&own), "{coarse:?} {fine:?}");
            assert!((10.0..24.0).contains(&kept), "{coarse:?} {fine:?}");
            assert!(100.0 * coarse[1] < coarse[0], "{coarse:?}");
        }
    }
}
