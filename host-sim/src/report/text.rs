//! The texts of a run's page.
//!
//! `(scene, plan, summary) => failures, warnings, picture, tables, command line`, in HTML that needs no
//! scripts.

use dbd_plant::Plan;
use dbd_plant::time::display;
use dbd_report::data::{FORMAT, Table, Text};
use dbd_report::picture::{Mechanism, Paper};
use dbd_scene::Scene;
use dbd_study::command::with_changes;

use crate::report::summary::Summary;

/// Largest number of bodies in a still picture.
const MAX_PICTURED: usize = 300;
/// Largest number of listed warnings; the others are counted.
const MAX_WARNINGS: usize = 20;

/// The texts of a run's page. `called` is the scene's name on the command line.
#[must_use]
pub fn text(scene: &Scene, plan: &Plan, summary: &Summary, called: &str) -> Text {
    let failures = (summary.status != "ok").then(|| summary.status.clone());
    let pictured = scene.body_names.len() <= MAX_PICTURED;
    let cells = |(row, text): (&str, String)| vec![row.into(), text];
    let table = |title: &str, rows: Vec<(&'static str, String)>| Table {
        title: title.into(),
        columns: Vec::new(),
        rows: rows.into_iter().map(cells).collect(),
    };
    // Warnings are shown at the top of the page.
    let mut rows = summary.rows();
    rows.retain(|(row, _)| *row != "warning");
    let note = summary.state_hash.as_ref().map(|hash| {
        format!(
            "Equal state hashes ({hash}) mean equal bits: every position, orientation and \
             velocity at the end of the run."
        )
    });
    Text {
        failures: failures.into_iter().collect(),
        warnings: warnings(summary),
        picture: pictured.then(|| dbd_report::picture::svg(&Mechanism::of(scene), Paper::Page)),
        tables: vec![table("Summary", rows), table("Versions", versions(summary))],
        commands: vec![(String::new(), command(scene, plan, summary, called))],
        notes: note.into_iter().collect(),
        survey: None,
    }
}

/// The first warnings, and how many more there are.
fn warnings(summary: &Summary) -> Vec<String> {
    let all = &summary.warnings;
    let mut warnings: Vec<String> = all.iter().take(MAX_WARNINGS).cloned().collect();
    if let more @ 1.. = all.len() - warnings.len() {
        warnings.push(format!("{more} more in `summary.json`"));
    }
    warnings
}

/// The versions of the program and its files.
fn versions(summary: &Summary) -> Vec<(&'static str, String)> {
    let mut rows = vec![
        ("host-sim", summary.version.to_owned()),
        ("trace format", summary.trace_format.to_string()),
        ("page data format", FORMAT.to_string()),
    ];
    rows.extend(summary.scene_file.iter().map(|file| ("scene file", file.clone())));
    rows.extend(summary.scene_hash.iter().map(|hash| ("scene file hash", hash.clone())));
    rows
}

/// The command line of the run, with all chosen options.
fn command(scene: &Scene, plan: &Plan, summary: &Summary, called: &str) -> String {
    let newton = summary.newton.map(|n| format!(" --newton {n}")).unwrap_or_default();
    let rho = summary.rho.map(|rho| format!(" --rho {rho}")).unwrap_or_default();
    let damping = summary.damping.map(|way| format!(" --damping {way}")).unwrap_or_default();
    let orientation = match summary.orientation {
        "quaternion" => String::new(),
        other => format!(" --orientation {other}"),
    };
    let modes = summary.modes.as_ref().map(|modes| format!(" --modes {}", modes.len()));
    format!(
        "host-sim run {} --scheme {}{newton}{rho}{damping} --precision {}{orientation} --step {} \
         --duration {} --every {}{}",
        with_changes(scene, called),
        summary.scheme,
        summary.precision,
        display(plan.step),
        display(plan.duration),
        display(plan.time(plan.stride).min(plan.duration)),
        modes.unwrap_or_default(),
    )
}
