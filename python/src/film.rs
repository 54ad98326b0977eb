//! Samples of a plant, and the page that shows them.
//!
//! `plant, sample by sample => HTML`, the report of `host-sim run`.

use dbd_kernel::{Energy, F64, State};
use dbd_plant::monitor::Monitor;
use dbd_plant::{Method, Plan, plant, readings};
use dbd_report::data::{Data, Text};
use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_report::{Recording, Sample, page};
use dbd_scene::{Scene, SceneModel};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::raise;
use crate::plant::Plant;

/// A sample of a plant.
struct Kept {
    time: f64,
    state: State<SceneModel<F64>>,
    readings: Vec<f64>,
}

/// The samples of a plant for the page of its run.
#[pyclass(module = "dbd._dbd")]
pub(crate) struct Film {
    scene: Scene,
    method: Method,
    step: f64,
    kept: Vec<Kept>,
}

#[pymethods]
impl Film {
    /// Of a plant; no sample is taken yet.
    #[new]
    fn new(py: Python<'_>, plant: &Plant) -> PyResult<Self> {
        let instance = plant.held(py)?;
        let method = instance.settings().method().map_err(raise(py))?;
        let scene = instance.scene().clone();
        Ok(Self { scene, method, step: instance.step_size(), kept: Vec::new() })
    }

    /// Takes a sample of the plant. Those at its time and later are dropped.
    fn sample(&mut self, py: Python<'_>, plant: &Plant) -> PyResult<()> {
        let instance = plant.held(py)?;
        let (time, plant) = (instance.time(), instance.plant());
        while self.kept.last().is_some_and(|last| last.time >= time) {
            self.kept.pop();
        }
        let mut readings = Vec::new();
        for info in &self.scene.readouts {
            readings::append(plant.read(&info.readout), info.columns.len(), &mut readings);
        }
        self.kept.push(Kept { time, state: plant.state(), readings });
        Ok(())
    }

    /// The page, with further curves: their names and units, and their values in each sample.
    fn html(
        &self,
        py: Python<'_>,
        others: Vec<(String, String)>,
        values: Vec<Vec<f64>>,
    ) -> PyResult<String> {
        if values.len() != self.kept.len() || values.iter().any(|row| row.len() != others.len()) {
            return Err(PyValueError::new_err("further curves need one value each per sample"));
        }
        let page = py.detach(|| self.page(&others, &values));
        page.map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

impl Film {
    fn page(
        &self,
        others: &[(String, String)],
        values: &[Vec<f64>],
    ) -> Result<String, dbd_plant::PlantError> {
        let Self { scene, method, step, kept } = self;
        let duration = kept.last().map_or(0.0, |last| last.time);
        let steps = (kept.len() as u64).saturating_sub(1).max(1);
        let plan = Plan { step: *step, duration, steps, stride: 1 };
        let mut recording = Recording::with_others(scene, method, &plan, others)?;
        let plant = plant(scene, method, *step)?;
        let mut monitor = Monitor::new(scene, plant.as_ref());
        for (Kept { time, state, readings }, others) in kept.iter().zip(values) {
            let energy =
                monitor.check(state).map_or_else(|_| Energy::default(), |seen| seen.energy);
            let extensions = monitor.extensions();
            recording.push(&Sample { time: *time, state, readings, energy, extensions, others });
        }
        let mut data = Data::of_run(&scene.name, &scene.description, recording.finish().run);
        data.text = Text {
            picture: Some(svg(&Mechanism::of(scene), Paper::Page)),
            commands: vec![(String::new(), "recording.report(\"run.html\")".into())],
            ..Text::default()
        };
        Ok(page::html(&data))
    }
}
