//! Texts as messages quote them: what a file or a command line may hold at any length.

use std::borrow::Cow;

/// Characters that a message quotes of a text: more than any name has that was meant.
const MOST: usize = 80;

/// A text, its end left out where it is long.
#[must_use]
pub fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(MOST) {
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
        let text = "ö".repeat(MOST);
        assert_eq!(shortened(&text), text);
        assert_eq!(shortened(&format!("{text}a")), format!("{text}…"));
    }
}
