//! Bodies moved from their given poses: geometry given in the world moves with them.

use dbd_kernel::{BodyIndex, BodyState, F64, Geometry, Vec3};

use crate::assembly::Assembly;
use crate::direction::settled;

impl Assembly {
    /// The states of all bodies.
    pub(crate) fn states(&self) -> &[BodyState<F64>] {
        &self.model.initial
    }

    /// Moves a body; geometry given at the poses of the file moves with it from now on.
    pub(crate) fn set_state(&mut self, row: usize, state: BodyState<F64>) {
        let places = self.model.initial.get_mut(row).zip(self.frames.get_mut(row));
        if let Some((stored, frame)) = places {
            self.given.entry(row).or_insert(*stored);
            *frame = F64::frame(&state.position, &state.orientation);
            *stored = state;
        }
    }

    /// Sets the velocities of a body to those of a state.
    pub(crate) fn set_velocities(&mut self, row: usize, state: BodyState<F64>) {
        if let Some(stored) = self.model.initial.get_mut(row) {
            stored.velocity = state.velocity;
            stored.angular_velocity = state.angular_velocity;
        }
    }

    /// Marks all joints as closed.
    pub(crate) fn set_assembled(&mut self) {
        self.is_assembled = true;
    }

    /// Whether all joints have been closed.
    pub(crate) fn is_assembled(&self) -> bool {
        self.is_assembled
    }

    /// World position of a body point at the given pose of the body.
    pub(crate) fn given_place(&self, body: BodyIndex, point_b: Vec3<f64>) -> Vec3<f64> {
        match self.given.get(&body.row()) {
            Some(given) => given.position + given.orientation.rotation().to_world(point_b),
            None => self.place(body, point_b),
        }
    }

    /// A world point in body axes at the given pose of the body.
    pub(crate) fn given_point_in(&self, body: BodyIndex, point_w: Vec3<f64>) -> Vec3<f64> {
        match self.given.get(&body.row()) {
            Some(given) => given.orientation.rotation().to_body(point_w - given.position),
            None => self.point_in(body, point_w),
        }
    }

    /// Present position of a body point that was given in the world.
    pub(crate) fn carried_point(&self, body: BodyIndex, point_w: Vec3<f64>) -> Vec3<f64> {
        let Some(given) = self.given.get(&body.row()) else { return point_w };
        let arm = given.orientation.rotation().to_body(point_w - given.position);
        self.place(body, arm)
    }

    /// Present direction of a unit vector of a body that was given in the world.
    pub(crate) fn carried_direction(&self, body: BodyIndex, direction_w: Vec3<f64>) -> Vec3<f64> {
        let Some(given) = self.given.get(&body.row()) else { return direction_w };
        let carried = self.direction_w(body, given.orientation.rotation().to_body(direction_w));
        settled(carried).unwrap_or(direction_w)
    }
}
