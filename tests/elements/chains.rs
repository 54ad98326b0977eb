//! Signal chains: sensors of joints and inputs with lag, delay and limits, the same in every precision and after a
//! snapshot.

use dbd_plant::instance::{Blueprint, Instance, LinearOptions, Settings};
use dbd_scene::Scene;

use crate::{instance, value};

/// A wheel of 0.02 kg·m² on a pivot along z that turns at 3 rad/s, with an input and a read-out of its angle.
fn wheel(input: &str, sensor: &str) -> String {
    format!(
        "name = \"wheel\"\nduration = 1\n[[body]]\nname = \"wheel\"\nmass = 1\ninertia = [0.02, 0.02, 0.02]\n\
         position = [0, 0, 0]\nangular_velocity = [0, 0, 3]\n\
         [[joint]]\nname = \"pivot\"\ntype = \"revolute\"\nbetween = [\"world\", \"wheel\"]\nat = [0, 0, 0]\n\
         axis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e5\n\
         [[input]]\nname = \"motor\"\ntype = \"joint_torque\"\ntarget = \"pivot\"\n{input}\n\
         [[readout]]\nname = \"angle\"\ntype = \"joint_angle\"\ntarget = \"pivot\"\n{sensor}\n\
         [[readout]]\nname = \"speed\"\ntype = \"joint_rate\"\ntarget = \"pivot\"\n"
    )
}

const EFFORT: &str = "[[readout]]\nname = \"effort\"\ntype = \"interaction\"\ntarget = \"motor\"\nquantity = \"effort\"\n";

/// An encoder of 1024 counts sampled every 2 ms, three samples late: every value is the truth of 6 ms before, rounded.
#[test]
fn an_encoder_shows_the_rounded_angle_of_some_samples_ago() {
    let sensor = "sensor = { counts = 1024, period = \"2 ms\", delay = 3, bias = 0.1 }";
    for precision in ["f64", "f32", "fixed"] {
        let mut run = instance(&wheel("", sensor), 1e-3, precision);
        let count = std::f64::consts::TAU / 1024.0;
        let mut truths = vec![value(&run, "angle")];
        // Before the first step, too.
        assert!((value(&run, "angle.sensor") - 16.0 * count).abs() < 1e-6, "{precision}");
        for step in 1..=3000 {
            run.advance(1).unwrap();
            truths.push(value(&run, "angle"));
            let sample = (step / 2 * 2_usize).saturating_sub(6);
            let expected = ((truths[sample] + 0.1) / count).round() * count;
            let shown = value(&run, "angle.sensor");
            // At a boundary of two counts rounding of the truth may decide.
            let near = if precision == "f64" { 1e-9 } else { 1e-5 };
            let at_boundary = (((truths[sample] + 0.1) / count).fract().abs() - 0.5).abs() < 1e-2;
            assert!(
                (shown - expected).abs() < near || at_boundary,
                "{precision} {step}: {shown} {expected}"
            );
        }
        // It counts revolutions, too.
        assert!(truths[3000] > 8.9, "{}", truths[3000]);
    }
}

/// Noise and walk have their deviations, seeds and names their own numbers, and the mechanism does not feel a sensor.
#[test]
fn noise_and_walk_have_their_deviations() {
    let errors = |sensor: &str| {
        let mut run = instance(&wheel("", sensor), 1e-3, "f64");
        let errors: Vec<f64> = (0..20_000)
            .map(|_| {
                run.advance(1).unwrap();
                value(&run, "angle.sensor") - value(&run, "angle")
            })
            .collect();
        (errors, value(&run, "angle"))
    };
    let square = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64;
    let (noise, end) = errors("sensor = { noise = 0.02, seed = 5 }");
    assert!((square(&noise).sqrt() / 0.02 - 1.0).abs() < 0.02, "{}", square(&noise).sqrt());
    let pairs: f64 = noise.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / 20_000.0;
    assert!(pairs.abs() < 0.02 * 0.02 * 0.03, "{pairs}");
    let (walk, other) = errors("sensor = { walk = 0.5, seed = 5 }");
    assert_eq!(end, other);
    let steps: Vec<f64> = walk.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(
        (square(&steps).sqrt() / (0.5 * 1e-3_f64.sqrt()) - 1.0).abs() < 0.02,
        "{}",
        square(&steps)
    );
    assert_eq!(errors("sensor = { noise = 0.02, seed = 5 }").0, noise);
    assert_ne!(errors("sensor = { noise = 0.02, seed = 6 }").0, noise);
    let renamed = wheel("", "sensor = { noise = 0.02, seed = 5 }").replace("\"angle\"", "\"phi\"");
    let mut run = instance(&renamed, 1e-3, "f64");
    run.advance(1).unwrap();
    assert_ne!(value(&run, "phi.sensor") - value(&run, "phi"), noise[0]);
    let (limited, _) = errors("sensor = { noise = 0.5, range = [-0.25, 0.25], resolution = 0.5 }");
    assert!(limited.len() == 20_000);
}

