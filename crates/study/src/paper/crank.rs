//! Section 4.4: the crank-slider.

use std::f64::consts::PI;

use dbd_kernel::{F64, State};
use dbd_plant::{AnyPlant, SchemeName, plant};
use dbd_scene::{Scene, SceneModel};

use crate::paper::context::{Context, PaperError, dbd, place, scheme};
use crate::paper::drift::{self, Drift, drift};
use crate::paper::finding::{APPROXIMATE, Curve, Finding, Plot, Row, Tolerance, assumptions};

/// \[s\] the torque ends, the run ends.
const TORQUE_ENDS: f64 = 2.0;
const ENDS: f64 = 10.0;

/// \[s\] between samples, and steps within.
const INTERVAL: f64 = 5e-4;
const STEPS: u64 = 20;

/// Intervals over which an acceleration is a mean.
const WITHIN: usize = 10;

/// Section 4.4.1.
const ENERGY: f64 = 1.8;
const SPEED: f64 = 30.0;
const FORCE: f64 = 150.0;
const OFFSET: f64 = 9.5e-6;
const ROTATION: f64 = 1e-8;
const RATE: f64 = 0.8e-3;

/// Section 4.4.2: rate \[J/s\] on the plateau, step \[s\], frequency \[Hz\].
const PLATEAU: [f64; 2] = [5e-3, 7e-3];
const STEP: f64 = 33.8e-6;

/// Data of a run.
struct Run {
    /// Time \[s\] and energy \[J\].
    energies: Vec<[f64; 2]>,
    /// \[rad/s\] of the crank.
    speeds: Vec<f64>,
    /// \[m/s\] of the slider along its axis.
    velocities: Vec<f64>,
    /// \[m\] of the slider from its axis.
    offsets: Vec<f64>,
    /// \[rad\] of the slider about its axis.
    rotations: Vec<f64>,
    /// \[rad\] of the crank, folded to half a revolution.
    angles: Vec<f64>,
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt()
}

fn turn_about_z(state: &State<SceneModel<F64>>, body: usize) -> f64 {
    let [w, _, _, z] = state.bodies[body].orientation.to_f64();
    (2.0 * z.atan2(w)).rem_euclid(PI)
}

fn run(scene: &Scene, plant: &mut dyn AnyPlant) -> Result<Run, PaperError> {
    let (crank, slider) = (place(scene, "crank")?, place(scene, "slider")?);
    let mut run = Run {
        energies: vec![[0.0, plant.energy().total()]],
        speeds: Vec::new(),
        velocities: Vec::new(),
        offsets: Vec::new(),
        rotations: Vec::new(),
        angles: Vec::new(),
    };
    let start = plant.state().bodies[slider].position;
    while plant.time() < ENDS - 0.5 * INTERVAL {
        if plant.advance(STEPS).is_err() {
            break;
        }
        let state = plant.state();
        let body = &state.bodies[slider];
        let energy = plant.energy();
        // The load's potential is that of a rotating torque: only the energy of bodies and springs counts.
        run.energies.push([plant.time(), energy.total() - energy.load]);
        run.speeds.push(state.bodies[crank].angular_velocity.z.abs());
        run.velocities.push(body.velocity.x);
        let aside = body.position - start;
        run.offsets.push(aside.y.hypot(aside.z));
        run.rotations.push(2.0 * body.orientation.to_f64()[1]);
        run.angles.push(turn_about_z(&state, crank));
    }
    Ok(run)
}

