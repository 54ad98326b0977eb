//! Vibrations with a closed solution: mass ratios, stiffness, steps and damping ratios at their ends.

use dbd_tests::page::figure;

use crate::extremes_mechanics::{
    DAMPED, End, Rows, States, UNDAMPED, Way, body, each, follow, scene_of, single, spring,
};

/// \[m\] the free length, and how far beyond it bodies are let go.
const LENGTH: f64 = 1.0;
const AMPLITUDE: f64 = 0.1;

fn x(state: &States, row: usize) -> f64 {
    state.bodies[row].position.x
}

/// Two free bodies on one spring vibrate against each other by ω = 1 rad/s in steps of 0.1 s.
#[test]
fn two_bodies_of_any_mass_ratio_vibrate_as_one() {
    for ratio in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        let stiffness = ratio / (1.0 + ratio);
        let scene = scene_of(&[
            body("one", 1.0, 0.0),
            body("other", ratio, LENGTH + AMPLITUDE),
            spring(["one", "other"], stiffness, 0.0, LENGTH),
        ]);
        each(&UNDAMPED, |way, method| {
            let end = follow(&scene, method, 0.1, 600, 200, |t, state| {
                (x(state, 1) - x(state, 0) - LENGTH - AMPLITUDE * t.cos()).abs() / AMPLITUDE
            });
            let rounding = if single(method) { 1e-3 } else { 1e-12 };
            assert!(end.is_within(way.error(0.1, 60.0) + rounding), "{ratio:e} {method:?} {end:?}");
            end
        });
    }
}

/// A body of 1 kg hangs on a light one between two springs: a quarter of its period, in steps for the
/// light one.
#[test]
fn a_heavy_body_on_a_light_one_moves_as_it_should() {
    let stiffness = 1.0;
    for light in [1e-6_f64, 1e-4, 1e-2, 1.0] {
        // Modes of [[2, −1], [−1, 1]]·k over the masses: ω⁴·m − ω²·(2 + m) + 1 = 0.
        let sum = (2.0 + light) / light;
        let fast_square = 0.5 * (sum + (sum * sum - 4.0 / light).sqrt());
        let slow_square: f64 = 1.0 / light / fast_square;
        let slow = slow_square.sqrt();
        let share = 1.0 - slow_square; // of the heavy one's amplitude, from its row
        let scene = scene_of(&[
            body("light", light, LENGTH + share * AMPLITUDE),
            body("heavy", 1.0, 2.0 * LENGTH + AMPLITUDE),
            spring(["world", "light"], stiffness, 0.0, LENGTH),
            spring(["light", "heavy"], stiffness, 0.0, LENGTH),
        ]);
        let step = 0.1 / fast_square.sqrt();
        let steps = (std::f64::consts::FRAC_PI_2 / slow / step) as u64 / 10 * 10;
        each(&UNDAMPED, |way, method| {
            let end = follow(&scene, method, step, steps, 10, |t, state| {
                (x(state, 1) - 2.0 * LENGTH - AMPLITUDE * (slow * t).cos()).abs() / AMPLITUDE
            });
            let rounding = if single(method) { 5e-2 } else { 1e-9 };
            let bound = way.error(slow * step, 1.6) + rounding;
            assert!(end.is_within(bound), "{light:e} {method:?} {end:?}");
            end
        });
    }
}

/// 1 kg is let go on a spring at its free length of 1 m under 9.81 m/s².
#[test]
fn springs_of_any_stiffness_carry_a_weight() {
    let mut rows = Rows::new(&["stiffness [N/m]", "deflection [m]"], &UNDAMPED);
    for stiffness in [1e2, 1e4, 1e6, 1e8, 1e9_f64] {
        let omega = stiffness.sqrt();
        let deflection = 9.81 / stiffness;
        let scene = scene_of(&[
            "gravity = [9.81, 0, 0]\n".to_owned(),
            body("b", 1.0, LENGTH),
            spring(["world", "b"], stiffness, 0.0, LENGTH),
        ]);
        let ends = each(&UNDAMPED, |way, method| {
            let end = follow(&scene, method, 0.1 / omega, 1_000, 250, |t, state| {
                (x(state, 0) - LENGTH - deflection * (1.0 - (omega * t).cos())).abs()
            });
            let grid: f64 = if single(method) { f32::EPSILON.into() } else { f64::EPSILON };
            // A rounding of the position is a kick of k times it; pefrl drifts forth and back within
            // a step and rounds each time.
            let kicks = if way == Way::Pefrl { 300.0 } else { 50.0 };
            let bound = deflection * way.error(0.1, 100.0) + kicks * grid;
            assert!(end.is_within(bound), "{stiffness:e} {method:?} {end:?} {bound:e}");
            end
        });
        rows.push(vec![format!("{stiffness:e}"), figure(deflection, 2)], &ends);
    }
    rows.write("stiffness");
}

