//! `host-sim trade` on the command line.

use std::io::Write;

use clap::Args;
use dbd_plant::time::Time;
use dbd_study::files::Piece;
use dbd_study::{Phase, files};

use crate::arguments::SceneArgument;
use crate::cli::named::{ResultsArguments, load};
use crate::commands::trade::{TradeRequest, json as survey_json, trade};
use crate::commands::warnings::of_scene;
use crate::error::Error;
use crate::terminal::{Catalogue, Console, Exit, Found, Progress};

#[derive(Debug, Args)]
pub(super) struct TradeArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Longest comparison window, e.g. 0.2s; it ends before the motion becomes chaotic [default: 0.5s or
    /// the scene's duration]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    window: Option<Time>,
    /// Time that is a multiple of every step, e.g. a controller's 1ms [default: the scene's sampling interval,
    /// else a power of ten of at least ten steps]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    period: Option<Time>,
    #[command(flatten)]
    results: ResultsArguments,
    /// Print only errors
    #[arg(long)]
    quiet: bool,
    /// Print the window and all points as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn trade_scene(
    catalogue: &Catalogue,
    arguments: &TradeArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let called = &arguments.scene.scene;
    let Found { scene, file, .. } = load(catalogue, &arguments.scene)?;
    of_scene(&scene).iter().filter(|_| !arguments.quiet).for_each(|w| console.warn(w));
    let destination = arguments.results.destination(&file);
    let request = TradeRequest {
        called,
        window: arguments.window.map(Time::seconds),
        period: arguments.period.map(Time::seconds),
        out: &destination,
        shipped: Catalogue::shipped(&scene.name),
    };
    let mut silence = std::io::sink();
    let lines = if arguments.quiet { &mut silence as &mut dyn Write } else { &mut *console.err };
    let bars = console.terminal && !arguments.quiet;
    let mut progress = Progress::of(bars, "evaluations", lines);
    let done = trade(&scene, request, &mut |phase| match phase {
        Phase::Window => progress.begin("time until chaotic motion"),
        Phase::ReferenceSolution => progress.begin("reference solution"),
        Phase::SecondSolution => progress.begin("second reference solution"),
        Phase::Limits => progress.begin("largest stable steps"),
        Phase::Runs(done, all) => progress.update(done, all),
        Phase::Times(0, _) => progress.begin("measuring times"),
        Phase::Times(..) => {}
        Phase::Variants => progress.begin("alternative models of the mechanism"),
    });
    progress.finish();
    let (trade, folder) = done?;
    let report = files::Report { scene: &scene, called, trade: &trade };
    if arguments.json {
        console.print(&survey_json(&report, &file))?;
    } else if !arguments.quiet {
        let written = format!("{}/trade.{{csv,svg,html,json}}", folder.display());
        let look = console.look;
        let text = report.pieces().into_iter().map(|piece| match piece {
            Piece::Sentence(sentence) => look.sentence(&sentence),
            Piece::Lines(lines) => lines,
        });
        console.print(&format!("{}\nwritten  {written}\n", text.collect::<String>()))?;
    }
    Ok(Exit::Done)
}
