//! The table of `docs/elements.md`: what elements reach, at three steps each.

use std::fmt::Write as _;

use dbd_plant::digits::significant;
use dbd_tests::page::{block, table};
use nalgebra::{Matrix6, Vector6};

use crate::drives::{ROTOR, period, wheel};
use crate::{
    axes, contacts, couplings, driven, gravity, instance, loaded, mounts, shaft, soft, value,
    winches,
};

const G: f64 = 9.81;

/// A value that an element must reach.
pub(crate) struct Case {
    pub(crate) element: &'static str,
    pub(crate) what: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) exact: f64,
    /// \[s\] the longest of three steps, each half of the one before.
    pub(crate) step: f64,
    pub(crate) found: Box<dyn Fn(f64) -> f64>,
    /// What the last may be off by, of the value.
    pub(crate) near: f64,
}

/// A body of `mass` \[kg\] on the y axis.
pub(crate) fn mass(mass: f64, place: f64, speed: f64, gravity: f64, more: &str) -> String {
    format!(
        "name = \"mass\"\nduration = 1\ngravity = [0, {gravity}, 0]\n[[body]]\nname = \"mass\"\nmass = {mass}\n\
         inertia = [0.1, 0.1, 0.1]\nposition = [0, {place}, 0]\nvelocity = [0, {speed}, 0]\n{more}\n"
    )
}

/// Runs until `ends`; the least and the last of a column, and the time.
pub(crate) fn until(
    text: &str,
    step: f64,
    name: &str,
    ends: impl Fn(f64, f64) -> bool,
) -> [f64; 3] {
    let mut run = instance(text, step, "f64");
    let output = run.output(name).unwrap();
    let mut least = f64::INFINITY;
    loop {
        run.advance(1).unwrap();
        let now = run.value(output);
        least = least.min(now);
        if ends(run.time(), now) {
            return [least, now, run.time()];
        }
    }
}

pub(crate) fn at(text: &str, step: f64, time: f64, name: &str) -> f64 {
    let mut run = instance(text, step, "f64");
    run.advance_to(time).unwrap();
    value(&run, name)
}

/// Hunt & Crossley (1975): k 1e5 N/m, a 0.6 s/m, 1 kg at 1 m/s; by Lambert's W.
pub(crate) fn stop() -> String {
    mass(
        1.0,
        0.001,
        -1.0,
        0.0,
        "[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"mass\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         normal = [0, 1, 0]\nstiffness = 1e5\ndissipation = 0.6",
    )
}

const BUMP: &str = "[[interaction]]\nlaw = \"distance-spring\"\nbetween = [\"world\", \"mass\"]\n\
                    points = [[0, 0, 0], [0, 0, 0]]\nfree_length = 0.5\n\
                    force = [[\"-60 mm\", -2400], [\"-20 mm\", -400], [0, 0], [\"1 mm\", 0]]";

/// Depth of 5 kg that fall by 0.1 m on the bump stop: `m·g·(0.1 + x) = 4 + 400·(x − 0.02) + 25,000·(x − 0.02)²`.
fn depth() -> f64 {
    let (weight, fall) = (5.0 * G, 0.1);
    let square: f64 = (400.0 - weight) * (400.0 - weight) + 1e5 * (weight * (fall + 0.02) - 4.0);
    0.02 + (weight - 400.0 + square.sqrt()) / 5e4
}

/// 5 kg on a rope of 1 m and 5 kN/m that only pulls, thrown down by 1 m/s where it begins to.
const ROPE: &str = "[[interaction]]\nlaw = \"distance-spring\"\nbetween = [\"world\", \"mass\"]\n\
                    points = [[0, 0, 0], [0, 0, 0]]\nfree_length = 1\n\
                    force = [[\"-1 m\", 0], [0, 0], [\"100 mm\", 500]]";

/// Time from slack to slack again and back: taut for `(π + 2·atan(g/(ω·v)))/ω`, then in flight.
fn bounce() -> f64 {
    let rate = (5000.0_f64 / 5.0).sqrt();
    (std::f64::consts::PI + 2.0 * (G / rate).atan()) / rate + 2.0 / G
}

/// The second time at which the rope is drawn taut.
fn drawn(step: f64) -> f64 {
    let mut run = instance(&mass(5.0, -1.0, -1.0, -G, ROPE), step, "f64");
    let y = run.output("mass.y").unwrap();
    let (mut last, mut flew) = (-1.0, false);
    loop {
        run.advance(1).unwrap();
        let now = run.value(y);
        flew |= now > -0.999;
        if flew && now < -1.0 {
            return run.time() - step * (-1.0 - now) / (last - now);
        }
        last = now;
    }
}

