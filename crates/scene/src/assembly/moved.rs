//! Bodies that were moved after they were given: what was given beside them goes with them.

use dbd_kernel::{BodyIndex, BodyState, F64, Geometry, Vec3};

use crate::assembly::Assembly;
use crate::direction::settled;

impl Assembly {
    /// The states of all bodies.
    pub(crate) fn states(&self) -> &[BodyState<F64>] {
        &self.model.initial
    }

    /// Moves a body: what is given at the poses of the file goes with it from now on.
    pub(crate) fn set_state(&mut self, row: usize, state: BodyState<F64>) {
        let places = self.model.initial.get_mut(row).zip(self.frames.get_mut(row));
        if let Some((stored, frame)) = places {
            self.given.entry(row).or_insert(*stored);
            *frame = F64::frame(&state.position, &state.orientation);
            *stored = state;
        }
    }

    /// Gives a body the velocities of a state.
    pub(crate) fn set_velocities(&mut self, row: usize, state: BodyState<F64>) {
        if let Some(stored) = self.model.initial.get_mut(row) {
            stored.velocity = state.velocity;
            stored.angular_velocity = state.angular_velocity;
        }
    }

    /// Says that all joints have been closed.
    pub(crate) fn set_assembled(&mut self) {
        self.is_assembled = true;
    }

    /// Whether all joints have been closed.
    pub(crate) fn is_assembled(&self) -> bool {
        self.is_assembled
    }

    /// Where a point of a body was in the world when the body was given.
    pub(crate) fn given_place(&self, body: BodyIndex, point_b: Vec3<f64>) -> Vec3<f64> {
        match self.given.get(&body.row()) {
            Some(given) => given.position + given.orientation.rotation().to_world(point_b),
            None => self.place(body, point_b),
        }
    }

    /// A point of the world in the axes of its owner when that was given.
    pub(crate) fn given_point_in(&self, body: BodyIndex, point_w: Vec3<f64>) -> Vec3<f64> {
        match self.given.get(&body.row()) {
            Some(given) => given.orientation.rotation().to_body(point_w - given.position),
            None => self.point_in(body, point_w),
        }
    }

    /// Where a point of a body is now that was given in the world.
    pub(crate) fn carried_point(&self, body: BodyIndex, point_w: Vec3<f64>) -> Vec3<f64> {
        let Some(given) = self.given.get(&body.row()) else { return point_w };
        let arm = given.orientation.rotation().to_body(point_w - given.position);
        self.place(body, arm)
    }

    /// What has become of a unit vector of a body that was given in the world.
    pub(crate) fn carried_direction(&self, body: BodyIndex, direction_w: Vec3<f64>) -> Vec3<f64> {
        let Some(given) = self.given.get(&body.row()) else { return direction_w };
        let carried = self.direction_w(body, given.orientation.rotation().to_body(direction_w));
        settled(carried).unwrap_or(direction_w)
    }
}