/// 1 kg on 10 kN/m, ω = 100 rad/s, let go 0.1 m from rest, in 10,000 steps.
#[test]
fn steps_from_the_shortest_to_twice_the_limit() {
    let omega = 100.0;
    let scene = scene_of(&[
        body("b", 1.0, LENGTH + AMPLITUDE),
        spring(["world", "b"], omega * omega, 0.0, LENGTH),
    ]);
    let mut rows = Rows::new(&["step"], &UNDAMPED);
    // The share of the way so far by which it is off: at 1 it stands still.
    let run = |method: &_, step| {
        let mut way = 0.0_f64;
        let mut off = 0.0_f64;
        let end = follow(&scene, method, step, 10_000, 100, |t, state| {
            let reference_solution = AMPLITUDE * (omega * t).cos();
            way = way.max((AMPLITUDE - reference_solution).abs());
            off = off.max((x(state, 0) - LENGTH - reference_solution).abs());
            off / way
        });
        match end {
            End::Right(_) => End::Right(off / way),
            end => end,
        }
    };
    for step in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        let ends = each(&UNDAMPED, |way, method| {
            let end = run(method, step);
            let phase = 10_000.0 * step * omega;
            // In the first steps from rest a step is a share of the way.
            let first = 2.0 / 10_000.0;
            let bound = match single(method) {
                false => 2.0 * way.error(step * omega, phase) + first,
                // Steps are lost where h·v is below the grid of the position.
                true if step < 1e-6 => 1.5,
                true => 2.0 * way.error(step * omega, phase) + 0.05,
            };
            assert!(end.is_within(bound), "{step:e} {method:?} {end:?} {bound:e}");
            end
        });
        rows.push(vec![format!("{step:e} s")], &ends);
    }
    for share in [0.99, 1.01, 2.0] {
        let ends = each(&UNDAMPED, |_, method| {
            let end = run(method, share * method.stability_limit() / omega);
            // Below the limit no growth, and no digit of the phase; beyond it is told.
            let right = if share < 1.0 { end.is_within(20.0) } else { end.is_reported() };
            assert!(right, "{share} {method:?} {end:?}");
            end
        });
        rows.push(vec![format!("{share} of the limit")], &ends);
    }
    rows.write("steps");
}

/// How far a body of ω = 1 rad/s is from rest at a time, let go at 1.
pub(crate) fn relaxed(ratio: f64, t: f64) -> f64 {
    let square = ratio * ratio - 1.0;
    if square.abs() < 1e-12 {
        return (-t).exp() * (1.0 + t);
    }
    let root = square.abs().sqrt();
    if square < 0.0 {
        return (-ratio * t).exp() * ((root * t).cos() + ratio / root * (root * t).sin());
    }
    let (slow, fast) = (-1.0 / (ratio + root), -ratio - root);
    (fast * (slow * t).exp() - slow * (fast * t).exp()) / (fast - slow)
}

#[test]
fn dampers_of_any_strength() {
    let mut rows = Rows::new(&["damping ratio", "h·c/m"], &DAMPED);
    let step = 0.1;
    for ratio in [0.0, 1e-3, 0.1, 1.0, 5.0, 10.0, 100.0] {
        let scene = scene_of(&[
            body("b", 1.0, LENGTH + AMPLITUDE),
            spring(["world", "b"], 1.0, 2.0 * ratio, LENGTH),
        ]);
        let strength = 2.0 * ratio * step;
        let ends = each(&DAMPED, |way, method| {
            let end = follow(&scene, method, step, 2_000, 400, |t, state| {
                (x(state, 0) - LENGTH - AMPLITUDE * relaxed(ratio, t)).abs() / AMPLITUDE
            });
            let explicit = matches!(way, Way::LeapfrogExplicit | Way::Rk4 | Way::Dbd);
            if explicit && strength > 2.8 {
                assert!(end.is_reported(), "{ratio} {method:?} {end:?}");
            } else if !explicit || strength < 1.0 {
                let rounding = if single(method) { 2e-2 } else { 0.0 };
                let bound = match way {
                    Way::Leapfrog if ratio >= 0.1 => 2e-3,
                    Way::Pefrl if strength > 0.5 => 0.8,
                    Way::Pefrl => 2e-2,
                    _ if ratio >= 0.1 => 0.1,
                    _ => way.error(step, 200.0),
                };
                let bound = bound + rounding;
                assert!(end.is_within(bound), "{ratio} {method:?} {end:?} {bound:e}");
            }
            end
        });
        rows.push(vec![figure(ratio, 1), figure(strength, 1)], &ends);
    }
    rows.write("damping ratios");
}

/// Constants that double precision holds and single precision does not: each run in the latter ends told.
#[test]
fn constants_beyond_single_precision_are_told() {
    let cases = [
        ("a mass of 1e39 kg", body("b", 1e39, 1.0), 1e5, 1e-3),
        ("a mass of 1e-38 kg", body("b", 1e-38, 1.0), 1e5, 1e-25),
        ("a stiffness of 1e39 N/m", body("b", 1.0, 1.0), 1e39, 1e-25),
        ("a spring of 1e20 m", body("b", 1.0, 1e20), 1.0, 0.1),
    ];
    for (name, body, stiffness, step) in cases {
        let scene = scene_of(&[body, spring(["world", "b"], stiffness, 0.0, 0.5)]);
        let start = x(&dbd_kernel::State::initial(&scene.model), 0);
        each(&UNDAMPED, |_, method| {
            let end = follow(&scene, method, step, 100, 100, |_, state| {
                // No further than it was let go, but for the scheme's error.
                (x(state, 0).abs() / start - 1.0).max(0.0)
            });
            let held = name.contains("e-38") || !single(method);
            assert!(
                if held { end.is_within(0.2) } else { end.is_reported() },
                "{name} {method:?} {end:?}"
            );
            end
        });
    }
    // Its way is 1e40 m: the error in parts of it.
    let (speed, omega, step) = (1e37, 1e-3, 10.0);
    let body = body("b", 1.0, 0.0) + &format!("velocity = [{speed:?}, 0, 0]\n");
    let scene = scene_of(&[body, spring(["world", "b"], omega * omega, 0.0, 0.0)]);
    each(&UNDAMPED, |_, method| {
        let end = follow(&scene, method, step, 100, 100, |t, state| {
            (x(state, 0) - speed / omega * (omega * t).sin()).abs() * omega / speed
        });
        assert!(
            if single(method) { end.is_reported() } else { end.is_within(0.02) },
            "{method:?} {end:?}"
        );
        end
    });
}
