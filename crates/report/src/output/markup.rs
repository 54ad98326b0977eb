//! Markup: common parts of pages and drawings.
//!
//! `text => escaped text`.

/// The style sheet of every page.
pub const PAGE_STYLE: &str = include_str!("page.css");

/// The script of pages with drawings: shows a mark's `<title>` immediately, also on touch.
pub const HOVER_SCRIPT: &str = include_str!("hover.js");

/// Escapes text for HTML and SVG.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_become_markup() {
        assert_eq!(escape("<b a=\"1\">&"), "&lt;b a=&quot;1&quot;&gt;&amp;");
    }
}
