//! Orders of convergence, by halving the step against a run at a twentieth of the finer one.

use dbd_kernel::{Dbd, F64, Leapfrog, Scheme};
use dbd_tests::{distance, hung_ring, run};

/// The error at `h` over the error at `h/2`, over `time` \[s\], against a run at `h/40`.
fn ratio<S: Scheme>(scheme: S, damping: f64, h: f64, time: f64) -> f64 {
    let model = hung_ring::<F64>(damping);
    let steps = (time / h).round() as u64;
    let truth = run(&model, scheme, h / 40.0, 40 * steps);
    let coarse = run(&model, scheme, h, steps);
    let fine = run(&model, scheme, h / 2.0, 2 * steps);
    distance(&coarse.bodies, &truth.bodies) / distance(&fine.bodies, &truth.bodies)
}

#[test]
fn tumbling_bodies_on_springs() {
    // Against a reference of step h/40 the ratio of order p is (40^p − 1)/(20^p − 1).
    let leapfrog = ratio(Leapfrog, 0.0, 4e-4, 0.4);
    assert!((leapfrog - 1599.0 / 399.0).abs() < 0.15, "{leapfrog}");
    let dbd = ratio(Dbd::default(), 0.0, 1e-4, 0.4);
    assert!((dbd - 39.0 / 19.0).abs() < 0.1, "{dbd}");
    // The iterations dissipate h·ω²·E: the window is short against 1/(h·ω²) = 0.6 s.
    let newton = ratio(Dbd { newton: 2 }, 0.0, 1e-5, 0.05);
    assert!((newton - 39.0 / 19.0).abs() < 0.1, "{newton}");
}

#[test]
fn damping_sweeps_keep_second_order() {
    let leapfrog = ratio(Leapfrog, 2.0, 2e-3, 0.4);
    assert!((leapfrog - 1599.0 / 399.0).abs() < 0.15, "{leapfrog}");
    let dbd = ratio(Dbd::default(), 2.0, 5e-4, 0.4);
    assert!((dbd - 39.0 / 19.0).abs() < 0.1, "{dbd}");
}
