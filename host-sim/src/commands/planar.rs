//! The plane of a scene as `check` reports it: whether it exists, its savings, or the elements outside it.
//!
//! `scene => plane, freedoms and elements before and in it; what leaves it`.

use dbd_scene::Scene;
use serde::Serialize;

/// Largest number of reported departures; the others are counted.
const MAX_REPORTED: usize = 5;

/// The plane of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaneCheck {
    /// The plane of the scene, or the plane with the fewest departures.
    pub plane: String,
    /// Whether all of the scene stays in it.
    pub planar: bool,
    /// Whether the scene requests it and so runs as the planar model.
    pub asked: bool,
    /// Equations of motion of the planar model: 3 per body. `None` where the scene is not planar.
    pub equations: Option<usize>,
    /// TSDAs of the planar model, likewise.
    pub tsdas: Option<usize>,
    /// The joints and raw elements that are as stiff in it at rest only: the others are the same at
    /// any stretch.
    pub at_rest: usize,
    /// Number of departures from the plane.
    pub departures: usize,
    /// The first departures, each with its size.
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
                let reported = unplanar.departures.iter().take(MAX_REPORTED);
                Self {
                    planar: false,
                    asked,
                    equations: None,
                    tsdas: None,
                    at_rest: 0,
                    departures: unplanar.departures.len(),
                    leaves: reported.map(|departure| departure.text(scene)).collect(),
                    plane: unplanar.plane,
                }
            }
        }
    }

    /// The report for people.
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
