//! Inertia of uniform bodies of simple shapes about their centres.
//!
//! `(shape, sizes) => volume, moments per mass`. Source: Meriam & Kraige, Engineering Mechanics: Dynamics,
//! table D/4. The first axis is the one along the shape, the next two lie across it.

use crate::precise::{PI, Precise};
use crate::solid::Solid;

/// The moment of a slender rod about its own axis over the others: a line has none, but a body needs one. The value
/// is that of a round bar with a diameter of 8 % of its length.
const SLENDER: (f64, f64) = (1.0, 100.0);

/// A uniform body; sizes in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A slender rod.
    SlenderRod { length: Precise },
    /// A solid or hollow cylinder, by its diameters.
    Cylinder { length: Precise, outer: Precise, inner: Precise },
    /// A block: along, next, last.
    Block { size: [Precise; 3] },
    /// A solid or hollow sphere, by its diameters.
    Sphere { outer: Precise, inner: Precise },
}

impl Shape {
    /// \[m³\], `None` without thickness.
    pub(crate) fn volume(self) -> Option<Precise> {
        let volume = match self {
            Self::SlenderRod { .. } => return None,
            Self::Cylinder { length, outer, inner } => {
                PI * (square(outer) - square(inner)) * length / Precise::from(4.0)
            }
            Self::Block { size: [x, y, z] } => x * y * z,
            Self::Sphere { outer, inner } => PI * (cube(outer) - cube(inner)) / Precise::from(6.0),
        };
        (volume.nearest() > 0.0).then_some(volume)
    }

    /// The solid with its length along a body's axis; `None` without thickness. Hollow shapes appear solid.
    pub(crate) fn solid(self, along: usize) -> Option<Solid> {
        let half = |size: Precise| 0.5 * size.nearest();
        let on_axis = |by: f64| {
            let mut end = [0.0; 3];
            end[along % 3] = by;
            end
        };
        match self {
            Self::SlenderRod { .. } => None,
            Self::Cylinder { length, outer, .. } => {
                let ends = [-half(length), half(length)].map(on_axis);
                Some(Solid::Cylinder { ends, radius: half(outer) })
            }
            Self::Block { size } => {
                let mut sides = [0.0; 3];
                for (i, size) in size.into_iter().enumerate() {
                    sides[(along + i) % 3] = half(size);
                }
                let turn = [1.0, 0.0, 0.0, 0.0];
                sides.iter().all(|side| *side > 0.0).then_some(Solid::Box {
                    at: [0.0; 3],
                    turn,
                    half: sides,
                })
            }
            Self::Sphere { outer, .. } => Some(Solid::Sphere { at: [0.0; 3], radius: half(outer) }),
        }
    }

    /// \[m²\] Moments over the mass: about the axis along it, about the next, about the last.
    pub(crate) fn moments(self) -> [Precise; 3] {
        let [three, four, eight, ten, twelve] = [3.0, 4.0, 8.0, 10.0, 12.0].map(Precise::from);
        match self {
            Self::SlenderRod { length } => {
                let across = square(length) / twelve;
                let (part, whole) = SLENDER;
                [across * part.into() / whole.into(), across, across]
            }
            Self::Cylinder { length, outer, inner } => {
                let squares = square(outer) + square(inner);
                let across = (three * squares / four + square(length)) / twelve;
                [squares / eight, across, across]
            }
            Self::Block { size } => {
                let [x, y, z] = size.map(square);
                [(y + z) / twelve, (x + z) / twelve, (x + y) / twelve]
            }
            Self::Sphere { outer, inner } => {
                let fifth = |d: Precise| square(d) * cube(d);
                [(fifth(outer) - fifth(inner)) / (ten * (cube(outer) - cube(inner))); 3]
            }
        }
    }
}

fn square(x: Precise) -> Precise {
    x * x
}

fn cube(x: Precise) -> Precise {
    x * x * x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume and moments over the mass by summing over the centres of small cubes in the box of these sides, refined
    /// until it is within its own error of 1/cells.
    fn summed(sides: [f64; 3], is_inside: impl Fn([f64; 3]) -> bool) -> (f64, [f64; 3]) {
        const CELLS: usize = 100;
        let middle = |i: usize, side: f64| ((i as f64 + 0.5) / CELLS as f64 - 0.5) * side;
        let (mut count, mut squares) = (0.0, [0.0; 3]);
        for i in 0..CELLS {
            for j in 0..CELLS {
                for k in 0..CELLS {
                    let place = [middle(i, sides[0]), middle(j, sides[1]), middle(k, sides[2])];
                    if is_inside(place) {
                        count += 1.0;
                        for (sum, c) in squares.iter_mut().zip(place) {
                            *sum += c * c;
                        }
                    }
                }
            }
        }
        let cell = sides.iter().product::<f64>() / (CELLS * CELLS * CELLS) as f64;
        let [x, y, z] = squares.map(|sum| sum / count);
        (count * cell, [y + z, x + z, x + y])
    }

    fn assert_near(shape: Shape, (volume, moments): (f64, [f64; 3])) {
        let near = |a: f64, b: f64| (a - b).abs() < 4e-3 * b.abs();
        let own = shape.volume().unwrap().nearest();
        assert!(near(own, volume), "{shape:?}: {own} {volume}");
        let own = shape.moments().map(Precise::nearest);
        assert!(own.into_iter().zip(moments).all(|(a, b)| near(a, b)), "{own:?} {moments:?}");
    }

    #[test]
    fn volume_and_moments_are_those_of_the_sum_over_small_cubes() {
        let p = Precise::from;
        let in_ring =
            |d: f64, outer: f64, inner: f64| (inner * inner..outer * outer).contains(&(4.0 * d));
        let block = Shape::Block { size: [0.7, 0.2, 0.3].map(p) };
        assert_near(block, summed([0.7, 0.2, 0.3], |_| true));
        for inner in [0.0, 0.2] {
            let tube = Shape::Cylinder { length: p(0.5), outer: p(0.4), inner: p(inner) };
            let sum = summed([0.5, 0.4, 0.4], |[_, y, z]| in_ring(y * y + z * z, 0.4, inner));
            assert_near(tube, sum);
            let ball = Shape::Sphere { outer: p(0.4), inner: p(inner) };
            let sum = summed([0.4; 3], |[x, y, z]| in_ring(x * x + y * y + z * z, 0.4, inner));
            assert_near(ball, sum);
        }
        // A plate is a thin box, a rod a thin cylinder.
        let thin = Shape::Block { size: [p(2.0), p(0.5), Precise::ZERO] };
        assert_eq!(thin.volume(), None);
        let moments = thin.moments().map(Precise::nearest);
        assert_eq!(moments, [0.25 / 12.0, 4.0 / 12.0, 4.25 / 12.0]);
        let rod = Shape::SlenderRod { length: p(2.0) }.moments().map(Precise::nearest);
        assert_eq!(rod, [0.01 / 3.0, 1.0 / 3.0, 1.0 / 3.0]);
        let round = Shape::Cylinder { length: p(2.0), outer: p(0.16), inner: p(0.0) };
        let [along, across, _] = round.moments().map(Precise::nearest);
        assert!((along / across - 0.01).abs() < 5e-4, "{}", along / across);
    }
}
