//! One rigid body: its constants, and its state in the words that are stored.
//!
//! `mass, inertia => Body`, whose derived constants are rounded once each; `BodyState` is plain
//! data, the only words of a body that hash and snapshot see.

use crate::attitude::Attitude as _;
use crate::geometry::Geometry;
use crate::real::Real;
use crate::vector::Vec3;
use crate::words::{WordSource, WordVisitor, Words};

/// A rigid body: mass, principal inertia and what is derived from them, rounded once each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Body<R> {
    /// \[kg\] mass, > 0.
    pub mass: R,
    /// \[kg·m²\] principal inertia (Ix, Iy, Iz) about the centre of mass, body axes, > 0.
    pub inertia: Vec3<R>,
    /// \[1/kg\] inverse mass.
    pub inverse_mass: R,
    /// \[1/(kg·m²)\] inverse inertia.
    pub inverse_inertia: Vec3<R>,
    /// (Iz/Iy, Ix/Iz, Iy/Ix): how a rotation about x, y, z carries the next axis' rate over.
    pub ratio: Vec3<R>,
    /// (Iy/Iz, Iz/Ix, Ix/Iy).
    pub inverse_ratio: Vec3<R>,
}

impl<R: Real> Body<R> {
    /// A body of mass \[kg\] and principal inertia \[kg·m²\].
    pub fn from_f64(mass: f64, inertia: [f64; 3]) -> Self {
        let [x, y, z] = inertia;
        Self {
            mass: R::from_f64(mass),
            inertia: Vec3::from_f64(inertia),
            inverse_mass: R::from_f64(1.0 / mass),
            inverse_inertia: Vec3::from_f64([1.0 / x, 1.0 / y, 1.0 / z]),
            ratio: Vec3::from_f64([z / y, x / z, y / x]),
            inverse_ratio: Vec3::from_f64([y / z, z / x, x / y]),
        }
    }

    /// The same body in another precision: the stored mass and inertia, all else derived anew.
    pub fn convert<Q: Real>(&self) -> Body<Q> {
        Body::from_f64(self.mass.to_f64(), self.inertia.to_f64())
    }
}

/// The state of one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyState<P: Geometry> {
    /// \[m\] position of the centre of mass, world.
    pub position: P::Position,
    /// Orientation, body → world.
    pub orientation: P::Orientation,
    /// \[m/s\] velocity of the centre of mass, world.
    pub velocity: P::Velocity,
    /// \[rad/s\] angular velocity, body axes.
    pub angular_velocity: P::Velocity,
}

/// A change of velocity \[m/s\] (world) and of angular velocity \[rad/s\] (body axes).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Increment<R> {
    /// \[m/s\] world axes.
    pub linear: Vec3<R>,
    /// \[rad/s\] body axes.
    pub angular: Vec3<R>,
}

impl<P: Geometry> BodyState<P> {
    /// A state rounded once from double precision: position \[m\], unit quaternion (scalar first,
    /// body → world), velocity \[m/s\] (world), angular velocity \[rad/s\] (body axes).
    pub fn from_f64(
        position: [f64; 3],
        orientation: [f64; 4],
        velocity: [f64; 3],
        angular_velocity: [f64; 3],
    ) -> Self {
        Self {
            position: P::position_from_f64(position),
            orientation: P::Orientation::from_f64(orientation),
            velocity: P::velocity_from_f64(velocity),
            angular_velocity: P::velocity_from_f64(angular_velocity),
        }
    }

    /// The same state in another precision.
    pub fn convert<Q: Geometry>(&self) -> BodyState<Q> {
        BodyState::from_f64(
            P::position_to_f64(&self.position),
            P::Orientation::to_f64(&self.orientation),
            P::velocity_to_f64(&self.velocity),
            P::velocity_to_f64(&self.angular_velocity),
        )
    }
}

impl<P: Geometry> Words for BodyState<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.position.visit(visitor);
        self.orientation.visit(visitor);
        self.velocity.visit(visitor);
        self.angular_velocity.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.position.fill(source);
        self.orientation.fill(source);
        self.velocity.fill(source);
        self.angular_velocity.fill(source);
    }
}
