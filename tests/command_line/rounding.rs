//! What rounding loses is told, by the right amount; fixed point does not lose it.

use std::f64::consts::FRAC_PI_4;

use dbd_plant::{Method, PrecisionName, plant};
use dbd_scene::Scene;
use serde_json::Value;

use crate::{Folder, call};

/// A free body far from where numbers are fine, slow in a way and a turn.
fn drifter(place: &str, velocity: &str, rate: &str) -> String {
    format!(
        "name = \"drift\"\nduration = 2\nevery = 0.5\ngravity = [0, 0, 0]\n[[body]]\nname = \"b\"\nmass = 2\n\
         inertia = [0.02, 0.02, 0.02]\nposition = {place}\norientation = {{ axis = [0, 0, 1], angle = \"90 deg\" }}\nvelocity = {velocity}\nangular_velocity = {rate}\n"
    )
}

fn said(summary: &Value, part: &str) -> Option<String> {
    let warnings = summary["warnings"].as_array().unwrap().iter().map(|one| one.as_str().unwrap());
    warnings.filter(|text| text.contains(part)).map(str::to_owned).next()
}

/// The number before `unit of` in a warning of lost motion.
fn lost(text: &str) -> f64 {
    let words: Vec<&str> = text.split_whitespace().collect();
    let at = words.iter().position(|word| *word == "lost").unwrap();
    words[at + 1].parse().unwrap()
}

#[test]
fn the_loss_that_a_run_tells_is_the_one_that_it_has() {
    let folder = Folder::new();
    // Half the angle at the end of two seconds.
    let turned = FRAC_PI_4 + 4.363e-3;
    for (place, velocity, rate, step, column, meant) in [
        // 1 mm/s at 1.5 m: stands still, and runs fast.
        ("[0, 0, 1.5]", "[0, 0, 1e-3]", "[0, 0, 0]", "20us", "b.z", 1.5 + 2e-3),
        ("[0, 0, 1.5]", "[0, 0, 1e-3]", "[0, 0, 0]", "100us", "b.z", 1.5 + 2e-3),
        ("[20, 0, 0]", "[1e-2, 0, 0]", "[0, 0, 0]", "50us", "b.x", 20.0 + 2e-2),
        // A quarter of a degree per second about one axis: the sine of half the angle.
        ("[0, 0, 0]", "[0, 0, 0]", "[0, 0, 4.363e-3]", "20us", "b.qz", turned.sin()),
    ] {
        let scene = folder.scene(&drifter(place, velocity, rate));
        let options = ["--precision", "f32", "--step", step];
        let summary = folder.summary(&scene, &options);
        let trace = folder.trace("scene");
        let row = trace.header.iter().position(|name| name == column).unwrap();
        let last: f64 = trace.rows.last().unwrap()[row].parse().unwrap();
        let half = if column == "b.qz" { 2.0 / turned.cos() } else { 1.0 };
        let off = half * (last - meant).abs();
        let text = said(&summary, "has lost").unwrap_or_else(|| panic!("{step}: {summary}"));
        assert!((lost(&text) / off - 1.0).abs() < 0.06, "{off:e}: {text}");
        assert!(text.contains("body `b`") && text.contains("fixed"), "{text}");
        // It was to be seen before the run, too.
        assert!(said(&summary, "is too short for single precision: body `b` starts").is_some());
        for precision in ["f64", "fixed"] {
            let summary = folder.summary(&scene, &["--precision", precision, "--step", step]);
            assert_eq!(said(&summary, "lost"), None);
            let trace = folder.trace("scene");
            let last: f64 = trace.rows.last().unwrap()[row].parse().unwrap();
            let moved = (meant - place_of(place, column)).abs();
            assert!((last - meant).abs() < 1e-4 * moved, "{precision} {step}: {last:e}");
        }
    }
}

fn place_of(place: &str, column: &str) -> f64 {
    let numbers = place.trim_matches(['[', ']']).split(", ").map(|n| n.parse::<f64>().unwrap());
    let row = ["b.x", "b.y", "b.z"].iter().position(|name| *name == column);
    row.map_or(FRAC_PI_4.sin(), |row| numbers.collect::<Vec<f64>>()[row])
}

