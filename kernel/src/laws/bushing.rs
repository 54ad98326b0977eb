//! A bushing with six stiffnesses and six dampings in axes of the first body, for rotations of any size.
//!
//! With the displacement d of B's point from A's and the rotation `(w, v)` of B in A since t = 0, as a unit quaternion,
//! the coordinates are `eᵢ·d` and `2·vᵢ`: `E = ½·Σ kᵢ·(eᵢ·d)² + ½·Σ Kᵢ·(2·vᵢ)²`. Rotated about one axis by φ, the torque is
//! `K·sin φ`. Without a singular pose and without trigonometry (compare Masarati & Morandini, Multibody System Dynamics 23
//! (2010) 361).

use crate::force_pair::{Direction, ForcePair};
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _, Turn as _, Vector as _};

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

/// How far the axes may be from perpendicular: the cosine of the angle between them.
const SQUARE: f64 = 1e-6;

/// A bushing at a pose.
struct Deflected<P: Geometry> {
    /// Displacements along x, y, z.
    ways: [Coordinate<P>; 3],
    /// Twice the components of the vector of the rotation's quaternion along x, y, z.
    turns: [P::Real; 3],
    /// Their gradients for a rotation of B, axes of A.
    gradients: [P::Moment; 3],
    /// The axes x, y, z as moments, axes of A.
    axes: [P::Moment; 3],
}

impl<P: Geometry> Bushing<P> {
    #[inline(always)]
    fn deflected(&self, seen: &Seen<'_, P>) -> Deflected<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let way = P::displacement(&at_a, &at_b);
        // In the plane the third vector is 0, and so are the first two moments.
        let (x, z) = (self.x, self.z.axis);
        let y = z.cross(x);
        let vectors = [x, y, x.across(y)];
        let axes = [y.cross(vectors[2]), vectors[2].cross(x), z];
        let ways = vectors.map(|axis| {
            let along = seen.a.to_world(axis);
            Coordinate::carried(along.dot(way), along, [arm, way, other])
        });
        let turn = seen.a.turn_of(&seen.b).product(self.z.reference);
        let parts = axes.map(|axis| turn.about(axis));
        let [(w, _), ..] = parts;
        let vector = axes[0] * parts[0].1 + axes[1] * parts[1].1 + axes[2] * parts[2].1;
        let turns = parts.map(|(_, part)| P::Real::TWO * part);
        let gradients = axes.map(|axis| axis * w + vector.commutator(axis));
        Deflected { ways, turns, gradients, axes }
    }

    #[inline(always)]
    fn stiffnesses(&self) -> [[P::Real; 3]; 2] {
        [
            [self.stiffness_x, self.stiffness_y, self.stiffness_z],
            [self.turn_stiffness_x, self.turn_stiffness_y, self.turn_stiffness_z],
        ]
    }

    #[inline(always)]
    fn dampings(&self) -> [[P::Real; 3]; 2] {
        [
            [self.damping_x, self.damping_y, self.damping_z],
            [self.turn_damping_x, self.turn_damping_y, self.turn_damping_z],
        ]
    }
}

impl<P: Geometry> Deflected<P> {
    /// The direction of a rotation about a moment in the axes of A.
    #[inline(always)]
    fn about(seen: &Seen<'_, P>, moment: P::Moment) -> Direction<P::Space> {
        seen.about(seen.a.moment_to_world(moment))
    }
}

/// The names of the fields of stiffnesses and dampings.
const NAMES: [[&str; 3]; 4] = [
    ["stiffness_x", "stiffness_y", "stiffness_z"],
    ["turn_stiffness_x", "turn_stiffness_y", "turn_stiffness_z"],
    ["damping_x", "damping_y", "damping_z"],
    ["turn_damping_x", "turn_damping_y", "turn_damping_z"],
];

