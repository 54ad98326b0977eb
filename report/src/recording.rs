//! A run as it goes on: what its page and its animation will show.
//!
//! `samples => film, curves`. Memory and page stay small whatever the run's length.

use dbd_kernel::{Energy, F64, Quaternion, State, Vec3};
use dbd_picture::Mechanism;
use dbd_plant::numerals::Numerals;
use dbd_plant::{Method, Plan, PlantError, plant};
use dbd_scene::{Scene, SceneModel};

use crate::charts::{Charts, Finished};
use crate::curves::Curves;
use crate::data::{Run, Trace};
use crate::film::{Frame, Spread, packed};
use crate::loading::Loading;
use crate::turn::turn;

/// What is known at a sample.
#[derive(Clone, Copy)]
pub struct Sample<'s> {
    /// \[s\] the time.
    pub time: f64,
    /// The state, widened exactly.
    pub state: &'s State<SceneModel<F64>>,
    /// The scene's read-outs, one number per column; NaN where there is none.
    pub readings: &'s [f64],
    /// \[J\] its energy.
    pub energy: Energy<f64>,
    /// \[m\] the largest extension of the elements of each joint, in scene order.
    pub extensions: &'s [f64],
}

/// Takes a run's samples in.
#[derive(Clone)]
pub struct Recording {
    mechanism: Mechanism,
    traces: Vec<Trace>,
    loading: Loading,
    numerals: Numerals,
    charts: Charts,
    curves: Curves,
    spread: Spread,
    frames: Vec<Frame>,
    /// The last sample that is no frame yet.
    last: Option<Seen>,
    turns: Vec<[f64; 3]>,
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
    /// What its page draws from.
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
        // Forces are those of the constants that run, rounded as they are.
        let plant = plant(scene, method, plan.step)?;
        let mechanism = Mechanism::of(scene);
        let loading = Loading::new(scene, &mechanism, plant.model().clone(), plant.step_size());
        let charts = Charts::of(scene, &mechanism, plan);
        let curves = Curves::new(charts.deviations(), plan.samples());
        Ok(Self {
            spread: Spread::of(&mechanism, plan.samples()),
            turns: vec![[0.0; 3]; mechanism.bodies.len()],
            traces: traces(scene),
            numerals: plant.numerals(),
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

    /// Takes the next sample.
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
        // What a run that fails ended with is seen, too.
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
        let Sample { state, readings, energy, extensions, .. } = *sample;
        row.clear();
        row.extend([energy.kinetic, energy.potential(), energy.total()]);
        row.extend(readings);
        row.extend(state.signals.iter().map(|signal| signal.value));
        let extensions = extensions.iter().copied().chain(std::iter::repeat(f64::NAN));
        for (extension, force) in extensions.zip(joint_forces.iter()) {
            row.extend([extension, *force]);
        }
        let length = |vector: Vec3<f64>| vector.dot(vector).sqrt();
        for (index, ((body, shape), last)) in
            state.bodies.iter().zip(&mechanism.bodies).zip(turns).enumerate()
        {
            if mechanism.is_spider(index) {
                continue;
            }
            *last = turn(shape.orientation, body.orientation.to_f64(), *last);
            row.extend(body.position.to_f64());
            row.extend(*last);
            row.extend([length(body.velocity), length(body.angular_velocity)]);
        }
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

    /// The samples taken so far as a whole.
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
            self.charts.finish(&self.curves, self.numerals);
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

/// The points that a scene reads out.
fn traces(scene: &Scene) -> Vec<Trace> {
    use dbd_kernel::readouts::Readout;
    use dbd_picture::mechanism::Place;
    let trace = |readout: &dbd_scene::ReadoutInfo| match readout.readout {
        Readout::Point { body, point } => {
            let place = Place { body: Some(body.row()), point: point.to_f64() };
            Some(Trace { name: readout.name.clone(), place })
        }
        _ => None,
    };
    scene.readouts.iter().filter_map(trace).collect()
}
