//! Leapfrog over the same elements, written plainly: one loop over one flat list, in double precision.
//!
//! `(model, step) => bodies, after so many steps`. Arrays of numbers and the standard library's functions, no
//! generic code and no library: what one writes who wants it fast and knows nothing more. Each element places
//! both its points; a rotation matrix is made once per body and pose. What it does not have, it refuses.

mod elements;
mod read;

pub use elements::{End, Spring, Stretch, Torsion};
pub use read::Lacks;

use crate::vectors::{
    Matrix, Quaternion, Vector, cross, difference, matrix, normalised, product, scaled, sum, turn,
    turned, turned_back,
};

/// A body and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] body axes.
    pub inertia: Vector,
    /// \[m\] centre of mass, world.
    pub position: Vector,
    /// Body → world.
    pub orientation: Quaternion,
    /// \[m/s\] world.
    pub velocity: Vector,
    /// \[rad/s\] body axes.
    pub rate: Vector,
    /// Body → world, of this pose.
    rotation: Matrix,
    /// \[rad/s\] world axes, at this pose.
    spin: Vector,
    /// \[N\] world axes.
    force: Vector,
    /// \[N·m\] about the centre of mass: world axes while elements add to it, then body axes, with what tumbling
    /// does.
    torque: Vector,
}

/// A force and a torque on a body over a window of time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Load {
    body: usize,
    in_body_axes: bool,
    force: Vector,
    torque: Vector,
    from: f64,
    until: f64,
}

/// A mechanism on its way through time.
#[derive(Clone, Debug, PartialEq)]
pub struct Plain {
    /// Its bodies.
    pub bodies: Vec<Body>,
    gravity: Vector,
    springs: Vec<Spring>,
    torsions: Vec<Torsion>,
    loads: Vec<Load>,
    step: f64,
    steps: u64,
    has_forces: bool,
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
