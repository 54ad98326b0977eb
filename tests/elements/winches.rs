//! Free lengths that inputs set: a hoist, a rope that slackens, an air spring, against closed forms.

use dbd_plant::instance::Instance;

use crate::values::{Case, at};
use crate::{instance, value};

const G: f64 = 9.81;

/// \[m\] at rest.
const STRETCH: f64 = 5.0 * G / 1500.0;

/// 5 kg on a rope of 1.5 kN/m from the origin, 2 m long, at rest.
fn hoist(rope: &str, input: &str) -> String {
    format!(
        r#"
        name = "hoist"
        duration = 2
        gravity = [0, -{G}, 0]
        [[body]]
        name = "load"
        mass = 5
        inertia = [0.1, 0.1, 0.1]
        position = [0, {}, 0]
        [[tsda]]
        name = "rope"
        between = ["load", "world"]
        points = [[0, 0, 0], [0, 0, 0]]
        stiffness = 1500
        {rope}
        [[input]]
        name = "winch"
        type = "free_length"
        target = "rope"
        {input}
        [[readout]]
        name = "tension"
        type = "tsda_force"
        target = "rope"
        [[readout]]
        name = "extension"
        type = "interaction"
        target = "rope"
        quantity = "extension"
        "#,
        -2.0 - STRETCH,
    )
}

/// Wound up with 0.5 m/s from t = 0 on.
const LIFT: &str = "table = [[0, 2], [2, 1]]\ninterpolate = \"linear\"";

/// The height after a lift of `time` \[s\]: extension from rest at `m·g/k`, `x″ + 2ζω·x′ + ω²·x = 0`, `x′ = 0.5 m/s`.
fn lifted(time: f64, damping: f64) -> f64 {
    let (rate, decay) = ((1500.0_f64 / 5.0).sqrt(), damping / 10.0);
    let damped = (rate * rate - decay * decay).sqrt();
    let stretch = 0.5 / damped * (-decay * time).exp() * (damped * time).sin();
    -(2.0 - 0.5 * time + STRETCH + stretch)
}

/// 10 kg that fall from 0.5 m above on a rope of 10 kN/m.
fn bouncing() -> String {
    let text = hoist("free_length = 2\nacts = \"tension\"", "");
    text.replace("stiffness = 1500", "stiffness = 1e4")
        .replace("mass = 5", "mass = 10")
        .replace(&format!("{}", -2.0 - STRETCH), "-1.5")
}

/// Its period, taut once, and the largest tension.
fn bounce(step: f64) -> [f64; 2] {
    let mut run = instance(&bouncing(), step, "f64");
    let [y, tension] = ["load.y", "tension"].map(|name| run.output(name).unwrap());
    let (mut last, mut taut, mut most) = (-1.5, Vec::new(), 0.0_f64);
    while taut.len() < 2 {
        run.advance(1).unwrap();
        let now = run.value(y);
        most = most.max(run.value(tension));
        if now >= -2.0 {
            assert_eq!(run.value(tension), 0.0);
        }
        if now < -2.0 && last >= -2.0 {
            taut.push(run.time() - step * (-2.0 - now) / (last - now));
        }
        last = now;
    }
    [taut[1] - taut[0], most]
}

#[test]
fn a_hoist_lifts_as_its_closed_form() {
    for (damping, near) in [(0.0, [3e-6, 2e-5, 3e-4]), (60.0, [3e-6, 2e-5, 3e-4])] {
        let rope = format!("damping = {damping}\nacts = \"tension\"");
        for (precision, near) in ["f64", "f32", "fixed"].into_iter().zip(near) {
            let mut run = instance(&hoist(&rope, LIFT), 1e-4, precision);
            for ms in 1..1000 {
                run.advance_to(f64::from(ms) * 1e-3).unwrap();
                let (now, exact) = (value(&run, "load.y"), lifted(run.time(), damping));
                assert!((now - exact).abs() < near, "{damping} {precision} {ms}: {now} {exact}");
            }
        }
    }
    // A linear table costs no evaluation: one of a step, one at t = 0.
    let mut run = instance(&hoist("acts = \"tension\"", LIFT), 1e-4, "f64");
    run.advance(1000).unwrap();
    assert_eq!(run.plant().evaluations(), 1001);
    // In the end the damper does not resist the winch.
    let rope = "damping = 60\nacts = \"tension\"";
    let mut run = instance(&hoist(rope, LIFT), 1e-4, "f64");
    run.advance_to(1.9).unwrap();
    assert!((value(&run, "tension") - 5.0 * G).abs() < 1e-3, "{}", value(&run, "tension"));
}

