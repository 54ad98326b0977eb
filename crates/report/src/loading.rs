//! Forces at a state: tensions, forces of joints, loads and inputs.
//!
//! `(scene, model that ran, state) => values in the order of the mechanism's parts`, in double precision.

use std::collections::HashMap;

use crate::picture::Mechanism;
use crate::picture::mechanism::{ForceKind, Place};
use dbd_kernel::elements::element::Law;
use dbd_kernel::readouts::{each_force, each_tension};
use dbd_kernel::schedule::LoadWindow;
use dbd_kernel::{F64, Quaternion, State, Vec3};
use dbd_scene::{Scene, SceneModel};

/// Where the value of a force comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// A load, while its window is open.
    Load { window: LoadWindow, value: f64 },
    /// The signal of an input.
    Input(usize),
    /// Nowhere.
    Nothing,
}

/// Role of a group in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// It belongs to a joint.
    Joint,
    /// It is a spring of this row.
    Spring(usize),
    /// It is nothing that has a tension.
    Guide,
}

/// Computes the forces of a run's states.
#[derive(Clone, Debug)]
pub struct Loading {
    model: SceneModel<F64>,
    parts: Vec<Part>,
    /// The group whose force on its second body is that of each joint.
    last_groups: Vec<usize>,
    spring_ends: Vec<[Place; 2]>,
    sources: Vec<Source>,
}

/// The forces of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// \[N\] tensions of the mechanism's springs.
    pub springs: Vec<f32>,
    /// \[N\] tensions of its joints' springs.
    pub joint_springs: Vec<f32>,
    /// \[N, N·m, m\] values of its forces.
    pub forces: Vec<f32>,
}

impl Loading {
    /// For runs of a scene as a model of it in `step_size` \[s\] steps.
    #[must_use]
    pub fn new(
        scene: &Scene,
        mechanism: &Mechanism,
        model: SceneModel<F64>,
        step_size: f64,
    ) -> Self {
        let first = scene.joints.iter().map(|joint| joint.groups.end).max().unwrap_or(0);
        let mut springs = 0;
        let part = |(row, law): (usize, Law)| {
            if row < first {
                return Part::Joint;
            }
            if law == Law::PointOnLine {
                return Part::Guide;
            }
            springs += 1;
            Part::Spring(springs - 1)
        };
        let laws = model.groups.iter().map(|group| group.law);
        let parts = laws.enumerate().map(part).collect();
        let last = scene.joints.iter().map(|joint| (&joint.name, joint.groups.end));
        let last: HashMap<_, _> = last.collect();
        let last = |name| last.get(name).map_or(usize::MAX, |end| end.saturating_sub(1));
        let last_groups = mechanism.joints.iter().map(|joint| last(&joint.name)).collect();
        let spring_ends = mechanism.springs.iter().map(|spring| spring.ends).collect();
        let sources = sources(scene, mechanism, &model, step_size);
        Self { model, parts, last_groups, spring_ends, sources }
    }

    /// \[N\] the force of each joint on its second body.
    pub fn joints(&self, state: &State<SceneModel<F64>>, forces: &mut Vec<f64>) {
        let mut of_groups = vec![0.0; self.model.groups.len()];
        each_force(&self.model, state, |group, force| of_groups[group] = length(force));
        forces.clear();
        let of = |group: &usize| of_groups.get(*group).copied().unwrap_or(0.0);
        forces.extend(self.last_groups.iter().map(of));
    }

    /// All others.
    #[must_use]
    pub fn others(&self, state: &State<SceneModel<F64>>) -> Forces {
        let mut springs = vec![0.0_f32; self.spring_ends.len()];
        let mut joint_springs = Vec::new();
        each_tension(&self.model, state, |group, tension| match self.parts[group] {
            Part::Joint => joint_springs.push(tension as f32),
            Part::Spring(row) => springs[row] = tension as f32,
            Part::Guide => {}
        });
        if !self.model.bushings.is_empty() {
            each_force(&self.model, state, |group, force| {
                let Part::Spring(row) = self.parts[group] else { return };
                if self.model.groups[group].law == Law::PointBushing {
                    // It pulls its second body towards the first, or pushes it away.
                    let [a, b] = self.spring_ends[row].map(|end| place(state, &end));
                    let pull = if force.dot(a - b) < 0.0 { -1.0 } else { 1.0 };
                    springs[row] = (pull * length(force)) as f32;
                }
            });
        }
        let value = |source: &Source| match source {
            Source::Load { window, value } if window.contains(state.step) => *value as f32,
            Source::Input(row) => state.signals.get(*row).map_or(0.0, |s| s.value as f32),
            Source::Load { .. } | Source::Nothing => 0.0,
        };
        Forces { springs, joint_springs, forces: self.sources.iter().map(value).collect() }
    }
}

/// A point in the world \[m\].
fn place(state: &State<SceneModel<F64>>, place: &Place) -> Vec3<f64> {
    let point = Vec3::from_f64(place.point);
    match place.body.and_then(|row| state.bodies.get(row)) {
        Some(body) => {
            let orientation = Quaternion::from_f64(body.orientation.to_f64());
            Vec3::from_f64(body.position.to_f64()) + orientation.rotation().to_world(point)
        }
        None => point,
    }
}

/// Of each force of the mechanism: the loads in their order, then inputs by their names.
fn sources(
    scene: &Scene,
    mechanism: &Mechanism,
    model: &SceneModel<F64>,
    step_size: f64,
) -> Vec<Source> {
    let mut loads = model.loads.iter().flat_map(|load| {
        let window = LoadWindow::new(load.from, load.until, step_size);
        [(ForceKind::Force, load.force), (ForceKind::Torque, load.torque)]
            .map(|(kind, vector)| (kind, window, length(vector)))
    });
    let source = |mark: &crate::picture::mechanism::ForceMark| match &mark.input {
        Some(name) => {
            let info = scene.inputs.iter().find(|info| info.name == *name);
            info.map_or(Source::Nothing, |info| Source::Input(usize::from(info.index.0)))
        }
        // The picture has those of a load that are not zero.
        None => loads
            .find(|(kind, _, value)| *kind == mark.kind && *value > 0.0 && value.is_finite())
            .map_or(Source::Nothing, |(_, window, value)| Source::Load { window, value }),
    };
    mechanism.forces.iter().map(source).collect()
}

fn length(vector: Vec3<f64>) -> f64 {
    vector.dot(vector).sqrt()
}
