//! The builder as owner of its model, stored in vectors of fixed capacity.

use heapless::Vec;

use crate::body::BodyState;
use crate::builder::ModelBuilder;
use crate::geometry::Geometry;
use crate::model::{AllTerms, ModelOwner, ModelRef};
use crate::schedule::{KnotStep, LoadWindow};
use crate::sources::SourceStep;

impl<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize,
    const POINTS: usize,
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const KNOTS: usize,
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
> ModelOwner
    for ModelBuilder<
        P,
        BODIES,
        GROUPS,
        POINTS,
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        LOADS,
        LINES,
        INPUTS,
        KNOTS,
        REVOLUTES,
        UNIVERSALS,
    >
{
    type Precision = P;
    type Terms = AllTerms;
    type PerBody<T: Copy> = Vec<T, BODIES>;
    type PerDampedBody<T: Copy> = Vec<T, BODIES>;
    type PerTorsion = Vec<i32, TORSIONS>;
    type PerLoad = Vec<LoadWindow, LOADS>;
    type PerInput<T: Copy> = Vec<T, INPUTS>;
    type PerDamper<T: Copy> = Vec<T, DAMPERS>;
    type PerTsda<T: Copy> = Vec<T, TSDAS>;
    type PerPair<T: Copy> = [T; 0];
    type PerSlot<T: Copy> = [T; 0];
    type PerKnot = Vec<KnotStep<P::Real>, KNOTS>;
    type PerSource = [SourceStep; 0];

    fn view(&self) -> ModelRef<'_, P, AllTerms> {
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
            sources: &[],
            laws: &(),
        }
    }

    fn initial(&self) -> &[BodyState<P>] {
        &self.initial
    }

    fn per_body<T: Copy>(&self, value: T) -> Vec<T, BODIES> {
        self.bodies.iter().map(|_| value).collect()
    }

    fn per_damped_body<T: Copy>(&self, value: T) -> Vec<T, BODIES> {
        self.per_body(value)
    }

    fn per_torsion(&self) -> Vec<i32, TORSIONS> {
        self.torsions.iter().map(|_| 0).collect()
    }

    fn per_load(&self) -> Vec<LoadWindow, LOADS> {
        self.loads.iter().map(|_| LoadWindow::default()).collect()
    }

    fn per_input<T: Copy>(&self, value: T) -> Vec<T, INPUTS> {
        self.inputs.iter().map(|_| value).collect()
    }

    fn per_damper<T: Copy>(&self, value: T) -> Vec<T, DAMPERS> {
        self.dampers.iter().map(|_| value).collect()
    }

    fn per_tsda<T: Copy>(&self, value: T) -> Vec<T, TSDAS> {
        self.tsdas.iter().map(|_| value).collect()
    }

    fn per_pair<T: Copy>(&self, _: T) -> [T; 0] {
        []
    }

    fn per_slot<T: Copy>(&self, _: T) -> [T; 0] {
        []
    }

    fn per_knot(&self) -> Self::PerKnot {
        self.knots.iter().map(|_| KnotStep::default()).collect()
    }

    fn per_source(&self) -> Self::PerSource {
        []
    }
}