/// Energy changes by the power of the input, minus the tension times the rate of the free length, less what the damper
/// takes, its tension times the rate of the extension.
#[test]
fn the_input_s_power_is_tension_times_rate() {
    let input = "sine = { amplitude = 0.1, frequency = 3, offset = 2 }";
    for damping in [0.0, 40.0] {
        let h = 5e-5;
        let rope = format!("damping = {damping}\nacts = \"tension\"");
        let mut run = instance(&hoist(&rope, input), h, "f64");
        let outputs =
            ["energy.total", "tension", "extension"].map(|name| run.output(name).unwrap());
        let read = |run: &Instance| outputs.map(|output| run.value(output));
        let rate = |t: f64| {
            let turn = std::f64::consts::TAU * 3.0;
            0.1 * turn * (turn * t).cos()
        };
        let damper = |[_, tension, extension]: [f64; 3]| tension - 1500.0 * extension.max(0.0);
        // As the sine begins, so does the tension of the damper.
        run.advance(1).unwrap();
        let mut before = read(&run);
        let start = before[0];
        let (mut work, mut lost, mut slack) = (0.0, 0.0, 0);
        for step in 2..=20_000 {
            run.advance(1).unwrap();
            let now = read(&run);
            let t = f64::from(step) * h;
            work -= 0.5 * h * (before[1] * rate(t - h) + now[1] * rate(t));
            lost += 0.5 * (damper(before) + damper(now)) * (now[2] - before[2]);
            slack += u32::from(now[2] < 0.0);
            assert!(now[1] >= 0.0, "{damping}: pushes with {}", now[1]);
            before = now;
        }
        let gained = before[0] - start;
        assert!(slack > 1000 && (damping == 0.0) == (lost == 0.0), "{damping}: {slack} {lost}");
        let off = (gained - work + lost).abs();
        assert!(work.abs() > 1.0 && off < 1e-2 * (work.abs() + lost), "{gained} {work} {lost}");
    }
}

#[test]
fn a_rope_slackens_and_the_plane_is_as_space() {
    let rope = "damping = 60\nacts = \"tension\"";
    let input = "table = [[0, 2], [0.2, 2.6], [0.6, 1.8]]\ninterpolate = \"linear\"";
    let run = |planar: bool, precision: &str| {
        let text =
            hoist(rope, input).replacen("duration", &format!("planar = {planar}\nduration"), 1);
        let mut run = instance(&text, 1e-4, precision);
        run.advance_to(0.1).unwrap();
        // Faster than the load falls.
        assert_eq!(value(&run, "tension"), 0.0, "{planar} {precision}");
        run.advance_to(1.0).unwrap();
        value(&run, "load.y")
    };
    let space = run(false, "f64");
    for (planar, precision, near) in
        [(true, "f64", 1e-12), (true, "f32", 2e-4), (false, "f32", 2e-4)]
    {
        let found = run(planar, precision);
        assert!((found - space).abs() < near, "{planar} {precision}: {found} {space}");
    }
}

