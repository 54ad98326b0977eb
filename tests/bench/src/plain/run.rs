//! A plain loop's steps.

use crate::vectors::{
    Vector, cross, difference, matrix, normalised, product, scaled, sum, turn, turned, turned_back,
};

use super::body::{Body, Load};
use super::elements::{Spring, Torsion};

/// A mechanism on its way through time.
#[derive(Clone, Debug, PartialEq)]
pub struct Plain {
    /// Its bodies.
    pub bodies: Vec<Body>,
    pub(super) gravity: Vector,
    pub(super) springs: Vec<Spring>,
    pub(super) torsions: Vec<Torsion>,
    pub(super) loads: Vec<Load>,
    pub(super) step: f64,
    pub(super) steps: u64,
    pub(super) has_forces: bool,
}

impl Plain {
    /// So many steps of kick–drift–kick: second order, one evaluation each.
    pub fn advance(&mut self, steps: u64) {
        for _ in 0..steps {
            if !self.has_forces {
                self.evaluate();
                self.has_forces = true;
            }
            self.kick();
            self.drift();
            self.steps += 1;
            self.evaluate();
            self.kick();
        }
    }

    /// Forces and torques at the present pose.
    fn evaluate(&mut self) {
        let Self { bodies, gravity, springs, torsions, loads, .. } = self;
        for body in bodies.iter_mut() {
            body.rotation = matrix(body.orientation);
            body.spin = turned(&body.rotation, body.rate);
            body.force = scaled(*gravity, body.mass);
            body.torque = [0.0; 3];
        }
        let time = self.steps as f64 * self.step;
        for load in loads.iter().filter(|load| load.from <= time && time < load.until) {
            let body = &mut bodies[load.body];
            let in_world = |v| match load.in_body_axes {
                true => turned(&body.rotation, v),
                false => v,
            };
            let (force, torque) = (in_world(load.force), in_world(load.torque));
            body.force = sum(body.force, force);
            body.torque = sum(body.torque, torque);
        }
        for spring in springs.iter() {
            spring.pull(bodies);
        }
        for torsion in torsions.iter_mut() {
            torsion.turn(bodies);
        }
        for body in bodies.iter_mut() {
            let momentum = std::array::from_fn(|i| body.inertia[i] * body.rate[i]);
            let torque = turned_back(&body.rotation, body.torque);
            body.torque = difference(torque, cross(body.rate, momentum));
        }
    }

    /// Half a step of the forces.
    fn kick(&mut self) {
        let half = 0.5 * self.step;
        for body in &mut self.bodies {
            body.velocity = sum(body.velocity, scaled(body.force, half / body.mass));
            for i in 0..3 {
                body.rate[i] += half * body.torque[i] / body.inertia[i];
            }
        }
    }

    fn drift(&mut self) {
        for body in &mut self.bodies {
            body.position = sum(body.position, scaled(body.velocity, self.step));
            let turn = turn(scaled(body.rate, self.step));
            body.orientation = normalised(product(body.orientation, turn));
        }
    }
}
