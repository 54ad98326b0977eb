//! How fast leapfrog's ensembles are, compiled here once for all that ask.
//!
//! `(model, h, instruction set, threads) => steps per second of both`, see [`crate::pace()`].

use dbd_kernel::{F32, F64, Leapfrog};
use dbd_scene::SceneModel;

use crate::ensemble::EnsembleError;
use crate::pace::{Course, Pace, pace};

/// Of a model in double precision.
///
/// # Errors
/// As [`crate::pace()`].
pub fn pace_in_f64(
    model: &SceneModel<F64>,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    pace(model, Leapfrog, step_size, course)
}

/// Of a model that is rounded to single precision.
///
/// # Errors
/// As [`crate::pace()`].
pub fn pace_in_f32(
    model: &SceneModel<F64>,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    pace(&model.convert::<F32>(), Leapfrog, step_size, course)
}
