//! The crank-slider of the paper's section 4.4.1: what its joints hold, at both of its steps, beside
//! the paper's figures.

use dbd_kernel::energy::energy;
use dbd_kernel::{Dbd, F64, Leapfrog, Plant, Scheme};
use dbd_scene::SceneModel;
use dbd_tests::page::{block, figure, table};
use dbd_tests::scene;

/// The slider's row among the bodies.
const SLIDER: usize = 2;
const CRANK: usize = 0;

/// What the paper reports of one run of 10 s.
struct Figures {
    /// \[J\] energy at the end of the torque less that at the start.
    put_in: f64,
    /// \[rad/s\] largest rate of the crank.
    top_speed: f64,
    /// \[rad/s\] mean rate of the crank after the torque.
    mean_speed: f64,
    /// \[m\] root mean square distance of the slider from its axis.
    offset: f64,
    /// \[rad\] root mean square rotation of the slider about its axis.
    rotation: f64,
    /// \[W\] least-squares slope of the energy after the torque.
    rate: f64,
}

fn figures<S: Scheme>(model: &SceneModel<F64>, scheme: S, steps: u64) -> Figures {
    let h = 10.0 / steps as f64;
    let mut plant = Plant::new(model, scheme, h).unwrap();
    let start = energy(model, plant.state(), h).total();
    let (mut top_speed, mut turned, mut offset, mut rotation) = (0.0_f64, 0.0, 0.0, 0.0);
    let mut after = Vec::new();
    for _ in 0..steps {
        plant.step().ok().unwrap();
        let bodies = &plant.state().bodies;
        top_speed = top_speed.max(bodies[CRANK].angular_velocity.z.abs());
        let (p, q) = (bodies[SLIDER].position, bodies[SLIDER].orientation);
        offset += p.y * p.y + p.z * p.z;
        rotation += 4.0 * q.v.x * q.v.x;
        if plant.time() > 2.0 {
            turned += bodies[CRANK].angular_velocity.z.abs();
            after.push((plant.time(), energy(model, plant.state(), h).total()));
        }
    }
    let count = after.len() as f64;
    let mean = after.iter().fold((0.0, 0.0), |m, (t, e)| (m.0 + t / count, m.1 + e / count));
    let (mut covariance, mut variance) = (0.0, 0.0);
    for (t, e) in &after {
        covariance += (t - mean.0) * (e - mean.1);
        variance += (t - mean.0) * (t - mean.0);
    }
    Figures {
        put_in: after[0].1 - start,
        top_speed,
        mean_speed: turned / count,
        offset: (offset / steps as f64).sqrt(),
        rotation: (rotation / steps as f64).sqrt(),
        rate: covariance / variance,
    }
}

#[test]
fn figures_are_those_of_the_paper() {
    let model = scene("crank-slider").model;
    let mut columns = vec![[1.8, 30.0, 30.0, 9.5, 0.01, -0.8]];
    let mut head = vec!["`cargo test -p dbd-tests --test crank_slider`".to_owned(), "paper".into()];
    // 133.3 µs and 30.9 µs in whole steps of 10 s.
    for steps in [75_000_u64, 323_625] {
        let runs = std::thread::scope(|scope| {
            let dbd = scope.spawn(|| figures(&model, Dbd::default(), steps));
            let leapfrog = scope.spawn(|| figures(&model, Leapfrog, steps));
            [("dbd", dbd), ("leapfrog", leapfrog)].map(|(name, run)| (name, run.join().unwrap()))
        });
        for (scheme, f) in runs {
            let run = format!("{scheme} {} µs", figure(1e7 / steps as f64, 3));
            // The paper's geometry is drawn, not given; ours takes in 10 % less. Its 30 rad/s is
            // near the mean rate: the peak at the dead centres follows from energy and inertia.
            assert!((f.put_in - 1.8).abs() < 0.25, "{run}: {}", f.put_in);
            assert!((f.mean_speed - 30.0).abs() < 4.0, "{run}: {}", f.mean_speed);
            assert!((f.top_speed - 45.0).abs() < 1.0, "{run}: {}", f.top_speed);
            assert!((f.offset - 9.5e-6).abs() < 1.5e-6, "{run}: {}", f.offset);
            // The paper's 0.01 is not reached with the geometry that its figure shows.
            assert!(f.rotation < 1.1e-6, "{run}: {}", f.rotation);
            assert!(f.rate.abs() < 0.8e-4, "{run}: {}", f.rate);
            head.push(run);
            let micro = [f.offset, f.rotation].map(|length| 1e6 * length);
            columns.push([f.put_in, f.top_speed, f.mean_speed, micro[0], micro[1], 1e3 * f.rate]);
        }
    }
    let rows: Vec<Vec<String>> = [
        "energy put in [J]",
        "crank, peak [rad/s]",
        "crank, mean after the torque [rad/s]",
        "slider off its axis, RMS [µm]",
        "slider about its axis, RMS [µrad]",
        "energy after the torque [mJ/s]",
    ]
    .iter()
    .enumerate()
    .map(|(row, what)| {
        let cells = columns.iter().enumerate().map(|(column, figures)| match (row, column) {
            (_, 0) => format!("{}", figures[row]),
            (5, _) => figure(figures[row], 2),
            _ => figure(figures[row], 3),
        });
        [(*what).to_owned()].into_iter().chain(cells).collect()
    })
    .collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    block("README.md", "crank-slider", &table(&head, &rows));
}
