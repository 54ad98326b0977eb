//! Fast spins, flips about the intermediate axis, and pitch through exactly ±90°.

use std::f64::consts::{PI, TAU};

use dbd_kernel::euler::{EulerF32, EulerF64};
use dbd_kernel::{BodyState, F32, F64, Geometry, Leapfrog, Pefrl, Plant, Quaternion, Scheme, Vec3};
use dbd_tests::Bench;
use dbd_tests::page::{block, table};

use super::outcome;

/// \[rad/s\] the spin.
const SPIN: f64 = 1e4;

fn rotor<P: Geometry>(inertia: [f64; 3], pose: [f64; 4], rate: [f64; 3]) -> Bench<P> {
    let mut model = Bench::new();
    let state = BodyState::from_f64([0.0; 3], pose, [0.0; 3], rate);
    model.add_body(1.0, inertia, state).unwrap();
    model
}

const UNTURNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Angular momentum, world, and kinetic energy of a free body.
fn kept(inertia: [f64; 3], body: &BodyState<F64>) -> (Vec3<f64>, f64) {
    let spin = body.angular_velocity;
    let momentum = Vec3::from_f64(inertia).scale(spin);
    (body.orientation.rotation().to_world(momentum), 0.5 * momentum.dot(spin))
}

/// How far \[rad\] a body that spins about one axis is off after a turn, of 1,000 steps.
fn angle_off<P: Geometry>(step_angle: f64) -> Result<f64, u64> {
    let h = step_angle / SPIN;
    let model = rotor::<P>([1.0, 2.0, 3.0], UNTURNED, [0.0, 0.0, SPIN]);
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let mut before = 0.0;
    let mut off = 0.0;
    for _ in 0..1_000 {
        plant.step().map_err(|failure| failure.step)?;
        let q = plant.state().bodies[0].convert::<F64>().orientation;
        let angle = 2.0 * libm::atan2(q.v.z, q.w);
        let error = angle - before - step_angle;
        off += error - TAU * (error / TAU).round();
        before = angle;
    }
    Ok(off.abs() * TAU / (1_000.0 * step_angle))
}

/// The worst change of a tumbling body's angular momentum over 10,000 steps, in parts of it.
fn momentum_off<P: Geometry>(step_angle: f64) -> Result<f64, u64> {
    let inertia = [1.0, 2.0, 3.0];
    let model = rotor::<P>(inertia, UNTURNED, [0.1 * SPIN, -0.2 * SPIN, SPIN]);
    let mut plant = Plant::new(&model, Leapfrog, step_angle / SPIN).unwrap();
    let momentum = |body: &BodyState<P>| kept(inertia, &body.convert()).0;
    let start = momentum(&plant.state().bodies[0]);
    let mut worst = 0.0_f64;
    for _ in 0..100 {
        plant.advance(100).map_err(|failure| failure.step)?;
        let change = momentum(&plant.state().bodies[0]) - start;
        worst = worst.max(change.dot(change).sqrt());
    }
    Ok(worst / start.dot(start).sqrt())
}

#[test]
fn a_spin_of_ten_thousand_radians_per_second_is_a_matter_of_the_step() {
    let mut rows = Vec::new();
    for step_angle in [0.01, 0.1, 0.5, 1.0, 2.0, 3.0] {
        let angles = [angle_off::<F64>(step_angle), angle_off::<F32>(step_angle)];
        let momenta = [
            momentum_off::<F64>(step_angle),
            momentum_off::<F32>(step_angle),
            momentum_off::<EulerF64>(step_angle),
        ];
        if step_angle <= 0.1 {
            let right = |off: &[Result<f64, u64>; 2]| off[0] < Ok(1e-11) && off[1] < Ok(1e-3);
            let two = [momenta[0], momenta[1]];
            assert!(right(&angles) && right(&two), "{step_angle}: {angles:?} {momenta:?}");
        }
        if step_angle == 0.5 {
            // What host-sim warns of.
            let lost = momenta[2].unwrap_or_default();
            assert!((0.15..0.25).contains(&lost), "{lost}");
        }
        let cells = [format!("{:.0e} s", step_angle / SPIN)];
        let figures = angles.into_iter().chain(momenta).map(outcome);
        rows.push([format!("{step_angle}")].into_iter().chain(cells).chain(figures).collect());
    }
    let head = [
        "h·ω",
        "step at 1e4 rad/s",
        "angle per turn, f64 [rad]",
        "f32 [rad]",
        "momentum, f64",
        "f32",
        "f64, `euler-321`",
    ];
    block("docs/extremes.md", "spin", &table(&head, &rows));
}

