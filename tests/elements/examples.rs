//! The scenes of `docs/examples` that use these elements do what they say.

use dbd_tests::results::path;

use crate::{instance, value};

fn example(name: &str) -> String {
    std::fs::read_to_string(path(&format!("docs/examples/{name}/{name}.toml"))).unwrap()
}

#[test]
fn a_gate_opens_to_its_stop_and_closes() {
    for precision in ["f64", "f32", "fixed"] {
        let mut gate = instance(&example("gate-opener"), 2e-3, precision);
        gate.advance_to(4.0).unwrap();
        let degrees = |gate: &_| value(gate, "angle").to_degrees();
        assert!((degrees(&gate) - 37.7).abs() < 1.0, "{precision}: {}", degrees(&gate));
        gate.advance_to(14.2).unwrap();
        assert!(value(&gate, "depth") > 1e-3, "{precision}: the stop is not met");
        gate.advance_to(16.0).unwrap();
        assert!((degrees(&gate) - 90.0).abs() < 0.3, "{precision}: {}", degrees(&gate));
        gate.advance_to(32.0).unwrap();
        assert!(degrees(&gate).abs() < 0.5, "{precision}: {}", degrees(&gate));
    }
}

#[test]
fn a_hand_grasps_a_ball_lifts_it_and_lets_it_fall() {
    for precision in ["f64", "f32", "fixed"] {
        let mut hand = instance(&example("grasp"), 50e-6, precision);
        hand.advance_to(0.5).unwrap();
        let [left, right] = ["left", "right"].map(|name| value(&hand, name));
        assert!(left < -0.08 && (left + right).abs() < 0.01, "{precision}: {left} {right}");
        hand.advance_to(1.2).unwrap();
        let held = value(&hand, "ball.z");
        assert!((held - 0.12).abs() < 5e-4, "{precision}: {held}");
        // Both pads squeeze alike with half of the torque, and the ball does not creep.
        hand.advance_to(1.45).unwrap();
        let squeeze = value(&hand, "squeeze");
        assert!((3.5..4.7).contains(&squeeze), "{precision}: {squeeze}");
        assert!((value(&hand, "ball.z") - held).abs() < 2e-6, "{precision}");
        hand.advance_to(1.65).unwrap();
        assert!(value(&hand, "ball.z") < 0.08 && value(&hand, "squeeze") == 0.0, "{precision}");
    }
}

#[test]
fn a_trolley_goes_as_far_as_its_table_says() {
    let mut crane = instance(&example("crane"), 1e-3, "f64");
    let mut widest: f64 = 0.0;
    for tenth in 1..=200 {
        crane.advance_to(f64::from(tenth) * 0.1).unwrap();
        let swing = value(&crane, "load.x") - value(&crane, "trolley.x");
        widest = widest.max(swing.abs());
    }
    // The area under the table: 6 m, less what the load pulls it about.
    let place = value(&crane, "trolley.x");
    assert!((place - 6.0).abs() < 0.1, "{place}");
    // The load swings by some a·l/g twice over, with 2/3 m/s² on 6 m.
    assert!((0.3..1.0).contains(&widest), "{widest}");
}

#[test]
fn a_wheel_leaves_the_plate_and_the_strut_meets_its_rubber() {
    for precision in ["f64", "f32"] {
        let mut car = instance(&example("quarter-car"), 2e-4, precision);
        let (mut off, mut hardest) = (0, 0.0_f64);
        for ms in 1..=3000 {
            car.advance_to(f64::from(ms) * 1e-3).unwrap();
            off += u32::from(value(&car, "tyre_force") == 0.0);
            hardest = hardest.min(value(&car, "bump_stop_force"));
        }
        assert!((20..60).contains(&off), "{precision}: {off} ms without contact");
        assert!((-12e3..-5e3).contains(&hardest), "{precision}: {hardest} N");
        // At rest under its weight: 372 kg.
        let weight = value(&car, "tyre_force");
        assert!((weight + 372.0 * 9.81).abs() < 5.0, "{precision}: {weight} N");
    }
}

/// Attitude and height by proportional and differential feedback, as a flight controller has it.
#[test]
fn a_quadrotor_carries_its_load() {
    for precision in ["f64", "f32"] {
        let mut craft = instance(&example("quadrotor"), 1e-3, precision);
        let input = |name: &str| craft.input(name).unwrap();
        let [one, two, three, four] = ["thrust_1", "thrust_2", "thrust_3", "thrust_4"].map(input);
        let mut swing: f64 = 0.0;
        for _ in 0..6000 {
            let of = |name: &str| value(&craft, name);
            // Small angles: twice the vector part of the quaternion.
            let tilt = |name: &str, rate: &str| -6.0 * 2.0 * of(name) - 1.2 * of(rate);
            let [roll, pitch] =
                [tilt("airframe.qx", "airframe.wx"), tilt("airframe.qy", "airframe.wy")];
            // Down is positive.
            let lift = 2.943 + 0.8 * of("airframe.z") + 1.0 * of("airframe.vz");
            swing = swing.max((of("load.x") - of("airframe.x")).abs());
            // Front right, rear left, front left, rear right.
            for (rotor, thrust) in [
                (one, lift - roll + pitch),
                (two, lift + roll - pitch),
                (three, lift + roll + pitch),
                (four, lift - roll - pitch),
            ] {
                craft.set_input(rotor, thrust).unwrap();
            }
            craft.advance(1).unwrap();
        }
        let of = |name: &str| value(&craft, name);
        assert!((0.09..0.15).contains(&swing), "{precision}: {swing}");
        assert!(of("airframe.z").abs() < 0.02, "{precision}: {}", of("airframe.z"));
        let tilt = of("airframe.qx").abs().max(of("airframe.qy").abs());
        assert!(tilt < 0.02, "{precision}: {tilt}");
        // The rope carries 200 g.
        assert!((of("rope_force") - 1.96).abs() < 0.1, "{precision}: {}", of("rope_force"));
    }
}

/// A push tips it onto its front bumper, on which it comes to rest.
#[test]
fn a_robot_on_two_wheels_falls_without_its_controller() {
    for precision in ["f64", "f32", "fixed"] {
        let mut robot = instance(&example("balance-robot"), 1e-3, precision);
        robot.advance_to(1.0).unwrap();
        assert!(value(&robot, "pitch").abs() < 1e-3, "{precision}: not upright before the push");
        robot.advance_to(10.0).unwrap();
        let [pitch, rate] = ["pitch", "pitch_rate"].map(|name| value(&robot, name));
        assert!(
            (pitch.to_degrees() - 20.6).abs() < 0.5 && rate.abs() < 1e-3,
            "{precision}: {pitch}"
        );
    }
}