/// A command acts one step after it is set, and `delay` samples later; limits and rate limit hold; a lag has its
/// exponential; the momentum that the wheel gets is the effort's.
#[test]
fn a_command_is_delayed_limited_and_lags() {
    let h = 1e-3;
    for precision in ["f64", "f32", "fixed"] {
        let run = |chain: &str| {
            let mut run = instance(&(wheel(chain, "") + EFFORT), h, precision);
            run.advance(10).unwrap();
            let motor = run.input("motor").unwrap();
            run.set_input(motor, 2.0).unwrap();
            let before = value(&run, "speed");
            let efforts: Vec<f64> = (0..200)
                .map(|_| {
                    run.advance(1).unwrap();
                    value(&run, "effort")
                })
                .collect();
            let gained = (value(&run, "speed") - before) * 0.02;
            (efforts, gained)
        };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-5;
        let (efforts, gained) = run("delay = 5");
        let first = efforts.iter().position(|effort| *effort != 0.0);
        assert_eq!((first, efforts[199]), (Some(5), 2.0), "{precision}");
        // Set after step 10, it acts from the end of step 16 on: all but the first six steps.
        assert!((gained - 2.0 * h * 194.0).abs() < 1.1 * 2.0 * h, "{precision} {gained}");
        let (efforts, _) = run("delay = 2\nperiod = \"10 ms\"");
        let first = efforts.iter().position(|effort| *effort != 0.0);
        // Samples at 10 and 20 ms hold the old command, the next holds the one set at 10 ms.
        assert!(first.is_some_and(|first| (19..=30).contains(&first)), "{precision} {first:?}");
        let (efforts, _) = run("limits = [-1, 1.5]");
        assert_eq!(efforts[199], 1.5);
        let (efforts, _) = run("rate_limit = 50");
        assert!(near(efforts[9], 0.5) && near(efforts[199], 2.0), "{precision} {}", efforts[9]);
        let (efforts, _) = run("lag = \"20 ms\"");
        let expected = 2.0 * (1.0 - (-1.0_f64).exp());
        assert!((efforts[19] - expected).abs() < 1e-3, "{precision} {} {expected}", efforts[19]);
    }
}

/// Saved in the middle of a delay, in noise and in a lag, a run continues bit for bit; it is the run of the whole.
#[test]
fn a_snapshot_keeps_samples_noise_and_lag() {
    let text = wheel(
        "lag = 0.01\ndelay = 4\nvalue = 1",
        "sensor = { noise = 0.1, walk = 0.1, delay = 7, period = 0.003, seed = 1 }",
    ) + EFFORT;
    for precision in ["f64", "f32", "fixed"] {
        let mut one = instance(&text, 1e-3, precision);
        one.advance(37).unwrap();
        one.set_input(0, -2.0).unwrap();
        one.advance(2).unwrap();
        let saved = one.save().unwrap();
        let mut other = instance(&text, 1e-3, precision);
        other.restore(&saved).unwrap();
        for _ in 0..100 {
            one.advance(1).unwrap();
            other.advance(1).unwrap();
            for name in ["angle", "angle.sensor", "effort"] {
                assert_eq!(value(&one, name).to_bits(), value(&other, name).to_bits(), "{name}");
            }
        }
        assert_eq!(one.hash(), other.hash());
        let mut whole = instance(&text, 1e-3, precision);
        whole.advance(37).unwrap();
        whole.set_input(0, -2.0).unwrap();
        whole.advance(102).unwrap();
        assert_eq!(whole.hash(), one.hash());
    }
}

