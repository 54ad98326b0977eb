//! What the page on near-rigid joints shows: accuracy against cost beside explicit schemes, and energies.

use dbd_kernel::energy::energy;
use dbd_kernel::frequency::bound;
use dbd_kernel::{F64, GeneralizedAlpha, Leapfrog, Pefrl, Plant, Scheme, State};
use dbd_scene::SceneModel;
use dbd_study::costs::Costs;
use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::rows;
use dbd_tests::{run, scene};

/// \[s\] between two samples, and how many there are.
const EVERY: f64 = 0.01;
const SAMPLES: u64 = 10;

/// \[m\] errors that are asked for.
const LEVELS: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// \[N/m\], and what 5 % of damping is of a kilogram on it \[N·s/m\].
const STIFF: [&str; 2] = ["joint.*.stiffness=9e8", "joint.*.damping=3000"];

/// \[s\] the step where joints are shaken for ever.
const SHAKEN: f64 = 1e-5;

type Samples = Vec<[f64; 3]>;

/// A scene with joints of 9e8 N/m, without dampers or with.
fn stiff(name: &str, damped: bool) -> SceneModel<F64> {
    let stiff = scene(name).with(STIFF[0]).unwrap();
    let stiff = if damped { stiff.with(STIFF[1]).unwrap() } else { stiff };
    stiff.model.planned()
}

/// Positions at the samples with `n` steps between two of them; `None` where it fails.
fn positions<S: Scheme>(model: &SceneModel<F64>, scheme: S, n: u64) -> Option<Samples> {
    let mut plant = Plant::new(model, scheme, EVERY / n as f64).ok()?;
    let mut samples = Samples::new();
    for _ in 0..SAMPLES {
        if plant.advance(n).is_err() {
            return None;
        }
        samples.extend(plant.state().bodies.iter().map(|body| body.position.to_f64()));
    }
    Some(samples)
}

/// \[m\] root mean square of distances.
fn error(of: &Samples, reference_solution: &Samples) -> f64 {
    let square = |(a, b): (&[f64; 3], &[f64; 3])| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    let sum: f64 = of.iter().zip(reference_solution).map(square).sum();
    (sum / reference_solution.len() as f64).sqrt()
}

/// The fewest steps per sample of a ladder, ascending, that stay within each level.
fn fewest<S: Scheme + Default>(
    model: &SceneModel<F64>,
    reference_solution: &Samples,
    ladder: &[u64],
) -> [Option<u64>; 3] {
    let mut found = [None; 3];
    for &n in ladder {
        let off = positions(model, S::default(), n).map(|own| error(&own, reference_solution));
        for (found, level) in found.iter_mut().zip(LEVELS) {
            if found.is_none() && off.is_some_and(|off| off <= level) {
                *found = Some(n);
            }
        }
        if found[2].is_some() {
            break;
        }
    }
    found
}

