//! What a state holds, and whether a run can go on from it.
//!
//! `(model in the precision that runs, state) => energy, largest joint extension | trouble`, in
//! double precision: the stored words are taken as exact, whatever precision stepped them.

use std::ops::Range;

use dbd_kernel::energy::{energy, largest_extension};
use dbd_kernel::model::Law;
use dbd_kernel::{BodyState, Energy, F64, Geometry, State};
use dbd_scene::{Scene, SceneModel};

use crate::joint_groups::joint_groups;
use crate::simulate::Trouble;

/// A joint's element that is longer than this many times the largest free length of all joints
/// is torn: a run that diverges slowly passes through here before anything becomes infinite.
const TORN: f64 = 1000.0;

/// What a state holds.
pub(crate) struct Verdict {
    /// \[J\] its energy.
    pub(crate) energy: Energy<f64>,
    /// \[m\] the largest extension of the joints' elements.
    pub(crate) extension: f64,
}

/// The model that runs, its stored words taken as exact in double precision.
pub(crate) struct Judge {
    model: SceneModel<F64>,
    /// The joints' elements alone.
    joints: SceneModel<F64>,
    /// The groups of each joint.
    ranges: Vec<Range<usize>>,
    /// \[m\] the extension of a joint's element at which it counts as torn.
    torn: f64,
    step_size: f64,
}

impl Judge {
    /// The judge of a scene's model in the precision that runs it.
    pub(crate) fn new<P: Geometry>(scene: &Scene, model: &SceneModel<P>, step_size: f64) -> Self {
        let model_of_judge: SceneModel<F64> = model.convert();
        let mut joints = model_of_judge.clone();
        let ranges = joint_groups(scene);
        joints.groups.truncate(ranges.last().map_or(0, |range| range.end));
        let elements = joints.groups.iter().filter(|group| group.law == Law::Tsda);
        let lengths = elements.flat_map(|group| {
            let first = usize::from(group.element);
            joints.tsdas[first..first + group.elements()].iter().map(|tsda| tsda.free_length)
        });
        let torn = TORN * lengths.fold(0.0, f64::max);
        Self { model: model_of_judge, joints, ranges, torn, step_size }
    }

    /// What a state holds, or why it is none to go on from.
    pub(crate) fn judge(&self, state: &State<SceneModel<F64>>) -> Result<Verdict, Trouble> {
        let energy = energy(&self.model, state, self.step_size);
        if !energy.total().is_finite() {
            return Err(Trouble::Energy { body: fastest(state) });
        }
        let extension = largest_extension(&self.joints, state);
        if self.torn > 0.0 && extension > self.torn {
            return Err(Trouble::Torn { joint: self.longest(state), extension });
        }
        Ok(Verdict { energy, extension })
    }

    /// The row of the joint with the largest extension.
    fn longest(&self, state: &State<SceneModel<F64>>) -> usize {
        let extension = |groups: &Range<usize>| {
            let mut joint = self.joints.clone();
            joint.groups = joint.groups[groups.clone()].to_vec();
            largest_extension(&joint, state)
        };
        let extensions = self.ranges.iter().map(extension).enumerate();
        extensions.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(row, _)| row)
    }
}

/// The row of the body with the largest component of a velocity.
fn fastest(state: &State<SceneModel<F64>>) -> usize {
    let speed = |body: &BodyState<F64>| {
        let components = [body.velocity.to_f64(), body.angular_velocity.to_f64()];
        components.as_flattened().iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    };
    let speeds = state.bodies.iter().map(speed).enumerate();
    speeds.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(row, _)| row)
}
