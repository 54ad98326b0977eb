//! `host-sim list`: the scenes that have a name, one line each: those in `scenes/` and those that are
//! built in.

use serde::Serialize;

use crate::terminal::catalogue::BUILT_IN;
use crate::terminal::console::OutputError;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Found, Look};

/// A scene of the list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// Bodies.
    pub bodies: usize,
    /// TSDAs.
    pub tsdas: usize,
    /// What it shows.
    pub shows: String,
    /// The whole path of its file, or `built in`.
    pub from: String,
}

/// Prints the scenes of a catalogue. A refused scene is reported and decides the exit code.
///
/// # Errors
/// Where the list cannot be written.
pub fn list(
    catalogue: &Catalogue,
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<Exit, OutputError> {
    let mut exit = Exit::Done;
    let mut entries = Vec::new();
    for name in catalogue.names() {
        match catalogue.load(&name) {
            Ok(Found { scene, file, .. }) => entries.push(Entry {
                name,
                bodies: scene.body_names.len(),
                tsdas: scene.model.tsda_count(),
                shows: first_sentence(&scene.description).into(),
                from: file.place,
            }),
            Err(error) => {
                console.report(&error);
                exit = Exit::Refused;
            }
        }
    }
    console.print(&if as_json { json(&entries) } else { lines(&entries, console.look) })?;
    Ok(exit)
}

fn lines(entries: &[Entry], look: Look) -> String {
    let cells = |entry: &Entry| {
        [
            entry.name.clone(),
            counted(entry.bodies, "body", "bodies"),
            counted(entry.tsdas, "TSDA", "TSDAs"),
            origin(&entry.from).to_owned(),
            entry.shows.clone(),
        ]
    };
    look.columns(None, &entries.iter().map(cells).collect::<Vec<_>>())
}

/// What a line has room for: all files lie in one folder.
fn origin(from: &str) -> &str {
    if from == BUILT_IN { BUILT_IN } else { "scenes/" }
}

/// `1 body`, `3 bodies`, right-aligned for up to three digits.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count:>3} {}", if count == 1 { one } else { many })
}

/// Up to the first full stop that ends a sentence.
fn first_sentence(text: &str) -> &str {
    let text = text.trim();
    let end = text.find(". ").or_else(|| text.find(".\n"));
    let sentence = end.map_or(text, |end| &text[..end]);
    sentence.strip_suffix('.').unwrap_or(sentence)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_sentence_of_a_description() {
        assert_eq!(first_sentence("A linkage of 2.5 m. It swings."), "A linkage of 2.5 m");
        assert_eq!(first_sentence("A linkage."), "A linkage");
        assert_eq!(first_sentence(""), "");
    }

    #[test]
    fn one_aligned_line_per_scene() {
        let entry = |name: &str, bodies, tsdas, from: &str| Entry {
            name: name.into(),
            bodies,
            tsdas,
            shows: "swings".into(),
            from: from.into(),
        };
        let text = lines(
            &[entry("four-bar", 3, 24, BUILT_IN), entry("top", 1, 0, "/a/scenes/top.toml")],
            Look::PLAIN,
        );
        assert_eq!(
            text,
            "four-bar    3 bodies   24 TSDAs  built in  swings\n\
             top         1 body      0 TSDAs  scenes/   swings\n"
        );
    }
}
