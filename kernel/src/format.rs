//! `defmt::Format` where a derive cannot see the bounds (feature `defmt`).

use core::ops::Deref;

use defmt::{Format, Formatter, write};

use crate::body::{Body, BodyState, Diagonal, Increment};
use crate::elements::load::Load;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::torsion_spring::{TorsionAngle, TorsionSpring};
use crate::forces::Wrench;
use crate::geometry::Geometry;
use crate::model::ModelOwner;
use crate::pass_sum::Sum;
use crate::plant::Plant;
use crate::real::Real as _;
use crate::schemes::Scheme;
use crate::space::{Linear as _, Space, Turn as _};
use crate::state::State;

/// Formats a type of a space by its fields, each with a function that converts it.
macro_rules! of_a_space {
    ($($name:ident, $text:literal: $value:ident => $($shown:expr),+;)*) => {
        $(impl<S: Space> Format for $name<S> {
            fn format(&self, f: Formatter<'_>) {
                let $value = self;
                write!(f, $text, $($shown),+);
            }
        })*
    };
}

of_a_space! {
    Body, "Body {{ mass: {}, inertia: {} }}": body =>
        body.mass.to_f64(), body.inertia.to_f64();
    Increment, "Increment {{ linear: {}, angular: {} }}": increment =>
        increment.linear.to_f64(), increment.angular.to_f64();
    Sum, "Sum {{ linear: {}, angular: {} }}": sum =>
        sum.linear.to_f64(), sum.angular.to_f64();
    Diagonal, "Diagonal {{ mass: {}, inertia: {} }}": diagonal =>
        diagonal.mass.to_f64(), diagonal.inertia.to_f64();
    Wrench, "Wrench {{ force: {}, torque: {} }}": wrench =>
        wrench.force.to_f64(), wrench.torque.to_f64();
    Load, "Load {{ body: {}, frame: {}, force: {}, torque: {}, from: {}, until: {} }}": load =>
        load.body, load.frame, load.force.to_f64(), load.torque.to_f64(), load.from, load.until;
    PointOnLine, "PointOnLine {{ direction: {}, stiffness: {}, free_length: {} }}": line =>
        line.direction.to_f64(), line.stiffness.to_f64(), line.free_length.to_f64();
    TorsionAngle, "Twist {{ angle: {}, gradient: {} }}": torsion_angle =>
        torsion_angle.angle.to_f64(), torsion_angle.gradient.to_f64();
    TorsionSpring,
        "TorsionSpring {{ a: {}, b: {}, axis: {}, reference: {}, stiffness: {}, preload: {}, \
         damper: {} }}": spring =>
        spring.a, spring.b, spring.axis.to_f64(), spring.reference.to_f64(),
        spring.stiffness.to_f64(), spring.preload.to_f64(), spring.damper;
}

impl<P: Geometry> Format for BodyState<P> {
    fn format(&self, f: Formatter<'_>) {
        let (position, orientation, velocity, angular_velocity) = self.to_f64();
        write!(
            f,
            "BodyState {{ position: {}, orientation: {}, velocity: {}, \
             angular_velocity: {} }}",
            position, orientation, velocity, angular_velocity,
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
