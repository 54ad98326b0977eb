//! A model whose sizes are const generics: arrays in flash, checked by the compiler.

use crate::body::{Body, BodyState};
use crate::elements::input::{Input, InputKind, Knot};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::source::Source;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, DamperIndex};
use crate::laws::Laws;
use crate::model::{CountedTerms, Group, Law, ModelOwner, ModelRef};
use crate::pass_sum::PassSum;
use crate::real::Real;
use crate::schedule::{KnotStep, LoadWindow};
use crate::sources::SourceStep;

/// A model whose sizes are const generics. A kind that a scene lacks has count 0, the default.
///
/// `SUMS` is the number of sums that a damper pass keeps apart from the velocities, one per body, where the precision
/// has them: `BODIES` with dampers, 0 without. Its default is the number of dampers. `DRIVEN` is the number of
/// [driven](Body::driven) bodies; with 0 none of the bodies may be driven.
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
    const REVOLUTES: usize = 0,
    const UNIVERSALS: usize = 0,
    const SUMS: usize = DAMPERS,
    const SOURCES: usize = 0,
    L = (),
    const DRIVEN: usize = 0,
> {
    /// Bodies in scene order.
    pub bodies: [Body<P::Space>; BODIES],
    /// The bodies' states at t = 0.
    pub initial: [BodyState<P>; BODIES],
    /// \[m/s²\] gravity, or empty.
    pub gravity: [P::Vector; GRAVITY],
    /// Groups in the order of their records' sums.
    pub groups: [Group; GROUPS],
    /// \[m\] points of the groups, in the axes of their bodies.
    pub points: [P::Local; POINTS],
    /// TSDAs of the groups.
    pub tsdas: [Tsda<P::Real>; TSDAS],
    /// Point bushings of the groups.
    pub bushings: [PointBushing<P::Real>; BUSHINGS],
    /// \[N·s/m, N·m·s/rad\] damping coefficients of groups and torsion springs.
    pub dampers: [P::Real; DAMPERS],
    /// Torsion springs, summed after all groups.
    pub torsions: [TorsionSpring<P::Space>; TORSIONS],
    /// Loads, summed before all groups.
    pub loads: [Load<P::Space>; LOADS],
    /// Points on lines of the groups.
    pub lines: [PointOnLine<P::Space>; LINES],
    /// Inputs, added after the loads.
    pub inputs: [Input<P>; INPUTS],
    /// Knots of the inputs' tables.
    pub knots: [Knot<P::Real>; KNOTS],
    /// \[m\] clearances of groups.
    pub clearances: [P::Real; CLEARANCES],
    /// Revolute joints of bushings of the groups.
    pub revolutes: [Revolute<P::Space>; REVOLUTES],
    /// Universal joints of the groups.
    pub universals: [Universal<P::Space>; UNIVERSALS],
    /// Sources that drive inputs.
    pub sources: [Source<P>; SOURCES],
    /// The list of laws: a tuple of tables, each the rows of one law, see [`crate::laws`].
    pub laws: L,
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
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
    const SUMS: usize,
    const SOURCES: usize,
    L: Laws<P>,
    const DRIVEN: usize,
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
        REVOLUTES,
        UNIVERSALS,
        SUMS,
        SOURCES,
        L,
        DRIVEN,
    >
{
    /// Checks every index of the model; in a `const` at compile time.
    ///
    /// # Panics
    /// Where a group, spring or load refers to a body, point, element or damper that does not exist. A step of an
    /// unchecked model skips such an element.
    #[must_use]
    pub const fn checked(self) -> Self {
        assert!(BODIES > 0, "a model needs at least one body");
        assert!(BODIES <= BodyIndex::FIRST_ANCHOR as usize, "a model has at most 65280 bodies");
        let sums = (DAMPERS > 0 || L::DAMPED) && <P::PassSum as PassSum<P::Space>>::APART;
        assert!(!sums || SUMS >= BODIES, "a damped model needs one sum per body: SUMS = BODIES");
        assert!(GRAVITY <= 1, "a model has at most one gravity vector");
        let mut i = 0;
        while i < GROUPS {
            let group = &self.groups[i];
            check_pair(group.a, group.b, BODIES);
            assert!(group.triples >= 1, "a group needs at least one spring triple");
            assert!(
                group.law.takes_arms(group.arms),
                "the law does not accept this number of legs"
            );
            let bushing = matches!(group.law, Law::PointBushing);
            assert!(!(bushing && group.shared), "point bushings cannot share points");
            let elements = group.elements();
            assert!(
                group.point as usize + group.points() <= POINTS,
                "a point of a group does not exist"
            );
            let count = match group.law {
                Law::Tsda => TSDAS,
                Law::PointBushing => BUSHINGS,
                Law::PointOnLine => LINES,
                Law::Revolute => {
                    assert!(elements == 1, "a revolute joint needs a group of its own");
                    REVOLUTES
                }
                Law::Universal => {
                    assert!(elements == 1, "a universal joint needs a group of its own");
                    UNIVERSALS
                }
            };
            assert!(
                group.element as usize + elements <= count,
                "an element of a group does not exist"
            );
            check_damper(group.damper, elements, DAMPERS);
            self.check_anchor(group.a);
            self.check_anchor(group.b);
            if let Some(row) = group.clearance.row() {
                assert!(row < CLEARANCES, "the clearance of a group does not exist");
            }
            i += 1;
        }
        i = 0;
        while i < TORSIONS {
            let spring = &self.torsions[i];
            check_pair(spring.a, spring.b, BODIES);
            self.check_anchor(spring.a);
            self.check_anchor(spring.b);
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
                InputKind::Force { body, .. }
                | InputKind::Torque { body, .. }
                | InputKind::Velocity { body, .. }
                | InputKind::AngularVelocity { body, .. } => {
                    assert!(body.row() < BODIES, "the body of an input does not exist");
                }
                InputKind::JointTorque { a, b, .. } | InputKind::JointForce { a, b, .. } => {
                    check_pair(*a, *b, BODIES);
                }
                InputKind::Actuator { group, element } => {
                    assert!(group.row() < GROUPS, "the group of an actuator does not exist");
                    let elements = self.groups[group.row()].elements();
                    assert!(
                        (*element as usize) < elements,
                        "the element of an actuator does not exist"
                    );
                }
                InputKind::Gravity { .. } | InputKind::Signal | InputKind::Anchor { .. } => {}
            }
            i += 1;
        }
        i = 0;
        while i < SOURCES {
            let source = &self.sources[i];
            assert!((source.input.0 as usize) < INPUTS, "the input of a source does not exist");
            let knots = self.inputs[source.input.0 as usize].knots;
            assert!(knots == 0, "an input has a source and a table");
            let end = source.knot as usize + source.knots as usize;
            assert!(end <= KNOTS, "a knot of a source does not exist");
            i += 1;
        }
        i = 0;
        while i < LOADS {
            assert!(self.loads[i].body.row() < BODIES, "the body of a load does not exist");
            i += 1;
        }
        self
    }

    /// Ground that an input moves names an input that moves ground.
    const fn check_anchor(&self, body: BodyIndex) {
        if let Some(row) = body.anchor_row() {
            assert!(row < INPUTS, "the input of an anchor does not exist");
            let moves = matches!(&self.inputs[row].kind, InputKind::Anchor { .. });
            assert!(moves, "the input of an anchor does not move the ground");
        }
    }
}

