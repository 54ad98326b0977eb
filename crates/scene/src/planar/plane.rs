//! A plane in space with its bodies: conversion between the world and the plane.
//!
//! `world vectors, orientations <=> those of the plane's own axes, its normal their z`. Where the normal is an axis of
//! the world or of a body the conversion permutes components, without rounding.

use dbd_kernel::vector::Rotation;
use dbd_kernel::{BodyState, F64, Quaternion, Vec3};

use crate::direction::{least_aligned, normals, unit};
use crate::orientation::of_axes;

/// Directions are equal if the sine of their angle is below this.
pub(crate) const ALIKE: f64 = 1e-9;

/// Half a revolution about x: z becomes −z.
const FLIP: Quaternion<f64> = Quaternion::new(0.0, 1.0, 0.0, 0.0);

/// The rotation that maps x to y, y to z, z to x.
const ONWARD: Quaternion<f64> = Quaternion::new(0.5, 0.5, 0.5, 0.5);

/// Axes whose z is the normal, as a rotation from them to the axes in which the normal is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axes {
    turn: Quaternion<f64>,
    rotation: Rotation<f64>,
}

impl Axes {
    /// The axes of a unit normal. A normal close to ± a coordinate axis is replaced by it.
    pub(crate) fn of(normal: Vec3<f64>) -> Self {
        let [x, y, z] = normal.to_f64();
        let along = |others: [f64; 2]| others.iter().all(|other| other.abs() <= ALIKE);
        let (turn, sign) = if along([x, y]) {
            (Quaternion::IDENTITY, z)
        } else if along([y, z]) {
            (ONWARD, x)
        } else if along([x, z]) {
            (ONWARD.conjugate(), y)
        } else {
            let [x, y, _] = Vec3::axes();
            let [e1, e2] = normals(normal, least_aligned(normal)).unwrap_or([x, y]);
            (Quaternion::from_f64(of_axes([e1, e2, normal])), 1.0)
        };
        let turn = if sign < 0.0 { turn.product(FLIP) } else { turn };
        Self { turn, rotation: turn.rotation() }
    }

    /// A vector in these axes.
    pub(crate) fn inward(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.rotation.to_body(v)
    }

    /// A vector of these axes, outside.
    pub(crate) fn outward(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.rotation.to_world(v)
    }

    /// The normal, outside.
    pub(crate) fn normal(&self) -> Vec3<f64> {
        self.outward(Vec3::new(0.0, 0.0, 1.0))
    }
}

/// The plane of a scene, and the orientation of each body's axes in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    axes: Axes,
    /// \[m\] distance from the world's origin along the normal.
    height: f64,
    /// \[m\] size of the scene.
    size: f64,
    /// Per body the axes whose z is the normal.
    bodies: Vec<Axes>,
}

impl Plane {
    pub(crate) fn new(axes: Axes, height: f64, size: f64) -> Self {
        Self { axes, height, size, bodies: Vec::new() }
    }

    /// Adds the next body; the normal is given in its own axes.
    pub(crate) fn add_body(&mut self, normal_b: Vec3<f64>) {
        self.bodies.push(Axes::of(normal_b));
    }

    /// The unit normal, world.
    #[must_use]
    pub fn normal(&self) -> Vec3<f64> {
        self.axes.normal()
    }

    /// \[m\] the plane's distance from the world's origin along its normal.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Its name in messages: `z = 0`, or its normal and distance.
    #[must_use]
    pub fn name(&self) -> String {
        let normal = self.normal().to_f64();
        let axis = ["x", "y", "z"].into_iter().zip(normal).find(|(_, n)| n.abs() == 1.0);
        let height = self.height;
        match axis {
            Some((axis, sign)) => {
                format!("{axis} = {}", short(if height == 0.0 { 0.0 } else { sign * height }))
            }
            None => format!(
                "normal to [{}], {} m from the origin",
                normal.map(short).join(", "),
                short(height)
            ),
        }
    }

    /// Converts a vector from the world to the plane's axes.
    #[must_use]
    pub fn inward(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.axes.inward(v)
    }

