use super::*;
use crate::geometry::{F32, F64};

#[test]
fn turns_agree_with_libm_within_the_stated_error() {
    for (angle, bound64, bound32) in [(0.1, 3e-16, 2e-7), (1.0, 3e-10, 3e-7)] {
        let (s, c) = libm::sincos(angle / 2.0);
        let t = Turn::by(angle);
        assert!((t.half_cos - c).abs() < bound64 && (t.half_sin - s).abs() < bound64);
        let t = Turn::by(angle as f32);
        assert!((f64::from(t.half_cos) - c).abs() < bound32);
        assert!((f64::from(t.half_sin) - s).abs() < bound32);
    }
}

#[test]
fn a_rotation_about_one_axis_is_exact_in_all_maps() {
    let body = Body::<f64>::from_f64(1.0, [1.0, 2.0, 3.0]);
    for axis in 0..3 {
        let mut w = [0.0; 3];
        w[axis] = 0.8;
        let [mut a, mut b, mut c] = [Quaternion::IDENTITY; 3];
        let mut rate = Vec3::from_f64(w);
        for _ in 0..100 {
            free_rotor::<F64>(&body, &mut a, &mut rate, 0.1);
            turn_by::<F64>(&mut b, Vec3::from_f64(w) * 0.05);
            free_rotor_of_order_four::<F64>(&body, &mut c, &mut rate, 0.1);
        }
        let (sin, cos) = libm::sincos(4.0);
        for q in [a, b, c] {
            assert!((q.w - cos).abs() < 1e-13 && (q.v.to_f64()[axis] - sin).abs() < 1e-13);
        }
        assert_eq!(rate.to_f64(), w);
    }
}

#[test]
fn a_turn_about_an_axis_is_the_turn_of_its_quaternion() {
    let mut about @ [start, ..] = [Quaternion::new(0.8, -0.2, 0.4, 0.4); 3];
    about[0].turn_about::<0>(0.995, 0.0998);
    about[1].turn_about::<1>(0.995, 0.0998);
    about[2].turn_about::<2>(0.995, 0.0998);
    for (q, axis) in about.into_iter().zip(Vec3::<f64>::axes()) {
        assert_eq!(q, start.product(Quaternion { w: 0.995, v: axis * 0.0998 }));
    }
}

#[test]
fn a_body_that_turns_about_z_alone_is_turned_as_by_all_five() {
    let body = Body::<f64>::from_f64(1.0, [0.5, 0.7, 1.1]);
    for [x, y, z] in [[0.0, 0.0, 1.3], [-0.0, 0.0, -1.3], [0.0, -0.0, 1.3], [-0.0; 3]] {
        let (mut q, mut rate) = (Quaternion::new(0.8, -0.0, 0.0, -0.6), Vec3::new(x, y, z));
        let (mut all, mut all_rate) = (q, rate);
        free_rotor::<F64>(&body, &mut q, &mut rate, 0.1);
        about_z::<F64>(&body, &mut all, &mut all_rate, 0.1, false);
        all.renormalise();
        assert_eq!(std::format!("{q:?} {rate:?}"), std::format!("{all:?} {all_rate:?}"));
    }
}

/// The pose of a free rotor after 2 s in steps of `h`, and its world angular momentum.
fn tumbled(inertia: [f64; 3], h: f64) -> (Quaternion<f64>, Vec3<f64>) {
    let body = Body::<f64>::from_f64(1.0, inertia);
    let mut q = Quaternion::IDENTITY;
    let mut rate = Vec3::new(1.3, -0.9, 2.1);
    for _ in 0..(2.0 / h).round() as u32 {
        free_rotor_of_order_four::<F64>(&body, &mut q, &mut rate, h);
    }
    (q, q.rotation().to_world(body.inertia.scale(rate)))
}

fn apart(a: Quaternion<f64>, b: Quaternion<f64>) -> f64 {
    let (w, d) = (a.w - b.w, a.v - b.v);
    libm::sqrt(w * w + d.dot(d))
}

