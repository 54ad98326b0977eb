//! What the joints leave free at the initial pose, by the rank of their constraints.
//!
//! `scene => freedoms, bodies that cannot move`. A joint's element holds the velocity along it; the
//! rank of what all elements hold is what a solver with constraints could not do without, whatever
//! loops hold twice. Raw elements are springs and hold nothing. Orthonormal rows by Gram and
//! Schmidt, twice over (Giraud et al. 2005: twice is enough).

use dbd_kernel::model::Group;
use dbd_kernel::{BodyIndex, F64, Geometry, Vec3};

use crate::Scene;
use crate::facts::frames;
use crate::facts::lengths::{End, along, held_turns, is_bushing, points};
use crate::facts::stiffness::law;
use crate::parts::Parts;

/// A row that is this near to what others hold holds nothing of its own: the joints' springs give
/// way more than that, and axes are written with some digits. It errs to the side of freedom.
const DEPENDENT: f64 = 1e-3;

/// More bodies are not looked at: the time grows with the third power.
const MOST_BODIES: usize = 60;

/// A body's axis along which less than this share of a velocity is free is held.
const HELD: f64 = 1e-4;

/// A joint that is ten times softer than the stiffest is a mount: it is there to give way, as the
/// rubber of a suspension whose arms would not move without, and locks nothing.
const MOUNT: f64 = 0.1;

/// What the joints leave free.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Mobility {
    /// Freedoms of all bodies together.
    pub(super) freedoms: usize,
    /// Bodies that stiff joints to several others hold in place, though none holds them rigidly to
    /// what does not move.
    pub(super) locked: Vec<usize>,
}

/// What the joints leave free; `None` where the bodies are too many.
pub(super) fn mobility(scene: &Scene) -> Option<Mobility> {
    let bodies = scene.model.bodies.len();
    if bodies > MOST_BODIES {
        return None;
    }
    let mut holds = holds(scene);
    let freedoms = 6 * bodies - span(bodies, &holds).0.len();
    let stiffest = holds.iter().map(|hold| hold.stiffness).fold(0.0, f64::max);
    holds.retain(|hold| hold.stiffness > MOUNT * stiffest);
    Some(Mobility { freedoms, locked: locked(bodies, &holds) })
}

/// What the joints hold of all bodies' motions.
fn span(bodies: usize, holds: &[Hold]) -> Rows {
    let scale = holds.iter().flat_map(|hold| hold.arms).fold(f64::MIN_POSITIVE, f64::max);
    let mut rows = Rows::default();
    for hold in holds {
        hold.rows(bodies, scale, &mut rows);
    }
    rows
}

fn locked(bodies: usize, holds: &[Hold]) -> Vec<usize> {
    let mut all = span(bodies, holds);
    let mut rigid = rigid(bodies, holds);
    let mut joined = Parts::apart(bodies + 1);
    for hold in holds {
        joined.join(hold.ends[0], hold.ends[1]);
    }
    // What nothing joins to the world is judged as seen from one of its bodies.
    let mut seen_from = vec![None; bodies + 1];
    seen_from[joined.first(bodies)] = Some(bodies);
    for row in 0..bodies {
        let island = joined.first(row);
        if seen_from[island].is_none() {
            seen_from[island] = Some(row);
            for axis in 0..6 {
                let mut unit = vec![0.0; 6 * bodies];
                unit[6 * row + axis] = 1.0;
                all.add(unit);
            }
        }
    }
    let still = |row: &usize| (0..6).all(|axis| 1.0 - all.share(6 * row + axis) < HELD);
    let apart = |row: &usize| {
        let from = seen_from[joined.first(*row)];
        from.is_some_and(|from| rigid.first(from) != rigid.first(*row))
    };
    (0..bodies).filter(apart).filter(still).collect()
}

/// Bodies that the joints between two of them hold rigidly together, the world after all bodies.
fn rigid(bodies: usize, holds: &[Hold]) -> Parts {
    let mut rigid = Parts::apart(bodies + 1);
    let mut pairs: Vec<_> = holds.iter().map(Hold::pair).collect();
    pairs.sort_unstable();
    pairs.dedup();
    for [a, b] in pairs {
        // As if one of the two were the world.
        let own = holds.iter().filter(|hold| hold.pair() == [a, b]);
        let alone =
            |hold: &Hold| Hold { ends: hold.ends.map(|end| usize::from(end != a)), ..hold.clone() };
        let own: Vec<_> = own.map(alone).collect();
        if span(1, &own).0.len() == 6 {
            rigid.join(a, b);
        }
    }
    rigid
}

/// What a group of a joint holds between two bodies.
#[derive(Clone)]
struct Hold {
    /// Rows of its bodies, the world after all.
    ends: [usize; 2],
    /// From the bodies' centres of mass to it, world.
    from: [Vec3<f64>; 2],
    /// \[m\] their lengths; 0 from the world.
    arms: [f64; 2],
    /// Orthonormal forces and torques (over its size) about its place.
    wrenches: Vec<[f64; 6]>,
    /// \[m\] its size.
    size: f64,
    /// \[N/m\] of its elements.
    stiffness: f64,
}

