//! The deflection of a bushing, common to its laws.
//!
//! `(points, axes, state of the ends) => six coordinates, their gradients, the record of their forces`. With the
//! displacement d of B's point from A's and the rotation `(w, v)` of B in A since t = 0, as a unit quaternion, the
//! coordinates are `eᵢ·d` and `2·vᵢ` along axes e of A. Without a singular pose and without trigonometry (compare Masarati
//! & Morandini, Multibody System Dynamics 23 (2010) 361).

use crate::force_pair::{Direction, ForcePair};
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Hinge;
use crate::laws::interaction::{Damper, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _, Turn as _, Vector as _};

/// One number for each axis x, y, z: of displacements, then of rotations.
pub(super) type Sixfold<R> = [[R; 3]; 2];

/// The six numbers one after the other.
#[inline(always)]
pub(super) fn flat<R: Copy>([[a, b, c], [d, e, f]]: Sixfold<R>) -> [R; 6] {
    [a, b, c, d, e, f]
}

/// The reverse of [`flat`].
#[inline(always)]
pub(super) fn sixfold<R: Copy>([a, b, c, d, e, f]: [R; 6]) -> Sixfold<R> {
    [[a, b, c], [d, e, f]]
}

/// A number for each axis from two.
#[inline(always)]
pub(super) fn each<R: Copy>(a: Sixfold<R>, b: Sixfold<R>, f: impl Fn(R, R) -> R) -> Sixfold<R> {
    let ([[a, b, c], [d, e, g]], [[u, v, w], [x, y, z]]) = (a, b);
    [[f(a, u), f(b, v), f(c, w)], [f(d, x), f(e, y), f(g, z)]]
}

/// The outputs of a bushing.
pub(super) const LOADS: &[Quantity] = &[
    Quantity { name: "force_x", unit: "N" },
    Quantity { name: "force_y", unit: "N" },
    Quantity { name: "force_z", unit: "N" },
    Quantity { name: "torque_x", unit: "N·m" },
    Quantity { name: "torque_y", unit: "N·m" },
    Quantity { name: "torque_z", unit: "N·m" },
];

/// The names of the fields of stiffnesses.
pub(super) const STIFFNESSES: Sixfold<&str> = [
    ["stiffness_x", "stiffness_y", "stiffness_z"],
    ["turn_stiffness_x", "turn_stiffness_y", "turn_stiffness_z"],
];

/// The names of the fields of dampings.
pub(super) const DAMPINGS: Sixfold<&str> = [
    ["damping_x", "damping_y", "damping_z"],
    ["turn_damping_x", "turn_damping_y", "turn_damping_z"],
];

/// How far the axes may be from perpendicular: the cosine of the angle between them.
const SQUARE: f64 = 1e-6;

/// Where a bushing is, in both bodies.
pub(super) struct Mount<'c, P: Geometry> {
    pub(super) points: &'c [P::Local; 2],
    /// First axis.
    pub(super) x: P::Vector,
    /// Third axis.
    pub(super) z: &'c Hinge<P::Space>,
}

/// A bushing at a pose.
pub(super) struct Deflected<P: Geometry> {
    /// Displacements along x, y, z.
    ways: [Coordinate<P>; 3],
    /// Twice the components of the vector of the rotation's quaternion along x, y, z.
    turns: [P::Real; 3],
    /// Their gradients for a rotation of B, axes of A.
    pub(super) gradients: [P::Moment; 3],
    /// The axes x, y, z as moments, axes of A.
    pub(super) axes: [P::Moment; 3],
    /// The axes x, y, z, world.
    vectors: [P::Vector; 3],
    /// \[m\] the lever arm of A's point, the displacement from it to B's and the lever arm of B's point, world.
    arms: [P::Vector; 3],
}

impl<P: Geometry> Mount<'_, P> {
    #[inline(always)]
    pub(super) fn deflected(&self, seen: &Seen<'_, P>) -> Deflected<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let way = P::displacement(&at_a, &at_b);
        // In the plane the third vector is 0, and so are the first two moments.
        let (x, z) = (self.x, self.z.axis);
        let y = z.cross(x);
        let vectors = [x, y, x.across(y)];
        let axes = [y.cross(vectors[2]), vectors[2].cross(x), z];
        // Not by `map`, which is not always inlined.
        let [u, v, w] = vectors;
        let vectors = [seen.a.to_world(u), seen.a.to_world(v), seen.a.to_world(w)];
        let arms = [arm, way, other];
        let carried = |along: P::Vector| Coordinate::carried(along.dot(way), along, arms);
        let [u, v, w] = vectors;
        let ways = [carried(u), carried(v), carried(w)];
        let turn = seen.a.turn_of(&seen.b).product(self.z.reference);
        let parts = axes.map(|axis| turn.about(axis));
        let [(w, _), ..] = parts;
        let vector = axes[0] * parts[0].1 + axes[1] * parts[1].1 + axes[2] * parts[2].1;
        let turns = parts.map(|(_, part)| P::Real::TWO * part);
        let gradients = axes.map(|axis| axis * w + vector.commutator(axis));
        Deflected { ways, turns, gradients, axes, vectors, arms }
    }

    /// Refuses axes that are not perpendicular.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let y = self.z.axis.cross(self.x);
        let square = y.dot(y) >= P::Real::from_f64(1.0 - SQUARE * SQUARE);
        Wrong::unless(square, "x", "is not perpendicular to `z`", "an axis perpendicular to `z`")
    }
}

impl<P: Geometry> Deflected<P> {
    /// The direction of a rotation about a moment in the axes of A.
    #[inline(always)]
    fn about(seen: &Seen<'_, P>, moment: P::Moment) -> Direction<P::Space> {
        seen.about(seen.a.moment_to_world(moment))
    }