const fn check_pair(a: BodyIndex, b: BodyIndex, bodies: usize) {
    assert!(a.is_world() || a.row() < bodies, "the first body of an element does not exist");
    assert!(b.is_world() || b.row() < bodies, "the second body of an element does not exist");
    let ground = a.is_world() && b.is_world();
    assert!(a.0 != b.0 && !ground, "an element must join two different bodies");
}

const fn check_damper(damper: DamperIndex, elements: usize, dampers: usize) {
    if let Some(row) = damper.row() {
        assert!(row + elements <= dampers, "the damping coefficient of an element does not exist");
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
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
    const SUMS: usize,
    const SOURCES: usize,
    L: Laws<P>,
    const DRIVEN: usize,
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
        REVOLUTES,
        UNIVERSALS,
        SUMS,
        SOURCES,
        L,
        DRIVEN,
    >
{
    type Precision = P;
    type Terms = CountedTerms<
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        GRAVITY,
        LOADS,
        LINES,
        INPUTS,
        CLEARANCES,
        REVOLUTES,
        UNIVERSALS,
        SOURCES,
        L,
        DRIVEN,
    >;
    type PerBody<T: Copy> = [T; BODIES];
    type PerDampedBody<T: Copy> = [T; SUMS];
    type PerTorsion = [i32; TORSIONS];
    type PerLoad = [LoadWindow; LOADS];
    type PerInput<T: Copy> = [T; INPUTS];
    type PerDamper<T: Copy> = [T; DAMPERS];
    type PerTsda<T: Copy> = [T; TSDAS];
    type PerPair<T: Copy> = [T; 0];
    type PerSlot<T: Copy> = [T; 0];
    type PerKnot = [KnotStep<P::Real>; KNOTS];
    type PerSource = [SourceStep; SOURCES];

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
            revolutes: &self.revolutes,
            universals: &self.universals,
            sources: &self.sources,
            laws: &self.laws,
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
    fn per_damped_body<T: Copy>(&self, value: T) -> [T; SUMS] {
        [value; SUMS]
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
    fn per_input<T: Copy>(&self, value: T) -> [T; INPUTS] {
        [value; INPUTS]
    }

    #[inline]
    fn per_damper<T: Copy>(&self, value: T) -> [T; DAMPERS] {
        [value; DAMPERS]
    }

    #[inline]
    fn per_tsda<T: Copy>(&self, value: T) -> [T; TSDAS] {
        [value; TSDAS]
    }

    #[inline]
    fn per_pair<T: Copy>(&self, _: T) -> [T; 0] {
        []
    }

    #[inline]
    fn per_slot<T: Copy>(&self, _: T) -> [T; 0] {
        []
    }

    #[inline]
    fn per_knot(&self) -> [KnotStep<P::Real>; KNOTS] {
        [KnotStep { first: 0, offset: P::Real::ZERO }; KNOTS]
    }

    #[inline]
    fn per_source(&self) -> [SourceStep; SOURCES] {
        [SourceStep { phase: 0, advance: 0 }; SOURCES]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::F32;
    use crate::model_spec::{ModelSpec, Spring, Start};

    const fn hung(damping: f64) -> ModelSpec {
        let spring = Spring { stiffness: 1e3, damping, free_length: 1.0 };
        ModelSpec::new()
            .body(1.0, [0.1; 3], Start::at([1.0, 0.0, 0.0]))
            .body(1.0, [0.1; 3], Start::at([3.0, 0.0, 0.0]))
            .tsda([BodyIndex::WORLD, BodyIndex(0)], [[0.0; 3]; 2], spring)
    }

    const BARE: ModelSpec = hung(0.0);
    const DAMPED: ModelSpec = hung(1.0);
    crate::model!(static BARE_F32: F32 = BARE);
    crate::model!(static DAMPED_F32: F32 = DAMPED);

    /// Two bodies and one damper: as many sums as bodies, and none without a damper.
    #[test]
    fn a_model_without_dampers_has_no_sums() {
        assert_eq!(BARE_F32.per_damped_body(0).len(), 0);
        assert_eq!(DAMPED_F32.per_damped_body(0).len(), 2);
    }

    #[test]
    #[should_panic(expected = "SUMS = BODIES")]
    fn too_few_sums_are_refused() {
        let Model { bodies, initial, gravity, groups, points, tsdas, bushings, .. } = DAMPED_F32;
        let Model { dampers, torsions, loads, lines, inputs, knots, .. } = DAMPED_F32;
        let Model { clearances, revolutes, universals, .. } = DAMPED_F32;
        // The default is as many as dampers.
        let short: Model<F32, 2, 1, 2, 1, 0, 1> = Model {
            bodies,
            initial,
            gravity,
            groups,
            points,
            tsdas,
            bushings,
            dampers,
            torsions,
            loads,
            lines,
            inputs,
            knots,
            clearances,
            revolutes,
            universals,
            sources: [],
            laws: (),
        };
        let _ = short.checked();
    }
}
