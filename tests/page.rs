//! Tables and figures in README.md and docs/, written by the tests that know them.
//!
//! `page, name, text => the page holds the text`. A block stands between two comments,
//! `<!-- table NAME: COMMAND -->` and `<!-- end -->`; the command is the test that writes it. With
//! `DBD_BLESS=1` in the environment the test writes the block, otherwise it compares. Golden bits are written by
//! `DBD_BLESS=golden` alone, never in passing.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::Path;

/// What ends a block.
const END: &str = "<!-- end -->";

/// Lines of either text that a failure shows.
const MAX_LINES: usize = 40;

/// Whether the environment blesses what is derived from the sources (`DBD_BLESS=1`).
#[must_use]
pub fn is_blessed() -> bool {
    environment_says("1")
}

fn environment_says(word: &str) -> bool {
    std::env::var_os("DBD_BLESS").is_some_and(|value| value == word)
}

/// Compares a file that is derived from the sources, by its path from the root, with what was computed, or writes it
/// where `DBD_BLESS=1`. `command` is the one that runs the test.
///
/// # Panics
/// Where the file holds something else; the message names `DBD_BLESS=1` and the command.
pub fn file(name: &str, text: &str, command: &str) {
    kept(name, text, "1", command);
}

/// The same of golden bits: they are written where `DBD_BLESS=golden`, which nothing else is by.
///
/// # Panics
/// Where the file holds something else; the message names `DBD_BLESS=golden` and the command.
pub fn golden(name: &str, text: &str, command: &str) {
    kept(name, text, "golden", command);
}

fn kept(name: &str, text: &str, word: &str, command: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
    if environment_says(word) {
        std::fs::write(&path, text).unwrap();
    }
    let present = std::fs::read_to_string(&path).unwrap_or_default();
    if let Err(why) = same(&present, text) {
        panic!("{name} {why}if the new lines are right: DBD_BLESS={word} {command}");
    }
}

/// Compares a block of a page, by its path from the root, with what it ought to hold, or writes it. A block that is made
/// of measured data names their commit.
///
/// # Panics
/// Where the page has no such block, or one that holds something else.
pub fn block(page: &str, name: &str, text: &str) {
    let text = &format!("{}\n{}", text.trim_end(), crate::results::origin());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(page);
    let bless = is_blessed();
    let mut file = File::options().read(true).write(bless).open(&path).unwrap();
    // Other tests write other blocks of the page at the same time.
    file.lock().unwrap();
    let mut present = String::new();
    file.read_to_string(&mut present).unwrap();
    if bless {
        let wanted = with(&present, name, text).unwrap_or_else(|why| panic!("{page}: {why}"));
        if wanted != present {
            file.seek(SeekFrom::Start(0)).unwrap();
            file.set_len(0).unwrap();
            file.write_all(wanted.as_bytes()).unwrap();
        }
    } else if let Err(why) = compared(&present, name, text) {
        panic!("{page}: {why}");
    }
}

/// Where a block begins and ends in a page, and its command.
fn find<'p>(page: &'p str, name: &str) -> Result<(std::ops::Range<usize>, &'p str), String> {
    let head = format!("<!-- table {name}: ");
    let (before, rest) =
        page.split_once(&head).ok_or(format!("has no block `{head}COMMAND -->`"))?;
    let (command, rest) = rest.split_once(" -->\n").ok_or(format!("`{head}` has no end"))?;
    let start = before.len() + head.len() + command.len() + " -->\n".len();
    let length = rest.find(END).ok_or(format!("no `{END}` after block `{name}`"))?;
    if rest.contains(&head) || rest[..length].contains("<!-- table ") {
        return Err(format!("block `{name}` is there twice or holds another"));
    }
    Ok((start..start + length, command))
}

/// The page with the block's text.
fn with(page: &str, name: &str, text: &str) -> Result<String, String> {
    let (place, _) = find(page, name)?;
    Ok(format!("{}{}\n{}", &page[..place.start], text.trim_end(), &page[place.end..]))
}

