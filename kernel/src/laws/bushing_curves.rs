//! A bushing with a curve of the force along and of the torque about each axis: progressive rubber, gaps, preload.
//!
//! Of the coordinates of [`super::Bushing`], `eᵢ·d` and `2·vᵢ`, each has a force by its table F; its energy is the area.
//! Rotated about one axis by φ, the torque is `F(2·sin(φ/2))·cos(φ/2)`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::curve::Curve;
use crate::laws::deflection::{DAMPINGS, Deflected, LOADS, Mount, Sixfold, any, flat, sixfold};
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::tabled::rising;
use crate::real::Real;

law! {
    /// A bushing with a table of force over displacement along and of torque over rotation about three axes.
    pub struct BushingCurves = "bushing-curves" {
        /// A point of the first body and one of the second, at the same place where the bushing is not deflected.
        points: Points,
        /// First axis, perpendicular to `z`; the second is z × x.
        x: Normal,
        /// Third axis. The bushing is not twisted at t = 0.
        z: Axis,
        /// Force along x over the displacement, non-decreasing; extrapolated linearly. Its value at 0 is a preload.
        force_x: Table<16>("m", "N") = 0.0,
        /// The same along y.
        force_y: Table<16>("m", "N") = 0.0,
        /// The same along z.
        force_z: Table<16>("m", "N") = 0.0,
        /// Torque about x over the rotation, non-decreasing; extrapolated linearly. Its value at 0 is a preload.
        torque_x: Table<16>("rad", "N·m") = 0.0,
        /// The same about y.
        torque_y: Table<16>("rad", "N·m") = 0.0,
        /// The same about z.
        torque_z: Table<16>("rad", "N·m") = 0.0,
        /// Damping along x.
        damping_x: Number("N·s/m") = 0.0,
        /// Damping along y.
        damping_y: Number("N·s/m") = 0.0,
        /// Damping along z.
        damping_z: Number("N·s/m") = 0.0,
        /// Damping of a rotation about x.
        turn_damping_x: Number("N·m·s/rad") = 0.0,
        /// Damping of a rotation about y.
        turn_damping_y: Number("N·m·s/rad") = 0.0,
        /// Damping of a rotation about z.
        turn_damping_z: Number("N·m·s/rad") = 0.0,
    }
}

/// The names of the tables.
const TABLES: [&str; 6] = ["force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"];

impl<P: Geometry> BushingCurves<P> {
    #[inline(always)]
    fn mount(&self) -> Mount<'_, P> {
        Mount { points: &self.points, x: self.x, z: &self.z }
    }

    #[inline(always)]
    fn curves(&self) -> [&Curve<P::Real, 16>; 6] {
        let Self { force_x, force_y, force_z, torque_x, torque_y, torque_z, .. } = self;
        [force_x, force_y, force_z, torque_x, torque_y, torque_z]
    }

    #[inline(always)]
    fn dampings(&self) -> Sixfold<P::Real> {
        [
            [self.damping_x, self.damping_y, self.damping_z],
            [self.turn_damping_x, self.turn_damping_y, self.turn_damping_z],
        ]
    }

    /// \[N, N·m\]
    #[inline(always)]
    fn forces(&self, deflected: &Deflected<P>) -> Sixfold<P::Real> {
        let mut forces = flat(deflected.values());
        for (force, curve) in forces.iter_mut().zip(self.curves()) {
            *force = curve.at(*force).0;
        }
        sixfold(forces)
    }
}

impl<P: Geometry> Interaction<P> for BushingCurves<P> {
    type State = NoStorage;
    type Dampers = [(); 6];
    const QUANTITIES: &'static [Quantity] = LOADS;

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let deflected = self.mount().deflected(seen);
        let forces = self.forces(&deflected);
        Some(deflected.force_pair(seen, forces))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let values = flat(self.mount().deflected(seen).values());
        let mut sum = P::Real::ZERO;
        for (curve, value) in self.curves().into_iter().zip(values) {
            sum = sum + (curve.area(value) - curve.area(P::Real::ZERO));
        }
        sum
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let deflected = self.mount().deflected(seen);
        let forces = self.forces(&deflected);
        let slopes = sixfold(self.curves().map(Curve::steepest));
        deflected.tangent(seen, slopes, forces, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        flat(self.dampings()) != [P::Real::ZERO; 6]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        self.mount().deflected(seen).dampers(seen, self.dampings(), visit);
    }

    fn check(&self) -> Result<(), Wrong> {
        self.mount().check()?;
        let mut acts = any(self.dampings(), DAMPINGS)?;
        for (curve, name) in self.curves().into_iter().zip(TABLES) {
            rising(curve, name)?;
            acts |= curve.known().iter().any(|[_, force]| *force != P::Real::ZERO);
        }
        Wrong::unless(acts, "force_x", "is 0 like all others", "a table, or give another of them")
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let deflected = self.mount().deflected(seen);
        deflected.damped(seen, self.forces(&deflected), self.dampings(), quantity)
    }
}
