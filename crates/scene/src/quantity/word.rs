//! Words in a value's text: the syntax of names and units.

use crate::quantity::decimal::Decimal;

/// The words of a text that could be names, in order.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut place = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = text.get(place..)?;
            let first = rest.chars().next()?;
            if let Some((_, length)) = Decimal::begins(rest) {
                place += length;
            } else if begins_word(first) {
                let word = word(rest);
                place += word.len();
                return Some(word);
            } else {
                place += first.len_utf8();
            }
        }
    })
}

/// Whether a name or a unit may begin with it.
pub(super) fn begins_word(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == '°'
}

/// The name or unit at the beginning of a text.
pub(super) fn word(text: &str) -> &str {
    let end = text.find(|c: char| !(begins_word(c) || c.is_ascii_digit())).unwrap_or(text.len());
    &text[..end]
}
