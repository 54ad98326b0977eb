//! The files of a run for people.
//!
//! `(recording, words) => report.html, SCENE.glb`. Files of an earlier run that were not requested are
//! removed.

use std::io::{self, Write as _};

use dbd_report::data::{Mode, Text};
use dbd_report::output::set::FileSet;
use dbd_report::{Data, Recorded, Recording, gltf, page};
use dbd_scene::Scene;

/// The requested files.
pub struct Shown<'s> {
    /// Whether there is a page.
    pub report: bool,
    /// Whether there is an animation.
    pub gltf: bool,
    /// The animation's file.
    pub animation: &'s str,
}

/// Writes the requested files of a run; `words` are the texts of its page, `modes` its animated modes.
///
/// # Errors
/// Where a file cannot be written, or the animation would be larger than 4 GiB.
pub fn show(
    files: &mut FileSet,
    shown: &Shown<'_>,
    scene: &Scene,
    recording: Option<Recording>,
    (words, modes): (Text, Vec<Mode>),
) -> io::Result<()> {
    let recorded = recording.map(Recording::finish);
    match recorded.as_ref().filter(|_| shown.gltf) {
        Some(Recorded { run, frames }) => {
            let mut file = files.begin(shown.animation)?;
            if let Some(mechanism) = &run.mechanism {
                file.write_all(&gltf::glb(mechanism, frames)?)?;
            }
            files.add(file);
        }
        None => files.without(shown.animation),
    }
    match recorded.filter(|_| shown.report) {
        Some(Recorded { run, .. }) => {
            let mut data = Data::of_run(&scene.name, &scene.description, run);
            (data.text, data.modes) = (words, modes);
            files.write("report.html", &page::html(&data))
        }
        None => {
            files.without("report.html");
            Ok(())
        }
    }
}