/// A block of 1 kg between a spring of 1 kN/m and dry friction of 5 N, let go 72 mm beside its rest.
const BLOCK: &str = "name = \"block\"\nduration = 1\n[[body]]\nname = \"mass\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\n\
                     position = [0.072, 0, 0]\n[[tsda]]\nbetween = [\"world\", \"mass\"]\n\
                     points = [[-1, 0, 0], [0, 0, 0]]\nstiffness = 1000\nfree_length = 1\n[[interaction]]\n\
                     law = \"slide-friction\"\nbetween = [\"world\", \"mass\"]\npoints = [[0.072, 0, 0], [0, 0, 0]]\n\
                     axis = [1, 0, 0]\ncoulomb = 5\nbreakaway = 5\ngive = \"10 um\"\ndamping = 15";

/// A disc of 1 kg, radius 0.1 m, on a plane that gravity leans over.
fn disc(axis_error: f64, start: &str, contact: &str) -> String {
    let (sin, cos) = axis_error.sin_cos();
    let depth = G * cos / 1e6;
    format!(
        "name = \"disc\"\nduration = 1\ngravity = [{}, {}, 0]\n[[body]]\nname = \"disc\"\nmass = 1\n\
         inertia = [0.005, 0.005, 0.005]\nposition = [0, {}, 0]\n{start}\n[[interaction]]\nlaw = \"plane-contact\"\n\
         between = [\"world\", \"disc\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nnormal = [0, 1, 0]\nradius = 0.1\n\
         stiffness = 1e6\ndissipation = 1\n{contact}\n",
        G * sin,
        -G * cos,
        0.1 - depth,
    )
}

/// \[V\] on the winding.
const VOLTS: f64 = 12.0;

fn motor() -> String {
    wheel(
        "mode = \"voltage\"\nwinding = { resistance = 1.2, inductance = \"0.8 mH\", constant = 0.05 }\n\
         rotor = \"2e-5 kg*m^2\"\nratio = 50\ngear = { stiffness = \"200 N*m/rad\", damping = 0.5 }\nvalue = 12",
        "",
    )
}

/// Angle of wheel and torque at the output after a time: the matrix exponential of the linear drive.
fn driven(time: f64) -> [f64; 2] {
    let (j, m, k, c, constant) = (0.02, 0.05, 200.0, 0.5, 0.05 * 50.0);
    let (resistance, inductance) = (1.2, 0.8e-3);
    #[rustfmt::skip]
    let a = Matrix6::new(
        0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
        0.0, -c / j, k / j, c / j, 0.0, 0.0,
        0.0, -1.0, 0.0, 1.0, 0.0, 0.0,
        0.0, c / m, -k / m, -c / m, constant / m, 0.0,
        0.0, 0.0, 0.0, -constant / inductance, -resistance / inductance, VOLTS / inductance,
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    );
    let state = (a * time).exp() * Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    [state[0], constant * state[4]]
}

/// Of a first order with a bound: 0.02 kg·m² by 0.8 N·m to 3 rad/s, from there with kd 0.4 N·m·s/rad.
fn bounded(time: f64) -> f64 {
    let (speed, most, kd, inertia) = (3.0, 0.8, 0.4, 0.02);
    // Until the servo asks for less: kd·(3 − ω) = 0.8.
    let full = inertia * (speed - most / kd) / most;
    let (turned, rate) = (0.5 * most / inertia * full * full, speed - most / kd);
    let (left, decay) = (time - full, kd / inertia);
    turned + speed * left - (speed - rate) * (1.0 - (-decay * left).exp()) / decay
}

