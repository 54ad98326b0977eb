//! The largest stable step of a method on a scene, found by running it.
//!
//! `(model, pose, method) => stable ranges of z = ω·h`, ω the highest eigenfrequency. The pose is
//! frozen: no velocities, gravity, loads, inputs or preloads, every spring at its present length,
//! clearances closed; dampers are kept. About it the mechanism vibrates with an amplitude of 1e-7
//! of its shortest spring, in all its elastic modes at once, in space, for 100 periods of the
//! fastest, 600 steps at least and 2500 at most. A step is unstable where the largest energy of the
//! last third exceeds twice that of the first, as for a mode that gains 1e-3 of its amplitude per step, or any energy a
//! thousand times the initial. z is scanned from small to large, because there may be several stable ranges; edges are
//! refined by bisection. Always in double precision: rounding does not move the limit, but in a soft mode its energy
//! looks like growth.

use std::f64::consts::TAU;

use crate::reference::perturbed::perturbed;
use crate::reference::{Mechanism, State as Reference, eigenfrequencies};
use dbd_kernel::{F64, State, Vec3};
use dbd_plant::{Method, MethodError, OrientationName, PrecisionName, plant_of_model};
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

/// The energy, over the initial, at which a trial ends: at 1.999 of 2 an oscillation of leapfrog reaches it.
const GROWN: f64 = 1e3;

/// Margin of an advised step as a fraction of the largest stable one: frequencies change along a motion, and only the
/// pose at t = 0 is analysed.
pub const MARGIN: f64 = 0.15;

/// The vibration's amplitude over the shortest spring.
const AMPLITUDE: f64 = 1e-7;

/// The fraction of the initial energy caused by rounding.
const NOISE: f64 = 1e-9;

/// Steps between energy checks, in rotation, to avoid aliasing with an oscillation.
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

/// The stability of a method about a pose of a model; `None` if nothing vibrates.
///
/// # Errors
/// [`MethodError::Restless`] in a precision in which no pose is in equilibrium, [`MethodError::Comparison`] if this
/// build does not include the method.
pub fn stability(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    method: &Method,
) -> Result<Option<Stability>, MethodError> {
    // A method that has no stability is refused where nothing vibrates, too.
    judged(method)?;
    Vibration::about(model, state).map(|vibration| vibration.stability(method)).transpose()
}

/// A mechanism that vibrates about a frozen pose.
#[derive(Clone, Debug)]
pub struct Vibration {
    /// \[rad/s\] its highest eigenfrequency.
    pub frequency: f64,
    /// The model at rest except for the initial velocities.
    kicked: SceneModel<F64>,
}

