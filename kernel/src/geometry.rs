//! The arithmetic of positions, velocities and the displacement between two points.
//!
//! Separate from [`Real`] because it determines precision: a displacement of micrometres is the difference of
//! coordinates of metres. A precision is a type that implements [`Geometry`]; laws and schemes use displacements, lever
//! arms and rates as vectors of its `Real`, never coordinates. Orientations are [`Attitude`]s, stored separately from
//! positions. The vectors are those of its [`Space`].

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::attitude::Attitude;
use crate::elongation::{AtRest, Beside, Beyond, Elongation};
use crate::force_pair::ForcePair;
use crate::lanes::Named;
use crate::pass_sum::PassSum;
use crate::real::Real;
use crate::space::{Linear as _, Moment, Space, Vector};
use crate::vector::{Quaternion, Rotation, Vec3};
use crate::words::Words;

/// The range of a precision: fixed point only, floating point has no limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Limits {
    /// \[m\] a centre of mass or a point of the ground from the origin, along each axis.
    pub extent: f64,
    /// \[m\] a point of a body from its centre of mass.
    pub elongation: f64,
    /// \[m\] a centre of mass in one drift.
    pub drift: f64,
    /// \[m\] the ground that an input moves.
    pub shift: f64,
}

/// How a precision stores and combines positions and velocities, and its attitude.
pub trait Geometry: Copy + Debug + Default + PartialEq + Send + 'static {
    /// The number in which forces and rates are computed.
    type Real: Real;
    /// Displacements, lever arms, velocities and forces.
    type Vector: Vector<Real = Self::Real, Moment = Self::Moment>;
    /// Angular velocities, torques and inertias.
    type Moment: Moment<Real = Self::Real, Vector = Self::Vector>;
    /// The space of these vectors.
    type Space: Space<Real = Self::Real, Vector = Self::Vector, Moment = Self::Moment>;
    /// The stored position of a body's centre of mass, world.
    type Position: Copy + Debug + Default + PartialEq + Send + Words;
    /// The stored orientation of a body.
    type Orientation: Attitude<Real = Self::Real, Turn = <Self::Space as Space>::Turn>;
    /// A stored velocity, with the rounding error of its sum where the precision keeps one.
    type Velocity: Copy + Debug + Default + PartialEq + Send + Words;
    /// A stored angular velocity, likewise.
    type Spin: Copy + Debug + Default + PartialEq + Send + Words;
    /// A point in body axes from the centre of mass; a point in the world for the ground.
    type Local: Copy + Debug + Default + PartialEq + Send + Sync + Words;
    /// A point in the world.
    type Location: Copy + Default;
    /// A body's pose, prepared for computing many points.
    type Frame: Copy + Debug + Default + Send;
    /// The reference data of a TSDA, `()` where none is stored.
    type Rest: Copy + Debug + Default + Send;
    /// The relative pose of two bodies, `()` where no reference data is stored.
    type Apart: Copy + Default;
    /// The sums of a damper pass per body, `()` where impulses are added to velocities directly.
    type PassSum: PassSum<Self::Space>;

    /// The geometry of several lanes in which alike joints of one model are computed together; `Self` without lanes.
    type Abreast: Geometry;

    /// The name users give: `f64`, `f32`.
    const NAME: &'static str;
    /// The space's name: `spatial`, `planar`.
    const SPACE: &'static str = <Self::Space as Space>::NAME;
    /// The name of the storage form of orientations, for users.
    const ORIENTATION: &'static str = <Self::Orientation as Attitude>::NAME;
    /// The range of bodies and points, `None` for floating point.
    const LIMITS: Option<Limits> = None;

    /// Prepares a pose for [`Self::place`].
    fn frame(position: &Self::Position, orientation: &Self::Orientation) -> Self::Frame;
    /// Writes [`Self::frame`] in place.
    #[inline(always)]
    fn set_frame(
        frame: &mut Self::Frame,
        position: &Self::Position,
        orientation: &Self::Orientation,
    ) {
        *frame = Self::frame(position, orientation);
    }
    /// After the rotations of a step [`Self::renormalise`], and then [`Self::set_frame`].
    #[inline(always)]
    fn set_next_frame(
        frame: &mut Self::Frame,
        position: &Self::Position,
        orientation: &mut Self::Orientation,
    ) {
        Self::renormalise(orientation);
        Self::set_frame(frame, position, orientation);
    }
    /// The point's world location and its lever arm from the centre of mass in world axes \[m\].
    fn place(frame: &Self::Frame, local: &Self::Local) -> (Self::Location, Self::Vector);
    /// The location of a point of the ground.
    fn ground(local: &Self::Local) -> Self::Location;
    /// A location moved by a displacement \[m\].
    fn shift(location: &Self::Location, by: Self::Vector) -> Self::Location;
    /// `to − from` \[m\], world axes.
    fn displacement(from: &Self::Location, to: &Self::Location) -> Self::Vector;
    /// [`Self::displacement`] with a free length \[m\]: a precision may represent the difference of the lengths more
    /// accurately than the displacement.
    #[inline(always)]
    fn elongation(
        from: &Self::Location,
        to: &Self::Location,
        free_length: Self::Real,
    ) -> Elongation<Self::Vector> {
        let _ = free_length;
        Elongation { way: Self::displacement(from, to), more: None }
    }
    /// A frame per lane.
    fn frames_abreast(of: impl Fn(usize) -> Self::Frame) -> <Self::Abreast as Geometry>::Frame;
    /// A point per lane.
    fn points_abreast(of: impl Fn(usize) -> Self::Local) -> <Self::Abreast as Geometry>::Local;
    /// A number per lane.
    fn numbers_abreast(of: impl Fn(usize) -> Self::Real) -> <Self::Abreast as Geometry>::Real;
    /// The force pair in a lane.
    fn force_pair_of(
        pairs: &ForcePair<<Self::Abreast as Geometry>::Space>,
        lane: usize,
    ) -> ForcePair<Self::Space>;
    /// Whether reference data of TSDAs is stored: the offset of a triple's centre from its reference position in B is
    /// then more accurate than its distance from the points of B.
    const RESTS: bool = false;
    /// The reference data of a triple's TSDAs with the centre at `centre`, in the axes of the body of `frame`, which
    /// has the endpoints `endpoints`.
    fn find_rests(
        _frame: &Self::Frame,
        _centre: &Self::Location,
        _endpoints: &[Self::Local],
        _free_lengths: &[Self::Real],
        _rests: &mut [Self::Rest],
    ) {
    }
    /// The pose of A relative to B, common to all triples of a joint; `None` for the ground, which may be moved.
    #[inline(always)]
    fn apart(
        _a: Option<&Self::Frame>,
        _moved: Option<Self::Vector>,
        _b: &Self::Frame,
    ) -> Self::Apart {
        Self::Apart::default()
    }
    /// The offset of a triple's centre, a point of A, from its reference position in B; `endpoint` is the triple's first
    /// point of B.
    #[inline(always)]
    fn beside<const ARMS: usize>(
        _apart: &Self::Apart,
        (_a, _centre): (Option<&Self::Frame>, &Self::Local),
        (_b, _endpoint): (&Self::Frame, &Self::Local),
        _rests: &[Self::Rest; ARMS],
    ) -> Beside<Self::Vector> {
        Beside::default()
    }
    /// The offset of a second triple's centre relative to that of the first.
    #[inline(always)]
    fn beyond<const ARMS: usize>(
        (_a, _centres): (Option<&Self::Frame>, [&Self::Local; 2]),
        (_b, _endpoint): (&Self::Frame, &Self::Local),
        _rests: [&[Self::Rest; ARMS]; 2],
    ) -> Beyond<Self::Vector> {
        Beyond::default()
    }
    /// The reference state of a TSDA for its law.
    #[inline(always)]
    fn at_rest(_rest: &Self::Rest) -> AtRest<Self::Vector> {
        AtRest::default()
    }
    /// \[m²\] the squared offset of a triple's centre below which its TSDAs are near their reference.
    #[inline(always)]
    fn near_rest(_rest: &Self::Rest) -> Self::Real {
        Self::Real::ZERO
    }
    /// Body axes to world axes.
    fn to_world(frame: &Self::Frame, v: Self::Vector) -> Self::Vector;
    /// World axes to body axes.
    fn to_body(frame: &Self::Frame, v: Self::Vector) -> Self::Vector;
    /// A moment's body axes to world axes.
    fn moment_to_world(frame: &Self::Frame, m: Self::Moment) -> Self::Moment;
    /// A moment's world axes to body axes.
    fn moment_to_body(frame: &Self::Frame, m: Self::Moment) -> Self::Moment;
    /// The axes of a body's moments in world axes, one per component.
    #[inline(always)]
    fn moment_axes(frame: &Self::Frame) -> [Self::Moment; 3] {
        let [x, y, z] = Self::Moment::axes();
        [x, y, z].map(|axis| Self::moment_to_world(frame, axis))
    }
    /// The value of a stored position \[m\].
    fn position(stored: &Self::Position) -> Self::Vector;
    /// The value of a stored velocity.
    fn velocity(stored: &Self::Velocity) -> Self::Vector;
    /// The value of a stored angular velocity.
    fn spin(stored: &Self::Spin) -> Self::Moment;
    /// `to − from` of stored velocities.
    #[inline(always)]
    fn velocity_change(from: &Self::Velocity, to: &Self::Velocity) -> Self::Vector {
        Self::velocity(to) - Self::velocity(from)
    }
    /// `to − from` of stored angular velocities.
    #[inline(always)]
    fn spin_change(from: &Self::Spin, to: &Self::Spin) -> Self::Moment {
        Self::spin(to) - Self::spin(from)
    }
    /// Adds an increment to a stored velocity.
    fn accelerate(stored: &mut Self::Velocity, increment: Self::Vector);
    /// Whether gravity acts on velocities and not by weights. The forces on a body are rounded to the last digit of the
    /// largest: a weight among them is rounded in the same direction step after step, which does work.
    const HAS_GRAVITY_STEP: bool = false;
    /// Adds the increment by gravity to a stored velocity, to be rounded with the next [`Self::accelerate`].
    #[inline(always)]
    fn apply_gravity(stored: &mut Self::Velocity, increment: Self::Vector) {
        Self::accelerate(stored, increment);
    }
    /// Adds an increment to a stored angular velocity.
    fn spin_up(stored: &mut Self::Spin, increment: Self::Moment);
    /// [`Self::spin_up`] by an increment that has no component about body axis `AXIS`.
    #[inline(always)]
    fn spin_up_across<const AXIS: usize>(stored: &mut Self::Spin, increment: Self::Moment) {
        Self::spin_up(stored, increment);
    }
    /// [`Self::spin_up`] by zero: adds the stored rounding error.
    #[inline(always)]
    fn settle(stored: &mut Self::Spin) {
        Self::spin_up(stored, Self::Moment::ZERO);
    }
    /// Adds a displacement to a stored position.
    fn translate(position: &mut Self::Position, displacement: Self::Vector);

    /// Advances a stored position by its velocity for `time` \[s\].
    #[inline(always)]
    fn advance_position(
        position: &mut Self::Position,
        velocity: &Self::Velocity,
        time: Self::Real,
    ) {
        Self::translate(position, Self::velocity(velocity) * time);
    }

    /// Rotates about body axis `AXIS` by its `rate` for `time` \[s\], given cosine and sine of half the angle.
    #[inline(always)]
    fn turn_about<const AXIS: usize>(
        orientation: &mut Self::Orientation,
        rate: &Self::Spin,
        time: Self::Real,
        (cos, sin): (Self::Real, Self::Real),
    ) {
        let _ = (rate, time);
        Self::Orientation::turn_about::<AXIS>(orientation, cos, sin);
    }
    /// Restores unit length after [`Self::turn_about`], where that does not.
    #[inline(always)]
    fn renormalise(orientation: &mut Self::Orientation) {
        orientation.renormalise();
    }
    /// Whether a position is within the limits, and no previous drift left them.
    #[inline(always)]
    fn is_within(_position: &Self::Position) -> bool {
        true
    }
    /// Whether the ground may be moved by `displacement` \[m\].
    #[inline(always)]
    fn bears_shift(_displacement: Self::Real) -> bool {
        true
    }

    /// Rounds a world position \[m\] once.
    fn position_from_f64(position: [f64; 3]) -> Self::Position;
    /// The position in double precision \[m\].
    fn position_to_f64(position: &Self::Position) -> [f64; 3];
    /// Rounds a velocity once.
    fn velocity_from_f64(velocity: [f64; 3]) -> Self::Velocity;
    /// The velocity in double precision.
    fn velocity_to_f64(velocity: &Self::Velocity) -> [f64; 3];
    /// Rounds an angular velocity once.
    fn spin_from_f64(spin: [f64; 3]) -> Self::Spin;
    /// The angular velocity in double precision.
    fn spin_to_f64(spin: &Self::Spin) -> [f64; 3];
    /// Rounds a point \[m\] once.
    fn local_from_f64(local: [f64; 3]) -> Self::Local;
    /// The point in double precision \[m\].
    fn local_to_f64(local: &Self::Local) -> [f64; 3];
}

