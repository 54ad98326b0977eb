//! Numbers as their bit patterns, so that the compiler reads the bits that the assembly computed.
//!
//! `number, vector, moment, rotation => expression`, in the types of the space.

use dbd_kernel::fixed::{FixedPlace, FixedPoint, FixedTurn, FixedVelocity};
use dbd_kernel::geometry::Float;
use dbd_kernel::lanes::Named;
use dbd_kernel::planar::Planar;
use dbd_kernel::plane::{Axial, Heading, Vec2};
use dbd_kernel::space::Space;
use dbd_kernel::{Fixed, Geometry, Quaternion, Real, Vec3};

/// A number that can be written as source, and its precision.
pub trait SourceNumber: Real + Named {
    /// The precision's type in the kernel.
    const TYPE: &'static str;
    /// The number's expression.
    fn number(self) -> String;
}

impl SourceNumber for f64 {
    const TYPE: &'static str = "F64";
    fn number(self) -> String {
        format!("f64::from_bits({:#018x})", self.to_bits())
    }
}

impl SourceNumber for f32 {
    const TYPE: &'static str = "F32";
    fn number(self) -> String {
        format!("f32::from_bits({:#010x})", self.to_bits())
    }
}

/// A precision in a space, whose constants can be written as source.
pub(super) trait SourceGeometry: Geometry<Real: SourceNumber> {
    /// Suffix of types; upper case for constants, lower case for functions.
    const SUFFIX: &'static str;
    /// Its type in the kernel.
    fn name() -> String;
    /// A stored position's expression.
    fn stored_position(position: &Self::Position) -> String;
    /// A stored velocity's expression.
    fn stored_velocity(velocity: &Self::Velocity) -> String;
    /// A stored angular velocity's expression.
    fn stored_spin(spin: &Self::Spin) -> String;
    /// A vector's expression.
    fn vector(v: &Self::Vector) -> String;
    /// A moment's expression.
    fn moment(m: &Self::Moment) -> String;
    /// A rotation's expression.
    fn turn(turn: &<Self::Space as Space>::Turn) -> String;
    /// An orientation's expression.
    fn orientation(orientation: &Self::Orientation) -> String;
    /// A point's expression.
    fn local(point: &Self::Local) -> String;
}

impl<R: SourceNumber> SourceGeometry for Float<R> {
    const SUFFIX: &'static str = R::TYPE;

    fn name() -> String {
        R::TYPE.into()
    }
    fn stored_position(position: &Vec3<R>) -> String {
        Self::vector(position)
    }
    fn stored_velocity(velocity: &Vec3<R>) -> String {
        Self::vector(velocity)
    }
    fn stored_spin(spin: &Vec3<R>) -> String {
        Self::vector(spin)
    }
    fn vector(v: &Vec3<R>) -> String {
        format!("Vec3::new({}, {}, {})", v.x.number(), v.y.number(), v.z.number())
    }
    fn moment(m: &Vec3<R>) -> String {
        Self::vector(m)
    }
    fn turn(q: &Quaternion<R>) -> String {
        let [w, x, y, z] = [q.w, q.v.x, q.v.y, q.v.z].map(R::number);
        format!("Quaternion::new({w}, {x}, {y}, {z})")
    }
    fn orientation(q: &Quaternion<R>) -> String {
        Self::turn(q)
    }
    fn local(point: &Vec3<R>) -> String {
        Self::vector(point)
    }
}

impl<R: SourceNumber> SourceGeometry for Planar<R> {
    const SUFFIX: &'static str = R::TYPE;

    fn name() -> String {
        R::TYPE.replace('F', "Planar")
    }
    fn stored_position(position: &Vec2<R>) -> String {
        Self::vector(position)
    }
    fn stored_velocity(velocity: &Vec2<R>) -> String {
        Self::vector(velocity)
    }
    fn stored_spin(spin: &Axial<R>) -> String {
        Self::moment(spin)
    }
    fn vector(v: &Vec2<R>) -> String {
        format!("Vec2::new({}, {})", v.x.number(), v.y.number())
    }
    fn moment(m: &Axial<R>) -> String {
        format!("Axial::new({})", m.z.number())
    }
    fn turn(heading: &Heading<R>) -> String {
        format!("Heading::new({}, {})", heading.w.number(), heading.z.number())
    }
    fn orientation(heading: &Heading<R>) -> String {
        Self::turn(heading)
    }
    fn local(point: &Vec2<R>) -> String {
        Self::vector(point)
    }
}

type Single = Float<f32>;

impl SourceGeometry for Fixed {
    const SUFFIX: &'static str = "Fixed";

    fn name() -> String {
        "dbd_kernel::generated::Fixed".into()
    }
    fn stored_position(position: &FixedPlace) -> String {
        format!("dbd_kernel::generated::FixedPlace {{ at: {:?} }}", position.at)
    }
    fn stored_velocity(velocity: &FixedVelocity) -> String {
        let [sum, lost] = [velocity.sum, velocity.lost].map(|v| Single::vector(&v));
        format!("dbd_kernel::generated::FixedVelocity {{ sum: {sum}, lost: {lost} }}")
    }
    fn stored_spin(spin: &FixedVelocity) -> String {
        Self::stored_velocity(spin)
    }
    fn vector(v: &Vec3<f32>) -> String {
        Single::vector(v)
    }
    fn moment(m: &Vec3<f32>) -> String {
        Single::vector(m)
    }
    fn turn(q: &Quaternion<f32>) -> String {
        Single::turn(q)
    }
    fn orientation(turn: &FixedTurn) -> String {
        format!("dbd_kernel::generated::FixedTurn::from_words({}, {:?})", turn.w, turn.v)
    }
    fn local(point: &FixedPoint) -> String {
        format!("dbd_kernel::generated::FixedPoint {{ at: {:?} }}", point.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_their_bits() {
        assert_eq!(1.0_f32.number(), "f32::from_bits(0x3f800000)");
        assert_eq!((-2.5_f64).number(), "f64::from_bits(0xc004000000000000)");
    }
}
