//! The comments of a scene's text, by the item that they precede or follow.
//!
//! `(text, byte) => comment lines`. Comments above the first key that are followed by an empty line are the head of the
//! file.

use std::cell::RefCell;
use std::collections::BTreeSet;

/// The comments of a text.
pub(super) struct Comments<'t> {
    text: &'t str,
    /// Starts of lines whose comments are already written.
    taken: RefCell<BTreeSet<usize>>,
}

impl<'t> Comments<'t> {
    /// Of a file's text.
    pub(super) fn of(text: &'t str) -> Self {
        Self { text, taken: RefCell::default() }
    }

    /// The comments at the file's beginning, with the empty lines among them.
    pub(super) fn head(&self) -> String {
        let mut head = String::new();
        let mut pending = String::new();
        let mut start = 0;
        for line in self.text.split_inclusive('\n') {
            let trimmed = line.trim();
            if !(trimmed.is_empty() || trimmed.starts_with('#')) {
                break;
            }
            self.taken.borrow_mut().insert(start);
            start += line.len();
            pending.push_str(trimmed);
            pending.push('\n');
            if trimmed.is_empty() {
                head.push_str(&pending);
                pending.clear();
            }
        }
        head + &pending
    }

    /// The comment lines that end on the line before the one of a byte.
    pub(super) fn before(&self, byte: usize) -> String {
        let Some(mut start) = self.line_start(byte) else { return String::new() };
        // An item that follows another one on its line has no preceding comment.
        let lead = self.text.get(start..byte).unwrap_or_default();
        if !lead.trim_matches([' ', '\t', '{', '[']).is_empty() {
            return String::new();
        }
        let mut lines = Vec::new();
        while start > 0 {
            let Some(above) = self.line_start(start - 1) else { break };
            let line = self.text[above..start].trim();
            if !line.starts_with('#') || !self.taken.borrow_mut().insert(above) {
                break;
            }
            lines.push(line);
            start = above;
        }
        lines.iter().rev().map(|line| format!("{line}\n")).collect()
    }

    /// The comment after the item that ends at a byte, on the same line, if not yet taken.
    pub(super) fn behind(&self, byte: usize) -> String {
        let Some(rest) = self.text.get(byte..) else { return String::new() };
        let line = rest.split('\n').next().unwrap_or_default();
        let tail = line.trim_start_matches([' ', '\t', ',', '}', ']']);
        let Some(comment) = tail.strip_prefix('#') else { return String::new() };
        let place = byte + line.len() - comment.len();
        match self.taken.borrow_mut().insert(place) {
            true => format!("  #{}", comment.trim_end()),
            false => String::new(),
        }
    }

    /// The end of the header that begins at a byte; the byte itself without a header.
    pub(super) fn end_of_header(&self, byte: usize) -> usize {
        let Some(rest) = self.text.get(byte..).filter(|rest| rest.starts_with("[[")) else {
            return byte;
        };
        rest.find("]]").map_or(byte, |end| byte + end + 2)
    }

    /// The start of a byte's line; `None` beyond the file's text, where changes are.
    fn line_start(&self, byte: usize) -> Option<usize> {
        let before = self.text.get(..byte)?;
        Some(before.rfind('\n').map_or(0, |newline| newline + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_goes_with_what_it_stands_at_and_only_once() {
        let text = "# Head.\n\n# Of a.\na = 1 # one, two\n# Of b,\n# and more.\nb = 2, c = 3\n";
        let comments = Comments::of(text);
        assert_eq!(comments.head(), "# Head.\n\n# Of a.\n");
        let [a, b, c] = ["a = 1", "b = 2", "c = 3"].map(|key| text.find(key).unwrap());
        assert_eq!(
            (comments.before(a), comments.behind(a + 5)),
            (String::new(), "  # one, two".into())
        );
        assert_eq!(comments.behind(a + 5), "");
        assert_eq!(comments.before(b), "# Of b,\n# and more.\n");
        assert_eq!((comments.before(c), comments.before(1000)), (String::new(), String::new()));
    }
}
