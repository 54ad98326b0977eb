//! Named points, ends of links, and body axes that are not the principal axes.

use std::collections::BTreeMap;

use dbd_kernel::{BodyIndex, Quaternion, Vec3};

use crate::assembly::Assembly;
use crate::orientation::{normalised, settled};

impl Assembly {
    /// The named points, world, at the initial pose.
    pub(crate) fn points(&self) -> &BTreeMap<String, Vec3<f64>> {
        &self.points
    }

    /// Sets the named points.
    pub(crate) fn set_points(&mut self, points: BTreeMap<String, Vec3<f64>>) {
        self.points = points;
    }

    /// The point of a body with this name, from the centre of mass in body axes.
    pub(crate) fn end(&self, body: BodyIndex, point: &str) -> Option<Vec3<f64>> {
        let mut ends = self.ends.get(body.row())?.iter();
        ends.find(|(name, _)| name == point).map(|(_, place)| *place)
    }

    /// Sets the named points of a body.
    pub(crate) fn set_ends(&mut self, body: BodyIndex, ends: Vec<(String, Vec3<f64>)>) {
        if let Some(known) = self.ends.get_mut(body.row()) {
            *known = ends;
        }
    }

    /// Sets the rotation from a body's principal axes to its given axes.
    pub(crate) fn set_turn(&mut self, body: BodyIndex, turn: Option<Quaternion<f64>>) {
        if let Some(known) = self.turns.get_mut(body.row()) {
            *known = turn;
        }
    }

    /// Transforms a vector from a body's given axes to its principal axes.
    pub(crate) fn of_written(&self, body: BodyIndex, vector: Vec3<f64>) -> Vec3<f64> {
        match self.turns.get(body.row()) {
            Some(Some(turn)) => turn.rotation().to_body(vector),
            _ => vector,
        }
    }

    /// The orientation of a body's principal axes, unit and scalar first, from that of its given axes.
    pub(crate) fn orientation_of_written(&self, body: BodyIndex, written: [f64; 4]) -> [f64; 4] {
        match self.turns.get(body.row()) {
            Some(Some(turn)) => normalised(Quaternion::from_f64(written).product(*turn).to_f64()),
            _ => written,
        }
    }

    /// Transforms a rotation, unit and scalar first, from a body's given axes to its principal axes.
    pub(crate) fn turn_of_written(&self, body: BodyIndex, turn: [f64; 4]) -> [f64; 4] {
        match self.turns.get(body.row()) {
            Some(Some(own)) => {
                settled(own.conjugate().product(Quaternion::from_f64(turn)).to_f64())
            }
            _ => turn,
        }
    }
}
