//! Text for people and programs: JSON, rows and columns.
//!
//! `(values, look) => lines`. Cells are as wide as a terminal shows them, whatever the letters. On a terminal long
//! texts go on in the next line, below their beginning, and names that do not fit lose their middle; elsewhere
//! all stands in one line.

use anstyle::Style;
use serde::Serialize;
use textwrap::core::display_width;
use textwrap::{Options, WordSplitter, wrap};

use crate::terminal::look::{BAD, DOUBTFUL, GOOD, GOOD_TO_KNOW, HEAD, Look};

/// Between two columns.
const GAP: usize = 2;

/// Columns that a text gets at least before it moves into a line of its own.
const LEAST_TEXT: usize = 24;

/// Columns that a name keeps at least.
const LEAST_NAME: usize = 9;

/// Where a text begins that has a line of its own.
const BELOW: usize = 4;

/// Where the further lines of a sentence begin.
const FURTHER: usize = 2;

/// A value as JSON, indented, with a final line feed. What JSON cannot hold becomes `null`.
#[must_use]
pub fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).unwrap_or_default();
    text.push('\n');
    text
}

impl Look {
    /// Rows of a name and a text as aligned lines; warnings, notes and how it ended are coloured.
    #[must_use]
    pub fn table<N: AsRef<str>>(self, rows: &[(N, String)]) -> String {
        let names = rows.iter().map(|(name, _)| display_width(name.as_ref()));
        let indent = names.max().unwrap_or(0) + GAP;
        let mut lines = String::new();
        for (name, text) in rows {
            let (name, tone) = (name.as_ref(), tone(name.as_ref(), text));
            let space = " ".repeat(indent - display_width(name));
            let mut pieces = self.broken(text, indent).into_iter();
            let painted = |style: Option<Style>, text: &str| match style {
                Some(style) => self.paint(style, text),
                None => text.to_owned(),
            };
            let first = pieces.next().unwrap_or_default();
            let text_tone = tone.filter(|_| name == STATUS);
            lines += &painted(tone.filter(|_| name != STATUS), name);
            lines += &format!("{space}{}\n", painted(text_tone, &first));
            for piece in pieces {
                lines += &format!("{:indent$}{}\n", "", painted(text_tone, &piece));
            }
        }
        lines
    }

    /// A separate sentence, its further lines indented.
    #[must_use]
    pub fn sentence(self, text: &str) -> String {
        let pieces = self.broken(text, FURTHER);
        let indented = pieces.join(&format!("\n{:FURTHER$}", ""));
        indented + "\n"
    }

    /// A text in pieces that fit behind an indent.
    fn broken(self, text: &str, indent: usize) -> Vec<String> {
        let Some(width) = self.width else { return vec![text.to_owned()] };
        let room = width.saturating_sub(indent).max(LEAST_TEXT);
        let options =
            Options::new(room).break_words(false).word_splitter(WordSplitter::NoHyphenation);
        wrap(text, options).into_iter().map(String::from).collect()
    }

    /// Lines of cells in columns below a head, if there is one; numbers stand at the right of theirs.
    #[must_use]
    pub fn columns<const N: usize>(self, head: Option<[&str; N]>, lines: &[[String; N]]) -> String {
        let head = head.map(|head| head.map(str::to_owned));
        let is_number = std::array::from_fn(|column| {
            lines.iter().all(|line| line[column] == "–" || line[column].parse::<f64>().is_ok())
        });
        let layout = Layout::of(self.width, is_number, head.iter().chain(lines));
        let heads = head.iter().map(|head| self.line(head, &layout, Some(HEAD)));
        heads.chain(lines.iter().map(|line| self.line(line, &layout, None))).collect()
    }