/// The complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn complete_integral(modulus_squared: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus_squared).sqrt());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// What came of 20 flips: the relative error of their time, and the largest changes of angular
/// momentum and energy, in parts of each.
fn flips<P: Geometry, S: Scheme>(scheme: S, step_angle: f64) -> [f64; 3] {
    let (inertia, rate): ([f64; 3], [f64; 3]) = ([1.0, 2.0, 3.0], [0.0, 10.0, 0.1]);
    let [i1, i2, i3] = inertia;
    let double_energy = i2 * rate[1] * rate[1] + i3 * rate[2] * rate[2];
    let square = i2 * i2 * rate[1] * rate[1] + i3 * i3 * rate[2] * rate[2];
    // Landau & Lifshitz, Mechanics, § 37; the rate about the middle axis begins at its largest.
    let speed = ((i3 - i2) * (square - double_energy * i1) / (i1 * i2 * i3)).sqrt();
    let modulus =
        (i2 - i1) * (double_energy * i3 - square) / ((i3 - i2) * (square - double_energy * i1));
    let between = 2.0 * complete_integral(modulus) / speed;

    let h = step_angle / 10.0;
    let model = rotor::<P>(inertia, UNTURNED, rate);
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    let body = |state: &BodyState<P>| -> BodyState<F64> { state.convert() };
    let (momentum, energy) = kept(inertia, &body(&plant.state().bodies[0]));
    let (mut times, mut before, mut worst) = (Vec::new(), rate[1], [0.0_f64; 2]);
    for n in 1.. {
        plant.step().unwrap();
        let now = body(&plant.state().bodies[0]);
        let (m, e) = kept(inertia, &now);
        let change = m - momentum;
        let change = (change.dot(change) / momentum.dot(momentum)).sqrt();
        worst = [worst[0].max(change), worst[1].max((e / energy - 1.0).abs())];
        let middle = now.angular_velocity.y;
        if middle * before < 0.0 {
            times.push(h * (f64::from(n) - middle / (middle - before)));
            if times.len() == 21 {
                break;
            }
        }
        before = middle;
    }
    let time = (times[20] - times[0]) / 20.0;
    [(time / between - 1.0).abs(), worst[0], worst[1]]
}

#[test]
fn a_body_flips_about_its_middle_axis_in_time() {
    let check = |name: &str, seen: [f64; 3], bounds: [f64; 3]| {
        assert!(seen.iter().zip(bounds).all(|(seen, bound)| *seen < bound), "{name}: {seen:?}");
    };
    for (step_angle, time) in [(0.1, 1e-2), (0.01, 1e-4)] {
        check("leapfrog, f64", flips::<F64, _>(Leapfrog, step_angle), [time, 1e-12, time]);
        check("pefrl, f64", flips::<F64, _>(Pefrl, step_angle), [time, 1e-12, time]);
        check("leapfrog, f32", flips::<F32, _>(Leapfrog, step_angle), [0.05, 1e-3, 1e-2]);
    }
}

/// How far a direction is off \[rad\] after 10 turns end over end, through exactly ±90° of pitch each
/// time, from which it begins; or the step at which the plant failed.
fn through_the_pole<P: Geometry>(sign: f64) -> Result<f64, u64> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let steps = 10_000_u32;
    let h = 1e-3;
    let rate = 10.0 * TAU / (f64::from(steps) * h);
    let model = rotor::<P>([1.0, 2.0, 3.0], [half, 0.0, sign * half, 0.0], [0.0, rate, 0.0]);
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    plant.advance(steps.into()).map_err(|failure| failure.step)?;
    let q: Quaternion<f64> = plant.state().bodies[0].convert::<F64>().orientation;
    let start = Quaternion::new(half, 0.0, sign * half, 0.0);
    let d = start.conjugate().product(q).v;
    Ok(2.0 * d.dot(d).sqrt())
}

#[test]
fn pitch_passes_exactly_through_the_poles() {
    for sign in [1.0, -1.0] {
        for off in [through_the_pole::<F64>(sign), through_the_pole::<EulerF64>(sign)] {
            assert!(off.is_ok_and(|off| off < 1e-9), "{off:?}");
        }
        for off in [through_the_pole::<F32>(sign), through_the_pole::<EulerF32>(sign)] {
            assert!(off.is_ok_and(|off| off < 5e-2), "{off:?}");
        }
    }
}
