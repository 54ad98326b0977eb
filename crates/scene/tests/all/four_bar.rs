//! The shipped four-bar scene: its counts, its closed loop, its springs at free length.

use std::path::Path;

use dbd_kernel::energy::largest_extension;
use dbd_kernel::{BodyIndex, State, Vec3};
use dbd_scene::Scene;

fn four_bar() -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/four-bar.toml");
    Scene::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn it_has_three_bodies_and_twenty_four_tsdas() {
    let scene = four_bar();
    let model = &scene.model;
    assert_eq!(scene.body_names, ["crank", "coupler", "rocker"]);
    assert_eq!((model.bodies.len(), model.tsda_count(), model.groups.len()), (3, 24, 4));
    assert_eq!((model.points.len(), model.dampers.len(), model.torsions.len()), (20, 0, 2));
    assert_eq!(model.gravity, [Vec3::new(0.0, -9.81, 0.0)]);
    assert_eq!((scene.duration, scene.step, scene.every), (0.5, Some(2e-5), Some(1e-3)));
    assert_eq!(
        scene.torsion_names,
        ["torsion_spring 1 (world–crank)", "torsion_spring 2 (world–rocker)"]
    );
    for joint in &scene.joints {
        assert_eq!((joint.kind, joint.holds, joint.tsdas), ("revolute", 5, 6));
    }
    // Each group's elements and points follow those of the one before.
    for (i, group) in model.groups.iter().enumerate() {
        assert_eq!((group.point, group.element), (5 * i as u16, 6 * i as u16));
        assert_eq!((group.triples, group.arms, group.shared), (2, 3, true));
    }
}

#[test]
fn its_springs_are_at_free_length() {
    let scene = four_bar();
    let largest = largest_extension(&scene.model, &State::initial(&scene.model));
    assert!(largest < 1e-12, "{largest:e}");
    let reported = scene.joints.iter().map(|joint| joint.assembly_error).fold(0.0, f64::max);
    assert!((reported - largest).abs() < 1e-15, "{reported:e} {largest:e}");
}

/// The ends of a link lie at ±L/2 on its y axis; where two links meet, so do their ends.
#[test]
fn link_ends_meet() {
    let scene = four_bar();
    let end = |row: usize, along: f64| {
        let state = &scene.model.initial[row];
        state.position + state.orientation.rotation().to_world(Vec3::new(0.0, along, 0.0))
    };
    let (ground_a, ground_b) = (Vec3::ZERO, Vec3::new(3.5, 0.0, 0.0));
    for (p, q) in [
        (ground_a, end(0, -0.5)),
        (end(0, 0.5), end(1, -2.0)),
        (end(1, 2.0), end(2, 1.25)),
        (ground_b, end(2, -1.25)),
    ] {
        let gap = p - q;
        assert!(libm::sqrt(gap.dot(gap)) < 1e-12, "{gap:?}");
    }
}

/// The axis points lie on the first body at ±span/2, the ring points on the second at 120°·j from
/// the reference, which defaults to x for an axis along z.
#[test]
fn a_revolute_lies_as_its_definition_says() {
    let scene = four_bar();
    let group = scene.model.groups[0];
    assert_eq!((group.a, group.b), (BodyIndex::WORLD, BodyIndex(0)));
    let points = &scene.model.points[..5];
    assert_eq!(points[0], Vec3::new(0.0, 0.0, -0.1));
    assert_eq!(points[1], Vec3::new(0.0, 0.0, 0.1));
    let crank = &scene.model.initial[0];
    let radius = 0.2 / core::f64::consts::SQRT_2;
    for (j, point) in points[2..].iter().enumerate() {
        let world = crank.position + crank.orientation.rotation().to_world(*point);
        let azimuth = 120.0_f64.to_radians() * j as f64;
        let expected =
            Vec3::new(radius * libm::cos(azimuth), radius * libm::sin(azimuth), 0.0) - world;
        assert!(libm::sqrt(expected.dot(expected)) < 1e-15, "{j}: {expected:?}");
    }
    let free_length = scene.model.tsdas[0].free_length;
    assert!((free_length - 0.5 * libm::sqrt(3.0) * 0.2).abs() < 1e-16);
}
