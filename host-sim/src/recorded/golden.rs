//! A golden file as a recorded run, by itself or within a console log.
//!
//! `text => head, rows`. A run that a chip has printed can thus be compared unchanged.

use std::path::Path;

use dbd_golden::subject::BodyNumbers;
use dbd_golden::{Damage, Digits, Golden, Mismatch, recording};
use dbd_plant::number_format::{Digits as StoredDigits, NumberFormat};
use dbd_scene::BODY_COLUMNS;

use crate::recorded::head::{Head, Kind, Value};
use crate::recorded::row::Row;
use crate::recorded::unreadable::Unreadable;

/// Largest size of a golden file, which people read.
const MAX_GOLDEN_BYTES: u64 = 1 << 30;

/// The beginning of a golden file.
pub const FIRST: &str = "# dbd golden ";

/// Reads a golden file.
///
/// # Errors
/// If it cannot be read, is damaged, or contains no golden file.
pub fn read(file: &Path) -> Result<(Head, Vec<Row>), Unreadable> {
    let failed = |reason| Unreadable::system(file, &reason);
    let bytes = dbd_scene::file::read(file, MAX_GOLDEN_BYTES).map_err(failed)?;
    // A console log may contain anything else.
    let text = String::from_utf8_lossy(&bytes);
    let Some(record) = recording::within(&text).or(text.starts_with(FIRST).then_some(&text)) else {
        let problem = match text.contains(FIRST) {
            true => "the record is truncated: its last line, `# end: …`, is missing",
            false => "contains neither a run nor a golden file",
        };
        return Err(Unreadable::new(file, problem));
    };
    let before = record.as_ptr() as usize - text.as_ptr() as usize;
    let lines_before = text[..before].matches('\n').count() as u64;
    let golden = Golden::read(record).map_err(|mismatch| match mismatch {
        Mismatch::Damaged { line, damage } => {
            let wrong =
                Unreadable::new(file, damage.to_string()).at_line(lines_before + line as u64);
            match damage {
                Damage::Number(column) => {
                    let line = record.lines().nth(line - 1).unwrap_or_default();
                    let before: usize = line
                        .split('\t')
                        .take(column - 1)
                        .map(|text| text.chars().count() + 1)
                        .sum();
                    wrong.at_column(before + 1)
                }
                _ => wrong,
            }
        }
        other => Unreadable::new(file, other.to_string()).at_line(lines_before + 1),
    })?;
    let head = head(file, &golden)?;
    let rows = rows(&golden, &head);
    Ok((head, rows))
}

fn head(file: &Path, golden: &Golden<'_>) -> Result<Head, Unreadable> {
    let identity = golden.identity();
    let columns: Vec<&str> = golden.columns().collect();
    let numbers = BODY_COLUMNS.len() * identity.bodies;
    let bodies = columns[..numbers].chunks(BODY_COLUMNS.len()).map(|of| {
        let name = of[0].strip_suffix(BODY_COLUMNS[0])?;
        let own =
            of.iter().zip(BODY_COLUMNS).all(|(column, end)| column.strip_prefix(name) == Some(end));
        own.then(|| name.to_owned())
    });
    let Some(bodies) = bodies.collect::<Option<Vec<String>>>() else {
        return Err(Unreadable::new(file, "the columns do not match the bodies"));
    };
    let digits = |digits| match digits {
        Digits::Single => StoredDigits::Single,
        Digits::Double => StoredDigits::Double,
    };
    let values = columns[numbers + identity.turns..].iter();
    Ok(Head {
        file: file.to_owned(),
        kind: Kind::Golden,
        scene: golden.scene().to_owned(),
        scheme: identity.scheme.name.to_owned(),
        newton: None,
        rho: None,
        damping: Some(identity.scheme.damping.to_owned()),
        precision: identity.precision.name.to_owned(),
        orientation: identity.precision.orientation.to_owned(),
        step: identity.step_size,
        samples: golden.samples(),
        number_format: NumberFormat {
            position: digits(identity.number_format.position),
            orientation: digits(identity.number_format.orientation),
            velocity: digits(identity.number_format.velocity),
            reading: digits(identity.number_format.value),
        },
        bodies,
        values: values.map(|name| Value { name: (*name).to_owned(), unit: None }).collect(),
        status: None,
        set: Vec::new(),
        scene_file: None,
        scene_hash: None,
        model: Some(identity.model),
        version: None,
        unchecked: Vec::new(),
    })
}

fn rows(golden: &Golden<'_>, head: &Head) -> Vec<Row> {
    let turns = golden.identity().turns;
    let rows = golden.rows().map(|row| {
        let mut numbers = golden.numbers_of(&row);
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        Row {
            time: row.step as f64 * head.step,
            step: row.step,
            bodies: head.bodies.iter().map(|_| BodyNumbers::default().map(|_| next())).collect(),
            energies: None,
            turns: Some((0..turns).map(|_| next() as i32).collect()),
            values: head.values.iter().map(|_| next()).collect(),
            hash: Some(row.hash),
        }
    });
    rows.collect()
}
