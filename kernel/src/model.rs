//! The model: read-only constants of bodies and elements, in flash or on a heap.
//!
//! [`Model`] owns arrays whose lengths are const generics; a run-time-sized owner lives elsewhere
//! and implements [`ModelOwner`] likewise. All work is done on [`ModelRef`], slices that either
//! owner lends, so both step through the same code. [`Terms`] tells the compiler which kinds of
//! element a model has at all: what it lacks leaves no code.
//!
//! Elements lie in groups, one per joint and one per raw element. A TSDA group is made of stars:
//! a point of the first body joined to each of one or three points of the second. A revolute is
//! two stars that share three points, a spherical joint one star of three, a raw TSDA one of one.

use core::marker::PhantomData;

use crate::elements::load::{Load, LoadWindow};
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::geometry::{Geometry, RealOf};
use crate::inputs::{Input, InputIndex, InputKind, Knot, KnotStep, Signal};
use crate::real::Real;
use crate::state::BodyState;
use crate::vector::Vec3;

/// The index of a body, or the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BodyIndex(pub u16);

impl BodyIndex {
    /// The world: immovable, its points are the ground's.
    pub const WORLD: Self = Self(u16::MAX);

    /// Indices from here on are the ground's.
    const FIRST_ANCHOR: u16 = 0xff00;

    /// The ground as moved by input `input`, an [`InputKind::Anchor`].
    ///
    /// # Panics
    /// Where the input's index is above 254.
    #[must_use]
    pub const fn anchor(input: InputIndex) -> Self {
        assert!(input.0 < u16::MAX - Self::FIRST_ANCHOR, "an anchor is one of the first inputs");
        Self(Self::FIRST_ANCHOR + input.0)
    }

    /// The input that moves this part of the ground, if one does.
    #[inline(always)]
    #[must_use]
    pub const fn anchor_row(self) -> Option<usize> {
        if self.0 >= Self::FIRST_ANCHOR && self.0 != u16::MAX {
            Some((self.0 - Self::FIRST_ANCHOR) as usize)
        } else {
            None
        }
    }

    /// Whether this is the world, moved by an input or not: no force moves it.
    #[must_use]
    pub const fn is_world(self) -> bool {
        self.0 >= Self::FIRST_ANCHOR
    }

    /// The index into slices of bodies; the world's lies beyond any of them.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> usize {
        self.0 as usize
    }
}

/// The index of the first damping coefficient of a group or spring, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DamperIndex(pub u16);

impl DamperIndex {
    /// Undamped.
    pub const NONE: Self = Self(u16::MAX);

    /// The index into the dampers, `None` where undamped.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> Option<usize> {
        if self.0 == u16::MAX { None } else { Some(self.0 as usize) }
    }
}

/// The index of a group's clearance, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClearanceIndex(pub u16);

impl ClearanceIndex {
    /// Without clearance.
    pub const NONE: Self = Self(u16::MAX);

    /// The index into the clearances, `None` without one.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> Option<usize> {
        if self.0 == u16::MAX { None } else { Some(self.0 as usize) }
    }
}

/// The law that a group's elements follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Law {
    /// Stars of TSDAs with free lengths.
    Tsda,
    /// One point bushing.
    PointBushing,
    /// Stars on lines: each star's first point and its elements' direction define a line of the
    /// first body, on which the second body's points are projected.
    PointOnLine,
}

/// The elements of one joint or one raw element: one record of force and torques.
///
/// Its points lie together from `point` on: the first body's, one per star, then the second
/// body's, `arms` for each star, or once where the stars share them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Group {
    /// The law of its elements.
    pub law: Law,
    /// First body.
    pub a: BodyIndex,
    /// Second body.
    pub b: BodyIndex,
    /// Points of the first body, ≥ 1.
    pub stars: u8,
    /// Points of the second body per star: 1 or 3; 1 or 2 on a line.
    pub arms: u8,
    /// Whether all stars share the second body's points.
    pub shared: bool,
    /// First point among the model's points.
    pub point: u16,
    /// First element among the model's elements of this law; star by star, arm by arm.
    pub element: u16,
    /// First of the elements' damping coefficients among the model's dampers.
    pub damper: DamperIndex,
    /// The clearance of all its elements among the model's clearances; bushings have none.
    pub clearance: ClearanceIndex,
}

impl Group {
    /// The number of elements.
    #[must_use]
    pub const fn elements(&self) -> usize {
        self.stars as usize * self.arms as usize
    }

