//! Texts that were read, and places in them.
//!
//! `file, byte => line, column, what is shown`.

/// A stretch of one of the texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Which text, in the order in which they were read.
    pub(crate) file: usize,
    /// Its first byte.
    pub(crate) start: usize,
    /// The byte behind its last.
    pub(crate) end: usize,
    /// Its line, from 1.
    pub(crate) line: usize,
}

/// Where something comes from: words and place.
pub(crate) type Source = (String, Place);

/// The texts by their names.
#[derive(Clone, Debug, Default)]
pub(crate) struct Texts {
    files: Vec<(String, String)>,
}

impl Texts {
    /// Keeps a text; the number that places call it by.
    pub(crate) fn add(&mut self, name: &str, text: &str) -> usize {
        self.files.push((name.to_owned(), text.to_owned()));
        self.files.len() - 1
    }

    /// Name and text of a file.
    pub(crate) fn file(&self, file: usize) -> (&str, &str) {
        self.files.get(file).map_or(("", ""), |(name, text)| (name, text))
    }

    /// How often a file was read so far, to tell a circle.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.files.iter().any(|(known, _)| known == name)
    }

    /// A place as comments show it: its line, with the file where there is more than one.
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
