//! `host-sim advise` on the command line.

use std::io::Write;

use clap::Args;
use dbd_plant::time::Time;
use dbd_study::Phase;
use dbd_study::recommend::{Request, recommend};

use crate::arguments::SceneArgument;
use crate::cli::named::load;
use crate::commands::advise::{mcu, positive, rows};
use crate::commands::warnings::of_scene;
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Found, Progress};

#[derive(Debug, Args)]
pub(super) struct AdviseArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Class of the microcontroller: cortex-m0plus, cortex-m4f, cortex-m7, cortex-m7-double, cortex-m33, rv32imafc
    #[arg(long, value_name = "NAME", default_value = "cortex-m4f")]
    mcu: String,
    /// Clock frequency, e.g. 168MHz [default: typical of the class]
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true)]
    clock: Option<String>,
    /// Controller rate, e.g. 1kHz; its period is a whole number of steps
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true)]
    rate: Option<String>,
    /// Largest error of the motion, e.g. 0.1mm, root mean square over bodies and time [default: 1 % of the
    /// bodies' displacement]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    accuracy: Option<String>,
    /// Longest comparison window, e.g. 0.2s; it ends before the motion becomes chaotic [default: 0.5s or
    /// the scene's duration]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    window: Option<Time>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn advise_scene(
    catalogue: &Catalogue,
    arguments: &AdviseArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let mcu = mcu(&arguments.mcu)?;
    let number = |option, unit, example, text: &Option<String>| {
        text.as_ref().map(|text| positive(option, unit, example, text)).transpose()
    };
    let clock = number("clock", "Hz", "168MHz", &arguments.clock)?;
    let rate = number("rate", "Hz", "1kHz", &arguments.rate)?;
    let accuracy = number("accuracy", "m", "0.1mm", &arguments.accuracy)?;
    let Found { scene, .. } = load(catalogue, &arguments.scene)?;
    of_scene(&scene).iter().for_each(|warning| console.warn(warning));
    let request = Request {
        mcu,
        clock: clock.unwrap_or(mcu.clock),
        rate,
        accuracy,
        window: arguments.window.map(Time::seconds),
        shipped: Catalogue::shipped(&scene.name),
    };
    let bars = console.terminal;
    let mut progress = Progress::of(bars, "evaluations", &mut *console.err as &mut dyn Write);
    let found = recommend(&scene, &request, &mut |phase| match phase {
        Phase::Window => progress.begin("time until chaotic motion"),
        Phase::ReferenceSolution => progress.begin("reference solution"),
        Phase::SecondSolution => progress.begin("second reference solution"),
        Phase::Limits => progress.begin("methods, cheapest first"),
        Phase::Variants => progress.begin("scene variants"),
        Phase::Runs(..) | Phase::Times(..) => {}
    });
    progress.finish();
    let found = found?;
    if arguments.json {
        console.print(&json(&found))?;
    } else {
        let rows = rows(&scene, &arguments.scene.scene, &found);
        console.print(&console.look.table(&rows))?;
    }
    Ok(if found.meets { Exit::Done } else { Exit::Failed })
}