/// A tumbling handle flips in fixed point when it does in double precision, at any step.
#[test]
fn fixed_point_turns_as_double_precision() {
    let text = drifter("[1.5, 0, 0]", "[0, 0, 0]", "[1e-3, 6, 1e-3]")
        .replace("[0.02, 0.02, 0.02]", "[0.01, 0.02, 0.028]")
        .replace("duration = 2", "duration = 3");
    let scene = Scene::parse(&text, "handle.toml").unwrap();
    for step in [5e-6, 50e-6, 1e-3] {
        let end = |precision| {
            let method = Method::default().with_precision(precision);
            let mut plant = plant(&scene, &method, step).unwrap();
            assert!(plant.advance((3.0 / step).round() as u64).is_ok());
            plant.state().bodies[0].orientation.to_f64()
        };
        let [double, fixed] = [PrecisionName::F64, PrecisionName::Fixed].map(end);
        let off = double.iter().zip(fixed).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 2e-3, "{step}: {off:e}");
    }
}

/// Stiff joints make noise of the last digit of a position, which forces show: as large as it is said to be.
#[test]
fn noise_of_forces_is_told_by_its_size() {
    let folder = Folder::new();
    let text = |stiffness: &str| {
        format!(
            "name = \"hung\"\nduration = 0.1\nevery = 1e-4\nstep = 1e-5\ngravity = [0, -9.81, 0]\nsettle = true\n\
             [[body]]\nname = \"b\"\nmass = 3\ninertia = [0.01, 0.01, 0.01]\nposition = [0.8, 0.9, 0]\n[[joint]]\n\
             name = \"j\"\ntype = \"fixed\"\nbetween = [\"world\", \"b\"]\nat = [0.8, 1, 0]\naxis = [0, 0, 1]\nspan = 0.1\n\
             stiffness = {stiffness}\ndamping = 2e4\narm = 0.1\n[[readout]]\nname = \"F\"\ntype = \"joint_force\"\ntarget = \"j\"\n\
             [[readout]]\nname = \"I\"\ntype = \"imu\"\nbody = \"b\"\npoint = [0, 0, 0]\n"
        )
    };
    let stiff = folder.scene(&text("3e8"));
    let summary = folder.summary(&stiff, &["--precision", "f32"]);
    let reported = said(&summary, "at any time").unwrap_or_else(|| panic!("{summary}"));
    let words: Vec<&str> = reported.split_whitespace().collect();
    let some = words.iter().position(|word| *word == "about").unwrap();
    let size: f64 = words[some + 1].parse().unwrap();
    let trace = folder.trace("scene");
    let row = trace.header.iter().position(|name| name == "F.y").unwrap();
    let forces: Vec<f64> = trace.rows.iter().map(|row_of| row_of[row].parse().unwrap()).collect();
    let off = forces.iter().map(|force| (force - 3.0 * 9.81).abs()).fold(0.0, f64::max);
    assert!(off > size / 10.0 && off < 10.0 * size, "{off} {reported}");
    // Before a run, too; not of softer joints, nor in double precision.
    let checked = call(&["check", &stiff]).out;
    assert!(checked.contains("in f32 read-out `"), "{checked}");
    assert_eq!(said(&folder.summary(&stiff, &["--precision", "f64"]), "at any time"), None);
    let soft = folder.scene(&text("3e4"));
    assert_eq!(said(&folder.summary(&soft, &["--precision", "f32"]), "at any time"), None);
    assert!(!call(&["check", &soft]).out.contains("at any time"));
}

/// A mechanism of a millimetre is coarse in fixed point.
#[test]
fn small_mechanisms_are_told_of_in_fixed_point() {
    let folder = Folder::new();
    let text = |length: f64| {
        format!(
            "name = \"small\"\nduration = 1e-3\nstep = 1e-6\n[[body]]\nname = \"b\"\nmass = 1e-6\n\
             inertia = [1e-12, 1e-12, 1e-12]\nposition = [{length:?}, 0, 0]\n[[joint]]\nname = \"j\"\n\
             type = \"revolute\"\nbetween = [\"world\", \"b\"]\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
             stiffness = 1e2\nspan = {length:?}\n"
        )
    };
    for (length, reported) in [(1e-3, true), (1e-2, false)] {
        let scene = folder.scene(&text(length));
        let summary = folder.summary(&scene, &["--precision", "fixed"]);
        assert_eq!(said(&summary, "fixed resolves points to").is_some(), reported, "{summary}");
    }
}
