//! The law `bushing` with six stiffnesses, against closed forms.

use dbd_plant::instance::LinearOptions;

use crate::{instance, value};

const ALONG: [f64; 3] = [2e5, 5e4, 9e4];
const ABOUT: [f64; 3] = [300.0, 20.0, 90.0];

/// A body of 2 kg on a bushing whose axes are tilted, with another orientation than the ground at t = 0.
fn mounted(gravity: &str, start: &str, more: &str) -> String {
    let [kx, ky, kz] = ALONG;
    let [tx, ty, tz] = ABOUT;
    format!(
        "name = \"mount\"\nduration = 1\n{gravity}\n[[body]]\nname = \"engine\"\nmass = 2\n\
         inertia = [0.05, 0.05, 0.05]\nposition = [0.3, 0.2, 0.1]\n\
         orientation = {{ axis = [1, 2, 2], angle = 0.7 }}\n{start}\n[[interaction]]\nname = \"mount\"\n\
         law = \"bushing\"\nbetween = [\"world\", \"engine\"]\npoints = [[0.3, 0.2, 0.1], [0, 0, 0]]\n\
         x = [0.6, 0, 0.8]\nz = [0.8, 0, -0.6]\nstiffness_x = {kx}\nstiffness_y = {ky}\nstiffness_z = {kz}\n\
         turn_stiffness_x = {tx}\nturn_stiffness_y = {ty}\nturn_stiffness_z = {tz}\n{more}\n"
    )
}

/// Six vibrations: √(k/m) along each axis and √(K/I) about it.
#[test]
fn each_axis_vibrates_with_its_own_stiffness() {
    let plant = instance(&mounted("gravity = [0, 0, 0]", "", ""), 1e-4, "f64");
    let poles = plant.linearise(&LinearOptions::default()).unwrap().poles().unwrap();
    let mut exact: Vec<f64> = ALONG.map(|k| (k / 2.0).sqrt()).into_iter().collect();
    exact.extend(ABOUT.map(|k| (k / 0.05).sqrt()));
    exact.sort_by(f64::total_cmp);
    for (pair, exact) in poles.chunks(2).zip(exact) {
        for pole in pair {
            let (found, rate) = (pole.im.abs(), pole.re);
            assert!((found / exact - 1.0).abs() < 1e-6 && rate.abs() < 1e-3, "{pole} {exact}");
        }
    }
}

/// Each axis decays with its own damping: c/(2·m) and C/(2·I).
#[test]
fn each_axis_decays_with_its_own_damping() {
    let damped = "damping_x = 40\ndamping_y = 20\ndamping_z = 10\nturn_damping_x = 0.3\n\
                  turn_damping_y = 0.1\nturn_damping_z = 0.2";
    let plant = instance(&mounted("gravity = [0, 0, 0]", "", damped), 1e-4, "f64");
    let poles = plant.linearise(&LinearOptions::default()).unwrap().poles().unwrap();
    let mut exact: Vec<[f64; 2]> = Vec::new();
    for (k, c) in ALONG.into_iter().zip([40.0, 20.0, 10.0]) {
        exact.push([(k / 2.0).sqrt(), 0.5 * c / 2.0]);
    }
    for (k, c) in ABOUT.into_iter().zip([0.3, 0.1, 0.2]) {
        exact.push([(k / 0.05).sqrt(), 0.5 * c / 0.05]);
    }
    exact.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for (pair, [_, decay]) in poles.chunks(2).zip(exact) {
        assert!((pair[0].re + decay).abs() < 1e-4 * decay, "{} {decay}", pair[0]);
    }
}

/// Under its weight it gives way by mass × gravity over the stiffness of each axis, in every precision.
#[test]
fn a_weight_deflects_each_axis_by_its_stiffness() {
    let weight = 2.0 * 9.81;
    // Gravity along x, along y and along z of the bushing.
    let axes = [[0.6, 0.0, 0.8], [0.0, -1.0, 0.0], [0.8, 0.0, -0.6]];
    for (precision, near) in [("f64", 1e-9), ("f32", 1e-7), ("fixed", 1e-7)] {
        for (row, axis) in axes.into_iter().enumerate() {
            let [x, y, z] = axis.map(|part: f64| 9.81 * part);
            let text = mounted(&format!("gravity = [{x}, {y}, {z}]"), "", "");
            let readouts =
                "[[readout]]\nname = \"force\"\ntype = \"interaction\"\ntarget = \"mount\"\n\
                            quantity = \"force_QUANTITY\"\n"
                    .replace("QUANTITY", ["x", "y", "z"][row]);
            let mut plant = instance(&format!("{text}{readouts}"), 1e-4, precision);
            plant.settle().unwrap();
            let moved = [("x", 0.3), ("y", 0.2), ("z", 0.1)]
                .map(|(name, start)| value(&plant, &format!("engine.{name}")) - start);
            let exact = weight / ALONG[row];
            for (moved, axis) in moved.into_iter().zip(axis) {
                assert!((moved - exact * axis).abs() < near, "{precision} {row}: {moved} {exact}");
            }
            let force = value(&plant, "force").abs();
            assert!((force - weight).abs() < 2e-2, "{precision} {row}: {force}");
        }
    }
}

