//! Friction holds still: an arm of six joints, each of whose friction bears four fifths of its limit, does not sink.

use std::fmt::Write as _;

use dbd_tests::page::{block, figure, table};

use crate::{instance, value};

/// \[s\] the step.
const STEP: f64 = 2.5e-4;

/// \[s\] when the joints have come to rest, and the end.
const WINDOW: [f64; 2] = [8.0, 12.0];

/// Six links of 0.1 m and 0.5 kg, stretched out.
fn arm() -> String {
    let mut text = "name = \"arm\"\nduration = 12\ngravity = [0, 0, -9.81]\n[defaults.joint]\ntype = \"revolute\"\n\
                    axis = [0, 1, 0]\nspan = 0.04\nstiffness = 1e6\ndamping_ratio = 0.1\nfrequency = 300\n"
        .to_owned();
    let mut parent = "world".to_owned();
    for link in 0..6 {
        let beyond = f64::from(6 - link);
        let moment = 0.5 * 9.81 * 0.05 * beyond * beyond;
        let _ = write!(
            text,
            "[[body]]\nname = \"b{link}\"\nmass = 0.5\ninertia = [1e-4, 6e-4, 6e-4]\nposition = [{:?}, 0, 0]\n\
             [[joint]]\nname = \"j{link}\"\nbetween = [\"{parent}\", \"b{link}\"]\nat = [{:?}, 0, 0]\n\
             friction = {{ coulomb = {:?} }}\n",
            0.1 * f64::from(link) + 0.05,
            0.1 * f64::from(link),
            1.25 * moment,
        );
        parent = format!("b{link}");
    }
    text
}

#[test]
fn friction_joints_in_a_chain_do_not_creep() {
    let mut rows = Vec::new();
    for (precision, most) in [("f64", 1e-9), ("f32", 2e-7), ("fixed", 1e-9)] {
        let mut run = instance(&arm(), STEP, precision);
        let [rest, end] = WINDOW.map(|time| {
            run.advance_to(time).unwrap();
            ["x", "z"].map(|axis| value(&run, &format!("b5.{axis}")))
        });
        let sunk = (end[0] - rest[0]).hypot(end[1] - rest[1]);
        assert!(rest[1] < -1e-4, "{precision}: the joints give before they hold, {rest:?}");
        assert!(sunk < most, "{precision}: {sunk:e} m");
        let steps = ((WINDOW[1] - WINDOW[0]) / STEP).round();
        rows.push(vec![precision.into(), format!("{steps}"), figure(sunk, 2)]);
    }
    let head = ["precision", "steps", "last link moved [m]"];
    block("docs/elements.md", "creep", &table(&head, &rows));
}
