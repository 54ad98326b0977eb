//! probe
use std::time::Instant;
use dbd_ensemble::*;
use dbd_kernel::*;
use dbd_scene::*;
fn go<R: Number>(name: &str, set: InstructionSet, steps: u64) where  {
    let text = std::fs::read_to_string(format!("scenes/{name}.toml")).unwrap();
    let scene = Scene::parse(&text, name).unwrap();
    let h = scene.step.unwrap_or(1e-4);
    let n = 16;
    let models: Vec<SceneModel<geometry::Float<R>>> = (0..n).map(|i| {
        let mut m = scene.model.convert::<geometry::Float<R>>();
        for b in &mut m.initial { b.velocity.x = b.velocity.x + R::from_f64(1e-3 * i as f64); }
        m }).collect();
    let mut e = Ensemble::with_instructions(models.clone(), Leapfrog, h, set).unwrap();
    let mut singles: Vec<_> = models.iter().map(|m| Plant::new(m, Leapfrog, h).unwrap()).collect();
    let (mut best_e, mut best_s) = (f64::MAX, f64::MAX);
    for _ in 0..7 {
        let t = Instant::now(); e.advance(steps); best_e = best_e.min(t.elapsed().as_secs_f64());
        let t = Instant::now(); for p in &mut singles { let _ = p.advance(steps); } best_s = best_s.min(t.elapsed().as_secs_f64());
    }
    let same = (0..n).all(|i| e.plant(i).hash() == singles[i].hash() && e.status(i) == singles[i].status());
    println!("{name} {} {} ratio {:.2} same {same}", <R as geometry::Named>::NAME, set.name(), best_s / best_e);
}
fn main() {
    let steps = std::env::args().nth(2).map_or(2000, |s| s.parse().unwrap());
    let names = std::env::args().nth(1).unwrap_or("hexagon".into());
    for name in names.split(',') {
    for set in [InstructionSet::Avx2] { if set.is_there() { go::<f32>(name, set, steps); if std::env::args().nth(3).is_some() { go::<f64>(name, set, steps); } } }
    }
}
