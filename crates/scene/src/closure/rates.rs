//! Velocities that joints allow, nearest to rest, with some of them prescribed.
//!
//! `(joints, poses, prescribed velocities and rates) => velocities, or what contradicts`. At closed poses the
//! constraint derivatives times the velocities are 0; of all such velocities with the prescribed values the result
//! minimises the sum over the bodies of v² + (length·ω)².

use dbd_kernel::Vec3;

use crate::closure::constraint::Closure;
use crate::closure::island::Island;
use crate::closure::least_norm::{Factors, dot};
use crate::closure::newton::CAREFUL;
use crate::closure::pose::Pose;

/// Tolerance of prescribed values relative to the largest: the scene gives at least six digits.
const MISSED: f64 = 1e-6;

/// A motion counts as prevented if the joints leave less than this fraction of its row.
const NO_MOTION: f64 = 1e-6;

/// The motion of a body, world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Motion {
    /// \[m/s\] of its centre of mass.
    pub(crate) velocity: Vec3<f64>,
    /// \[rad/s\].
    pub(crate) spin: Vec3<f64>,
}

/// A prescribed velocity or rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Prescribed {
    /// \[m/s\] the velocity of a body's centre of mass, world.
    Velocity(usize, Vec3<f64>),
    /// \[rad/s\] the angular velocity of a body, world.
    Spin(usize, Vec3<f64>),
    /// \[rad/s\] the angular velocity of a joint's second body relative to its first about the axis.
    Turn(usize, f64),
    /// \[m/s\] the velocity of a joint's second body along the first one's axis.
    Slide(usize, f64),
}

/// A prescribed value that cannot be satisfied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Contradiction {
    /// Index of the prescribed value.
    pub(crate) row: usize,
    /// Whether the joints alone prevent this motion.
    pub(crate) is_held: bool,
    /// In its unit: the value nearest to all prescribed ones; for a velocity its deviation.
    pub(crate) nearest: f64,
}

/// An equation: a row of six columns per body of an island, and its value.
struct Equation {
    columns: Vec<f64>,
    value: f64,
    /// Index of the prescribed value.
    source: usize,
}

/// The velocities of all bodies; without joints the prescribed ones, or 0.
pub(crate) fn motions(
    closures: &[Closure],
    poses: &[Pose],
    prescribed: &[Prescribed],
    length: f64,
) -> Result<Vec<Motion>, Contradiction> {
    let mut motions = vec![Motion::default(); poses.len()];
    for island in Island::all(closures, &vec![true; poses.len()]) {
        let system = island.system(closures, length);
        let joints = system.equations(poses).rows;
        let equations: Vec<Equation> = (0..prescribed.len())
            .flat_map(|source| {
                equations(&island.bodies, closures, poses, (source, prescribed), length)
            })
            .collect();
        let largest = equations.iter().fold(0.0, |most: f64, row| most.max(row.value.abs()));
        if largest == 0.0 {
            continue;
        }
        let held = joints.len();
        let mut rows = joints;
        rows.extend(equations.iter().map(|row| row.columns.clone()));
        let mut residuals = vec![0.0; held];
        residuals.extend(equations.iter().map(|row| -row.value));
        let found = Factors::of(&rows, system.columns(), CAREFUL).step(&residuals, 0.0);
        let miss = |row: usize| dot(&rows[row], &found) + residuals[row];
        // Residuals of joints are caused by prescribed values.
        let misses = (0..rows.len()).any(|row| miss(row).abs() > MISSED * largest);
        if misses {
            return Err(contradiction(&equations, &rows, held, miss, prescribed, length));
        }
        for (body, own) in island.bodies.iter().zip(found.chunks_exact(6)) {
            motions[*body] = Motion {
                velocity: Vec3::new(own[0], own[1], own[2]),
                spin: Vec3::new(own[3], own[4], own[5]) * (1.0 / length),
            };
        }
    }
    for given in prescribed {
        // Exact to the last bit.
        match *given {
            Prescribed::Velocity(body, velocity) => motions[body].velocity = velocity,
            Prescribed::Spin(body, spin) => motions[body].spin = spin,
            Prescribed::Turn(..) | Prescribed::Slide(..) => {}
        }
    }
    Ok(motions)
}

