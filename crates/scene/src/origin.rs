//! The text that a scene was read from, to show settings that conflict with a run.
//!
//! `(text, setting) => error with file, line and column`.

use std::ops::Range;
use std::sync::Arc;

use crate::error::{SceneError, Source};
use crate::text::Table;

/// A setting of a scene file that a run may override.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// `duration`.
    Duration,
    /// `step`.
    Step,
    /// `every`.
    Every,
}

impl Setting {
    const ALL: [Self; 3] = [Self::Duration, Self::Step, Self::Every];

    fn key(self) -> &'static str {
        match self {
            Self::Duration => "duration",
            Self::Step => "step",
            Self::Every => "every",
        }
    }
}

/// The text of a scene with the positions of its settings.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    file: String,
    text: Arc<str>,
    own: usize,
    /// In the order of [`Setting::ALL`].
    places: [Option<Range<usize>>; 3],
}

impl Origin {
    pub(crate) fn of(source: Source<'_>, root: &Table<'_>) -> Self {
        let place = |setting: Setting| root.value(setting.key()).map(|value| value.span());
        let places = Setting::ALL.map(place);
        Self { file: source.file.to_owned(), text: source.text.into(), own: source.own, places }
    }

    /// The file's name and its own text, without changes.
    pub(crate) fn file(&self) -> (&str, &str) {
        (&self.file, self.text.get(..self.own).unwrap_or_default())
    }

    pub(crate) fn refuse(&self, setting: Setting, message: &str, help: &str) -> Option<SceneError> {
        let place = self.places[setting as usize].clone()?;
        let source = Source { own: self.own, ..Source::of(&self.file, &self.text) };
        Some(source.refuse(place, message, help))
    }
}
