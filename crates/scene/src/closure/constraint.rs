//! Constraints of a joint on the poses of its two bodies, with derivatives.
//!
//! `(joint's halves, two poses) => residuals \[m\] with their derivatives`. A residual is a part of a displacement or
//! an angle times the length at which a radian counts as a metre; derivatives are with respect to a translation and a
//! rotation times that length, both world. Angles are those of rotation vectors, so that a rotation of 180° is not a
//! zero. Bullo & Murray 1995 (logarithms on SO(3)); Haug, Computer Aided Kinematics, 1989, 9.4.

use dbd_kernel::{BodyIndex, Quaternion, Vec3};

use crate::closure::pose::{Pose, length, logarithm};

/// Constraint on the joint's two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// They coincide.
    Point,
    /// The second lies on the line through the first along its axis.
    Line,
}

/// Constraint on the joint's two triads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// No constraint.
    Free,
    /// Their axes are parallel.
    Axis,
    /// Their axes are normal to each other.
    Across,
    /// They coincide.
    All,
}

/// A joint to be closed.
#[derive(Clone, Debug)]
pub(crate) struct Closure {
    /// Its bodies.
    pub(crate) ends: [BodyIndex; 2],
    /// Constraint on its points.
    pub(crate) place: Place,
    /// Constraint on its triads.
    pub(crate) turn: Turn,
    /// \[m\] a point of each body, body axes.
    pub(crate) points: [Vec3<f64>; 2],
    /// A right-handed triad of each body with the joint axis third: the rotation from the body axes to it.
    pub(crate) triads: [Quaternion<f64>; 2],
}

/// Gap of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Opening {
    /// \[m\].
    pub(crate) distance: f64,
    /// \[rad\].
    pub(crate) angle: f64,
}

/// A residual, 0 if the joint is closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// \[m\].
    pub(super) residual: f64,
    /// Per body, derivatives with respect to translation (3) and rotation times the length (3).
    pub(super) slopes: [[f64; 6]; 2],
}

impl Closure {
    /// Its residuals. `all` are the poses of the bodies.
    pub(super) fn rows(&self, all: &[Pose], scale: f64) -> Vec<Row> {
        let poses = self.poses(all);
        let [first, _] = self.world_triads(&poses);
        let places = [0, 1].map(|end| poses[end].place(self.points[end]));
        let gap = places[1] - places[0];
        let mut rows = Vec::with_capacity(6);
        let mut along = |e: Vec3<f64>, is_of_first: bool| {
            let arms = [0, 1].map(|end| (places[end] - poses[end].position).cross(e));
            // The direction rotates with the first body.
            let turning = if is_of_first { e.cross(gap) } else { Vec3::ZERO };
            rows.push(Row {
                residual: e.dot(gap),
                slopes: [
                    slopes(-e, (turning - arms[0]) * (1.0 / scale)),
                    slopes(e, arms[1] * (1.0 / scale)),
                ],
            });
        };
        match self.place {
            Place::Point => Vec3::axes().into_iter().for_each(|e| along(e, false)),
            Place::Line => first[..2].iter().for_each(|e| along(*e, true)),
        }
        let mut about = |angle: f64, by: [Vec3<f64>; 2]| {
            rows.push(Row {
                residual: angle * scale,
                slopes: [slopes(Vec3::ZERO, by[0]), slopes(Vec3::ZERO, by[1])],
            });
        };
        match self.turn {
            Turn::Free => {}
            Turn::Axis => {
                self.tilt(&poses).into_iter().for_each(|(angle, c)| about(angle, [-c, c]))
            }
            Turn::Across => {
                let (angle, c) = self.squint(&poses);
                about(angle, [-c, c]);
            }
            Turn::All => {
                let turn = self.between(&poses);
                for e in Vec3::axes() {
                    about(turn.dot(e), [back(-turn, -e), back(turn, e)]);
                }
            }
        }
        rows
    }

    /// Its gap.
    pub(crate) fn opening(&self, all: &[Pose]) -> Opening {
        let poses = self.poses(all);
        let gap = poses[1].place(self.points[1]) - poses[0].place(self.points[0]);
        let distance = match self.place {
            Place::Point => length(gap),
            Place::Line => {
                let [first, _] = self.world_triads(&poses);
                length(gap - first[2] * first[2].dot(gap))
            }
        };
        let angle = match self.turn {
            Turn::Free => 0.0,
            Turn::Axis => {
                let [(a, _), (b, _)] = self.tilt(&poses);
                libm::sqrt(a * a + b * b)
            }
            Turn::Across => self.squint(&poses).0.abs(),
            Turn::All => length(self.between(&poses)),
        };
        Opening { distance, angle }
    }

