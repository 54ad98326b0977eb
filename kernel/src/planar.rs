//! Planar precisions: models in the plane z = 0, with three degrees of freedom per body.
//!
//! `model and state of z = 0 => two thirds of the words, a third of the arithmetic`. Values in double precision have
//! three components, as in space; those off the plane are taken as zero. A model is planar where centres, points and
//! forces are in z = 0, a principal axis of every body is along z, and rotations and moments are about z: then the
//! motion is that of space, to rounding.

use core::marker::PhantomData;

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::lanes::Named;
use crate::plane::{Axial, Heading, Plane, Vec2};
use crate::real::Real;
use crate::space::Linear as _;

/// Floating-point geometry of the plane: everything is stored in the `Real` itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Planar<R>(PhantomData<R>);

/// Double precision in the plane.
pub type Planar64 = Planar<f64>;
/// Single precision in the plane.
pub type Planar32 = Planar<f32>;

/// The pose of a body in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct PlanarPose<R> {
    position: Vec2<R>,
    cosine: R,
    sine: R,
}

impl<R: Real + Named> Vec2<R> {
    #[inline(always)]
    fn abreast(of: impl Fn(usize) -> Self) -> Vec2<R::Abreast> {
        Vec2::new(R::abreast(|lane| of(lane).x), R::abreast(|lane| of(lane).y))
    }

    #[inline(always)]
    fn lane(of: Vec2<R::Abreast>, lane: usize) -> Self {
        Self::new(R::lane(of.x, lane), R::lane(of.y, lane))
    }
}

impl<R: Real + Named> Geometry for Planar<R> {
    type Real = R;
    type Vector = Vec2<R>;
    type Moment = Axial<R>;
    type Space = Plane<R>;
    type Position = Vec2<R>;
    type Orientation = Heading<R>;
    type Velocity = Vec2<R>;
    type Spin = Axial<R>;
    type Local = Vec2<R>;
    type Location = Vec2<R>;
    type Frame = PlanarPose<R>;
    type Rest = ();
    type Apart = ();
    type PassSum = R::PassSum<Plane<R>>;
    type Abreast = Planar<R::Abreast>;

    const NAME: &'static str = R::NAME;

    #[inline(always)]
    fn frames_abreast(of: impl Fn(usize) -> PlanarPose<R>) -> PlanarPose<R::Abreast> {
        PlanarPose {
            position: Vec2::abreast(|lane| of(lane).position),
            cosine: R::abreast(|lane| of(lane).cosine),
            sine: R::abreast(|lane| of(lane).sine),
        }
    }
    #[inline(always)]
    fn points_abreast(of: impl Fn(usize) -> Vec2<R>) -> Vec2<R::Abreast> {
        Vec2::abreast(of)
    }
    #[inline(always)]
    fn numbers_abreast(of: impl Fn(usize) -> R) -> R::Abreast {
        R::abreast(of)
    }
    #[inline(always)]
    fn force_pair_of(pairs: &ForcePair<Plane<R::Abreast>>, lane: usize) -> ForcePair<Plane<R>> {
        ForcePair {
            force: Vec2::lane(pairs.force, lane),
            torque_a: Axial::new(R::lane(pairs.torque_a.z, lane)),
            torque_b: Axial::new(R::lane(pairs.torque_b.z, lane)),
        }
    }

    #[inline(always)]
    fn frame(position: &Vec2<R>, orientation: &Heading<R>) -> PlanarPose<R> {
        let (cosine, sine) = orientation.cosine_and_sine();
        PlanarPose { position: *position, cosine, sine }
    }
    #[inline(always)]
    fn place(frame: &PlanarPose<R>, local: &Vec2<R>) -> (Vec2<R>, Vec2<R>) {
        let arm = Self::to_world(frame, *local);
        (frame.position + arm, arm)
    }
    #[inline(always)]
    fn ground(local: &Vec2<R>) -> Vec2<R> {
        *local
    }
    #[inline(always)]
    fn shift(location: &Vec2<R>, by: Vec2<R>) -> Vec2<R> {
        *location + by
    }
    #[inline(always)]
    fn displacement(from: &Vec2<R>, to: &Vec2<R>) -> Vec2<R> {
        *to - *from
    }
    #[inline(always)]
    fn to_world(frame: &PlanarPose<R>, v: Vec2<R>) -> Vec2<R> {
        let PlanarPose { cosine, sine, .. } = *frame;
        Vec2::new(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y)
    }
    #[inline(always)]
    fn to_body(frame: &PlanarPose<R>, v: Vec2<R>) -> Vec2<R> {
        let PlanarPose { cosine, sine, .. } = *frame;
        Vec2::new(cosine * v.x + sine * v.y, cosine * v.y - sine * v.x)
    }
    #[inline(always)]
    fn moment_to_world(_: &PlanarPose<R>, m: Axial<R>) -> Axial<R> {
        m
    }
    #[inline(always)]
    fn moment_to_body(_: &PlanarPose<R>, m: Axial<R>) -> Axial<R> {
        m
    }
    #[inline(always)]
    fn position(stored: &Vec2<R>) -> Vec2<R> {
        *stored
    }
    #[inline(always)]
    fn velocity(stored: &Vec2<R>) -> Vec2<R> {
        *stored
    }
    #[inline(always)]
    fn spin(stored: &Axial<R>) -> Axial<R> {
        *stored
    }
    #[inline(always)]
    fn accelerate(stored: &mut Vec2<R>, increment: Vec2<R>) {
        *stored = *stored + increment;
    }
    #[inline(always)]
    fn spin_up(stored: &mut Axial<R>, increment: Axial<R>) {
        *stored = *stored + increment;
    }
    #[inline(always)]
    fn translate(position: &mut Vec2<R>, displacement: Vec2<R>) {
        *position = *position + displacement;
    }
    fn position_from_f64(position: [f64; 3]) -> Vec2<R> {
        Vec2::from_f64(position)
    }
    fn position_to_f64(position: &Vec2<R>) -> [f64; 3] {
        position.to_f64()
    }
    fn velocity_from_f64(velocity: [f64; 3]) -> Vec2<R> {
        Vec2::from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &Vec2<R>) -> [f64; 3] {
        velocity.to_f64()
    }
    fn spin_from_f64(spin: [f64; 3]) -> Axial<R> {
        Axial::from_f64(spin)
    }
    fn spin_to_f64(spin: &Axial<R>) -> [f64; 3] {
        spin.to_f64()
    }
    fn local_from_f64(local: [f64; 3]) -> Vec2<R> {
        // As in space: without negative zeros.
        Vec2::from_f64(local.map(|c| c + 0.0))
    }
    fn local_to_f64(local: &Vec2<R>) -> [f64; 3] {
        local.to_f64()
    }
}
