//! `host-sim reproduce` on the command line.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_study::paper::page::{HEAD, columns};

use crate::commands::reproduce::{items, json, reproduce};
use crate::error::Error;
use crate::terminal::{Console, Exit, Progress};

#[derive(Debug, Args)]
pub(super) struct ReproduceArguments {
    /// Items of the paper, e.g. table-7a or fig-18 [default: those that take seconds]
    #[arg(value_name = "ITEM")]
    items: Vec<String>,
    /// Measure every item; takes minutes and resumes after an interruption
    #[arg(long, conflicts_with = "items")]
    all: bool,
    /// Folder for results
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Print only errors
    #[arg(long)]
    quiet: bool,
    /// Print the results as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn reproduce_items(
    arguments: &ReproduceArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let wanted = items(&arguments.items, arguments.all)?;
    let mut silence = std::io::sink();
    let lines = if arguments.quiet { &mut silence as &mut dyn Write } else { &mut *console.err };
    let bars = console.terminal && !arguments.quiet;
    let mut progress = Progress::of(bars, "items", lines);
    let done = reproduce(&wanted, &arguments.out, &mut |item| progress.begin(item.title));
    progress.finish();
    let (findings, folder) = done?;
    if arguments.json {
        console.print(&json(&findings))?;
        return Ok(Exit::Done);
    }
    if arguments.quiet {
        return Ok(Exit::Done);
    }
    let look = console.look;
    let mut text = String::new();
    for finding in &findings {
        let verdict = finding.verdict().map_or("–", |verdict| verdict.words());
        text += &look.sentence(&format!("{} ({}): {verdict}", finding.title, finding.place));
        let lines: Vec<[String; 5]> = finding
            .rows
            .iter()
            .map(|row| {
                let [quantity, paper, ours, ratio, verdict, _] = columns(row);
                [quantity, paper, ours, ratio, verdict]
            })
            .collect();
        let [quantity, paper, ours, ratio, verdict, _] = HEAD;
        text += &look.columns(Some([quantity, paper, ours, ratio, verdict]), &lines);
        text.push('\n');
    }
    text += &format!("written  {}/reproduce.{{html,md,json}}\n", folder.display());
    console.print(&text)?;
    Ok(Exit::Done)
}
