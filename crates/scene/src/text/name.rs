//! Valid names.
//!
//! `text => nothing, or the problem`. A name becomes a column header and appears in exported source and in messages: it
//! must be visible as a whole, and a spreadsheet must not evaluate it.

/// Most bytes of a name in UTF-8: file systems allow 255 for a folder, including suffixes.
const LONGEST: usize = 200;

/// An invalid name.
pub(crate) struct NameFault {
    /// The problem; follows the key.
    pub(crate) problem: String,
    /// The remedy.
    pub(crate) help: &'static str,
}

/// Checks a name.
///
/// # Errors
/// [`NameFault`], where the text cannot be a name.
pub(crate) fn check_name(text: &str) -> Result<(), NameFault> {
    let wrong = |problem: &str, help| Err(NameFault { problem: problem.into(), help });
    if text.trim().is_empty() {
        return wrong("is empty", "give a name in quotes");
    }
    if has_invisible(text) {
        return wrong(
            "contains a line break or another invisible character",
            "use one line of visible text: a name becomes a column header and appears in exported \
             source",
        );
    }
    if text.starts_with(['=', '+', '-', '@']) {
        return wrong(
            "begins with `=`, `+`, `-` or `@`",
            "begin with a letter: a name becomes a column header, which spreadsheets would read as \
             a formula",
        );
    }
    if text.len() > LONGEST {
        return wrong(
            &format!("is {} bytes long", text.len()),
            "use at most 200 bytes: 200 letters of English, half as many of most other alphabets",
        );
    }
    Ok(())
}

/// Whether a text is a valid name in a scene.
#[must_use]
pub fn is_name(text: &str) -> bool {
    check_name(text).is_ok()
}

/// Whether a text contains an invisible character. Joiners and variation selectors are part of the spelling of some
/// scripts and pictographs, but only after a character of such a script.
fn has_invisible(text: &str) -> bool {
    let mut before = None;
    text.chars().any(|c| {
        let spelt = is_spelling(c) && before.is_some_and(|before: char| !before.is_ascii());
        before = Some(c);
        is_invisible(c) && !spelt
    })
}

fn is_spelling(c: char) -> bool {
    matches!(c, '\u{200c}' | '\u{200d}' | '\u{fe00}'..='\u{fe0f}')
}

/// Control characters, line and paragraph separators, blanks that text libraries do not trim, and Unicode's
/// default-ignorable code points (`Default_Ignorable_Code_Point` in `DerivedCoreProperties.txt`), which include changes
/// of the writing direction.
fn is_invisible(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{00ad}' | '\u{034f}' | '\u{061c}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}'
            | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{2800}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}'
            | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}' | '\u{1bca0}'..='\u{1bca3}'
            | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_seen_whole() {
        for good in [
            "arm",
            "left arm",
            "Schwinge-2",
            "جا\u{200c}به",
            "❤\u{fe0f}",
            "क्\u{200d}ष",
            "a=b",
            "x+",
        ] {
            assert!(is_name(good), "{good:?}");
        }
        let invisible = [
            '\u{ad}',
            '\u{34f}',
            '\u{61c}',
            '\u{115f}',
            '\u{1160}',
            '\u{17b4}',
            '\u{180e}',
            '\u{200b}',
            '\u{200c}',
            '\u{200d}',
            '\u{200f}',
            '\u{2029}',
            '\u{2060}',
            '\u{2064}',
            '\u{206f}',
            '\u{2800}',
            '\u{3164}',
            '\u{fe0f}',
            '\u{feff}',
            '\u{ffa0}',
            '\u{fffb}',
            '\u{1d173}',
            '\u{e0001}',
            '\u{e0100}',
            '\u{7f}',
            '\u{85}',
        ];
        for c in invisible {
            // Alone, and such that two names look alike.
            for name in [c.to_string(), format!("arm{c}"), format!("{c}arm"), format!("a{c}rm")] {
                assert!(!is_name(&name), "{name:?}");
            }
        }
        for blank in ["", " ", "\u{a0}", "\u{2003}\u{3000}", "\u{1680}", "\u{202f}"] {
            assert!(!is_name(blank), "{blank:?}");
        }
    }

    #[test]
    fn a_name_is_no_formula() {
        for name in ["=1+1", "+x", "-x", "@SUM(A1)", "=HYPERLINK(\"http://a\")"] {
            assert!(!is_name(name), "{name:?}");
        }
    }
}
