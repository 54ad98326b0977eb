//! Drives: rotor, gear, play, winding, servos, against closed forms and references of their own.

use dbd_plant::PlantError;
use dbd_plant::instance::{Blueprint, Instance, LinearOptions, Settings};
use dbd_scene::Scene;
use dbd_study::modes::ModesError;

use crate::{instance, reference, value};

const STEPS: [f64; 3] = [500e-6, 250e-6, 125e-6];

/// A wheel of 0.02 kg·m² on a pivot along z, and a drive.
pub(crate) fn wheel(drive: &str, more: &str) -> String {
    format!(
        r#"
        name = "wheel"
        duration = 1
        {more}
        [[body]]
        name = "wheel"
        mass = 1
        inertia = [0.02, 0.02, 0.02]
        position = [0, 0, 0]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "wheel"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        span = 0.1
        stiffness = 1e5
        [[input]]
        name = "motor"
        type = "drive"
        target = "pivot"
        {drive}
        [[readout]]
        name = "angle"
        type = "joint_angle"
        target = "pivot"
        [[readout]]
        name = "speed"
        type = "joint_rate"
        target = "pivot"
        [[readout]]
        name = "effort"
        type = "interaction"
        target = "motor"
        quantity = "effort"
        "#
    )
}

/// Read-outs of a quantity of the drive.
fn shown(quantity: &str) -> String {
    format!(
        "[[readout]]\nname = \"{quantity}\"\ntype = \"interaction\"\ntarget = \"motor\"\nquantity = \"{quantity}\"\n"
    )
}

/// Runs to `time` \[s\]; all of the read-outs at every millisecond.
fn run(instance: &mut Instance, time: f64, names: &[&str]) -> Vec<Vec<f64>> {
    let rows = (time * 1e3).round() as u32;
    let row = |ms| {
        instance.advance_to(f64::from(ms) * 1e-3).unwrap();
        names.iter().map(|name| value(instance, name)).collect()
    };
    (1..=rows).map(row).collect()
}

/// The largest difference of a column.
fn off<const N: usize>(found: &[Vec<f64>], known: &[[f64; N]], [column, state]: [usize; 2]) -> f64 {
    let pairs = found.iter().zip(known);
    pairs.fold(0.0, |most: f64, (a, b)| most.max((a[column] - b[state]).abs()))
}

fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// Period of a pendulum that is let go at `amplitude` \[rad\]: zero crossings.
pub(crate) fn period(amplitude: f64, drive: &str, step: f64) -> f64 {
    let text = format!(
        r#"
        name = "pendulum"
        duration = 1
        gravity = [0, 0, -9.81]
        [[body]]
        name = "bob"
        mass = 1
        inertia = [0.02, 0.02, 0.02]
        position = [{}, 0, {}]
        orientation = {{ axis = [0, 1, 0], angle = {amplitude} }}
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "bob"]
        at = [0, 0, 0]
        axis = [0, 1, 0]
        span = 0.1
        stiffness = 1e6
        {drive}
        [[readout]]
        name = "angle"
        type = "joint_angle"
        target = "pivot"
        "#,
        -0.25 * amplitude.sin(),
        -0.25 * amplitude.cos(),
    );
    let mut instance = instance(&text, step, "f64");
    let angle = instance.output("angle").unwrap();
    let mut crossings = Vec::new();
    let mut last = amplitude;
    while crossings.len() < 3 {
        instance.advance(1).unwrap();
        let now = instance.value(angle) + amplitude;
        if last < 0.0 && now >= 0.0 {
            crossings.push(instance.time() - instance.step_size() * now / (now - last));
        }
        last = now;
    }
    (crossings[2] - crossings[0]) / 2.0
}

/// The rotor of the pendulum.
pub(crate) const ROTOR: &str = r#"[[input]]
        name = "motor"
        type = "drive"
        target = "pivot"
        mode = "torque"
        rotor = "2e-5 kg*m^2"
        ratio = 50
        gear = { stiffness = "100 kN*m/rad" }"#;

