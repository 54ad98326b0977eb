//! Findings for people: a table in Markdown, a table in CSV, one page in HTML.

use std::fmt::Write as _;

use dbd_plant::digits::significant;
use dbd_report::output;
use dbd_report::output::markup::{PAGE_STYLE, escape};

use crate::paper::finding::{Finding, Row};
use crate::paper::plot;

/// A number to three digits, a dash if there is none.
fn number(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| significant(value, 3))
}

/// Columns of a row: quantity with unit, paper, here, ratio, verdict, note.
#[must_use]
pub fn columns(row: &Row) -> [String; 6] {
    let unit = if row.unit.is_empty() { String::new() } else { format!(" [{}]", row.unit) };
    [
        format!("{}{unit}", row.quantity),
        number(row.paper),
        number(row.ours),
        number(row.ratio()),
        row.verdict.map_or("–", |verdict| verdict.words()).to_owned(),
        row.note.clone(),
    ]
}

/// The head of the columns.
pub const HEAD: [&str; 6] = ["quantity", "paper", "here", "here over paper", "verdict", "note"];

/// The findings as Markdown tables, one per item.
#[must_use]
pub fn markdown(findings: &[Finding]) -> String {
    let mut text = String::new();
    for finding in findings {
        let verdict = finding.verdict().map_or("–", |verdict| verdict.words());
        let _ = writeln!(text, "### {}: {}\n", finding.place, finding.title);
        let _ = writeln!(text, "`{}`: {verdict}.\n", finding.item);
        let _ = writeln!(text, "| {} |\n|---|--:|--:|--:|---|---|", HEAD.join(" | "));
        for row in &finding.rows {
            let cells = columns(row).map(|cell| cell.replace('|', "\\|"));
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
        text.push('\n');
        for assumption in &finding.assumptions {
            let _ = writeln!(text, "- {assumption}");
        }
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

/// The rows of an item as CSV.
///
/// # Errors
/// Where a row cannot be written.
pub fn csv(finding: &Finding) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["quantity", "unit", "paper", "ours", "ratio", "verdict", "note"])?;
    for row in &finding.rows {
        let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        writer.write_record([
            row.quantity.clone(),
            row.unit.clone(),
            number(row.paper),
            number(row.ours),
            number(row.ratio()),
            row.verdict.map_or("", |verdict| verdict.words()).to_owned(),
            row.note.clone(),
        ])?;
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// One page that needs no other file.
#[must_use]
pub fn html(findings: &[Finding], conditions: &str) -> String {
    let mut body = String::new();
    let _ = writeln!(body, "<p>{}</p>", escape(conditions));
    let _ = writeln!(body, "<table><tr><th>item</th><th>place</th><th>verdict</th></tr>");
    for finding in findings {
        let verdict = finding.verdict().map_or("–", |verdict| verdict.words());
        let _ = writeln!(
            body,
            "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{verdict}</td></tr>",
            escape(&finding.item),
            escape(&finding.place)
        );
    }
    body.push_str("</table>\n");
    for finding in findings {
        let _ = writeln!(
            body,
            "<h2 id=\"{}\">{}: {}</h2>",
            escape(&finding.item),
            escape(&finding.place),
            escape(&finding.title)
        );
        finding.plots.iter().for_each(|drawn| body.push_str(&plot::svg(drawn)));
        body.push_str("<table><tr>");
        HEAD.iter().for_each(|head| {
            let _ = write!(body, "<th>{head}</th>");
        });
        body.push_str("</tr>\n");
        for row in &finding.rows {
            let class = row.verdict.map_or("none", |verdict| verdict.words());
            let class = class.split(' ').next_back().unwrap_or_default();
            let _ = write!(body, "<tr class=\"{class}\">");
            for (n, cell) in columns(row).iter().enumerate() {
                let kind = if (1..4).contains(&n) { " class=\"number\"" } else { "" };
                let _ = write!(body, "<td{kind}>{}</td>", escape(cell));
            }
            body.push_str("</tr>\n");
        }
        body.push_str("</table>\n<ul>\n");
        for assumption in &finding.assumptions {
            let _ = writeln!(body, "<li>{}</li>", escape(assumption));
        }
        body.push_str("</ul>\n");
    }
    let title = "Results of Franco & Degani 2026, measured again";
    let body = format!("<main>\n<h1>{}</h1>\n{body}</main>\n", escape(title));
    output::page::html(title, &[PAGE_STYLE, STYLE], &body, &[])
}

const STYLE: &str = "\
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.contradicted td:nth-child(5) { color: #c0392b; font-weight: 600; }
svg { max-width: 100%; height: auto; }
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::finding::EXACT;

    fn finding() -> Finding {
        Finding {
            item: "x".into(),
            place: "Table <1>".into(),
            title: "T".into(),
            assumptions: vec!["a & b".into()],
            rows: vec![
                Row::compared("q, with comma", "m", 2.0, 2.0, EXACT),
                Row::claim("c", false, "a | b"),
            ],
            plots: Vec::new(),
        }
    }

    #[test]
    fn tables_hold_every_row_and_no_foreign_markup() {
        let found = [finding()];
        let text = markdown(&found);
        assert!(text.contains("| q, with comma [m] | 2 | 2 | 1 | reproduced |  |"), "{text}");
        assert!(text.contains("`x`: contradicted.") && text.contains("a \\| b"), "{text}");
        let page = html(&found, "on a PC");
        assert!(page.contains("Table &lt;1&gt;") && page.contains("a &amp; b"), "{page}");
        let table = csv(&found[0]).unwrap();
        assert!(table.starts_with(
            "quantity,unit,paper,ours,ratio,verdict,note\n\"q, with comma\",m,2,2,1,reproduced,\n"
        ));
    }
}
