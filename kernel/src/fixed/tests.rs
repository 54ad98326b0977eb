use super::number::tests::words;
use super::*;
use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::elements::tsda::Tsda;
use crate::index::BodyIndex;
use crate::model_spec::{ModelSpec, Start};
use crate::plant::Plant;
use crate::schemes::Leapfrog;
use crate::status::Cause;
use crate::vector::Quaternion;

/// Numbers in [−1, 1] from words.
fn units(seed: u64) -> impl Iterator<Item = f64> {
    words(seed).map(|word| (word as i64 >> 11) as f64 * (1.0 / (1_u64 << 52) as f64))
}

fn unit(numbers: &mut impl Iterator<Item = f64>) -> [f64; 4] {
    let q: [f64; 4] = core::array::from_fn(|_| numbers.next().unwrap());
    let n = libm::sqrt(q.iter().map(|c| c * c).sum());
    q.map(|c| c / n)
}

/// The matrix of a stored quaternion, exact up to its length: entries times 2^124, and the squared length likewise.
fn exact_matrix(q: &FixedTurn) -> ([[i128; 3]; 3], i128) {
    let (w, [x, y, z]) = (i128::from(q.w), q.v.map(i128::from));
    let n = w * w + x * x + y * y + z * z;
    let rows = [
        [n - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), n - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), n - 2 * (x * x + y * y)],
    ];
    (rows, n)
}

#[test]
fn matrices_are_the_exact_ones_to_the_nearest() {
    let mut numbers = units(11);
    for _ in 0..20_000 {
        let q = FixedTurn::from_f64(unit(&mut numbers));
        let (exact, n) = exact_matrix(&q);
        // The length of a quaternion in double precision is 1 within 2^-50.
        assert!((n - (1 << 124)).abs() < 1 << 74);
        for (row, exact) in q.matrix().into_iter().zip(exact) {
            for (c, exact) in row.into_iter().zip(exact) {
                // 2^94 units of 2^-124 per unit of 2^-30: half of one, and a 2^-19th for the length.
                let off = (i128::from(c) << 94) - exact;
                assert!(off.abs() < (1 << 93) + (1 << 75), "{q:?}: {off}");
            }
        }
    }
}

#[test]
fn what_a_matrix_loses_the_next_makes_up_for() {
    let mut numbers = units(13);
    for case in 0..20 {
        let start = unit(&mut numbers);
        let [w, _, _, z] = start;
        let n = libm::sqrt(w * w + z * z);
        // Every second one rotates about z only, as in a plane.
        let is_flat = case % 2 == 0;
        let mut q = FixedTurn::from_f64(if is_flat { [w / n, 0.0, 0.0, z / n] } else { start });
        // The sum of the entries' errors over all poses, times 2^94.
        let mut off = [[0_i128; 3]; 3];
        for pose in 1..2_000 {
            q.turn_exactly::<2>((1e-3 * numbers.next().unwrap() as f32, 0.0));
            if !is_flat {
                q.turn_exactly::<0>((1e-3 * numbers.next().unwrap() as f32, 0.0));
            }
            let mut other = q;
            let matrix = q.next_matrix();
            assert_eq!(q.matrix(), matrix, "made once more it is the same");
            if is_flat {
                assert_eq!((other.next_matrix_about_z(), other), (matrix, q), "{q:?}");
            }
            let (exact, _) = exact_matrix(&q);
            for ((row, exact), off) in matrix.into_iter().zip(exact).zip(&mut off) {
                for ((c, exact), off) in row.into_iter().zip(exact).zip(off) {
                    *off += (i128::from(c) << 94) - exact;
                    // One unit of 2^-30, and the errors of an entry's sum and length in each pose.
                    assert!(off.abs() < (1 << 94) + pose * (1 << 77), "{pose}: {off}");
                }
            }
        }
    }
}

