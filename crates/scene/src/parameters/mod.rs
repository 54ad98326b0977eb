//! Changes of single values of a scene by their paths, before it is checked: `body.cart.mass=1.2`; and the named values
//! in `[parameters]` (`named.rs`).
//!
//! `(text, changes) => tables with other values`. A changed value is checked like one in the file; an error points to
//! the change. In a list of tables the second step of a path is a name, or the number from 1 of an unnamed table; then
//! follow keys and array indices from 0. A missing key is added to its table, and so is a table that none of the fitting
//! elements has: then reading the scene checks whether there may be one.

mod named;
mod numbers;
mod path;
mod pattern;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{SceneError, Source};
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text;
pub use named::Parameter;
pub(crate) use named::{all, read};
pub use numbers::SceneNumber;
pub(crate) use numbers::numbers;
use path::{Placed, Step};
pub use pattern::is_of;

/// The effect of a change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Changed {
    /// The whole path of one value, without wildcards: `body.cart.mass`.
    pub path: String,
    /// The value in the file; `None` where it was absent.
    pub before: Option<String>,
    /// The new value.
    pub now: String,
}

/// A scene's text followed by the changes, so that each byte of either has a unique position.
pub(crate) struct Changes {
    /// The file's text, then a line per change, its value written in TOML.
    text: String,
    /// Length of the file's text.
    own: usize,
    changes: Vec<Change>,
    /// The changes as given.
    pub(crate) given: Vec<String>,
}

/// Precedes a change's value; shorter than any path with its equals sign and the line break before it.
const KEY: &str = "v=";

struct Change {
    steps: Vec<Placed>,
    /// Start of its line in the whole text, and start of its value.
    start: usize,
    value: usize,
    /// The value as a table.
    toml: String,
}

impl Changes {
    /// Reads changes, each `PATH=VALUE`.
    pub(crate) fn read(text: &str, changes: &[impl AsRef<str>]) -> Result<Self, SceneError> {
        let given = changes.iter().map(|change| change.as_ref().to_owned()).collect();
        let (text, own) = (text.to_owned(), text.len());
        let mut whole = Self { text, own, changes: Vec::new(), given };
        for written in changes.iter().map(AsRef::as_ref) {
            let source = Source::of(Source::CHANGE, written);
            let (steps, value) = path::read(source)?;
            let tail = written[value..].trim();
            if tail.is_empty() || tail.contains(['\n', '\r']) {
                let help = "give a number, a text or an array as in the file, on one line";
                let problem = format!("`{}` is not a valid value", shortened(tail));
                return Err(source.refuse(value..written.len(), problem, help));
            }
            let toml = if is_word(tail) { format!("\"{tail}\"") } else { tail.to_owned() };
            whole.text.push('\n');
            let start = whole.text.len();
            whole.text.push_str(&written[..value]);
            let value = whole.text.len();
            whole.text.push_str(&toml);
            whole.changes.push(Change { steps, start, value, toml: format!("{KEY}{toml}") });
        }
        Ok(whole)
    }

    /// Whether there are no changes.
    pub(crate) fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    /// The text, the file's and the changes'.
    pub(crate) fn source<'t>(&'t self, file: &'t str) -> Source<'t> {
        Source { own: self.own, ..Source::of(file, &self.text) }
    }

    /// Applies the changes to the document in order.
    pub(crate) fn apply<'t>(
        &'t self,
        file: &'t str,
        document: &mut DeTable<'t>,
    ) -> Result<Vec<Changed>, SceneError> {
        let source = self.source(file);
        let mut all = Vec::new();
        for change in &self.changes {
            let value = change.parse(source)?;
            let places = change.resolve(source, document)?;
            for place in places {
                let before = put(document, &place, value.clone(), change.place());
                all.push(Changed {
                    path: shown(&place),
                    before: before.and_then(|span| self.text.get(span).map(str::to_owned)),
                    now: self.text[value.span()].to_owned(),
                });
            }
        }
        Ok(all)
    }
}

/// Whether a value is text without quotes: `20us`, `9 kN/mm`, `2 * L`, `quaternion`.
fn is_word(value: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "_-.+ */()^·⋅×÷−°⁻".contains(c);
    let number = value.replace('_', "").parse::<f64>().is_ok();
    let radix = ["0x", "0o", "0b"].iter().any(|prefix| value.starts_with(prefix));
    let keyword = matches!(value, "true" | "false");
    value.chars().all(plain) && !(number || radix || keyword)
}