/// By the inertia of rotor and body together and the complete elliptic integral, a stiff gear.
#[test]
fn a_rotor_makes_a_pendulum_slow() {
    for (drive, small, large) in [("", 1.153_118_2, 1.531_426_3), (ROTOR, 1.461_351_9, 1.940_783_3)]
    {
        for (amplitude, exact) in [(0.1, small), (2.0, large)] {
            let found = period(amplitude, drive, 50e-6);
            assert!((found - exact).abs() < 1e-4, "{amplitude} {drive}: {found}, not {exact}");
        }
    }
}

/// Voltage, winding, rotor, gear and load are linear: order 2 to the solution.
#[test]
fn a_winding_with_rotor_and_gear_is_of_second_order() {
    let drive = r#"
        mode = "voltage"
        winding = { resistance = 1.2, inductance = "0.8 mH", constant = 0.05 }
        rotor = "2e-5 kg*m^2"
        ratio = 50
        gear = { stiffness = "200 N*m/rad", damping = 0.5 }
        value = "12 V"
        "#;
    let text = wheel(drive, "") + &shown("ahead") + &shown("rate");
    let (j, m, k, c, constant, resistance) = (0.02, 0.05, 200.0, 0.5, 2.5, 1.2);
    let inductance = 0.8e-3;
    let known = reference([0.0; 5], 0.15, |&[_, w, ahead, v, current], _| {
        let pull = k * ahead + c * (v - w);
        let torque = constant * current;
        let rise = (12.0 - resistance * current - constant * v) / inductance;
        [w, pull / j, v - w, (torque - pull) / m, rise]
    });
    let names = ["angle", "speed", "ahead", "rate"];
    let errors = STEPS.map(|step| {
        let found = run(&mut instance(&text, step, "f64"), 0.15, &names);
        [0, 2, 3].map(|i| off(&found, &known, [i, i]))
    });
    for i in 0..3 {
        let of = errors.map(|errors| errors[i]);
        assert!((1.85..2.2).contains(&order(&of)), "{}: {of:?}", names[i]);
    }
    assert!(errors[2][0] < 1e-6, "{errors:?}");
    // The current as torque at the output.
    let mut fine = instance(&text, STEPS[2], "f64");
    let effort = run(&mut fine, 0.15, &["effort"]);
    let torques: Vec<[f64; 1]> = known.iter().map(|row| [constant * row[4]]).collect();
    let effort_off = off(&effort, &torques, [0, 0]);
    assert!(effort_off < 2e-2, "{effort_off}");
}

/// Play: the rotor goes to and fro between the flanks. A reference of a smooth kind between them.
#[test]
fn play_lets_the_rotor_go_free() {
    let drive = r#"
        mode = "torque"
        rotor = "0.01 kg*m^2"
        gear = { stiffness = "300 N*m/rad", damping = 0.3, play = "2 deg" }
        sine = { amplitude = 1, frequency = 4 }
        "#;
    let text = wheel(drive, "") + &shown("ahead") + &shown("load");
    let half = 1_f64.to_radians();
    let known = reference([0.0; 4], 0.5, |&[_, w, ahead, v], t| {
        let beyond = if ahead > half {
            ahead - half
        } else if ahead < -half {
            ahead + half
        } else {
            0.0
        };
        let mut pull = 300.0 * beyond;
        if beyond != 0.0 {
            let damped = pull + 0.3 * (v - w);
            // The teeth never pull.
            pull = if beyond > 0.0 { damped.max(0.0) } else { damped.min(0.0) };
        }
        let torque = (8.0 * std::f64::consts::PI * t).sin();
        [w, pull / 0.02, v - w, (torque - pull) / 0.01]
    });
    let names = ["angle", "speed", "ahead", "load"];
    let errors = [100e-6, 25e-6].map(|step| {
        let found = run(&mut instance(&text, step, "f64"), 0.5, &names);
        assert!(found.iter().any(|row| row[3] == 0.0) && found.iter().any(|row| row[3] > 0.5));
        [off(&found, &known, [0, 0]), off(&found, &known, [2, 2])]
    });
    // At a flank the damper sets in by a jump: of first order there.
    assert!(errors[0][0] < 1e-4 && errors[1][0] < 4e-5, "{errors:?}");
    assert!(errors[0][1] < 3e-4 && errors[1][1] < 1.2e-4, "{errors:?}");
}