#[test]
fn turns_are_exact_to_what_they_were_given() {
    let mut numbers = units(12);
    for _ in 0..20_000 {
        let (mut q, turn) = (FixedTurn::from_f64(unit(&mut numbers)), unit(&mut numbers));
        let (a, turn) = (q, Quaternion::<f32>::from_f64(turn));
        q.turn(turn);
        q.renormalise();
        // The exact product of the exact single-precision numbers, of unit length.
        let [bw, bx, by, bz] = turn.to_f64().map(|c| (c * (1_u64 << 50) as f64) as i128);
        let (aw, [ax, ay, az]) = (i128::from(a.w), a.v.map(i128::from));
        let product = [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
        ];
        // Components times 2^112; the length is that of single precision, corrected by one Newton step to an error of
        // 2^-46.
        let length = turn.to_f64().iter().map(|c| c * c).sum::<f64>();
        let root = libm::sqrt(length);
        for (c, exact) in [q.w, q.v[0], q.v[1], q.v[2]].into_iter().zip(product) {
            let exact = exact as f64 / root * (1.0 / (1_u64 << 50) as f64);
            assert!((c as f64 - exact).abs() < 2e4, "{c} {exact}");
        }
        let (_, n) = exact_matrix(&q);
        assert!((n - (1 << 124)).abs() < 1 << 79, "{n}");
    }
}

#[test]
fn turns_about_axes_are_those_of_double_precision() {
    let mut numbers = units(17);
    for i in 0..3_000 {
        let start = FixedTurn::from_f64(unit(&mut numbers));
        let (half, rest) = (0.1 * numbers.next().unwrap() as f32, 1e-9);
        let (sin, cos) = libm::sincos(f64::from(half) + f64::from(rest));
        let mut axis = [cos, 0.0, 0.0, 0.0];
        axis[1 + i % 3] = sin;
        let turn = Quaternion::<f64>::from_f64(axis);
        let expected = Quaternion::<f64>::from_f64(start.to_f64()).product(turn).to_f64();
        let mut q = start;
        match i % 3 {
            0 => q.turn_exactly::<0>((half, rest)),
            1 => q.turn_exactly::<1>((half, rest)),
            _ => q.turn_exactly::<2>((half, rest)),
        }
        // Apart from 1 and the angle, polynomials in single precision: three roundings of half the square.
        let bound = 1e-15 + 1e-7 * f64::from(half * half);
        for (c, expected) in q.to_f64().into_iter().zip(expected) {
            assert!((c - expected).abs() < bound, "{i}: {c} {expected}");
        }
    }
}

#[test]
fn places_and_ways_between_them_are_exact() {
    let mut numbers = units(13);
    let mut next =
        move |scale: f64| -> [f64; 3] { core::array::from_fn(|_| numbers.next().unwrap() * scale) };
    let mut turns = units(14);
    for _ in 0..20_000 {
        let position = FixedPlace::new(next(24.0));
        let point = FixedPoint::new(next(4.0));
        let ground = FixedPoint::new(next(24.0));
        let frame = Fixed::frame(&position, &FixedTurn::from_f64(unit(&mut turns)));
        let (place, arm) = Fixed::place(&frame, &point);
        let way = Fixed::displacement(&Fixed::ground(&ground), &place).to_f64();
        for (i, way) in way.into_iter().enumerate() {
            let row = frame.rotation[i].map(i128::from);
            let turned: i128 = (0..3).map(|j| row[j] * i128::from(point.at[j])).sum();
            let exact = i128::from(position.at[i]) + turned;
            assert_eq!(i128::from(place.at[i]), exact);
            let exact = (exact - (i128::from(ground.at[i]) << 30)) as f64 / 57.0_f64.exp2();
            assert!((way - exact).abs() <= exact.abs() * 1.3e-7 + 2e-15, "{way} {exact}");
            let turned = turned as f64 / 57.0_f64.exp2();
            assert!((arm.to_f64()[i] - turned).abs() < 2e-6, "{arm:?} {turned}");
        }
    }
}

#[test]
fn constants_have_the_bits_of_what_is_made_at_run_time() {
    const AT: [f64; 3] = [0.1, -20.2, 1e-9];
    const TURN: [f64; 4] = [0.8, 0.0, 0.6, 0.0];
    const RATES: [[f64; 3]; 2] = [[1.0 / 3.0, 2.0, -0.7], [0.3, 1e10, -1.1]];
    const STATE: BodyState<Fixed> = BodyState::<Fixed>::new(AT, TURN, RATES[0], RATES[1]);
    assert_eq!(STATE, BodyState::from_f64(AT, TURN, RATES[0], RATES[1]));
    let position = Fixed::position_to_f64(&STATE.position);
    assert!(position.iter().zip(AT).all(|(a, b)| (a - b).abs() < 1e-17 + 4e-16 * b.abs()));
}

