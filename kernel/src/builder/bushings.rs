//! Bushings of joints in a model under construction: axial ones, and universal joints without a spider.

use crate::builder::{BuildError, ModelBuilder, Part, Quantity, check, finite, length, room};
use crate::elements::axial_bushing::AxialBushing;
use crate::elements::universal::Universal;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, ClearanceIndex};
use crate::model::{Group, Law};

/// What bushings have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BushingLaw {
    /// \[N/m\] stiffness, ≥ 0; of an axial bushing that across its axis.
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
    const AXIALS: usize,
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
        AXIALS,
        UNIVERSALS,
    >
{
    /// Adds axial bushings as one group: each of the `centres` \[m\] of the first body to its own of the
    /// `tips` \[m\] of the second, stiffer by `ratio` ≥ 0 along `axis` (first body's axes).
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, a body that is not there, a quantity out of range.
    pub fn add_axial_bushings(
        &mut self,
        between: [BodyIndex; 2],
        [centres, tips]: [&[[f64; 3]]; 2],
        axis: [f64; 3],
        ratio: f64,
        law: BushingLaw,
    ) -> Result<(), BuildError> {
        let count = centres.len();
        let norm = length(axis);
        check(norm > 0.0 && norm.is_finite(), Quantity::Axis)?;
        check(ratio >= 0.0 && ratio.is_finite(), Quantity::Stiffness)?;
        check(count == tips.len() && (1..=255).contains(&count), Quantity::Arms)?;
        room(&self.axials, count, Part::Axials)?;
        let element = self.axials.len();
        self.add_bushing_group(Law::AxialBushing, between, [centres, tips], element, law)?;
        let bushing = AxialBushing::from_f64(axis.map(|c| c / norm), law.stiffness, ratio);
        for _ in 0..count {
            // Room was made sure of above.
            let _ = self.axials.push(bushing);
        }
        Ok(())
    }

    /// Adds a universal joint without a spider: a point \[m\] and an axis of either body in its own
    /// axes, and the `lever` \[m\] at which the stiffness holds the axes perpendicular.
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, a body that is not there, a quantity out of range.
    pub fn add_universal(
        &mut self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        axes: [[f64; 3]; 2],
        lever: f64,
        law: BushingLaw,
    ) -> Result<(), BuildError> {
        let norms = axes.map(length);
        check(norms.iter().all(|norm| *norm > 0.0 && norm.is_finite()), Quantity::Axis)?;
        check(lever >= 0.0 && lever.is_finite(), Quantity::Stiffness)?;
        room(&self.universals, 1, Part::Universals)?;
        let [centre, tip] = points.map(|point| [point]);
        let element = self.universals.len();
        self.add_bushing_group(Law::Universal, between, [&centre, &tip], element, law)?;
        let levers = axes[0].map(|c| c / norms[0] * lever);
        let axis = axes[1].map(|c| c / norms[1]);
        let _ = self.universals.push(Universal::from_f64(law.stiffness, levers, axis));
        Ok(())
    }

    /// Adds the group of as many bushings as points of either body, from `element` on.
    fn add_bushing_group(
        &mut self,
        law: Law,
        between: [BodyIndex; 2],
        [centres, tips]: [&[[f64; 3]]; 2],
        element: usize,
        BushingLaw { stiffness, damping }: BushingLaw,
    ) -> Result<(), BuildError> {
        self.check_pair(between)?;
        check(stiffness >= 0.0 && stiffness.is_finite(), Quantity::Stiffness)?;
        check(damping >= 0.0 && damping.is_finite(), Quantity::Damping)?;
        let points = centres.iter().chain(tips);
        check(points.clone().all(|point| finite(point)), Quantity::Point)?;
        room(&self.groups, 1, Part::Groups)?;
        room(&self.points, 2 * centres.len(), Part::Points)?;
        let damper = self.add_dampers(damping, centres.len())?;
        let _ = self.groups.push(Group {
            law,
            a: between[0],
            b: between[1],
            stars: centres.len() as u8,
            arms: 1,
            shared: false,
            point: self.points.len() as u16,
            element: element as u16,
            damper,
            clearance: ClearanceIndex::NONE,
        });
        for point in points {
            let _ = self.points.push(P::local_from_f64(*point));
        }
        Ok(())
    }
}
