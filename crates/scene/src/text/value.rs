//! One value of a table, with its position and a name for messages.

use std::fmt;
use std::ops::Range;
use std::rc::Rc;

use toml::Spanned;
use toml::de::DeValue;

use crate::error::{SceneError, Source};
use crate::quantity::Fault;
use crate::shortened::shortened;

/// A kind of value.
pub(crate) trait Kind {
    /// The type of the result.
    type Output;
    /// The expectation, following `… must be`: `a number > 0 in kg`.
    fn expected(&self) -> String;
    /// Reads it.
    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError>;
}

/// A value with its name in messages.
pub(crate) struct Value<'t> {
    pub(crate) source: Source<'t>,
    pub(crate) entry: &'t Spanned<DeValue<'t>>,
    /// The key.
    pub(crate) key: Key<'t>,
    /// Its owner: ``body `crank` ``.
    pub(crate) owner: Rc<str>,
}

/// A key in messages, with an index for an entry of an array: `` `points`[1] ``.
#[derive(Clone)]
pub(crate) enum Key<'t> {
    /// A key of a table.
    Named(&'t str),
    /// An entry of its array.
    Entry(Rc<Self>, usize),
}

impl fmt::Display for Key<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named(name) => write!(f, "`{}`", shortened(name)),
            Self::Entry(array, i) => write!(f, "{array}[{i}]"),
        }
    }
}

impl<'t> Value<'t> {
    /// The value itself.
    pub(crate) fn get(&self) -> &'t DeValue<'t> {
        self.entry.get_ref()
    }

    /// Its position.
    pub(crate) fn span(&self) -> Range<usize> {
        self.entry.span()
    }

    /// The value as written.
    pub(crate) fn written(&self) -> &'t str {
        self.source.text.get(self.span()).unwrap_or_default()
    }

    /// Refuses it: `problem` follows its name, e.g. `is negative`.
    pub(crate) fn refuse(&self, problem: &str, expected: &str) -> SceneError {
        let Self { key, owner, .. } = self;
        self.refuse_with(problem, format!("{key} of {owner} must be {expected}"))
    }

    /// Refuses it with a custom help text.
    pub(crate) fn refuse_with(&self, problem: &str, help: impl Into<String>) -> SceneError {
        let Self { key, owner, .. } = self;
        self.source.refuse(self.span(), format!("{key} of {owner} {problem}"), help)
    }

    /// Refuses a part of its text; `text` is the string value.
    pub(crate) fn refuse_within(&self, text: &str, fault: &Fault, expected: &str) -> SceneError {
        let Self { key, owner, .. } = self;
        let span = self.span();
        // With escapes such as \u0041 the whole text is shown.
        let start = Some(text).filter(|text| !text.is_empty());
        let start = start.and_then(|text| Some(span.start + self.written().find(text)?));
        let place = start.map(|start| start + fault.place.start..start + fault.place.end);
        let message = format!("{key} of {owner}: {fault}");
        let help = format!("{}; {key} of {owner} must be {expected}", fault.help);
        self.source.refuse(place.unwrap_or(span), message, help)
    }

    /// Refuses its type.
    pub(crate) fn wrong_type(&self, expected: &str) -> SceneError {
        let kind = self.get().type_str();
        let article = if matches!(kind, "integer" | "array") { "an" } else { "a" };
        self.refuse(&format!("is {article} {kind}"), expected)
    }

    /// The entries of an array of exactly `length`.
    pub(crate) fn entries(
        &self,
        length: usize,
        expected: impl Fn() -> String,
    ) -> Result<Vec<Value<'t>>, SceneError> {
        let entries = self.array(&expected)?;
        if entries.len() != length {
            let plural = if entries.len() == 1 { "entry" } else { "entries" };
            return Err(self.refuse(&format!("has {} {plural}", entries.len()), &expected()));
        }
        Ok(entries)
    }

    /// The entries of an array.
    pub(crate) fn array(
        &self,
        expected: impl Fn() -> String,
    ) -> Result<Vec<Value<'t>>, SceneError> {
        let array = self.get().as_array().ok_or_else(|| self.wrong_type(&expected()))?;
        let key = Rc::new(self.key.clone());
        let entry = |(i, entry)| Value {
            source: self.source,
            entry,
            key: Key::Entry(key.clone(), i),
            owner: self.owner.clone(),
        };
        Ok(array.iter().enumerate().map(entry).collect())
    }
}
