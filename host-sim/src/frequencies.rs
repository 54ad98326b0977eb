//! How fast a scene can vibrate at t = 0, and the step that follows from it.
//!
//! `scene => highest frequency: bound, estimate; advised step`. In double precision whatever
//! precision runs, so that a default step is a function of the scene alone. Speaks for the pose
//! at t = 0, not for the future.

use std::f64::consts::TAU;

use dbd_kernel::{State, frequency};
use dbd_scene::Scene;

/// Power iterations of the estimate: beyond 0.99 of the highest frequency on every scene that
/// ships, chains included, whose frequencies lie close together.
const ITERATIONS: u32 = 200;

/// Where nothing vibrates, a run takes this many steps.
const STEPS_WITHOUT_SPRINGS: f64 = 1000.0;

/// The highest angular frequency of a scene at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequencies {
    /// \[rad/s\] never below the true value; 0 where nothing vibrates.
    pub bound: f64,
    /// \[rad/s\] never above the true value.
    pub estimate: f64,
}

impl Frequencies {
    /// Those of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let state = State::initial(&scene.model);
        Self {
            bound: frequency::bound(&scene.model, &state),
            estimate: frequency::estimate(&scene.model, &state, ITERATIONS),
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

    /// \[s\] half the stability limit of leapfrog: 1/ω of the bound. `None` where nothing vibrates.
    #[must_use]
    pub fn advised_step(&self) -> Option<f64> {
        (self.bound > 0.0).then(|| 1.0 / self.bound)
    }

    /// \[s\] the longest step to take where none is given.
    #[must_use]
    pub fn default_limit(&self, duration: f64) -> f64 {
        self.advised_step().unwrap_or(duration / STEPS_WITHOUT_SPRINGS)
    }
}
