//! `[[torsion_spring]]`: a spring about an axis of the first body, with preload and damping.

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::pair::Between;
use crate::spring;
use crate::text::{Direction, Number, Table};

const KEYS: &[&str] = &["between", "axis", "preload"];

/// Reads all torsion springs in scene order and names them for messages:
/// `torsion_spring 1 (world–crank)`.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
) -> Result<Vec<String>, SceneError> {
    let mut names = Vec::new();
    for table in root.list("torsion_spring")? {
        table.only(&[KEYS, spring::KEYS])?;
        let pair = table.required("between", Between(assembly))?;
        let axis = table.required("axis", Direction)?;
        let spring = spring::read(&table, spring::TORSIONAL)?;
        let preload = table.optional("preload", Number::any("N·m"))?.unwrap_or(0.0);
        assembly
            .add_torsion_spring(&pair, axis, spring, preload)
            .map_err(|defect| defect.refuse(&table))?;
        let [a, b] = &pair.names;
        names.push(format!("{} ({a}–{b})", table.label()));
    }
    Ok(names)
}
