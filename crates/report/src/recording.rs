//! Recording of a run for its page and its animation.
//!
//! `samples => film, curves`. Memory and page stay small whatever the run's length.

use crate::picture::Mechanism;
use dbd_kernel::{Energy, F64, Quaternion, State, Vec3};
use dbd_plant::number_format::NumberFormat;
use dbd_plant::{Method, Plan, PlantError, plant};
use dbd_scene::{Scene, SceneModel};

use crate::charts::{Charts, Finished};
use crate::curves::Curves;
use crate::data::{Run, Trace};
use crate::film::{Frame, Spread, packed};
use crate::loading::Loading;
use crate::turn::Turn;

/// Data of a sample.
#[derive(Clone, Copy)]
pub struct Sample<'s> {
    /// \[s\] the time.
    pub time: f64,
    /// The state, widened exactly.
    pub state: &'s State<SceneModel<F64>>,
    /// The scene's sensors, one number per column; NaN if undefined.
    pub readings: &'s [f64],
    /// \[J\] its energy.
    pub energy: Energy<f64>,
    /// \[m\] the largest extension of the elements of each joint, in scene order.
    pub extensions: &'s [f64],
    /// Numbers that are not the scene's, see [`Recording::with_others`].
    pub others: &'s [f64],
}

/// Records a run's samples.
#[derive(Clone)]
pub struct Recording {
    mechanism: Mechanism,
    traces: Vec<Trace>,
    loading: Loading,
    number_format: NumberFormat,
    charts: Charts,
    curves: Curves,
    spread: Spread,
    frames: Vec<Frame>,
    /// The last sample that is no frame yet.
    last: Option<Seen>,
    turns: Vec<Turn>,
    joint_forces: Vec<f64>,
    row: Vec<f64>,
}

/// A sample of which a frame can be made.
#[derive(Clone)]
struct Seen {
    time: f64,
    state: State<SceneModel<F64>>,
    extensions: Vec<f64>,
}

/// A run that was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// Data of its page.
    pub run: Run,
    /// The frames of its film in full precision.
    pub frames: Vec<Frame>,
}

impl Recording {
    /// Of a planned run of a scene; nothing is taken in yet.
    ///
    /// # Errors
    /// Where there is no plant of the method with the plan's step.
    pub fn new(scene: &Scene, method: &Method, plan: &Plan) -> Result<Self, PlantError> {
        Self::with_others(scene, method, plan, &[])
    }

