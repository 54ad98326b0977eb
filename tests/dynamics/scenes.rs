//! Every scene that ships: counts, a run over its duration, its energy band.
//!
//! The band is the largest deviation of the total energy from its value once the last load or
//! table has ended, over the largest kinetic energy from then on; of a damped scene the largest
//! rise, for dampers may only take, over the largest kinetic energy of the run. Bounds are three
//! times the figure measured when the row was written; the present figures stand in
//! `docs/schemes.md`.

use std::collections::BTreeSet;

use dbd_kernel::energy::energy;
use dbd_kernel::{F32, F64, Geometry, Leapfrog, Plant};
use dbd_scene::{Scene, SceneModel, widen};
use dbd_tests::page::{block, table};
use dbd_tests::{scene, scene_names};

/// Counts of a scene and its energy bands, f64 and f32.
struct Row {
    name: &'static str,
    bodies: usize,
    tsdas: usize,
    damped: bool,
    f64: f64,
    f32: f64,
}

const fn row(name: &'static str, bodies: usize, tsdas: usize, f64: f64, f32: f64) -> Row {
    Row { name, bodies, tsdas, damped: false, f64, f32 }
}

const fn damped(name: &'static str, bodies: usize, tsdas: usize, f64: f64, f32: f64) -> Row {
    Row { name, bodies, tsdas, damped: true, f64, f32 }
}

/// Leapfrog at the scene's step. In f64 the band is that of the modified Hamiltonian, (ω·h)²
/// times the energy in the joints' vibration, so it is largest where a preload is let go
/// against stiff joints (five-bar-a, 3rrr-2) and least where gravity acts softly (hexagon,
/// chains). In f32 rounding adds 1e-5 to 1e-4 of the kinetic energy, whatever the step, and more
/// in the longest run, the crank-slider's 400,000 steps, and in the gentlest, the hanging chain's
/// 50,000 with 0.3 J of kinetic energy in all.
const SCENES: &[Row] = &[
    row("3rrr", 7, 54, 3.1e-5, 1.1e-4),
    row("3rrr-1", 6, 48, 4.2e-5, 1.1e-4),
    row("3rrr-2", 5, 42, 1.5e-4, 1.6e-4),
    row("3ruu", 13, 90, 1.7e-5, 6.1e-5),
    row("3ruu-1", 12, 84, 1.2e-5, 1.7e-4),
    row("3ruu-2", 11, 78, 1.2e-5, 9.7e-5),
    damped("cart-pendulum", 2, 14, 1e-9, 2.2e-8),
    row("chain-closed", 10, 66, 1.1e-7, 1.1e-4),
    row("chain-open-30", 10, 60, 1.3e-9, 3.5e-5),
    row("chain-open-60", 10, 60, 1.1e-9, 8.2e-6),
    row("crank-slider", 4, 29, 4.1e-7, 5.8e-4),
    damped("delta-pick-and-place", 13, 90, 1e-9, 8.4e-6),
    damped("double-wishbone", 4, 38, 1e-9, 6.7e-7),
    row("five-bar-a", 4, 30, 3.2e-4, 3.2e-4),
    row("five-bar-b", 4, 30, 3.8e-5, 9.7e-5),
    row("four-bar", 3, 24, 6.5e-5, 2.9e-4),
    damped("gripper", 8, 70, 1e-9, 7.6e-8),
    row("gyroscope", 1, 3, 1.2e-8, 1.4e-5),
    row("hanging-chain", 20, 60, 7.7e-7, 1.4e-3),
    row("hexagon", 5, 36, 2.1e-8, 9.1e-6),
    damped("macpherson", 20, 154, 1e-9, 1e-8),
    row("six-bar", 5, 36, 4.3e-5, 8.1e-5),
    row("spring-ball", 1, 1, 7.3e-5, 7.8e-5),
    row("three-systems", 31, 222, 1.1e-4, 2.6e-4),
    row("two-3ruu", 26, 180, 1.7e-5, 4.6e-5),
];

#[test]
fn the_table_lists_every_scene_that_ships() {
    let shipped = BTreeSet::from_iter(scene_names());
    let listed: BTreeSet<String> = SCENES.iter().map(|row| row.name.to_owned()).collect();
    assert_eq!(shipped, listed);
}

#[test]
fn counts_are_those_of_the_table() {
    for row in SCENES {
        let scene = scene(row.name);
        let counts = (scene.model.bodies.len(), scene.model.tsda_count());
        assert_eq!(scene.name, row.name);
        assert_eq!(counts, (row.bodies, row.tsdas), "{}", row.name);
        assert!(!scene.description.is_empty(), "{}", row.name);
        for joint in &scene.joints {
            assert!(joint.assembly_error < 1e-12, "{}: {joint:?}", row.name);
        }
    }
}

/// The energy band of a whole run, or its largest rise.
fn band<P: Geometry>(scene: &Scene, damped: bool) -> f64 {
    let model: SceneModel<P> = scene.model.convert();
    let exact: SceneModel<F64> = model.convert();
    let h = scene.step.unwrap();
    let steps = (scene.duration / h).round() as u64;
    let loads = scene.model.loads.iter().map(|load| load.until);
    let knots = scene.model.knots.iter().map(|knot| knot.time);
    let driven = loads.chain(knots).fold(0.0, f64::max);
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let (mut start, mut worst, mut kinetic) = (None, 0.0_f64, 0.0_f64);
    for n in 0..=steps {
        if n % 10 == 0 {
            let now = energy(&exact, &widen(plant.state()), h);
            let free = plant.time() >= driven;
            if free || damped {
                kinetic = kinetic.max(now.kinetic);
            }
            if free {
                let start = start.get_or_insert(now.total());
                if damped {
                    worst = worst.max(now.total() - *start);
                    *start = start.min(now.total());
                } else {
                    worst = worst.max((now.total() - *start).abs());
                }
            }
        }
        if n < steps {
            plant.step().unwrap_or_else(|failure| panic!("{}: {failure}", scene.name));
        }
    }
    worst / kinetic
}

#[test]
fn every_scene_runs_and_keeps_its_energy() {
    // Two at a time: the runs in either precision.
    let [in_f64, in_f32]: [Vec<f64>; 2] = std::thread::scope(|scope| {
        let of = |band: fn(&Scene, bool) -> f64| {
            let bands = move |row: &Row| band(&scene(row.name), row.damped);
            scope.spawn(move || SCENES.iter().map(bands).collect())
        };
        [of(band::<F64>), of(band::<F32>)].map(|bands| bands.join().unwrap())
    });
    let (mut failed, mut rows) = (Vec::new(), Vec::new());
    for (row, bands) in SCENES.iter().zip(in_f64.into_iter().zip(in_f32)) {
        let kind = if row.damped { "rise" } else { "band" };
        // Below this a damped scene's rise is rounding of the sums alone.
        let shown = |band: f64| if band < 1e-9 { "< 1e-9".into() } else { format!("{band:.1e}") };
        rows.push(vec![format!("`{}`", row.name), kind.into(), shown(bands.0), shown(bands.1)]);
        for (name, band, figure) in [("f64", bands.0, row.f64), ("f32", bands.1, row.f32)] {
            let within = band < 3.0 * figure && (name == "f32" || band < 1e-3);
            if !within {
                failed.push(format!("{} {name}: {band:.2e}, was {figure:.1e}", row.name));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
    block(
        "docs/schemes-measured.md",
        "energies",
        &table(&["scene", "energy", "f64", "f32"], &rows),
    );
}
