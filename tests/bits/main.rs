//! Golden bits: the state's hash per scene, scheme, precision, step and number of steps.
//!
//! The table `hashes.csv` is part of the interface, `orientations.csv` holds those of Euler angles,
//! `planar.csv` those of scenes in their plane, `joint-wise.csv` those of damping joint by joint,
//! `fixed.csv` those of fixed point, `generalized-alpha.csv` those of the scheme with a matrix.
//! `DBD_BLESS=golden cargo test -p dbd-bits` writes the present hashes; a changed one needs its
//! reason in the commit.

use std::fmt::Write as _;

use dbd_kernel::euler::{EulerF32, EulerF64, SingleEulerF32, SingleEulerF64};
use dbd_kernel::geometry::{F32, F64, Geometry};
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, Fixed, GeneralizedAlpha, JointWise, Leapfrog, Pefrl,
    Planar32, Planar64, Plant, Rk4, Scheme, SemiImplicitEuler,
};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::golden;
use dbd_tests::{scene, scene_names};

const HEADER: &str = "scene,scheme,precision,step,steps,hash";

/// Steps of every scene, at its own step, and the longer run of one.
const STEPS: u64 = 1_000;
const LONG: (&str, u64) = ("four-bar", 10_000);

/// \[s\] the step of the scheme with a matrix.
const SOLVED: f64 = 1e-3;
const SOLVE: GeneralizedAlpha = GeneralizedAlpha::DEFAULT;

/// What leapfrog is called with its dampers joint by joint.
const JOINT_WISE: &str = "leapfrog-joint-wise";

/// Scenes of all schemes: planar, with torsion springs, with points on lines, in space, damped.
const ALL_SCHEMES: [&str; 5] = ["four-bar", "3rrr", "crank-slider", "3ruu", "double-wishbone"];

/// Compares what is with the golden table, or blesses it.
fn compare(name: &str, present: &str) {
    golden(&format!("tests/bits/{name}"), present, "cargo test -p dbd-bits");
}

fn row<P: Geometry, S: Scheme>(scene: &Scene, scheme: S, steps: u64) -> String {
    row_of::<P, S>(scene, S::NAME, scheme, steps)
}

fn row_of<P: Geometry, S: Scheme>(scene: &Scene, called: &str, scheme: S, steps: u64) -> String {
    row_of_model::<P, S>(scene, &scene.model, called, scheme, steps)
}

fn row_of_model<P: Geometry, S: Scheme>(
    scene: &Scene,
    model: &SceneModel<F64>,
    called: &str,
    scheme: S,
    steps: u64,
) -> String {
    let model: SceneModel<P> = model.convert();
    let step = scene.step.expect("a golden scene states its step");
    let mut plant = Plant::new(&model, scheme, step).unwrap();
    for _ in 0..steps {
        plant.step().ok().unwrap();
    }
    let (name, precision) = (&scene.name, P::NAME);
    format!("{name},{called},{precision},{step:e},{steps},{:016x}", plant.hash())
}

#[test]
fn states_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let mut runs = vec![(LONG.0.to_owned(), LONG.1)];
    runs.extend(scene_names().into_iter().map(|name| (name, STEPS)));
    for (name, steps) in runs {
        let scene = scene(&name);
        for row in [
            row::<F64, _>(&scene, Dbd::default(), steps),
            row::<F32, _>(&scene, Dbd::default(), steps),
            row::<F64, _>(&scene, Leapfrog, steps),
            row::<F32, _>(&scene, Leapfrog, steps),
        ] {
            writeln!(present, "{row}").unwrap();
        }
    }
    for name in ALL_SCHEMES {
        let scene = scene(name);
        macro_rules! rows {
            ($($name:expr => $scheme:expr),*) => {$(
                for row in [
                    row_of::<F64, _>(&scene, $name, $scheme, STEPS),
                    row_of::<F32, _>(&scene, $name, $scheme, STEPS),
                ] {
                    writeln!(present, "{row}").unwrap();
                }
            )*};
        }
        rows!(
            "dbd-newton-1" => Dbd { newton: 1 },
            DbdP1::NAME => DbdP1::default(),
            DbdP2::NAME => DbdP2::default(),
            SemiImplicitEuler::NAME => SemiImplicitEuler,
            Pefrl::NAME => Pefrl,
            BlanesMoanS6::NAME => BlanesMoanS6,
            Rk4::NAME => Rk4
        );
    }
    compare("hashes.csv", &present);
}

/// Of scenes with damped joints: to the ground and between bodies, raw springs, torsion springs, clearances.
#[test]
fn states_of_joint_wise_damping_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    for name in
        ["cart-pendulum", "delta-pick-and-place", "double-wishbone", "gripper", "macpherson"]
    {
        let scene = scene(name);
        for row in [
            row_of::<F64, _>(&scene, JOINT_WISE, JointWise(Leapfrog), STEPS),
            row_of::<F32, _>(&scene, JOINT_WISE, JointWise(Leapfrog), STEPS),
        ] {
            writeln!(present, "{row}").unwrap();
        }
    }
    compare("joint-wise.csv", &present);
}

