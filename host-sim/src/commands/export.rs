//! `host-sim export`: Rust source of a scene's const model.
//!
//! `(scene, precisions) => source`. The constant of the step is the scene's, else the default one
//! before it is shortened to fit.

use dbd_plant::plant::check_inputs;
use dbd_plant::{Frequencies, Method, PlantError, PrecisionName, SchemeName};
use dbd_scene::{Scene, export as source};

/// The source of a scene's const model in these precisions, f64 and f32 where none is named.
///
/// # Errors
/// [`PlantError::Input`] where single precision cannot hold what an input is given.
pub fn export(scene: &Scene, precision: Option<ExportPrecision>) -> Result<String, PlantError> {
    let step = Frequencies::of(scene).default_limit(scene.duration);
    let mut text = source::preamble(scene, step);
    let all = [ExportPrecision::F64, ExportPrecision::F32];
    for precision in all.into_iter().filter(|one| precision.is_none_or(|asked| asked == *one)) {
        text += &match precision {
            ExportPrecision::F64 => source::model::<f64>(scene),
            ExportPrecision::F32 => {
                let single = Method::new(SchemeName::default(), None, PrecisionName::F32);
                check_inputs(scene, &single?)?;
                source::model::<f32>(scene)
            }
        };
    }
    Ok(text)
}

/// Precisions that const models are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ExportPrecision {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
}
