//! A bushing with six stiffnesses and six dampings in axes of the first body, for rotations of any size.
//!
//! With the displacement d of B's point from A's and the rotation `(w, v)` of B in A since t = 0, as a unit quaternion,
//! the coordinates are `eᵢ·d` and `2·vᵢ`: `E = ½·Σ kᵢ·(eᵢ·d)² + ½·Σ Kᵢ·(2·vᵢ)²`. Rotated about one axis by φ, the torque is
//! `K·sin φ`. Without a singular pose and without trigonometry (compare Masarati & Morandini, Multibody System Dynamics 23
//! (2010) 361).

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::deflection::{
    DAMPINGS, Deflected, LOADS, Mount, STIFFNESSES, Sixfold, any, each, flat,
};
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::real::Real;

law! {
    /// A bushing: six springs and dampers along and about three axes of the first body.
    pub struct Bushing = "bushing" {
        /// A point of the first body and one of the second, at the same place where the bushing is unloaded.
        points: Points,
        /// First axis, perpendicular to `z`; the second is z × x.
        x: Normal,
        /// Third axis. The bushing is not twisted at t = 0.
        z: Axis,
        /// Stiffness along x.
        stiffness_x: Number("N/m"),
        /// Stiffness along y.
        stiffness_y: Number("N/m"),
        /// Stiffness along z.
        stiffness_z: Number("N/m"),
        /// Stiffness of a rotation about x.
        turn_stiffness_x: Number("N·m/rad"),
        /// Stiffness of a rotation about y.
        turn_stiffness_y: Number("N·m/rad"),
        /// Stiffness of a rotation about z.
        turn_stiffness_z: Number("N·m/rad"),
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

impl<P: Geometry> Bushing<P> {
    #[inline(always)]
    fn mount(&self) -> Mount<'_, P> {
        Mount { points: &self.points, x: self.x, z: &self.z }
    }

    #[inline(always)]
    fn deflected(&self, seen: &Seen<'_, P>) -> Deflected<P> {
        self.mount().deflected(seen)
    }

    #[inline(always)]
    fn stiffnesses(&self) -> Sixfold<P::Real> {
        [
            [self.stiffness_x, self.stiffness_y, self.stiffness_z],
            [self.turn_stiffness_x, self.turn_stiffness_y, self.turn_stiffness_z],
        ]
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
        each(self.stiffnesses(), deflected.values(), |stiffness, value| stiffness * value)
    }
}

impl<P: Geometry> Interaction<P> for Bushing<P> {
    type State = NoStorage;
    type Dampers = [(); 6];
    const QUANTITIES: &'static [Quantity] = LOADS;

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let deflected = self.deflected(seen);
        let forces = self.forces(&deflected);
        Some(deflected.force_pair(seen, forces))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let values = self.deflected(seen).values();
        let mut sum = P::Real::ZERO;
        for (stiffness, value) in flat(self.stiffnesses()).into_iter().zip(flat(values)) {
            sum = sum + stiffness * (value * value);
        }
        P::Real::HALF * sum
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let deflected = self.deflected(seen);
        let forces = self.forces(&deflected);
        deflected.tangent(seen, self.stiffnesses(), forces, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        flat(self.dampings()) != [P::Real::ZERO; 6]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        self.deflected(seen).dampers(seen, self.dampings(), visit);
    }

    fn check(&self) -> Result<(), Wrong> {
        self.mount().check()?;
        let stiff = any(self.stiffnesses(), STIFFNESSES)?;
        let acts = any(self.dampings(), DAMPINGS)? || stiff;
        Wrong::unless(acts, "stiffness_x", "is 0 like all others", "above 0, or another of them")
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let deflected = self.deflected(seen);
        deflected.damped(seen, self.forces(&deflected), self.dampings(), quantity)
    }
}
