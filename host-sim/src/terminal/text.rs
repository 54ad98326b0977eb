//! Text for people and programs: JSON, rows and columns.
//!
//! `values => lines`.

use serde::Serialize;

/// A value as JSON, indented, with a final line feed. What JSON cannot hold becomes `null`.
#[must_use]
pub fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).unwrap_or_default();
    text.push('\n');
    text
}

/// Rows as aligned lines.
#[must_use]
pub fn table<N: AsRef<str>>(rows: &[(N, String)]) -> String {
    let width = rows.iter().map(|(name, _)| name.as_ref().chars().count()).max().unwrap_or(0);
    rows.iter().map(|(name, text)| format!("{:<width$}  {text}\n", name.as_ref())).collect()
}

/// Lines of cells in columns.
#[must_use]
pub fn aligned<const N: usize>(lines: &[[String; N]]) -> String {
    let width =
        |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for line in lines {
        for (cell, width) in line.iter().zip(widths) {
            text.push_str(&format!("{cell:<width$}  "));
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_aligned() {
        let text = table(&[("a", "1".into()), ("höhe", "2".into())]);
        assert_eq!(text, "a     1\nhöhe  2\n");
    }
}
