//! `trade.html`: the charts, advice and every point in one self-contained page.
//!
//! `chart => HTML`.

use std::fmt::Write as _;

use dbd_plant::digits::significant;
use dbd_report::output;
use dbd_report::output::markup::{HOVER_SCRIPT, PAGE_STYLE, escape};

use crate::advice::{advice, remark};
use crate::chart::{Chart, narrow_svg, steppers, svg};
use crate::front_table::{headings, rows};
use crate::point::{Machine, Point};
use crate::precisions::of_precisions;
use crate::stability::MARGIN;
use crate::variants_table;
use crate::words::{capital, percent, shown};

const STYLE: &str = include_str!("trade.css");
const SCRIPT: &str = include_str!("trade.js");

/// The page.
#[must_use]
pub fn html(chart: &Chart<'_>) -> String {
    let title = format!("{}: accuracy against speed", chart.scene);
    let mut page = format!("<main>\n<h1>{}</h1>\n", escape(&title));
    if !chart.description.is_empty() {
        let _ = writeln!(page, "<p class=\"lead\">{}</p>", escape(chart.description));
    }
    machine(&mut page, chart, Machine::Host, "On this PC");
    let counted = |point: &Point| point.target_instructions.is_some();
    if chart.points.iter().any(counted) {
        machine(&mut page, chart, Machine::Target, "On a Cortex-M4F");
    }
    variants(&mut page, chart);
    reading(&mut page, chart);
    all(&mut page, chart);
    if !chart.conditions.is_empty() {
        page.push_str("<h2>Conditions</h2>\n<ul>\n");
        for line in chart.conditions {
            let _ = writeln!(page, "<li>{}</li>", escape(line));
        }
        page.push_str("</ul>\n");
    }
    page.push_str("</main>\n");
    output::page::html(&title, &[PAGE_STYLE, STYLE], &page, &[HOVER_SCRIPT, SCRIPT])
}

