//! Roots, angles and powers in a value's text.
//!
//! `(function, quantity) => quantity, or a fault at its place`. All are computed when a scene is read, by libm or in
//! double-double arithmetic, so that every host gets the same number.

use crate::precise::sine_and_cosine;
use crate::quantity::dimension::Dimension;
use crate::quantity::fault::Fault;
use crate::quantity::operand::{Operand, Worth};

/// The dimension of an angle.
const ANGLE: Dimension = Dimension::new(0, 0, 0, 1);

/// Largest exponent of a value.
pub(super) const HIGHEST: u64 = 9;

/// A function of one argument in brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Root,
    Sine,
    Cosine,
    Tangent,
    Arcsine,
    Arccosine,
    Arctangent,
}

/// Their names.
pub(super) const FUNCTIONS: [(&str, Function); 7] = [
    ("sqrt", Function::Root),
    ("sin", Function::Sine),
    ("cos", Function::Cosine),
    ("tan", Function::Tangent),
    ("asin", Function::Arcsine),
    ("acos", Function::Arccosine),
    ("atan", Function::Arctangent),
];

/// The function of a name.
pub(super) fn find(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

impl Function {
    /// Its value at an argument. The operand keeps the argument's position.
    pub(super) fn of<'t>(self, argument: Operand<'t>) -> Result<Operand<'t>, Fault> {
        let value = argument.value();
        if !value.is_finite() {
            return Err(Fault::too_large(argument.place));
        }
        let refuse =
            |message: String, help: &str| Err(Fault::new(argument.place.clone(), message, help));
        let plain = Dimension::default();
        let (value, dimension) = match self {
            Self::Root => {
                let Some(dimension) = argument.dimension.root() else {
                    let message = format!("a value in {} has no square root", argument.dimension);
                    return refuse(message, "expected a square, e.g. sqrt(a * a + b * b)");
                };
                if value < 0.0 {
                    return refuse(
                        format!("square root of {value}"),
                        "expected a value that is 0 or more",
                    );
                }
                (libm::sqrt(value), dimension)
            }
            Self::Sine | Self::Cosine | Self::Tangent => {
                if ![ANGLE, plain].contains(&argument.dimension) {
                    let message = format!("a value in {} is not an angle", argument.dimension);
                    return refuse(
                        message,
                        "expected an angle, e.g. sin(30 deg), or a plain number of radians",
                    );
                }
                let (sine, cosine) = sine_and_cosine(value);
                let value = match self {
                    Self::Sine => sine,
                    Self::Cosine => cosine,
                    _ if cosine.nearest() == 0.0 => {
                        return refuse("the tangent is infinite".into(), "use another angle");
                    }
                    _ => sine / cosine,
                };
                (value.nearest(), plain)
            }
            Self::Arcsine | Self::Arccosine | Self::Arctangent => {
                if argument.dimension != plain {
                    let message = format!("a value in {} is not a ratio", argument.dimension);
                    return refuse(message, "expected a plain number, e.g. atan(rise / run)");
                }
                if self != Self::Arctangent && value.abs() > 1.0 {
                    return refuse(
                        format!("ratio out of range: {value}"),
                        "expected a ratio from \
                                                                           -1 to 1",
                    );
                }
                let angle = match self {
                    Self::Arcsine => libm::asin(value),
                    Self::Arccosine => libm::acos(value),
                    _ => libm::atan(value),
                };
                (angle, ANGLE)
            }
        };
        let place = argument.place;
        Ok(Operand { worth: Worth::Computed(value), dimension, place, is_bare: false })
    }
}

/// A whole power of an operand: the product from left to right, or its reciprocal.
pub(super) fn power(base: Operand<'_>, exponent: i8, end: usize) -> Result<Operand<'_>, Fault> {
    let place = base.place.start..end;
    let value = base.value();
    if !value.is_finite() {
        return Err(Fault::too_large(place));
    }
    if exponent < 0 && value == 0.0 {
        return Err(Fault::new(place, "division by 0", "use another base"));
    }
    let Some(dimension) = Dimension::default().times(base.dimension, exponent) else {
        let help = "use fewer units: exponents of length, mass, time and angle are at most 24";
        return Err(Fault::new(place, "exponent of the unit is too high", help));
    };
    let product = (1..exponent.unsigned_abs()).fold(value, |product, _| product * value);
    let value = if exponent < 0 { 1.0 / product } else { product };
    if !value.is_finite() {
        return Err(Fault::too_large(place));
    }
    Ok(Operand { worth: Worth::Computed(value), dimension, place, is_bare: true })
}