impl<P: Geometry> Interaction<P> for Bushing<P> {
    type State = NoStorage;
    type Dampers = [(); 6];
    const QUANTITIES: &'static [Quantity] = &[
        Quantity { name: "force_x", unit: "N" },
        Quantity { name: "force_y", unit: "N" },
        Quantity { name: "force_z", unit: "N" },
        Quantity { name: "torque_x", unit: "N·m" },
        Quantity { name: "torque_y", unit: "N·m" },
        Quantity { name: "torque_z", unit: "N·m" },
    ];

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let Deflected { ways, turns, gradients, .. } = self.deflected(seen);
        let [along, about] = self.stiffnesses();
        let [x, y, z] = ways.map(|way| (way.direction(seen), way.value));
        let [x, y, z] = [(x, along[0]), (y, along[1]), (z, along[2])]
            .map(|((direction, value), stiffness)| seen.pull(&direction, stiffness * value));
        let moment = gradients[0] * (about[0] * turns[0])
            + gradients[1] * (about[1] * turns[1])
            + gradients[2] * (about[2] * turns[2]);
        let turned = seen.pull(&Deflected::about(seen, moment), P::Real::ONE);
        Some(x.with(&y).with(&z).with(&turned))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let Deflected { ways, turns, .. } = self.deflected(seen);
        let [along, about] = self.stiffnesses();
        let values = ways.map(|way| way.value).into_iter().chain(turns);
        let mut sum = P::Real::ZERO;
        for (stiffness, value) in along.into_iter().chain(about).zip(values) {
            sum = sum + stiffness * (value * value);
        }
        P::Real::HALF * sum
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let Deflected { ways, turns, gradients, .. } = self.deflected(seen);
        let [along, about] = self.stiffnesses();
        let mut bent = [P::Real::ZERO; 2];
        for (way, stiffness) in ways.into_iter().zip(along) {
            visit(stiffness, &way.direction(seen));
            let force = (stiffness * way.value).abs();
            let more = way.bent(seen, force, visit);
            bent = [bent[0] + more[0], bent[1] + more[1]];
        }
        for ((turn, gradient), stiffness) in turns.into_iter().zip(gradients).zip(about) {
            visit(stiffness, &Deflected::about(seen, gradient));
            let torque = (stiffness * turn).abs();
            bent = bent.map(|bent| bent + P::Real::HALF * torque);
        }
        bent
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        let Deflected { ways, axes, .. } = self.deflected(seen);
        let [mut along, mut about] = self.dampings();
        if P::Space::PLANAR {
            along[2] = P::Real::ZERO;
            (about[0], about[1]) = (P::Real::ZERO, P::Real::ZERO);
        }
        for (way, damping) in ways.into_iter().zip(along) {
            visit(Damper::new(damping, way.direction(seen)));
        }
        for (axis, damping) in axes.into_iter().zip(about) {
            visit(Damper::new(damping, Deflected::about(seen, axis)));
        }
    }

    fn check(&self) -> Result<(), Wrong> {
        let y = self.z.axis.cross(self.x);
        let square = y.dot(y) >= P::Real::from_f64(1.0 - SQUARE * SQUARE);
        Wrong::unless(square, "x", "is not perpendicular to `z`", "an axis perpendicular to `z`")?;
        let values = self.stiffnesses().into_iter().chain(self.dampings()).zip(NAMES);
        let mut any = false;
        for (value, name) in values.flat_map(|(values, names)| values.into_iter().zip(names)) {
            let holds = value >= P::Real::ZERO;
            Wrong::unless(holds, name, "is negative", "a stiffness or damping ≥ 0")?;
            any |= value > P::Real::ZERO;
        }
        Wrong::unless(any, "stiffness_x", "is 0 like all others", "above 0, or another of them")
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let Deflected { ways, turns, axes, .. } = self.deflected(seen);
        let ([k, turn_k], [c, turn_c]) = (self.stiffnesses(), self.dampings());
        let row = quantity % 3;
        match quantity {
            0..3 => k[row] * ways[row].value + c[row] * seen.rate(&ways[row].direction(seen)),
            _ => {
                let rate = seen.rate(&Deflected::about(seen, axes[row]));
                turn_k[row] * turns[row] + turn_c[row] * rate
            }
        }
    }
}
