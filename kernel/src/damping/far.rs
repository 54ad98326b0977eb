//! A damper along a sum of directions, each between two bodies.
//!
//! `(directions, rates, kick's rates, coefficient, time) => impulse on all bodies`; see [`super::pair`] for two bodies.

use crate::damping::kick::Kick;
use crate::damping::moving::Moving;
use crate::damping::pair::{Damper, Limits};
use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::MAX_BRANCHES;
use crate::model::{ModelRef, Terms};
use crate::real::Real as _;
use crate::space::{Linear as _, Moment as _};

/// A body and its response to a unit impulse along the sum.
#[derive(Clone, Copy)]
pub(crate) struct Held<P: Geometry> {
    pub(crate) row: usize,
    /// World axes.
    pub(crate) along: P::Vector,
    /// Body axes.
    pub(crate) moment: P::Moment,
}

/// The bodies moved by a sum of directions, each once, in order of first occurrence.
pub(crate) struct Far<P: Geometry>([Option<Held<P>>; 2 * (1 + MAX_BRANCHES)]);

impl<P: Geometry> Default for Far<P> {
    #[inline(always)]
    fn default() -> Self {
        Self([None; 2 * (1 + MAX_BRANCHES)])
    }
}

impl<P: Geometry> Far<P> {
    /// Adds a direction between two bodies, B before A; the ground is skipped.
    #[inline(always)]
    pub(crate) fn add(&mut self, bodies: [BodyIndex; 2], direction: &Direction<P::Space>) {
        let Direction { along, moments: [of_a, of_b] } = *direction;
        let [a, b] = bodies;
        for (body, along, moment) in [(b, along, of_b), (a, -along, -of_a)] {
            if !body.is_world() {
                self.hold(Held { row: body.row(), along, moment });
            }
        }
    }

    #[inline(always)]
    fn hold(&mut self, more: Held<P>) {
        for place in &mut self.0 {
            match place {
                Some(held) if held.row == more.row => {
                    held.along = held.along + more.along;
                    held.moment = held.moment + more.moment;
                    return;
                }
                Some(_) => {}
                None => {
                    *place = Some(more);
                    return;
                }
            }
        }
    }

    /// Its bodies.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Held<P>> {
        self.0.iter().flatten()
    }

    /// The damper acts on all bodies at once.
    #[inline(always)]
    pub(super) fn damp<T: Terms<P>, K: Kick<P>>(
        &self,
        model: &ModelRef<'_, P, T>,
        kick: &K,
        (damper, limits): (Damper<P::Real>, Limits<P::Real>),
        moving: &mut Moving<'_, P>,
    ) {
        let [mut inverse, mut rate, mut kicked] = [P::Real::ZERO; 3];
        for Held { row, along, moment } in self.iter() {
            let (Some(body), Some((velocity, spin))) =
                (model.bodies.get(*row), moving.velocities(*row))
            else {
                return;
            };
            let response = moment.scale(body.inverse_inertia);
            inverse = inverse + along.dot(*along) * body.inverse_mass + moment.dot(response);
            rate = rate + along.dot(velocity) + moment.dot(spin);
            if K::KNOWN {
                let Some(kick) = kick.of(*row) else { return };
                kicked = kicked + along.dot(kick.linear) + moment.dot(kick.angular);
            }
        }
        if inverse == P::Real::ZERO {
            return;
        }
        let impulse = damper.impulse(K::KNOWN, [inverse, rate, kicked], limits);
        for Held { row, along, moment } in self.iter() {
            let Some(body) = model.bodies.get(*row) else { return };
            moving.accelerate(*row, *along * -(impulse * body.inverse_mass));
            moving.spin_up(*row, moment.scale(body.inverse_inertia) * -impulse);
        }
    }
}