    /// Derivative of the angle about its axis times the length, in the columns of a row.
    pub(super) fn turning(&self, all: &[Pose]) -> [[f64; 6]; 2] {
        let [[_, _, axis], _] = self.world_triads(&self.poses(all));
        [slopes(Vec3::ZERO, -axis), slopes(Vec3::ZERO, axis)]
    }

    /// Derivative of the position of its second point along its axis, likewise.
    pub(super) fn sliding(&self, all: &[Pose], scale: f64) -> [[f64; 6]; 2] {
        let poses = self.poses(all);
        let [[_, _, axis], _] = self.world_triads(&poses);
        // The point of the first body that coincides with that of the second.
        let place = poses[1].place(self.points[1]);
        let arms = poses.map(|pose| (place - pose.position).cross(axis) * (1.0 / scale));
        [slopes(-axis, -arms[0]), slopes(axis, arms[1])]
    }

    fn poses(&self, all: &[Pose]) -> [Pose; 2] {
        self.ends.map(|end| all.get(end.row()).copied().unwrap_or(Pose::WORLD))
    }

    fn world_triads(&self, poses: &[Pose; 2]) -> [[Vec3<f64>; 3]; 2] {
        [0, 1].map(|end| {
            let rotation = poses[end].orientation.product(self.triads[end]).rotation();
            Vec3::axes().map(|axis| rotation.to_world(axis))
        })
    }

    /// The rotation vector from the first axis to the second, in the first triad, and the derivative of each
    /// component with respect to the relative rotation of the second body, world.
    fn tilt(&self, poses: &[Pose; 2]) -> [(f64, Vec3<f64>); 2] {
        let [[e1, e2, n], [_, _, m]] = self.world_triads(poses);
        let across = n.cross(m);
        let (sine, cosine) = (length(across), n.dot(m));
        let angle = libm::atan2(sine, cosine);
        // The axis of rotation is arbitrary at a tilt of 0° or 180°.
        let axis = if sine > 1e-12 { across * (1.0 / sine) } else { e1 };
        // The axis of rotation rotates about the first axis, the faster the smaller the tilt.
        let ratio = if sine > 1e-12 { angle / sine } else { 1.0 };
        let (side, towards) = (n.cross(axis), m.cross(axis));
        [e1, e2].map(|e| {
            let change = axis * e.dot(axis) + towards * (ratio * e.dot(side));
            (angle * e.dot(axis), change)
        })
    }

    /// 90° less the angle between the axes, and its derivative with respect to the relative rotation of the second
    /// body.
    fn squint(&self, poses: &[Pose; 2]) -> (f64, Vec3<f64>) {
        let [[e1, _, n], [_, _, m]] = self.world_triads(poses);
        let across = m.cross(n);
        let sine = length(across);
        let axis = if sine > 1e-12 { across * (1.0 / sine) } else { e1 };
        (libm::atan2(n.dot(m), sine), axis)
    }

    /// The rotation vector from the first triad to the second, world.
    fn between(&self, poses: &[Pose; 2]) -> Vec3<f64> {
        let [a, b] = [0, 1].map(|end| poses[end].orientation.product(self.triads[end]));
        logarithm(b.product(a.conjugate()))
    }
}

/// The row `e` of the inverse of the left Jacobian of SO(3) at a rotation vector φ,
/// `I − ½[φ]× + c·[φ]×²`, `c = (1 − (φ/2)·cot(φ/2))/φ²`; the right one's
/// is that of −φ.
fn back(turn: Vec3<f64>, e: Vec3<f64>) -> Vec3<f64> {
    let square = turn.dot(turn);
    let c = if square < 1e-4 {
        1.0 / 12.0 + square / 720.0
    } else {
        let half = 0.5 * libm::sqrt(square);
        let (sine, cosine) = libm::sincos(half);
        (1.0 - half * cosine / sine) / square
    };
    let once = e.cross(turn);
    e - once * 0.5 + once.cross(turn) * c
}

