//! Elements without length, and points that meet.

use dbd_scene::Scene;

use crate::extremes_mechanics::{
    DAMPED, End, States, UNDAMPED, Way, body, each, follow, scene_of, single, spring,
};

fn x(state: &States) -> f64 {
    state.bodies[0].position.x
}

/// A body of 1 kg on one element with ω = 1 rad/s.
fn mount(start: [f64; 2], velocity: f64, damping: f64, free_length: f64) -> Scene {
    let [x, y] = start;
    scene_of(&[
        format!(
            "[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [{x:?}, {y:?}, 0]\n\
             velocity = [{velocity:?}, 0, 0]\n"
        ),
        spring(["world", "b"], 1.0, damping, free_length),
    ])
}

/// An element without free length needs no direction: a body swings through its other point.
#[test]
fn elements_without_length_are_driven_through_zero() {
    let line = |damping: f64| {
        scene_of(&[
            body("b", 1.0, 0.0).replace("[0.0, 0, 0]", "[1.0, 0, 0]"),
            format!(
                "[[point_on_line]]\nbetween = [\"world\", \"b\"]\nline_point = [0, 0, 0]\n\
                 line_direction = [0, 0, 1]\npoint = [0, 0, 0]\nstiffness = 1\n\
                 damping = {damping:?}\nfree_length = 0\n"
            ),
        ])
    };
    for ratio in [0.0, 0.1_f64, 1.0] {
        let tsda = mount([1.0, 0.0], 0.0, 2.0 * ratio, 0.0);
        for (name, scene) in [("TSDA", tsda), ("point on line", line(2.0 * ratio))] {
            each(&DAMPED, |way, method| {
                let end = follow(&scene, method, 0.1, 600, 600, |t, state| {
                    (x(state) - crate::extremes_mechanics::oscillators::relaxed(ratio, t)).abs()
                });
                let bound = way.error(0.1, 60.0) + if way == Way::Pefrl { 1e-2 } else { 1e-3 };
                assert!(end.is_within(bound), "{name} {ratio} {method:?} {end:?}");
                end
            });
        }
    }
}

/// \[m\] of the elements that have a free length here.
const LENGTH: f64 = 0.5;

/// A body comes along a TSDA of 0.5 m through its other point, where the force turns round: the law
/// between points at `x` is −(x − L0·sgn x). It slows down to `turn` beyond it and comes back.
/// From 2 m at rest: to x = 0 in arccos(−L0/(2 − L0)), mirrored beyond.
#[test]
fn a_spring_with_a_length_is_driven_through_zero() {
    let reach = 2.0 - LENGTH;
    let crossing = (-LENGTH / reach).acos();
    let reference_solution = |t: f64| {
        // Four mirror images in a period: away, through, beyond, and back.
        let turns = t / (2.0 * crossing);
        let (whole, part) = (turns.floor(), turns - turns.floor());
        let side = if whole as i64 % 2 == 0 { 1.0 } else { -1.0 };
        let phase = part * 2.0 * crossing;
        // From the far end to the crossing, then on the other side out to its far end.
        if phase < crossing {
            side * (LENGTH + reach * phase.cos())
        } else {
            -side * (LENGTH + reach * (2.0 * crossing - phase).cos())
        }
    };
    for step in [0.1, 0.01, 1e-3] {
        let scene = mount([2.0, 0.0], 0.0, 0.0, LENGTH);
        each(&UNDAMPED, |_, method| {
            let steps = (10.0 / step) as u64;
            let end = follow(&scene, method, step, steps, 100, |t, state| {
                (x(state) - reference_solution(t)).abs()
            });
            // The force turns round within a step: of first order, whatever the scheme.
            let bound = 10.0 * step + if single(method) { 1e-4 } else { 0.0 };
            assert!(end.is_within(bound), "{step} {method:?} {end:?}");
            end
        });
    }
}

/// Likewise, past the other point at a distance of `aside`: no plain solution, but energy stays.
#[test]
fn a_spring_passes_close_by_its_other_point() {
    for aside in [0.1_f64, 1e-3, 1e-9, 1e-30, 1e-160] {
        for ratio in [0.0, 0.1] {
            let scene = mount([2.0, aside], 0.0, 2.0 * ratio, LENGTH);
            let extension = aside.hypot(2.0) - LENGTH;
            let start = 0.5 * extension * extension;
            each(&DAMPED, |_, method| {
                let end = follow(&scene, method, 1e-3, 10_000, 200, |_, state| {
                    let body = &state.bodies[0];
                    let speed = body.velocity;
                    let length = body.position.dot(body.position).sqrt() - LENGTH;
                    let energy = 0.5 * (speed.dot(speed) + length * length);
                    let change = (energy - start) / start;
                    if ratio > 0.0 { change.max(0.0) } else { change.abs() }
                });
                // One step's force at the wrong side, 2·k·L0, along the way of that step.
                let crossings = 10.0 / 2.0;
                let bound = 2.0 * LENGTH * 1e-3 * 1.5 / start * crossings + 1e-3;
                assert!(end.is_within(bound), "{aside:e} {ratio} {method:?} {end:?} {bound:e}");
                end
            });
        }
    }
}

/// Points that coincide at the start have no direction: with a free length a scene is refused. A
/// model that is brought there by other means has no force there, and stays.
#[test]
fn coincident_points_with_a_free_length_are_refused() {
    let text = [
        "name = \"extreme\"\nduration = 1\n".to_owned(),
        body("b", 1.0, 0.0),
        spring(["world", "b"], 1.0, 0.1, LENGTH),
    ];
    let why = Scene::parse(&text.concat(), "extreme.toml").unwrap_err().to_string();
    assert!(why.contains("`points` of tsda 1 coincide"), "{why}");

    let mut scene = mount([LENGTH, 0.0], 0.0, 0.1, LENGTH);
    scene.model.initial[0].position.x = 0.0;
    for ends in
        each(&DAMPED, |_, method| follow(&scene, method, 0.01, 100, 100, |_, state| x(state).abs()))
    {
        assert_eq!(ends, [End::Right(0.0); 2]);
    }
}
