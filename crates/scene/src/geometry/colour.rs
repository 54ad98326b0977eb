//! `colour`: one of a few names, or `#rrggbb` as in CSS.

use crate::error::SceneError;
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::{Kind, Value};

/// Names and colours, distinguishable on light and dark backgrounds.
const WORDS: [(&str, &str); 12] = [
    ("black", "#1f242b"),
    ("white", "#f2f4f7"),
    ("grey", "#8a939e"),
    ("silver", "#c3cad3"),
    ("red", "#d0342c"),
    ("orange", "#e2762b"),
    ("yellow", "#e6b800"),
    ("green", "#2e9e5b"),
    ("blue", "#2b6cb0"),
    ("purple", "#8457b3"),
    ("brown", "#8a5a33"),
    ("pink", "#d9709f"),
];

/// The names in order.
pub(crate) fn words() -> [&'static str; WORDS.len()] {
    WORDS.map(|(word, _)| word)
}

/// A colour as `#rrggbb` in lower case.
#[derive(Clone, Copy)]
pub(super) struct Colour;

impl Kind for Colour {
    type Output = String;

    fn expected(&self) -> String {
        format!("\"#rrggbb\", \"#rgb\", or one of {}", words().join(", "))
    }

    fn read(&self, value: &Value<'_>) -> Result<String, SceneError> {
        let text = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        if let Some((_, colour)) = WORDS.iter().find(|(word, _)| *word == text) {
            return Ok((*colour).into());
        }
        hexadecimal(text).ok_or_else(|| {
            let problem = format!("is \"{}\"", shortened(text));
            let meant = nearest(text, words());
            let meant = meant.map_or(String::new(), |word| format!("; did you mean \"{word}\"?"));
            value.refuse(&problem, &format!("{}{meant}", self.expected()))
        })
    }
}

/// `#rrggbb` from that or from `#rgb`.
fn hexadecimal(text: &str) -> Option<String> {
    let digits = text.strip_prefix('#')?;
    if !digits.chars().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let digits = digits.to_ascii_lowercase();
    match digits.len() {
        6 => Some(format!("#{digits}")),
        3 => Some(digits.chars().fold("#".into(), |all: String, digit| {
            // Each digit is doubled.
            format!("{all}{digit}{digit}")
        })),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_six_digits_in_small_letters() {
        assert_eq!(hexadecimal("#0aF").as_deref(), Some("#00aaff"));
        assert_eq!(hexadecimal("#12AB9f").as_deref(), Some("#12ab9f"));
        for wrong in ["", "#", "0af", "#12", "#12345", "#12345g", "#1234567", "#äöü"] {
            assert_eq!(hexadecimal(wrong), None, "{wrong}");
        }
        for (word, colour) in WORDS {
            assert_eq!(hexadecimal(colour).as_deref(), Some(colour), "{word}");
        }
    }
}
