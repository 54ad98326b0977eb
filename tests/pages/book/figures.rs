//! Figures of the book, and the tables beside them.
//!
//! `short runs of the kernel => docs/pictures/*.svg, blocks`. With `DBD_BLESS=1` they are written.

use dbd_kernel::{
    Dbd, F32, F64, Geometry, Leapfrog, Pefrl, Plant, Rk4, Scheme, SemiImplicitEuler, State,
    frequency,
};
use dbd_report::picture::Paper;
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::{block, figure, file, grouped, table};
use dbd_tests::results::{cost, path, rows};
use dbd_tests::{distance, scene};
use host_sim::commands::picture::picture;
use plotters::prelude::SeriesLabelPosition;

use crate::book::chart::{Axis, COLOURS, Curve, svg};
use crate::book::measures::{SAMPLES, deviation, error, growth, states};

/// Compares a picture with what was drawn, or writes it.
pub fn drawn(name: &str, svg: &str) {
    file(&format!("docs/pictures/{name}.svg"), svg, "cargo test -p dbd-tests --test pages book");
}

fn example(file: &str) -> Scene {
    Scene::load(path("docs/examples").join(file)).unwrap()
}

fn curve(name: &'static str, colour: usize, points: Vec<(f64, f64)>) -> Curve {
    Curve { name, points, colour: COLOURS[colour], dashed: false }
}

#[test]
fn six_springs_are_a_hinge() {
    let (hinge, springs) = (example("method/hinge.toml"), example("method/six-springs.toml"));
    let end = |scene: &Scene| {
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
        plant.advance(1_000).unwrap();
        plant.state().bodies.to_vec()
    };
    let (joint, written) = (end(&hinge), end(&springs));
    assert!(joint[0].position.y < -0.01, "it swings");
    assert!(distance(&joint, &written) < 1e-12, "{:e}", distance(&joint, &written));
    drawn("six-springs", &picture(&springs, Paper::File));
}

#[test]
fn the_figure_of_growth_is_what_steps_do() {
    fn of<S: Scheme>(scheme: S) -> Vec<(f64, f64)> {
        (1..=340).map(|i| f64::from(i) * 0.01).map(|z| (z, growth(scheme, z))).collect()
    }
    let curves = [
        curve("leapfrog, dbd", 1, of(Leapfrog)),
        curve("dbd, one Newton iteration", 0, of(Dbd { newton: 1 })),
        curve("rk4", 3, of(Rk4)),
        curve("pefrl", 2, of(Pefrl)),
    ];
    // One curve stands for both.
    for (a, b) in of(Leapfrog).iter().zip(of(Dbd { newton: 0 })) {
        assert!((a.1 - b.1).abs() < 1e-9, "{a:?} {b:?}");
    }
    let x = Axis { label: "z = ω·h", range: 0.0..3.4, logarithmic: false };
    let y = Axis { label: "growth per step", range: 0.1..1.4, logarithmic: false };
    drawn("stability", &svg(&x, &y, &curves, SeriesLabelPosition::LowerLeft));
}

#[test]
fn the_figure_of_energy_is_what_runs_give() {
    let scene = scene("four-bar");
    let runs = [
        ("`dbd`", deviation(&scene, Dbd { newton: 0 }, 2e-5, 250, 100)),
        ("`rk4`", deviation(&scene, Rk4, 2e-5, 250, 100)),
        ("`leapfrog`", deviation(&scene, Leapfrog, 2e-5, 250, 100)),
        ("`pefrl`", deviation(&scene, Pefrl, 2e-5, 250, 100)),
    ];
    let names = ["dbd", "rk4", "leapfrog", "pefrl"];
    let colours = [0, 3, 1, 2];
    let curves: Vec<Curve> = (0..4)
        .map(|i| {
            curve(names[i], colours[i], runs[i].1.iter().map(|&(t, e)| (1e3 * t, e)).collect())
        })
        .collect();
    let x = Axis { label: "time [ms]", range: 0.0..500.1, logarithmic: false };
    let y = Axis { label: "|E − E(0)| [J]", range: 1e-6..1e3, logarithmic: true };
    drawn("energy", &svg(&x, &y, &curves, SeriesLabelPosition::UpperRight));
    let most = |part: &[(f64, f64)]| figure(part.iter().map(|(_, e)| *e).fold(0.0, f64::max), 2);
    let rows = runs.iter().map(|(name, run)| {
        let (first, last) = run.split_at(run.len() / 2);
        vec![(*name).to_owned(), most(first), most(last)]
    });
    let head = ["four-bar, h = 20 µs, f64", "0 to 0.25 s, at most [J]", "0.25 to 0.5 s [J]"];
    block("docs/method.md", "energy", &table(&head, &rows.collect::<Vec<_>>()));
}

/// Errors over the step of a scheme in a precision.
struct Errors<'s> {
    scene: &'s Scene,
    reference_solution: Vec<State<SceneModel<F64>>>,
}

/// \[s\] how much of a motion is compared.
const WINDOW: f64 = 0.1;

impl<'s> Errors<'s> {
    fn new(scene: &'s Scene) -> Self {
        // PEFRL is of order 4: far below what any run shows.
        Self { scene, reference_solution: states::<F64, _>(scene, Pefrl, 100_000, WINDOW) }
    }

    /// (step, error) \[µs, µm\] for so many steps each; what fails or is lost is left out.
    fn over_steps<P: Geometry, S: Scheme>(&self, scheme: S, counts: &[u64]) -> Vec<(f64, f64)> {
        let of = |&steps: &u64| {
            let error = self.off::<P, S>(scheme, steps)?;
            (error < 0.1).then_some((1e6 * WINDOW / steps as f64, 1e6 * error))
        };
        counts.iter().filter_map(of).collect()
    }