/// Floating-point geometry: everything is stored in the `Real` itself, orientations as `A`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Float<R, A = Quaternion<R>>(PhantomData<(R, A)>);

/// Double precision throughout.
pub type F64 = Float<f64>;
/// Single precision throughout.
pub type F32 = Float<f32>;

/// The pose of a body in floating-point geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Pose<R> {
    pub(crate) position: Vec3<R>,
    pub(crate) rotation: Rotation<R>,
}

impl<R: Real> Pose<R> {
    /// Its numbers: position and the rows of the rotation matrix.
    #[inline(always)]
    #[must_use]
    pub fn numbers(&self) -> [R; 12] {
        let Self { position: p, rotation: Rotation { x, y, z } } = self;
        [p.x, p.y, p.z, x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z]
    }

    /// The pose from [`Self::numbers`].
    #[inline(always)]
    #[must_use]
    pub fn from_numbers(numbers: [R; 12]) -> Self {
        let [px, py, pz, xx, xy, xz, yx, yy, yz, zx, zy, zz] = numbers;
        let rotation = Rotation {
            x: Vec3::new(xx, xy, xz),
            y: Vec3::new(yx, yy, yz),
            z: Vec3::new(zx, zy, zz),
        };
        Self { position: Vec3::new(px, py, pz), rotation }
    }
}