/// A caller starts at the TSDA's free length; negative ones count as 0, and an evaluation is due for each new value.
#[test]
fn a_caller_sets_a_free_length() {
    for precision in ["f64", "f32", "fixed"] {
        let text = hoist("free_length = 2\nacts = \"tension\"", "");
        let mut run = instance(&text, 1e-4, precision);
        let winch = run.input("winch").unwrap();
        assert_eq!(run.inputs()[0].start, 2.0);
        run.advance(100).unwrap();
        assert!((value(&run, "tension") - 5.0 * G).abs() < 0.1, "{precision}");
        let evaluations = run.plant().evaluations();
        let controlled = |run: &mut Instance, steps: u32| {
            for step in 0..steps {
                run.set_input(winch, 2.0 - 1e-4 * f64::from(step)).unwrap();
                run.advance(1).unwrap();
            }
        };
        controlled(&mut run, 100);
        assert_eq!(run.plant().evaluations() - evaluations, 199, "{precision}");
        let saved = run.save().unwrap();
        let mut other = instance(&text, 1e-4, precision);
        other.restore(&saved).unwrap();
        controlled(&mut run, 50);
        controlled(&mut other, 50);
        assert_eq!(run.hash(), other.hash(), "{precision}");
        assert_eq!(run.plant().status(), Ok(()));
        run.set_input(winch, -1.0).unwrap();
        run.advance(1).unwrap();
        let (tension, y) = (value(&run, "tension"), value(&run, "load.y"));
        assert!((value(&run, "extension") + y).abs() < 1e-6, "{precision}: {tension} {y}");
    }
}

/// With the rate, which a caller may set as well, a damper does not resist.
#[test]
fn a_caller_sets_the_rate_as_well() {
    let text = hoist("free_length = 2\ndamping = 60\nacts = \"tension\"", "");
    let mut run = instance(&text, 1e-4, "f64");
    let [winch, rate] = ["winch", "winch.rate"].map(|name| run.input(name).unwrap());
    run.set_input(rate, -0.5).unwrap();
    for step in 0..5000 {
        run.set_input(winch, 2.0 - 0.5 * 1e-4 * (f64::from(step) + 0.5)).unwrap();
        run.advance(1).unwrap();
    }
    let (now, exact) = (value(&run, "load.y"), lifted(0.5, 60.0));
    assert!((now - exact).abs() < 2e-4, "{now} {exact}");
}

/// Every scheme takes it.
#[test]
fn every_scheme_lifts() {
    use dbd_plant::instance::{Blueprint, Settings};
    for scheme in ["semi-implicit-euler", "pefrl", "rk4", "generalized-alpha", "blanes-moan-s6"] {
        let settings =
            Settings { step: Some(1e-4), scheme: Some(scheme.to_owned()), ..Settings::default() };
        let text = hoist("acts = \"tension\"", LIFT);
        let mut run = Instance::new(Blueprint::new("hoist.toml", text), settings).unwrap();
        run.advance_to(0.5).unwrap();
        let (now, exact) = (value(&run, "load.y"), lifted(0.5, 0.0));
        let near = if scheme == "semi-implicit-euler" { 1e-3 } else { 2e-6 };
        assert!((now - exact).abs() < near, "{scheme}: {now} {exact}");
    }
}

/// The rows of the page.
pub(crate) fn cases() -> Vec<Case> {
    vec![
        Case {
            element: "distance-winch",
            what: "height 0.5 s after a lift with 0.5 m/s begins",
            unit: "m",
            exact: lifted(0.5, 0.0),
            step: 2e-4,
            near: 1e-5,
            found: Box::new(|h| at(&hoist("acts = \"tension\"", LIFT), h, 0.5, "load.y")),
        },
        Case {
            element: "distance-winch",
            what: "the same, 60 N·s/m",
            unit: "m",
            exact: lifted(0.5, 60.0),
            step: 2e-4,
            near: 1e-5,
            found: Box::new(|h| {
                let rope = "damping = 60\nacts = \"tension\"";
                at(&hoist(rope, LIFT), h, 0.5, "load.y")
            }),
        },
        Case {
            element: "distance-winch",
            what: "period of 10 kg that fall 0.5 m on a rope",
            unit: "s",
            exact: 0.744_140_559,
            step: 2e-4,
            near: 1e-5,
            found: Box::new(|h| bounce(h)[0]),
        },
        Case {
            element: "distance-winch",
            what: "largest tension of that rope",
            unit: "N",
            exact: 1_093.400_76,
            step: 2e-4,
            near: 1e-4,
            found: Box::new(|h| bounce(h)[1]),
        },
    ]
}
