//! Inputs with a table over a read-out; read once all read-outs are known.
//!
//! `table of [[input]], read-outs => source of the model`.

use dbd_kernel::F64;
use dbd_kernel::elements::source::SourceLaw;

use crate::assembly::Assembly;
use crate::drive::{Argument, Curve, curve};
use crate::error::SceneError;
use crate::free_length;
use crate::input::InputInfo;
use crate::interaction;
use crate::nearest::nearest;
use crate::readout::ReadoutInfo;
use crate::text::{Table, Text};

/// Reads the tables over read-outs.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
    inputs: &[InputInfo],
    readouts: &[ReadoutInfo],
) -> Result<(), SceneError> {
    for (table, info) in root.list("input")?.iter().zip(inputs) {
        if table.has("over") {
            let (curve, law) = read(table, readouts, info.unit)?;
            if info.kind == free_length::TYPE {
                interaction::check_lengths(table, "table", curve.least())?;
            }
            let added = assembly.add_source(info.index, law, &curve);
            added.map_err(|defect| defect.refuse(table))?;
        }
    }
    Ok(())
}

/// The sensor that a table is a function of, with the direction of a vector's column.
fn read(
    table: &Table<'_>,
    readouts: &[ReadoutInfo],
    unit: &'static str,
) -> Result<(Curve, SourceLaw<F64>), SceneError> {
    let name = table.required("over", Text::Name)?;
    let columns = readouts.iter().flat_map(|info| {
        let column = move |(row, (end, unit)): (usize, &(&'static str, &'static str))| {
            (format!("{}{end}", info.name), row, *unit, info)
        };
        info.columns.iter().enumerate().map(column)
    });
    let columns: Vec<_> = columns.collect();
    let Some((_, row, unit_over, info)) = columns.iter().find(|(column, ..)| *column == name)
    else {
        let help = match nearest(&name, columns.iter().map(|(column, ..)| column.as_str())) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => "expected a read-out, or one column of a vector read-out: \"NAME.x\"".into(),
        };
        let problem = format!("names no read-out column: \"{name}\"");
        return Err(table.refuse_value("over", &problem, help));
    };
    let Some(sensor) = info.readout.sensor() else {
        let problem = format!("names `{name}`, a read-out of type {}", info.kind);
        let help = "expected a joint_angle, joint_rate, point or point_velocity: read-outs of \
            forces or inputs would form a cycle; for a travel use a column of a point";
        return Err(table.refuse_value("over", &problem, help));
    };
    let curve = curve(table, Argument { unit: unit_over, name: "reading" }, unit)?;
    let weights = core::array::from_fn(|i| if i == *row { 1.0 } else { 0.0 });
    Ok((curve, SourceLaw::Over { sensor, weights, offset: 0.0 }))
}