fn cases() -> Vec<Case> {
    let case = |element, what, unit, exact, step, near, found: Box<dyn Fn(f64) -> f64>| Case {
        element,
        what,
        unit,
        exact,
        step,
        found,
        near,
    };
    let axis_error = 30_f64.to_radians();
    let backspin = "velocity = [2, 0, 0]\nangular_velocity = [0, 0, 30]";
    let lever = 0.1 - G / 1e6;
    let ends = (2.0 + 30.0 * lever) / (0.2 * G * (1.0 + lever * lever / 0.005));
    vec![
        case(
            "end-stop",
            "penetration",
            "m",
            2.687_381_736_5e-3,
            2e-4,
            1e-3,
            Box::new(|h| -until(&stop(), h, "mass.y", |time, _| time > 0.02)[0]),
        ),
        case(
            "end-stop",
            "speed of the rebound",
            "m/s",
            0.711_950_179_6,
            2e-4,
            1e-3,
            Box::new(|h| at(&stop(), h, 0.02, "mass.vy")),
        ),
        case(
            "distance-spring",
            "depth in a bump stop",
            "m",
            depth(),
            2e-4,
            1e-3,
            Box::new(|h| {
                0.5 - until(&mass(5.0, 0.6, 0.0, -G, BUMP), h, "mass.y", |t, _| t > 0.25)[0]
            }),
        ),
        case(
            "distance-spring",
            "period on a rope that slackens",
            "s",
            bounce(),
            2e-4,
            1e-3,
            Box::new(drawn),
        ),
        case(
            "slide-friction",
            "rest after 7 half swings",
            "m",
            -2e-3,
            1e-4,
            2e-2,
            Box::new(|h| at(BLOCK, h, 2.0, "mass.x")),
        ),
        case(
            "plane-contact",
            "speed after rolling 1 s on 30°",
            "m/s",
            0.5 * G / 1.5,
            1e-4,
            1e-3,
            Box::new(move |h| {
                at(&disc(axis_error, "", "friction = 0.5\ndamping = 100"), h, 1.0, "disc.vx")
            }),
        ),
        case(
            "plane-contact",
            "speed after sliding 1 s on 30°, μ 0.15",
            "m/s",
            G * (axis_error.sin() - 0.15 * axis_error.cos()),
            1e-4,
            1e-3,
            Box::new(move |h| at(&disc(axis_error, "", "friction = 0.15"), h, 1.0, "disc.vx")),
        ),
        case(
            "plane-contact",
            "speed after a backspin of 30 rad/s at 2 m/s, μ 0.2",
            "m/s",
            2.0 - 0.2 * G * ends,
            1e-4,
            1e-3,
            Box::new(move |h| {
                at(&disc(0.0, backspin, "friction = 0.2\ndamping = 100"), h, 1.0, "disc.vx")
            }),
        ),
        case(
            "hinge-drive",
            "period of a pendulum with a rotor at 0.1 rad",
            "s",
            1.461_351_9,
            2e-4,
            1e-5,
            Box::new(|h| period(0.1, ROTOR, h / 4.0)),
        ),
        case(
            "hinge-drive",
            "the same at 2 rad",
            "s",
            1.940_783_3,
            2e-4,
            2e-5,
            Box::new(|h| period(2.0, ROTOR, h / 4.0)),
        ),
        case(
            "hinge-drive",
            "angle 0.1 s after 12 V on a winding",
            "rad",
            driven(0.1)[0],
            5e-4,
            1e-5,
            Box::new(|h| at(&motor(), h, 0.1, "angle")),
        ),
        case(
            "hinge-drive",
            "torque 5 ms after 12 V on a winding",
            "N·m",
            driven(0.005)[1],
            5e-4,
            1e-2,
            Box::new(|h| at(&motor(), h, 0.005, "effort")),
        ),
        case(
            "hinge-servo",
            "angle 0.1 s after 3 rad/s, bound 0.8 N·m",
            "rad",
            bounded(0.1),
            1e-3,
            1e-4,
            Box::new(|h| {
                let drive = "mode = \"velocity\"\nkd = 0.4\nmost = 0.8\nvalue = \"3 rad/s\"";
                at(&wheel(drive, ""), h, 0.1, "angle")
            }),
        ),
        case(
            "coupling",
            "frequency of a mesh of 3 : 1, 25 kN·m/rad",
            "Hz",
            (25e3_f64 * (1.0 + 1.0 / 0.09)).sqrt() / std::f64::consts::TAU,
            1e-4,
            1e-5,
            Box::new(|h| {
                let mut pair = instance(&couplings::driven(""), h, "f64");
                1.0 / couplings::period(&mut pair, "load", -30.0 / 1.09, 40)
            }),
        ),
        case(
            "coupling",
            "rate of its output 1 s after 10 N·m",
            "rad/s",
            30.0 / 1.09,
            1e-4,
            1e-6,
            Box::new(|h| at(&couplings::driven("damping = 40"), h, 1.0, "rate_output")),
        ),
        case(
            "coupling",
            "place of a rack after falling 0.5 s",
            "m",
            -0.125 * G * 2.0 / 7.0,
            1e-4,
            1e-4,
            Box::new(|h| at(&couplings::rack(), h, 0.5, "rack.z")),
        ),
    ]
}

/// Every value is reached, and the page has the table.
#[test]
fn elements_reach_their_values() {
    let mut rows = Vec::new();
    let mut off = String::new();
    let further = [
        contacts::cases(),
        mounts::cases(),
        soft::cases(),
        winches::cases(),
        shaft::cases(),
        axes::cases(),
        loaded::cases(),
        vec![gravity::case()],
        driven::cases(),
    ];
    for case in cases().into_iter().chain(further.into_iter().flatten()) {
        let steps = [case.step, case.step / 2.0, case.step / 4.0];
        let found = steps.map(|step| (case.found)(step));
        let errors = found.map(|found| (found - case.exact).abs());
        let relative = errors[2] / case.exact.abs();
        if relative.is_nan() || relative > case.near {
            let _ = writeln!(off, "{}, {}: {found:?}, not {}", case.element, case.what, case.exact);
        }
        let micro = |step: f64| format!("{} µs", significant(step * 1e6, 3));
        rows.push(vec![
            format!("`{}`", case.element),
            case.what.to_owned(),
            format!("{} {}", significant(case.exact, 7), case.unit),
            micro(case.step),
            significant(errors[0], 2),
            significant(errors[1], 2),
            significant(errors[2], 2),
        ]);
    }
    assert!(off.is_empty(), "{off}");
    let head = ["element", "value", "exact", "h", "error at h", "at h/2", "at h/4"];
    block("docs/elements.md", "values", &table(&head, &rows));
}
