//! Writes the page of a scene's run: `cargo run -p dbd-report --example page SCENE.toml PAGE.html`.

use dbd_picture::{Mechanism, Paper};
use dbd_plant::judge::Judge;
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::{Frequencies, Method, plant};
use dbd_report::data::{Data, Text};
use dbd_report::page::html;
use dbd_report::{Recording, Sample};
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
    let mut judge = Judge::new(&scene, plant.as_ref());
    let mut recording = Recording::new(&scene, &method, &plan)?;
    loop {
        let state = plant.state();
        let energy = judge.judge(&state).map_err(|trouble| format!("{trouble:?}"))?.energy;
        let mut readings = Vec::new();
        for info in &scene.readouts {
            dbd_plant::readings::append(
                plant.read(&info.readout),
                info.columns.len(),
                &mut readings,
            );
        }
        recording.push(&Sample {
            time: plant.time(),
            state: &state,
            readings: &readings,
            energy,
            extensions: judge.extensions(),
        });
        if state.step >= plan.steps {
            break;
        }
        plant.advance(plan.stride.min(plan.steps - state.step)).ok()?;
    }
    let recorded = recording.finish();
    let mut data = Data::of_run(&scene.name, &scene.description, recorded.run);
    data.text = Text {
        picture: Some(dbd_picture::svg(&Mechanism::of(&scene), Paper::Page)),
        ..Text::default()
    };
    std::fs::write(page, html(&data))?;
    Ok(())
}