/// A servo of position with a bound: it holds for the sum of both gains.
#[test]
fn a_servo_gives_no_more_than_its_bound() {
    for rotor in ["", "rotor = 0.004\ngear = { stiffness = \"2 kN*m/rad\", damping = 2 }"] {
        let drive = format!(
            "mode = \"position\"\nkp = 40\nkd = 1.2\nmost = \"0.8 N*m\"\nvalue = \"60 deg\"\n{rotor}"
        );
        let text = wheel(&drive, "");
        let target = 60_f64.to_radians();
        let effort =
            |place: f64, rate: f64| (40.0 * (target - place) - 1.2 * rate).clamp(-0.8, 0.8);
        let known = reference([0.0; 4], 2.0, |&[x, w, ahead, v], _| {
            if rotor.is_empty() {
                return [w, effort(x, w) / 0.02, 0.0, 0.0];
            }
            let pull = 2e3 * ahead + 2.0 * (v - w);
            [w, pull / 0.02, v - w, (effort(x + ahead, v) - pull) / 0.004]
        });
        let names = ["angle", "speed", "effort"];
        let mut errors = Vec::new();
        for step in STEPS {
            let found = run(&mut instance(&text, step, "f64"), 2.0, &names);
            let most = found.iter().fold(0.0, |most: f64, row| most.max(row[2].abs()));
            assert!(most <= 0.8 * (1.0 + 1e-12), "{most}");
            errors.push(off(&found, &known, [0, 0]));
            let last = found.last().unwrap();
            assert!((last[0] - target).abs() < 1e-4, "{last:?}");
        }
        assert!(errors[2] < 1e-4, "{rotor}: {errors:?}");
    }
}

/// A strong servo of velocity limits no step.
#[test]
fn a_strong_servo_of_velocity_limits_no_step() {
    let rotors = ["", "rotor = 0.02\ngear = { stiffness = \"200 N*m/rad\", damping = 50 }"];
    for (kd, rotor) in [1.0, 1e3, 1e6].into_iter().zip([rotors, rotors, rotors].concat()) {
        let drive = format!("mode = \"velocity\"\nkd = {kd}\nvalue = \"3 rad/s\"\n{rotor}");
        for precision in ["f64", "f32", "fixed"] {
            let mut instance = instance(&wheel(&drive, ""), 500e-6, precision);
            instance.advance_to(1.0).unwrap();
            let speed = value(&instance, "speed");
            assert!((speed - 3.0).abs() < 2e-4, "{kd} {rotor} {precision}: {speed}");
        }
    }
}

/// Not driven, neither gear nor play makes energy, in any precision; it is kept to the order of the step.
#[test]
fn a_gear_makes_no_energy() {
    for (play, damping) in [(0.0, 0.0), (0.05, 0.0), (0.05, 0.2)] {
        let drive = format!(
            "mode = \"torque\"\nrotor = 0.01\ngear = {{ stiffness = 300, damping = {damping}, play = {play} }}"
        );
        let start = "[[load]]\nbody = \"wheel\"\ntorque = [0, 0, 2]\nuntil = 0.1\n";
        for (precision, near) in [("f64", 1e-9), ("f32", 2e-5), ("fixed", 2e-5)] {
            let mut instance = instance(&(wheel(&drive, "") + start), 100e-6, precision);
            instance.advance_to(0.1).unwrap();
            let given = value(&instance, "energy.total");
            let mut most = given;
            for ms in 101..2000 {
                instance.advance_to(f64::from(ms) * 1e-3).unwrap();
                let now = value(&instance, "energy.total");
                assert!(
                    now < most * (1.0 + near) + 2e-3 * given,
                    "{play} {precision}: {now} {most}"
                );
                most = most.min(now).max(given * 1e-3);
            }
            let left = value(&instance, "energy.total") / given;
            if damping == 0.0 {
                assert!((left - 1.0).abs() < 2e-3, "{play} {damping} {precision}: {left}");
            } else {
                assert!(left < 0.9999, "{play} {damping} {precision}: {left}");
            }
        }
    }
}