    /// The same with further numbers in each sample, such as a controller's state: their names and units.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_others(
        scene: &Scene,
        method: &Method,
        plan: &Plan,
        others: &[(String, String)],
    ) -> Result<Self, PlantError> {
        // Forces are those of the constants that run, rounded as they are.
        let plant = plant(scene, method, plan.step)?;
        let mechanism = Mechanism::of(scene);
        let loading = Loading::new(scene, &mechanism, plant.model().clone(), plant.step_size());
        let charts = Charts::of(scene, &mechanism, plan, others);
        let curves = Curves::new(charts.deviations(), plan.samples());
        Ok(Self {
            spread: Spread::of(&mechanism, plan.samples()),
            turns: mechanism.bodies.iter().map(|body| Turn::new(body.orientation)).collect(),
            traces: traces(scene),
            number_format: plant.number_format(),
            mechanism,
            loading,
            charts,
            curves,
            frames: Vec::new(),
            last: None,
            joint_forces: Vec::new(),
            row: Vec::new(),
        })
    }

    /// Records the next sample.
    pub fn push(&mut self, sample: &Sample<'_>) {
        let number = self.curves.samples();
        self.loading.joints(sample.state, &mut self.joint_forces);
        self.fill_row(sample);
        self.curves.push(sample.time, &self.row);
        if self.spread.keeps(number) {
            let frame = self.frame(sample.time, sample.state, sample.extensions);
            self.frames.push(frame);
            self.last = None;
            return;
        }
        // The last sample of a failed run is included.
        match &mut self.last {
            Some(last) => {
                last.time = sample.time;
                last.state.bodies.clone_from(&sample.state.bodies);
                last.state.signals.clone_from(&sample.state.signals);
                last.state.step = sample.state.step;
                last.extensions.clear();
                last.extensions.extend_from_slice(sample.extensions);
            }
            None => {
                let Sample { time, state, extensions, .. } = *sample;
                self.last =
                    Some(Seen { time, state: state.clone(), extensions: extensions.into() });
            }
        }
    }

    /// The values of all lines at a sample, as [`Charts::of`] has them.
    fn fill_row(&mut self, sample: &Sample<'_>) {
        let Self { row, mechanism, turns, joint_forces, .. } = self;
        let Sample { state, readings, energy, extensions, others, .. } = *sample;
        row.clear();
        row.extend([energy.kinetic, energy.potential(), energy.total()]);
        row.extend(readings);
        row.extend(state.signals.iter().map(|signal| signal.value));
        let extensions = extensions.iter().copied().chain(std::iter::repeat(f64::NAN));
        for (extension, force) in extensions.zip(joint_forces.iter()) {
            row.extend([extension, *force]);
        }
        let length = |vector: Vec3<f64>| vector.dot(vector).sqrt();
        for (index, (body, turn)) in state.bodies.iter().zip(turns).enumerate() {
            if mechanism.is_spider(index) {
                continue;
            }
            row.extend(body.position.to_f64());
            row.extend(turn.to(body.orientation.to_f64()));
            row.extend([length(body.velocity), length(body.angular_velocity)]);
        }
        row.extend(others);
    }

    fn frame(&self, time: f64, state: &State<SceneModel<F64>>, extensions: &[f64]) -> Frame {
        let pose = |body: &dbd_kernel::BodyState<F64>| {
            (body.position.to_f64(), Quaternion::to_f64(body.orientation))
        };
        let extensions = extensions.iter().copied().chain(std::iter::repeat(f64::NAN));
        let joints = self.joint_forces.iter().zip(extensions);
        Frame {
            time,
            poses: state.bodies.iter().map(pose).collect(),
            joints: joints.map(|(force, extension)| [*force as f32, extension as f32]).collect(),
            forces: self.loading.others(state),
        }
    }

    /// The recorded samples.
    #[must_use]
    pub fn finish(mut self) -> Recorded {
        if let Some(last) = self.last.take() {
            self.loading.joints(&last.state, &mut self.joint_forces);
            let frame = self.frame(last.time, &last.state, &last.extensions);
            self.frames.push(frame);
        }
        self.curves.finish();
        let film = packed(&self.frames, &self.mechanism, self.traces);
        let Finished { times, thinned, charts, bodies_left_out, joints_left_out } =
            self.charts.finish(&self.curves, self.number_format);
        let mut mechanism = self.mechanism;
        if !crate::film::has_joint_springs(&mechanism) {
            mechanism.joint_springs.clear();
        }
        let run = Run {
            label: String::new(),
            mechanism: Some(mechanism),
            film,
            times,
            thinned,
            bodies_left_out,
            joints_left_out,
            charts,
        };
        Recorded { run, frames: self.frames }
    }
}

/// Point sensors of a scene.
/// Points of a scene with a drawn path: its point sensors.
#[must_use]
pub fn traces(scene: &Scene) -> Vec<Trace> {
    use crate::picture::mechanism::Place;
    use dbd_kernel::readouts::Readout;
    let trace = |readout: &dbd_scene::ReadoutInfo| match readout.readout {
        Readout::Point { body, point } => {
            let place = Place { body: Some(body.row()), point: point.to_f64() };
            Some(Trace { name: readout.name.clone(), place })
        }
        _ => None,
    };
    scene.readouts.iter().filter_map(trace).collect()
}

#[cfg(test)]
mod tests {
    use dbd_plant::monitor::Monitor;
    use dbd_plant::plan::{Request, StepRequest, plan};

