//! Numbers with units and the arithmetic between them: `30 deg`, `9 kN/mm`, `2 * L + 5 mm`.
//!
//! `(text, names) => SI value and dimension, or a fault with its place in the text`. Lengths, masses, times
//! and angles are dimensions of their own; a number without a unit has none. `*` and `/` go before `+`
//! and `-`, each from left to right, and a unit right behind a number goes before all: `5 N / 2 mm`
//! is 2500 N/m. A value has whole powers and roots, an angle a sine, cosine and tangent. A number with its units is converted at once; every further operation
//! rounds once. Nothing here knows of files or scenes.

mod decimal;
mod dimension;
mod expression;
mod fault;
mod function;
mod operand;
mod scope;
mod unit;
mod word;

pub use dimension::Dimension;
pub(crate) use expression::within;
pub use fault::Fault;
pub(crate) use scope::{NameFault, Scope, check_name};
pub(crate) use word::words;

/// A value in SI units with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// \[SI unit of its dimension\] finite.
    pub value: f64,
    /// What it measures; none for a plain number.
    pub dimension: Dimension,
}

/// The value of a text of numbers and units: `20us`, `9 kN/mm`, `(1 + 2) / 3 * m`.
///
/// ```
/// let stiffness = dbd_scene::quantity::evaluate("9 kN/mm")?;
/// assert_eq!((stiffness.value, stiffness.dimension.to_string().as_str()), (9e6, "N/m"));
/// # Ok::<(), dbd_scene::quantity::Fault>(())
/// ```
///
/// # Errors
/// Where it is none; a name that is no unit is at fault, too.
pub fn evaluate(text: &str) -> Result<Quantity, Fault> {
    within(text, None)
}

/// The names of all units.
pub fn units() -> impl Iterator<Item = &'static str> {
    unit::UNITS.iter().map(|unit| unit.name)
}

/// The dimension of a key's unit as messages show it: `kg·m²`, and without what follows a comma.
pub(crate) fn dimension_of(unit: &str) -> Dimension {
    let unit = unit.split(',').next().unwrap_or_default().trim();
    let found = evaluate(&format!("1 {unit}"));
    debug_assert!(found.is_ok(), "`{unit}` is no unit");
    found.map(|quantity| quantity.dimension).unwrap_or_default()
}

#[cfg(test)]
mod property;
#[cfg(test)]
mod tests;