/// Whether a page's block holds a text; where not, the lines that differ and what to do.
fn compared(page: &str, name: &str, text: &str) -> Result<(), String> {
    let (place, command) = find(page, name)?;
    let (present, wanted) = (&page[place], format!("{}\n", text.trim_end()));
    same(present, &wanted).map_err(|why| {
        format!("block `{name}` {why}if the new lines are right: DBD_BLESS=1 {command}")
    })
}

/// Whether two texts are the same; where not, the lines that differ.
fn same(present: &str, wanted: &str) -> Result<(), String> {
    if present == wanted {
        return Ok(());
    }
    let mut lines = String::new();
    let (old, new): (Vec<_>, Vec<_>) = (present.lines().collect(), wanted.lines().collect());
    for line in old.iter().filter(|line| !new.contains(line)).take(MAX_LINES) {
        let _ = writeln!(lines, "- {line}");
    }
    for line in new.iter().filter(|line| !old.contains(line)).take(MAX_LINES) {
        let _ = writeln!(lines, "+ {line}");
    }
    Err(format!("is not what was computed:\n{lines}"))
}

/// A table in Markdown.
///
/// # Panics
/// Where a row has more or fewer cells than the head.
#[must_use]
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        assert_eq!(row.len(), head.len(), "{row:?}");
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// A number to so many significant digits: plain where it is short, else with an exponent.
#[must_use]
pub fn figure(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    // What the rounding made of it decides, so that 9.96 is 10 and not 10.0.
    let rounded: f64 = text.parse().unwrap_or(value);
    let exponent = rounded.abs().log10().floor() as i32;
    if !(-2..=5).contains(&exponent) {
        return text;
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    let plain = format!("{rounded:.decimals$}");
    match plain.split_once('.') {
        Some((whole, part)) => format!("{}.{part}", grouped(whole)),
        None => grouped(&plain),
    }
}

/// A whole number with a comma before every three digits, from four digits on.
#[must_use]
pub fn grouped(whole: &str) -> String {
    let mut text = String::new();
    for (i, digit) in whole.chars().enumerate() {
        let left = whole.len() - i;
        if i > 0 && left.is_multiple_of(3) && digit.is_ascii_digit() && !text.ends_with('-') {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{compared, figure, grouped, table, with};

    const PAGE: &str = "a\n<!-- table t: cargo test -->\nold\nsame\n<!-- end -->\nb\n";

    #[test]
    fn a_block_is_compared_and_written() {
        assert_eq!(compared(PAGE, "t", "old\nsame"), Ok(()));
        let why = compared(PAGE, "t", "new\nsame\n").unwrap_err();
        assert!(why.contains("- old\n+ new\n") && why.ends_with("DBD_BLESS=1 cargo test"), "{why}");
        let new = with(PAGE, "t", "new\n\n").unwrap();
        assert_eq!(new, "a\n<!-- table t: cargo test -->\nnew\n<!-- end -->\nb\n");
        assert_eq!(compared(&new, "t", "new"), Ok(()));
        assert!(compared(PAGE, "u", "").unwrap_err().contains("no block"));
        assert!(compared(&PAGE.repeat(2), "t", "").unwrap_err().contains("twice"));
        assert!(compared(&PAGE.replace("<!-- end -->", ""), "t", "").is_err());
    }

    #[test]
    fn figures_are_short() {
        let shown = [0.0, 1.04e-5, 0.00996, 0.0782, 9.96, 26.4, 1834.0, -60_450.0, 2.1e7]
            .map(|value| figure(value, 2));
        let expected = ["0", "1.0e-5", "0.010", "0.078", "10", "26", "1,800", "-60,000", "2.1e7"];
        assert_eq!(shown, expected);
        assert_eq!(
            ["1234567", "123", "-123", "-1234"].map(grouped),
            ["1,234,567", "123", "-123", "-1,234"]
        );
        assert_eq!(
            table(&["a", "b"], &[vec!["1".into(), "2".into()]]),
            "| a | b |\n|---|---|\n| 1 | 2 |\n"
        );
    }
}
