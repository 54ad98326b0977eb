//! Highest frequency and angular velocity of a scene at t = 0, and the advised step.
//!
//! `scene => highest frequency: bound, estimate; largest angular velocity; advised step`. Always computed in double
//! precision, so that the default step of an explicit scheme depends on the scene alone. Valid at t = 0 only.

use std::f64::consts::TAU;

use dbd_kernel::{State, frequency};
use dbd_scene::Scene;
use dbd_scene::default_step::{
    Bears, LARGEST_TURN, STEPS_PER_PERIOD, fastest_spin, longest, shortest_period,
};

use crate::digits::{approximate, significant};
use crate::method::Method;
use crate::time::display;

/// Power iterations of the estimate: beyond 0.99 of the highest frequency on every scene that
/// ships, chains included, whose frequencies lie close together.
const ITERATIONS: u32 = 200;

/// The highest angular frequency and the largest angular velocity of a scene at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequencies {
    /// \[rad/s\] never below the true value; 0 where nothing vibrates.
    pub bound: f64,
    /// \[rad/s\] a lower bound, except for rounding: see
    /// [`dbd_kernel::frequency::estimate`].
    pub estimate: f64,
    /// \[rad/s\] the largest angular velocity of a body.
    pub spin: f64,
    /// The body with that angular velocity.
    pub fastest: usize,
    /// \[s\] the shortest period of a sine or a repeated table; infinite without one.
    pub period: f64,
}

impl Frequencies {
    /// The frequencies of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        // In the plane the bound excludes rotations out of it.
        let model = scene.stepped();
        let state = State::initial(model);
        let (spin, fastest) = fastest_spin(&state);
        Self {
            spin,
            fastest,
            period: shortest_period(model),
            bound: frequency::bound(model, &state),
            estimate: frequency::estimate(model, &state, ITERATIONS),
        }
    }

    /// \[Hz\] the bound.
    #[must_use]
    pub fn bound_hz(&self) -> f64 {
        self.bound / TAU
    }

    /// \[Hz\] the estimate.
    #[must_use]
    pub fn estimate_hz(&self) -> f64 {
        self.estimate / TAU
    }

    /// \[s\] half the stability limit of leapfrog, 1/ω of the bound, or the step in which the
    /// fastest body turns by [`LARGEST_TURN`], if that is shorter. `None` if nothing vibrates or rotates.
    #[must_use]
    pub fn advised_step(&self) -> Option<f64> {
        match (self.vibration_step(), self.spin_step()) {
            (Some(vibration), Some(spin)) => Some(vibration.min(spin)),
            (one, other) => one.or(other),
        }
    }

    fn vibration_step(&self) -> Option<f64> {
        (self.bound > 0.0).then(|| 1.0 / self.bound)
    }

    fn spin_step(&self) -> Option<f64> {
        (self.spin > 0.0).then(|| LARGEST_TURN / self.spin)
    }

    /// \[s\] the longest default step of a method: [`longest`].
    #[must_use]
    pub fn default_limit(&self, method: &Method, duration: f64) -> f64 {
        let bears =
            Bears { stability: method.stability_limit(), vibration: method.most_vibration() };
        longest(self.bound, self.spin, bears, duration).min(self.period / STEPS_PER_PERIOD)
    }

    /// \[s\] the longest step in which no body rotates too far; infinite if none rotates.
    #[must_use]
    pub fn longest_turn(&self) -> f64 {
        self.spin_step().unwrap_or(f64::INFINITY)
    }

    /// Warning about a step in which a body rotates too far.
    #[must_use]
    pub fn warning(&self, scene: &Scene, step: f64) -> Option<String> {
        let longest = self.spin_step()?;
        let turn = self.spin * step;
        if turn <= LARGEST_TURN * (1.0 + 1e-9) {
            return None;
        }
        let body = scene.body_names.get(self.fastest).map_or("", String::as_str);
        Some(format!(
            "body `{body}` turns by {} rad in a step of {} at t = 0: beyond {LARGEST_TURN} rad \
             energy and attitude are inaccurate; use a step of at most {}",
            significant(turn, 2),
            display(step),
            approximate(longest),
        ))
    }
}

/// Text of an advised step and its origin.
#[must_use]
pub fn advised_text(step: Option<f64>, bound_hz: f64) -> String {
    match step {
        Some(step) if step * bound_hz * TAU < 1.0 - 1e-9 => {
            format!("{} ({LARGEST_TURN} rad per step of the fastest body)", approximate(step))
        }
        Some(step) => format!("{} (1/ω of the bound)", approximate(step)),
        None => "– (nothing vibrates)".into(),
    }
}
