//! Products, quotients, sums and differences of quantities.
//!
//! `(operand, operand) => operand, or a fault at its place`. A number absorbs the units by which it is multiplied or
//! divided before it is rounded: `9 kN/mm` is 9e6 in one rounding.

use std::ops::Range;

use crate::quantity::decimal::Decimal;
use crate::quantity::dimension::Dimension;
use crate::quantity::fault::Fault;
use crate::quantity::unit::Scale;

/// An operand of an operator.
pub(super) struct Operand<'t> {
    pub(super) worth: Worth<'t>,
    pub(super) dimension: Dimension,
    pub(super) place: Range<usize>,
    /// Whether it is written without brackets.
    pub(super) is_bare: bool,
}

#[derive(Clone, Copy)]
pub(super) enum Worth<'t> {
    /// A number with its units, not yet rounded.
    Written {
        number: Decimal<'t>,
        scale: Scale,
        is_negative: bool,
    },
    /// A unit without a number.
    Unit(Scale),
    Computed(f64),
}

impl<'t> Operand<'t> {
    pub(super) fn value(&self) -> f64 {
        match self.worth {
            Worth::Written { number, scale, is_negative: false } => number.of(scale),
            Worth::Written { number, scale, is_negative: true } => -number.of(scale),
            Worth::Unit(scale) => Decimal::ONE.of(scale),
            Worth::Computed(value) => value,
        }
    }

    /// Whether it is a number with its unit, without brackets.
    pub(super) fn has_unit(&self) -> bool {
        self.is_bare && matches!(self.worth, Worth::Written { .. }) && !self.dimension.is_none()
    }

    pub(super) fn negated(self) -> Self {
        let worth = match self.worth {
            Worth::Written { number, scale, is_negative } => {
                Worth::Written { number, scale, is_negative: !is_negative }
            }
            Worth::Unit(_) | Worth::Computed(_) => Worth::Computed(-self.value()),
        };
        Self { worth, ..self }
    }

    /// A product or a quotient.
    pub(super) fn times(self, right: Self, divided: bool) -> Result<Self, Fault> {
        let place = self.place.start..right.place.end;
        let beyond = || {
            let help = "use fewer units: exponents of length, mass, time and angle are at most 24";
            Fault::new(place.clone(), "exponent of the unit is too high", help)
        };
        let power = if divided { -1 } else { 1 };
        let dimension = self.dimension.times(right.dimension, power).ok_or_else(beyond)?;
        let worth = match (self.worth, right.worth) {
            (Worth::Written { number, scale, is_negative }, Worth::Unit(unit)) => {
                let scale = scale.times(unit, divided).ok_or_else(beyond)?;
                Worth::Written { number, scale, is_negative }
            }
            (Worth::Unit(scale), Worth::Unit(unit)) => {
                Worth::Unit(scale.times(unit, divided).ok_or_else(beyond)?)
            }
            (_, Worth::Unit(unit)) => {
                let unit = if divided { Scale::ONE.times(unit, true) } else { Some(unit) };
                Worth::Computed(unit.ok_or_else(beyond)?.of(self.value()))
            }
            _ => {
                let (value, by) = (self.value(), right.value());
                if !by.is_finite() {
                    // As a divisor it would give 0.
                    return Err(Fault::too_large(right.place));
                }
                if divided && by == 0.0 {
                    return Err(Fault::new(right.place, "division by 0", "use another divisor"));
                }
                Worth::Computed(if divided { value / by } else { value * by })
            }
        };
        Self { worth, dimension, place, is_bare: true }.finite()
    }

    /// A sum or a difference.
    pub(super) fn plus(self, right: Self, subtracted: bool) -> Result<Self, Fault> {
        if self.dimension != right.dimension {
            return Err(unlike(&self, &right));
        }
        let (value, other) = (self.value(), right.value());
        let sum = if subtracted { value - other } else { value + other };
        let place = self.place.start..right.place.end;
        let worth = Worth::Computed(sum);
        Self { worth, dimension: self.dimension, place, is_bare: true }.finite()
    }

    fn finite(self) -> Result<Self, Fault> {
        match self.worth {
            // A unit may still follow.
            Worth::Computed(value) if !value.is_finite() => Err(Fault::too_large(self.place)),
            _ => Ok(self),
        }
    }
}

/// The fault of a sum of different dimensions.
fn unlike(left: &Operand<'_>, right: &Operand<'_>) -> Fault {
    let (plain, other) = match (left.dimension.is_none(), right.dimension.is_none()) {
        (true, _) => (left, right),
        (_, true) => (right, left),
        _ => {
            let message = format!(
                "mismatched units: a value in {} and one in {}",
                right.dimension, left.dimension
            );
            let help = "operands of + and - must have one dimension";
            return Fault::new(right.place.clone(), message, help);
        }
    };
    let message = format!("mismatched units: a plain number and a value in {}", other.dimension);
    let help = format!(
        "give the number its unit, e.g. \"5 {0}\", or `* {0}` after a name",
        other.dimension
    );
    Fault::new(plain.place.clone(), message, help)
}
