//! The law `bushing-maxwell`, a spring and a damper in series along each axis, against closed forms.

use dbd_scene::Scene;
use nalgebra::{Complex, Matrix3, Vector3};

use crate::{instance, value};

/// \[N/m\] of the bushing along x.
pub(crate) const STATIC: f64 = 4e3;
/// \[N/m\] of the branch beside it.
pub(crate) const BRANCH: f64 = 6e3;
/// \[s\] relaxation time of the branch.
pub(crate) const TIME: f64 = 0.02;

/// A body of 1 kg and 0.1 kg·m² on a bushing with a branch; as stiff about z as along x.
pub(crate) fn soft(relaxation: f64, branch: f64, more: &str) -> String {
    let at = "between = [\"world\", \"mass\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nx = [1, 0, 0]\nz = [0, 0, 1]";
    let turning = 0.1 * STATIC;
    format!(
        "name = \"soft\"\nduration = 1\n{more}\n[[interaction]]\nlaw = \"bushing\"\n{at}\nstiffness_x = {STATIC}\n\
         stiffness_y = 1e4\nstiffness_z = 1e4\nturn_stiffness_x = 900\nturn_stiffness_y = 900\n\
         turn_stiffness_z = {turning}\n[[interaction]]\nname = \"rubber\"\nlaw = \"bushing-maxwell\"\n{at}\n\
         relaxation = {relaxation}\nstiffness_x = {branch}\nstiffness_y = {branch}\nstiffness_z = {branch}\n\
         turn_stiffness_x = 100\nturn_stiffness_y = 100\nturn_stiffness_z = {}\n",
        0.1 * branch
    )
}

pub(crate) fn body(start: &str) -> String {
    format!(
        "[[body]]\nname = \"mass\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 0, 0]\n{start}\n"
    )
}

/// Place and rate of 1 kg thrown at 1 m/s, and the damper's deflection: a linear system of third order.
pub(crate) fn decayed(time: f64) -> Vector3<f64> {
    #[rustfmt::skip]
    let a = Matrix3::new(
        0.0, 1.0, 0.0,
        -STATIC - BRANCH, 0.0, BRANCH,
        1.0 / TIME, 0.0, -1.0 / TIME,
    );
    (a * time).exp() * Vector3::new(0.0, 1.0, 0.0)
}

/// The complex stiffness under a harmonic force, after the transient: `k·iωτ/(1 + iωτ)`.
#[test]
fn a_branch_has_its_complex_stiffness() {
    for (input, column, size) in [
        ("type = \"force\"\naxis = [1, 0, 0]\nbody = \"mass\"", "mass.x", 1.0),
        ("type = \"force\"\naxis = [0, 0, 1]\nbody = \"mass\"", "mass.z", 1.0),
    ] {
        for (precision, near) in [("f64", 2e-4), ("f32", 1e-3), ("fixed", 1e-3)] {
            for frequency in [2.5, 8.0, 20.0, 32.0] {
                let rate = std::f64::consts::TAU * frequency;
                let text = soft(TIME, BRANCH, &body(""))
                    + &format!(
                        "[[input]]\nname = \"push\"\n{input}\nsine = {{ amplitude = 5, frequency = {frequency} }}\n"
                    );
                let mut plant = instance(&text, 1e-4, precision);
                plant.advance_to(2.0).unwrap();
                // Of whole periods.
                let (periods, count) = ((frequency * 2.0).round(), 20_000);
                let output = plant.output(column).unwrap();
                let mut sum = Complex::new(0.0, 0.0);
                for _ in 0..count {
                    plant.advance(1).unwrap();
                    sum += plant.value(output) * Complex::from_polar(1.0, -rate * plant.time());
                }
                assert!((periods / frequency - 2.0).abs() < 1e-12);
                // x = Im(X·exp(iωt)), so its mean with exp(−iωt) is X/(2i).
                let shift = Complex::new(0.0, 2.0) * sum / f64::from(count);
                let stiff = if column == "mass.z" { 1e4 } else { STATIC };
                let found = Complex::from(5.0) / shift + size * rate * rate - stiff;
                let ratio = Complex::new(0.0, rate * TIME);
                let exact = BRANCH * ratio / (1.0 + ratio);
                let off = (found - exact).norm() / stiff.max(BRANCH);
                assert!(
                    off < near * 5.0,
                    "{precision} {column} {frequency}: {found} {exact} {off:e}"
                );
            }
        }
    }
}

