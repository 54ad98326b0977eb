//! A bushing with a full stiffness matrix K, stiffness-proportional damping and preload p.
//!
//! With the coordinates e of [`super::Bushing`], `eᵢ·d` and `2·vᵢ`: `E = ½·eᵀ·K·e − pᵀ·e`, exact at any rotation (Masarati
//! & Morandini, Multibody System Dynamics 23 (2010) 361). By `K = L·D·Lᵀ` it is six springs, and the damping `t·K` six
//! dampers, along the columns of L.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::deflection::{
    Deflected, LOADS, Mount, Sixfold, coefficients, each, flat, sixfold,
};
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::real::Real;

law! {
    /// A bushing with a full symmetric stiffness matrix in axes of the first body, proportional damping and preload.
    pub struct BushingMatrix = "bushing-matrix" {
        /// A point of the first body and one of the second, at the same place where the bushing is not deflected.
        points: Points,
        /// First axis, perpendicular to `z`; the second is z × x.
        x: Normal,
        /// Third axis. The bushing is not twisted at t = 0.
        z: Axis,
        /// Stiffness of displacements along x, y, z and of rotations about x, y, z; positive semi-definite.
        matrix: Matrix("N/m", "N/rad", "N", "N·m/rad"),
        /// The damping matrix is this time times the stiffness matrix.
        damping_time: Number("s") = 0.0,
        /// Force on the second body along x without deflection.
        preload_x: Number("N") = 0.0,
        /// Force on the second body along y without deflection.
        preload_y: Number("N") = 0.0,
        /// Force on the second body along z without deflection.
        preload_z: Number("N") = 0.0,
        /// Torque on the second body about x without deflection.
        turn_preload_x: Number("N·m") = 0.0,
        /// Torque on the second body about y without deflection.
        turn_preload_y: Number("N·m") = 0.0,
        /// Torque on the second body about z without deflection.
        turn_preload_z: Number("N·m") = 0.0,
    }
}

impl<P: Geometry> BushingMatrix<P> {
    #[inline(always)]
    fn mount(&self) -> Mount<'_, P> {
        Mount { points: &self.points, x: self.x, z: &self.z }
    }

    #[inline(always)]
    fn preload(&self) -> Sixfold<P::Real> {
        [
            [self.preload_x, self.preload_y, self.preload_z],
            [self.turn_preload_x, self.turn_preload_y, self.turn_preload_z],
        ]
    }

    /// \[N, N·m\]
    #[inline(always)]
    fn forces(&self, deflected: &Deflected<P>) -> Sixfold<P::Real> {
        let elastic = self.matrix.loads(self.matrix.along(flat(deflected.values())));
        each(sixfold(elastic), self.preload(), |elastic, preload| elastic - preload)
    }
}

impl<P: Geometry> Interaction<P> for BushingMatrix<P> {
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
        let (mut twice, mut preload) = (P::Real::ZERO, P::Real::ZERO);
        for (stiffness, value) in self.matrix.diagonal.into_iter().zip(self.matrix.along(values)) {
            twice = twice + stiffness * (value * value);
        }
        for (force, value) in flat(self.preload()).into_iter().zip(values) {
            preload = preload + force * value;
        }
        P::Real::HALF * twice - preload
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let deflected = self.mount().deflected(seen);
        for (stiffness, column) in self.matrix.diagonal.into_iter().zip(self.matrix.columns()) {
            visit(stiffness, &deflected.sum(seen, deflected.gradients, sixfold(column)));
        }
        let forces = self.forces(&deflected);
        deflected.tangent(seen, [[P::Real::ZERO; 3]; 2], forces, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.damping_time != P::Real::ZERO
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        if !Interaction::<P>::is_damped(self) {
            return (0..6).for_each(|_| visit(Damper::idle()));
        }
        let deflected = self.mount().deflected(seen);
        let known = flat(coefficients::<P>(sixfold(self.matrix.diagonal)));
        for (stiffness, column) in known.into_iter().zip(self.matrix.columns()) {
            let direction = deflected.sum(seen, deflected.axes, sixfold(column));
            visit(Damper::new(self.damping_time * stiffness, direction));
        }
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        self.mount().check()?;
        let definite = self.matrix.diagonal.iter().all(|stiffness| *stiffness >= zero);
        let expected = "a positive semi-definite matrix";
        Wrong::unless(definite, "matrix", "is not positive semi-definite", expected)?;
        let acts = self.matrix.diagonal.iter().any(|stiffness| *stiffness > zero);
        Wrong::unless(acts, "matrix", "is 0", "a matrix with a stiffness > 0")?;
        Wrong::unless(self.damping_time >= zero, "damping_time", "is negative", "a time ≥ 0")
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let deflected = self.mount().deflected(seen);
        let rates = self.matrix.along(deflected.rates(seen, deflected.axes));
        let damped = sixfold(self.matrix.loads(rates));
        let sum = each(self.forces(&deflected), damped, |force, damped| {
            force + self.damping_time * damped
        });
        flat(sum).into_iter().nth(quantity).unwrap_or(P::Real::ZERO)
    }
}
