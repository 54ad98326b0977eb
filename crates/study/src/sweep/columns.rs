//! Selected columns of a trace, and their statistics.
//!
//! `(names with wildcards, columns of the trace) => rows of the trace's columns`.

use dbd_scene::parameters::is_of;
use dbd_scene::{ENERGY_COLUMNS, Scene, nearest, shortened};

use crate::sweep::refusal::Refusal;
use crate::sweep::spec::Spec;

/// A column of a trace that the table has figures of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
}

/// The requested columns of a sweep, in the order of the trace.
///
/// # Errors
/// If a name is not a column of the scene.
pub fn columns(spec: &Spec, scene: &Scene) -> Result<Vec<Column>, Box<Refusal>> {
    let all = all(scene);
    let mut wanted = vec![false; all.len()];
    if spec.columns.is_empty() {
        let is_wanted =
            |name: &str| ENERGY_COLUMNS.contains(&name) || readout_of(scene, name).is_some();
        wanted = all.iter().map(|column| is_wanted(&column.name)).collect();
    }
    for asked in &spec.columns {
        let fits = |column: &Column| {
            let readout = readout_of(scene, &column.name);
            is_of(&asked.text, &column.name) || readout.is_some_and(|name| is_of(&asked.text, name))
        };
        let mut found = false;
        for (wanted, _) in wanted.iter_mut().zip(&all).filter(|(_, column)| fits(column)) {
            (*wanted, found) = (true, true);
        }
        if !found {
            let meant = nearest(&asked.text, all.iter().map(|column| column.name.as_str()));
            let meant = meant.map(|meant| format!("did you mean `{meant}`? "));
            let some: Vec<&str> = all.iter().take(24).map(|column| column.name.as_str()).collect();
            let more = if all.len() > some.len() { " …" } else { "" };
            let meant = meant.unwrap_or_default();
            let help = format!("{meant}the columns of its trace are {}{more}", some.join(", "));
            let message = format!("the scene has no column `{}`", shortened(&asked.text));
            return Err(spec.source.refuse(asked.place.clone(), message, help));
        }
    }
    let wanted = wanted.into_iter().zip(all).filter(|(wanted, _)| *wanted);
    Ok(wanted.map(|(_, column)| column).collect())
}

/// Every column of a trace but the time.
fn all(scene: &Scene) -> Vec<Column> {
    let unit = |name: &str| {
        if ENERGY_COLUMNS.contains(&name) {
            return "J".to_owned();
        }
        let readouts = scene.readouts.iter().flat_map(|readout| {
            readout.columns.iter().map(|(end, unit)| (readout.name.clone() + end, *unit))
        });
        if let Some((_, unit)) = readouts.into_iter().find(|(column, _)| column == name) {
            return unit.to_owned();
        }
        let end = name.rsplit('.').next().unwrap_or_default();
        match end {
            "x" | "y" | "z" => "m",
            "vx" | "vy" | "vz" => "m/s",
            "wx" | "wy" | "wz" => "rad/s",
            _ => "",
        }
        .to_owned()
    };
    let names = scene.columns().into_iter().skip(1);
    names.map(|name| Column { unit: unit(&name), name }).collect()
}

/// The read-out that a column belongs to.
fn readout_of<'s>(scene: &'s Scene, column: &str) -> Option<&'s str> {
    let found = scene.readouts.iter().find(|readout| {
        let ends = readout.columns.iter().map(|(end, _)| *end);
        column.strip_prefix(&readout.name).is_some_and(|rest| ends.into_iter().any(|e| e == rest))
    });
    found.map(|readout| readout.name.as_str())
}