/// Section 4.4.1.
pub(super) fn motion(context: &Context<'_>) -> Result<Finding, PaperError> {
    let scene = context.scene("crank-slider")?;
    let mut plant = plant(&scene, &dbd(0)?, INTERVAL / STEPS as f64)?;
    let run = run(&scene, plant.as_mut())?;
    let at = |time: f64| ((time / INTERVAL).round() as usize).min(run.energies.len() - 1);
    let put_in = run.energies[at(TORQUE_ENDS + INTERVAL)][1] - run.energies[0][1];
    let peak = run.speeds.iter().copied().fold(0.0, f64::max);
    let mean = run.speeds.iter().sum::<f64>() / run.speeds.len() as f64;
    let mass = scene.model.bodies[place(&scene, "slider")?].mass;
    let over = |n: usize| n as f64 * INTERVAL;
    let changes = run.velocities.windows(WITHIN + 1).map(|v| (v[WITHIN] - v[0]).abs());
    let force = mass / over(WITHIN) * changes.fold(0.0, f64::max);
    let lost = drift::of(&run.energies[at(TORQUE_ENDS + INTERVAL)..]).map_or(f64::NAN, |d| d.rate);
    let near = Tolerance { within: 0.1, factor: 3.0 };
    let rotation = rms(&run.rotations);
    let rows = vec![
        Row::compared("energy put in", "J", ENERGY, put_in, near),
        Row::compared("mean speed of the crank over 10 s", "rad/s", SPEED, mean, near)
            .noted("the 30 rad/s read as the mean"),
        Row::compared(
            "peak speed of the crank",
            "rad/s",
            SPEED,
            peak,
            Tolerance { within: 0.1, factor: 1.2 },
        )
        .noted(
            "1.8 J by 0.05 N·m are 36 rad in 2 s from rest: 36 rad/s at the end on average, more at the dead centres",
        ),
        Row::compared("largest force on the slider along its axis", "N", FORCE, force, near)
            .noted("mass times mean acceleration over 5 ms; the joints' vibration is part of it"),
        Row::compared("RMS offset of the slider from its axis", "m", OFFSET, rms(&run.offsets), APPROXIMATE),
        Row::open(
            "RMS rotation of the slider about its axis",
            "rad",
            Some(ROTATION),
            Some(rotation),
            "it measures how far the guide's points are from mirror images of each other, and the text does not give them",
        ),
        Row::claim(
            "Energy loss per second is three orders of magnitude below the energy put in",
            lost.abs() < 1e-3 * put_in,
            format!("{:.3} mJ/s; the paper has {:.1} mJ/s", 1e3 * lost, 1e3 * RATE),
        ),
    ];
    Ok(Finding {
        assumptions: assumptions(&[
            "The crank is upright at the start and gravity points along −y: of the poses tried, the one that takes up the paper's energy.",
            "Joints of 0.476 MN/m, dbd without iterations, 25 µs.",
        ]),
        rows,
        ..Finding::default()
    })
}

/// Fig. 19.
pub(super) fn dead_centres(context: &Context<'_>) -> Result<Finding, PaperError> {
    /// \[rad\] about a dead centre.
    const NEAR: f64 = 10.0 * PI / 180.0;
    let scene = context.scene("crank-slider")?;
    let mut plant = plant(&scene, &dbd(0)?, INTERVAL / STEPS as f64)?;
    let run = run(&scene, plant.as_mut())?;
    let from = (TORQUE_ENDS / INTERVAL) as usize + 2;
    let (mut near, mut far) = (Vec::new(), Vec::new());
    for n in from..run.angles.len() {
        let change = run.energies[n + 1][1] - run.energies[n][1];
        let angle = run.angles[n];
        if (NEAR..=PI - NEAR).contains(&angle) { far.push(change) } else { near.push(change) }
    }
    let ratio = rms(&near) / rms(&far);
    let points: Vec<[f64; 2]> = (from..run.angles.len())
        .step_by(7)
        .map(|n| {
            let change = run.energies[n + 1][1] - run.energies[n][1];
            [run.angles[n].to_degrees(), 1e6 * change.abs().max(1e-12)]
        })
        .collect();
    let rows = vec![
        Row::open(
            "step size of ADAMS over the crank's angle",
            "",
            None,
            None,
            "an adaptive controller's steps are in the figure alone",
        ),
        Row::claim(
            "DBD is insensitive to dead centres: one constant step runs through all of them",
            run.energies.len() as f64 * INTERVAL >= ENDS,
            format!("{} samples of {INTERVAL} s to the end", run.energies.len()),
        ),
        Row::claim(
            "Energy changes near dead centres are those of elsewhere",
            ratio < 3.0,
            format!(
                "RMS change in {INTERVAL} s within 10° of a dead centre over the rest: {ratio:.2}"
            ),
        ),
    ];
    let plots = vec![Plot {
        name: String::new(),
        title: "Change of energy over the crank's angle, constant step of 25 µs".into(),
        axes: ["crank angle [°], folded to half a turn".into(), "|ΔE| in 0.5 ms [µJ]".into()],
        logarithmic: [false, true],
        curves: vec![Curve { name: "dbd".into(), paper: false, line: false, points }],
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&["As crank-slider."]),
        rows,
        plots,
        ..Finding::default()
    })
}

