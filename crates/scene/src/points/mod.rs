//! `[points]`: named points, and the values that may refer to them.
//!
//! `table => places`, world, at the initial pose. Points and bodies may depend on each other: a point in a body's
//! frame, a body between two points. They are read in order of dependency.

mod forms;
mod heading;
mod order;
mod place;
mod places;

use crate::error::SceneError;
use crate::text::{Table, Value};

pub(crate) use forms::{KEYS, body_frame, precise_direction};
pub(crate) use heading::Heading;
pub(crate) use order::{Node, order};
pub(crate) use place::{Place, PlaceOf, PrecisePlace};
pub(crate) use places::{Frame, Places};

/// The points of a scene as they are written, in their order.
pub(crate) fn written<'t>(root: &Table<'t>) -> Result<Vec<(String, Value<'t>)>, SceneError> {
    let Some(value) = root.value("points") else { return Ok(Vec::new()) };
    let expected = "a table of named points: A = [x, y, z]";
    value.table(expected)?.called("[points]").named()
}