    /// The number of points.
    #[must_use]
    pub const fn points(&self) -> usize {
        let blocks = if self.shared { 1 } else { self.stars as usize };
        self.stars as usize + blocks * self.arms as usize
    }
}

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

/// Which kinds of element a model has. What is `false` leaves no code in a step.
pub trait Terms: Copy + Default + 'static {
    /// Uniform gravity.
    const GRAVITY: bool;
    /// Loads.
    const LOADS: bool;
    /// TSDAs.
    const TSDAS: bool;
    /// Point bushings.
    const BUSHINGS: bool;
    /// Torsion springs.
    const TORSIONS: bool;
    /// Dampers of any kind.
    const DAMPERS: bool;
    /// Points on lines.
    const LINES: bool;
    /// Inputs.
    const INPUTS: bool;
    /// Clearances.
    const CLEARANCES: bool;
}

/// Terms of a model whose sizes are known at run time only: any kind may occur.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AllTerms;

impl Terms for AllTerms {
    const GRAVITY: bool = true;
    const LOADS: bool = true;
    const TSDAS: bool = true;
    const BUSHINGS: bool = true;
    const TORSIONS: bool = true;
    const DAMPERS: bool = true;
    const LINES: bool = true;
    const INPUTS: bool = true;
    const CLEARANCES: bool = true;
}

/// Terms of a model whose counts are const generics: a kind occurs where its count is not 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CountedTerms<
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const CLEARANCES: usize,
>;

impl<
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const CLEARANCES: usize,
> Terms
    for CountedTerms<TSDAS, BUSHINGS, DAMPERS, TORSIONS, GRAVITY, LOADS, LINES, INPUTS, CLEARANCES>
{
    const GRAVITY: bool = GRAVITY > 0;
    const LOADS: bool = LOADS > 0;
    const TSDAS: bool = TSDAS > 0;
    const BUSHINGS: bool = BUSHINGS > 0;
    const TORSIONS: bool = TORSIONS > 0;
    const DAMPERS: bool = DAMPERS > 0;
    const LINES: bool = LINES > 0;
    const INPUTS: bool = INPUTS > 0;
    const CLEARANCES: bool = CLEARANCES > 0;
}

impl<P: Geometry, T: Terms> ModelRef<'_, P, T> {
    /// The clearance \[m\] of a group, `None` without one.
    #[inline(always)]
    pub(crate) fn clearance(&self, group: &Group) -> Option<P::Real> {
        if !T::CLEARANCES {
            return None;
        }
        group.clearance.row().and_then(|row| self.clearances.get(row)).copied()
    }
}

/// A model lent as slices.
#[derive(Clone, Copy, Debug)]
pub struct ModelRef<'m, P: Geometry, T> {
    /// Bodies in scene order.
    pub bodies: &'m [Body<P::Real>],
    /// \[m/s²\] the field of gravity, or nothing.
    pub gravity: &'m [Vec3<P::Real>],
    /// Groups in the order of their records' sums.
    pub groups: &'m [Group],
    /// Points of the groups.
    pub points: &'m [P::Local],
    /// TSDAs of the groups.
    pub tsdas: &'m [Tsda<P::Real>],
    /// Point bushings of the groups.
    pub bushings: &'m [PointBushing<P::Real>],
    /// Damping coefficients of groups and torsion springs.
    pub dampers: &'m [P::Real],
    /// Torsion springs, summed after all groups.
    pub torsions: &'m [TorsionSpring<P::Real>],
    /// Loads, summed before all groups.
    pub loads: &'m [Load<P::Real>],
    /// Points on lines of the groups.
    pub lines: &'m [PointOnLine<P::Real>],
    /// Inputs, added after the loads.
    pub inputs: &'m [Input<P>],
    /// Knots of the inputs' tables.
    pub knots: &'m [Knot<P::Real>],
    /// \[m\] clearances of groups.
    pub clearances: &'m [P::Real],
    /// The kinds of element that occur.
    pub terms: PhantomData<T>,
}

/// Owns a model's constants and says how much memory a plant of it takes.
pub trait ModelOwner {
    /// The precision its constants are stored in.
    type Precision: Geometry;
    /// The kinds of element that may occur.
    type Terms: Terms;
    /// Memory of one `T` per body.
    type PerBody<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one turn count per torsion spring.
    type PerTorsion: Clone + AsRef<[i32]> + AsMut<[i32]>;
    /// Memory of one window per load.
    type PerLoad: Clone + AsRef<[LoadWindow]> + AsMut<[LoadWindow]>;
    /// Memory of one signal per input.
    type PerInput: Clone + AsRef<[Signal<RealOf<Self>>]> + AsMut<[Signal<RealOf<Self>>]>;
    /// Memory of one place per knot.
    type PerKnot: Clone + AsRef<[KnotStep<RealOf<Self>>]> + AsMut<[KnotStep<RealOf<Self>>]>;