/// The same about an axis, small rotations: the torque of free decay is that of the translation.
#[test]
fn a_rotation_decays_as_a_translation() {
    let exact = decayed(0.05);
    for (precision, near) in [("f64", 1e-5), ("f32", 1e-4), ("fixed", 1e-4)] {
        let turning = body("velocity = [1e-2, 0, 0]\nangular_velocity = [0, 0, 1e-2]");
        let mut plant = instance(&soft(TIME, BRANCH, &turning), 5e-5, precision);
        plant.advance_to(0.05).unwrap();
        for (name, scale) in [("mass.vx", 1e2), ("mass.wz", 1e2)] {
            let found = scale * value(&plant, name);
            assert!((found - exact[1]).abs() < near, "{precision} {name}: {found} {}", exact[1]);
        }
    }
}

/// At any relaxation time and large motions the energy never exceeds that of the start but by the step's error.
#[test]
fn a_branch_takes_energy_at_any_step() {
    let thrown = body("velocity = [2, 1, -1]\nangular_velocity = [20, -30, 25]");
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for relaxation in [1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 10.0, 1e6] {
        for precision in ["f64", "f32"] {
            let mut plant = instance(&soft(relaxation, 2e4, &thrown), 1e-4, precision);
            let start = value(&plant, "energy.total");
            for _ in 0..2000 {
                plant.advance(5).unwrap();
                let now = value(&plant, "energy.total") / start;
                assert!(now < 1.0 + 2e-3, "{relaxation} {precision}: {now}");
            }
            let end = value(&plant, "energy.total") / start;
            (least, most) = (least.min(end), most.max(end));
        }
    }
    // It takes most between the limits of no branch and of a spring.
    assert!(least < 0.05 && most > 0.99, "{least} {most}");
}

/// A scene at rest begins with relaxed springs: it sags by the bushing's stiffness and stays.
#[test]
fn a_body_at_rest_has_a_relaxed_branch() {
    let text = soft(TIME, BRANCH, &format!("gravity = [-9.81, 0, 0]\nsettle = true\n{}", body("")));
    for (precision, near) in [("f64", 1e-9), ("f32", 1e-8), ("fixed", 1e-8)] {
        let mut plant = instance(&text, 1e-4, precision);
        for _ in 0..2 {
            let sag = value(&plant, "mass.x");
            assert!((sag + 9.81 / STATIC).abs() < near, "{precision}: {sag}");
            plant.advance_to(0.2).unwrap();
        }
    }
}

/// The deflections of the dampers are part of hash and snapshot.
#[test]
fn a_snapshot_keeps_the_memory() {
    for precision in ["f64", "f32", "fixed"] {
        let thrown = body("velocity = [1, 0, 0]");
        let mut plant = instance(&soft(TIME, BRANCH, &thrown), 1e-4, precision);
        plant.advance(300).unwrap();
        let saved = plant.save().unwrap();
        plant.advance(300).unwrap();
        let (hash, place) = (plant.hash(), value(&plant, "mass.x"));
        plant.restore(&saved).unwrap();
        assert_ne!(plant.hash(), hash);
        plant.advance(300).unwrap();
        assert_eq!((plant.hash(), value(&plant, "mass.x")), (hash, place));
    }
}

/// What makes no bushing is refused with the key and a remedy.
#[test]
fn invalid_constants_are_refused() {
    let text = include_str!("../fuzz/corpus/scene/mounts.toml");
    let changed = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    for (text, why) in [
        (changed("[-0.002, -40], [0, 0], [0.002, 40]", "[0, 0], [0.002, -40]"), "`force_y` of"),
        (changed("[\"-1 deg\", -20]", "[\"-1 deg\", 30]"), "decreases"),
        (changed("turn_damping_y = 0.2", "turn_damping_y = -0.2"), "is negative"),
        (changed("[0, 40, 0, 9, 0, 0]", "[0, 41, 0, 9, 0, 0]"), "is not symmetric"),
        (changed("[0, 0, 0, 0, 0, 6],", "[0, 0, 0, 0, 0, -6],"), "is not positive semi-definite"),
        (changed("[0, 0, 0, 0, 0, 6],", ""), "has 5 entries"),
        (changed("[0, 0, 0, 0, 0, 6],", "[0, 0, 0, 0, 6],"), "has 5 entries"),
        (changed("\"-60 N\"", "\"-60 N/m\""), "a value in N/m"),
        (changed("damping_time = \"0.5 ms\"", "damping_time = -1"), "is negative"),
        (changed("relaxation = \"10 ms\"", "relaxation = 0"), "is not positive"),
        (changed("relaxation = \"10 ms\"", ""), "relaxation"),
        (changed("x = [1, 0, 0]", "x = [1, 0, 1]"), "is not perpendicular to `z`"),
    ] {
        let refused = Scene::parse(&text, "mounts.toml").unwrap_err().to_string();
        assert!(refused.contains(why), "{refused}: {why}");
    }
}