    fn off<P: Geometry, S: Scheme>(&self, scheme: S, steps: u64) -> Option<f64> {
        error::<P>(&states::<P, S>(self.scene, scheme, steps, WINDOW), &self.reference_solution)
    }
}

/// Numbers of steps of the window, each about 1.4 times the one before.
fn ladder(least: u64, rungs: i32) -> Vec<u64> {
    let of = |rung| (least as f64 * 2_f64.powf(0.5 * f64::from(rung)) / SAMPLES as f64).round();
    (0..rungs).map(|rung| of(rung) as u64 * SAMPLES).collect()
}

/// The largest distance \[m\] of a body of the four-bar from the truth over 0.1 s at 100,000 force
/// evaluations per second: leapfrog in f32 and f64, pefrl in f64.
pub fn at_equal_cost() -> [f64; 3] {
    let scene = scene("four-bar");
    let errors = Errors::new(&scene);
    let steps = (100_000.0 * WINDOW) as u64;
    [
        errors.off::<F32, _>(Leapfrog, steps),
        errors.off::<F64, _>(Leapfrog, steps),
        errors.off::<F64, _>(Pefrl, steps / 4),
    ]
    .map(Option::unwrap)
}

#[test]
fn the_figures_of_steps_are_what_runs_give() {
    let scene = scene("six-bar");
    let errors = Errors::new(&scene);
    let counts = ladder(1_000, 13);
    // Shorter steps of pefrl leave less than the chart shows.
    let long = &counts[..9];
    let curves = [
        curve("dbd", 0, errors.over_steps::<F64, _>(Dbd { newton: 0 }, &counts)),
        curve("leapfrog", 1, errors.over_steps::<F64, _>(Leapfrog, &counts)),
        curve("rk4", 3, errors.over_steps::<F64, _>(Rk4, &counts)),
        curve("pefrl", 2, errors.over_steps::<F64, _>(Pefrl, long)),
    ];
    let x = || Axis { label: "step h [µs]", range: 1.0..100.0, logarithmic: true };
    let y = || Axis { label: "off by at most [µm]", range: 1e-6..1e4, logarithmic: true };
    drawn("steps", &svg(&x(), &y(), &curves, SeriesLabelPosition::UpperLeft));
    // The lines are as steep as the schemes' orders say.
    for (curve, order) in curves.iter().zip([1.0, 2.0, 4.0, 4.0]) {
        let middle = curve.points.len() / 2;
        let [(h, e), (k, f)] = [curve.points[middle - 2], curve.points[middle + 2]];
        let steep = (e / f).ln() / (h / k).ln();
        assert!((steep - order).abs() < 0.3, "{}: {steep}", curve.name);
    }
    let single =
        |name, colour, points| Curve { name, points, colour: COLOURS[colour], dashed: true };
    let [_, leapfrog, _, pefrl] = curves;
    let curves = [
        Curve { name: "leapfrog, f64", ..leapfrog },
        single("leapfrog, f32", 1, errors.over_steps::<F32, _>(Leapfrog, &counts)),
        Curve { name: "pefrl, f64", ..pefrl },
        single("pefrl, f32", 2, errors.over_steps::<F32, _>(Pefrl, &counts)),
    ];
    drawn("precision", &svg(&x(), &y(), &curves, SeriesLabelPosition::LowerLeft));
}

/// How stiffness makes the step: the four-bar with joints of other stiffness.
#[test]
fn steps_shrink_with_the_root_of_stiffness() {
    let text = dbd_tests::scene_text("four-bar");
    let rows = ["9e4", "9e5", "9e6", "9e7", "9e8"].map(|stiffness| {
        let changed = text.replace("stiffness = 9e6", &format!("stiffness = {stiffness}"));
        let scene = Scene::parse(&changed, "four-bar.toml").unwrap();
        let plant = Plant::new(&scene.model, SemiImplicitEuler, 1e-6).unwrap();
        let bound = frequency::bound(plant.model(), plant.state());
        let hertz = bound / std::f64::consts::TAU;
        vec![
            stiffness.to_owned(),
            grouped(&format!("{hertz:.0}")),
            figure(1e6 / bound, 2),
            figure(1e6 * 2.0 / bound, 2),
        ]
    });
    let head =
        ["stiffness of each spring [N/m]", "highest frequency ≤ [Hz]", "1/ω [µs]", "2/ω [µs]"];
    block("docs/step.md", "stiffness", &table(&head, &rows));
}

/// What a precision is, and what it costs.
#[test]
fn precisions_are_as_measured() {
    let timing = rows("docs/results/timing.csv");
    // Fixed point has no digits but places after the point.
    let rows =
        [("f32", "24", 23), ("fixed", "–", 57), ("f64", "53", 52)].map(|(name, digits, bits)| {
            let spacing = 2_f64.powi(-bits);
            let wanted = [("scene", "four-bar"), ("scheme", "leapfrog"), ("precision", name)];
            let time = timing
                .iter()
                .find(|row| row.is(&wanted))
                .map(|row| grouped(row.text("ns_per_step")));
            let counted = cost("four-bar", "leapfrog", name);
            vec![
                format!("`{name}`"),
                digits.to_owned(),
                figure(spacing, 2),
                figure(9e6 * spacing, 2),
                time.unwrap_or_else(|| "–".to_owned()),
                grouped(counted.text("instructions_mean")),
                grouped(counted.text("plant_ram_bytes")),
            ]
        });
    let head = [
        "precision",
        "binary digits",
        "neighbours at 1 m are apart by [m]",
        "which is, at 9 MN/m [N]",
        "PC [ns per step]",
        "Cortex-M4F [instructions]",
        "plant [bytes]",
    ];
    block("docs/precision.md", "precisions", &table(&head, &rows));
}
