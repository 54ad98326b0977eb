//! Gravity as an input: free fall by a table against its closed form, tilting gravity against forces at the centres of
//! mass, the caller against a table, an accelerometer, the work.

use dbd_plant::instance::Instance;

use crate::values::Case;
use crate::{instance, value};

/// \[m/s²\] until 0.5 s linear from 0, then constant.
const RISE: &str = "table = [[0, 0], [0.5, 4], [2, 4]]\ninterpolate = \"linear\"";

/// A body on the y axis that starts with 1 m/s, above gravity `g`, with gravity along −y as an input.
fn falling(g: f64, planar: bool, input: &str) -> String {
    format!(
        "name = \"falling\"\nduration = 2\ngravity = [0, {g}, 0]\nplanar = {planar}\n[[body]]\nname = \"stone\"\n\
         mass = 0.7\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 0, 0]\nvelocity = [0, 1, 0]\n[[input]]\nname = \"field\"\n\
         type = \"gravity\"\naxis = [0, -2, 0]\n{input}\n"
    )
}

/// \[m\] its height after 1 s with [`RISE`] and gravity `g`: 8 m/s³ for 0.5 s, then 4 m/s² for 0.5 s.
fn fallen(g: f64) -> f64 {
    let (rise, held) = (0.5_f64, 0.5);
    let (speed, place) = (4.0 * rise * rise, 8.0 / 6.0 * rise.powi(3));
    1.0 + 0.5 * g - (place + speed * held + 2.0 * held * held)
}

pub(crate) fn case() -> Case {
    Case {
        element: "gravity",
        what: "height after falling 1 s by a table",
        unit: "m",
        exact: fallen(-1.3),
        step: 2e-3,
        found: Box::new(|step| {
            let mut run = instance(&falling(-1.3, false, RISE), step, "f64");
            run.advance_to(1.0).unwrap();
            value(&run, "stone.y")
        }),
        near: 3e-7,
    }
}

#[test]
fn a_table_of_gravity_gives_the_closed_form_in_each_precision_and_in_the_plane() {
    for g in [0.0, -1.3] {
        for (planar, precision, near) in [
            (false, "f64", 1e-6),
            (true, "f64", 1e-6),
            (false, "f32", 1e-4),
            (true, "f32", 1e-4),
            (false, "fixed", 1e-5),
        ] {
            let mut run = instance(&falling(g, planar, RISE), 1e-3, precision);
            run.advance_to(1.0).unwrap();
            let off = value(&run, "stone.y") - fallen(g);
            assert!(off.abs() < near, "{g} {planar} {precision}: {off:e}");
        }
    }
    // One evaluation per step, one at t = 0, one at the kink.
    let mut run = instance(&falling(0.0, false, RISE), 1e-3, "f64");
    run.advance(1000).unwrap();
    assert_eq!(run.plant().evaluations(), 1002);
}

/// A double pendulum whose gravity has the angle 0.3·sin(2π·0.7·t) from the vertical, nearly: a constant part of the
/// scene and the inputs `drive`; `masses` \[kg\].
fn tilted(masses: [f64; 2], planar: bool, drive: &str) -> String {
    let bodies: String = masses
        .iter()
        .enumerate()
        .map(|(i, mass)| {
            let before = if i == 0 { "world" } else { "b0" };
            let at = 0.5 * i as f64;
            format!(
                "[[body]]\nname = \"b{i}\"\nmass = {mass}\ninertia = [0.01, 0.03, 0.03]\nposition = [{}, 0, 0]\n\
                 [[joint]]\nname = \"j{i}\"\ntype = \"revolute\"\nbetween = [\"{before}\", \"b{i}\"]\n\
                 at = [{at}, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e5\ndamping = 20\n",
                at + 0.25
            )
        })
        .collect();
    format!(
        "name = \"tilted\"\nduration = 2\ngravity = [0, -4, 0]\nplanar = {planar}\n{bodies}{drive}"
    )
}

const SINES: [(&str, f64, &str); 2] = [("[1, 0, 0]", 3.0, "0"), ("[0, -1, 0]", 5.0, "1")];

fn sine(axis: &str, amplitude: f64, phase: &str) -> String {
    format!(
        "axis = {axis}\nsine = {{ amplitude = {amplitude:?}, frequency = 0.7, phase = {phase} }}\n"
    )
}

fn by_gravity() -> String {
    SINES
        .iter()
        .enumerate()
        .map(|(i, (axis, size, phase))| {
            let sine = sine(axis, *size, phase);
            format!("[[input]]\nname = \"g{i}\"\ntype = \"gravity\"\n{sine}")
        })
        .collect()
}

fn by_forces(masses: [f64; 2]) -> String {
    let mut text = String::new();
    for (i, (axis, size, phase)) in SINES.iter().enumerate() {
        for (body, mass) in masses.iter().enumerate() {
            let sine = sine(axis, size * mass, phase);
            text += &format!(
                "[[input]]\nname = \"f{i}{body}\"\ntype = \"force\"\nbody = \"b{body}\"\n{sine}"
            );
        }
    }
    text
}

