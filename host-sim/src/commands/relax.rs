//! `host-sim relax`: the static equilibrium of a scene under its loads.
//!
//! `scene => scene at rest, what was moved, forces that remain`. The search is that of `settle = true`.

use dbd_plant::digits::significant;
use dbd_scene::{Restless, Scene};
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::commands::assembled::SettledCheck;
use crate::commands::write::{self, WriteError};
use crate::terminal::Look;

/// Why a scene was not settled, or not written.
#[derive(Debug, Error, Diagnostic)]
pub enum RelaxError {
    /// It has no equilibrium.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Restless(#[from] Restless),
    /// It was not written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Write(#[from] WriteError),
    /// Both would go to standard output.
    #[error("--out - and --json both write to standard output")]
    #[diagnostic(help("use only one of them, or write the scene to a file with --out FILE"))]
    Both,
}

/// A scene at rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Relaxed {
    /// Its name.
    pub scene: String,
    /// \[N\] the largest force on a body at rest; of a planar scene in its plane.
    pub residual_force: f64,
    /// \[N·m\] the largest torque on a body at rest.
    pub residual_torque: f64,
    /// \[m\] the largest distance by which a body was moved.
    pub largest_distance: f64,
    /// \[rad\] the largest angle by which a body was turned.
    pub largest_angle: f64,
    /// What was moved.
    #[serde(flatten)]
    pub settled: SettledCheck,
}

/// Brings a scene to rest: the scene, and what was done.
///
/// # Errors
/// [`Restless`].
pub fn relax(scene: &Scene) -> Result<(Scene, Relaxed), Restless> {
    let rest = dbd_scene::relaxed(scene)?;
    let settled = SettledCheck::of(&rest).unwrap_or_default();
    let [force, torque] = rest.settled.as_ref().map_or([0.0; 2], |rest| [rest.force, rest.torque]);
    let moved = &settled.moved;
    let relaxed = Relaxed {
        scene: scene.name.clone(),
        residual_force: force,
        residual_torque: torque,
        largest_distance: moved.iter().map(|moved| moved.distance).fold(0.0, f64::max),
        largest_angle: moved.iter().map(|moved| moved.angle).fold(0.0, f64::max),
        settled,
    };
    Ok((rest, relaxed))
}

/// The text of a scene in equilibrium, verified to read back to the same bits.
///
/// # Errors
/// [`WriteError`] where it does not.
pub fn text_at_rest(rest: &Scene, file: &str) -> Result<String, WriteError> {
    write::seen_to_read_back(rest, rest.long_text()?, file)
}

impl Relaxed {
    /// The report for people.
    #[must_use]
    pub fn text(&self, look: Look) -> String {
        let two = |one: f64, unit: &str, other: f64, unit_of_other: &str| {
            format!("{} {unit}, {} {unit_of_other}", significant(one, 3), significant(other, 3))
        };
        look.table(&[
            ("scene", self.scene.clone()),
            ("moved", self.settled.sentence()),
            ("largest displacement", two(self.largest_distance, "m", self.largest_angle, "rad")),
            ("residual", two(self.residual_force, "N", self.residual_torque, "N·m")),
        ])
    }
}
