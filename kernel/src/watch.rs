//! Guards that are too expensive for every step: periodic checks.
//!
//! `(watch, plant) => status`. A step itself refuses values that are not finite, too fast rotation and counter
//! overflow. [`Watch`] detects a run that leaves the range its step was chosen for: mounts whose natural frequency
//! exceeds that at the start, because an element is compressed or under tension far beyond its initial state, and
//! energy beyond a limit. Each check covers the mounts of one body in turn; only computing the frames, and the energy
//! if requested, visit the whole model.

use core::ops::Deref;

use crate::body::BodyState;
use crate::energy::energy;
use crate::frequency::{bound, square_of};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelOwner, RealOf, Terms};
use crate::plant::Plant;
use crate::real::Real;
use crate::schemes::Scheme;
use crate::space::{Linear as _, Moment as _};
use crate::status::{Cause, Failure};

/// The factor by which the frequency bound may exceed the scheme's limit or, where it was above that at the start, its
/// initial value.
const GROWTH: f64 = 1.2;

/// Checks a plant periodically.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Watch<R> {
    /// The body of the next check.
    next: usize,
    /// \[rad²/s²\] the square of the limit frequency.
    square: R,
    /// \[J\] the limit of the energy.
    energy: Option<R>,
}

impl<R: Real> Watch<R> {
    /// A watch over a plant in its present state: it refuses frequencies by [`crate::frequency::bound`] whose ω·h
    /// exceeds 1.2 times the larger of the scheme's limit and the present bound.
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

    /// Checks the next body's mounts and, if requested, the energy. A plant that fails the check is not stepped until
    /// it is cleared, reset or restored.
    ///
    /// # Errors
    /// The latched failure of the plant.
    pub fn look<H, S>(&mut self, plant: &mut Plant<H, S>) -> Result<(), Failure>
    where
        H: Deref<Target: ModelOwner<Precision: Geometry<Real = R>> + Sized>,
        S: Scheme,
    {
        plant.status()?;
        let row = self.next;
        let square = plant.with_places(|view, places, state| {
            square_of(view, places, state.bodies.as_ref(), (state.turns.as_ref(), &state.laws), row)
        });
        let count = plant.state().bodies.as_ref().len();
        self.next = if row + 1 < count { row + 1 } else { 0 };
        // NaN fails the check, too.
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
        if <H::Target as ModelOwner>::Terms::DRIVEN && body.is_driven() {
            continue;
        }
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