    /// Converts a vector from the plane's axes to the world.
    #[must_use]
    pub fn outward(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.axes.outward(v)
    }

    /// Converts a point \[m\] from the world to the plane's axes; z is its distance from the plane.
    #[must_use]
    pub fn place_inward(&self, place_w: Vec3<f64>) -> Vec3<f64> {
        let place = self.inward(place_w);
        Vec3::new(place.x, place.y, place.z - self.height)
    }

    /// Converts a point \[m\] from the plane's axes to the world.
    #[must_use]
    pub fn place_outward(&self, place: Vec3<f64>) -> Vec3<f64> {
        self.outward(Vec3::new(place.x, place.y, place.z + self.height))
    }

    /// Converts a vector from the axes of body `row` to those of the body in the plane; other rows mean the world.
    #[must_use]
    pub fn of_body_inward(&self, row: usize, v: Vec3<f64>) -> Vec3<f64> {
        self.bodies.get(row).unwrap_or(&self.axes).inward(v)
    }

    /// Converts a vector from the axes of body `row` in the plane to its own.
    #[must_use]
    pub fn of_body_outward(&self, row: usize, v: Vec3<f64>) -> Vec3<f64> {
        self.bodies.get(row).unwrap_or(&self.axes).outward(v)
    }

    /// Converts a point of body `row` \[m\], from its centre of mass in its own axes, to those of the body in the
    /// plane; for the world as [`Self::place_inward`].
    #[must_use]
    pub fn point_inward(&self, row: usize, point: Vec3<f64>) -> Vec3<f64> {
        if row < self.bodies.len() {
            self.of_body_inward(row, point)
        } else {
            self.place_inward(point)
        }
    }

    /// The rotation of body `b` relative to body `a`, or its inverse, converted from the plane to their own axes.
    #[must_use]
    pub fn turn_outward(&self, a: usize, b: usize, turn: Quaternion<f64>) -> Quaternion<f64> {
        let own = |row: usize| self.bodies.get(row).unwrap_or(&self.axes).turn;
        own(b).product(turn).product(own(a).conjugate())
    }

    /// Whether a state in the world leaves the plane by more than the fraction `share`: positions relative to the size
    /// of the scene, other quantities relative to their own.
    #[must_use]
    pub fn leaves(&self, row: usize, state: &BodyState<F64>, share: f64) -> bool {
        let length = |v: Vec3<f64>| libm::sqrt(v.dot(v));
        let place = self.place_inward(state.position);
        let body = self.bodies.get(row).map_or(Quaternion::IDENTITY, |body| body.turn);
        let turn = self.axes.turn.conjugate().product(state.orientation).product(body);
        let velocity = self.inward(state.velocity);
        let spin = self.of_body_inward(row, state.angular_velocity);
        place.z.abs() > share * self.size
            || libm::hypot(turn.v.x, turn.v.y) > share
            || velocity.z.abs() > share * length(velocity)
            || libm::hypot(spin.x, spin.y) > share * length(spin)
    }

    /// Converts the state of body `row` from the world to the plane; out-of-plane components are dropped.
    #[must_use]
    pub fn state_inward(&self, row: usize, state: &BodyState<F64>) -> BodyState<F64> {
        let body = self.bodies.get(row).map_or(Quaternion::IDENTITY, |body| body.turn);
        let turn = self.axes.turn.conjugate().product(state.orientation).product(body);
        let flat = |v: Vec3<f64>| [v.x, v.y, 0.0];
        let spin = self.of_body_inward(row, state.angular_velocity);
        BodyState::from_f64(
            flat(self.place_inward(state.position)),
            about_z(turn),
            flat(self.inward(state.velocity)),
            [0.0, 0.0, spin.z],
        )
    }

    /// Converts the state of body `row` from the plane to the world.
    #[must_use]
    pub fn state_outward(&self, row: usize, state: &BodyState<F64>) -> BodyState<F64> {
        let body = self.bodies.get(row).map_or(Quaternion::IDENTITY, |body| body.turn);
        let orientation = self.axes.turn.product(state.orientation).product(body.conjugate());
        BodyState {
            position: self.place_outward(state.position),
            orientation,
            velocity: self.outward(state.velocity),
            angular_velocity: self.of_body_outward(row, state.angular_velocity),
        }
    }
}

