//! The scene's read-outs as a run sees them.
//!
//! `(scene, plant) => one number per column of the trace`, computed in the precision that runs.

use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Geometry, Plant, Real, Scheme};
use dbd_scene::{Scene, SceneModel};

/// The read-outs in a precision.
pub(crate) struct Sensors<P: Geometry> {
    /// Each with the number of its columns.
    readouts: Vec<(Readout<P>, usize)>,
    values: Vec<f64>,
}

impl<P: Geometry> Sensors<P> {
    /// Those of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let readouts = scene.readouts.iter();
        let readouts = readouts.map(|info| (info.readout.convert(), info.columns.len()));
        Self { readouts: readouts.collect(), values: Vec::new() }
    }

    /// What they show now.
    pub(crate) fn read<S: Scheme>(&mut self, plant: &Plant<&SceneModel<P>, S>) -> &[f64] {
        self.values.clear();
        for (readout, columns) in &self.readouts {
            let values = &mut self.values;
            match plant.read(readout) {
                Some(Reading::Scalar(value)) => values.push(value.to_f64()),
                Some(Reading::Vector(vector)) => values.extend(vector.to_f64()),
                Some(Reading::Imu { specific_force, rate }) => {
                    values.extend(specific_force.to_f64());
                    values.extend(rate.to_f64());
                }
                None => values.extend(std::iter::repeat_n(f64::NAN, *columns)),
            }
        }
        &self.values
    }
}
