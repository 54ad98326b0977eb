//! The model: read-only constants of bodies and elements, in flash or on a heap.
//!
//! [`Model`] owns arrays whose lengths are const generics; an owner sized at run time is defined elsewhere and also
//! implements [`ModelOwner`]. All code works on [`ModelRef`], slices lent by either owner, so both are stepped by the
//! same code. [`Terms`] states the kinds of element of a model at compile time: other kinds generate no code.
//!
//! Elements form groups, one per joint and one per raw element. A TSDA group consists of spring triples: a point of the
//! first body joined to one to three points of the second. A revolute is two triples with three common points, a
//! spherical joint one triple of three legs, a raw TSDA one of one. As bushings each of these is one pair of points, a
//! fixed joint three pairs.

mod owned;
mod plan;
mod planned;
mod terms;

pub use owned::Model;
pub use plan::Plan;
pub use planned::Planned;
pub use terms::{AllTerms, CountedTerms, Terms};

use crate::body::Body;
use crate::body::BodyState;
use crate::elements::element::Element;
pub use crate::elements::element::Law;
use crate::elements::input::{Input, Knot};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_law::{Deformation, PointLaw as _};
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::source::Source;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
use crate::laws::Laws;
use crate::schedule::{KnotStep, LoadWindow};
use crate::sources::SourceStep;

/// The elements of one joint or one raw element: one record of force and torques.
///
/// Its points are stored together from `point` on: the first body's, one per triple, then the second body's, `arms` for
/// each triple, or once where the triples share them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Group {
    /// The law of its elements.
    pub law: Law,
    /// First body.
    pub a: BodyIndex,
    /// Second body.
    pub b: BodyIndex,
    /// Points of the first body, ≥ 1.
    pub triples: u8,
    /// Points of the second body per triple: 1 to 3; 1 or 2 on a line.
    pub arms: u8,
    /// Whether all triples share the second body's points.
    pub shared: bool,
    /// First point among the model's points.
    pub point: u16,
    /// First element among the model's elements of this law; triple by triple, leg by leg.
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
        self.triples as usize * self.arms as usize
    }

    /// The number of points.
    #[must_use]
    pub const fn points(&self) -> usize {
        let blocks = if self.shared { 1 } else { self.triples as usize };
        self.triples as usize + blocks * self.arms as usize
    }

    /// The row of a triple's first point among the model's points.
    #[inline(always)]
    pub(crate) const fn centre(&self, triple: usize) -> usize {
        self.point as usize + triple
    }

    /// The row of a triple's first point of the second body; its others follow.
    #[inline(always)]
    pub(crate) const fn endpoints(&self, triple: usize) -> usize {
        let block = if self.shared { 0 } else { triple };
        self.point as usize + self.triples as usize + block * self.arms as usize
    }
}

/// A model lent as slices.
pub struct ModelRef<'m, P: Geometry, T: Terms<P>> {
    /// Bodies in scene order.
    pub bodies: &'m [Body<P::Space>],
    /// \[m/s²\] gravity, or empty.
    pub gravity: &'m [P::Vector],
    /// Groups in the order of their records' sums.
    pub groups: &'m [Group],
    /// \[m\] points of the groups, in the axes of their bodies.
    pub points: &'m [P::Local],
    /// TSDAs of the groups.
    pub tsdas: &'m [Tsda<P::Real>],
    /// Point bushings of the groups.
    pub bushings: &'m [PointBushing<P::Real>],
    /// \[N·s/m, N·m·s/rad\] damping coefficients of groups and torsion springs.
    pub dampers: &'m [P::Real],
    /// Torsion springs, summed after all groups.
    pub torsions: &'m [TorsionSpring<P::Space>],
    /// Loads, summed before all groups.
    pub loads: &'m [Load<P::Space>],
    /// Points on lines of the groups.
    pub lines: &'m [PointOnLine<P::Space>],
    /// Inputs, added after the loads.
    pub inputs: &'m [Input<P>],
    /// Knots of the inputs' tables.
    pub knots: &'m [Knot<P::Real>],
    /// \[m\] clearances of groups.
    pub clearances: &'m [P::Real],
    /// Revolute joints of bushings of the groups.
    pub revolutes: &'m [Revolute<P::Space>],
    /// Universal joints of the groups.
    pub universals: &'m [Universal<P::Space>],
    /// Sources that drive inputs.
    pub sources: &'m [Source<P>],
    /// The list of laws, summed after all torsion springs.
    pub laws: &'m LawsIn<P, T>,
}

impl<P: Geometry, T: Terms<P>> Clone for ModelRef<'_, P, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: Geometry, T: Terms<P>> Copy for ModelRef<'_, P, T> {}

impl<P: Geometry, T: Terms<P>> core::fmt::Debug for ModelRef<'_, P, T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("ModelRef")
            .field("bodies", &self.bodies)
            .field("gravity", &self.gravity)
            .field("groups", &self.groups)
            .field("points", &self.points)
            .field("tsdas", &self.tsdas)
            .field("bushings", &self.bushings)
            .field("dampers", &self.dampers)
            .field("torsions", &self.torsions)
            .field("loads", &self.loads)
            .field("lines", &self.lines)
            .field("inputs", &self.inputs)
            .field("knots", &self.knots)
            .field("clearances", &self.clearances)
            .field("revolutes", &self.revolutes)
            .field("universals", &self.universals)
            .field("sources", &self.sources)
            .finish_non_exhaustive()
    }
}

/// The list of laws of a model's terms.
pub type LawsIn<P, T> = <T as Terms<P>>::Laws;
/// The memories of its laws.
pub type StatesIn<P, T> = <LawsIn<P, T> as Laws<P>>::States;
/// The weights of its laws' dampers.
pub type SharesIn<P, T> = <LawsIn<P, T> as Laws<P>>::Shares;

