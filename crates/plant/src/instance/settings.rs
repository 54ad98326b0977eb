//! Scheme, precision and step by name.
//!
//! `names => method; (method, scene) => step`. Defaults are those of `host-sim run`.

use crate::plan::step_of;
use crate::{DampingName, Frequencies, Method, Named, PlanError, PrecisionName, SchemeName};
use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::instance::error::InstanceError;

/// Settings of a run. `None` selects the scene's value or the default.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The scheme's name, [`SchemeName`].
    pub scheme: Option<String>,
    /// Newton iterations, for the schemes that have them.
    pub newton: Option<u32>,
    /// \[1\] ρ∞, for the scheme that has it.
    pub rho: Option<f64>,
    /// The damping's name, [`DampingName`].
    pub damping: Option<String>,
    /// The precision's name, [`PrecisionName`].
    pub precision: Option<String>,
    /// \[s\] the step.
    pub step: Option<f64>,
}

impl Settings {
    /// The method with these names.
    ///
    /// # Errors
    /// For an unknown name or an invalid combination.
    pub fn method(&self) -> Result<Method, InstanceError> {
        let scheme = choice::<SchemeName>("scheme", self.scheme.as_deref())?.unwrap_or_default();
        let precision = choice("precision", self.precision.as_deref())?;
        let precision: PrecisionName = precision.unwrap_or_default();
        let method = Method::new(scheme, self.newton, precision)?;
        let method = match self.rho {
            Some(rho) => method.with_rho(rho)?,
            None => method,
        };
        Ok(match choice::<DampingName>("damping", self.damping.as_deref())? {
            Some(damping) => method.with_damping(damping)?,
            None => method,
        })
    }

    /// \[s\] the step of a scene: the requested one, else the scene's, else the advised one, shortened to fit duration
    /// and sampling interval.
    ///
    /// # Errors
    /// Where no step fits these.
    pub fn step_of(&self, scene: &Scene, method: &Method) -> Result<f64, PlanError> {
        let longest = || Frequencies::of(scene).default_limit(method, scene.duration);
        step_of(scene, self.step, longest)
    }
}

fn choice<N: Named>(kind: &'static str, name: Option<&str>) -> Result<Option<N>, InstanceError> {
    let Some(name) = name else { return Ok(None) };
    N::of_name(name).map(Some).ok_or_else(|| InstanceError::Choice {
        kind,
        name: name.to_owned(),
        known: N::ALL.iter().map(|choice| choice.name()).collect(),
    })
}