/// A free body with a velocity \[m/s\] and an angular velocity \[rad/s\], stepped by 1 ms.
fn flight(at: f64, velocity: f64, spin: f64, steps: u64) -> (Result<(), Cause>, f64) {
    let start = Start {
        velocity: [0.0, velocity, 0.0],
        angular_velocity: [spin, 0.0, 0.0],
        ..Start::at([0.0, at, 0.0])
    };
    let model = ModelSpec::new()
        .gravity([0.0, 0.0, -1e-3])
        .body(1.0, [0.1, 0.2, 0.2], start)
        .model_fixed::<1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0>();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let end = plant.advance(steps).map_err(|failure| failure.cause);
    (end, Fixed::position_to_f64(&plant.state().bodies[0].position)[1])
}

#[test]
fn what_leaves_its_limits_latches_and_never_wraps() {
    let extent = Err(Cause::Extent { body: BodyIndex(0) });
    // At every speed up to the limit: the first step beyond the range fails, on the side where the body left it.
    for tenth in 1..=12 {
        let velocity = f64::from(tenth) * 10.0;
        for sign in [1.0, -1.0] {
            let (end, at) = flight(sign * 20.0, sign * velocity, 0.0, 1_000_000);
            assert_eq!(end, extent);
            assert!(at * sign > 24.0 && at * sign < 24.2, "{velocity}: {at}");
        }
    }
    // From one end of the range to the other.
    let (end, at) = flight(-24.0, 100.0, 0.0, 479);
    assert!(end.is_ok() && (at - 23.9).abs() < 1e-4, "{end:?} {at}");
    // A kick makes it faster than a step allows, out and back within one step.
    let mut numbers = units(15);
    for _ in 0..1000 {
        let mut place = FixedPlace::new([24.0 * numbers.next().unwrap(); 3]);
        let drift = numbers.next().unwrap() as f32 * 1e3;
        Fixed::translate(&mut place, Vec3::new(0.0, drift, 0.0));
        for _ in 0..6 {
            Fixed::translate(&mut place, Vec3::new(0.0, 0.125, -0.125));
        }
        assert_eq!(Fixed::is_within(&place), drift.abs() <= 0.125 && place.at[1] >> 52 < 24 << 5);
    }
    for drift in [f32::NAN, f32::INFINITY, 0.126, -1e30] {
        let mut place = FixedPlace::default();
        Fixed::translate(&mut place, Vec3::new(0.0, 0.0, drift));
        assert!(!Fixed::is_within(&place), "{drift}");
    }
}

#[test]
fn a_turn_that_is_none_latches() {
    assert_eq!(flight(0.0, 0.0, 900.0, 1000).0, Ok(()));
    assert_eq!(flight(0.0, 0.0, 1100.0, 1).0, Err(Cause::Spin { body: BodyIndex(0) }));
    for turn in [Quaternion::new(f32::NAN, 0.0, 0.0, 0.0), Quaternion::new(3.0, 1e9, 0.0, 0.0)] {
        let mut q = FixedTurn::default();
        q.turn(turn);
        q.turn(Quaternion::IDENTITY);
        q.renormalise();
        assert!(q.is_lost());
    }
}

#[test]
fn squares_of_ways_beside_free_lengths_are_exact_to_their_units() {
    let mut numbers = units(16);
    for i in 0..30_000 {
        // Below 0.2 m, around it, and up to 50 m.
        let scale = [0.19, 0.3, 12.0, 50.0][i % 4];
        let d: [f64; 3] = core::array::from_fn(|_| numbers.next().unwrap() * scale);
        let from = FixedPlace::new(core::array::from_fn(|_| numbers.next().unwrap() * 10.0));
        let to = FixedPlace { at: sum(from.at, FixedPlace::new(d).at) };
        let length = libm::sqrt(d.iter().map(|c| c * c).sum::<f64>());
        let free = (length * (1.0 + 1e-4 * numbers.next().unwrap())) as f32;
        let elongation = Fixed::elongation(&from, &to, free);
        let exact = way_beside(difference(to.at, from.at), free);
        let beyond = f64::from(elongation.more.unwrap()) / (length + f64::from(free));
        let bound = if length < 15.9 { 2.1e-10 + 1e-6 * exact.abs() } else { 3e-7 * length };
        assert!((beyond - exact).abs() < bound, "{d:?}: {beyond:e} {exact:e}");
        for (way, d) in elongation.way.to_f64().into_iter().zip(d) {
            assert!((way - d).abs() < 1.2e-10 + 1.2e-7 * d.abs(), "{way} {d}");
        }
    }
}

