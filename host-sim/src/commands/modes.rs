//! The lowest modes of a scene about its pose at t = 0.
//!
//! `(scene, how many) => frequencies, motions, remarks`.

use dbd_kernel::State;
use dbd_report::data::Mode;
use dbd_report::packed::F32s;
use dbd_scene::Scene;
use dbd_study::modes::{ModesError, modes, remarks};

/// The lowest modes.
#[derive(Clone, Debug, PartialEq)]
pub struct LowestModes {
    /// \[Hz\] ascending; negative for an unstable mode, 0 for a free one.
    pub frequencies: Vec<f64>,
    /// Of each mode: body by body a shift \[m\] in world axes and a turn \[rad\] about the body's
    /// axes, the largest 1.
    pub motions: Vec<Vec<[f64; 6]>>,
    /// Their limitations, in sentences.
    pub remarks: Vec<String>,
}

/// The `count` lowest modes of a scene, all of them where there are fewer.
///
/// # Errors
/// Where there are too many bodies, or no stiffness about the pose.
pub fn lowest(scene: &Scene, count: usize) -> Result<LowestModes, ModesError> {
    let found = modes(&scene.model, &State::initial(&scene.model))?;
    let count = count.min(found.frequencies.len());
    Ok(LowestModes {
        frequencies: found.frequencies[..count].to_vec(),
        motions: (0..count).map(|mode| found.motion(&scene.model, mode)).collect(),
        remarks: remarks(scene, &found)?,
    })
}

impl LowestModes {
    /// The modes for the animation of a page.
    #[must_use]
    pub fn of_page(&self) -> Vec<Mode> {
        let pairs = self.frequencies.iter().zip(&self.motions);
        let mode = |(frequency, motion): (&f64, &Vec<[f64; 6]>)| Mode {
            frequency: *frequency,
            shape: F32s(motion.iter().flatten().map(|part| *part as f32).collect()),
        };
        pairs.map(mode).collect()
    }
}
