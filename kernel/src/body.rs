//! One rigid body: its constants, and its state in the words that are stored.
//!
//! `mass, inertia => Body`, whose derived constants are rounded once each; `BodyState` is plain data, the only data of
//! a body in hashes and snapshots.

use crate::attitude::Attitude as _;
use crate::fixed::{Fixed, FixedPlace, FixedTurn, FixedVelocity};
use crate::geometry::{F32, F64, Geometry};
use crate::planar::{Planar32, Planar64};
use crate::plane::{Axial, Heading, Plane, Vec2};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space};
use crate::vector::{Quaternion, Vec3};
use crate::words::{WordSource, WordVisitor, Words};

/// A rigid body: mass, principal inertia and what is derived from them, rounded once each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body<S: Space> {
    /// \[kg\] mass, > 0.
    pub mass: S::Real,
    /// \[kg·m²\] principal inertia (Ix, Iy, Iz) about the centre of mass, body axes, > 0.
    pub inertia: S::Moment,
    /// \[1/kg\] inverse mass; 0 of a driven body, see [`Self::driven`].
    pub inverse_mass: S::Real,
    /// \[1/(kg·m²)\] inverse inertia.
    pub inverse_inertia: S::Moment,
    /// \[1\] (Iz/Iy, Ix/Iz, Iy/Ix): factors of the gyroscopic coupling between the axes' rates.
    pub ratio: S::Moment,
    /// \[1\] (Iy/Iz, Iz/Ix, Ix/Iy).
    pub inverse_ratio: S::Moment,
}

impl<S: Space> Body<S> {
    /// A body of mass \[kg\] and principal inertia \[kg·m²\]. In a constant: `Body::<f64>::new`.
    pub fn from_f64(mass: f64, inertia: [f64; 3]) -> Self {
        let [x, y, z] = inertia;
        Self {
            mass: S::Real::from_f64(mass),
            inertia: S::Moment::from_f64(inertia),
            inverse_mass: S::Real::from_f64(1.0 / mass),
            inverse_inertia: S::Moment::from_f64([1.0 / x, 1.0 / y, 1.0 / z]),
            ratio: S::Moment::from_f64([z / y, x / z, y / x]),
            inverse_ratio: S::Moment::from_f64([y / z, z / x, x / y]),
        }
    }

    /// The same body in another precision: the stored mass and inertia are converted, the rest is derived again.
    pub fn convert<Q: Space>(&self) -> Body<Q> {
        let body = Body::from_f64(self.mass.to_f64(), self.inertia.to_f64());
        if self.is_driven() { body.driven() } else { body }
    }

    /// The same body as a driven one, which inputs move and no force: of infinite mass and inertia. Its mass and inertia
    /// are kept and act nowhere.
    #[must_use]
    pub fn driven(self) -> Self {
        Self { inverse_mass: S::Real::ZERO, inverse_inertia: S::Moment::ZERO, ..self }
    }

    /// Whether it is [driven](Self::driven), unlike a body whose mass overflows. Lanes have no driven bodies.
    #[inline(always)]
    #[must_use]
    pub fn is_driven(&self) -> bool {
        S::Real::ONE_LANE && self.inverse_mass == S::Real::ZERO && self.mass.is_finite()
    }
}

/// A change of velocity \[m/s\] (world) and of angular velocity \[rad/s\] (body axes).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Increment<S: Space> {
    /// \[m/s\] world axes.
    pub linear: S::Vector,
    /// \[rad/s\] body axes.
    pub angular: S::Moment,
}

/// ½·h·D⁻¹ of one body: half the step over its mass and its principal inertias. Most kicks are half kicks and then need
/// no further factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Diagonal<S: Space> {
    /// \[s/kg\].
    pub mass: S::Real,
    /// \[s/(kg·m²)\].
    pub inertia: S::Moment,
}

impl<S: Space> Diagonal<S> {
    /// The diagonal of a body for the step `h` \[s\]: one division each.
    pub fn new(body: &Body<S>, h: S::Real) -> Self {
        let half = S::Real::HALF;
        Self { mass: half * (h / body.mass), inertia: body.inertia.under(h) * half }
    }

    /// `scale·(h·D⁻¹)·Q` of a force (world) and a torque (body axes), without the gyroscopic term.
    #[inline(always)]
    pub(crate) fn increment(
        &self,
        force: S::Vector,
        torque: S::Moment,
        scale: S::Real,
    ) -> Increment<S> {
        let halves = S::Real::TWO * scale;
        Increment {
            linear: force * (halves * self.mass),
            angular: torque.scale(self.inertia * halves),
        }
    }

    /// [`Self::increment`] with the change of velocity by gravity.
    #[inline(always)]
    pub(crate) fn kick(
        &self,
        (force, torque): (S::Vector, S::Moment),
        scale: S::Real,
        fall: Fall<S::Vector>,
    ) -> Increment<S> {
        let mut kick = self.increment(force, torque, scale);
        if let Some(change) = fall.of(self) {
            kick.linear = kick.linear + change;
        }
        kick
    }
}

/// The change of velocity by gravity in part of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fall<V> {
    /// \[m/s\], `None` where weights are part of the wrenches.
    pub(crate) change: Option<V>,
    /// Whether the model may have driven bodies.
    pub(crate) driven: bool,
}