/// Keys of the scene that are tables: they are added where they are missing. Lists of tables are not.
const TABLES: [&str; 5] = ["assemble", "defaults", "parameters", "points", "start"];

/// One step of the path to a value: a key or an array index.
#[derive(Clone, Debug)]
enum To {
    Key(String),
    /// Its name in the displayed path, and its array index.
    Named(String, usize),
    Entry(usize),
}

impl Change {
    /// Its position.
    fn place(&self) -> std::ops::Range<usize> {
        self.start..self.value
    }

    fn parse<'t>(&'t self, source: Source<'t>) -> Result<Spanned<DeValue<'t>>, SceneError> {
        let parsed = text::parse_at(source, &self.toml, self.value - KEY.len())?;
        match parsed.into_iter().next() {
            Some((_, value)) => Ok(value),
            None => Err(source.refuse(self.place(), "missing value", "expected PATH=VALUE")),
        }
    }

    /// All values that match the path.
    fn resolve(
        &self,
        source: Source<'_>,
        document: &DeTable<'_>,
    ) -> Result<Vec<Vec<To>>, SceneError> {
        let mut ways = vec![(Vec::new(), Node::Table(document))];
        let mut steps = self.steps.iter().peekable();
        while let Some((step, place)) = steps.next() {
            let place = self.start + place.start..self.start + place.end;
            let last = steps.peek().is_none();
            let mut known: Vec<String> = Vec::new();
            let mut found = follow(&ways, step, last, &mut known);
            let is_table = matches!(steps.peek(), Some((Step::Name { .. }, _)))
                && (place.start > self.start || TABLES.iter().any(|table| step.fits(table)));
            if found.is_empty() && is_table {
                found = follow(&ways, step, true, &mut Vec::new());
            }
            if found.is_empty() {
                let kind = match self.steps.first() {
                    Some((Step::Name { text, .. }, first))
                        if self.start + first.start < place.start =>
                    {
                        text
                    }
                    _ => "key",
                };
                return Err(nothing(source, step, place, kind, &known));
            }
            ways = found;
        }
        Ok(ways.into_iter().map(|(way, _)| way).collect())
    }
}

/// A way from the document's root, and where it leads.
type Way<'d> = (Vec<To>, Node<'d>);

/// The ways that go on by a step; with `add` also to keys that their tables lack. Possible names are added to `known`.
fn follow<'d>(ways: &[Way<'d>], step: &Step, add: bool, known: &mut Vec<String>) -> Vec<Way<'d>> {
    let mut found = Vec::new();
    for (way, node) in ways {
        for (to, node) in node.children(step, add, known) {
            found.push(([&way[..], &[to]].concat(), node));
        }
    }
    found
}

/// The start of a step.
#[derive(Clone, Copy)]
enum Node<'d> {
    Table(&'d DeTable<'d>),
    Value(&'d DeValue<'d>),
    /// A key that does not exist yet.
    Absent,
}

impl<'d> Node<'d> {
    /// The matches of a step; possible names are added to `known`.
    fn children(self, step: &Step, add: bool, known: &mut Vec<String>) -> Vec<(To, Node<'d>)> {
        match self {
            Self::Table(table) => Self::keys(table, step, add, known),
            Self::Value(DeValue::Table(table)) => Self::keys(table, step, add, known),
            Self::Absent => Self::added(step).into_iter().collect(),
            Self::Value(DeValue::Array(array)) => {
                let entry = |i: usize| array.get(i).map(|entry| Self::Value(entry.get_ref()));
                match step {
                    Step::Entry(i) => {
                        known.push(format!("entries 0 to {}", array.len().saturating_sub(1)));
                        entry(*i).map(|node| (To::Entry(*i), node)).into_iter().collect()
                    }
                    Step::Name { text, .. } => {
                        let mut found = Vec::new();
                        for (i, value) in array.iter().enumerate() {
                            let name = value.get_ref().get("name");
                            let name = name.and_then(|name| name.get_ref().as_str());
                            let number = (i + 1).to_string();
                            let called = name.unwrap_or(&number);
                            known.push(called.to_owned());
                            if step.fits(called) || (name.is_none() && *text == number) {
                                let node = Self::Value(value.get_ref());
                                found.push((To::Named(called.to_owned(), i), node));
                            }
                        }
                        found
                    }
                }
            }
            Self::Value(_) => Vec::new(),
        }
    }

