//! `defmt::Format` where a derive cannot see the bounds (feature `defmt`).

use core::ops::Deref;

use defmt::{Format, Formatter, write};

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::geometry::Geometry;
use crate::model::ModelOwner;
use crate::plant::Plant;
use crate::schemes::Scheme;
use crate::state::State;

impl<P: Geometry> Format for BodyState<P> {
    fn format(&self, f: Formatter<'_>) {
        write!(
            f,
            "BodyState {{ position: {}, orientation: {}, velocity: {}, \
             angular_velocity: {} }}",
            P::position_to_f64(&self.position),
            P::Orientation::to_f64(&self.orientation),
            P::velocity_to_f64(&self.velocity),
            P::velocity_to_f64(&self.angular_velocity),
        );
    }
}

impl<M: ModelOwner> Format for State<M> {
    fn format(&self, f: Formatter<'_>) {
        write!(
            f,
            "State {{ bodies: {=[?]}, turns: {=[?]}, step: {=u64} }}",
            self.bodies.as_ref(),
            self.turns.as_ref(),
            self.step,
        );
    }
}

impl<H, S> Format for Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    fn format(&self, f: Formatter<'_>) {
        write!(
            f,
            "Plant {{ scheme: {=str}, step_size: {=f64}, status: {}, state: {} }}",
            S::NAME,
            self.step_size(),
            self.status(),
            self.state(),
        );
    }
}
