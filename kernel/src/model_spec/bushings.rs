//! Joints of bushings in a sketch: revolutes, and universal joints without a spider.

use crate::elements::element::Law;
use crate::elements::revolute::Revolute;
use crate::elements::universal::Universal;
use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
use crate::model::Group;
use crate::model_spec::{ModelSpec, assert_not_negative, assert_unit, dot, point, vector};
use crate::vector::Vec3;

impl ModelSpec {
    /// A revolute joint of bushings: a point \[m\] and a unit axis of each body in its own axes, `stiffness` \[N/m\]
    /// and `damping` \[N·s/m\] across the axis, `ratio` times as much along it, and the `lever` arm \[m\] at which they
    /// align the axes.
    ///
    /// # Panics
    /// Where a number is out of range or a list is full.
    #[must_use]
    pub const fn revolute(
        self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        axes: [[f64; 3]; 2],
        [lever, ratio]: [f64; 2],
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        assert_unit(dot(axes[0], axes[0]));
        assert_unit(dot(axes[1], axes[1]));
        assert_not_negative(lever);
        assert_not_negative(ratio);
        assert!(lever > 0.0, "the length of a lever is not positive");
        let element = self.revolutes.count;
        let law = Law::Revolute;
        let mut model_spec =
            self.bushing_group(law, between, points, element, [stiffness, damping]);
        let along = (ratio - 1.0) / (lever * lever);
        let levers = [scaled(axes[0], lever), scaled(axes[1], lever)];
        model_spec.revolutes = model_spec.revolutes.push(Revolute { stiffness, along, levers });
        model_spec
    }

    /// A universal joint without a spider: a point \[m\] and a unit axis of each body in its own axes, `stiffness`
    /// \[N/m\], `damping` \[N·s/m\], and the `lever` arm \[m\] at which they keep the axes perpendicular.
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
        assert_unit(dot(axes[0], axes[0]));
        assert_unit(dot(axes[1], axes[1]));
        assert_not_negative(lever);
        let element = self.universals.count;
        let law = Law::Universal;
        let mut model_spec =
            self.bushing_group(law, between, points, element, [stiffness, damping]);
        let (lever, axis) = (scaled(axes[0], lever), vector(axes[1]));
        model_spec.universals = model_spec.universals.push(Universal { stiffness, lever, axis });
        model_spec
    }

    const fn bushing_group(
        mut self,
        law: Law,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        element: usize,
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        assert_not_negative(stiffness);
        assert_not_negative(damping);
        let damper =
            if damping > 0.0 { DamperIndex(self.dampers.count as u16) } else { DamperIndex::NONE };
        self.groups = self.groups.push(Group {
            law,
            a: between[0],
            b: between[1],
            triples: 1,
            arms: 1,
            shared: false,
            point: self.points.count as u16,
            element: element as u16,
            damper,
            clearance: ClearanceIndex::NONE,
        });
        self.points = self.points.push(point(points[0])).push(point(points[1]));
        if damping > 0.0 {
            self.dampers = self.dampers.push(damping);
            let mut row = 1;
            while row < law.damper_rows(1, false) {
                self.dampers = self.dampers.push(0.0);
                row += 1;
            }
        }
        self
    }
}

const fn scaled(axis: [f64; 3], by: f64) -> Vec3<f64> {
    vector([axis[0] * by, axis[1] * by, axis[2] * by])
}