/// Fig. 20.
pub(super) fn plateau(context: &Context<'_>) -> Result<Finding, PaperError> {
    const STEPS: [f64; 8] = [80e-6, 62.5e-6, 50e-6, STEP, 25e-6, 20e-6, 10e-6, 4e-6];
    let scene = context.scene("crank-slider")?.with("joint.*.stiffness=4e5")?;
    let free = [TORQUE_ENDS + 1e-3, ENDS];
    let methods = [
        ("dbd, N = 0", dbd(0)?),
        ("dbd, N = 1", dbd(1)?),
        ("leapfrog", scheme(SchemeName::Leapfrog)?),
    ];
    let mut curves = Vec::new();
    let mut found: Vec<Vec<(f64, Option<Drift>)>> = Vec::new();
    for (name, method) in &methods {
        let mut drifts = Vec::new();
        for step in STEPS {
            drifts.push((step, drift(&scene, method, step, free)?));
        }
        let points = drifts
            .iter()
            .filter_map(|(step, drift)| Some([*step, drift.as_ref()?.rate.abs()]))
            .filter(|[_, rate]| *rate > 0.0)
            .collect();
        curves.push(Curve { name: (*name).into(), paper: false, line: true, points });
        found.push(drifts);
    }
    let at = |method: usize, step: f64| {
        let found = found[method].iter().find(|(of, _)| *of == step);
        found.and_then(|(_, drift)| drift.as_ref()).map(|drift| drift.rate)
    };
    let middle = 0.5 * (PLATEAU[0] + PLATEAU[1]);
    let mut rows = Vec::new();
    for (method, name) in ["dbd, N = 0", "dbd, N = 1"].into_iter().enumerate() {
        match at(method, STEP) {
            Some(rate) => {
                let quantity = format!("rate of energy loss at 33.8 µs, {name}");
                let row = Row::compared(quantity, "J/s", middle, rate.abs(), APPROXIMATE);
                rows.push(row.noted("33.8 µs are the paper's 1/((2π)²·750 Hz)"));
            }
            None => rows.push(Row::claim(
                format!("{name} runs at 33.8 µs"),
                false,
                "the run fails: its energy grows without bound",
            )),
        }
    }
    let plateau: Vec<f64> = [50e-6, STEP, 25e-6, 20e-6, 10e-6]
        .iter()
        .filter_map(|step| at(0, *step))
        .map(f64::abs)
        .collect();
    let (low, high) = plateau
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(low, high), rate| (low.min(*rate), high.max(*rate)));
    rows.push(Row::claim(
        "The rate hardly depends on the step from 10 to 50 µs",
        plateau.len() == 5 && high < 10.0 * low,
        format!(
            "without iterations from {:.2e} to {:.2e} J/s, all below the paper's {middle} J/s: {}",
            low,
            high,
            high < middle
        ),
    ));
    curves.push(Curve {
        name: "paper: plateau of 5 to 7 mJ/s at 33.8 µs".into(),
        paper: true,
        line: true,
        points: PLATEAU.map(|rate| [STEP, rate]).into(),
    });
    let plots = vec![Plot {
        name: String::new(),
        title: "Rate of energy change over the step".into(),
        axes: ["step [s]".into(), "|rate of energy change| [J/s]".into()],
        logarithmic: [true, true],
        curves,
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&[
            "Joints of 0.4 MN/m, otherwise as crank-slider; the rate is the slope of a straight line through the energy from the torque's end to 10 s.",
            "The paper's horizontal axis is simulation time over real time: the step times a constant.",
        ]),
        rows,
        plots,
        ..Finding::default()
    })
}
