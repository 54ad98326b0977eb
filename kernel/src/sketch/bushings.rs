//! Bushings of joints in a sketch: axial ones, and universal joints without a spider.

use crate::elements::axial_bushing::AxialBushing;
use crate::elements::element::Law;
use crate::elements::universal::Universal;
use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
use crate::model::Group;
use crate::sketch::{Sketch, assert_not_negative, assert_unit, dot, point, vector};

impl Sketch {
    /// The bushings of one joint: each of the `centres` \[m\] of the first body to its own of the `tips`
    /// \[m\] of the second, `stiffness` \[N/m\] and `damping` \[N·s/m\] across the unit `axis` (first
    /// body's axes), `ratio` times as much along it.
    ///
    /// # Panics
    /// Where a number is out of range or a list is full; there are as many centres as tips.
    #[must_use]
    pub const fn axial_bushings(
        self,
        between: [BodyIndex; 2],
        [centres, tips]: [&[[f64; 3]]; 2],
        axis: [f64; 3],
        ratio: f64,
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        assert_unit(dot(axis, axis));
        assert_not_negative(ratio);
        let element = self.axials.count;
        let mut sketch = self.bushing_group(
            Law::AxialBushing,
            between,
            [centres, tips],
            element,
            [stiffness, damping],
        );
        let mut i = 0;
        while i < centres.len() {
            let bushing = AxialBushing { axis: vector(axis), stiffness, ratio };
            sketch.axials = sketch.axials.push(bushing);
            i += 1;
        }
        sketch
    }

    /// A universal joint without a spider: a point \[m\] and a unit axis of either body in its own axes,
    /// `stiffness` \[N/m\], `damping` \[N·s/m\], and the `lever` \[m\] at which they hold the axes
    /// perpendicular.
    ///
    /// # Panics
    /// Where a number is out of range or a list is full.
    #[must_use]
    pub const fn universal(
        self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        axes: [[f64; 3]; 2],
        lever: f64,
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        let [[x, y, z], axis] = axes;
        assert_unit(dot(axes[0], axes[0]));
        assert_unit(dot(axis, axis));
        assert_not_negative(lever);
        let element = self.universals.count;
        let ends = [&[points[0]] as &[_], &[points[1]]];
        let mut sketch =
            self.bushing_group(Law::Universal, between, ends, element, [stiffness, damping]);
        let levers = vector([x * lever, y * lever, z * lever]);
        let universal = Universal { stiffness, lever: levers, axis: vector(axis) };
        sketch.universals = sketch.universals.push(universal);
        sketch
    }

    const fn bushing_group(
        mut self,
        law: Law,
        between: [BodyIndex; 2],
        [centres, tips]: [&[[f64; 3]]; 2],
        element: usize,
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        assert_not_negative(stiffness);
        assert_not_negative(damping);
        assert!(centres.len() == tips.len(), "a bushing has a point of either body");
        assert!(!centres.is_empty() && centres.len() <= 255, "a joint has 1 to 255 centres");
        let damper =
            if damping > 0.0 { DamperIndex(self.dampers.count as u16) } else { DamperIndex::NONE };
        self.groups = self.groups.push(Group {
            law,
            a: between[0],
            b: between[1],
            stars: centres.len() as u8,
            arms: 1,
            shared: false,
            point: self.points.count as u16,
            element: element as u16,
            damper,
            clearance: ClearanceIndex::NONE,
        });
        let mut i = 0;
        while i < centres.len() {
            self.points = self.points.push(point(centres[i]));
            i += 1;
        }
        i = 0;
        while i < tips.len() {
            self.points = self.points.push(point(tips[i]));
            if damping > 0.0 {
                self.dampers = self.dampers.push(damping);
            }
            i += 1;
        }
        self
    }
}
