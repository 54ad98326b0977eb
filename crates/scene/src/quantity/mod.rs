//! Numbers with units and the arithmetic between them: `30 deg`, `9 kN/mm`, `2 * L + 5 mm`.
//!
//! `(text, names) => SI value and dimension, or a fault with its place in the text`. Lengths, masses, times and angles
//! are separate dimensions; a number without a unit has none. `*` and `/` bind tighter than `+` and `-`, each from left
//! to right, and a unit directly after a number binds tightest: `5 N / 2 mm` is 2500 N/m. Whole powers, roots, sine,
//! cosine, tangent and their inverses are supported. A number with its units is converted in one rounding; every
//! further operation rounds once. This module is independent of files and scenes.

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
    /// Its dimension; none for a plain number.
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
/// Where the text is not a valid value; unknown units are errors as well.
pub fn evaluate(text: &str) -> Result<Quantity, Fault> {
    within(text, None)
}

/// The names of all units.
pub fn units() -> impl Iterator<Item = &'static str> {
    unit::UNITS.iter().map(|unit| unit.name)
}

/// The dimension of a key's unit in message form, e.g. `kg·m²`; text after a comma is ignored.
pub(crate) fn dimension_of(unit: &str) -> Dimension {
    let unit = unit.split(',').next().unwrap_or_default().trim();
    let found = evaluate(&format!("1 {unit}"));
    debug_assert!(found.is_ok(), "unknown unit `{unit}`");
    found.map(|quantity| quantity.dimension).unwrap_or_default()
}

#[cfg(test)]
mod property;
#[cfg(test)]
mod tests;