/// L − L0 \[m\] from the exact squares, by 2^114.
fn way_beside(d: [i64; 3], free: f32) -> f64 {
    let square: i128 = d.iter().map(|&c| i128::from(c) * i128::from(c)).sum();
    let exact_free = (f64::from(free) * 57.0_f64.exp2()) as i128;
    let more = (square - exact_free * exact_free) as f64 * (-114.0_f64).exp2();
    more / (libm::sqrt(square as f64 * (-114.0_f64).exp2()) + f64::from(free))
}

#[test]
fn stars_from_where_they_rested_pull_as_their_points_do() {
    let mut numbers = units(17);
    for i in 0..10_000 {
        // A stiff joint, a soft one, and distant parts.
        let scale = [1e-7, 1e-5, 1e-2, 1.0, 20.0][i % 5];
        let mut vector = |scale: f64| core::array::from_fn(|_| numbers.next().unwrap() * scale);
        let (at, local, shift) = (vector(3.0), vector(0.5), vector(scale));
        let endpoints: [[f64; 3]; 3] = core::array::from_fn(|_| vector(0.4));
        let turn = FixedTurn::from_f64(unit(&mut numbers));
        let frame = Fixed::frame(&FixedPlace::new(at), &turn);
        let (start, _) = Fixed::place(&frame, &FixedPoint::new(local));
        let endpoints = endpoints.map(FixedPoint::new);
        let mut rests = [Rest::default(); 3];
        Fixed::find_rests(&frame, &start, &endpoints, &[0.3; 3], &mut rests);
        let centre = FixedPoint { at: rests.map(|rest| -i64::from(rest.less)) };
        let near = difference(centre.at, FixedPoint::new(local).at);
        // Single precision resolves the first displacement, up to 0.9 m.
        assert!(near.iter().all(|c| c.abs() <= 8), "{near:?}");
        // B rotated slightly about another point, and the centre moved with it and relative to it.
        let turn = FixedTurn::from_f64(unit(&mut numbers));
        let frame = Fixed::frame(&FixedPlace::new(at.map(|c| 0.5 - c)), &turn);
        let (resting, _) = Fixed::place(&frame, &centre);
        let moved = FixedPlace { at: sum(resting.at, FixedPlace::new(shift).at) };
        let apart = difference(moved.at, frame.position);
        let none = FixedPoint::default();
        let beside = Fixed::beside(&apart, (None, &none), (&frame, &endpoints[0]), &rests);
        let exact = Fixed::displacement(&resting, &moved);
        assert_eq!(beside.off, exact);
        // A separate triple with one point: its reference position is that of the point.
        let alone = Fixed::beside(&apart, (None, &none), (&frame, &endpoints[0]), &[rests[0]]);
        assert_eq!(alone, beside);
        let arm = beside.arm_b - nearest::<PLACE>(apart);
        assert!(arm.dot(arm) == 0.0 && beside.arm_a == Vec3::ZERO);
        let off = Fixed::to_body(&frame, beside.off);
        let far = f64::from(off.dot(off)).sqrt();
        for (endpoint, rest) in endpoints.into_iter().zip(rests) {
            let elongation = Fixed::at_rest(&rest).elongation(off);
            let (endpoint, _) = Fixed::place(&frame, &endpoint);
            let way = Fixed::to_world(&frame, elongation.way);
            let exact = Fixed::displacement(&moved, &endpoint);
            let apart = (way - exact).dot(way - exact).sqrt();
            assert!(apart < 2e-7 + 3e-7 * far as f32, "{apart} {far}");
            let length = f64::from(exact.dot(exact)).sqrt();
            let beyond = f64::from(elongation.more.unwrap()) / (length + 0.3_f32 as f64);
            let exact = way_beside(difference(endpoint.at, moved.at), 0.3);
            // The matrix's rounding, and the single-precision resolution of the offset and of the initial distance.
            let bound = 3e-9 + 3e-7 * (far + exact.abs());
            assert!((beyond - exact).abs() < bound, "{far:e}: {beyond:e} {exact:e}");
        }
    }
}

#[test]
fn a_star_that_lies_far_off_rests_at_a_point_that_a_body_may_have() {
    let frame = Fixed::frame(&FixedPlace::default(), &FixedTurn::default());
    for at in [[20.0, -20.0, 0.0], [24.0; 3], [-24.0; 3]] {
        let endpoint = FixedPoint::new([0.1, 0.2, -0.3]);
        let mut rests = [Rest::default(); 3];
        Fixed::find_rests(&frame, &FixedPlace::new(at), &[endpoint; 3], &[1.0; 3], &mut rests);
        let centre = rests.map(|rest| f64::from(rest.less) / 27.0_f64.exp2());
        assert!(centre.iter().all(|c| c.abs() <= LIMITS.elongation + 1e-6), "{centre:?}");
    }
}

