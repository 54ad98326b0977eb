//! The kinds of plain values: numbers, vectors, directions, texts, choices.

use dbd_kernel::Vec3;
use toml::de::DeValue;

use crate::direction::unit;
use crate::error::SceneError;
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::value::{Kind, Value};
use crate::time::seconds;

/// A finite number; integers are numbers, too.
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
        format!("a finite number{}{}", self.range(), self.in_unit())
    }

    fn read(&self, value: &Value<'_>) -> Result<f64, SceneError> {
        let number = number(value).ok_or_else(|| value.wrong_type(&self.expected()))?;
        if !self.holds(number) {
            return Err(
                value.refuse(&format!("is {}", shortened(value.written())), &self.expected())
            );
        }
        Ok(number)
    }
}

/// A time: a number of seconds, or a text with a unit such as `"20us"`.
#[derive(Clone, Copy)]
pub(crate) struct Seconds(Number);

impl Seconds {
    /// Any finite time.
    pub(crate) const fn any() -> Self {
        Self(Number::any("s"))
    }

    /// A time > 0.
    pub(crate) const fn positive() -> Self {
        Self(Number::positive("s"))
    }
}

impl Kind for Seconds {
    type Output = f64;

    fn expected(&self) -> String {
        format!(
            "{}, or a time in quotes with its unit (s, ms, us, ns): \"20us\"",
            self.0.expected()
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<f64, SceneError> {
        let Some(text) = value.get().as_str() else { return self.0.read(value) };
        let time = seconds(text).ok().filter(|time| self.0.holds(*time));
        time.ok_or_else(|| {
            value.refuse(&format!("is {}", shortened(value.written())), &self.expected())
        })
    }
}

/// The number nearest to what is written; one too large to write down is infinite.
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
        for (number, entry) in numbers.iter_mut().zip(value.entries(N, &self.expected())?) {
            *number = self.0.read(&entry)?;
        }
        Ok(numbers)
    }
}

/// A unit vector along an array of three numbers.
#[derive(Clone, Copy)]
pub(crate) struct Direction;

impl Kind for Direction {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        "an array of 3 finite numbers, not all 0, in world axes".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        let vector = Numbers::<3>(Number::any("")).read(value)?;
        unit(Vec3::from_f64(vector))
            .ok_or_else(|| value.refuse("has no direction", &self.expected()))
    }
}

/// Bytes of a name in UTF-8: a folder may have it, with room for what systems add; 255 is the end.
pub(super) const LONGEST_NAME: usize = 200;

/// A string; with something in it where it is a name.
#[derive(Clone, Copy)]
pub(crate) enum Text {
    /// Any string.
    Any,
    /// A name.
    Name,
}

impl Kind for Text {
    type Output = String;

    fn expected(&self) -> String {
        match self {
            Self::Any => "a string in quotes".into(),
            Self::Name => "a name in quotes, not empty".into(),
        }
    }

    fn read(&self, value: &Value<'_>) -> Result<String, SceneError> {
        let text = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        if matches!(self, Self::Name) && text.trim().is_empty() {
            return Err(value.refuse("is empty", &self.expected()));
        }
        if matches!(self, Self::Name) && text.chars().any(is_invisible) {
            let problem = "holds a line break or another invisible character";
            let help = "a name is one line of visible text: it heads a column, and stands in \
                        exported source";
            return Err(value.refuse_with(problem, help));
        }
        if matches!(self, Self::Name) && text.len() > LONGEST_NAME {
            let problem = format!("is a name of {} bytes", text.len());
            let help = format!(
                "a name has at most {LONGEST_NAME} bytes: as many letters of English, half as many \
                 of most other alphabets"
            );
            return Err(value.refuse_with(&problem, help));
        }
        Ok(text.to_owned())
    }
}

/// Whether a character breaks a line or steers what shows it: control characters, Unicode's line
/// and paragraph separators and those that turn the direction of writing, which compilers refuse.
pub(super) fn is_invisible(c: char) -> bool {
    let steers = matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}');
    c.is_control() || steers
}

/// One of a few words, by its index.
#[derive(Clone, Copy)]
pub(crate) struct Choice<'c>(pub(crate) &'c [&'static str]);

impl Kind for Choice<'_> {
    type Output = usize;

    fn expected(&self) -> String {
        let words: Vec<_> = self.0.iter().map(|word| format!("\"{word}\"")).collect();
        match words.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => words.concat(),
        }
    }

    fn read(&self, value: &Value<'_>) -> Result<usize, SceneError> {
        let word = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        self.0.iter().position(|choice| *choice == word).ok_or_else(|| {
            let problem = format!("is \"{}\"", shortened(word));
            match nearest(word, self.0.iter().copied()) {
                Some(meant) => {
                    let expected = format!("{}; did you mean \"{meant}\"?", self.expected());
                    value.refuse(&problem, &expected)
                }
                None => value.refuse(&problem, &self.expected()),
            }
        })
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
