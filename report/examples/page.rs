//! Writes the page of a scene's run: `cargo run -p dbd-report --example page SCENE.toml PAGE.html`.

use dbd_picture::{Mechanism, Paper};
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::{Frequencies, Method, plant};
use dbd_report::data::{Chart, Data, FORMAT, Film, Kind, Line, Run, Section, Table, Text};
use dbd_report::packed::{F32s, F64s, I16s};
use dbd_report::page::html;
use dbd_scene::Scene;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(scene), Some(page)) = (arguments.next(), arguments.next()) else {
        return Err("give a scene and a page".into());
    };
    let scene = Scene::load(&scene)?;
    let method = Method::default();
    let step = match scene.step {
        Some(step) => StepRequest::Given(step),
        None => StepRequest::AtMost(Frequencies::of(&scene).default_limit(scene.duration)),
    };
    let plan = plan(&Request { step, duration: scene.duration, every: scene.every })?;
    let mut plant = plant(&scene, &method, plan.step)?;
    let mechanism = Mechanism::of(&scene);
    let (mut times, mut kinetic, mut potential, mut poses) = (vec![], vec![], vec![], vec![]);
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    loop {
        let state = plant.state();
        times.push(plant.time());
        let energy = plant.energy();
        kinetic.push(energy.kinetic);
        potential.push(energy.potential());
        for body in &state.bodies {
            let position = body.position.to_f64();
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
            poses.push((position, body.orientation.to_f64()));
        }
        if state.step >= plan.steps {
            break;
        }
        plant.advance(plan.stride.min(plan.steps - state.step)).ok()?;
    }
    let mut words = Vec::new();
    for (position, orientation) in poses {
        for axis in 0..3 {
            let share = (position[axis] - low[axis]) / (high[axis] - low[axis]).max(1e-300);
            words.push((share * 65534.0 - 32767.0).round() as i16);
        }
        words.extend(orientation.map(|q| (q * 32767.0).round() as i16));
    }
    let frames = times.len();
    let zeros = |each: usize| F32s(vec![0.0; frames * each]);
    let film = Film {
        times: F64s(times.clone()),
        bodies: scene.body_names.len(),
        low,
        high,
        poses: I16s(words),
        springs: zeros(mechanism.springs.len()),
        joints: zeros(2 * mechanism.joints.len()),
        joint_springs: zeros(mechanism.joint_springs.len()),
        forces: zeros(mechanism.forces.len()),
        traces: vec![],
    };
    let line = |name: &str, values: Vec<f64>| Line {
        name: name.into(),
        initial: values[0],
        deviation: false,
        still: false,
        low: values.iter().copied().fold(f64::INFINITY, f64::min),
        high: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        values: F32s::rounded(values),
    };
    let chart = Chart {
        section: Section::Energy,
        title: "Energy".into(),
        quantity: "energy".into(),
        unit: "J".into(),
        body: None,
        joint: None,
        lines: vec![line("kinetic", kinetic), line("potential", potential)],
    };
    let picture = dbd_picture::svg(&mechanism, Paper::Page);
    let run = Run {
        mechanism: Some(mechanism),
        film: Some(film),
        times: F64s(times),
        charts: vec![chart],
        ..Run::default()
    };
    let data = Data {
        format: FORMAT,
        kind: Kind::Run,
        name: scene.name.clone(),
        description: scene.description.clone(),
        runs: vec![run],
        differences: vec![],
        difference_times: F64s::default(),
        first_difference: None,
        modes: vec![],
        text: Text {
            picture: Some(picture),
            tables: vec![Table {
                title: "Summary".into(),
                columns: vec![],
                rows: vec![vec!["scene".into(), scene.name.clone()]],
            }],
            commands: vec![(String::new(), format!("host-sim run {}", scene.name))],
            ..Text::default()
        },
    };
    std::fs::write(page, html(&data))?;
    Ok(())
}
