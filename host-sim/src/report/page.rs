//! `report.html`: one page that needs no other file.
//!
//! `(scene, summary, curves) => HTML` with a picture of the mechanism, the summary, the energies, the
//! read-outs and the path of every body, and what it takes to run it again.

use std::fmt::Write as _;

use dbd_output::markup::{PAGE_STYLE, escape};
use dbd_output::panel::{Line, Panel, svg};
use dbd_picture::{Mechanism, Paper};
use dbd_plant::Plan;
use dbd_plant::time::display;
use dbd_scene::Scene;
use dbd_study::command::with_changes;

use crate::report::curves::{Curve, Curves};
use crate::report::summary::Summary;

/// What a report is made from.
pub struct Report<'r> {
    /// The scene.
    pub scene: &'r Scene,
    /// The plan of the run.
    pub plan: &'r Plan,
    /// Its summary.
    pub summary: &'r Summary,
    /// Its curves.
    pub curves: &'r Curves,
    /// What a command line calls the scene.
    pub called: &'r str,
}

/// Distinct for people who see few colours, too (Okabe & Ito 2008).
const COLOURS: [&str; 3] = ["#0072b2", "#d55e00", "#009e73"];

const WIDE: (f64, f64) = (1000.0, 280.0);
const HALF: (f64, f64) = (490.0, 250.0);

/// The picture's letters are as large as the page's, a little larger at most.
const PICTURE: &str = "max-width:40rem;margin-top:1.5rem";

/// The page.
#[must_use]
pub fn html(report: &Report<'_>) -> String {
    let Report { scene, summary, curves, .. } = report;
    let name = escape(&scene.name);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}</title>\n<style>\n{PAGE_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>{name}</h1>\n"
    );
    if !scene.description.is_empty() {
        let _ = writeln!(page, "<p class=\"lead\">{}</p>", escape(&scene.description));
    }
    if summary.status != "ok" {
        let status = escape(&summary.status);
        let _ = writeln!(page, "<p class=\"failed\"><strong>Failed:</strong> {status}.</p>");
    }
    let picture = dbd_picture::svg(&Mechanism::of(scene), Paper::Page);
    let _ = writeln!(page, "<figure style=\"{PICTURE}\">\n{picture}</figure>");
    page.push_str("<h2>Summary</h2>\n<table>\n");
    for (row, text) in summary.rows() {
        let _ = writeln!(page, "<tr><th>{row}</th><td>{}</td></tr>", escape(&text));
    }
    page.push_str("</table>\n");

    // A run that failed before its second sample has nothing to draw.
    if curves.kinetic.points.len() > 1 {
        figures(&mut page, scene, curves);
    }

    let _ = writeln!(page, "<h2>Run it again</h2>\n<pre>{}</pre>", escape(&command(report)));
    if let Some(hash) = &summary.state_hash {
        let _ = writeln!(
            page,
            "<p>The same state hash, <code>{hash}</code>, means the same bits: every position, \
             orientation and velocity at the end of the run.</p>"
        );
    }
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn figures(page: &mut String, scene: &Scene, curves: &Curves) {
    page.push_str("<h2>Energy</h2>\n");
    let lines = [("kinetic", &curves.kinetic), ("potential", &curves.potential)];
    figure(page, "", WIDE, ("energy", "J"), &lines);
    let lines = [("total less that at t = 0", &curves.change)];
    figure(page, "", WIDE, ("change", "J"), &lines);

    if !scene.readouts.is_empty() {
        readouts(page, scene, curves);
    }

    page.push_str("<h2>Positions</h2>\n<div class=\"grid\">\n");
    for (body, [x, y, z]) in scene.body_names.iter().zip(&curves.positions) {
        figure(page, body, HALF, ("position", "m"), &[("x", x), ("y", y), ("z", z)]);
    }
    page.push_str("</div>\n");
}

/// A figure for each read-out; two for an inertial measurement unit, whose quantities are two.
fn readouts(page: &mut String, scene: &Scene, curves: &Curves) {
    page.push_str("<h2>Read-outs</h2>\n<div class=\"grid\">\n");
    let mut curves = curves.readings.iter();
    for readout in &scene.readouts {
        for columns in readout.columns.chunks(3) {
            let lines: Vec<_> = columns
                .iter()
                .zip(&mut curves)
                .map(|((column, _), curve)| (column.trim_start_matches('.'), curve))
                .collect();
            let unit = columns.first().map_or("", |(_, unit)| unit);
            figure(page, &readout.name, HALF, (quantity(readout.kind, unit), unit), &lines);
        }
    }
    page.push_str("</div>\n");
}

/// What a read-out of a type shows.
fn quantity(kind: &str, unit: &str) -> &'static str {
    match (kind, unit) {
        ("joint_angle", _) => "angle",
        ("joint_rate", _) | ("imu", "rad/s") => "rate",
        ("point", _) => "position",
        ("point_velocity", _) => "velocity",
        ("tsda_force", _) => "tension",
        ("joint_force", _) => "force",
        ("imu", _) => "specific force",
        _ => "input",
    }
}

/// The command line of the run, with all that was chosen for it spelled out.
fn command(report: &Report<'_>) -> String {
    let Report { plan, summary, scene, called, .. } = report;
    let newton = summary.newton.map(|n| format!(" --newton {n}")).unwrap_or_default();
    let damping = summary.damping.map(|way| format!(" --damping {way}")).unwrap_or_default();
    let orientation = match summary.orientation {
        "quaternion" => String::new(),
        other => format!(" --orientation {other}"),
    };
    format!(
        "host-sim run {} --scheme {}{newton}{damping} --precision {}{orientation} --step {} \
         --duration {} --every {}",
        with_changes(scene, called),
        summary.scheme,
        summary.precision,
        display(plan.step),
        display(plan.duration),
        display(plan.time(plan.stride).min(plan.duration)),
    )
}

fn figure(
    page: &mut String,
    title: &str,
    size: (f64, f64),
    (quantity, unit): (&str, &str),
    curves: &[(&str, &Curve)],
) {
    let coloured = || curves.iter().zip(COLOURS);
    let lines =
        coloured().map(|((_, curve), colour)| Line { points: &curve.points, colour }).collect();
    let Some(drawing) = svg(&Panel { size, quantity, unit, lines }) else { return };
    page.push_str("<figure>\n<figcaption>");
    if !title.is_empty() {
        let _ = write!(page, "<strong>{}</strong>", escape(title));
    }
    for ((name, _), colour) in coloured().filter(|((name, _), _)| !name.is_empty()) {
        let _ =
            write!(page, "<span class=\"key\"><i style=\"background:{colour}\"></i>{name}</span>");
    }
    let _ = writeln!(page, "</figcaption>\n{}</figure>", drawing.trim_start());
}