    fn keys(
        table: &'d DeTable<'d>,
        step: &Step,
        add: bool,
        known: &mut Vec<String>,
    ) -> Vec<(To, Node<'d>)> {
        let mut found = Vec::new();
        for (key, value) in table.iter() {
            let key = key.get_ref().as_ref();
            known.push(key.to_owned());
            if step.fits(key) {
                found.push((To::Key(key.to_owned()), Self::Value(value.get_ref())));
            }
        }
        if found.is_empty() && add {
            found.extend(Self::added(step));
        }
        found
    }

    /// A key to add; reading the scene checks whether the table allows it.
    fn added(step: &Step) -> Option<(To, Node<'d>)> {
        match step {
            Step::Name { text, is_pattern: false } => Some((To::Key(text.clone()), Self::Absent)),
            _ => None,
        }
    }
}

/// The error of a step without a match.
fn nothing(
    source: Source<'_>,
    step: &Step,
    place: std::ops::Range<usize>,
    kind: &str,
    known: &[String],
) -> SceneError {
    let (what, meant) = match step {
        Step::Name { text, .. } => {
            let what = format!("the scene has no {} `{}`", shortened(kind), shortened(text));
            (what, nearest(text, known.iter().map(String::as_str)))
        }
        Step::Entry(entry) => (format!("there is no entry {entry}"), None),
    };
    let mut help = meant.map_or_else(String::new, |meant| format!("did you mean `{meant}`? "));
    let some: Vec<_> = known.iter().take(12).map(|name| shortened(name)).collect();
    help += &match some.is_empty() {
        true => "it is a plain value".to_owned(),
        false => {
            format!("known: {}{}", some.join(", "), if known.len() > 12 { " …" } else { "" })
        }
    };
    source.refuse(place, what, help)
}

/// Sets a value; returns the position of the previous one.
fn put<'t>(
    document: &mut DeTable<'t>,
    way: &[To],
    value: Spanned<DeValue<'t>>,
    written: std::ops::Range<usize>,
) -> Option<std::ops::Range<usize>> {
    let (last, before) = way.split_last()?;
    let mut table = Some(document);
    let mut entry: Option<&mut DeValue<'t>> = None;
    for to in before {
        if let To::Key(key) = to {
            let within = match (&mut table, &mut entry) {
                (Some(table), _) => Some(&mut **table),
                (None, Some(DeValue::Table(table))) => Some(table),
                _ => None,
            };
            if let Some(within) = within.filter(|within| !within.contains_key(key.as_str())) {
                let added = Spanned::new(written.clone(), DeValue::Table(DeTable::new()));
                within.insert(Spanned::new(written.clone(), key.clone().into()), added);
            }
        }
        let next = child(table.take(), entry.take(), to)?;
        entry = Some(next.get_mut());
    }
    let container = match (table, entry) {
        (Some(table), _) => table,
        (None, Some(DeValue::Table(table))) => table,
        (None, Some(entry)) => {
            let old = child(None, Some(entry), last)?;
            let span = old.span();
            *old = value;
            return Some(span);
        }
        (None, None) => return None,
    };
    let To::Key(key) = last else { return None };
    match container.get_mut(key.as_str()) {
        Some(old) => {
            let span = old.span();
            *old = value;
            Some(span)
        }
        None => {
            container.insert(Spanned::new(written, key.clone().into()), value);
            None
        }
    }
}

/// The value that a step refers to.
fn child<'d, 't>(
    table: Option<&'d mut DeTable<'t>>,
    value: Option<&'d mut DeValue<'t>>,
    to: &To,
) -> Option<&'d mut Spanned<DeValue<'t>>> {
    match (table, value, to) {
        (Some(table), _, To::Key(key)) | (None, Some(DeValue::Table(table)), To::Key(key)) => {
            table.get_mut(key.as_str())
        }
        (_, Some(DeValue::Array(array)), To::Named(_, i) | To::Entry(i)) => array.get_mut(*i),
        _ => None,
    }
}

/// The path of one value.
fn shown(way: &[To]) -> String {
    let mut text = String::new();
    for to in way {
        match to {
            To::Entry(i) => text += &format!("[{i}]"),
            To::Key(name) | To::Named(name, _) => {
                if !text.is_empty() {
                    text.push('.');
                }
                let plain = !name.contains(['.', '[', '=', '*', '?', '"']) && name.trim() == name;
                text += &if plain { name.clone() } else { format!("\"{name}\"") };
            }
        }
    }
    text
}
