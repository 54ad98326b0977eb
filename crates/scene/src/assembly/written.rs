//! What bodies are written with: named points, ends of links, axes that are not the principal ones.

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

    /// Where a body has a point of that name of its own, from its centre of mass, body axes.
    pub(crate) fn end(&self, body: BodyIndex, point: &str) -> Option<Vec3<f64>> {
        let mut ends = self.ends.get(body.row())?.iter();
        ends.find(|(name, _)| name == point).map(|(_, place)| *place)
    }

    /// Gives a body points of its own.
    pub(crate) fn set_ends(&mut self, body: BodyIndex, ends: Vec<(String, Vec3<f64>)>) {
        if let Some(known) = self.ends.get_mut(body.row()) {
            *known = ends;
        }
    }

    /// Says how a body's principal axes lie in those that it is written in.
    pub(crate) fn set_turn(&mut self, body: BodyIndex, turn: Option<Quaternion<f64>>) {
        if let Some(known) = self.turns.get_mut(body.row()) {
            *known = turn;
        }
    }

    /// A vector in the axes that a body is written in, in its principal axes.
    pub(crate) fn of_written(&self, body: BodyIndex, vector: Vec3<f64>) -> Vec3<f64> {
        match self.turns.get(body.row()) {
            Some(Some(turn)) => turn.rotation().to_body(vector),
            _ => vector,
        }
    }

    /// The orientation of a body's principal axes, unit and scalar first, given that of the axes it is written in.
    pub(crate) fn orientation_of_written(&self, body: BodyIndex, written: [f64; 4]) -> [f64; 4] {
        match self.turns.get(body.row()) {
            Some(Some(turn)) => normalised(Quaternion::from_f64(written).product(*turn).to_f64()),
            _ => written,
        }
    }

    /// A turn in the axes that a body is written in, unit and scalar first, in its principal axes.
    pub(crate) fn turn_of_written(&self, body: BodyIndex, turn: [f64; 4]) -> [f64; 4] {
        match self.turns.get(body.row()) {
            Some(Some(own)) => {
                settled(own.conjugate().product(Quaternion::from_f64(turn)).to_f64())
            }
            _ => turn,
        }
    }
}
