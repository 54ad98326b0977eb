//! Inputs, and the torsion springs and hinges that read-outs need.

use dbd_kernel::elements::input::{Input, InputKind, Knot};
use dbd_kernel::elements::source::{Source, SourceLaw};
use dbd_kernel::{BodyIndex, F64, InputIndex, TorsionIndex, Vec3};

use crate::assembly::{Assembly, Defect, index};
use crate::drive::{Curve, Drive};
use crate::hinge::Hinge;
use crate::pair::Pair;
use crate::spring::Spring;

/// Axes count as equal if 1 − cos of their angle is less than this.
const SAME_AXIS: f64 = 1e-12;

/// Reasons why a group cannot be an anchor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoAnchor {
    /// Neither of its bodies is the world.
    NoGround,
    /// This input moves it already.
    Taken(usize),
    /// The input comes too late in the scene for its index.
    TooLate,
}

impl Assembly {
    /// Whether inputs, not forces, move a body.
    pub(crate) fn is_driven(&self, body: BodyIndex) -> bool {
        self.model.bodies.get(body.row()).is_some_and(dbd_kernel::Body::is_driven)
    }

    /// The hinge between two bodies about the axis `axis_w` \[world\].
    pub(crate) fn hinge(&self, pair: &Pair, axis_w: Vec3<f64>) -> Hinge {
        Hinge { a: pair.a, b: pair.b, axis: self.vector_in(pair.a, axis_w) }
    }

    /// The hinge of a torsion spring.
    pub(crate) fn torsion_hinge(&self, spring: usize) -> Option<Hinge> {
        let spring = self.model.torsions.get(spring)?;
        Some(Hinge { a: spring.a, b: spring.b, axis: spring.axis })
    }

    /// The torsion spring that counts a hinge's revolutions: an existing one, or a new one without stiffness.
    pub(crate) fn carrier(&mut self, hinge: &Hinge) -> Result<TorsionIndex, Defect> {
        let same = |axis: Vec3<f64>| 1.0 - axis.dot(hinge.axis) < SAME_AXIS;
        let between = self.torsions_between.get(&[hinge.a.0, hinge.b.0]);
        let mut rows = between.into_iter().flatten().copied();
        let known = rows.find(|row| self.model.torsions.get(*row).is_some_and(|s| same(s.axis)));
        let row = known.unwrap_or(self.model.torsions.len());
        if known.is_none() {
            let pair = Pair { a: hinge.a, b: hinge.b, names: Default::default() };
            let spring = Spring { stiffness: 0.0, damping: 0.0, clearance: 0.0 };
            let axis_w = self.direction_w(hinge.a, hinge.axis);
            self.add_torsion_spring(&pair, axis_w, spring, 0.0)?;
        }
        index(row, 0, "torsion springs").map(TorsionIndex)
    }

    /// The number of torsion springs, including those that only count revolutions.
    pub(crate) fn torsions(&self) -> usize {
        self.model.torsions.len()
    }

    /// Transforms a vector from body axes to the world.
    pub(crate) fn direction_w(&self, body: BodyIndex, vector_b: Vec3<f64>) -> Vec3<f64> {
        match self.state(body) {
            Some(state) => state.orientation.rotation().to_world(vector_b),
            None => vector_b,
        }
    }

    /// Lets the next input move the ground's points of a group.
    pub(crate) fn anchor(&mut self, group: usize) -> Result<(), NoAnchor> {
        let row = self.model.inputs.len();
        if row >= usize::from(u16::MAX - BodyIndex::FIRST_ANCHOR) {
            return Err(NoAnchor::TooLate);
        }
        let anchor = BodyIndex::anchor(InputIndex(row as u16));
        let Some(group) = self.model.groups.get_mut(group) else { return Err(NoAnchor::NoGround) };
        let ground = if group.a.is_world() { &mut group.a } else { &mut group.b };
        match ground.anchor_row() {
            Some(other) if other != row => Err(NoAnchor::Taken(other)),
            _ if ground.is_world() => {
                *ground = anchor;
                Ok(())
            }
            _ => Err(NoAnchor::NoGround),
        }
    }

    /// Adds an input.
    pub(crate) fn add_input(
        &mut self,
        kind: InputKind<F64>,
        drive: &Drive,
        range: [f64; 2],
    ) -> Result<InputIndex, Defect> {
        let row = index(self.model.inputs.len(), 1, "inputs")?;
        let input = InputIndex(row);
        let value = if let Drive::Caller(value) = drive { *value } else { 0.0 };
        let (knot, knots) = match drive {
            Drive::Table(curve) => self.add_knots(curve, curve.knots.len())?,
            _ => (0, 0),
        };
        self.model.inputs.push(Input { kind, value, knot, knots, range });
        match drive {
            Drive::Sine(sine) => {
                index(self.model.sources.len(), 1, "sources of inputs")?;
                self.model.sources.push(Source::sine(input, *sine));
            }
            Drive::Periodic(curve) => {
                let [first, .., last] = curve.knots[..] else { return Ok(input) };
                self.add_source(input, SourceLaw::Periodic { period: last[0] - first[0] }, curve)?;
            }
            Drive::Caller(_) | Drive::Table(_) | Drive::Over => {}
        }
        Ok(input)
    }

    /// Sets the value of an input at t = 0, also where a table drives it.
    pub(crate) fn start_input(&mut self, input: InputIndex, value: f64) {
        if let Some(input) = self.model.inputs.get_mut(usize::from(input.0)) {
            input.value = value;
        }
    }

    /// Lets an input follow a periodic table or a table over a read-out.
    pub(crate) fn add_source(
        &mut self,
        input: InputIndex,
        law: SourceLaw<F64>,
        curve: &Curve,
    ) -> Result<(), Defect> {
        index(self.model.sources.len(), 1, "sources of inputs")?;
        // The last knot of a period is its end.
        let ends = usize::from(matches!(law, SourceLaw::Periodic { .. }));
        let (knot, knots) = self.add_knots(curve, curve.knots.len() - ends)?;
        self.model.sources.push(Source { input, knot, knots, law });
        Ok(())
    }

    /// Adds the first `count` knots of a table and returns their first row and number.
    fn add_knots(
        &mut self,
        Curve { knots, linear }: &Curve,
        count: usize,
    ) -> Result<(u16, u16), Defect> {
        let first = index(self.model.knots.len(), count, "knots")?;
        let rows = (0..count).filter_map(|i| Knot::of_table(knots, i, *linear));
        self.model.knots.extend(rows);
        Ok((first, count as u16))
    }
}