/// Of all scenes, and of those of all schemes, of the damped one with its dampers in all ways.
#[test]
fn states_in_fixed_point_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let mut runs = vec![(LONG.0.to_owned(), LONG.1)];
    runs.extend(scene_names().into_iter().map(|name| (name, STEPS)));
    for (name, steps) in runs {
        let scene = scene(&name);
        writeln!(present, "{}", row::<Fixed, _>(&scene, Dbd::default(), steps)).unwrap();
        writeln!(present, "{}", row::<Fixed, _>(&scene, Leapfrog, steps)).unwrap();
    }
    for name in ALL_SCHEMES {
        let scene = scene(name);
        macro_rules! rows {
            ($($name:expr => $scheme:expr),*) => {$(
                let row = row_of::<Fixed, _>(&scene, $name, $scheme, STEPS);
                writeln!(present, "{row}").unwrap();
            )*};
        }
        rows!(
            "dbd-newton-1" => Dbd { newton: 1 },
            DbdP1::NAME => DbdP1::default(),
            DbdP2::NAME => DbdP2::default(),
            SemiImplicitEuler::NAME => SemiImplicitEuler,
            Pefrl::NAME => Pefrl,
            BlanesMoanS6::NAME => BlanesMoanS6,
            Rk4::NAME => Rk4
        );
        if !scene.model.dampers.is_empty() {
            rows!(
                "leapfrog-explicit" => Explicit(Leapfrog),
                "leapfrog-joint-wise" => JointWise(Leapfrog)
            );
        }
    }
    compare("fixed.csv", &present);
}

/// Of the paper's mechanisms, of joints without a tangent in closed form, clearances, bushings, inputs and a
/// matrix that is filled.
#[test]
fn states_of_generalized_alpha_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let mut scenes = ALL_SCHEMES.to_vec();
    scenes.extend(["six-bar", "gripper", "cart-pendulum", "delta-pick-and-place", "macpherson"]);
    for name in scenes {
        let mut scene = scene(name);
        scene.step = Some(SOLVED);
        let model = scene.model.clone().planned();
        for row in [
            row_of_model::<F64, _>(&scene, &model, GeneralizedAlpha::NAME, SOLVE, STEPS),
            row_of_model::<F32, _>(&scene, &model, GeneralizedAlpha::NAME, SOLVE, STEPS),
            row_of_model::<Fixed, _>(&scene, &model, GeneralizedAlpha::NAME, SOLVE, STEPS),
        ] {
            writeln!(present, "{row}").unwrap();
        }
    }
    compare("generalized-alpha.csv", &present);
}

/// Of scenes in their plane: pins, a spherical and a universal joint with a guide, dampers.
#[test]
fn states_in_the_plane_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    for name in ["hexagon", "four-bar", "3rrr", "crank-slider", "cart-pendulum"] {
        let scene = scene(name);
        let planar = scene.reduced().unwrap_or_else(|found| panic!("{name}: {found:?}"));
        macro_rules! rows {
            ($($scheme:expr),*) => {$(
                for row in [
                    planar_row::<Planar64, _>(&scene, &planar.model, $scheme),
                    planar_row::<Planar32, _>(&scene, &planar.model, $scheme),
                ] {
                    writeln!(present, "{row}").unwrap();
                }
            )*};
        }
        rows!(Dbd::default(), Leapfrog, Rk4);
    }
    let scene = scene("cart-pendulum");
    let planar = scene.reduced().unwrap_or_else(|found| panic!("{found:?}"));
    for row in [
        row_of_model::<Planar64, _>(&scene, &planar.model, JOINT_WISE, JointWise(Leapfrog), STEPS),
        row_of_model::<Planar32, _>(&scene, &planar.model, JOINT_WISE, JointWise(Leapfrog), STEPS),
    ] {
        writeln!(present, "{row}").unwrap();
    }
    for name in ["hexagon", "six-bar"] {
        let mut scene = dbd_tests::scene(name);
        scene.step = Some(SOLVED);
        let planar = scene.reduced().unwrap_or_else(|found| panic!("{name}: {found:?}"));
        let model = planar.model.clone().planned();
        for row in [
            row_of_model::<Planar64, _>(&scene, &model, GeneralizedAlpha::NAME, SOLVE, STEPS),
            row_of_model::<Planar32, _>(&scene, &model, GeneralizedAlpha::NAME, SOLVE, STEPS),
        ] {
            writeln!(present, "{row}").unwrap();
        }
    }
    compare("planar.csv", &present);
}

fn planar_row<P: Geometry, S: Scheme>(scene: &Scene, model: &SceneModel<F64>, scheme: S) -> String {
    row_of_model::<P, S>(scene, model, S::NAME, scheme, STEPS)
}

#[test]
fn states_of_euler_angles_have_their_golden_hashes() {
    let mut present = "scene,scheme,precision,step,steps,hash,orientation\n".to_owned();
    for name in ["four-bar", "crank-slider", "3ruu"] {
        let scene = scene(name);
        macro_rules! rows {
            ($($geometry:ty),*) => {$(
                for row in [
                    row::<$geometry, _>(&scene, Leapfrog, STEPS),
                    row::<$geometry, _>(&scene, Pefrl, STEPS),
                    row::<$geometry, _>(&scene, Rk4, STEPS),
                ] {
                    let orientation = <$geometry as Geometry>::ORIENTATION;
                    writeln!(present, "{row},{orientation}").unwrap();
                }
            )*};
        }
        rows!(EulerF64, EulerF32, SingleEulerF64, SingleEulerF32);
    }
    compare("orientations.csv", &present);
}