/// The second of two triples of a joint, computed from the first: as computed by itself.
#[test]
fn a_second_star_is_as_far_beyond_the_first_as_it_is_off() {
    let mut numbers = units(18);
    for i in 0..10_000 {
        let mut vector = |scale: f64| core::array::from_fn(|_| numbers.next().unwrap() * scale);
        let [a, b] = [vector(3.0), vector(3.0)].map(FixedPlace::new);
        let [centres, endpoints]: [[FixedPoint; 2]; 2] =
            [0.5, 0.4].map(|scale| [(); 2].map(|()| FixedPoint::new(vector(scale))));
        let turns = [(); 2].map(|()| FixedTurn::from_f64(unit(&mut numbers)));
        let (a, b) = (Fixed::frame(&a, &turns[0]), Fixed::frame(&b, &turns[1]));
        let of_a = if i % 2 == 0 { Some(&a) } else { None };
        let rests = endpoints.map(|endpoint| {
            let mut rests = [Rest::default(); 3];
            let at = FixedPlace::new([0.1, 0.2, 0.3]);
            Fixed::find_rests(&b, &at, &[endpoint; 3], &[1.0; 3], &mut rests);
            rests
        });
        let apart = Fixed::apart(of_a, None, &b);
        let [first, second] = [0, 1].map(|triple| {
            Fixed::beside(&apart, (of_a, &centres[triple]), (&b, &endpoints[0]), &rests[triple])
        });
        let (ends, triples) = ((of_a, centres.each_ref()), rests.each_ref());
        let beyond = Fixed::beyond(ends, (&b, &endpoints[0]), triples);
        for (by, beside) in
            [(beyond.off, second.off - first.off), (beyond.way, second.arm_b - first.arm_b)]
        {
            let apart = (by - beside).dot(by - beside).sqrt();
            assert!(apart < 3e-6, "{by:?} {beside:?}");
        }
    }
}

/// Near its reference a triple exerts the same force as its springs' displacements.
#[test]
fn a_star_near_its_rest_pulls_as_its_springs_do() {
    let mut numbers = units(19);
    for i in 0..30_000 {
        let mut vector =
            |scale: f64| -> [f64; 3] { core::array::from_fn(|_| numbers.next().unwrap() * scale) };
        let endpoints: [FixedPoint; 3] = core::array::from_fn(|_| FixedPoint::new(vector(0.4)));
        let frame = Fixed::frame(&FixedPlace::default(), &FixedTurn::default());
        let free_lengths: [f32; 3] = [[0.3, 0.1, 0.5], [0.2; 3]][i % 2];
        let mut rests = [Rest::default(); 3];
        Fixed::find_rests(&frame, &FixedPlace::default(), &endpoints, &free_lengths, &mut rests);
        let off = Vec3::from_f64(vector([1e-7, 1e-4, 0.05][i % 3]));
        let square = off.dot(off);
        if square >= rests[0].near {
            continue;
        }
        let springs = free_lengths.map(|free_length| Tsda { stiffness: 1e6, free_length });
        let near = Tsda::pull_near_rest(&springs, &rests.map(|rest| rest.at), (off, square));
        let (mut exact, mut size) = ([0.0_f64; 3], 0.0);
        for (rest, spring) in rests.iter().zip(&springs) {
            let ([x, y, z], [p, q, r]) = (rest.at.way.to_f64(), off.to_f64());
            let way = [x - p, y - q, z - r];
            let length = libm::sqrt(way.iter().map(|c| c * c).sum());
            let free = f64::from(spring.free_length);
            // The square of a single-precision displacement differs slightly from the reference's.
            let more =
                f64::from(rest.at.more) + (p * p + q * q + r * r - 2.0 * (p * x + q * y + r * z));
            let tension = 1e6 * more / (length + free);
            size += tension.abs();
            for (sum, c) in exact.iter_mut().zip(way) {
                *sum += tension * c / length;
            }
        }
        for (c, exact) in near.to_f64().into_iter().zip(exact) {
            assert!((c - exact).abs() < 1e-6 * size, "{off:?}: {c} {exact}");
        }
    }
}