/// What a halved step divides the difference to the next one by in the slow motion, soft and stiff, without
/// dampers and with 5 % of them: once what the start shook has gone, which ρ∞ = 0 sees to in 0.05 s.
#[test]
fn it_converges_with_order_2_at_every_stiffness() {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (name, calming, step) in [
        ("four-bar", 5e-4, 5e-4),
        ("six-bar", 5e-4, 2.5e-4),
        ("3ruu", 1e-3, 1e-3),
        ("crank-slider", 1e-3, 1e-3),
    ] {
        // Of a kilogram on a spring of the joint 5 % damping.
        for (stiffness, damper) in [("9e6", 300), ("9e8", 3_000)] {
            for damping in [0, damper] {
                // Its fast motion shakes its joints for ever: there a step has to resolve them.
                let shaken = (name, stiffness, damping) == ("six-bar", "9e6", 0);
                let step = if shaken { SHAKEN } else { step };
                let stiff = scene(name).with(&format!("joint.*.stiffness={stiffness}")).unwrap();
                let stiff = stiff.with(&format!("joint.*.damping={damping}")).unwrap();
                let model = stiff.model.planned();
                let calm = GeneralizedAlpha::new(0.0).unwrap();
                let mut start = run(&model, calm, calming, (0.05 / calming).round() as u64);
                start.step = 0;
                let at = |part: u64| {
                    let mut plant =
                        Plant::new(&model, GeneralizedAlpha::DEFAULT, step / part as f64).unwrap();
                    plant.set_state(start.clone()).unwrap();
                    plant.advance((0.05 / step).round() as u64 * part).unwrap();
                    plant.state().bodies.iter().map(|b| b.position.to_f64()).collect::<Samples>()
                };
                let [coarse, middle, fine] = [1, 2, 4].map(at);
                let factor = error(&coarse, &middle) / error(&middle, &fine);
                rows.push(vec![
                    format!("`{name}`"),
                    stiffness.into(),
                    damping.to_string(),
                    figure(step, 2),
                    format!("{factor:.2}"),
                ]);
                assert!((factor - 4.0).abs() < 0.4, "{name} {stiffness} {damping}: {factor}");
            }
        }
    }
    let head = ["scene", "stiffness [N/m]", "damping [N·s/m]", "step [s]", "factor"];
    block("docs/near-rigid.md", "near-rigid orders", &table(&head, &rows));
}

#[test]
fn it_is_cheaper_by_far_where_joints_are_all_but_rigid() {
    let costs = Costs::shipped();
    let count = |name: &str, scheme: &str| {
        costs.instructions_per_step(name, scheme, None, None, "f32", "quaternion").unwrap()
    };
    let ladder: Vec<u64> = (2..30).map(|i| 1.3_f64.powi(i).round() as u64).collect();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut gains = Vec::new();
    for name in ["3ruu", "crank-slider", "six-bar", "four-bar", "3rrr"] {
        let model = stiff(name, false);
        let highest = bound(&model, &State::initial(&model));
        // Explicit ones from beyond their limits on: the bound exceeds the frequency.
        let explicit = |z: &[f64]| -> Vec<u64> {
            z.iter().map(|z| (EVERY * highest / z).ceil() as u64).collect()
        };
        let reference_solution = positions(&model, Pefrl, (EVERY * highest / 0.3) as u64).unwrap();
        let own = fewest::<GeneralizedAlpha>(&model, &reference_solution, &ladder);
        let leapfrog = fewest::<Leapfrog>(
            &model,
            &reference_solution,
            &explicit(&[2.6, 2.3, 2.0, 1.8, 1.4, 1.0, 0.5]),
        );
        let pefrl = fewest::<Pefrl>(
            &model,
            &reference_solution,
            &explicit(&[4.0, 3.5, 3.0, 2.6, 2.0, 1.0]),
        );
        for (i, level) in LEVELS.into_iter().enumerate() {
            let per_second =
                |n: Option<u64>, scheme| n.map(|n| count(name, scheme) * n as f64 / EVERY);
            let own_cost = per_second(own[i], GeneralizedAlpha::NAME);
            let others =
                [per_second(leapfrog[i], Leapfrog::NAME), per_second(pefrl[i], Pefrl::NAME)];
            let best = others.into_iter().flatten().min_by(f64::total_cmp);
            let gain = best.zip(own_cost).map(|(best, own)| best / own);
            gains.extend(gain.map(|gain| ((name, i), gain)));
            let cell = |cost: Option<f64>| cost.map_or("–".into(), |cost| figure(cost, 2));
            let step = own[i].map_or("–".into(), |n| figure(EVERY / n as f64, 2));
            let gain = gain.map_or("–".into(), |gain| figure(gain, 2));
            let [leapfrog, pefrl] = others.map(cell);
            rows.push(vec![
                format!("`{name}`"),
                figure(level, 1),
                step,
                cell(own_cost),
                leapfrog,
                pefrl,
                gain,
            ]);
        }
    }
    let head = [
        "scene",
        "error [m]",
        "its step [s]",
        "`generalized-alpha` [1/s]",
        "`leapfrog` [1/s]",
        "`pefrl` [1/s]",
        "times cheaper",
    ];
    block("docs/near-rigid.md", "near-rigid costs", &table(&head, &rows));
    for (at, least) in [
        (("3ruu", 0), 50.0),
        (("3ruu", 1), 50.0),
        (("crank-slider", 2), 40.0),
        (("six-bar", 0), 5.0),
    ] {
        let gain = gains.iter().find(|(of, _)| *of == at).map(|(_, gain)| *gain);
        assert!(gain.is_some_and(|gain| gain > least), "{at:?}: {gain:?}");
    }
}

