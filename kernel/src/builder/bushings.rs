//! Joints of bushings in a model under construction: revolutes, and universal joints without a spider.

use crate::builder::{BuildError, ModelBuilder, Part, Quantity, check, finite, length, room};
use crate::elements::revolute::Revolute;
use crate::elements::universal::Universal;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, ClearanceIndex};
use crate::model::{Group, Law};
use crate::space::Space as _;

/// Properties common to all bushing joints.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct BushingLaw {
    /// \[N/m\] stiffness, ≥ 0; of a revolute joint that across its axis.
    pub stiffness: f64,
    /// \[N·s/m\] damping, ≥ 0, likewise.
    pub damping: f64,
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
    /// Adds a revolute joint of bushings: a point \[m\] and an axis of each body in its own axes, the `lever` arm \[m\]
    /// at which the stiffness aligns the axes, and `ratio` ≥ 0, the axial stiffness over the radial stiffness.
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, an unknown body, a quantity out of range.
    pub fn add_revolute(
        &mut self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        axes: [[f64; 3]; 2],
        [lever, ratio]: [f64; 2],
        law: BushingLaw,
    ) -> Result<(), BuildError> {
        let levers = levers(axes, [lever; 2])?;
        check(lever > 0.0 && ratio >= 0.0 && ratio.is_finite(), Quantity::Stiffness)?;
        room(&self.revolutes, 1, Part::Revolutes)?;
        let element = self.revolutes.len();
        self.add_bushing_group(Law::Revolute, between, points, element, law)?;
        let along = (ratio - 1.0) / (lever * lever);
        // The capacity was checked above.
        let _ = self.revolutes.push(Revolute::from_f64(law.stiffness, along, levers));
        Ok(())
    }

    /// Adds a universal joint without a spider: a point \[m\] and an axis of each body in its own axes, and the `lever`
    /// arm \[m\] at which the stiffness keeps the axes perpendicular.
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, an unknown body, a quantity out of range.
    pub fn add_universal(
        &mut self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        axes: [[f64; 3]; 2],
        lever: f64,
        law: BushingLaw,
    ) -> Result<(), BuildError> {
        let [lever, axis] = levers(axes, [lever, 1.0])?;
        room(&self.universals, 1, Part::Universals)?;
        let element = self.universals.len();
        self.add_bushing_group(Law::Universal, between, points, element, law)?;
        let _ = self.universals.push(Universal::from_f64(law.stiffness, lever, axis));
        Ok(())
    }

    /// Adds the group of one point on each body.
    fn add_bushing_group(
        &mut self,
        law: Law,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        element: usize,
        BushingLaw { stiffness, damping }: BushingLaw,
    ) -> Result<(), BuildError> {
        self.check_pair(between)?;
        check(stiffness >= 0.0 && stiffness.is_finite(), Quantity::Stiffness)?;
        check(damping >= 0.0 && damping.is_finite(), Quantity::Damping)?;
        check(finite(points.as_flattened()), Quantity::Point)?;
        room(&self.groups, 1, Part::Groups)?;
        room(&self.points, 2, Part::Points)?;
        let damper = self.add_dampers(damping, 1, law.damper_rows(1, P::Space::PLANAR))?;
        let _ = self.groups.push(Group {
            law,
            a: between[0],
            b: between[1],
            triples: 1,
            arms: 1,
            shared: false,
            point: self.points.len() as u16,
            element: element as u16,
            damper,
            clearance: ClearanceIndex::NONE,
        });
        for point in points {
            let _ = self.points.push(P::local_from_f64(point));
        }
        Ok(())
    }
}

/// Axes of these lengths \[m\].
fn levers(axes: [[f64; 3]; 2], lengths: [f64; 2]) -> Result<[[f64; 3]; 2], BuildError> {
    let norms = axes.map(length);
    check(norms.iter().all(|norm| *norm > 0.0 && norm.is_finite()), Quantity::Axis)?;
    check(lengths.iter().all(|length| *length >= 0.0 && length.is_finite()), Quantity::Axis)?;
    Ok([0, 1].map(|end| axes[end].map(|c| c / norms[end] * lengths[end])))
}
