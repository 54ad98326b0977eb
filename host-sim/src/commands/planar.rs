//! What `check` says of a scene's plane: whether it has one, what that saves, or what leaves it.
//!
//! `scene => plane, freedoms and elements before and in it; what leaves it`.

use dbd_scene::Scene;
use serde::Serialize;

/// The most departures that are told; the others are counted.
const MOST_TOLD: usize = 5;

/// What is known of a scene's plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaneCheck {
    /// The plane: that in which the scene lies, or that which the least leaves.
    pub plane: String,
    /// Whether all of the scene stays in it.
    pub planar: bool,
    /// Whether the scene asks for it: what runs is the planar model then.
    pub asked: bool,
    /// Equations of motion of the planar model: 3 per body. `None` where the scene is not planar.
    pub equations: Option<usize>,
    /// TSDAs of the planar model, likewise.
    pub tsdas: Option<usize>,
    /// The joints and raw elements that are as stiff in it at rest only: the others are the same at
    /// any stretch.
    pub at_rest: usize,
    /// How many things leave the plane.
    pub departures: usize,
    /// The first of them: what leaves it, by how much.
    pub leaves: Vec<String>,
}

impl PlaneCheck {
    /// Of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let asked = scene.planar.is_some();
        match dbd_scene::reduced(scene) {
            Ok(planar) => Self {
                plane: planar.plane.name(),
                planar: true,
                asked,
                equations: Some(3 * planar.model.bodies.len()),
                tsdas: Some(planar.model.tsda_count()),
                at_rest: planar.at_rest.len(),
                departures: 0,
                leaves: Vec::new(),
            },
            Err(unplanar) => {
                let told = unplanar.departures.iter().take(MOST_TOLD);
                Self {
                    planar: false,
                    asked,
                    equations: None,
                    tsdas: None,
                    at_rest: 0,
                    departures: unplanar.departures.len(),
                    leaves: told.map(|departure| departure.text(scene)).collect(),
                    plane: unplanar.plane,
                }
            }
        }
    }

    /// What people read.
    pub(crate) fn text(&self) -> String {
        match (self.equations, self.tsdas) {
            (Some(equations), Some(tsdas)) => {
                let how = if self.asked { "runs in it" } else { "with --planar" };
                format!("{}; {how}: {equations} equations, {tsdas} TSDAs", self.plane)
            }
            _ => {
                let first = self.leaves.first().map_or("", String::as_str);
                let more = match self.departures.saturating_sub(1) {
                    0 => String::new(),
                    more => format!("; {more} more"),
                };
                format!("none: {first}{more}")
            }
        }
    }
}
