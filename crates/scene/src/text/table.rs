//! A table that refuses unknown keys.
//!
//! Unknown keys are refused before any key is read: if a required key is misspelled, the message reports the
//! misspelling rather than the missing key.

use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::error::{SceneError, Source};
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::name::{check_name, is_name};
use crate::text::value::{Key, Kind, Value};

/// A table with its name in messages.
pub(crate) struct Table<'t> {
    source: Source<'t>,
    entries: &'t DeTable<'t>,
    span: Range<usize>,
    /// ``body `crank` ``, or `body 1` where it has no name.
    label: Rc<str>,
    /// The defaults, used for keys that it does not give; earlier ones take precedence.
    defaults: Vec<&'t DeTable<'t>>,
    /// The allowed keys, once known; defaults with other keys are ignored.
    allowed: RefCell<Option<Vec<&'static str>>>,
}

/// Keys with their alternatives: where a table gives the key, defaults of the alternatives are ignored.
const ALTERNATIVES: &[(&str, &[&str])] = &[
    ("damping", &["damping_ratio", "frequency"]),
    ("damping_ratio", &["damping"]),
    ("frequency", &["damping"]),
    ("mass", &["density"]),
    ("density", &["mass"]),
    ("wall", &["inner_diameter"]),
    ("inner_diameter", &["wall"]),
    ("radius", &["diameter"]),
    ("diameter", &["radius"]),
    ("link", &["position", "orientation", "frame", "shape"]),
    ("position", &["link"]),
    ("inertia", &["shape"]),
    ("shape", &["inertia"]),
];

/// The table that is the whole scene.
pub(crate) fn root<'t>(source: Source<'t>, document: &'t DeTable<'t>) -> Table<'t> {
    Table::new(source, document, 0..0, "the scene")
}

impl<'t> Value<'t> {
    /// A nested table.
    pub(crate) fn table(&self, expected: &str) -> Result<Table<'t>, SceneError> {
        match self.get() {
            DeValue::Table(entries) => {
                let label = format!("{} of {}", self.key, self.owner);
                Ok(Table::new(self.source, entries, self.span(), &label))
            }
            _ => Err(self.wrong_type(expected)),
        }
    }

    /// A nested table with a custom name in messages.
    pub(crate) fn labelled(&self, expected: &str, label: &str) -> Result<Table<'t>, SceneError> {
        match self.get() {
            DeValue::Table(entries) => Ok(Table::new(self.source, entries, self.span(), label)),
            _ => Err(self.wrong_type(expected)),
        }
    }
}

impl<'t> Table<'t> {
    pub(crate) fn new(
        source: Source<'t>,
        entries: &'t DeTable<'t>,
        span: Range<usize>,
        label: &str,
    ) -> Self {
        let label = label.into();
        let (defaults, allowed) = (Vec::new(), RefCell::new(None));
        Self { source, entries, span, label, defaults, allowed }
    }

    /// Gives it another name in messages.
    pub(crate) fn called(self, label: &str) -> Self {
        Self { label: label.into(), ..self }
    }

    /// Adds the defaults of its kind from `[defaults.kind]` of the scene.
    pub(crate) fn with_defaults(
        mut self,
        root: &Table<'t>,
        kind: &str,
    ) -> Result<Self, SceneError> {
        let Some(all) = root.value("defaults") else { return Ok(self) };
        let all = all.table("tables of keys by kind: [defaults.joint]")?;
        let of = |kind: &str| match all.value(kind) {
            Some(value) => value.table("a table of keys").map(|table| Some(table.entries)),
            None => Ok(None),
        };
        self.defaults.extend(of(kind)?);
        if kind == "joint" {
            let own_type = self.value("type").and_then(|value| value.get().as_str());
            if let Some(own_type) = own_type {
                self.defaults = of(own_type)?.into_iter().chain(self.defaults).collect();
            }
        }
        Ok(self)
    }

