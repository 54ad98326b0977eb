//! Rounding losses of slow motion in single precision.
//!
//! `(states of consecutive steps) => rounding loss per body`. A step adds h·v to a position. If that is not far above
//! the last digit of the position, the sum is rounded in the same direction in every step, and a slow body moves too
//! far, too little or not at all. The loss of a position is its change minus the integral of its velocity by the
//! trapezoidal rule, whose error does not grow with time. Only steps in which rounding is visible count: in others the
//! error of the scheme may be larger.

use dbd_kernel::{BodyState, F64};
use dbd_scene::single::{LAST_TURN, last_digit};

use crate::any::AnyPlant;

/// A step counts if its increment is less than this many times the last digit of the sum.
const COUNTED: f64 = 1024.0;

/// \[1\] Minimum fraction of its motion that a body must lose to be listed.
const LOST: f64 = 1e-3;

/// \[1\] Minimum loss to be listed, in last digits: joints correct smaller losses.
const REPORTED: f64 = 1024.0;

/// Rounding loss of a body's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// The row of the body.
    pub body: usize,
    /// Whether it is a rotation \[rad\] and not a displacement \[m\].
    pub turn: bool,
    /// \[m, rad\] the largest loss.
    pub lost: f64,
    /// \[m, rad\] the largest displacement of the body from its start, by its velocity.
    pub moved: f64,
    /// \[s\] when the loss was largest.
    pub time: f64,
}

/// A sum of rounding errors and the motion that it is compared with, in the world's axes.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    errors: [f64; 3],
    motion: [f64; 3],
    lost: f64,
    moved: f64,
    time: f64,
    /// The largest rounded sum.
    last_digit: f64,
}

impl Sums {
    fn add(&mut self, change: [f64; 3], meant: [f64; 3], last_digit: f64, time: f64) {
        let counts = length(meant) < COUNTED * last_digit;
        for i in 0..3 {
            self.motion[i] += meant[i];
            if counts {
                self.errors[i] += change[i] - meant[i];
            }
        }
        self.moved = self.moved.max(length(self.motion));
        self.last_digit = self.last_digit.max(last_digit);
        let lost = length(self.errors);
        if lost > self.lost {
            (self.lost, self.time) = (lost, time);
        }
    }
}

/// Monitor of the rounding losses of a plant in single precision.
#[derive(Clone, Debug)]
pub struct RoundingWatch {
    last: Vec<BodyState<F64>>,
    next: Vec<BodyState<F64>>,
    /// Per body, of its displacement and of its rotation.
    sums: Vec<[Sums; 2]>,
}

impl RoundingWatch {
    /// A monitor from a plant's present state on; `None` if its precision has no significant losses.
    #[must_use]
    pub fn new(plant: &dyn AnyPlant) -> Option<Self> {
        let precision = plant.method().precision();
        if !precision.is_single() {
            return None;
        }
        let mut last = Vec::new();
        plant.bodies(&mut last);
        let sums = vec![Default::default(); last.len()];
        Some(Self { next: last.clone(), last, sums })
    }

    /// Updates with the plant after one more step.
    pub fn look(&mut self, plant: &dyn AnyPlant) {
        plant.bodies(&mut self.next);
        let half = 0.5 * plant.step_size();
        let time = plant.time();
        let states = self.last.iter().zip(&self.next);
        for ((last, next), [way, turn]) in states.zip(&mut self.sums) {
            let [x, y] = [last, next].map(|state| state.position.to_f64());
            let [v, w] = [last, next].map(|state| state.velocity.to_f64());
            let change = std::array::from_fn(|i| y[i] - x[i]);
            way.add(change, std::array::from_fn(|i| half * (v[i] + w[i])), last_digit(y), time);
            let [q, r] = [last, next].map(|state| state.orientation.to_f64());
            let [v, w] = [last, next].map(|state| state.angular_velocity.to_f64());
            let meant = std::array::from_fn(|i| half * (v[i] + w[i]));
            turn.add(in_world(r, turned(q, r)), in_world(r, meant), LAST_TURN, time);
        }
        std::mem::swap(&mut self.last, &mut self.next);
    }

    /// The bodies that lost more than a thousandth of their displacement and more than 1024 last digits, the largest
    /// fraction first.
    #[must_use]
    pub fn losses(&self) -> Vec<Loss> {
        let mut losses: Vec<Loss> = Vec::new();
        for (body, sums) in self.sums.iter().enumerate() {
            for (sums, turn) in sums.iter().zip([false, true]) {
                let Sums { lost, moved, time, last_digit, .. } = *sums;
                if lost > (LOST * moved).max(REPORTED * last_digit) && moved > 0.0 {
                    losses.push(Loss { body, turn, lost, moved, time });
                }
            }
        }
        losses.sort_by(|a, b| (b.lost / b.moved).total_cmp(&(a.lost / a.moved)));
        losses
    }
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// \[rad\] the small rotation from an orientation to another, in body axes.
fn turned(q: [f64; 4], r: [f64; 4]) -> [f64; 3] {
    let [a, b, c, d] = q;
    let [e, f, g, h] = r;
    let scalar = a * e + b * f + c * g + d * h;
    [a * f - b * e - c * h + d * g, a * g + b * h - c * e - d * f, a * h - b * g + c * f - d * e]
        .map(|part| 2.0 * part / scalar)
}

/// A vector of a body in the world's axes.
fn in_world(q: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let [w, x, y, z] = q;
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let once = cross([x, y, z], v);
    let twice = cross([x, y, z], once);
    std::array::from_fn(|i| v[i] + 2.0 * (w * once[i] + twice[i]))
}