/// In single precision many turns leave a gear its digits.
#[test]
fn many_turns_leave_a_gear_its_digits() {
    let drive = "mode = \"velocity\"\nkd = 5\nvalue = \"200 rad/s\"\nrotor = 0.02\n\
                 gear = { stiffness = \"2 kN*m/rad\", damping = 1 }";
    let text = wheel(drive, "") + &shown("load");
    let mut noise = Vec::new();
    for _ in 0..2 {
        let mut instance = instance(&text, 100e-6, "f32");
        instance.advance_to(20.0).unwrap();
        let turned = value(&instance, "angle");
        assert!((turned - 4000.0).abs() < 60.0, "{turned}");
        let load = run_on(&mut instance, 1000, "load");
        noise.push(load);
    }
    // One digit of 4,000 rad would be 0.5 N·m.
    assert!(noise[0] < 0.02, "{noise:?}");
    assert_eq!(noise[0].to_bits(), noise[1].to_bits());
}

/// The largest of a read-out over so many steps.
fn run_on(instance: &mut Instance, steps: u32, name: &str) -> f64 {
    let output = instance.output(name).unwrap();
    let mut most: f64 = 0.0;
    for _ in 0..steps {
        instance.advance(1).unwrap();
        most = most.max(instance.value(output).abs());
    }
    most
}

#[test]
fn a_snapshot_in_the_middle_goes_on_bit_for_bit_and_an_input_costs_no_evaluation() {
    let drive = r#"
        mode = "voltage"
        winding = { resistance = 1.2, inductance = "0.8 mH", constant = 0.05, most_current = 4 }
        rotor = "2e-5 kg*m^2"
        ratio = 50
        gear = { stiffness = "200 N*m/rad", damping = 0.5, play = "0.2 deg" }
        "#;
    for precision in ["f64", "f32", "fixed"] {
        let mut one = instance(&wheel(drive, ""), 100e-6, precision);
        let motor = one.input("motor").unwrap();
        let controlled = |instance: &mut Instance, steps: u32| {
            for step in 0..steps {
                let volts = 12.0 * (0.02 * f64::from(step)).sin();
                instance.set_input(motor, volts).unwrap();
                instance.advance(1).unwrap();
            }
        };
        controlled(&mut one, 1000);
        // One of a step, one at t = 0.
        assert_eq!(one.plant().evaluations(), 1001, "{precision}");
        let saved = one.save().unwrap();
        let mut other = instance(&wheel(drive, ""), 100e-6, precision);
        other.restore(&saved).unwrap();
        controlled(&mut one, 500);
        controlled(&mut other, 500);
        assert_eq!(one.hash(), other.hash(), "{precision}");
        assert_eq!(one.plant().status(), Ok(()));
    }
}

/// A drive along a slide: a screw; in the plane as in space.
#[test]
fn a_screw_moves_a_slide_in_plane_and_space() {
    let slide = |planar: bool| {
        format!(
            r#"
            name = "slide"
            duration = 1
            planar = {planar}
            [[body]]
            name = "table"
            mass = 4
            inertia = [0.1, 0.1, 0.1]
            position = [0, 0, 0]
            [[joint]]
            name = "rail"
            type = "translational"
            between = ["world", "table"]
            at = [0, 0, 0]
            axis = [1, 0, 0]
            reference = [0, 1, 0]
            span = 0.2
            gauge = 0.2
            offset = 0.05
            stiffness = 1e6
            [[input]]
            name = "screw"
            type = "drive"
            target = "rail"
            mode = "velocity"
            kd = "3 kN*s/m"
            rotor = "3e-5 kg*m^2"
            ratio = "1 rev/(5 mm)"
            gear = {{ stiffness = "5 N/um", damping = 200 }}
            table = [[0, 0], [0.2, 0.1], [0.6, 0.1], [0.8, 0]]
            interpolate = "linear"
            "#
        )
    };
    let places = [false, true].map(|planar| {
        let mut instance = instance(&slide(planar), 100e-6, "f64");
        instance.advance_to(1.0).unwrap();
        value(&instance, "table.x")
    });
    // The area below the table; the servo lags behind by the mass over its damping.
    assert!((places[0] - 0.06).abs() < 2e-3, "{places:?}");
    assert!((places[0] - places[1]).abs() < 1e-9, "{places:?}");
}

