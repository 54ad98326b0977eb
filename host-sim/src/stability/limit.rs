//! The largest stable step of a method on a scene, found by running it.
//!
//! `(model, pose, method) => stable ranges of z = ω·h`, ω the highest eigenfrequency. The pose is
//! frozen: no velocities, gravity, loads, inputs or preloads, every spring at its present length,
//! clearances taken up; dampers stay. About it the mechanism vibrates with an amplitude of 1e-7
//! of its shortest spring (3e-4 in single precision), in all its elastic modes at once, for 100
//! periods of the fastest, 600 steps at least and 2500 at most. A step is unstable where the
//! largest energy of the last third exceeds twice that of the first, as a mode does that gains
//! 1e-3 of its amplitude per step, or any a thousand times the initial. z is scanned from small to
//! large, for stability need not end once: a narrow range of growth may lie between stable ones;
//! its edges are refined by bisection.

use std::f64::consts::TAU;

use dbd_kernel::{F64, State, Vec3};
use dbd_plant::{Method, MethodError, PrecisionName, plant_of_model};
use dbd_reference::window::perturbed;
use dbd_reference::{Mechanism, State as Reference, eigenfrequencies};
use dbd_scene::SceneModel;

use crate::stability::frozen::frozen;

/// The grid of the scan up to `FINE`, and beyond: the window of growth of blanes-moan-s6, 0.027 wide,
/// meets the finer one twice.
const GRID: [f64; 2] = [0.05, 0.0125];
const FINE: f64 = 0.5;

/// The end of the scan: no scheme is stable beyond 6.31.
pub const LARGEST: f64 = 6.5;

/// How long a trial is: periods of the fastest mode, and the least and the most steps.
const PERIODS: f64 = 100.0;
const STEPS: [f64; 2] = [600.0, 2500.0];

/// The energy, over the initial, at which a trial ends: at 1.999 of 2 an oscillation of leapfrog
/// comes as far, and single precision's is still small.
const GROWN: f64 = 1e3;

/// Steps from one look at the energy to the next, in turn: no oscillation keeps step with all.
const LOOKS: [u64; 4] = [7, 3, 11, 2];

/// Halvings of a bracket: edges are known to 2e-4.
const HALVINGS: u32 = 8;

/// A first grid point that is unstable is halved as often at most: to z = 5e-5.
const DESCENTS: i32 = 10;

/// Where a method is stable.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// \[rad/s\] the highest eigenfrequency of the pose.
    pub frequency: f64,
    /// \[s\] every step up to here is stable, of those that were scanned; 0 where not even the smallest
    /// is.
    pub largest_step: f64,
    /// Ranges of z in which every scanned step is stable, ascending; the last may reach the end
    /// of the scan, [`LARGEST`].
    pub ranges: Vec<[f64; 2]>,
}

impl Stability {
    /// The z of the largest step.
    #[must_use]
    pub fn z(&self) -> f64 {
        self.largest_step * self.frequency
    }
}

/// How far rounding lets a vibration be small.
#[derive(Clone, Copy)]
struct Size {
    /// The vibration's amplitude over the shortest spring.
    amplitude: f64,
    /// The share of the initial energy that rounding makes of itself.
    noise: f64,
}

/// The size of a vibration in a precision, `None` where no frozen pose is at rest.
fn size(precision: PrecisionName) -> Option<Size> {
    match precision {
        PrecisionName::F64 => Some(Size { amplitude: 1e-7, noise: 1e-9 }),
        PrecisionName::F32 => Some(Size { amplitude: 3e-4, noise: 1e-2 }),
        PrecisionName::F32Micromath => None,
    }
}

/// The stability of a method about a pose of a model; `None` where nothing vibrates.
///
/// # Errors
/// [`MethodError::Restless`] in a precision in which no pose is at rest, [`MethodError::Comparison`]
/// where this build does not hold the method.
pub fn stability(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    method: &Method,
) -> Result<Option<Stability>, MethodError> {
    let precision = method.precision_name();
    method.check_built()?;
    let size = size(method.precision()).ok_or(MethodError::Restless { precision })?;
    Ok(stability_at(model, state, method, size))
}

