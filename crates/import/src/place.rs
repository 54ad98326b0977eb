//! Source texts and positions in them.
//!
//! `file, byte => line, column, excerpt`.

/// A span of one of the texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Index of the text in reading order.
    pub(crate) file: usize,
    /// Its first byte.
    pub(crate) start: usize,
    /// End, exclusive.
    pub(crate) end: usize,
    /// Its line, from 1.
    pub(crate) line: usize,
}

/// The origin of an item: description and position.
pub(crate) type Source = (String, Place);

/// The texts by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Texts {
    files: Vec<(String, String)>,
}

impl Texts {
    /// Stores a text; returns its index for positions.
    pub(crate) fn add(&mut self, name: &str, text: &str) -> usize {
        self.files.push((name.to_owned(), text.to_owned()));
        self.files.len() - 1
    }

    /// Name and text of a file.
    pub(crate) fn file(&self, file: usize) -> (&str, &str) {
        self.files.get(file).map_or(("", ""), |(name, text)| (name, text))
    }

    /// How often a file has been read, to detect cycles.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.files.iter().any(|(known, _)| known == name)
    }

    /// A position for comments: its line, with the file if there are several.
    pub(crate) fn shown(&self, place: Place) -> String {
        match self.files.len() {
            0 | 1 => format!("line {}", place.line),
            _ => format!("{}:{}", self.short(place), place.line),
        }
    }

    /// A file's name without its folders.
    fn short(&self, place: Place) -> &str {
        let name = self.file(place.file).0;
        name.rsplit(['/', '\\']).next().unwrap_or(name)
    }
}