#[test]
fn the_rotor_of_order_four_is_of_order_four_whichever_axis_is_the_middle() {
    let values = [0.5, 0.7, 1.1];
    for [i, j, k] in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let inertia = [values[i], values[j], values[k]];
        let (mask, _) = tumbled(inertia, 0.002);
        let (coarse, momentum) = tumbled(inertia, 0.1);
        let order = libm::log2(apart(coarse, mask) / apart(tumbled(inertia, 0.05).0, mask));
        assert!((order - 4.0).abs() < 0.1, "{inertia:?}: {order}");
        let start = Vec3::from_f64(inertia).scale(Vec3::new(1.3, -0.9, 2.1));
        let change = momentum - start;
        assert!(libm::sqrt(change.dot(change)) < 1e-13, "{inertia:?}: {change:?}");
    }
    // Compared with the rotor of second order, which does not distinguish the middle axis.
    let body = Body::<f64>::from_f64(1.0, values);
    let (mut q, mut rate) = (Quaternion::IDENTITY, Vec3::new(1.3, -0.9, 2.1));
    for _ in 0..200_000 {
        free_rotor::<F64>(&body, &mut q, &mut rate, 1e-5);
    }
    assert!(apart(q, tumbled(values, 0.002).0) < 1e-9);
}

#[test]
fn the_flow_of_a_body_with_two_equal_inertias_is_exact() {
    for inertia in [[0.5, 0.5, 0.9], [0.9, 0.5, 0.5], [0.5, 0.9, 0.5], [0.6; 3]] {
        let (one, many) = (tumbled(inertia, 0.1).0, tumbled(inertia, 0.001).0);
        assert!(apart(one, many) < 1e-12, "{inertia:?}: {}", apart(one, many));
    }
}

#[test]
fn a_backward_rotor_undoes_a_forward_one() {
    let body = Body::<f64>::from_f64(1.0, [0.5, 0.7, 1.1]);
    let (mut q, mut rate) = (Quaternion::IDENTITY, Vec3::new(1.3, -0.9, 2.1));
    free_rotor_of_order_four::<F64>(&body, &mut q, &mut rate, 0.1);
    free_rotor_of_order_four::<F64>(&body, &mut q, &mut rate, -0.1);
    let back = rate - Vec3::new(1.3, -0.9, 2.1);
    assert!(apart(q, Quaternion::IDENTITY) < 1e-15 && back.dot(back) < 1e-28);
}

#[test]
fn unit_length_survives_a_million_turns_in_single_precision() {
    let body = Body::<f32>::from_f64(1.0, [0.5, 0.7, 1.1]);
    let mut q = Quaternion::IDENTITY;
    let mut rate = Vec3::new(3.0, -2.0, 5.0);
    for _ in 0..1_000_000 {
        free_rotor::<F32>(&body, &mut q, &mut rate, 1e-3);
    }
    let norm: f64 = q.to_f64().iter().map(|c| c * c).sum();
    assert!((norm - 1.0).abs() < 1e-6, "{norm}");
}

#[test]
fn bodies_that_rotate_together_have_the_bits_of_each() {
    let bodies = [[0.5, 0.7, 1.1], [0.2, 0.3, 0.25]].map(|i| Body::<f64>::from_f64(1.0, i));
    let state =
        |rate| BodyState::<F64>::from_f64([0.0; 3], [0.8, 0.36, -0.48, 0.0], [0.0; 3], rate);
    let mut states = [state([0.0, -0.9, 1.3]), state([2.0, 0.0, 0.0])];
    let mut alone = states;
    for _ in 0..20 {
        assert!(free_rotors(&bodies, &mut states, 0.1));
        for (BodyState { orientation, angular_velocity, .. }, body) in alone.iter_mut().zip(&bodies)
        {
            free_rotor::<F64>(body, orientation, angular_velocity, 0.1);
        }
    }
    assert_eq!(std::format!("{states:?}"), std::format!("{alone:?}"));
    states[1] = state([0.0, 0.0, 1.3]);
    let before = states;
    assert!(!free_rotors(&bodies, &mut states, 0.1) && states == before);
}