impl<'m, P: Geometry, T: Terms<P>> ModelRef<'m, P, T> {
    /// Element `row` of a law, `None` where the model has none.
    #[inline(always)]
    pub(crate) fn element(&self, law: Law, row: usize) -> Option<Element<'m, P::Space>> {
        match law {
            Law::Tsda if T::TSDAS => self.tsdas.get(row).map(Element::Tsda),
            Law::PointBushing if T::BUSHINGS => self.bushings.get(row).map(Element::PointBushing),
            Law::PointOnLine if T::LINES => self.lines.get(row).map(Element::PointOnLine),
            Law::Revolute if T::REVOLUTES => self.revolutes.get(row).map(Element::Revolute),
            Law::Universal if T::UNIVERSALS => self.universals.get(row).map(Element::Universal),
            _ => None,
        }
    }

    /// The directions in which a law's damper acts and their number, `None` where the model has no such law.
    #[inline(always)]
    pub(crate) fn damped(
        &self,
        law: Law,
        deformation: &Deformation<P::Vector>,
    ) -> Option<([P::Vector; 3], usize)> {
        match law {
            Law::Tsda if T::TSDAS => Some(Tsda::damped(deformation)),
            Law::PointBushing if T::BUSHINGS => Some(PointBushing::damped(deformation)),
            Law::PointOnLine if T::LINES => Some(PointOnLine::<P::Space>::damped(deformation)),
            Law::Revolute if T::REVOLUTES => Some(Revolute::<P::Space>::damped(deformation)),
            Law::Universal if T::UNIVERSALS => Some(Universal::<P::Space>::damped(deformation)),
            _ => None,
        }
    }

    /// The clearance \[m\] of a group, `None` without one.
    #[inline(always)]
    pub(crate) fn clearance(&self, group: &Group) -> Option<P::Real> {
        if !T::CLEARANCES {
            return None;
        }
        group.clearance.row().and_then(|row| self.clearances.get(row)).copied()
    }
}

/// Owns a model's constants and defines the memory of its plant.
pub trait ModelOwner {
    /// The precision its constants are stored in.
    type Precision: Geometry;
    /// The kinds of element that may occur.
    type Terms: Terms<Self::Precision>;
    /// Memory of one `T` per body.
    type PerBody<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one `T` per body of a model with dampers; a model without any may have none.
    type PerDampedBody<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one revolution count per torsion spring.
    type PerTorsion: Clone + AsRef<[i32]> + AsMut<[i32]>;
    /// Memory of one window per load.
    type PerLoad: Clone + AsRef<[LoadWindow]> + AsMut<[LoadWindow]>;
    /// Memory of one `T` per input.
    type PerInput<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one `T` per damper.
    type PerDamper<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one `T` per pair of bodies of the elimination order, see [`Self::plan`].
    type PerPair<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one `T` per group, torsion spring and law of the elimination order.
    type PerSlot<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one `T` per TSDA.
    type PerTsda<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;
    /// Memory of one knot in steps per knot.
    type PerKnot: Clone + AsRef<[KnotStep<RealOf<Self>>]> + AsMut<[KnotStep<RealOf<Self>>]>;
    /// Memory of one source in steps per source.
    type PerSource: Clone + AsRef<[SourceStep]> + AsMut<[SourceStep]>;

    /// The constants.
    fn view(&self) -> ModelRef<'_, Self::Precision, Self::Terms>;
    /// The bodies' states at t = 0, as many as bodies.
    fn initial(&self) -> &[BodyState<Self::Precision>];
    /// One `value` per body.
    fn per_body<T: Copy>(&self, value: T) -> Self::PerBody<T>;
    /// One `value` per body of a model with dampers.
    fn per_damped_body<T: Copy>(&self, value: T) -> Self::PerDampedBody<T>;
    /// One 0 per torsion spring.
    fn per_torsion(&self) -> Self::PerTorsion;
    /// One empty window per load.
    fn per_load(&self) -> Self::PerLoad;
    /// One `value` per input.
    fn per_input<T: Copy>(&self, value: T) -> Self::PerInput<T>;
    /// One `value` per damper.
    fn per_damper<T: Copy>(&self, value: T) -> Self::PerDamper<T>;
    /// One `value` per pair of bodies of the elimination order.
    fn per_pair<T: Copy>(&self, value: T) -> Self::PerPair<T>;
    /// One `value` per group, torsion spring and law of the elimination order.
    fn per_slot<T: Copy>(&self, value: T) -> Self::PerSlot<T>;
    /// The order in which a scheme with a matrix eliminates the bodies; empty where the model was built without one,
    /// see [`Planned`].
    fn plan(&self) -> Plan<'_> {
        Plan::NONE
    }
    /// One `value` per TSDA.
    fn per_tsda<T: Copy>(&self, value: T) -> Self::PerTsda<T>;
    /// One knot in steps per knot.
    fn per_knot(&self) -> Self::PerKnot;
    /// One source in steps per source.
    fn per_source(&self) -> Self::PerSource;
}

/// The real number of a model's precision.
pub type RealOf<M> = <<M as ModelOwner>::Precision as Geometry>::Real;
/// The space of a model's precision.
pub type SpaceOf<M> = <<M as ModelOwner>::Precision as Geometry>::Space;
/// The memories of a model's laws.
pub type LawStates<M> = StatesIn<<M as ModelOwner>::Precision, <M as ModelOwner>::Terms>;
/// The weights of the dampers of a model's laws.
pub type LawShares<M> = SharesIn<<M as ModelOwner>::Precision, <M as ModelOwner>::Terms>;
/// The frame of a model's precision.
pub type FrameOf<M> = <<M as ModelOwner>::Precision as Geometry>::Frame;