#[test]
fn tilting_gravity_moves_as_forces_at_the_centres_of_mass() {
    let masses = [0.7, 1.1];
    for (planar, precision, near) in
        [(false, "f64", 1e-11), (true, "f64", 1e-11), (false, "f32", 1e-3), (false, "fixed", 1e-4)]
    {
        let places = |drive: &str| {
            let mut run = instance(&tilted(masses, planar, drive), 5e-4, precision);
            run.advance_to(2.0).unwrap();
            ["b0.x", "b0.y", "b1.x", "b1.y"].map(|name| value(&run, name))
        };
        let [by_gravity, by_forces, still] = [&by_gravity(), &by_forces(masses), ""].map(places);
        let off = |other: [f64; 4]| {
            other.iter().zip(by_forces).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        assert!(off(by_gravity) < near, "{planar} {precision}: {:e}", off(by_gravity));
        assert!(off(still) > 0.1, "{planar} {precision}: {still:?}");
    }
}

/// Every scheme: implicit ones solve with the external forces.
#[test]
fn schemes_agree_on_gravity_as_an_input() {
    let place = |scheme: &str| {
        let settings = dbd_plant::instance::Settings {
            scheme: Some(scheme.to_owned()),
            step: Some(2.5e-4),
            ..Default::default()
        };
        let text = tilted([0.7, 1.1], false, &by_gravity());
        let blueprint = dbd_plant::instance::Blueprint::new("tilted.toml", text);
        let mut run = Instance::new(blueprint, settings).unwrap();
        run.advance_to(0.5).unwrap();
        [value(&run, "b1.x"), value(&run, "b1.y")]
    };
    let reference = place("rk4");
    for scheme in ["leapfrog", "dbd", "generalized-alpha", "generalized-alpha-3", "pefrl"] {
        let found = place(scheme);
        let off = (found[0] - reference[0]).hypot(found[1] - reference[1]);
        assert!(off < 2e-3, "{scheme}: {off:e}");
    }
}

/// A caller's gravity beside a caller's force: as held tables of the same values, to the bit.
#[test]
fn the_caller_has_the_bits_of_a_held_table() {
    let push = |drive: &str| {
        format!(
            "[[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"b1\"\naxis = [1, 2, 0]\n{drive}\n"
        )
    };
    let field = |drive: &str| {
        format!("[[input]]\nname = \"field\"\ntype = \"gravity\"\naxis = [3, 1, 0]\n{drive}\n")
    };
    let (steps, h) = (40, 1e-3);
    // Each alone, both, the same value again.
    let values: Vec<[f64; 2]> =
        (0..steps).map(|n| [f64::from(n / 3 % 5) - 2.0, f64::from(n / 4 % 3) * 1.5]).collect();
    let tables = [0, 1].map(|column| {
        let rows = values.iter().enumerate();
        let rows: Vec<_> = rows.map(|(n, row)| [n as f64 * h, row[column]]).collect();
        format!("table = {rows:?}")
    });
    for precision in ["f64", "f32", "fixed"] {
        for fields_first in [true, false] {
            let drives = |push: String, field: String| match fields_first {
                true => field + &push,
                false => push + &field,
            };
            let text = tilted([0.7, 1.1], false, &drives(push(&tables[0]), field(&tables[1])));
            let mut table = instance(&text, h, precision);
            let text = tilted([0.7, 1.1], false, &drives(push(""), field("")));
            let mut called = instance(&text, h, precision);
            let inputs = ["push", "field"].map(|name| called.input(name).unwrap());
            let names = ["b0.x", "b0.vy", "b1.y", "b1.wz"];
            for (n, row) in values.iter().enumerate() {
                for (input, value) in inputs.into_iter().zip(row) {
                    called.set_input(input, *value).unwrap();
                }
                called.advance(1).unwrap();
                table.advance(1).unwrap();
                let [own, other] =
                    [&called, &table].map(|run| names.map(|name| value(run, name).to_bits()));
                assert_eq!(own, other, "{precision} {fields_first} step {n}");
            }
        }
    }
}

/// An accelerometer reads what holds it up: nothing in free fall, the field where it hangs.
#[test]
fn an_accelerometer_reads_no_gravity() {
    let sensor = "value = 6\n[[readout]]\nname = \"imu\"\ntype = \"imu\"\nbody = \"stone\"\n";
    let mut run = instance(&falling(-1.3, false, sensor), 1e-3, "f64");
    run.advance(10).unwrap();
    assert!(value(&run, "imu.ay").abs() < 1e-12, "{}", value(&run, "imu.ay"));
    let hung = "[[tsda]]\nbetween = [\"world\", \"stone\"]\npoints = [[0, 1, 0], [0, 0, 0]]\nstiffness = 200\n\
                damping = 20\nfree_length = 1\n";
    let text = falling(-1.3, false, &format!("{sensor}{hung}"));
    let mut run = instance(&text, 1e-3, "f64");
    run.advance_to(2.0).unwrap();
    assert!((value(&run, "imu.ay") - 7.3).abs() < 1e-6, "{}", value(&run, "imu.ay"));
}

/// The energy of the scene without the input changes by the input's work, m·a·v.
#[test]
fn the_energy_changes_by_the_work_of_the_field() {
    let mut run = instance(&tilted([0.7, 1.1], false, &by_gravity()), 2e-4, "f64");
    let read = |run: &Instance| {
        let names = ["energy.total", "b0.vx", "b0.vy", "b1.vx", "b1.vy"];
        names.map(|name| value(run, name))
    };
    let turn = std::f64::consts::TAU * 0.7;
    let power = |t: f64, [_, v0x, v0y, v1x, v1y]: [f64; 5]| {
        let (x, y) = (3.0 * (turn * t).sin(), -5.0 * (turn * t + 1.0).sin());
        0.7 * (x * v0x + y * v0y) + 1.1 * (x * v1x + y * v1y)
    };
    let mut before = read(&run);
    let (start, mut work, mut most) = (before[0], 0.0, 0.0_f64);
    for step in 1..=5000 {
        run.advance(1).unwrap();
        let now = read(&run);
        let t = f64::from(step) * 2e-4;
        work += 0.5 * 2e-4 * (power(t - 2e-4, before) + power(t, now));
        most = most.max(work.abs());
        before = now;
    }
    let gained = before[0] - start;
    assert!(most > 1.0 && (gained - work).abs() < 0.01 * most, "{gained} {work} {most}");
}