/// Two free bodies: an actuator between them gives both the opposite angular momentum.
#[test]
fn an_actuator_acts_on_both_bodies() {
    let text = "name = \"pair\"\nduration = 1\n[[body]]\nname = \"a\"\nmass = 1\ninertia = [0.02, 0.02, 0.02]\n\
        position = [0, 0, 0]\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\n\
        [[joint]]\nname = \"axle\"\ntype = \"cylindrical\"\nbetween = [\"a\", \"b\"]\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
        span = 0.1\noffset = 0.05\nstiffness = 1e5\n\
        [[input]]\nname = \"twist\"\ntype = \"joint_torque\"\ntarget = \"axle\"\nlag = 0.01\nvalue = 0.2\n\
        [[input]]\nname = \"push\"\ntype = \"joint_force\"\ntarget = \"axle\"\nlimits = [-1, 1]\nvalue = 3\n";
    let mut run = instance(text, 1e-4, "f64");
    run.advance_to(0.5).unwrap();
    let bodies = run.plant().state().bodies;
    let [a, b] = [0, 1].map(|row| (bodies[row].angular_velocity.z, bodies[row].velocity.z));
    assert!((0.02 * a.0 + 0.01 * b.0).abs() < 1e-9 && (b.0 - 10.0).abs() < 0.1, "{a:?} {b:?}");
    // A force of 1 N on each for half a second.
    assert!((a.1 + b.1).abs() < 1e-9 && (b.1 - 0.5).abs() < 1e-3, "{a:?} {b:?}");
}

#[test]
fn chains_that_cannot_be_are_refused() {
    for (input, sensor, says) in [
        ("delay = 17", "", "whole number from 0 to 16"),
        ("delay = 1.5", "", "whole number from 0 to 16"),
        ("limits = [2, 1]", "", "smaller bound first"),
        ("rate_limit = 0", "", "rate_limit"),
        ("lag = -1", "", "lag"),
        ("", "sensor = { counts = 100, resolution = 0.1 }", "contradicts"),
        ("", "sensor = { noise = -1 }", "noise"),
        ("", "sensor = { nose = 1 }", "noise"),
        ("", "sensor = { delay = 99 }", "whole number"),
        ("", "sensor = { range = [1, 1] }", "smaller bound first"),
    ] {
        let error = Scene::parse(&wheel(input, sensor), "wheel.toml").unwrap_err().to_string();
        let help = format!("{:?}", Scene::parse(&wheel(input, sensor), "wheel.toml").unwrap_err());
        assert!(error.contains(says) || help.contains(says), "{input}{sensor}: {error} {help}");
    }
    let force = wheel("", "").replace("\"joint_angle\"", "\"joint_force\"");
    let error = Scene::parse(
        &force.replace("target = \"pivot\"\n\n", "target = \"pivot\"\nsensor = {}\n"),
        "w",
    );
    assert!(error.is_err());
    // A chain that steps must advance is refused where steps go back.
    let run = |scheme: &str, text: &str| {
        let settings =
            Settings { scheme: Some(scheme.into()), step: Some(1e-3), ..Settings::default() };
        Instance::new(Blueprint::new("wheel.toml", text), settings)
    };
    assert!(run("pefrl", &wheel("lag = 1", "")).is_err());
    assert!(run("pefrl", &wheel("", "sensor = {}")).is_err());
    // Linearisation leaves sensors out, and refuses inputs with a state of their own.
    let linear = |text: &str, outputs: Option<Vec<String>>| {
        let run = instance(&text.replace("angular_velocity = [0, 0, 3]", ""), 1e-4, "f64");
        run.linearise(&LinearOptions { outputs, ..LinearOptions::default() })
    };
    let plain = linear(&wheel("", "sensor = { noise = 1 }"), None).unwrap();
    assert_eq!(plain.outputs, ["angle", "speed"]);
    let asked = Some(vec!["angle.sensor".to_owned()]);
    assert!(
        linear(&wheel("", "sensor = { noise = 1 }"), asked)
            .unwrap_err()
            .to_string()
            .contains("sensor")
    );
    assert!(linear(&wheel("lag = 1", ""), None).unwrap_err().to_string().contains("signal chain"));
}
