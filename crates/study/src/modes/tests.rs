use dbd_kernel::State;
use dbd_scene::Scene;

use super::*;

fn scene(text: &str) -> Scene {
    let head = "name = \"s\"\nduration = 1\n";
    Scene::parse(&format!("{head}{text}"), "s.toml").unwrap_or_else(|e| panic!("{e}"))
}

fn modes_of(scene: &Scene) -> Modes {
    modes(&scene.model, &State::initial(&scene.model)).unwrap()
}

/// Two free masses and a spring between them, far from the origin; dampers are ignored.
fn two_masses(place: f64) -> Scene {
    scene(&format!(
        "gravity = [0, 0, 0]
         [[body]]
         name = \"a\"
         mass = 1
         inertia = [0.1, 0.2, 0.25]
         position = [{place}, 0, 0]
         [[body]]
         name = \"b\"
         mass = 3
         inertia = [0.1, 0.2, 0.15]
         position = [{}, 0, 0]
         [[tsda]]
         between = [\"a\", \"b\"]
         points = [[0, 0, 0], [0, 0, 0]]
         stiffness = 400
         damping = 5
         free_length = 0.5",
        place + 0.5
    ))
}

#[test]
fn two_masses_have_one_vibration_and_eleven_free_motions() {
    for place in [0.0, 100.0] {
        let scene = two_masses(place);
        let modes = modes_of(&scene);
        assert_eq!((modes.frequencies.len(), modes.free(), modes.unstable()), (12, 11, 0));
        let expected = (400.0_f64 * (1.0 + 1.0 / 3.0)).sqrt() / TAU;
        assert!((modes.frequencies[11] / expected - 1.0).abs() < 1e-8, "{:?}", modes.frequencies);
        // Each moves against the other, the heavy one a third as far.
        let motion = modes.motion(&scene.model, 11);
        assert!((motion[0][0] - 1.0).abs() < 1e-6 && (motion[1][0] + 1.0 / 3.0).abs() < 1e-6);
        let rest: f64 = motion.iter().flat_map(|body| &body[1..]).map(|v| v.abs()).sum();
        assert!(rest < 1e-5, "{motion:?}");
        assert_eq!(remarks(&scene, &modes).unwrap(), [""; 0]);
    }
}

/// A rod on a stiff pivot at the origin, its centre at `y` \[m\], with the pivot loaded by its weight.
fn pendulum(y: f64) -> Scene {
    let sag = 2.0 * 9.81 / 1e6;
    scene(&format!(
        "gravity = [0, -9.81, 0]
         [[body]]
         name = \"rod\"
         mass = 2
         inertia = [0.05, 0.02, 0.06]
         position = [0, {}, 0]
         [[tsda]]
         between = [\"world\", \"rod\"]
         points = [[0, 0, 0], [0, {}, 0]]
         stiffness = 1e6
         free_length = 0",
        y - sag,
        -y
    ))
}

#[test]
fn a_pendulum_swings_about_two_axes_as_its_inertia_says() {
    let modes = modes_of(&pendulum(-0.4));
    // It may also rotate about its longitudinal axis.
    assert_eq!((modes.free(), modes.unstable()), (1, 0));
    for (mode, inertia) in [(1, 0.06), (2, 0.05)] {
        let expected = (2.0 * 9.81 * 0.4 / (inertia + 2.0 * 0.16_f64)).sqrt() / TAU;
        let found = modes.frequencies[mode];
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
    assert_eq!(remarks(&pendulum(-0.4), &modes).unwrap(), [""; 0]);
}

#[test]
fn upright_it_falls() {
    let scene = pendulum(0.4);
    let modes = modes_of(&scene);
    assert_eq!((modes.free(), modes.unstable()), (1, 2));
    let expected = -(2.0 * 9.81 * 0.4 / (0.05 + 2.0 * 0.16_f64)).sqrt() / TAU;
    assert!((modes.frequencies[0] / expected - 1.0).abs() < 1e-3, "{:?}", modes.frequencies);
    let remarks = remarks(&scene, &modes).unwrap();
    assert!(
        remarks.len() == 1 && remarks[0].starts_with("2 modes have negative frequencies"),
        "{remarks:?}"
    );
}

#[test]
fn a_pose_that_moves_or_falls_is_said() {
    let scene = scene(
        "gravity = [0, -9.81, 0]
         [[body]]
         name = \"stone\"
         mass = 2
         inertia = [0.03, 0.02, 0.04]
         position = [0, 0, 0]
         velocity = [1, 0, 0]",
    );
    let modes = modes_of(&scene);
    assert_eq!(modes.frequencies, [0.0; 6]);
    let remarks = remarks(&scene, &modes).unwrap();
    assert!(remarks[0].contains("moves at t = 0"), "{remarks:?}");
    assert!(
        remarks[1].contains("`stone` is unsupported and accelerates with 9.81 m/s²"),
        "{remarks:?}"
    );
}

#[test]
fn too_many_bodies_are_refused_and_numbers_beyond_all_numbers() {
    let mut scene = two_masses(0.0);
    scene.model.tsdas[0].stiffness = f64::MAX;
    let state = State::initial(&scene.model);
    assert_eq!(modes(&scene.model, &state).unwrap_err(), ModesError::Range);
    let body = scene.model.bodies[0];
    scene.model.bodies = vec![body; MAX_BODIES + 1];
    let error = modes(&scene.model, &state).unwrap_err();
    assert!(
        error.to_string().contains("201 bodies") && error.to_string().contains("200"),
        "{error}"
    );
}

#[test]
fn a_pose_that_gives_way_says_how_far() {
    // The pivot does not carry the rod yet: it deflects by 20 µm, and there is no swing.
    let mut scene = pendulum(-0.4);
    scene.model.initial[0].position.y = -0.4;
    let modes = modes_of(&scene);
    assert_eq!(modes.free(), 3);
    let remarks = remarks(&scene, &modes).unwrap();
    assert!(remarks[0].contains("reaches equilibrium about 0.0196 mm away"), "{remarks:?}");
}
