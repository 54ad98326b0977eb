//! Shortened texts for messages: a file or command line may contain texts of any length.

use std::borrow::Cow;

/// Most characters of a quoted text; longer than any sensible name.
const MAX: usize = 80;

/// A text, truncated if it is long.
#[must_use]
pub fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(MAX) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_loses_its_end() {
        assert_eq!(shortened("ö"), "ö");
        let text = "ö".repeat(MAX);
        assert_eq!(shortened(&text), text);
        assert_eq!(shortened(&format!("{text}a")), format!("{text}…"));
    }
}