/// The sentences, the chart and the front of a machine.
fn machine(page: &mut String, chart: &Chart<'_>, machine: Machine, title: &str) {
    let _ = writeln!(page, "<h2>{title}</h2>");
    if let Some(remark) = remark(chart.points, machine) {
        let _ = writeln!(page, "<p>{}.</p>", capital(remark));
    }
    let all = advice(chart.points, machine, chart.uncertainty);
    if !all.is_empty() {
        page.push_str("<ul class=\"advice\">\n");
        for advice in &all {
            let sentence = escape(&capital(&advice.sentence));
            let line = chart.command.line(&chart.points[advice.row]).unwrap_or_default();
            let _ = writeln!(page, "<li>{sentence}.<br><code>{}</code></li>", escape(&line));
        }
        page.push_str("</ul>\n");
    }
    if machine == Machine::Target
        && let Some(sentence) = of_precisions(chart.points, chart.uncertainty)
    {
        let _ = writeln!(page, "<p>{}.</p>", escape(&capital(&sentence)));
    }
    let (wide, narrow) = (svg(chart, machine), narrow_svg(chart, machine));
    let _ = writeln!(
        page,
        "<figure class=\"broad\">\n{wide}</figure>\n<figure class=\"narrow\">\n{narrow}</figure>"
    );
    let rows = rows(chart.points, machine);
    if rows.is_empty() {
        return;
    }
    page.push_str("<h3>Pareto front</h3>\n<div class=\"wide\"><table>\n<thead><tr>");
    for (column, [name, unit]) in headings(machine).into_iter().enumerate() {
        let _ = write!(page, "<th{}>{name}<small>{unit}</small></th>", number(column != 1));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    let numbers = steppers(chart.points);
    for (row, cells) in rows {
        start(page, numbers.get(&chart.points[row].stepper));
        let hidden = chart.points[row].error.is_some_and(|error| error < chart.uncertainty);
        let floor = format!("< {:.1e}", chart.uncertainty);
        for (column, cell) in cells.iter().enumerate() {
            let cell = match column {
                0 if hidden => &floor,
                4 if hidden => "–",
                _ => cell.as_str(),
            };
            let _ = write!(page, "<td{}>{}</td>", number(column != 1), escape(cell));
        }
        page.push_str("</tr>\n");
    }
    page.push_str(
        "</tbody></table></div>\n<p>“Paper's scheme”: the cost of the paper's scheme at equal \
         accuracy, as a multiple of this cost, interpolated between its measured steps; * extrapolated \
         from its last two steps, by at most two decades of error; ≤ at its largest step, which is \
         more accurate.</p>\n",
    );
}

/// The scene and its variants, if any.
fn variants(page: &mut String, chart: &Chart<'_>) {
    if chart.variants.is_empty() {
        return;
    }
    let title = capital(variants_table::TITLE);
    let _ = write!(page, "<h2>{title}</h2>\n<div class=\"wide\"><table>\n<thead><tr>");
    for (column, (name, unit)) in variants_table::HEADINGS.into_iter().enumerate() {
        let _ = write!(page, "<th{}>{name}<small>{unit}</small></th>", number(column > 0));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for row in variants_table::rows(chart.variants) {
        page.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let _ = write!(page, "<td{}>{}</td>", number(column > 0), escape(cell));
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n<ul>\n");
    for sentence in variants_table::meaning(chart.variants) {
        let _ = writeln!(page, "<li>{}.</li>", escape(&capital(sentence)));
    }
    page.push_str("</ul>\n");
}

fn reading(page: &mut String, chart: &Chart<'_>) {
    let window = significant(chart.window, 3);
    let uncertainty = significant(chart.uncertainty, 2);
    let margin = percent(MARGIN);
    let _ = write!(
        page,
        "<h2>How to read it</h2>\n<ul>\n\
         <li>Each mark is one run: a scheme in a precision at a step. Further down is more \
         accurate, further left is faster. Follow the line of the required accuracy to the yellow band: the mark below it is the cheapest one measured.</li>\n\
         <li>The yellow band is the Pareto front: no measured point is both faster and more accurate. \
         The grey lines are references in plain Rust, without the kernel.</li>\n\
         <li>The error is the distance of the bodies from the reference solution, attitudes included, root mean square over bodies and samples of {window} s. The reference solution is accurate to {uncertainty} m: the grey floor, below which errors are not significant.</li>\n\
         <li>The thick black line is the paper's scheme: explicit, no Newton iteration, double \
         precision; on a Cortex-M4F the dashed line is the same in single.</li>\n\
         <li>Hollow marks at the top are unstable at their step; hollow marks elsewhere are not \
         advised: they are lost (their error exceeds the displacement of the reference solution), or \
         their step is within {margin} of the largest stable one, or rotates a body too far. Point at \
         a mark, or tap it, for its numbers, at a line to see it alone.</li>\n</ul>\n"
    );
}

/// Every point, behind a click.
fn all(page: &mut String, chart: &Chart<'_>) {
    let points = chart.points;
    let _ = write!(
        page,
        "<h2>All points</h2>\n<details><summary>{} points</summary>\n<div class=\"wide\"><table>\n\
         <thead><tr><th>stepper</th>",
        points.len()
    );
    for (name, unit) in [
        ("step", ""),
        ("error", "m"),
        ("energy rms", "J"),
        ("energy peak", "J"),
        ("evaluations", "1/s"),
        ("PC", "core s/s"),
        ("median", "core s/s"),
        ("spread", "%"),
        ("Cortex-M4F", "10⁶ instr/s"),
    ] {
        let _ = write!(page, "<th class=\"number\">{name}<small>{unit}</small></th>");
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    let numbers = steppers(points);
    let mut sorted: Vec<&Point> = points.iter().collect();
    sorted.sort_by(|a, b| a.stepper.cmp(&b.stepper).then(b.step.total_cmp(&a.step)));
    for point in sorted {
        start(page, numbers.get(&point.stepper));
        let reference = if point.stepper.kernel { "" } else { " (reference)" };
        let _ = write!(page, "<td>{}{reference}</td>", escape(&point.stepper.label()));
        let error = match point.error.filter(|_| point.stable) {
            Some(error) if point.lost => format!("{error:.2e}, lost"),
            Some(error) if !point.advisable => format!("{error:.2e}, too close to the limit"),
            Some(error) => format!("{error:.2e}"),
            None => "unstable".into(),
        };
        let known = |value: Option<f64>, digits: usize| match value.filter(|v| v.is_finite()) {
            Some(value) => format!("{value:.digits$e}"),
            None => "–".into(),
        };
        let cells = [
            shown(point.step),
            error,
            known(point.energy_rms, 1),
            known(point.energy_peak, 1),
            significant(point.evaluations, 4),
            known(Some(point.host_seconds_least), 2),
            known(Some(point.host_seconds), 2),
            format!("{:.0}", 100.0 * point.host_spread),
            point.target_instructions.map_or("–".into(), |count| significant(count * 1e-6, 4)),
        ];
        for cell in cells {
            let _ = write!(page, "<td class=\"number\">{cell}</td>");
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div></details>\n");
}

fn start(page: &mut String, number: Option<&usize>) {
    match number {
        Some(number) => {
            let _ = write!(page, "<tr data-stepper=\"{number}\">");
        }
        None => page.push_str("<tr>"),
    }
}

fn number(number: bool) -> &'static str {
    if number { " class=\"number\"" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::tests::{chart, ladders};

    #[test]
    fn a_page_holds_what_was_measured_and_no_other_file() {
        let points = ladders();
        let mut chart = chart(&points);
        let page = html(&chart);
        if let Ok(folder) = std::env::var("DBD_DRAW") {
            std::fs::write(format!("{folder}/trade.html"), &page).unwrap();
        }
        // Both charts, each for wide screens and for narrow ones.
        assert_eq!(page.matches("<svg").count(), 4);
        assert_eq!(page.matches("<svg").count(), page.matches("</svg>").count());
        // Each point is a row; each of the fronts', too.
        let fronts: usize = [Machine::Host, Machine::Target]
            .map(|machine| rows(&points, machine).len())
            .iter()
            .sum();
        assert_eq!(page.matches("<tr data-stepper").count(), points.len() + fronts);
        assert!(page.contains("crank &lt;&amp;&gt; slider") && !page.contains("<&>"));
        assert!(!page.contains("NaN") && !page.contains("inf "));
        let page = page.replace("<link rel=\"icon\" href=\"data:,\">", "");
        for file in ["src=", "href=", "url("] {
            assert!(!page.contains(file), "{file}");
        }
        for advice in advice(&points, Machine::Host, chart.uncertainty) {
            let (sentence, line) = (&advice.sentence[1..], chart.command.line(&points[advice.row]));
            assert!(page.contains(&escape(sentence)), "{sentence}");
            assert!(page.contains(&format!("<code>{}</code>", escape(&line.unwrap()))));
        }
        // Without counted instructions there is no chart of the chip.
        let mut uncounted = points.clone();
        uncounted.iter_mut().for_each(|point| point.target_instructions = None);
        chart.points = &uncounted;
        assert_eq!(html(&chart).matches("<svg").count(), 2);
    }
}