impl<V> Fall<V> {
    /// \[m/s\] that of a body: none of a driven one, whose diagonal is 0.
    #[inline(always)]
    pub(crate) fn of<S: Space<Vector = V>>(self, diagonal: &Diagonal<S>) -> Option<V> {
        if self.driven && diagonal.mass == S::Real::ZERO { None } else { self.change }
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
    pub angular_velocity: P::Spin,
}

impl<P: Geometry> BodyState<P> {
    /// A state rounded once from double precision: position \[m\], unit quaternion (scalar first,
    /// body → world), velocity \[m/s\] (world), angular velocity \[rad/s\] (body axes). In a
    /// constant: `BodyState::<F64>::new`.
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
            angular_velocity: P::spin_from_f64(angular_velocity),
        }
    }

    /// Position \[m\], unit quaternion (scalar first, body → world), velocity \[m/s\] (world), angular velocity \[rad/s\]
    /// (body axes), in double precision.
    pub fn to_f64(&self) -> ([f64; 3], [f64; 4], [f64; 3], [f64; 3]) {
        (
            P::position_to_f64(&self.position),
            self.orientation.to_f64(),
            P::velocity_to_f64(&self.velocity),
            P::spin_to_f64(&self.angular_velocity),
        )
    }

    /// The same state in another precision.
    pub fn convert<Q: Geometry>(&self) -> BodyState<Q> {
        let (position, orientation, velocity, angular_velocity) = self.to_f64();
        BodyState::from_f64(position, orientation, velocity, angular_velocity)
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

/// Constructors for constants: a generic function cannot be called in a `const`.
macro_rules! constants {
    ($real:ident, $space:ty, $precision:ident) => {
        constants!(@ $real, $space, $precision,
            vector [x y _z] Vec2::new(x as $real, y as $real),
            moment [_x _y z] Axial::new(z as $real),
            turn [w _i _j k] Heading::new(w as $real, k as $real));
    };
    ($real:ident, $precision:ident) => {
        constants!(@ $real, $real, $precision,
            vector [x y z] Vec3::new(x as $real, y as $real, z as $real),
            moment [x y z] Vec3::new(x as $real, y as $real, z as $real),
            turn [w i j k] Quaternion::new(w as $real, i as $real, j as $real, k as $real));
    };
    (@ $real:ident, $space:ty, $precision:ident,
        vector [$($v:ident)*] $vector:expr,
        moment [$($m:ident)*] $moment:expr,
        turn [$($t:ident)*] $turn:expr) => {
        impl Body<$space> {
            /// [`Self::from_f64`] in a constant, with the same bits.
            #[must_use]
            pub const fn new(mass: f64, inertia: [f64; 3]) -> Self {
                const fn moment([$($m),*]: [f64; 3]) -> <$space as Space>::Moment {
                    $moment
                }
                let [x, y, z] = inertia;
                Self {
                    mass: mass as $real,
                    inertia: moment(inertia),
                    inverse_mass: (1.0 / mass) as $real,
                    inverse_inertia: moment([1.0 / x, 1.0 / y, 1.0 / z]),
                    ratio: moment([z / y, x / z, y / x]),
                    inverse_ratio: moment([y / z, z / x, x / y]),
                }
            }
        }

        impl BodyState<$precision> {
            /// [`Self::from_f64`] in a constant, with the same bits.
            #[must_use]
            pub const fn new(
                position: [f64; 3],
                orientation: [f64; 4],
                velocity: [f64; 3],
                angular_velocity: [f64; 3],
            ) -> Self {
                const fn vector([$($v),*]: [f64; 3]) -> <$space as Space>::Vector {
                    $vector
                }
                const fn moment([$($m),*]: [f64; 3]) -> <$space as Space>::Moment {
                    $moment
                }
                const fn turn([$($t),*]: [f64; 4]) -> <$space as Space>::Turn {
                    $turn
                }
                Self {
                    position: vector(position),
                    orientation: turn(orientation),
                    velocity: vector(velocity),
                    angular_velocity: moment(angular_velocity),
                }
            }
        }
    };
}

impl BodyState<Fixed> {
    /// [`Self::from_f64`] in a constant, with the same bits.
    #[must_use]
    pub const fn new(
        position: [f64; 3],
        orientation: [f64; 4],
        velocity: [f64; 3],
        angular_velocity: [f64; 3],
    ) -> Self {
        Self {
            position: FixedPlace::new(position),
            orientation: FixedTurn::new(orientation),
            velocity: FixedVelocity::from_f64(velocity),
            angular_velocity: FixedVelocity::from_f64(angular_velocity),
        }
    }
}

constants!(f64, F64);
constants!(f32, F32);
constants!(f64, Plane<f64>, Planar64);
constants!(f32, Plane<f32>, Planar32);

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the constants of a precision with the results of the generic function.
    macro_rules! same_bits {
        ($space:ty, $precision:ident) => {{
            const INERTIA: [f64; 3] = [0.08333, 0.00083, 0.1];
            const BODY: Body<$space> = Body::<$space>::new(0.3, INERTIA);
            const STATE: BodyState<$precision> = BodyState::<$precision>::new(
                [0.1, -0.2, 1e-9],
                [0.8, 0.0, 0.6, 0.0],
                [1.0 / 3.0, 2.0, -0.7],
                [0.3, 1e10, -1.1],
            );
            assert_eq!(BODY, Body::from_f64(0.3, INERTIA));
            let state = BodyState::<$precision>::from_f64(
                [0.1, -0.2, 1e-9],
                [0.8, 0.0, 0.6, 0.0],
                [1.0 / 3.0, 2.0, -0.7],
                [0.3, 1e10, -1.1],
            );
            assert_eq!(STATE, state);
        }};
    }

    #[test]
    fn constants_have_the_bits_of_what_is_made_at_run_time() {
        same_bits!(f64, F64);
        same_bits!(f32, F32);
        same_bits!(Plane<f64>, Planar64);
        same_bits!(Plane<f32>, Planar32);
    }
}