/// The contradictory prescribed value: one that the joints alone prevent, otherwise the one with the largest
/// deviation.
fn contradiction(
    equations: &[Equation],
    rows: &[Vec<f64>],
    held: usize,
    miss: impl Fn(usize) -> f64,
    prescribed: &[Prescribed],
    length: f64,
) -> Contradiction {
    let columns = rows.first().map_or(0, Vec::len);
    let joints = Factors::of(&rows[..held], columns, CAREFUL);
    let is_held = |row: usize| {
        let free = joints.free_part(&rows[row]);
        let square = dot(&rows[row], &rows[row]);
        equations[row - held].value != 0.0 && dot(&free, &free) <= NO_MOTION * NO_MOTION * square
    };
    let all = held..rows.len();
    let worst = all.clone().max_by(|a, b| miss(*a).abs().total_cmp(&miss(*b).abs()));
    let blamed = all.clone().find(|row| is_held(*row));
    let row = blamed.or(worst).unwrap_or(held);
    let source = equations[row - held].source;
    let unit = match prescribed[source] {
        Prescribed::Velocity(..) | Prescribed::Slide(..) => 1.0,
        Prescribed::Spin(..) | Prescribed::Turn(..) => 1.0 / length,
    };
    let nearest = match prescribed[source] {
        Prescribed::Turn(_, rate) | Prescribed::Slide(_, rate) => rate + miss(row) * unit,
        Prescribed::Velocity(..) | Prescribed::Spin(..) => miss(row).abs() * unit,
    };
    Contradiction { row: source, is_held: blamed.is_some(), nearest }
}

/// The equations of a prescribed value, if it belongs to the island.
fn equations(
    bodies: &[usize],
    closures: &[Closure],
    poses: &[Pose],
    (source, prescribed): (usize, &[Prescribed]),
    length: f64,
) -> Vec<Equation> {
    let columns = 6 * bodies.len();
    let place = |body: usize| bodies.binary_search(&body).ok().map(|column| 6 * column);
    let of_body = |body: usize, from: usize, value: Vec3<f64>, scale: f64| match place(body) {
        Some(first) => [0, 1, 2].map(|axis| {
            let mut row = vec![0.0; columns];
            row[first + from + axis] = 1.0;
            Equation { columns: row, value: value.to_f64()[axis] * scale, source }
        }),
        None => [0, 1, 2].map(|_| Equation { columns: Vec::new(), value: 0.0, source }),
    };
    let of_joint = |joint: usize, slopes: [[f64; 6]; 2], value: f64| {
        let mut row = vec![0.0; columns];
        for (end, slopes) in closures[joint].ends.iter().zip(slopes) {
            if let Some(first) = place(end.row()) {
                row[first..first + 6].copy_from_slice(&slopes);
            }
        }
        let own = closures[joint].ends.iter().any(|end| place(end.row()).is_some());
        Equation { columns: if own { row } else { Vec::new() }, value, source }
    };
    let all: Vec<Equation> = match prescribed[source] {
        Prescribed::Velocity(body, velocity) => of_body(body, 0, velocity, 1.0).into(),
        Prescribed::Spin(body, spin) => of_body(body, 3, spin, length).into(),
        Prescribed::Turn(joint, rate) => {
            vec![of_joint(joint, closures[joint].turning(poses), rate * length)]
        }
        Prescribed::Slide(joint, rate) => {
            vec![of_joint(joint, closures[joint].sliding(poses, length), rate)]
        }
    };
    all.into_iter().filter(|equation| !equation.columns.is_empty()).collect()
}
