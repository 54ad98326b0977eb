//! Visible values of the plant at one time, as an array of numbers.
//!
//! `state => time, energies, hash, poses, forces, outputs`. A page reads them at the offsets of [`Layout`].

use dbd_report::film::has_joint_springs;
use serde::Serialize;

use crate::session::live::Session;

/// Numbers before the poses: time \[s\], steps, whether it failed, kinetic, potential and total energy \[J\], the upper
/// and the lower half of the state's hash, energy at t = 0 \[J\], work of the hand \[J\].
pub const STATUS: usize = 10;

/// Offsets of the parts of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Layout {
    /// Per body position \[m\] and unit quaternion, scalar first, body → world.
    pub poses: usize,
    /// \[N\] tensions of the mechanism's springs.
    pub springs: usize,
    /// Per joint \[N\] the force on its second body and \[m\] the largest extension of its elements.
    pub joints: usize,
    /// \[N\] tensions of the joints' springs; none if there are too many to draw.
    pub joint_springs: usize,
    /// \[N, N·m, m\] values of the mechanism's forces.
    pub forces: usize,
    /// The displayed outputs.
    pub watched: usize,
    /// Their number.
    pub length: usize,
}

impl Session {
    /// Offsets of the parts of a frame.
    #[must_use]
    pub fn layout(&self) -> Layout {
        let mechanism = &self.mechanism;
        let poses = STATUS;
        let springs = poses + 7 * mechanism.bodies.len();
        let joints = springs + mechanism.springs.len();
        let joint_springs = joints + 2 * mechanism.joints.len();
        let many = has_joint_springs(mechanism);
        let forces = joint_springs + if many { mechanism.joint_springs.len() } else { 0 };
        let watched = forces + mechanism.forces.len();
        let length = watched + self.watched.len();
        Layout { poses, springs, joints, joint_springs, forces, watched, length }
    }

    /// The present frame. Undefined values are NaN.
    pub fn frame(&mut self) -> &[f64] {
        let layout = self.layout();
        let state = self.instance.plant().state();
        // Only its extensions are needed, not its verdict.
        let energy = match self.monitor.check(&state) {
            Ok(verdict) => verdict.energy,
            Err(_) => self.instance.plant().energy(),
        };
        let hash = self.instance.hash();
        let frame = &mut self.frame;
        frame.clear();
        frame.extend([
            self.instance.time(),
            state.step as f64,
            f64::from(u8::from(self.run_failure.is_some())),
            energy.kinetic,
            energy.potential(),
            energy.total(),
            (hash >> 32) as f64,
            (hash & 0xffff_ffff) as f64,
            self.energy_at_start,
            self.work,
        ]);
        for body in &state.bodies {
            frame.extend(body.position.to_f64());
            frame.extend(body.orientation.to_f64());
        }
        let forces = self.loading.others(&state);
        frame.extend(forces.springs.iter().map(|tension| f64::from(*tension)));
        let mut of_joints = Vec::new();
        self.loading.joints(&state, &mut of_joints);
        let extensions =
            self.monitor.extensions().iter().copied().chain(std::iter::repeat(f64::NAN));
        frame.extend(
            of_joints.iter().zip(extensions).flat_map(|(force, extension)| [*force, extension]),
        );
        if has_joint_springs(&self.mechanism) {
            frame.extend(forces.joint_springs.iter().map(|tension| f64::from(*tension)));
        }
        frame.extend(forces.forces.iter().map(|force| f64::from(*force)));
        self.instance.values_of(&self.watched, frame);
        debug_assert_eq!(frame.len(), layout.length);
        frame
    }
}