/// A rotation of 170° about no axis in particular keeps the energy; the bushing has no singular pose.
#[test]
fn a_large_rotation_keeps_the_energy() {
    let spinning = "angular_velocity = [60, -60, 100]\nvelocity = [3, 1, -2]";
    let mut plant = instance(&mounted("gravity = [0, 0, 0]", spinning, ""), 2e-5, "f64");
    let start = value(&plant, "energy.total");
    let (mut worst, mut turned): (f64, f64) = (0.0, 0.0);
    let orientation =
        |plant: &dbd_plant::instance::Instance| plant.plant().state().bodies[0].orientation;
    let before = orientation(&plant);
    for _ in 0..2000 {
        plant.advance(50).unwrap();
        worst = worst.max((value(&plant, "energy.total") / start - 1.0).abs());
        turned = turned
            .max(2.0 * before.conjugate().product(orientation(&plant)).w.abs().min(1.0).acos());
    }
    assert!(turned > 2.9, "{turned} rad");
    assert!(worst < 1e-4, "{worst:e}");
}

/// In its plane and in space the same.
#[test]
fn a_planar_bushing_is_the_spatial_one() {
    let text = "name = \"mount\"\nduration = 1\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"engine\"\nmass = 2\n\
                inertia = [0.05, 0.05, 0.05]\nposition = [0.1, 0.02, 0]\nangular_velocity = [0, 0, 9]\n\
                [[interaction]]\nlaw = \"bushing\"\nbetween = [\"world\", \"engine\"]\n\
                points = [[0, 0, 0], [-0.1, -0.02, 0]]\nx = [0.6, 0.8, 0]\nz = [0, 0, 1]\nstiffness_x = 2e4\n\
                stiffness_y = 5e3\nstiffness_z = 9e4\nturn_stiffness_x = 1000\nturn_stiffness_y = 1000\n\
                turn_stiffness_z = 15\ndamping_x = 10\ndamping_y = 5\ndamping_z = 3\nturn_damping_x = 1\n\
                turn_damping_z = 0.02\n";
    for (precision, near) in [("f64", 1e-9), ("f32", 1e-3)] {
        let run = |text: &str| {
            let mut plant = instance(text, 1e-4, precision);
            plant.advance_to(0.5).unwrap();
            ["engine.x", "engine.y", "engine.vx", "engine.wz"].map(|name| value(&plant, name))
        };
        let space = run(text);
        let plane = run(&text.replacen("duration", "planar = true\nduration", 1));
        for (space, plane) in space.into_iter().zip(plane) {
            assert!((space - plane).abs() < near, "{precision}: {space} {plane}");
        }
    }
}

/// The same motion with an implicit scheme.
#[test]
fn an_implicit_scheme_steps_it() {
    use dbd_plant::instance::{Blueprint, Instance, Settings};
    let text =
        mounted("gravity = [0, 0, -9.81]", "angular_velocity = [4, -3, 6]", "damping_x = 50");
    let run = |scheme: &str, step: f64| {
        let settings =
            Settings { scheme: Some(scheme.into()), step: Some(step), ..Settings::default() };
        let mut plant =
            Instance::new(Blueprint::new("mount.toml", text.as_str()), settings).unwrap();
        plant.advance_to(0.1).unwrap();
        ["engine.x", "engine.z", "engine.wx"].map(|name| value(&plant, name))
    };
    let (exact, found) = (run("leapfrog", 1e-5), run("generalized-alpha-3", 1e-4));
    for (exact, found) in exact.into_iter().zip(found) {
        assert!((exact - found).abs() < 2e-4 * (1.0 + exact.abs()), "{exact} {found}");
    }
}

#[test]
fn constants_that_make_no_bushing_are_refused() {
    let text = mounted("gravity = [0, 0, 0]", "", "");
    let zero = ["stiffness_x = 200000", "stiffness_y = 50000", "stiffness_z = 90000"]
        .into_iter()
        .chain(["turn_stiffness_x = 300", "turn_stiffness_y = 20", "turn_stiffness_z = 90"])
        .fold(text.clone(), |text, line| {
            let (key, _) = line.split_once('=').unwrap();
            assert!(text.contains(line), "{line}");
            text.replace(line, &format!("{key}= 0"))
        });
    for (text, why) in [
        (text.replace("x = [0.6, 0, 0.8]", "x = [0.6, 0, 0.9]"), "is not perpendicular to `z`"),
        (text.replace("stiffness_y = 50000", "stiffness_y = -1"), "is negative"),
        (format!("{text}turn_damping_z = -1\n"), "is negative"),
        (zero, "is 0 like all others"),
        (text.replace("turn_stiffness_z = 90\n", ""), "turn_stiffness_z"),
    ] {
        let refused = dbd_scene::Scene::parse(&text, "mount.toml").unwrap_err().to_string();
        assert!(refused.contains(why), "{refused}: {text}");
    }
}
