//! A comparison for people: on the terminal and in the tables of the page.

use dbd_plant::digits::significant;
use dbd_plant::time::{display, rounded};

use crate::commands::compare::differs::{Differs, differs, grouped};
use crate::comparison::run::End;
use crate::comparison::{Comparison, Quantity, Verdict};
use crate::recorded::{Head, Kind};
use crate::terminal::Look;

/// Longest list of names.
const MAX_NAMES: usize = 8;

/// The properties of a run in a line.
#[must_use]
pub fn run(head: &Head, end: End) -> String {
    let newton =
        head.newton.filter(|newton| *newton > 0).map(|n| format!(" with {n} Newton iterations"));
    let what = if head.kind == Kind::Golden { "golden, " } else { "" };
    format!(
        "{}: {what}{}, {}{}, {}, step {}, {} samples to {}",
        head.file.display(),
        head.scene,
        head.scheme,
        newton.unwrap_or_default(),
        head.precision,
        display(head.step),
        end.samples,
        display(rounded(end.until, 12)),
    )
}

/// The verdict as text.
#[must_use]
pub fn verdict(comparison: &Comparison) -> String {
    let Comparison { first, beyond, samples, pairing, .. } = comparison;
    match comparison.verdict() {
        Verdict::Equal => format!("equal, bit for bit, in all {samples} common samples"),
        Verdict::Within => "different bits, every quantity within its band".into(),
        Verdict::Different => match (beyond, first) {
            (Some(beyond), _) => format!("different, first beyond its band at {beyond}"),
            (None, Some(_)) if !comparison.banded => "different".into(),
            _ if pairing.lacks_bodies() => "different: some bodies are in one run only".into(),
            _ if comparison.ended_apart() => {
                "different: only one run failed, or they failed at different times".into()
            }
            _ => "different".into(),
        },
    }
}

/// Notes, one sentence each.
#[must_use]
pub fn notes(comparison: &Comparison) -> Vec<String> {
    let mut notes = Vec::new();
    let [a, b] = &comparison.ends;
    let from_to = |time: f64| display(rounded(time, 12));
    if a.until != b.until && (a.until - b.until).abs() > 1e-9 * a.until {
        let (shorter, longer) = if a.until < b.until { ("A", "B") } else { ("B", "A") };
        notes.push(format!(
            "{shorter} ends at {}, {longer} at {}: only the common part is compared",
            from_to(a.until.min(b.until)),
            from_to(a.until.max(b.until)),
        ));
    }
    for (name, side) in ["A", "B"].into_iter().zip(0..) {
        let (head, alone) = (&comparison.heads[side], &comparison.pairing.alone[side]);
        if head.failed() {
            let status = head.status.as_deref().unwrap_or_default();
            notes.push(format!("{name} failed: {status}"));
        }
        for (kind, names) in [("bodies", &alone.bodies), ("read-outs", &alone.readouts)] {
            if !names.is_empty() {
                notes.push(format!("only {name} has the {kind} {}", list(names)));
            }
        }
        notes.extend(head.unchecked.iter().cloned());
    }
    notes.extend(finer(comparison));
    notes
}

/// Instructions for finding the exact step between two samples.
fn finer(comparison: &Comparison) -> Option<String> {
    let first = comparison.first.as_ref()?;
    let [a, _] = &comparison.heads;
    let [before, _] = first.equal_steps?;
    // With another method or scene, every step differs.
    const OTHER: [&str; 8] =
        ["scene", "scheme", "precision", "orientation", "step", "newton", "rho", "damping"];
    let other = |what: &str| OTHER.contains(&what) || what.starts_with("set ");
    let alike = !differs(comparison).iter().any(|fact| other(&fact.what));
    if !alike || before + 1 >= first.steps[0] {
        return None;
    }
    Some(format!(
        "the first step that differs is one of {} to {}; run both again with --every {} --duration {} to find it",
        before + 1,
        first.steps[0],
        display(a.step),
        display(rounded(first.time, 12)),
    ))
}

fn list(names: &[String]) -> String {
    let shown = names.iter().take(MAX_NAMES).map(|name| format!("`{name}`")).collect::<Vec<_>>();
    match names.len() > MAX_NAMES {
        true => format!("{} and {} more", shown.join(", "), names.len() - MAX_NAMES),
        false => shown.join(", "),
    }
}

/// Numbers between one and its double; larger counts are not informative.
const NOTHING_ALIKE: u64 = 1 << 52;

/// The columns of the table of quantities.
pub const COLUMNS: [&str; 6] = ["quantity", "RMS", "largest", "of", "at", "ULP"];

/// A row of the table of quantities.
#[must_use]
pub fn quantity(quantity: &Quantity, banded: bool) -> [String; 6] {
    let Quantity { name, unit, rms, largest, body, time, ulps, band, .. } = quantity;
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let number = |value: &Option<f64>| {
        value.map_or("not a number in one run".into(), |value| {
            format!("{}{unit}", significant(value, 4))
        })
    };
    if quantity.is_equal() {
        let dash = || "–".to_owned();
        return [name.clone(), "equal".into(), dash(), dash(), dash(), "0".into()];
    }
    let mut largest = number(largest);
    if let Some(band) = band.filter(|_| banded) {
        largest += &format!(" (band {band:?})");
    }
    let time = time.map_or("–".into(), |time| display(rounded(time, 6)));
    let ulps = match *ulps {
        None => "–".into(),
        Some(ulps) if ulps < 10_000_000 => ulps.to_string(),
        Some(ulps) if ulps < NOTHING_ALIKE => significant(ulps as f64, 3),
        Some(_) => "> 2^52".into(),
    };
    [name.clone(), number(rms), largest, body.clone().unwrap_or_else(|| "–".into()), time, ulps]
}

/// The printed text.
#[must_use]
pub fn text(comparison: &Comparison, look: Look) -> String {
    let [a, b] = &comparison.heads;
    let mut rows = vec![("A", run(a, comparison.ends[0])), ("B", run(b, comparison.ends[1]))];
    for Differs { what, a, b } in grouped(differs(comparison)) {
        let side = |side: Option<String>| side.unwrap_or_else(|| "–".into());
        rows.push(("differs", format!("{what}: {} in A, {} in B", side(a), side(b))));
    }
    let [from, until] = comparison.span.map(|time| display(rounded(time, 12)));
    rows.push(("compared", format!("{} samples from {from} to {until}", comparison.samples)));
    rows.push(("bits", verdict(comparison)));
    if let Some(first) = &comparison.first {
        rows.push(("first", first.to_string()));
    }
    rows.extend(notes(comparison).into_iter().map(|note| ("note", note)));
    let mut text = look.table(&rows);
    if comparison.first.is_some() {
        let lines = comparison.quantities.iter().map(|of| quantity(of, comparison.banded));
        text += "\n";
        text += &look.columns(Some(COLUMNS), &lines.collect::<Vec<_>>());
    }
    text
}
