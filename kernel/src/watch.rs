//! Guards that cost more than a step can bear: a look now and then.
//!
//! `(watch, plant) => status`. A step itself refuses what is not finite, what spins too fast and
//! counters at their ends. [`Watch`] sees a run that leaves the range its step was chosen for:
//! mounts that vibrate faster than at the start, for an element is compressed or under tension far
//! beyond what it was, and energy beyond a limit. Each look takes the mounts of one body in turn; only
//! placing the bodies, and the energy where it is asked for, go through the whole model.

use core::ops::Deref;

use crate::body::BodyState;
use crate::energy::energy;
use crate::frequency::{bound, square_of};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelOwner, RealOf};
use crate::plant::Plant;
use crate::real::Real;
use crate::schemes::Scheme;
use crate::space::{Linear as _, Moment as _};
use crate::status::{Cause, Status};

/// How far the bound of a frequency may grow beyond what the scheme bears or, where it was beyond
/// at the start, beyond that.
const GROWTH: f64 = 1.2;

/// Looks at a plant from time to time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Watch<R> {
    /// The body that the next look takes.
    next: usize,
    /// \[rad²/s²\] the square of the frequency that is refused.
    square: R,
    /// \[J\] the energy that is refused.
    energy: Option<R>,
}

impl<R: Real> Watch<R> {
    /// A watch over a plant as it is now: it refuses frequencies by [`crate::frequency::bound`] whose
    /// ω·h is beyond 1.2 times the scheme's limit, or what the bound is now, by 1.2.
    pub fn new<H, S>(plant: &Plant<H, S>) -> Self
    where
        H: Deref<Target: ModelOwner<Precision: Geometry<Real = R>> + Sized>,
        S: Scheme,
    {
        let now = bound(plant.model(), plant.state());
        let most = R::from_f64(plant.scheme().stability_limit() / plant.step_size());
        let most = if now > most { now } else { most } * R::from_f64(GROWTH);
        Self { next: 0, square: most * most, energy: None }
    }

    /// Also refuses a total energy above `most` \[J\].
    #[must_use]
    pub fn with_energy(self, most: R) -> Self {
        Self { energy: Some(most), ..self }
    }

    /// Looks at the next body's mounts and, where it was asked to, at the energy. A plant that is
    /// refused has failed: it steps no more until it is cleared, reset or restored.
    pub fn look<H, S>(&mut self, plant: &mut Plant<H, S>) -> Status
    where
        H: Deref<Target: ModelOwner<Precision: Geometry<Real = R>> + Sized>,
        S: Scheme,
    {
        if !plant.status().is_running() {
            return plant.status();
        }
        let row = self.next;
        let square = plant.with_places(|view, places, state| {
            square_of(view, places, state.bodies.as_ref(), (state.turns.as_ref(), &state.laws), row)
        });
        let count = plant.state().bodies.as_ref().len();
        self.next = if row + 1 < count { row + 1 } else { 0 };
        // What is not a number is not calm either.
        let calm = square <= self.square;
        if !calm {
            return plant.fail(Cause::Frequency { body: BodyIndex(row as u16) });
        }
        if let Some(most) = self.energy {
            let total = energy(plant.model(), plant.state(), plant.step_size()).total();
            let calm = total <= most;
            if !calm {
                return plant.fail(Cause::Energy { body: fastest(plant) });
            }
        }
        plant.status()
    }
}

/// The body with the most kinetic energy.
fn fastest<H, S>(plant: &Plant<H, S>) -> BodyIndex
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    let bodies = plant.model().view().bodies;
    let mut most = (0, RealOf::<H::Target>::ZERO);
    for (row, (state, body)) in plant.state().bodies.as_ref().iter().zip(bodies).enumerate() {
        let BodyState { velocity, angular_velocity, .. } = state;
        let v = <H::Target as ModelOwner>::Precision::velocity(velocity);
        let w = <H::Target as ModelOwner>::Precision::spin(angular_velocity);
        let twice = body.mass * v.dot(v) + w.dot(body.inertia.scale(w));
        if twice > most.1 {
            most = (row, twice);
        }
    }
    BodyIndex(most.0 as u16)
}