impl<R: Real + Named, A: Attitude<Real = R, Turn = Quaternion<R>>> Geometry for Float<R, A> {
    type Real = R;
    type Vector = Vec3<R>;
    type Moment = Vec3<R>;
    type Space = R;
    type Position = Vec3<R>;
    type Orientation = A;
    type Velocity = Vec3<R>;
    type Spin = Vec3<R>;
    type Local = Vec3<R>;
    type Location = Vec3<R>;
    type Frame = Pose<R>;
    type Rest = ();
    type Apart = ();
    type PassSum = R::PassSum<R>;
    type Abreast = Float<R::Abreast>;

    const NAME: &'static str = R::NAME;

    #[inline(always)]
    fn frames_abreast(of: impl Fn(usize) -> Pose<R>) -> Pose<R::Abreast> {
        Pose {
            position: Vec3::abreast(|lane| of(lane).position),
            rotation: Rotation {
                x: Vec3::abreast(|lane| of(lane).rotation.x),
                y: Vec3::abreast(|lane| of(lane).rotation.y),
                z: Vec3::abreast(|lane| of(lane).rotation.z),
            },
        }
    }
    #[inline(always)]
    fn points_abreast(of: impl Fn(usize) -> Vec3<R>) -> Vec3<R::Abreast> {
        Vec3::abreast(of)
    }
    #[inline(always)]
    fn numbers_abreast(of: impl Fn(usize) -> R) -> R::Abreast {
        R::abreast(of)
    }
    #[inline(always)]
    fn force_pair_of(pairs: &ForcePair<R::Abreast>, lane: usize) -> ForcePair<R> {
        ForcePair {
            force: Vec3::lane(pairs.force, lane),
            torque_a: Vec3::lane(pairs.torque_a, lane),
            torque_b: Vec3::lane(pairs.torque_b, lane),
        }
    }
    #[inline(always)]
    fn frame(position: &Vec3<R>, orientation: &A) -> Pose<R> {
        Pose { position: *position, rotation: orientation.rotation() }
    }
    #[inline(always)]
    fn place(frame: &Pose<R>, local: &Vec3<R>) -> (Vec3<R>, Vec3<R>) {
        let arm = frame.rotation.to_world(*local);
        (frame.position + arm, arm)
    }
    #[inline(always)]
    fn ground(local: &Vec3<R>) -> Vec3<R> {
        *local
    }
    #[inline(always)]
    fn shift(location: &Vec3<R>, by: Vec3<R>) -> Vec3<R> {
        *location + by
    }
    #[inline(always)]
    fn displacement(from: &Vec3<R>, to: &Vec3<R>) -> Vec3<R> {
        *to - *from
    }
    #[inline(always)]
    fn to_world(frame: &Pose<R>, v: Vec3<R>) -> Vec3<R> {
        frame.rotation.to_world(v)
    }
    #[inline(always)]
    fn to_body(frame: &Pose<R>, v: Vec3<R>) -> Vec3<R> {
        frame.rotation.to_body(v)
    }
    #[inline(always)]
    fn moment_to_world(frame: &Pose<R>, m: Vec3<R>) -> Vec3<R> {
        frame.rotation.to_world(m)
    }
    #[inline(always)]
    fn moment_to_body(frame: &Pose<R>, m: Vec3<R>) -> Vec3<R> {
        frame.rotation.to_body(m)
    }
    #[inline(always)]
    fn moment_axes(frame: &Pose<R>) -> [Vec3<R>; 3] {
        let Rotation { x, y, z } = frame.rotation;
        [Vec3::new(x.x, y.x, z.x), Vec3::new(x.y, y.y, z.y), Vec3::new(x.z, y.z, z.z)]
    }
    #[inline(always)]
    fn position(stored: &Vec3<R>) -> Vec3<R> {
        *stored
    }
    #[inline(always)]
    fn velocity(stored: &Vec3<R>) -> Vec3<R> {
        *stored
    }
    #[inline(always)]
    fn spin(stored: &Vec3<R>) -> Vec3<R> {
        *stored
    }
    #[inline(always)]
    fn accelerate(stored: &mut Vec3<R>, increment: Vec3<R>) {
        *stored = *stored + increment;
    }
    #[inline(always)]
    fn spin_up(stored: &mut Vec3<R>, increment: Vec3<R>) {
        *stored = *stored + increment;
    }
    #[inline(always)]
    fn translate(position: &mut Vec3<R>, displacement: Vec3<R>) {
        *position = *position + displacement;
    }
    fn position_from_f64(position: [f64; 3]) -> Vec3<R> {
        Vec3::from_f64(position)
    }
    fn position_to_f64(position: &Vec3<R>) -> [f64; 3] {
        position.to_f64()
    }
    fn velocity_from_f64(velocity: [f64; 3]) -> Vec3<R> {
        Vec3::from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &Vec3<R>) -> [f64; 3] {
        velocity.to_f64()
    }
    fn spin_from_f64(spin: [f64; 3]) -> Vec3<R> {
        Vec3::from_f64(spin)
    }
    fn spin_to_f64(spin: &Vec3<R>) -> [f64; 3] {
        spin.to_f64()
    }
    fn local_from_f64(local: [f64; 3]) -> Vec3<R> {
        // + 0.0 turns a negative zero into a positive one, so that a ground point transformed by an identity pose and
        // one taken as stored have the same bits.
        Vec3::from_f64(local.map(|c| c + 0.0))
    }
    fn local_to_f64(local: &Vec3<R>) -> [f64; 3] {
        local.to_f64()
    }
}
