//! Directional derivatives over the functions of the standards.

mod host;

use dbd_fmu::Fmi;
use dbd_fmu::calls::{ERROR, OK};
use dbd_fmu::xml::model_description;
use dbd_plant::instance::{Blueprint, Settings};
use host::{scene, unpacked};

const BOTH: [Fmi; 2] = [Fmi::Two, Fmi::Three];

/// 2 kg on a spring of 200 N/m from a point of the ground that can be moved; an accelerometer, a force sensor.
const HUNG: &str = r#"
name = "hung"
duration = 1.0
step = "1 ms"
gravity = [0, -10, 0]
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, -1.1, 0]
[[tsda]]
name = "spring"
between = ["world", "weight"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 200.0
damping = 3.0
free_length = 1.0
[[input]]
name = "push"
type = "force"
body = "weight"
axis = [0, 1, 0]
[[input]]
name = "hook"
type = "anchor"
target = "spring"
axis = [0, 1, 0]
[[readout]]
name = "pull"
type = "tsda_force"
target = "spring"
[[readout]]
name = "imu"
type = "imu"
body = "weight"
"#;

#[test]
fn derivatives_are_those_of_the_scene() {
    for fmi in BOTH {
        for precision in ["f64", "f32"] {
            let settings = Settings { precision: Some(precision.into()), ..Settings::default() };
            let fmu = unpacked(Blueprint::new("hung.toml", HUNG), settings, fmi);
            let host = fmu.stepping();
            let of = ["pull", "imu.ay", "weight.y", "imu.ax"].map(|name| fmu.reference(name));
            let by = ["push", "hook", "hook.rate"].map(|name| fmu.reference(name));
            let near = |seed: &[f64], exact: [f64; 4]| {
                let found = host.derivative(&of, &by[..seed.len()], seed);
                let found = found.unwrap_or_else(|_| panic!("{}", host.said()));
                for (found, exact) in found.iter().zip(exact) {
                    assert!((found - exact).abs() < 1e-6 * exact.abs().max(1.0), "{found} {exact}");
                }
            };
            // Per newton; per metre; per metre a second; together.
            let all = || {
                near(&[1.0], [0.0, 0.5, 0.0, 0.0]);
                near(&[0.0, 1.0], [200.0, 100.0, 0.0, 0.0]);
                near(&[0.0, 0.0, 1.0], [3.0, 1.5, 0.0, 0.0]);
                near(&[-4.0, 0.5, 2.0], [106.0, 51.0, 0.0, 0.0]);
            };
            all();
            let before = host.everything();
            all();
            // A call changes nothing.
            assert!(host.everything() == before);
            host.run(0, 50, fmu.description.step);
            all();
            assert_eq!(host.derivative(&[], &[], &[]), Ok(Vec::new()));
            host.free();
        }
    }
}

/// Parameters are the present ones.
#[test]
fn derivatives_are_taken_where_the_plant_is() {
    for fmi in BOTH {
        let fmu = unpacked(Blueprint::new("hung.toml", HUNG), Settings::default(), fmi);
        let host = fmu.host();
        let (of, by) = ([fmu.reference("imu.ay")], [fmu.reference("push")]);
        let found = || host.derivative(&of, &by, &[1.0]);
        assert_eq!(found(), Err(ERROR));
        assert!(host.said().contains("not initialised yet"), "{}", host.said());
        assert_eq!(host.setup(0.0), OK);
        assert!((found().unwrap()[0] - 0.5).abs() < 1e-9);
        assert_eq!(host.set("body.weight.mass", 4.0), OK);
        assert!((found().unwrap()[0] - 0.25).abs() < 1e-9);
        assert_eq!(host.exit_initialization(), OK);
        assert!((found().unwrap()[0] - 0.25).abs() < 1e-9);
        let state = host.keep().unwrap();
        assert_eq!([host.reset(), host.initialize()], [OK; 2]);
        assert!((found().unwrap()[0] - 0.5).abs() < 1e-9);
        assert_eq!(host.go_back(state), OK);
        assert!((found().unwrap()[0] - 0.25).abs() < 1e-9);
        host.free();
    }
}

#[test]
fn what_is_no_pair_of_output_and_input_is_refused_in_words() {
    for fmi in BOTH {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let host = fmu.stepping();
        let [drive, angle, mass, time] =
            ["drive", "angle", "body.cart.mass", "time"].map(|name| fmu.reference(name));
        for (of, by, seed, says) in [
            (drive, drive, 1.0, "drive is not an output and cannot be an unknown"),
            (mass, drive, 1.0, "body.cart.mass is not an output"),
            (angle, angle, 1.0, "angle is not an input and cannot be a known"),
            (angle, mass, 1.0, "derivatives of outputs with respect to inputs"),
            (angle, time, 1.0, "time is not an input"),
            (angle, drive, f64::NAN, "seed NaN is not finite"),
            (70_000, drive, 1.0, "no variable with the value reference 70000"),
        ] {
            assert_eq!(host.derivative(&[of], &[by], &[seed]), Err(ERROR));
            assert!(host.said().contains(says), "{says}: {}", host.said());
        }
        let function = match fmi {
            Fmi::Two => "fmi2GetDirectionalDerivative: ",
            Fmi::Three => "fmi3GetDirectionalDerivative: ",
        };
        assert!(host.said().starts_with(function), "{}", host.said());
        assert_eq!(host.derivative(&[angle], &[drive], &[1.0]), Ok(vec![0.0]));
        host.free();
    }
}

#[test]
fn after_a_failed_step_there_are_none() {
    // A spring far too stiff for the step.
    let text = HUNG.replace("200.0", "1e9").replace("\"1 ms\"", "0.01");
    for fmi in BOTH {
        let fmu = unpacked(Blueprint::new("hung.toml", text.as_str()), Settings::default(), fmi);
        let host = fmu.stepping();
        let failed = (0..400).map(|n| host.step(f64::from(n) * 0.01, 0.01)).find(|s| *s != OK);
        assert_eq!(failed, Some(ERROR));
        let (of, by) = ([fmu.reference("pull")], [fmu.reference("push")]);
        assert_eq!(host.derivative(&of, &by, &[1.0]), Err(ERROR));
        assert!(host.said().contains("in step "), "{}", host.said());
        host.free();
    }
}

#[test]
fn the_model_description_says_so() {
    for (fmi, attribute) in [
        (Fmi::Two, " providesDirectionalDerivative=\"true\""),
        (Fmi::Three, " providesDirectionalDerivatives=\"true\""),
    ] {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        let xml = model_description(&fmu.description, fmi, &fmu.token);
        let kind = xml.lines().find(|line| line.contains("<CoSimulation ")).unwrap();
        assert!(kind.contains(attribute), "{kind}");
    }
}