    use super::*;
    use crate::data::{Chart, Section};

    /// A cart on a sprung, damped and driven line; a block that rests on a joint; a load for a while.
    const CART: &str = r#"
name = "cart"
duration = 1
step = 1e-3
body = [
  { name = "cart", mass = 2, inertia = [1, 1, 1], position = [1, 0, 0] },
  { name = "block", mass = 1, inertia = [1, 1, 1], position = [0, 5, 0] },
]
tsda = [{ name = "strut", between = ["world", "cart"], points = [[0, 0, 0], [0, 0, 0]], stiffness = 100, damping = 3, free_length = 0.8 }]
joint = [{ name = "pin", type = "revolute", between = ["world", "block"], at = [0, 5, 0], axis = [0, 0, 1], stiffness = 1e4, span = 0.1 }]
load = [{ body = "cart", force = [0, 0, 7], from = 0.2, until = 0.4 }]
input = [{ name = "push", type = "actuator", target = "strut", table = [[0, 0], [0.5, 4]], interpolate = "held" }]
readout = [
  { name = "tip", type = "point", body = "cart", point = [0.1, 0, 0] },
  { name = "pull", type = "tsda_force", target = "strut" },
]
"#;

    /// A run of a scene, `samples` of it, with its read-outs or none of their numbers.
    fn recorded(text: &str, every: f64, samples: u64, numbers: bool) -> (Recorded, Vec<Vec<f64>>) {
        let scene = Scene::parse(text, "cart.toml").unwrap_or_else(|error| panic!("{error}"));
        let method = Method::default();
        let step = StepRequest::Given(scene.step.unwrap());
        let request = Request { step, duration: scene.duration, every: Some(every) };
        let plan = plan(&request).unwrap();
        let mut plant = plant(&scene, &method, plan.step).unwrap();
        let mut monitor = Monitor::new(&scene, plant.as_ref());
        let mut recording = Recording::new(&scene, &method, &plan).unwrap();
        let mut all = Vec::new();
        for _ in 0..samples {
            let state = plant.state();
            let energy = monitor.check(&state).ok().unwrap().energy;
            let mut readings = Vec::new();
            for info in &scene.readouts {
                let reading = plant.read(&info.readout).filter(|_| numbers);
                dbd_plant::readings::append(reading, info.columns.len(), &mut readings);
            }
            recording.push(&Sample {
                time: plant.time(),
                state: &state,
                readings: &readings,
                energy,
                extensions: monitor.extensions(),
                others: &[],
            });
            all.push(readings);
            let _ = plant.advance(plan.stride);
        }
        (recording.finish(), all)
    }