    /// The constants.
    fn view(&self) -> ModelRef<'_, Self::Precision, Self::Terms>;
    /// The bodies' states at t = 0, as many as bodies.
    fn initial(&self) -> &[BodyState<Self::Precision>];
    /// One `value` per body.
    fn per_body<T: Copy>(&self, value: T) -> Self::PerBody<T>;
    /// One 0 per torsion spring.
    fn per_torsion(&self) -> Self::PerTorsion;
    /// One empty window per load.
    fn per_load(&self) -> Self::PerLoad;
    /// One zero signal per input.
    fn per_input(&self) -> Self::PerInput;
    /// One place per knot.
    fn per_knot(&self) -> Self::PerKnot;
}

/// A model whose sizes are const generics. A kind that a scene lacks has count 0, the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize = 0,
    const POINTS: usize = 0,
    const TSDAS: usize = 0,
    const BUSHINGS: usize = 0,
    const DAMPERS: usize = 0,
    const TORSIONS: usize = 0,
    const GRAVITY: usize = 0,
    const LOADS: usize = 0,
    const LINES: usize = 0,
    const INPUTS: usize = 0,
    const KNOTS: usize = 0,
    const CLEARANCES: usize = 0,
> {
    /// Bodies in scene order.
    pub bodies: [Body<P::Real>; BODIES],
    /// The bodies' states at t = 0.
    pub initial: [BodyState<P>; BODIES],
    /// \[m/s²\] the field of gravity, or nothing.
    pub gravity: [Vec3<P::Real>; GRAVITY],
    /// Groups in the order of their records' sums.
    pub groups: [Group; GROUPS],
    /// Points of the groups.
    pub points: [P::Local; POINTS],
    /// TSDAs of the groups.
    pub tsdas: [Tsda<P::Real>; TSDAS],
    /// Point bushings of the groups.
    pub bushings: [PointBushing<P::Real>; BUSHINGS],
    /// Damping coefficients of groups and torsion springs.
    pub dampers: [P::Real; DAMPERS],
    /// Torsion springs, summed after all groups.
    pub torsions: [TorsionSpring<P::Real>; TORSIONS],
    /// Loads, summed before all groups.
    pub loads: [Load<P::Real>; LOADS],
    /// Points on lines of the groups.
    pub lines: [PointOnLine<P::Real>; LINES],
    /// Inputs, added after the loads.
    pub inputs: [Input<P>; INPUTS],
    /// Knots of the inputs' tables.
    pub knots: [Knot<P::Real>; KNOTS],
    /// \[m\] clearances of groups.
    pub clearances: [P::Real; CLEARANCES],
}

impl<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize,
    const POINTS: usize,
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const KNOTS: usize,
    const CLEARANCES: usize,
