//! Numbers at their ends: denormals, −0, points that all but coincide, scenes far from the origin.

use dbd_kernel::builder::Triples;
use dbd_kernel::forces::wrenches;
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BodyIndex, BodyState, Dbd, F32, F64, Geometry, Leapfrog, Pefrl, Plant, Rk4, Scheme,
    SemiImplicitEuler, State, Vec3,
};
use dbd_tests::page::{block, figure, table};
use dbd_tests::{Bench, at, distance};

use super::{outcome, rounding};

/// The amplitude after 10,000 steps of 0.1 rad in parts of what it was, of a mass on a spring whose
/// amplitude is this.
fn amplitude<P: Geometry, S: Scheme>(scheme: S, start: f64) -> f64 {
    let mut model = Bench::<P>::new();
    let body = model.add_body(1.0, [1.0; 3], at([start, 0.0, 0.0])).unwrap();
    model.add_tsda([BodyIndex::WORLD, body], [[0.0; 3]; 2], 1.0, 0.0, 0.0).unwrap();
    let mut plant = Plant::new(&model, scheme, 0.1).unwrap();
    plant.advance(10_000).unwrap();
    let mut largest = 0.0_f64;
    for _ in 0..63 {
        plant.step().unwrap();
        let body: BodyState<F64> = plant.state().bodies[0].convert();
        largest = largest.max(body.position.x.abs());
    }
    largest / start
}

#[test]
fn a_vibration_of_denormals_stays_small() {
    for units in [1e6, 1e3, 30.0, 10.0, 1.0] {
        let least = [f64::from_bits(1), f64::from(f32::from_bits(1))].map(|least| units * least);
        let seen = [
            amplitude::<F64, _>(Leapfrog, least[0]),
            amplitude::<F32, _>(Leapfrog, least[1]),
            amplitude::<F64, _>(Rk4, least[0]),
            amplitude::<F32, _>(Rk4, least[1]),
        ];
        // It rounds to the grid in every step: it may stand still or die, and never grows far.
        assert!(seen.iter().all(|share| *share <= 1.0 + 30.0 / units), "{units}: {seen:?}");
    }
}

/// The force of a TSDA of 1 kN/m and 0.1 m between points that are so far apart \[m\], over what its
/// law says.
fn force_share<P: Geometry>(apart: f64) -> f64 {
    let mut model = Bench::<P>::new();
    let along = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0].map(|c| c * apart);
    let body = model.add_body(1.0, [1.0; 3], at(along)).unwrap();
    model.add_tsda([BodyIndex::WORLD, body], [[0.0; 3]; 2], 1e3, 0.0, 0.1).unwrap();
    let wrench: Vec<_> = wrenches(&model, &State::initial(&model), 1e-3).unwrap().to_vec();
    let force = wrench[0].force.to_f64();
    let pushed = force.iter().zip([1.0, 2.0, 2.0]).map(|(f, c)| f * c / 3.0).sum::<f64>();
    pushed / (1e3 * (0.1 - apart))
}

#[test]
fn a_spring_between_points_that_all_but_coincide_pushes_or_does_nothing() {
    // From where its force is right to a thousandth to where less than a thousandth is left: what a
    // square of a length never falls below takes it away.
    fn check<P: Geometry>(decades: i32) {
        let (mut right, mut none) = (f64::INFINITY, 0.0);
        for tenth in 11..10 * decades {
            let apart = libm::exp10(-f64::from(tenth) / 10.0);
            let share = force_share::<P>(apart);
            assert!((0.0..2.0).contains(&share), "{}, {apart:e}: {share}", P::NAME);
            if (share - 1.0).abs() < 1e-3 {
                right = right.min(apart);
            } else if share < 1e-3 {
                none = apart.max(none);
            }
        }
        assert!(none < right && none > 0.0, "{none:e} {right:e}");
    }
    check::<F64>(170);
    check::<F32>(30);
    assert_eq!((force_share::<F64>(0.0), force_share::<F32>(0.0)), (0.0, 0.0));
}