    fn chart<'r>(run: &'r Run, section: Section, title: &str, quantity: &str) -> &'r Chart {
        let named = |chart: &&Chart| chart.title == title && chart.quantity == quantity;
        let mut charts = run.charts.iter().filter(|chart| chart.section == section);
        charts.find(named).unwrap_or_else(|| panic!("{title}: {quantity}"))
    }

    #[test]
    fn film_and_curves_show_what_was_read() {
        let (Recorded { run, frames }, readings) = recorded(CART, 1e-2, 101, true);
        assert_eq!((frames.len(), run.times.0.len(), run.thinned), (101, 101, None));
        let pull = chart(&run, Section::Readouts, "pull", "tension");
        let film = run.film.as_ref().unwrap();
        for (row, reading) in readings.iter().enumerate() {
            // The film's tension is the read-out's: spring, damper and actuator.
            assert_eq!(film.springs.0[row], reading[3] as f32);
            assert_eq!(pull.lines[0].values.0[row], reading[3] as f32);
        }
        let inputs = chart(&run, Section::Inputs, "push", "tension");
        let push = &inputs.lines[0].values.0;
        assert_eq!((push[49], push[50], push[100]), (0.0, 4.0, 4.0));
        // A load acts within its window; an actuator is not a separate force.
        assert_eq!(film.forces.0.len(), 101);
        assert_eq!([19, 20, 39, 40].map(|row| film.forces.0[row]), [0.0, 7.0, 7.0, 0.0]);
        let tip = chart(&run, Section::Readouts, "tip", "position");
        assert_eq!((tip.lines[0].initial, tip.lines[0].values.0[0]), (1.1, 0.0));
        assert!(tip.lines[0].deviation && film.traces[0].name == "tip");
        let change = chart(&run, Section::Energy, "Change of the total energy", "total energy");
        assert!(change.lines[0].deviation && change.lines[0].values.0[0] == 0.0);
    }

    #[test]
    fn what_never_moves_is_still() {
        let (Recorded { run, .. }, _) = recorded(CART, 1e-2, 101, true);
        let still = |section, title, quantity| -> Vec<bool> {
            let chart = chart(&run, section, title, quantity);
            for line in &chart.lines {
                assert_eq!(line.values.0.is_empty(), line.still, "{title} {quantity}");
            }
            chart.lines.iter().map(|line| line.still).collect()
        };
        assert_eq!(still(Section::Motion, "cart", "position"), [false, true, false]);
        assert_eq!(still(Section::Motion, "cart", "turn"), [true; 3]);
        assert_eq!(still(Section::Motion, "block", "position"), [true; 3]);
        assert_eq!(still(Section::Motion, "block", "speed"), [true]);
        assert_eq!(
            still(Section::Joints, "pin: largest extension of its springs", "extension"),
            [true]
        );
        assert_eq!(still(Section::Inputs, "push", "tension"), [false]);
    }

    /// A run that fails, or has no finite numbers, keeps its samples.
    #[test]
    fn runs_may_end_early_or_not_begin() {
        for samples in [0, 1, 2, 1234] {
            let (Recorded { run, frames }, _) = recorded(CART, 1e-3, samples.min(1001), false);
            let samples = samples.min(1001) as usize;
            assert_eq!(run.film.is_some(), samples > 0);
            assert_eq!((frames.len(), run.times.0.len()), (samples, samples));
            let pull = chart(&run, Section::Readouts, "pull", "tension");
            assert!(pull.lines[0].initial.is_nan());
            let json = serde_json::to_value(&run).unwrap();
            assert!(json["charts"][0]["lines"][0]["initial"].is_null());
        }
    }

    /// Thousands of bodies: a small page that lists omissions.
    #[test]
    fn many_bodies_and_many_samples_stay_small() {
        let mut text = String::from("name = \"many\"\nduration = 1\nstep = 1e-2\nbody = [\n");
        for row in 0..1000 {
            let speed = if row == 77 { 3.0 } else { 1e-3 * f64::from(row) };
            text += &format!(
                "{{ name = \"b{row}\", mass = 1, inertia = [1, 1, 1], position = [{row}, 0, 0], \
                 velocity = [0, {speed:?}, 0] }},\n"
            );
        }
        text += "]\n";
        let (Recorded { run, .. }, _) = recorded(&text, 1e-2, 101, true);
        let json = serde_json::to_string(&run).unwrap();
        assert!(json.len() < 1_500_000, "{}", json.len());
        assert!(run.bodies_left_out > 500 && run.charts.iter().any(|chart| chart.title == "b77"));
        assert!(!run.charts.iter().any(|chart| chart.title == "b1"));
        let lines: usize = run.charts.iter().map(|chart| chart.lines.len()).sum();
        assert!(lines < 2000, "{lines}");

        let long = CART.replace("step = 1e-3", "step = 1e-5");
        let (Recorded { run, frames }, _) = recorded(&long, 1e-5, 100_001, true);
        let thinned = run.thinned.unwrap();
        assert!(thinned.samples == 100_001 && thinned.points == run.times.0.len());
        assert!(thinned.points <= 2000 && frames.len() == 1200);
        assert_eq!(frames[1199].time, run.times.0[run.times.0.len() - 1]);
    }
}
