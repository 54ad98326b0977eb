//! Inputs of the type `free_length`, and the TSDAs whose free length they set.
//!
//! `tables of inputs and TSDAs => rows of TSDAs with the rows of their inputs`.

use std::collections::BTreeMap;

use crate::error::SceneError;
use crate::text::Table;

/// The name of the type.
pub(crate) const TYPE: &str = "free_length";

/// Whether an input is of this type.
pub(crate) fn is_of_type(input: &Table<'_>) -> bool {
    input.value("type").is_some_and(|value| value.get().as_str() == Some(TYPE))
}

/// The rows of TSDAs with a free length that an input sets, each with the row of the input.
pub(crate) fn winches(root: &Table<'_>) -> Result<BTreeMap<usize, usize>, SceneError> {
    let inputs: Vec<_> = root.list("input")?.into_iter().enumerate().collect();
    let mut winches = BTreeMap::new();
    if !inputs.iter().any(|(_, input)| is_of_type(input)) {
        return Ok(winches);
    }
    let tsdas = root.list("tsda")?;
    for (number, input) in inputs.iter().filter(|(_, input)| is_of_type(input)) {
        let Some(target) = input.value("target") else { continue };
        let Some(name) = target.get().as_str() else { continue };
        let named = |tsda: &Table<'_>| {
            tsda.value("name").is_some_and(|value| value.get().as_str() == Some(name))
        };
        let Some(row) = tsdas.iter().position(named) else { continue };
        if let Some(first) = winches.insert(row, *number) {
            let other = inputs.get(first).map_or("another input", |(_, other)| other.label());
            let problem = format!("names `{name}`, whose free length {other} sets");
            return Err(target.refuse_with(&problem, "name each tsda in one input only"));
        }
    }
    Ok(winches)
}
