//! The left side of a change: the path to a value of a scene.
//!
//! `body.cart.mass, joint."base 1".at[2], joint.leg*.stiffness => segments with their places`. A segment with a dot, an
//! equals sign or a bracket is quoted; within quotes `*` and `?` are literal, elsewhere they match any letters and any
//! single letter.

use std::ops::Range;

use crate::error::{SceneError, Source};
use crate::parameters::pattern::is_of;

/// A step of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    /// Into a table, by key or by name.
    Name {
        /// The text without quotes.
        text: String,
        /// Whether `*` and `?` are wildcards.
        is_pattern: bool,
    },
    /// Into an array, from 0.
    Entry(usize),
}

impl Step {
    /// Whether a name matches.
    pub(crate) fn fits(&self, name: &str) -> bool {
        match self {
            Self::Name { text, is_pattern: false } => text == name,
            Self::Name { text, is_pattern: true } => is_of(text, name),
            Self::Entry(_) => false,
        }
    }
}

/// A step with its position.
pub(crate) type Placed = (Step, Range<usize>);

const HELP: &str = "expected PATH=VALUE, e.g. body.cart.mass=1.2, joint.pivot.at[1]=0.5, \
                    joint.*.stiffness=1e6 or step=20us; put a name that contains a dot in quotes";

/// Reads the path of a change; also returns the start of its value.
pub(crate) fn read(source: Source<'_>) -> Result<(Vec<Placed>, usize), SceneError> {
    let text = source.text;
    let refuse = |place: usize, what: &str| Err(source.refuse(place..text.len(), what, HELP));
    let (mut steps, mut place) = (Vec::new(), 0);
    loop {
        let rest = &text[place..];
        let (name, length, is_quoted) = match rest.strip_prefix('"') {
            Some(quoted) => match quoted.find('"') {
                Some(end) => (&quoted[..end], end + 2, true),
                None => return refuse(place, "unclosed quote"),
            },
            None => {
                let end = rest.find(['.', '[', '=', '"']).unwrap_or(rest.len());
                (rest[..end].trim(), end, false)
            }
        };
        if name.is_empty() {
            return refuse(place, "empty path segment");
        }
        let is_pattern = !is_quoted && name.contains(['*', '?']);
        steps.push((Step::Name { text: name.into(), is_pattern }, place..place + length));
        place += length;
        while text[place..].starts_with('[') {
            let inner = &text[place + 1..];
            let end = inner.find(']').unwrap_or(inner.len());
            let Ok(entry) = inner[..end].trim().parse() else {
                return refuse(place, "an array index must be a whole number from 0 in brackets");
            };
            let next = (place + end + 2).min(text.len());
            steps.push((Step::Entry(entry), place..next));
            place = next;
        }
        let rest = &text[place..];
        let blank = rest.len() - rest.trim_start().len();
        match rest.trim_start().chars().next() {
            Some('.') if blank == 0 => place += 1,
            Some('=') => return Ok((steps, place + blank + 1)),
            None => return refuse(place, "missing `=VALUE` after the path"),
            Some(_) => return refuse(place, "expected `.` or `=`"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(text: &str) -> Vec<String> {
        let (steps, value) = read(Source::of("--set", text)).unwrap();
        let mut shown: Vec<_> = steps
            .into_iter()
            .map(|(step, place)| match step {
                Step::Name { text: name, is_pattern } => {
                    format!("{name}{} {}", if is_pattern { "~" } else { "" }, &text[place])
                }
                Step::Entry(entry) => entry.to_string(),
            })
            .collect();
        shown.push(text[value..].to_owned());
        shown
    }

    #[test]
    fn a_path_is_read_step_by_step() {
        assert_eq!(steps("step=20us"), ["step step", "20us"]);
        assert_eq!(steps("body.cart.mass = 1"), ["body body", "cart cart", "mass mass ", " 1"]);
        assert_eq!(
            steps("joint.\"a.b=c*\".points[1][2]=x=y"),
            ["joint joint", "a.b=c* \"a.b=c*\"", "points points", "1", "2", "x=y"]
        );
        assert_eq!(steps("joint.leg*.k=1")[1], "leg*~ leg*");
    }

    #[test]
    fn what_is_no_path_is_refused_at_its_place() {
        for (text, column, what) in [
            ("", 1, "empty"),
            ("=1", 1, "empty"),
            ("body..mass=1", 6, "empty"),
            ("body.cart.mass", 15, "missing `=VALUE`"),
            ("body.\"cart=1", 6, "unclosed"),
            ("gravity[a]=1", 8, "whole number"),
            ("gravity[1=1", 8, "whole number"),
            ("body.\"cart\"mass=1", 12, "expected `.`"),
        ] {
            let error = read(Source::of("--set", text)).unwrap_err();
            assert_eq!(error.column(), Some(column), "{text}: {error}");
            assert!(error.message().contains(what), "{text}: {error}");
        }
    }
}
