//! Takes steps of a scene or a chain: what `cargo xtask instructions` runs below callgrind, which counts nothing but
//! [`counted_steps`] and what it calls.
//!
//! `steps FILE|LINKS f64|f32|plain|flops STEPS`: prints what stepping came to, so that nothing of it is left out; with
//! `flops` the floating-point operations of a step in both precisions instead.

use std::hint::black_box;
use std::process::ExitCode;

use dbd_bench::chain::{self, Joints};
use dbd_bench::flops::per_step;
use dbd_bench::plain::Plain;
use dbd_kernel::{F32, F64, Geometry, Leapfrog, Plant};
use dbd_scene::{Scene, SceneModel};

/// Steps that are taken before: the first one of a run evaluates twice.
const BEFORE: u64 = 2;

/// What is counted. Its name is what callgrind is told.
#[inline(never)]
fn counted_steps(step: &mut dyn FnMut(u64), steps: u64) {
    step(steps);
}

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [what, how, steps] = arguments else {
        return Err("steps FILE|LINKS f64|f32|plain|flops STEPS".to_owned());
    };
    let steps: u64 = steps.parse().map_err(|why| format!("{steps}: {why}"))?;
    let (model, step) = match what.parse::<usize>() {
        Ok(links) => {
            (chain::model(links, Joints::Revolute).map_err(|why| why.to_string())?, chain::STEP)
        }
        Err(_) => {
            let scene = Scene::load(what).map_err(|why| format!("{what}: {why}"))?;
            (scene.model, scene.step.ok_or_else(|| format!("{what} gives no step"))?)
        }
    };
    match how.as_str() {
        "f64" => kernel::<F64>(&model, step, steps),
        "f32" => kernel::<F32>(&model, step, steps),
        "plain" => plain(&model, step, steps),
        "flops" => {
            let flops = (
                per_step::<f64, _>(&model, Leapfrog, step),
                per_step::<f32, _>(&model, Leapfrog, step),
            );
            let (Some(double), Some(single)) = flops else { return Err(format!("{what} fails")) };
            Ok(format!("{double} {single}"))
        }
        _ => Err(format!("there is no `{how}`: f64, f32, plain or flops")),
    }
}

fn kernel<P: Geometry>(model: &SceneModel<F64>, step: f64, steps: u64) -> Result<String, String> {
    let model: SceneModel<P> = model.convert();
    let mut plant = Plant::new(&model, Leapfrog, step).map_err(|why| format!("{why:?}"))?;
    let mut advance = |steps| {
        let _ = black_box(plant.advance(steps));
    };
    advance(BEFORE);
    counted_steps(&mut advance, steps);
    if plant.status().is_ok() {
        Ok(format!("{:016x}", plant.hash()))
    } else {
        Err("it failed".to_owned())
    }
}

fn plain(model: &SceneModel<F64>, step: f64, steps: u64) -> Result<String, String> {
    let mut plain = Plain::of_model(model, step).map_err(|why| why.to_string())?;
    plain.advance(BEFORE);
    counted_steps(&mut |steps| plain.advance(steps), steps);
    Ok(format!("{:?}", plain.bodies.first().map(|body| body.position)))
}
