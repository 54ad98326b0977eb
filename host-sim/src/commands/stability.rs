//! `host-sim check --stability`: the largest stable step of a method on a scene.
//!
//! `(scene, method) => largest step, z, ranges`, about the pose at t = 0.

use std::f64::consts::TAU;

use dbd_kernel::State;
use dbd_plant::digits::{approximate, significant};
use dbd_plant::{Method, MethodError};
use dbd_scene::Scene;
use dbd_study::stability::{LARGEST, stability};
use serde::Serialize;

/// The stability of a method on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilityCheck {
    /// The scheme's name.
    pub scheme: &'static str,
    /// Its Newton iterations, for the schemes that have them.
    pub newton: Option<u32>,
    /// Its ρ∞, for the scheme that has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho: Option<f64>,
    /// Damping method.
    pub damping: &'static str,
    /// The precision's name.
    pub precision: &'static str,
    /// \[Hz\] the highest frequency of the frozen pose; 0 without vibration.
    pub frequency_hz: f64,
    /// \[s\] the largest stable step; `None` where nothing vibrates or no step was found stable.
    pub largest_step: Option<f64>,
    /// \[s\] for a planar scene, the same for its spatial model, which may tip; `None` for others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_step_in_space: Option<f64>,
    /// ω·h of the largest step.
    pub z: Option<f64>,
    /// The scheme's largest ω·h of one oscillator without damping.
    pub linear_limit: f64,
    /// Ranges of ω·h that were found stable, up to [`LARGEST`].
    pub ranges: Vec<[f64; 2]>,
}

impl StabilityCheck {
    /// The stability of a method about a scene's pose at t = 0.
    ///
    /// # Errors
    /// [`MethodError::Restless`] in a precision in which no pose is at rest.
    pub fn of(scene: &Scene, method: &Method) -> Result<Self, MethodError> {
        let model = &*scene.in_world();
        let found = stability(model, &State::initial(model), method)?;
        let some = found.as_ref().filter(|found| found.largest_step > 0.0);
        let in_space = match scene.planar {
            Some(_) => stability(&scene.model, &State::initial(&scene.model), method)?,
            None => None,
        };
        Ok(Self {
            scheme: method.scheme_name(),
            newton: method.newton(),
            rho: method.rho(),
            damping: method.damping().name(),
            precision: method.precision_name(),
            frequency_hz: found.as_ref().map_or(0.0, |found| found.frequency / TAU),
            largest_step: some.map(|found| found.largest_step),
            largest_step_in_space: in_space.map(|found| found.largest_step),
            z: some.map(|found| found.z()),
            linear_limit: method.stability_limit(),
            ranges: found.map_or(Vec::new(), |found| found.ranges),
        })
    }

    /// The report for people: names and texts.
    #[must_use]
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let newton = match self.newton {
            Some(1) => ", 1 Newton iteration".to_owned(),
            Some(n) => format!(", {n} Newton iterations"),
            None => String::new(),
        };
        let rho = self.rho.map(|rho| format!(", rho {rho}")).unwrap_or_default();
        let method = format!("{}{newton}{rho}, {}, {}", self.scheme, self.damping, self.precision);
        let step = match (self.largest_step, self.z) {
            (Some(_), Some(z)) if self.linear_limit.is_infinite() && z >= LARGEST => {
                format!("any with {method}: stable up to ω·h = {LARGEST}, where the scan ends")
            }
            (Some(step), Some(z)) => format!(
                "{} with {method}: ω·h = {} at {} Hz (one oscillator without damping: {})",
                approximate(step),
                significant(z, 4),
                significant(self.frequency_hz, 5),
                significant(self.linear_limit, 4),
            ),
            _ if self.frequency_hz == 0.0 => "– (nothing vibrates)".into(),
            _ => format!("no stable step was found with {method}"),
        };
        let about =
            "the pose at t = 0 without velocities: limits from angular velocity are not included";
        let mut rows = vec![("largest stable step", step), ("stability about", about.into())];
        if let Some(step) = self.largest_step_in_space {
            let step =
                if step > 0.0 { approximate(step) } else { "no stable step was found".into() };
            let text = format!(
                "{step}: includes tipping out of the plane, which the planar steps above do not"
            );
            rows.push(("stable in space", text));
        }
        let range = |[from, to]: &[f64; 2]| {
            let end = if *to < LARGEST { significant(*to, 4) } else { "the scan's end".into() };
            format!("{} to {end}", significant(*from, 4))
        };
        let again: Vec<String> = self.ranges.iter().filter(|r| r[0] > 0.0).map(range).collect();
        if !again.is_empty() {
            rows.push(("stable again", format!("ω·h {}", again.join(", "))));
        }
        rows
    }
}