/// What it takes to run a minute is that none fails; explicit schemes take steps of microseconds.
#[test]
fn what_a_minute_leaves_of_the_energy() {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let less_damped = GeneralizedAlpha::new(GeneralizedAlpha::MAX_RHO).unwrap();
    for name in [
        "four-bar",
        "five-bar-a",
        "five-bar-b",
        "six-bar",
        "crank-slider",
        "3rrr",
        "3rrr-1",
        "3rrr-2",
        "3ruu",
        "3ruu-1",
        "3ruu-2",
        "hexagon",
        "double-wishbone",
        "macpherson",
    ] {
        let model = stiff(name, false);
        let after = |scheme, step: f64, time: f64| {
            let state = run(&model, scheme, step, (time / step).round() as u64);
            energy(&model, &state, step).total()
        };
        let own = GeneralizedAlpha::DEFAULT;
        let start = energy(&model, &State::initial(&model), 1e-3).total();
        let [long, half] = [1e-3, 5e-4].map(|step| after(own, step, 1.0));
        if name == "four-bar" {
            // Of third order: what swings slowly against the step.
            let ratio = (start - long) / (start - half);
            assert!((7.0..9.0).contains(&ratio), "{ratio}");
        }
        let [minute, other] = [own, less_damped].map(|scheme| after(scheme, 1e-3, 60.0));
        let figures = [start, long, half, minute, other];
        // Leapfrog does not take ten steps of it.
        let mut explicit = Plant::new(&model, Leapfrog, 1e-3).unwrap();
        assert!(explicit.advance(200).is_err(), "{name}");
        let cells = figures.map(|joules| figure(joules, 4));
        rows.push([vec![format!("`{name}`")], cells.to_vec()].concat());
    }
    let head = [
        "energy [J]",
        "at the start",
        "after 1 s",
        "at half the step",
        "after 60 s",
        "with `--rho 0.8`",
    ];
    block("docs/near-rigid.md", "near-rigid energy", &table(&head, &rows));
}

/// At 1 kHz, as `cargo xtask cost` counts it.
#[test]
fn what_a_chip_keeps_up_with() {
    let rows = rows("docs/costs.csv");
    let rows = rows.iter().filter(|row| row.text("scheme") == GeneralizedAlpha::NAME);
    let table_rows: Vec<Vec<String>> = rows
        .filter(|row| row.text("precision") != "f64")
        .map(|row| {
            let [text, data] = ["text_bytes", "rodata_bytes"]
                .map(|column| row.text(column).parse::<f64>().unwrap_or(f64::NAN));
            let image =
                if text.is_nan() { "–".into() } else { figure((text + data) / 1024.0, 2) };
            let ram = row.number("plant_ram_bytes") + row.number("stack_bytes");
            let reached = row.number("estimated_rate_168mhz_hz") / 1e3;
            vec![
                format!("`{}`", row.text("scene")),
                row.text("precision").to_owned(),
                grouped(row.text("instructions_mean")),
                image,
                figure(ram / 1024.0, 2),
                figure(reached, 2),
                if reached >= 1.0 { "yes" } else { "no" }.to_owned(),
            ]
        })
        .collect();
    let head = [
        "scene",
        "precision",
        "instructions per step",
        "code and model [KiB]",
        "plant and stack [KiB]",
        "reaches [kHz]",
        "real time at 1 kHz",
    ];
    block("docs/near-rigid.md", "near-rigid chip", &table(&head, &table_rows));
}
