//! The scene with the recorded inputs as tables: repeats the run, without the hand.
//!
//! `(scene's text, times and values) => scene's text`.

use std::fmt::Write as _;

use crate::session::live::Session;

impl Session {
    /// The scene with a table in place of the value of each input that was set. Inputs without a separate `[[input]]`
    /// table in the text are appended as comments.
    #[must_use]
    pub fn replay(&self) -> String {
        let mut text = self.asked.text.clone();
        for (row, input) in self.instance.inputs().iter().enumerate() {
            let set = self.inputs_set.iter().filter(|(_, of, _)| *of == row);
            let knots: Vec<(f64, f64)> = set.map(|(time, _, value)| (*time, *value)).collect();
            // A rate has no separate table.
            if knots.is_empty() || input.name.ends_with(".rate") {
                continue;
            }
            let table = table(input.start, &knots);
            text = placed(&text, &input.name, &table).unwrap_or_else(|| {
                let commented = table.replace('\n', "\n# ");
                format!(
                    "{text}\n# of the input `{}`:\n# {}\n",
                    input.name,
                    commented.trim_end_matches("# ").trim_end()
                )
            });
        }
        text
    }
}

/// The lines of an input's table; of several values at one time the last.
fn table(start: f64, knots: &[(f64, f64)]) -> String {
    let mut rows: Vec<(f64, f64)> = vec![(0.0, start)];
    for knot in knots {
        match rows.last_mut() {
            Some(last) if knot.0 <= last.0 => last.1 = knot.1,
            _ => rows.push(*knot),
        }
    }
    let mut text = String::from("table = [");
    for (time, value) in rows {
        let _ = write!(text, "[{time:?}, {value:?}], ");
    }
    text.truncate(text.len() - 2);
    text + "]\ninterpolate = \"held\"\n"
}

/// The text with lines in the `[[input]]` of a name, instead of its value.
fn placed(text: &str, name: &str, table: &str) -> Option<String> {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let is_header = |line: &str| line.trim_start().starts_with('[');
    let key = |line: &str, key: &str| {
        let rest = line.trim_start().strip_prefix(key)?.trim_start().strip_prefix('=')?;
        Some(rest.trim().to_owned())
    };
    let mut from = 0;
    loop {
        let header = from
            + lines[from..].iter().position(|line| line.trim_start().starts_with("[[input]]"))?;
        let end = lines[header + 1..].iter().position(|line| is_header(line));
        let end = end.map_or(lines.len(), |count| header + 1 + count);
        let block = &lines[header..end];
        let named =
            |line: &&str| key(line, "name").is_some_and(|value| unquoted(&value) == Some(name));
        let Some(at) = block.iter().position(named) else {
            from = header + 1;
            continue;
        };
        let mut written = lines[..header].concat();
        for (row, line) in block.iter().enumerate() {
            if key(line, "value").is_none() {
                written += line;
            }
            if row == at {
                if !line.ends_with('\n') {
                    written.push('\n');
                }
                written += table;
            }
        }
        return Some(written + &lines[end..].concat());
    }
}

/// The content of a TOML string without escapes; ignores trailing text.
fn unquoted(value: &str) -> Option<&str> {
    let quote = value.chars().next().filter(|first| matches!(first, '"' | '\''))?;
    value[1..].split(quote).next()
}
