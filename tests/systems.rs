//! Test systems that are assembled at run time.

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::builder::{LineLaw, ModelBuilder, Triples};
use dbd_kernel::{BodyIndex, BodyState, Geometry, ModelOwner, Quaternion, Vec3};

use crate::turned;

/// A builder with room for every test system.
pub type Bench<P> = ModelBuilder<P, 6, 12, 60, 48, 12, 60, 6, 6, 6, 8, 12>;

/// World points in the axes of a body of the bench; the ground's stay as they are.
fn local<P: Geometry>(model: &Bench<P>, body: BodyIndex, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let Some(state) = model.initial().get(body.row()) else { return points.to_vec() };
    let rotation =
        Quaternion::<f64>::from_f64(P::Orientation::to_f64(&state.orientation)).rotation();
    let centre = Vec3::<f64>::from_f64(P::position_to_f64(&state.position));
    let turn = |p: &[f64; 3]| rotation.to_body(Vec3::from_f64(*p) - centre).to_f64();
    points.iter().map(turn).collect()
}

/// Joins two bodies at a world point: by a revolute about z with its ring \[m\] out of the mid plane, or by a spherical
/// joint.
fn join<P: Geometry>(
    model: &mut Bench<P>,
    between: [BodyIndex; 2],
    at: [f64; 3],
    revolute: Option<f64>,
    damping: f64,
) {
    let shifted = |d: [f64; 3]| [at[0] + d[0], at[1] + d[1], at[2] + d[2]];
    let ring = |j: u32| {
        let angle = f64::from(j) * 2.0 * std::f64::consts::PI / 3.0;
        shifted([0.2 * angle.cos(), 0.2 * angle.sin(), revolute.unwrap_or(0.1)])
    };
    let centres = if revolute.is_some() {
        vec![shifted([0.0, 0.0, -0.2]), shifted([0.0, 0.0, 0.2])]
    } else {
        vec![at]
    };
    let arms: Vec<_> = (0..3).map(ring).collect();
    let height: f64 = if revolute.is_some() { 0.2 } else { 0.1 };
    let triples = Triples {
        between,
        centres: &local(model, between[0], &centres),
        arms: &local(model, between[1], &arms),
        stiffness: 2_000.0,
        damping,
        free_length: (0.04 + height * height).sqrt(),
        clearance: 0.0,
    };
    model.add_triples(triples).unwrap();
}

/// Three asymmetric bodies, tumbling, joined in a ring by every kind of element, without ground
/// and gravity. Bushing and lines have no damper: their law does not keep angular momentum.
///
/// # Panics
/// Never: the bench has room.
#[must_use]
pub fn free_ring<P: Geometry>(damping: f64) -> Bench<P> {
    free_ring_of(0.0, damping)
}

fn free_ring_of<P: Geometry>(plane: f64, damping: f64) -> Bench<P> {
    let mut model = Bench::new();
    for i in 0..3_u32 {
        let angle = f64::from(i) * 2.0;
        let state = BodyState::from_f64(
            [angle.cos(), angle.sin(), 0.1 * f64::from(i)],
            turned([0.6, 0.0, 0.8], 0.4 * angle),
            [0.3 * angle.sin(), -0.2, 0.1 * angle.cos()],
            [0.8 - 0.2 * angle, 0.5, 0.3],
        );
        let inertia = [0.05, 0.08 + 0.01 * f64::from(i), 0.11];
        model.add_body(1.0 + f64::from(i), inertia, state).unwrap();
    }
    let [a, b, c] = [0, 1, 2].map(BodyIndex);
    join(&mut model, [a, b], [0.3, 0.5, 0.0], Some(plane), damping);
    join(&mut model, [b, c], [-0.5, 0.1, 0.1], None, damping);
    model.add_tsda([c, a], [[0.1, 0.2, 0.3], [0.0, -0.2, 0.1]], 150.0, damping, 1.5).unwrap();
    model.add_tsda([a, c], [[-0.4, 0.2, 0.3], [0.3, 0.2, 0.1]], 6.0, 0.0, 0.0).unwrap();
    model.add_torsion_spring([a, b], [0.0, 0.0, 1.0], 20.0, damping * 0.1, 3.0).unwrap();
    let mut hold = |between, points: &[[f64; 3]], free_length| {
        let law = LineLaw { stiffness: 25.0, damping: 0.0, free_length, clearance: 0.0 };
        model.add_points_on_line(between, [0.1, -0.2, 0.3], [0.3, 0.4, 1.2], points, law).unwrap();
    };
    hold([c, b], &[[0.2, 0.1, 0.0], [0.1, -0.3, 0.2]], 0.0);
    hold([a, c], &[[-0.3, 0.1, 0.4]], 0.2);
    model
}

/// [`free_ring`] hung to the ground under gravity.
///
/// # Panics
/// Never: the bench has room.
#[must_use]
pub fn hung_ring<P: Geometry>(damping: f64) -> Bench<P> {
    hung_ring_of(0.0, damping)
}

/// [`hung_ring`] whose revolutes have their rings out of the mid plane: none is a point with an axis.
///
/// # Panics
/// Never: the bench has room.
#[must_use]
pub fn uneven_ring<P: Geometry>(damping: f64) -> Bench<P> {
    hung_ring_of(0.02, damping)
}

fn hung_ring_of<P: Geometry>(plane: f64, damping: f64) -> Bench<P> {
    let mut model = free_ring_of(plane, damping);
    model.set_gravity([0.3, -9.81, 0.5]).unwrap();
    let world = BodyIndex::WORLD;
    join(&mut model, [world, BodyIndex(0)], [1.1, 0.4, 0.0], Some(plane), damping);
    let points = [[0.1, 0.2, -0.1], [-0.6, -0.5, 0.2]];
    model.add_tsda([BodyIndex(2), world], points, 100.0, damping, 0.0).unwrap();
    model.add_torsion_spring([world, BodyIndex(0)], [0.0, 0.0, 1.0], 8.0, 0.0, 0.5).unwrap();
    model
}