/// The rotation about z within a rotation, scalar first, unit; exact to the bit for a rotation about z.
fn about_z(turn: Quaternion<f64>) -> [f64; 4] {
    let Quaternion { w, v } = turn;
    if v.x == 0.0 && v.y == 0.0 {
        return [w, 0.0, 0.0, v.z];
    }
    match unit(Vec3::new(w, 0.0, v.z)) {
        Some(settled) => [settled.x, 0.0, 0.0, settled.z],
        // Not a valid rotation; the caller's checks report it.
        None => [w, 0.0, 0.0, v.z],
    }
}

/// A number for messages.
pub(crate) fn short(number: f64) -> String {
    let text = format!("{number:.6e}");
    let digits: f64 = text.parse().unwrap_or(number);
    let plain = digits == 0.0 || (1e-4..1e6).contains(&digits.abs());
    if plain { format!("{digits}") } else { format!("{digits:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Vec3<f64>, b: Vec3<f64>) -> bool {
        let d = a - b;
        d.dot(d) < 1e-28
    }

    #[test]
    fn the_normal_becomes_z_and_comes_back_and_axes_lose_no_bit() {
        let v = Vec3::new(0.1, -0.7, 1.0 / 3.0);
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                let normal = Vec3::from_f64(normal);
                let axes = Axes::of(normal);
                assert_eq!(axes.inward(normal), Vec3::new(0.0, 0.0, 1.0));
                assert_eq!(axes.normal(), normal);
                assert_eq!(axes.outward(axes.inward(v)), v);
            }
        }
        let normal = unit(Vec3::new(1.0, 2.0, -2.0)).unwrap();
        let axes = Axes::of(normal);
        assert!(near(axes.normal(), normal) && near(axes.outward(axes.inward(v)), v));
    }

    #[test]
    fn a_state_goes_into_the_plane_and_back() {
        let normal = unit(Vec3::new(2.0, -1.0, 0.5)).unwrap();
        let turn = Axes::of(normal);
        let mut plane = Plane::new(turn, 0.3, 1.0);
        // A body lying on its side: its own x is the normal.
        let flat = BodyState::<F64>::from_f64(
            [0.4, -0.2, 0.0],
            [libm::cos(0.4), 0.0, 0.0, libm::sin(0.4)],
            [1.0, 2.0, 0.0],
            [0.0, 0.0, 3.0],
        );
        plane.add_body(Vec3::new(1.0, 0.0, 0.0));
        let world = plane.state_outward(0, &flat);
        assert!((world.position.dot(normal) - 0.3).abs() < 1e-15);
        assert_eq!(world.angular_velocity, Vec3::new(3.0, 0.0, 0.0));
        let x = world.orientation.rotation().to_world(Vec3::new(1.0, 0.0, 0.0));
        assert!(near(x, normal));
        let back = plane.state_inward(0, &world);
        assert!(near(back.position, flat.position) && near(back.velocity, flat.velocity));
        assert!((back.orientation.w - flat.orientation.w).abs() < 1e-15);
        assert!((back.orientation.v.z - flat.orientation.v.z).abs() < 1e-15);
        assert_eq!(back.angular_velocity, flat.angular_velocity);
    }

    #[test]
    fn planes_are_called_by_their_axis() {
        let named = |normal: [f64; 3], height| {
            Plane::new(Axes::of(unit(Vec3::from_f64(normal)).unwrap()), height, 1.0).name()
        };
        assert_eq!(named([0.0, 0.0, 1.0], 0.0), "z = 0");
        assert_eq!(named([0.0, -1.0, 0.0], 0.25), "y = -0.25");
        assert_eq!(named([3.0, 0.0, 4.0], 2.0), "normal to [0.6, 0, 0.8], 2 m from the origin");
    }
}