    /// One line of cells, or more where the last does not fit into one.
    fn line<const N: usize>(
        self,
        cells: &[String; N],
        layout: &Layout<N>,
        style: Option<Style>,
    ) -> String {
        let (mut line, mut further, mut indent) = (String::new(), Vec::new(), 0);
        let last = N.saturating_sub(1);
        for (column, (cell, width)) in cells.iter().zip(layout.widths).enumerate() {
            let mut cell = cell.clone();
            if layout.is_below && column == last {
                indent = BELOW;
                further = self.broken(&cell, indent);
                break;
            } else if display_width(&cell) > width && column == last && self.width.is_some() {
                let mut pieces = self.broken(&cell, indent).into_iter();
                cell = pieces.next().unwrap_or_default();
                further = pieces.collect();
            } else if display_width(&cell) > width {
                cell = without_middle(&cell, width);
            }
            let space = " ".repeat(width.saturating_sub(display_width(&cell)));
            let painted = style.map_or_else(|| cell.clone(), |style| self.paint(style, &cell));
            line += &match layout.is_number[column] {
                true => format!("{space}{painted}"),
                false => format!("{painted}{space}"),
            };
            if column < last {
                line += &" ".repeat(layout.gap);
                indent += width + layout.gap;
            }
        }
        line.truncate(line.trim_end().len());
        let further = further.iter().map(|piece| format!("\n{:indent$}{piece}", ""));
        line + &further.collect::<String>() + "\n"
    }
}

/// Where the columns of a table lie.
struct Layout<const N: usize> {
    widths: [usize; N],
    is_number: [bool; N],
    gap: usize,
    /// Whether the last column has lines of its own, below the others.
    is_below: bool,
}

impl<const N: usize> Layout<N> {
    /// The layout of lines in a room: the last text gives way first, then the gaps do, then names, the widest before
    /// others.
    fn of<'l>(
        room: Option<usize>,
        is_number: [bool; N],
        lines: impl Iterator<Item = &'l [String; N]>,
    ) -> Self {
        let mut widths = [0; N];
        for line in lines {
            for (width, cell) in widths.iter_mut().zip(line) {
                *width = (*width).max(display_width(cell));
            }
        }
        let mut layout = Self { widths, is_number, gap: GAP, is_below: false };
        let (Some(room), Some(last)) = (room, N.checked_sub(1)) else { return layout };
        let mut names = 0..N;
        if !is_number[last] {
            names = 0..last;
            let others: usize = layout.widths[..last].iter().map(|width| width + GAP).sum();
            let left = room.saturating_sub(others);
            layout.is_below = left < layout.widths[last].min(LEAST_TEXT);
            let least = if layout.is_below { 0 } else { LEAST_TEXT };
            layout.widths[last] = layout.widths[last].min(left.max(least));
            if layout.is_below {
                layout.widths[last] = 0;
            }
        }
        let gaps = |gap: usize| gap * if layout.is_below { last.saturating_sub(1) } else { last };
        let all = |widths: &[usize; N], gap| widths.iter().sum::<usize>() + gaps(gap);
        if all(&layout.widths, GAP) > room {
            layout.gap = 1;
        }
        while all(&layout.widths, layout.gap) > room {
            let shrinks =
                |column: &usize| !is_number[*column] && layout.widths[*column] > LEAST_NAME;
            let widest = names.clone().filter(shrinks).max_by_key(|column| layout.widths[*column]);
            let Some(widest) = widest else { break };
            layout.widths[widest] -= 1;
        }
        layout
    }
}

/// The row that says how it ended.
const STATUS: &str = "status";

/// What colour a row has.
fn tone(name: &str, text: &str) -> Option<Style> {
    match name {
        "warning" => Some(DOUBTFUL),
        "note" => Some(GOOD_TO_KNOW),
        STATUS if text == "ok" => Some(GOOD),
        STATUS => Some(BAD),
        _ => None,
    }
}

