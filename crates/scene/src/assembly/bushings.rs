//! Elements of zero length: point bushings, revolute joints of bushings, universal joints without a spider.

use dbd_kernel::model::Law;
use dbd_kernel::{PointBushing, Revolute, Universal, Vec3};

use crate::assembly::{Assembly, Defect, Points, index};
use crate::pair::Pair;
use crate::spring::Spring;

impl Assembly {
    /// Adds a group of point bushings, one per centre; `size` \[m\] is that of the joint, 0 for a raw element.
    pub(crate) fn add_bushings(
        &mut self,
        pair: &Pair,
        points: Points<'_>,
        size: f64,
        spring: Spring,
    ) -> Result<(), Defect> {
        let (count, number) = (points.elements(), self.model.groups.len());
        let element = index(self.model.bushings.len(), count, "point bushings")?;
        self.add_group(Law::PointBushing, pair, points, element, spring)?;
        self.sizes.insert(number, size);
        let bushing = PointBushing::from_f64(spring.stiffness);
        self.model.bushings.extend(std::iter::repeat_n(bushing, count));
        Ok(())
    }

    /// Adds a revolute joint of bushings. `lever_w` is the axis in the world with the lever arm \[m\] as its length,
    /// `ratio` the axial stiffness over the radial one.
    pub(crate) fn add_revolute(
        &mut self,
        pair: &Pair,
        at_w: Vec3<f64>,
        (lever_w, ratio): (Vec3<f64>, f64),
        size: f64,
        spring: Spring,
    ) -> Result<(), Defect> {
        let number = self.model.groups.len();
        let element = index(self.model.revolutes.len(), 1, "revolute joints of bushings")?;
        let along = (ratio - 1.0) / lever_w.dot(lever_w);
        if !(along.is_finite() && (ratio * spring.stiffness).is_finite()) {
            return Err(Defect::OutOfRange);
        }
        let [centre, tip] = [pair.a, pair.b].map(|body| [self.point_in(body, at_w)]);
        let points = Points { centres: &centre, tips: &tip, shared: false };
        self.add_group(Law::Revolute, pair, points, element, spring)?;
        self.sizes.insert(number, size);
        let levers = [pair.a, pair.b].map(|body| self.vector_in(body, lever_w).to_f64());
        self.model.revolutes.push(Revolute::from_f64(spring.stiffness, along, levers));
        Ok(())
    }

    /// Records the mass \[kg\] that the joint of the last group does not use.
    pub(crate) fn leave_out(&mut self, mass: f64) {
        self.left_out.insert(self.model.groups.len() - 1, mass);
    }

    /// \[kg\] mass that the joint of a group does not use.
    pub(crate) fn mass_left_out(&self, number: usize) -> f64 {
        self.left_out.get(&number).copied().unwrap_or(0.0)
    }

    /// Adds a universal joint without a spider: the axis of the first body with the lever arm \[m\] as its length,
    /// and that of the second, each in body axes.
    pub(crate) fn add_universal(
        &mut self,
        pair: &Pair,
        at_w: Vec3<f64>,
        [lever, axis]: [Vec3<f64>; 2],
        size: f64,
        spring: Spring,
    ) -> Result<(), Defect> {
        let number = self.model.groups.len();
        let element = index(self.model.universals.len(), 1, "universal joints")?;
        let [centre, tip] = [pair.a, pair.b].map(|body| [self.point_in(body, at_w)]);
        let points = Points { centres: &centre, tips: &tip, shared: false };
        self.add_group(Law::Universal, pair, points, element, spring)?;
        self.sizes.insert(number, size);
        let universal = Universal::from_f64(spring.stiffness, lever.to_f64(), axis.to_f64());
        self.model.universals.push(universal);
        Ok(())
    }
}
