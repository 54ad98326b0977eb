//! The kinds of other plain values: directions, texts, choices.

use dbd_kernel::Vec3;

use crate::direction::unit;
use crate::error::SceneError;
use crate::nearest::nearest;
use crate::quantity::{Dimension, Quantity};
use crate::shortened::shortened;
use crate::text::name::check_name;
use crate::text::number::Measure;
use crate::text::value::{Kind, Value};

/// A unit vector along an array of three numbers.
#[derive(Clone, Copy)]
pub(crate) struct Direction;

impl Direction {
    /// Its three numbers as written.
    pub(crate) fn numbers(value: &Value<'_>) -> Result<[f64; 3], SceneError> {
        let mut vector = [0.0; 3];
        let mut common = None;
        for (component, entry) in vector.iter_mut().zip(value.entries(3, || Self.expected())?) {
            let Quantity { value: number, dimension } = Measure.read(&entry)?;
            *component = number;
            // A 0 fits any dimension.
            if number == 0.0 && dimension.is_none() {
                continue;
            }
            let common = *common.get_or_insert(dimension);
            if common != dimension {
                let help = "the components of a direction must have one dimension, or be plain \
                    numbers";
                let problem =
                    format!("is {}, but others are {}", called(dimension), called(common));
                return Err(entry.refuse_with(&problem, help));
            }
        }
        Ok(vector)
    }
}

impl Kind for Direction {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        "an array of 3 finite numbers, not all 0, in world axes".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        unit(Vec3::from_f64(Self::numbers(value)?))
            .ok_or_else(|| value.refuse("has no direction", &self.expected()))
    }
}

fn called(dimension: Dimension) -> String {
    if dimension.is_none() { "a plain number".into() } else { format!("a value in {dimension}") }
}

/// A string; a name must not be empty.
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
        if matches!(self, Self::Name) {
            check_name(text).map_err(|fault| value.refuse_with(&fault.problem, fault.help))?;
        }
        Ok(text.to_owned())
    }
}

/// `true` or `false`.
#[derive(Clone, Copy)]
pub(crate) struct Switch;

impl Kind for Switch {
    type Output = bool;

    fn expected(&self) -> String {
        "true or false, without quotes".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<bool, SceneError> {
        value.get().as_bool().ok_or_else(|| value.wrong_type(&self.expected()))
    }
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