#[test]
fn schemes_without_passes_over_dampers_refuse_a_rotor() {
    let drive = "mode = \"torque\"\nrotor = 0.01\ngear = { stiffness = 300 }";
    for (scheme, damping) in [
        ("pefrl", None),
        ("rk4", None),
        ("generalized-alpha", None),
        ("leapfrog", Some("explicit")),
        ("semi-implicit-euler", None),
    ] {
        let settings = Settings {
            step: Some(1e-4),
            scheme: Some(scheme.to_owned()),
            damping: damping.map(str::to_owned),
            ..Settings::default()
        };
        // Before anything is written, too.
        let scene = Scene::parse(&wheel(drive, ""), "drives.toml").unwrap();
        let refused = dbd_plant::plant::check(&scene, &settings.method().unwrap(), 1e-4);
        assert!(
            matches!(refused, Err(PlantError::Memory { law: "hinge-drive", .. })),
            "{refused:?}"
        );
        let refused = Instance::new(Blueprint::new("drives.toml", wheel(drive, "")), settings);
        let Err(error) = refused else { panic!("{scheme} takes a rotor") };
        assert!(error.to_string().contains("`hinge-drive`"), "{scheme}: {error}");
    }
    let settings = Settings {
        step: Some(1e-4),
        damping: Some("joint-wise".to_owned()),
        ..Settings::default()
    };
    let joint_wise = Instance::new(Blueprint::new("drives.toml", wheel(drive, "")), settings);
    joint_wise.unwrap().advance(100).unwrap();
}

/// A precision without laws is refused by `check`, before anything is written.
#[test]
fn precisions_for_comparison_have_no_laws() {
    let drive = "mode = \"velocity\"\nkd = 1";
    let scene = Scene::parse(&wheel(drive, ""), "drives.toml").unwrap();
    let method = |precision: &str| {
        let precision = Some(precision.to_owned());
        Settings { precision, ..Settings::default() }.method().unwrap()
    };
    for precision in ["f64", "f32", "fixed"] {
        dbd_plant::plant::check(&scene, &method(precision), 1e-4).unwrap();
    }
    let refused = dbd_plant::plant::check(&scene, &method("f32-micromath"), 1e-4);
    assert!(matches!(refused, Err(PlantError::Laws { .. })), "{refused:?}");
}

/// What looks at the bodies alone refuses a rotor; a servo without one it takes as the spring and damper that it is.
#[test]
fn modes_and_linear_systems_refuse_a_rotor() {
    let with = |more: &str| {
        let drive = format!("mode = \"position\"\nkp = 40\nkd = 0.1\n{more}");
        instance(&wheel(&drive, ""), 1e-4, "f64")
    };
    let modes_of = |instance: &Instance| {
        let plant = instance.plant();
        dbd_study::modes::modes(plant.model(), &plant.state())
    };
    let geared = with("rotor = 0.01\ngear = { stiffness = 300 }");
    assert!(matches!(modes_of(&geared), Err(ModesError::Rotor { law: "hinge-drive" })));
    let refused = geared.linearise(&LinearOptions::default()).unwrap_err().to_string();
    assert!(refused.contains("`hinge-drive`"), "{refused}");
    let direct = with("");
    let slowest = modes_of(&direct).unwrap().frequencies[0];
    let exact = (40.0_f64 / 0.02).sqrt() / std::f64::consts::TAU;
    assert!((slowest / exact - 1.0).abs() < 1e-6, "{slowest} Hz");
    direct.linearise(&LinearOptions::default()).unwrap();
}