impl Hold {
    /// Its bodies, the lower row first.
    fn pair(&self) -> [usize; 2] {
        [self.ends[0].min(self.ends[1]), self.ends[0].max(self.ends[1])]
    }

    /// Its rows in velocities and angular velocities times `scale`, world axes.
    fn rows(&self, bodies: usize, scale: f64, to: &mut Rows) {
        for [fx, fy, fz, tx, ty, tz] in &self.wrenches {
            let force = Vec3::new(*fx, *fy, *fz);
            let torque = Vec3::new(*tx, *ty, *tz) * self.size;
            let mut row = vec![0.0; 6 * bodies];
            for ((end, from), sign) in self.ends.iter().zip(self.from).zip([-1.0, 1.0]) {
                if *end < bodies {
                    let turning = (torque + from.cross(force)) * (1.0 / scale);
                    for (i, x) in force.to_f64().into_iter().chain(turning.to_f64()).enumerate() {
                        row[6 * end + i] += sign * x;
                    }
                }
            }
            to.add(row);
        }
    }
}

fn holds(scene: &Scene) -> Vec<Hold> {
    let frames = frames(scene);
    let model = &scene.model;
    let groups = scene.joints.iter().flat_map(|joint| joint.groups.clone());
    let hold = |number: usize| {
        let group = &model.groups[number];
        let row = |body: BodyIndex| body.row().min(model.bodies.len());
        let ends = [group.a, group.b].map(row);
        let spots = spots(scene, &frames, group);
        let count = spots.len() as f64;
        let place = spots.iter().fold(Vec3::ZERO, |sum, spot| sum + spot.0) * (1.0 / count);
        let offset = |(at, _): &(Vec3<f64>, Vec3<f64>)| length(*at - place);
        let [a, b] = [group.a, group.b].map(|body| End { scene, frames: &frames, body });
        let turns = held_turns(scene, group, &a, &b);
        let least = turns.iter().copied().map(length).fold(f64::MIN_POSITIVE, f64::max);
        let size = spots.iter().map(offset).fold(least, f64::max);
        let mut wrenches = Rows::default();
        for turn in turns {
            wrenches.add([[0.0; 3], turn.to_f64()].as_flattened().to_vec());
        }
        for (at, along) in &spots {
            let torque = (*at - place).cross(*along) * (1.0 / size);
            wrenches.add([along.to_f64(), torque.to_f64()].as_flattened().to_vec());
        }
        let from = ends.map(|end| match model.initial.get(end) {
            Some(state) => place - state.position,
            None => Vec3::ZERO,
        });
        let wrench = |row: Vec<f64>| std::array::from_fn(|i| row[i]);
        let wrenches = wrenches.0.into_iter().map(wrench).collect();
        let stiffness = law(scene, group, 0).0;
        Hold { ends, from, arms: from.map(length), wrenches, size, stiffness }
    };
    groups.map(hold).collect()
}

/// Per element of a group its point on the second body and its directions, world.
fn spots(
    scene: &Scene,
    frames: &[<F64 as Geometry>::Frame],
    group: &Group,
) -> Vec<(Vec3<f64>, Vec3<f64>)> {
    let [a, b] = [group.a, group.b].map(|body| End { scene, frames, body });
    let elements = (0..group.elements()).flat_map(|i| {
        let [centre, tip] = points(scene, group, i);
        let tip = b.place(tip);
        if is_bushing(group) {
            return Vec3::axes().map(|axis| (tip, axis)).to_vec();
        }
        let along = along(scene, group, i, &a, tip - a.place(centre));
        crate::direction::unit(along).map(|along| (tip, along)).into_iter().collect()
    });
    elements.collect()
}

fn length(v: Vec3<f64>) -> f64 {
    libm::sqrt(v.dot(v))
}

/// Orthonormal rows.
#[derive(Default)]
struct Rows(Vec<Vec<f64>>);

impl Rows {
    /// Adds what of a row the others do not span.
    fn add(&mut self, mut row: Vec<f64>) {
        if !normalise(&mut row, 0.0) {
            return;
        }
        for _ in 0..2 {
            for known in &self.0 {
                let share: f64 = known.iter().zip(&row).map(|(a, b)| a * b).sum();
                if share != 0.0 {
                    row.iter_mut().zip(known).for_each(|(x, known)| *x -= share * known);
                }
            }
        }
        if normalise(&mut row, DEPENDENT) {
            self.0.push(row);
        }
    }

    /// How much of the unit vector along a column the rows span: the square of its projection.
    fn share(&self, column: usize) -> f64 {
        self.0.iter().map(|row| row[column] * row[column]).sum()
    }
}

/// Brings a row to unit length; `false` where it is not longer than `least`.
fn normalise(row: &mut [f64], least: f64) -> bool {
    let norm = libm::sqrt(row.iter().map(|x| x * x).sum());
    let some = norm > least && norm.is_finite();
    if some {
        row.iter_mut().for_each(|x| *x /= norm);
    }
    some
}
