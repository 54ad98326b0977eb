//! x
use dbd_kernel::{Plant, State, energy::energy, frequency, schemes::Leapfrog};
fn main() {
    for name in [
        "hexagon",
        "four-bar",
        "3rrr",
        "3rrr-1",
        "crank-slider",
        "cart-pendulum",
        "gripper",
        "five-bar-a",
        "six-bar",
        "hanging-chain",
        "chain-closed",
        "chain-open-30",
        "spring-ball",
    ] {
        let scene = dbd_scene::Scene::load(format!("scenes/{name}.toml")).unwrap();
        let p = scene.reduced().unwrap();
        let h = scene.step.unwrap_or(1e-5);
        let mut a = Plant::new(&scene.model, Leapfrog, h).unwrap();
        let mut b = Plant::new(&p.model, Leapfrog, h).unwrap();
        let b0 = [
            frequency::bound(&scene.model, &State::initial(&scene.model)),
            frequency::bound(&p.model, &State::initial(&p.model)),
            frequency::estimate(&scene.model, &State::initial(&scene.model), 200),
            frequency::estimate(&p.model, &State::initial(&p.model), 200),
        ];
        let steps = (scene.duration / h).min(50000.0) as u64;
        let mut worst = 0.0_f64;
        let mut moved = 0.0_f64;
        let mut off = 0.0_f64;
        for _ in 0..100 {
            let s1 = a.advance(steps / 100);
            let s2 = b.advance(steps / 100);
            if s1.ok().is_err() || s2.ok().is_err() {
                println!("{name} {s1:?} {s2:?}");
                break;
            }
            for (row, (x, y)) in a.state().bodies.iter().zip(&b.state().bodies).enumerate() {
                let w = p.plane.state_outward(row, y);
                let d = x.position - w.position;
                worst = worst.max(d.dot(d).sqrt());
                let m = x.position - scene.model.initial[row].position;
                moved = moved.max(m.dot(m).sqrt());
                off = off.max(p.plane.place_inward(x.position).z.abs()).max(y.position.z.abs());
            }
        }
        let e = [
            energy(&scene.model, a.state(), h).total()
                - energy(&scene.model, &State::initial(&scene.model), h).total(),
            energy(&p.model, b.state(), h).total()
                - energy(&p.model, &State::initial(&p.model), h).total(),
        ];
        println!(
            "{name:15} t {:.2} moved {moved:.3} diff {worst:.2e} off {off:.1e} bounds {b0:.0?} dE {e:.1?}",
            steps as f64 * h
        );
    }
}