impl Vibration {
    /// The vibration about a pose of a model; `None` if nothing vibrates.
    #[must_use]
    pub fn about(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> Option<Self> {
        let frozen = frozen(model, state);
        let (mechanism, rest) = Mechanism::of_model(&frozen);
        let frequency = eigenfrequencies(&mechanism, &rest, 0.0).last().copied().unwrap_or(0.0);
        if frequency <= 0.0 {
            return None;
        }
        let kick = kick(&mechanism, &rest, frequency)?;
        Some(Self { frequency, kicked: kicked(frozen, &kick, AMPLITUDE) })
    }

    /// The stability of a method.
    ///
    /// # Errors
    /// As [`stability`].
    pub fn stability(&self, method: &Method) -> Result<Stability, MethodError> {
        let method = judged(method)?;
        let ranges: Vec<[f64; 2]> = Scan::new(|z| self.is_stable(&method, z)).collect();
        Ok(self.found(ranges))
    }

    /// The first range only, which contains a method's largest stable step.
    ///
    /// # Errors
    /// As [`stability`].
    pub fn first_range(&self, method: &Method) -> Result<Stability, MethodError> {
        let method = judged(method)?;
        let first = Scan::new(|z| self.is_stable(&method, z)).next();
        Ok(self.found(first.into_iter().collect()))
    }

    fn found(&self, ranges: Vec<[f64; 2]>) -> Stability {
        let first = ranges.first().filter(|range| range[0] == 0.0).map_or(0.0, |range| range[1]);
        Stability { frequency: self.frequency, largest_step: first / self.frequency, ranges }
    }

    /// Whether a method, in its own precision, is stable at a `z`.
    #[must_use]
    pub fn is_stable(&self, method: &Method, z: f64) -> bool {
        let steps = (PERIODS * TAU / z).clamp(STEPS[0], STEPS[1]).ceil() as u64;
        is_bounded(&self.kicked, method, z / self.frequency, steps)
    }
}

/// The method in double precision, with quaternions.
fn judged(method: &Method) -> Result<Method, MethodError> {
    method.check_built()?;
    if method.precision() == PrecisionName::F32Micromath {
        return Err(MethodError::Restless { precision: method.precision_name() });
    }
    let method = method.with_precision(PrecisionName::F64);
    Ok(method.with_orientation(OrientationName::Quaternion))
}

/// The stable ranges of z, ascending, found one after the other.
struct Scan<S> {
    is_stable: S,
    /// The last point of the grid that was looked at.
    before: f64,
    /// Where the range that is stable there begins.
    start: Option<f64>,
}

impl<S: Fn(f64) -> bool> Scan<S> {
    fn new(is_stable: S) -> Self {
        Self { is_stable, before: 0.0, start: Some(0.0) }
    }

    /// The edge between a stable and an unstable z.
    fn edge(&self, mut stable: f64, mut unstable: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stable + unstable);
            if (self.is_stable)(middle) { stable = middle } else { unstable = middle }
        }
        stable
    }
}

impl<S: Fn(f64) -> bool> Iterator for Scan<S> {
    type Item = [f64; 2];

    fn next(&mut self) -> Option<[f64; 2]> {
        while self.before < LARGEST {
            let before = self.before;
            let z = before + if before < FINE { GRID[0] } else { GRID[1] };
            self.before = z;
            match (self.start, (self.is_stable)(z)) {
                (Some(from), false) => {
                    self.start = None;
                    // Where the first point is unstable already, the edge is searched below it.
                    let bracket = if before > 0.0 {
                        Some([before, z])
                    } else {
                        let below = (1..=DESCENTS).map(|n| z * 0.5_f64.powi(n));
                        below.map(|z| [z, 2.0 * z]).find(|[z, _]| (self.is_stable)(*z))
                    };
                    if let Some([stable, unstable]) = bracket {
                        return Some([from, self.edge(stable, unstable)]);
                    }
                }
                (None, true) => self.start = Some(self.edge(z, before)),
                _ => {}
            }
        }
        self.start.take().map(|from| [from, LARGEST])
    }
}

/// The velocities that start the vibration, as multiples of the shortest spring's length: those
/// of the accelerations of a perturbed pose, so that every elastic mode is excited and free motions are not.
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

/// Whether a run of the given number of steps of `step` \[s\] keeps its energy in bounds.
fn is_bounded(model: &SceneModel<F64>, method: &Method, step: f64, steps: u64) -> bool {
    let Ok(mut plant) = plant_of_model(model, method, step) else { return false };
    let start = plant.energy().total();
    let (mut first, mut last) = (start, 0.0_f64);
    for look in LOOKS.into_iter().cycle() {
        if plant.steps() >= steps {
            break;
        }
        if plant.advance(look).is_err() {
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
    last <= 2.0 * first.max(NOISE * start)
}

/// \[m\] the shortest spring that has a length; 1 where none has.
fn shortest(model: &SceneModel<F64>) -> f64 {
    let lengths = model.tsdas.iter().map(|tsda| tsda.free_length);
    let shortest = lengths.filter(|length| *length > 0.0).fold(f64::INFINITY, f64::min);
    if shortest.is_finite() { shortest } else { 1.0 }
}