    /// A key with its value: its own, or the first default that applies.
    fn entry(&self, key: &str) -> Option<(&'t Spanned<DeString<'t>>, &'t Spanned<DeValue<'t>>)> {
        let own = self.entries.get_key_value(key);
        if own.is_some() || self.defaults.is_empty() {
            return own;
        }
        if self.allowed.borrow().as_ref().is_some_and(|allowed| !allowed.contains(&key)) {
            return None;
        }
        let replaces = |other: &&DeTable<'_>| {
            let mut others = ALTERNATIVES.iter().filter(|(_, replaced)| replaced.contains(&key));
            others.any(|(other_key, _)| other.contains_key(*other_key))
        };
        let mut before = vec![self.entries];
        for defaults in &self.defaults {
            if before.iter().any(replaces) {
                return None;
            }
            if let Some(entry) = defaults.get_key_value(key) {
                return Some(entry);
            }
            before.push(defaults);
        }
        None
    }

    /// Its entries.
    pub(crate) fn entries(&self) -> &'t DeTable<'t> {
        self.entries
    }

    /// Its name in messages.
    pub(crate) fn label(&self) -> &str {
        &self.label
    }

    /// Refuses the table as a whole.
    pub(crate) fn refuse(&self, problem: &str, help: impl Into<String>) -> SceneError {
        self.source.refuse(self.span.clone(), format!("{} {problem}", self.label), help)
    }

    /// Refuses a key.
    pub(crate) fn refuse_key(
        &self,
        key: &str,
        problem: &str,
        help: impl Into<String>,
    ) -> SceneError {
        let span = self.entry(key).map_or(self.span.clone(), |(k, _)| k.span());
        self.source.refuse(span, format!("`{key}` of {} {problem}", self.label), help)
    }

    /// Refuses the value of a key.
    pub(crate) fn refuse_value(
        &self,
        key: &str,
        problem: &str,
        help: impl Into<String>,
    ) -> SceneError {
        match self.value(key) {
            Some(value) => value.refuse_with(problem, help),
            None => self.refuse(problem, help),
        }
    }

    /// Refuses keys other than these.
    pub(crate) fn only(&self, keys: &[&[&'static str]]) -> Result<(), SceneError> {
        let mut allowed: Vec<&str> = Vec::new();
        for key in keys.iter().copied().flatten().copied() {
            if !allowed.contains(&key) {
                allowed.push(key);
            }
        }
        let unknown = self
            .entries
            .keys()
            .filter(|key| !allowed.contains(&key.get_ref().as_ref()))
            // Keys come in alphabetical order; the first in the file is the one to name.
            .min_by_key(|key| key.span().start);
        let Some(unknown) = unknown else {
            *self.allowed.borrow_mut() = Some(allowed);
            return Ok(());
        };
        let mut help = String::new();
        if self.has_parameter(unknown.get_ref()) {
            help = format!("did you mean `parameters.{}`? ", unknown.get_ref());
        } else if let Some(key) = nearest(unknown.get_ref(), allowed.iter().copied()) {
            help = format!("did you mean `{key}`? ");
        }
        let quoted: Vec<_> = allowed.iter().map(|key| format!("`{key}`")).collect();
        help += &format!("{} may have {}", self.label, quoted.join(", "));
        let message = format!("{} has no key `{}`", self.label, shortened(unknown.get_ref()));
        Err(self.source.refuse(unknown.span(), message, help))
    }

    /// Whether the scene's parameters have a key; `--set` then needs the full path.
    fn has_parameter(&self, key: &str) -> bool {
        let parameters = self.entries.iter().filter(|(name, _)| name.get_ref() == "parameters");
        parameters
            .filter_map(|(_, entry)| entry.get_ref().as_table())
            .any(|table| table.contains_key(key))
    }

    /// Whether a key is present.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.entry(key).is_some()
    }

    /// Whether the table itself gives a key, not its defaults.
    pub(crate) fn gives(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// The value of a key, if present.
    pub(crate) fn value(&self, key: &str) -> Option<Value<'t>> {
        self.entry(key).map(|(key, entry)| Value {
            source: self.source,
            entry,
            key: Key::Named(key.get_ref()),
            owner: self.label.clone(),
        })
    }

    /// All keys with their positions and values, in the order of the file.
    pub(crate) fn values(&self) -> Vec<(Range<usize>, &'t str, Value<'t>)> {
        let of = |entries: &'t DeTable<'t>| {
            let keys = entries.keys().map(|key| (key.span(), key.get_ref().as_ref()));
            let mut keys: Vec<(Range<usize>, &str)> = keys.collect();
            keys.sort_by_key(|(place, _)| place.start);
            keys
        };
        let mut keys = of(self.entries);
        // Its own keys, then the defaults.
        for defaults in &self.defaults {
            for (place, key) in of(defaults) {
                if keys.iter().all(|(_, known)| *known != key) {
                    keys.push((place, key));
                }
            }
        }
        let value = |(place, key)| Some((place, key, self.value(key)?));
        keys.into_iter().filter_map(value).collect()
    }

    /// A required key.
    pub(crate) fn required<K: Kind>(&self, key: &str, kind: K) -> Result<K::Output, SceneError> {
        match self.value(key) {
            Some(value) => kind.read(&value),
            None => Err(self.missing(key, &kind.expected())),
        }
    }

    /// The error of a missing key.
    pub(crate) fn missing(&self, key: &str, expected: &str) -> SceneError {
        self.refuse(&format!("has no `{key}`"), format!("add `{key}`: {expected}"))
    }

    /// An optional key.
    pub(crate) fn optional<K: Kind>(
        &self,
        key: &str,
        kind: K,
    ) -> Result<Option<K::Output>, SceneError> {
        self.value(key).map(|value| kind.read(&value)).transpose()
    }

    /// The tables of `[[key]]`, labelled by their names or `key 1` and so on; empty where the key is absent.
    pub(crate) fn list(&self, key: &str) -> Result<Vec<Table<'t>>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(Vec::new()) };
        let expected = || format!("an array of tables, each written as [[{key}]]");
        if matches!(value.get(), DeValue::Table(_)) && value.written().starts_with('[') {
            let problem = format!("is written as [{key}], in single brackets");
            let help = format!("write each {key} as [[{key}]], in double brackets");
            return Err(value.refuse_with(&problem, help));
        }
        let mut tables = Vec::new();
        for (i, entry) in value.array(expected)?.iter().enumerate() {
            let DeValue::Table(entries) = entry.get() else {
                return Err(entry.wrong_type(&format!("a table, written as [[{key}]]")));
            };
            let label = match entries.get("name").and_then(|name| name.get_ref().as_str()) {
                Some(name) if is_name(name) => format!("{key} `{}`", shortened(name)),
                _ => format!("{key} {}", i + 1),
            };
            let table = Table::new(self.source, entries, entry.span(), &label);
            tables.push(table.with_defaults(self, key)?);
        }
        Ok(tables)
    }

    /// All values with their keys as names, in the order of the file.
    pub(crate) fn named(&self) -> Result<Vec<(String, Value<'t>)>, SceneError> {
        let mut entries: Vec<_> = self.entries.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let mut named = Vec::new();
        for (key, entry) in entries {
            let name = key.get_ref().as_ref();
            if let Err(fault) = check_name(name) {
                let problem = format!("{} has a name that {}", self.label, fault.problem);
                return Err(self.source.refuse(key.span(), problem, fault.help));
            }
            let (key, owner) = (Key::Named(name), self.label.clone());
            named.push((name.to_owned(), Value { source: self.source, entry, key, owner }));
        }
        Ok(named)
    }

    /// The lines, from 1, on which the tables of [`Self::list`] begin.
    pub(crate) fn lines(&self, key: &str) -> Vec<usize> {
        // One pass over the text: a scene may have thousands of tables.
        let (mut line, mut from) = (1, 0);
        let mut lines = Vec::new();
        let tables = self.entries.get(key).and_then(|value| value.get_ref().as_array());
        for table in tables.into_iter().flatten() {
            let start = table.span().start;
            line += self.breaks(from..start);
            from = start.max(from);
            lines.push(line);
        }
        lines
    }

    /// The line breaks between two bytes of the text.
    pub(crate) fn breaks(&self, between: Range<usize>) -> usize {
        self.source.text.get(between).unwrap_or_default().matches('\n').count()
    }

    /// The byte at which the table begins.
    pub(crate) fn start(&self) -> usize {
        self.span.start
    }

    /// The line of a byte, from 1.
    pub(crate) fn line_of(&self, byte: usize) -> usize {
        self.source.position(byte).0
    }
}