>
    Model<
        P,
        BODIES,
        GROUPS,
        POINTS,
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        GRAVITY,
        LOADS,
        LINES,
        INPUTS,
        KNOTS,
        CLEARANCES,
    >
{
    /// Checks every index of the model; in a `const` the compiler does so.
    ///
    /// # Panics
    /// Where a group, spring or load names a body, point, element or damper that is not there. A
    /// step on a model that was not checked skips such an element.
    #[must_use]
    pub const fn checked(self) -> Self {
        assert!(BODIES > 0, "a model has at least one body");
        assert!(GRAVITY <= 1, "a model has at most one field of gravity");
        let mut i = 0;
        while i < GROUPS {
            let group = &self.groups[i];
            check_pair(group.a, group.b, BODIES);
            assert!(group.stars >= 1, "a group has at least one star");
            let arms = group.arms;
            let whole = match group.law {
                Law::Tsda => arms == 1 || arms == 3,
                Law::PointBushing => arms == 1,
                Law::PointOnLine => arms == 1 || arms == 2,
            };
            assert!(whole, "a star has as many arms as its law knows");
            let elements = group.elements();
            assert!(group.point as usize + group.points() <= POINTS, "a group's points are there");
            let count = match group.law {
                Law::Tsda => TSDAS,
                Law::PointBushing => {
                    assert!(elements == 1, "a point bushing stands alone in its group");
                    BUSHINGS
                }
                Law::PointOnLine => LINES,
            };
            assert!(group.element as usize + elements <= count, "a group's elements are there");
            check_damper(group.damper, elements, DAMPERS);
            if let Some(row) = group.clearance.row() {
                assert!(row < CLEARANCES, "a group's clearance is there");
            }
            i += 1;
        }
        i = 0;
        while i < TORSIONS {
            let spring = &self.torsions[i];
            check_pair(spring.a, spring.b, BODIES);
            check_damper(spring.damper, 1, DAMPERS);
            i += 1;
        }
        i = 0;
        while i < INPUTS {
            let input = &self.inputs[i];
            assert!(
                input.knot as usize + input.knots as usize <= KNOTS,
                "an input's knots are there"
            );
            match &input.kind {
                InputKind::Force { body, .. } | InputKind::Torque { body, .. } => {
                    assert!(body.row() < BODIES, "an input's body is there");
                }
                InputKind::JointTorque { a, b, .. } => check_pair(*a, *b, BODIES),
                InputKind::Actuator { group, element } => {
                    assert!((*group as usize) < GROUPS, "an actuator's group is there");
                    let elements = self.groups[*group as usize].elements();
                    assert!((*element as usize) < elements, "an actuator's element is there");
                }
                InputKind::Anchor { .. } => {}
            }
            i += 1;
        }
        i = 0;
        while i < LOADS {
            assert!(self.loads[i].body.row() < BODIES, "a load's body is there");
            i += 1;
        }
        self
    }
}

const fn check_pair(a: BodyIndex, b: BodyIndex, bodies: usize) {
    assert!(a.is_world() || a.row() < bodies, "an element's first body is there");
    assert!(b.is_world() || b.row() < bodies, "an element's second body is there");
    let ground = a.is_world() && b.is_world();
    assert!(a.0 != b.0 && !ground, "an element joins two different bodies");
}

const fn check_damper(damper: DamperIndex, elements: usize, dampers: usize) {
    if let Some(row) = damper.row() {
        assert!(row + elements <= dampers, "an element's damping coefficient is there");
    }
}

impl<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize,
    const POINTS: usize,
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const KNOTS: usize,
    const CLEARANCES: usize,
> ModelOwner
    for Model<
        P,
        BODIES,
        GROUPS,
        POINTS,
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        GRAVITY,
        LOADS,
        LINES,
        INPUTS,
        KNOTS,
        CLEARANCES,
    >
{
    type Precision = P;
    type Terms =
        CountedTerms<TSDAS, BUSHINGS, DAMPERS, TORSIONS, GRAVITY, LOADS, LINES, INPUTS, CLEARANCES>;
    type PerBody<T: Copy> = [T; BODIES];
    type PerTorsion = [i32; TORSIONS];
    type PerLoad = [LoadWindow; LOADS];
    type PerInput = [Signal<P::Real>; INPUTS];
    type PerKnot = [KnotStep<P::Real>; KNOTS];

    #[inline(always)]
    fn view(&self) -> ModelRef<'_, P, Self::Terms> {
        ModelRef {
            bodies: &self.bodies,
            gravity: &self.gravity,
            groups: &self.groups,
            points: &self.points,
            tsdas: &self.tsdas,
            bushings: &self.bushings,
            dampers: &self.dampers,
            torsions: &self.torsions,
            loads: &self.loads,
            lines: &self.lines,
            inputs: &self.inputs,
            knots: &self.knots,
            clearances: &self.clearances,
            terms: PhantomData,
        }
    }

    fn initial(&self) -> &[BodyState<P>] {
        &self.initial
    }

    #[inline]
    fn per_body<T: Copy>(&self, value: T) -> [T; BODIES] {
        [value; BODIES]
    }

    #[inline]
    fn per_torsion(&self) -> [i32; TORSIONS] {
        [0; TORSIONS]
    }

    #[inline]
    fn per_load(&self) -> [LoadWindow; LOADS] {
        [LoadWindow { first: 0, end: 0 }; LOADS]
    }

    #[inline]
    fn per_input(&self) -> [Signal<P::Real>; INPUTS] {
        [Signal { value: P::Real::ZERO, rate: P::Real::ZERO }; INPUTS]
    }

    #[inline]
    fn per_knot(&self) -> [KnotStep<P::Real>; KNOTS] {
        [KnotStep { first: 0, offset: P::Real::ZERO }; KNOTS]
    }
}