/// A pendulum of 1 kg on a revolute about z at `origin`, with a torsion spring, released at an angle.
fn pendulum<P: Geometry>(origin: [f64; 3], zero: f64) -> Bench<P> {
    let shifted = |d: [f64; 3]| [0, 1, 2].map(|i| origin[i] + d[i]);
    let mut model = Bench::<P>::new();
    model.set_gravity([zero, -9.81, zero]).unwrap();
    let state = BodyState::from_f64(
        shifted([0.5, zero, zero]),
        [1.0, zero, zero, zero],
        [zero, zero, zero],
        [zero; 3],
    );
    let body = model.add_body(1.0, [0.02, 0.05, 0.06], state).unwrap();
    let between = [BodyIndex::WORLD, body];
    let ring = [[0.2, 0.0, zero], [-0.1, 0.17, zero], [-0.1, -0.17, zero]];
    let triples = Triples {
        between,
        centres: &[[zero, zero, 0.2], [zero, zero, -0.2]].map(shifted),
        arms: &ring.map(|d| [d[0] - 0.5, d[1], d[2]]),
        stiffness: 2_000.0,
        damping: 0.5,
        free_length: 0.25,
        clearance: 0.0,
    };
    model.add_triples(triples).unwrap();
    model.add_torsion_spring(between, [zero, zero, 1.0], 2.0, 0.01, 0.0).unwrap();
    model
}

#[test]
fn a_negative_zero_is_a_zero() {
    fn same<P: Geometry, S: Scheme>(scheme: S) {
        let [plus, minus] = [0.0, -0.0].map(|zero| {
            let model = pendulum::<P>([0.0; 3], zero);
            let mut plant = Plant::new(&model, scheme, 1e-3).unwrap();
            plant.advance(1_000).unwrap();
            plant.state().bodies.to_vec()
        });
        // As numbers: their bits may differ by the sign of a zero.
        assert_eq!(plus, minus, "{} {}", P::NAME, S::NAME);
    }
    fn both<S: Scheme>(scheme: S) {
        same::<F64, S>(scheme);
        same::<F32, S>(scheme);
    }
    both(Dbd::default());
    both(SemiImplicitEuler);
    both(Leapfrog);
    both(Pefrl);
    both(Rk4);
}

/// How far \[m\] the pendulum is from where it ought to be after 1 s, at a distance from the origin;
/// and where it failed.
fn misplaced<P: Geometry>(from_origin: f64) -> Result<f64, u64> {
    fn end<P: Geometry>(origin: [f64; 3]) -> Result<BodyState<F64>, u64> {
        let model = pendulum::<P>(origin, 0.0);
        let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
        plant.advance(1_000).map_err(|failure| failure.step)?;
        let mut body: BodyState<F64> = plant.state().bodies[0].convert();
        body.position = body.position - Vec3::from_f64(origin);
        Ok(body)
    }
    let reference_solution = end::<F64>([0.0; 3])?;
    let moved = end::<P>([from_origin, -from_origin, from_origin])?;
    Ok(distance(&[moved], &[reference_solution]))
}

#[test]
fn far_from_the_origin_a_scene_moves_on_a_coarse_grid() {
    let mut rows = Vec::new();
    for origin in [0.0, 1.0, 10.0, 100.0, 1e3, 1e6] {
        let [double, single] = [misplaced::<F64>(origin), misplaced::<F32>(origin)];
        let double_error = double.unwrap();
        assert!(double_error <= 1e-9_f64.max(1e-13 * origin), "{origin}: {double_error:e}");
        // No promise beyond ten metres, but no silent infinity either.
        assert!(single.is_err() || origin > 10.0 || single < Ok(1e-2), "{origin}: {single:?}");
        // Between the coordinates of a body there, or those of its points about the origin.
        let place = origin.max(0.5);
        let single_grid = (place as f32).next_up() - place as f32;
        rows.push(vec![
            figure(origin, 1),
            rounding(place.next_up() - place),
            outcome(double),
            rounding(single_grid.into()),
            outcome(single),
        ]);
    }
    let head = ["from the origin [m]", "grid, f64 [m]", "off [m]", "grid, f32 [m]", "off [m]"];
    block("docs/extremes.md", "far", &table(&head, &rows));
}
