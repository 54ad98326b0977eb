//! Numbers as they are written, where the model no longer shows them: angles of orientations.
//!
//! `scene file => angles with their lines`.

use crate::error::SceneError;
use crate::text::{Number, Numbers, Table};

/// An angle of a body's orientation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenAngle {
    /// What messages call the body.
    pub(crate) owner: String,
    /// The key it is a value of.
    pub(crate) key: &'static str,
    /// The line, from 1.
    pub(crate) line: usize,
    /// \[rad\].
    pub(crate) angle: f64,
}

/// The angles of all bodies' orientations.
pub(crate) fn angles(root: &Table<'_>) -> Result<Vec<WrittenAngle>, SceneError> {
    let mut angles = Vec::new();
    let lines = root.line_starts();
    for table in root.list("body")? {
        let Some(value) = table.value("orientation") else { continue };
        let orientation = value.table("a table")?;
        let mut add = |key: &'static str, found: &[f64]| {
            let Some(value) = orientation.value(key) else { return };
            let line = lines.partition_point(|start| *start <= value.span().start);
            let written = |angle: &f64| WrittenAngle {
                owner: table.label().to_owned(),
                key,
                line,
                angle: *angle,
            };
            angles.extend(found.iter().map(written));
        };
        if let Some(angle) = orientation.optional("angle", Number::any("rad"))? {
            add("angle", &[angle]);
        }
        if let Some(angles) = orientation.optional("euler_321", Numbers::<3>(Number::any("rad")))? {
            add("euler_321", &angles);
        }
    }
    Ok(angles)
}
