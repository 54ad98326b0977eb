//! What sums in single precision lose of slow motion.
//!
//! `(states of consecutive steps) => per body what its sums rounded off`. A step adds h·v to a position. Where
//! that is not far above the last digit that the position holds, the sum rounds, step after step the same way, and a
//! slow body moves too far, too little or not at all. What a position lost is its change less the integral
//! of its velocity by the trapezoidal rule over every step, whose own error does not grow with time. Only steps
//! count in which rounding can be seen: others may have an error of the scheme that is larger.

use dbd_kernel::{BodyState, F64};
use dbd_scene::single::{LAST_TURN, last_digit};

use crate::any::AnyPlant;

/// A step counts where it adds less than this many times the last digit of what it adds to.
const COUNTED: f64 = 1024.0;

/// \[1\] Least share of its motion that a body must lose to be listed.
const LOST: f64 = 1e-3;

/// \[1\] Least loss to be listed, in last digits: joints give way by less, and put it right.
const TOLD: f64 = 1024.0;

/// What a body's sums lost of its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// The row of the body.
    pub body: usize,
    /// Whether it is a turn \[rad\] and not a way \[m\].
    pub turn: bool,
    /// \[m, rad\] the most that was lost.
    pub lost: f64,
    /// \[m, rad\] how far the body went from its start at most, by its velocity.
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
    /// The largest that a sum was rounded to.
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

/// A watch over what a plant in single precision rounds off.
#[derive(Clone, Debug)]
pub struct RoundingWatch {
    last: Vec<BodyState<F64>>,
    next: Vec<BodyState<F64>>,
    /// Per body of its way and of its turn.
    sums: Vec<[Sums; 2]>,
}

impl RoundingWatch {
    /// A watch from a plant's present state on; `None` where its sums lose nothing that counts.
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

    /// Looks at the plant after one more step.
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

    /// The bodies that lost more than a thousandth of how far they went and more than 1024 last digits, the largest share
    /// first.
    #[must_use]
    pub fn losses(&self) -> Vec<Loss> {
        let mut losses: Vec<Loss> = Vec::new();
        for (body, sums) in self.sums.iter().enumerate() {
            for (sums, turn) in sums.iter().zip([false, true]) {
                let Sums { lost, moved, time, last_digit, .. } = *sums;
                if lost > (LOST * moved).max(TOLD * last_digit) && moved > 0.0 {
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

/// \[rad\] the small turn from an orientation to another, in the body's axes.
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