fn stability_at(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    method: &Method,
    size: Size,
) -> Option<Stability> {
    let frozen = frozen(model, state);
    let (mechanism, rest) = Mechanism::of_model(&frozen);
    let frequency = eigenfrequencies(&mechanism, &rest, 0.0).last().copied().unwrap_or(0.0);
    if frequency <= 0.0 {
        return None;
    }
    let kick = kick(&mechanism, &rest, frequency)?;
    let kicked = kicked(frozen, &kick, size.amplitude);
    let is_stable = |z: f64| {
        let steps = (PERIODS * TAU / z).clamp(STEPS[0], STEPS[1]).ceil() as u64;
        is_bounded(&kicked, method, size.noise, z / frequency, steps)
    };
    let ranges = scan(is_stable);
    let first = ranges.first().filter(|range| range[0] == 0.0).map_or(0.0, |range| range[1]);
    Some(Stability { frequency, largest_step: first / frequency, ranges })
}

/// The stable ranges of z.
fn scan(is_stable: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
    let edge = |mut stable: f64, mut unstable: f64| {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stable + unstable);
            if is_stable(middle) { stable = middle } else { unstable = middle }
        }
        stable
    };
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut start = Some(0.0);
    let mut before = 0.0;
    while before < LARGEST {
        let z = before + if before < FINE { GRID[0] } else { GRID[1] };
        match (start, is_stable(z)) {
            (Some(from), false) => {
                // Where the first point is unstable already, the edge is searched below it.
                let bracket = if before > 0.0 {
                    Some([before, z])
                } else {
                    let below = (1..=DESCENTS).map(|n| z * 0.5_f64.powi(n));
                    below.map(|z| [z, 2.0 * z]).find(|[z, _]| is_stable(*z))
                };
                ranges.extend(bracket.map(|[stable, unstable]| [from, edge(stable, unstable)]));
                start = None;
            }
            (None, true) => start = Some(edge(z, before)),
            _ => {}
        }
        before = z;
    }
    ranges.extend(start.map(|from| [from, LARGEST]));
    ranges
}

/// The velocities that start the vibration, as multiples of the shortest spring's length: those
/// of the accelerations of a perturbed pose, so that every mode has its share and free motions,
/// which no spring resists, have none.
fn kick(mechanism: &Mechanism, rest: &Reference, frequency: f64) -> Option<Vec<[Vec3<f64>; 2]>> {
    let accelerations = mechanism.accelerations(&perturbed(rest), 0.0);
    let largest =
        accelerations.iter().map(|a| a.linear.amax().max(a.angular.amax())).fold(0.0, f64::max);
    let scale = frequency / largest;
    let vector = |v: nalgebra::Vector3<f64>| Vec3::from_f64((v * scale).into());
    scale
        .is_finite()
        .then(|| accelerations.iter().map(|a| [vector(a.linear), vector(a.angular)]).collect())
}

/// A resting model that starts with the velocities of a kick of this amplitude.
fn kicked(mut model: SceneModel<F64>, kick: &[[Vec3<f64>; 2]], amplitude: f64) -> SceneModel<F64> {
    let size = amplitude * shortest(&model);
    for (body, [linear, angular]) in model.initial.iter_mut().zip(kick) {
        body.velocity = *linear * size;
        body.angular_velocity = *angular * size;
    }
    model
}

/// Whether a run of so many steps of the size `step` \[s\] keeps its energy in bounds, `noise` of
/// which is rounding.
fn is_bounded(model: &SceneModel<F64>, method: &Method, noise: f64, step: f64, steps: u64) -> bool {
    let Ok(mut plant) = plant_of_model(model, method, step) else { return false };
    let start = plant.energy().total();
    let (mut first, mut last) = (start, 0.0_f64);
    for look in LOOKS.into_iter().cycle() {
        if plant.steps() >= steps {
            break;
        }
        if !plant.advance(look).is_running() {
            return false;
        }
        let now = plant.energy().total();
        // Written so that NaN ends it, too.
        let bounded = now < GROWN * start;
        if !bounded {
            return false;
        }
        if 3 * plant.steps() <= steps {
            first = first.max(now);
        } else if 3 * plant.steps() > 2 * steps {
            last = last.max(now);
        }
    }
    last <= 2.0 * first.max(noise * start)
}

/// \[m\] the shortest spring that has a length; 1 where none has.
fn shortest(model: &SceneModel<F64>) -> f64 {
    let lengths = model.tsdas.iter().map(|tsda| tsda.free_length);
    let shortest = lengths.filter(|length| *length > 0.0).fold(f64::INFINITY, f64::min);
    if shortest.is_finite() { shortest } else { 1.0 }
}
