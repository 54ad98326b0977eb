//! The runs that a recommendation has to pass before it is given.
//!
//! `(model, method, step, time) => steps that went well, when it failed`. A step that is stable at t = 0 may fail
//! later, as frequencies and speeds rise along the motion; a mechanism may also come apart by itself, whatever the
//! step.

use dbd_plant::monitor::{Monitor, Opening};
use dbd_plant::{Frequencies, Method, PlantError, plant};
use dbd_scene::Scene;
use serde::Serialize;

/// Factor of the scene's duration over which a recommendation is run.
pub const FURTHER: f64 = 10.0;

/// Steps × bodies of a run, at most: about a minute.
const AFFORDABLE: f64 = 3e8;

/// Number of checks of a run.
const LOOKS: u64 = 500;

/// A model that fails with this many steps per default step of leapfrog in double precision fails with any.
const FINER: f64 = 16.0;

/// Extent of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Followed {
    /// Steps that went well.
    pub(super) steps: u64,
    /// \[s\] time of failure, within one check interval; `None` if it did not fail.
    pub(super) fails: Option<f64>,
}

/// Time and cause of a scene's failure with any step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ends {
    /// \[s\] about when.
    pub time: f64,
    /// The joint that opens by more than its own size; where no such joint is, a step fails, however short it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
}

/// Runs a model over a time \[s\], or as long as is affordable.
///
/// # Errors
/// [`PlantError`] where the method cannot step it.
pub(super) fn follow(
    model: &Scene,
    method: &Method,
    step: f64,
    until: f64,
) -> Result<Followed, PlantError> {
    look(model, method, step, until, &mut |_, _| false)
}

/// Failure of a model over a time \[s\] with short steps; `None` if they complete.
pub(super) fn ends(model: &Scene, until: f64) -> Option<Ends> {
    let method = Method::default();
    let step = Frequencies::of(model).default_limit(&method, model.duration) / FINER;
    let mut apart = None;
    let followed = look(model, &method, step, until, &mut |monitor, time| {
        let is_open = |opening: &&Opening| opening.extension > opening.free_length;
        let open = monitor.openings().iter().find(is_open);
        let joint = open.and_then(|opening| model.joints.get(opening.joint));
        apart = joint.map(|joint| Ends { time, joint: Some(joint.name.clone()) });
        apart.is_some()
    });
    let fails = followed.ok()?.fails;
    apart.or_else(|| fails.map(|time| Ends { time, joint: None }))
}

/// Runs a model until a check ends it.
fn look(
    model: &Scene,
    method: &Method,
    step: f64,
    until: f64,
    enough: &mut dyn FnMut(&Monitor, f64) -> bool,
) -> Result<Followed, PlantError> {
    let mut plant = plant(model, method, step)?;
    let bodies = model.body_names.len().max(1) as f64;
    let steps = (until / step).round().min(AFFORDABLE / bodies).max(1.0) as u64;
    let mut monitor = Monitor::new(model, plant.as_ref());
    let stride = steps.div_ceil(LOOKS);
    let mut done = 0;
    while done < steps {
        let some = stride.min(steps - done);
        if plant.advance(some).is_err() || monitor.check(&plant.state()).is_err() {
            return Ok(Followed { steps: done, fails: Some(plant.time()) });
        }
        done += some;
        if enough(&monitor, plant.time()) {
            break;
        }
    }
    Ok(Followed { steps: done, fails: None })
}
