//! Step limits of a method: the largest stable and the largest advised step.
//!
//! `(scene, methods) => largest stable and largest advised step per method`. A stable step is within the linear limit
//! at the highest frequency of the pose at t = 0, preloads included, and within the limit that [`crate::stability`]
//! finds by running, with dampers and motion out of the plane of a planar scene. An advised step is [`MARGIN`] below
//! that, and no body rotates too far: a run accepts it without a warning. Explicit references with dampers use the
//! limit of the kernel's explicit step.

use dbd_kernel::State;
use dbd_plant::{DampingName, Frequencies, Method, OrientationName, PrecisionName, SchemeName};
use dbd_scene::Scene;

use crate::stability::{MARGIN, Vibration};
use crate::ways::Way;

/// A step above the limit by more than this fraction counts as unstable: limits are found more accurately, and the
/// estimate of the frequency is at most this much too low.
const SLACK: f64 = 0.01;

/// Bounds of the steps of a scene, independent of the method.
#[derive(Clone, Debug)]
pub struct Limits {
    frequencies: Frequencies,
    vibration: Option<Vibration>,
    damped: bool,
}

/// Step limits of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// \[s\] the largest stable step; 0 where none is, infinite where all are.
    pub stable: f64,
    /// \[s\] the largest advised one: below it by [`MARGIN`], or shorter if a body rotates fast.
    pub advised: f64,
}

impl Limit {
    /// Whether a step exceeds the stable one.
    #[must_use]
    pub fn is_beyond(&self, step: f64) -> bool {
        step > self.stable * (1.0 + SLACK)
    }

    /// \[s\] where a ladder of steps begins: the margin above the largest advised one.
    #[must_use]
    pub fn ladder_top(&self) -> f64 {
        self.advised / (1.0 - MARGIN)
    }

    /// Whether a step may be advised.
    #[must_use]
    pub fn advises(&self, step: f64) -> bool {
        step <= self.advised
    }
}

impl Limits {
    /// The limits of a scene; of a planar one in its plane.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let model = &*scene.in_world();
        let vibration = Vibration::about(model, &State::initial(model));
        let damped = !scene.model.dampers.is_empty();
        Self { frequencies: Frequencies::of(scene), vibration, damped }
    }

    /// The limits of a scene in space, also if it is planar: it may leave its plane.
    #[must_use]
    pub fn in_space(scene: &Scene) -> Self {
        let mut spatial = scene.clone();
        spatial.planar = None;
        Self::of(&spatial)
    }

    /// \[rad/s\] the highest frequency; 0 where nothing vibrates.
    #[must_use]
    pub fn highest(&self) -> f64 {
        let found = self.vibration.as_ref().map_or(0.0, |vibration| vibration.frequency);
        self.frequencies.estimate.max(found)
    }

    /// The method whose stability decides for a method's: precision and orientation do not change it. `None` if only
    /// the linear limit does.
    #[must_use]
    pub fn decisive(&self, way: &Way) -> Option<Method> {
        self.vibration.as_ref()?;
        if way.stability_limit().is_infinite() {
            return None;
        }
        let method = match way {
            Way::Kernel(method) => *method,
            // One evaluation with explicit dampers per step: at most as stable as the kernel's.
            _ if self.damped => {
                let method = Method::new(SchemeName::SemiImplicitEuler, None, PrecisionName::F64);
                method.and_then(|method| method.with_damping(DampingName::Explicit)).ok()?
            }
            _ => return None,
        };
        let method = method.with_precision(PrecisionName::F64);
        Some(method.with_orientation(OrientationName::Quaternion))
    }

    /// \[s\] the largest stable step of a decisive method, found by running it: as
    /// `check --stability` finds it.
    #[must_use]
    pub fn found(&self, method: &Method) -> f64 {
        let vibration = self.vibration.as_ref();
        let found = vibration.map(|vibration| vibration.first_range(method));
        // A method that cannot be run has no stable step.
        found.map_or(f64::INFINITY, |found| found.map_or(0.0, |found| found.largest_step))
    }

    /// The limit of a method, given the one [`found`](Self::found) for its decisive method.
    #[must_use]
    pub fn limit(&self, way: &Way, found: Option<f64>) -> Limit {
        let highest = self.highest();
        let linear = if highest > 0.0 { way.stability_limit() / highest } else { f64::INFINITY };
        let stable = linear.min(found.unwrap_or(f64::INFINITY));
        let turn = match way {
            Way::Kernel(_) => self.frequencies.longest_turn(),
            _ => f64::INFINITY,
        };
        Limit { stable, advised: ((1.0 - MARGIN) * stable).min(turn) }
    }
}