    /// \[m, rad\] the coordinates.
    #[inline(always)]
    pub(super) fn values(&self) -> Sixfold<P::Real> {
        let [x, y, z] = &self.ways;
        [[x.value, y.value, z.value], self.turns]
    }

    /// \[m/s, rad/s\] the rate along an axis or, of a rotation, along one of `moments`, by row.
    #[inline(always)]
    fn rate(&self, seen: &Seen<'_, P>, moments: [P::Moment; 3], row: usize) -> P::Real {
        match (self.ways.get(row), moments.get(row % 3)) {
            (Some(way), _) => seen.rate(&way.direction(seen)),
            (None, Some(moment)) => seen.rate(&Self::about(seen, *moment)),
            (None, None) => P::Real::ZERO,
        }
    }

    /// The six rates.
    #[inline(always)]
    pub(super) fn rates(&self, seen: &Seen<'_, P>, moments: [P::Moment; 3]) -> [P::Real; 6] {
        [0, 1, 2, 3, 4, 5].map(|row| self.rate(seen, moments, row))
    }

    /// The direction along a weighted sum of the axes and, of a rotation, of `moments`.
    #[inline(always)]
    pub(super) fn sum(
        &self,
        seen: &Seen<'_, P>,
        moments: [P::Moment; 3],
        [of_ways, of_turns]: Sixfold<P::Real>,
    ) -> Direction<P::Space> {
        let [x, y, z] = self.vectors;
        let along = x * of_ways[0] + y * of_ways[1] + z * of_ways[2];
        let [x, y, z] = moments;
        let moment = x * of_turns[0] + y * of_turns[1] + z * of_turns[2];
        let shifted = Coordinate::<P>::carried(P::Real::ZERO, along, self.arms).direction(seen);
        shifted.with(&Self::about(seen, moment))
    }

    /// The record of a force \[N, N·m\] along each coordinate.
    #[inline(always)]
    pub(super) fn force_pair(
        self,
        seen: &Seen<'_, P>,
        [along, about]: Sixfold<P::Real>,
    ) -> ForcePair<P::Space> {
        let gradients = self.gradients;
        let [x, y, z] = self.ways.map(|way| way.direction(seen));
        let [x, y, z] = [(x, along[0]), (y, along[1]), (z, along[2])]
            .map(|(direction, force)| seen.pull(&direction, force));
        let moment = gradients[0] * about[0] + gradients[1] * about[1] + gradients[2] * about[2];
        let turned = seen.pull(&Self::about(seen, moment), P::Real::ONE);
        x.with(&y).with(&z).with(&turned)
    }

    /// The tangent of a spring along each coordinate, by its stiffness \[N/m, N·m/rad\] and its force \[N, N·m\].
    pub(super) fn tangent(
        self,
        seen: &Seen<'_, P>,
        [stiff_ways, stiff_turns]: Sixfold<P::Real>,
        [along, about]: Sixfold<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let mut bent = [P::Real::ZERO; 2];
        for ((way, stiffness), force) in self.ways.into_iter().zip(stiff_ways).zip(along) {
            visit(stiffness, &way.direction(seen));
            let more = way.bent(seen, force.abs(), visit);
            bent = [bent[0] + more[0], bent[1] + more[1]];
        }
        for ((gradient, stiffness), torque) in
            self.gradients.into_iter().zip(stiff_turns).zip(about)
        {
            visit(stiffness, &Self::about(seen, gradient));
            bent = bent.map(|bent| bent + P::Real::HALF * torque.abs());
        }
        bent
    }

    /// A damper along and about each axis.
    #[inline(always)]
    pub(super) fn dampers(
        self,
        seen: &Seen<'_, P>,
        dampings: Sixfold<P::Real>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        let [along, about] = coefficients::<P>(dampings);
        for (way, damping) in self.ways.into_iter().zip(along) {
            visit(Damper::new(damping, way.direction(seen)));
        }
        for (axis, damping) in self.axes.into_iter().zip(about) {
            visit(Damper::new(damping, Self::about(seen, axis)));
        }
    }

    /// \[N, N·m\] a force with that of the damper along or about its axis, by row.
    pub(super) fn damped(
        &self,
        seen: &Seen<'_, P>,
        forces: Sixfold<P::Real>,
        dampings: Sixfold<P::Real>,
        row: usize,
    ) -> P::Real {
        let known = flat(forces).into_iter().zip(flat(dampings)).nth(row);
        let Some((force, damping)) = known else { return P::Real::ZERO };
        force + damping * self.rate(seen, self.axes, row)
    }
}

/// Coefficients of dampers: in the plane 0 along and about axes that have no direction there.
#[inline(always)]
pub(super) fn coefficients<P: Geometry>(
    [mut along, mut about]: Sixfold<P::Real>,
) -> Sixfold<P::Real> {
    if P::Space::PLANAR {
        along[2] = P::Real::ZERO;
        (about[0], about[1]) = (P::Real::ZERO, P::Real::ZERO);
    }
    [along, about]
}

/// Whether any number is above 0; refuses negative ones.
pub(super) fn any<R: Real>(
    numbers: Sixfold<R>,
    names: Sixfold<&'static str>,
) -> Result<bool, Wrong> {
    let mut any = false;
    for (number, name) in flat(numbers).into_iter().zip(flat(names)) {
        let holds = number >= R::ZERO;
        Wrong::unless(holds, name, "is negative", "a stiffness or damping ≥ 0")?;
        any |= number > R::ZERO;
    }
    Ok(any)
}