/// A name that is as wide as it may be: beginning and end stay.
fn without_middle(name: &str, width: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    let (mut begin, mut end) = (letters.len() / 2, letters.len() / 2);
    loop {
        let short: String = letters[..begin].iter().chain(&['…']).chain(&letters[end..]).collect();
        if display_width(&short) <= width || (begin == 0 && end == letters.len()) {
            return short;
        }
        if begin > letters.len() - end { begin -= 1 } else { end += 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NARROW: Look = Look { colours: false, width: Some(40) };
    const COLOURED: Look = Look { colours: true, width: None };

    fn cells<const N: usize>(lines: &[[&str; N]]) -> Vec<[String; N]> {
        lines.iter().map(|line| line.map(str::to_owned)).collect()
    }

    #[test]
    fn rows_are_aligned_by_what_a_terminal_shows() {
        let rows = [("a", "1".into()), ("höhe", "2".into()), ("高さ", "3".into())];
        assert_eq!(Look::PLAIN.table(&rows), "a     1\nhöhe  2\n高さ  3\n");
    }

    #[test]
    fn long_texts_go_on_below_their_beginning() {
        let rows = [("warning", "a joint opens by more than 25 % of its free length".to_owned())];
        let text = NARROW.table(&rows);
        assert_eq!(text, "warning  a joint opens by more than 25 %\n         of its free length\n");
        assert_eq!(Look::PLAIN.table(&rows).lines().count(), 1);
        // What nobody should have to put together again stays whole.
        let path = format!("/{}/trace.csv", "long".repeat(20));
        assert!(NARROW.table(&[("written", path.clone())]).contains(&path));
    }

    #[test]
    fn a_sentence_goes_on_indented() {
        let text = NARROW
            .sentence("for 1e-3 m choose leapfrog, f32, step 100us (20 million instructions)");
        assert_eq!(
            text,
            "for 1e-3 m choose leapfrog, f32, step\n  100us (20 million instructions)\n"
        );
        assert_eq!(Look::PLAIN.sentence("one two"), "one two\n");
    }

    #[test]
    fn numbers_stand_at_the_right() {
        let lines = cells(&[["A0", "5", "x"], ["longer", "1200", "–"], ["b", "–", "y"]]);
        let text = Look::PLAIN.columns(Some(["joint", "N", "what"]), &lines);
        assert_eq!(text, "joint      N  what\nA0         5  x\nlonger  1200  –\nb          –  y\n");
    }

    #[test]
    fn every_line_fits_a_narrow_terminal() {
        let lines = cells(&[
            ["upper-wishbone-front", "12", "holds the upright at its front, on rubber"],
            ["上のリンクの前側のジョイント", "1", "short"],
        ]);
        for width in [30, 40, 50, 70, 100] {
            let look = Look { colours: false, width: Some(width) };
            let text = look.columns(None, &lines);
            assert!(text.lines().all(|line| display_width(line) <= width), "{width}:\n{text}");
            // Whoever has to type a name needs all of it; the text behind it goes below.
            assert!(text.contains("upper-wishbone-front") && text.contains("rubber"), "{text}");
        }
        assert!(NARROW.columns(None, &lines).contains("12\n    holds the upright"));
        let numbers =
            lines.iter().map(|[name, count, _]| [name.clone(), name.clone(), count.clone()]);
        let text = NARROW.columns(Some(["name", "between", "count"]), &numbers.collect::<Vec<_>>());
        assert!(text.lines().all(|line| display_width(line) <= 40), "{text}");
        assert!(text.contains("…"), "{text}");
    }

    #[test]
    fn a_name_loses_its_middle() {
        assert_eq!(without_middle("upper-front", 9), "uppe…ront");
        assert_eq!(without_middle("上のリンク", 5), "上…ク");
        assert_eq!(without_middle("ab", 0), "…");
    }

    #[test]
    fn colours_change_no_place() {
        let rows = [("status", "ok".to_owned()), ("warning", "soft".into()), ("a", "b".into())];
        let text = COLOURED.table(&rows);
        assert!(text.contains("status   \u{1b}[32mok\u{1b}[0m\n"), "{text:?}");
        assert!(text.contains("\u{1b}[33mwarning\u{1b}[0m  soft\n"), "{text:?}");
        assert_eq!(anstream::adapter::strip_str(&text).to_string(), Look::PLAIN.table(&rows));
        let failed = COLOURED.table(&[("status", "diverged".to_owned())]);
        assert!(failed.contains("\u{1b}[31mdiverged"), "{failed:?}");
        let lines = cells(&[["a", "1"]]);
        let text = COLOURED.columns(Some(["name", "count"]), &lines);
        assert_eq!(
            anstream::adapter::strip_str(&text).to_string(),
            Look::PLAIN.columns(Some(["name", "count"]), &lines)
        );
        assert!(text.starts_with("\u{1b}[1mname\u{1b}[0m"), "{text:?}");
    }
}