fn slopes(shift: Vec3<f64>, turn: Vec3<f64>) -> [f64; 6] {
    [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::pose::exponential;

    fn some(numbers: [f64; 6]) -> Pose {
        let [x, y, z, a, b, c] = numbers;
        Pose::new(Vec3::new(x, y, z), exponential(Vec3::new(a, b, c)))
    }

    fn closure(place: Place, turn: Turn) -> Closure {
        Closure {
            ends: [BodyIndex(0), BodyIndex(1)],
            place,
            turn,
            points: [Vec3::new(0.3, -0.2, 0.5), Vec3::new(-0.4, 0.1, 0.25)],
            triads: [[0.4, -0.3, 0.2], [-0.1, 0.7, 0.5]]
                .map(|turn| exponential(Vec3::from_f64(turn))),
        }
    }

    const ALL: [(Place, Turn); 6] = [
        (Place::Point, Turn::Free),
        (Place::Point, Turn::Axis),
        (Place::Point, Turn::Across),
        (Place::Line, Turn::Axis),
        (Place::Line, Turn::All),
        (Place::Point, Turn::All),
    ];

    /// Poses near each other and far apart, one rotated by almost 180°.
    const POSES: [[[f64; 6]; 2]; 4] = [
        [[0.0, 0.0, 0.0, 0.1, 0.2, -0.1], [0.1, 0.0, 0.05, 0.6, -0.8, -0.4]],
        [[1.0, -2.0, 0.5, 0.4, 0.2, -1.1], [0.3, 0.7, 0.4, -0.9, 0.3, 1.2]],
        [[0.2, 0.1, 0.3, 0.0, 0.0, 0.0], [-0.2, 0.4, 1.3, 1.8, -1.4, 1.0]],
        [[0.2, 0.1, 0.3, -1.0, 0.4, 0.3], [-0.2, 0.4, 1.3, 1.1, 1.6, -0.2]],
    ];

    #[test]
    fn slopes_are_those_of_central_differences() {
        const STEP: f64 = 1e-5;
        let scale = 0.7;
        for (place, turn) in ALL {
            let closure = closure(place, turn);
            for numbers in POSES {
                let poses = numbers.map(some);
                let rows = closure.rows(&poses, scale);
                for column in 0..12 {
                    let (end, part) = (column / 6, column % 6);
                    let at = |step: f64| {
                        let mut by = [0.0; 6];
                        by[part] = step;
                        let mut moved = poses;
                        let turn = Vec3::new(by[3], by[4], by[5]) * (1.0 / scale);
                        moved[end] = poses[end].moved(Vec3::new(by[0], by[1], by[2]), turn);
                        closure.rows(&moved, scale)
                    };
                    let (after, before) = (at(STEP), at(-STEP));
                    for (i, row) in rows.iter().enumerate() {
                        let slope = (after[i].residual - before[i].residual) / (2.0 * STEP);
                        let gap = (slope - row.slopes[end][part]).abs();
                        assert!(gap < 2e-8, "{place:?} {turn:?} {numbers:?} {i} {column}: {gap:e}");
                    }
                }
            }
        }
    }

    /// There are as many rows as constrained freedoms, and an open joint has a nonzero residual.
    #[test]
    fn a_joint_is_closed_where_its_halves_meet_and_only_there() {
        for ((place, turn), held) in ALL.into_iter().zip([3, 5, 4, 4, 5, 6]) {
            let mut closure = closure(place, turn);
            let poses = POSES[1].map(some);
            assert_eq!(closure.rows(&poses, 1.0).len(), held);
            let opening = closure.opening(&poses);
            let norm: f64 = closure.rows(&poses, 1.0).iter().map(|r| r.residual * r.residual).sum();
            let Opening { distance, angle } = opening;
            assert!((norm - distance * distance - angle * angle).abs() < 1e-13);
            assert!(distance > 0.1 && (angle > 0.1 || turn == Turn::Free));

            // The second half is placed on the first, rotated by 90° about its second axis for perpendicular axes.
            let at = poses[0].place(closure.points[0]);
            let arm = at - poses[1].position;
            closure.points[1] = poses[1].orientation.rotation().to_body(arm);
            let triad = poses[0].orientation.product(closure.triads[0]);
            let quarter = exponential(Vec3::new(0.0, core::f64::consts::FRAC_PI_2, 0.0));
            let triad = if turn == Turn::Across { triad.product(quarter) } else { triad };
            closure.triads[1] = poses[1].orientation.conjugate().product(triad);
            let Opening { distance, angle } = closure.opening(&poses);
            assert!(distance < 1e-15 && angle < 1e-15, "{place:?} {turn:?} {distance:e} {angle:e}");
        }
    }

    /// Antiparallel axes have the largest gap and are not closed.
    #[test]
    fn a_half_turn_is_open() {
        let mut closure = closure(Place::Point, Turn::Axis);
        let half = exponential(Vec3::new(core::f64::consts::PI, 0.0, 0.0));
        closure.triads[1] = closure.triads[0].product(half);
        let poses = [Pose::WORLD; 2];
        let rows = closure.rows(&poses, 1.0);
        assert!((closure.opening(&poses).angle - core::f64::consts::PI).abs() < 1e-15);
        assert!(rows.iter().all(|row| row.slopes[1].iter().all(|slope| slope.is_finite())));
        assert!(rows[3..].iter().all(|row| row.slopes[1].iter().any(|slope| slope.abs() > 0.1)));
    }
}
