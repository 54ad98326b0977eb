//! Inputs of a model under construction: driven by the caller, or by a table.

use crate::builder::{BuildError, ModelBuilder, Part, Quantity, check, finite, room};
use crate::elements::input::{Input, InputKind, Knot};
use crate::geometry::Geometry;
use crate::index::InputIndex;
use crate::real::Real;
use crate::space::Linear as _;

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
>
    ModelBuilder<
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
    /// Adds an input that the caller drives, with the initial `value`.
    ///
    /// # Errors
    /// [`BuildError::Full`], an unknown body, a point, direction or value that is not finite.
    pub fn add_input(&mut self, kind: InputKind<P>, value: f64) -> Result<InputIndex, BuildError> {
        match &kind {
            InputKind::Force { body, .. }
            | InputKind::Torque { body, .. }
            | InputKind::Velocity { body, .. }
            | InputKind::AngularVelocity { body, .. } => {
                if body.row() >= self.bodies.len() {
                    return Err(BuildError::UnknownBody(*body));
                }
            }
            InputKind::JointTorque { a, b, .. } | InputKind::JointForce { a, b, .. } => {
                self.check_pair([*a, *b])?;
            }
            InputKind::Actuator { group, element } => {
                let known = self.groups.get(group.row());
                let there = known.is_some_and(|g| (*element as usize) < g.elements());
                check(there, Quantity::Arms)?;
            }
            InputKind::Gravity { .. } | InputKind::Signal | InputKind::Anchor { .. } => {}
        }
        match &kind {
            InputKind::Force { point, direction, .. } => {
                check(finite(&P::local_to_f64(point)), Quantity::Point)?;
                check(direction.is_finite(), Quantity::Axis)?;
            }
            InputKind::Torque { axis, .. } | InputKind::AngularVelocity { axis, .. } => {
                check(axis.is_finite(), Quantity::Axis)?;
            }
            InputKind::JointForce { point, axis, .. } => {
                check(finite(&P::local_to_f64(point)), Quantity::Point)?;
                check(axis.is_finite(), Quantity::Axis)?;
            }
            InputKind::JointTorque { axes, .. } => {
                check(axes.iter().all(|axis| axis.is_finite()), Quantity::Axis)?;
            }
            InputKind::Gravity { direction }
            | InputKind::Velocity { direction, .. }
            | InputKind::Anchor { direction } => {
                check(direction.is_finite(), Quantity::Axis)?;
            }
            InputKind::Actuator { .. } | InputKind::Signal => {}
        }
        check(P::Real::from_f64(value).is_finite(), Quantity::Load)?;
        room(&self.inputs, 1, Part::Inputs)?;
        let index = InputIndex(self.inputs.len() as u16);
        let range = [-f64::INFINITY, f64::INFINITY].map(P::Real::from_f64);
        let input = Input { kind, value: P::Real::from_f64(value), knot: 0, knots: 0, range };
        let _ = self.inputs.push(input);
        Ok(index)
    }

    /// Adds an input that follows a table of (time \[s\], value) with ascending times, held after each knot or linear
    /// in between.
    ///
    /// # Errors
    /// As [`Self::add_input`]; [`Quantity::Window`] where times do not ascend, [`Quantity::Load`] where a value or an
    /// interpolated value is not representable in the precision.
    pub fn add_table(
        &mut self,
        kind: InputKind<P>,
        table: &[[f64; 2]],
        linear: bool,
    ) -> Result<InputIndex, BuildError> {
        let ascending = table.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        let known = table.iter().all(|knot| finite(knot));
        check(!table.is_empty() && ascending && known, Quantity::Window)?;
        let knot = |i| Knot::<P::Real>::of_table(table, i, linear);
        let held = |i| knot(i).is_some_and(|now| now.is_finite(knot(i + 1).as_ref()));
        check((0..table.len()).all(held), Quantity::Load)?;
        room(&self.knots, table.len(), Part::Knots)?;
        let index = self.add_input(kind, 0.0)?;
        if let Some(input) = self.inputs.get_mut(index.0 as usize) {
            input.knot = self.knots.len() as u16;
            input.knots = table.len() as u16;
        }
        for knot in (0..table.len()).filter_map(knot) {
            let _ = self.knots.push(knot);
        }
        Ok(index)
    }
}
