//! Numbers, with or without units: plain ones in SI, or texts such as `"30 deg"` and `"2 * L"`.
//!
//! `value => number in the key's unit`. A plain number keeps its bits; a text must have the key's dimension or be a
//! plain number.

use toml::de::DeValue;

use crate::error::SceneError;
use crate::quantity::{Dimension, Quantity, dimension_of, within};
use crate::shortened::shortened;
use crate::text::value::{Kind, Value};

/// A finite number, including integers.
#[derive(Clone, Copy)]
pub(crate) struct Number {
    unit: &'static str,
    least: Least,
}

#[derive(Clone, Copy, PartialEq)]
enum Least {
    Any,
    Zero,
    AboveZero,
}

impl Number {
    /// Any finite number.
    pub(crate) const fn any(unit: &'static str) -> Self {
        Self { unit, least: Least::Any }
    }

    /// A number ≥ 0.
    pub(crate) const fn not_negative(unit: &'static str) -> Self {
        Self { unit, least: Least::Zero }
    }

    /// A number > 0.
    pub(crate) const fn positive(unit: &'static str) -> Self {
        Self { unit, least: Least::AboveZero }
    }

    fn range(self) -> &'static str {
        match self.least {
            Least::Any => "",
            Least::Zero => " ≥ 0",
            Least::AboveZero => " > 0",
        }
    }

    fn holds(self, number: f64) -> bool {
        let right = match self.least {
            Least::Any => true,
            Least::Zero => number >= 0.0,
            // A subnormal number has no finite inverse.
            Least::AboveZero => number >= f64::MIN_POSITIVE,
        };
        right && number.is_finite()
    }

    fn in_unit(self) -> String {
        if self.unit.is_empty() { String::new() } else { format!(" in {}", self.unit) }
    }
}

impl Kind for Number {
    type Output = f64;

    fn expected(&self) -> String {
        let example = if self.unit == "s" { ", or a text with its unit: \"20us\"" } else { "" };
        format!("a finite number{}{}{example}", self.range(), self.in_unit())
    }

    fn read(&self, value: &Value<'_>) -> Result<f64, SceneError> {
        let number = read(value, || self.expected())?;
        let is_text = value.get().is_str();
        if is_text && !number.dimension.is_none() {
            let own = dimension_of(self.unit);
            if number.dimension != own {
                return Err(unlike(value, number.dimension, own, &self.expected()));
            }
        }
        let is_plain = number.dimension.is_none();
        let number = number.value;
        if !self.holds(number) {
            let written = shortened(value.written());
            let problem = match is_text {
                true => format!("is {written}, which is {number:?}"),
                false => format!("is {written}"),
            };
            return Err(value.refuse(&problem, &self.expected()));
        }
        if let Some(angles) = value.source.angles.filter(|_| is_plain && self.unit == "rad") {
            let names = [&value.key.to_string(), &*value.owner];
            angles.note(number, names, value.source.text, value.span().start);
        }
        if let Some(log) = value.source.log {
            log.note(value.span(), number, self.unit);
        }
        Ok(number)
    }
}

/// The error of a value with the wrong dimension.
fn unlike(value: &Value<'_>, found: Dimension, own: Dimension, expected: &str) -> SceneError {
    let problem = format!("is {}, a value in {found}", shortened(value.written()));
    let help = match own.angles_to(found) {
        Some(1..) => "; an angle is a dimension: divide by `rad`, or by `turn` for revolutions",
        Some(_) => "; an angle is a dimension: multiply by `rad`, or by `turn` for revolutions",
        None if own.is_none() => ", without a unit: divide by it",
        None => "",
    };
    value.refuse(&problem, &format!("{expected}{help}"))
}

/// A time.
pub(crate) struct Seconds;

impl Seconds {
    /// Any finite time.
    pub(crate) const fn any() -> Number {
        Number::any("s")
    }

    /// A time > 0.
    pub(crate) const fn positive() -> Number {
        Number::positive("s")
    }
}

/// A finite number of any dimension.
#[derive(Clone, Copy)]
pub(crate) struct Measure;

impl Kind for Measure {
    type Output = Quantity;

    fn expected(&self) -> String {
        "a finite number, or a text such as \"30 deg\" or \"2 * L + 5 mm\"".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Quantity, SceneError> {
        let quantity = read(value, || self.expected())?;
        if !quantity.value.is_finite() {
            let problem = format!("is {}", shortened(value.written()));
            return Err(value.refuse(&problem, &self.expected()));
        }
        Ok(quantity)
    }
}

/// The value of a number or a text; infinite where a number is too large.
fn read(value: &Value<'_>, expected: impl Fn() -> String) -> Result<Quantity, SceneError> {
    if let Some(text) = value.get().as_str() {
        return within(text, value.source.scope)
            .map_err(|fault| value.refuse_within(text, &fault, &expected()));
    }
    let value = number(value).ok_or_else(|| value.wrong_type(&expected()))?;
    Ok(Quantity { value, dimension: Dimension::default() })
}

/// The number nearest to the text; infinite on overflow.
fn number(value: &Value<'_>) -> Option<f64> {
    match value.get() {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        DeValue::Integer(integer) => {
            i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|i| i as f64)
        }
        _ => None,
    }
}

/// An array of `N` numbers, each of one kind.
#[derive(Clone, Copy)]
pub(crate) struct Numbers<const N: usize>(pub(crate) Number);

impl<const N: usize> Kind for Numbers<N> {
    type Output = [f64; N];

    fn expected(&self) -> String {
        format!("an array of {N} finite numbers{}{}", self.0.range(), self.0.in_unit())
    }

    fn read(&self, value: &Value<'_>) -> Result<[f64; N], SceneError> {
        let mut numbers = [0.0; N];
        for (number, entry) in numbers.iter_mut().zip(value.entries(N, || self.expected())?) {
            *number = self.0.read(&entry)?;
        }
        Ok(numbers)
    }
}

#[cfg(test)]
mod tests {
    use crate::error::Source;
    use crate::text::{Number, parse, root};

    #[test]
    fn numbers_of_every_notation_are_the_nearest_doubles() {
        for (text, expected) in [
            ("x = 3", 3.0),
            ("x = +1_000", 1000.0),
            ("x = 0x1F", 31.0),
            ("x = 0b101", 5.0),
            ("x = 9007199254740993", 9007199254740992.0),
            ("x = 123456789012345678901234567890", 1.2345678901234568e29),
            ("x = 20e-6", 2e-5),
            ("x = 1_0.5", 10.5),
            ("x = -4.9e-324", -5e-324),
        ] {
            let document = parse(Source::of("f", text)).unwrap();
            let table = root(Source::of("f", text), &document);
            assert_eq!(table.required("x", Number::any("")).unwrap(), expected, "{text}");
        }
    }
}
