//! `sweep.html`: one self-contained page.
//!
//! `(spec, table) => HTML`. Over one axis a curve per figure; over two a map in colours, or a family of curves where
//! one of them has few values or names; a sample, or a grid of more, as points over each axis. The page lists what only
//! the table contains.

use std::fmt::Write as _;

use dbd_report::output;
use dbd_report::output::markup::{HOVER_SCRIPT, PAGE_STYLE, escape};

use crate::plot::heat::{self, Heat};
use crate::plot::lines::{self, Drawing, Series};
use crate::plot::{COLOURS, Scale};
use crate::sweep::columns::Column;
use crate::sweep::coordinates::Coordinates;
use crate::sweep::row::OK;
use crate::sweep::spec::Spec;
use crate::sweep::statistic::Statistic;
use crate::sweep::table::Table;

/// Data of a page.
pub struct Page<'p> {
    /// Name of the sweep.
    pub name: &'p str,
    /// The scene's name.
    pub scene: &'p str,
    /// The sweep.
    pub spec: &'p Spec,
    /// The columns that it has figures of.
    pub columns: &'p [Column],
    /// Its table.
    pub table: &'p Table,
    /// Names and texts for people.
    pub summary: &'p [(&'static str, String)],
    /// Command lines: the sweep, and a single case.
    pub commands: &'p [String],
}

/// Figures of a page at most.
const MAX_FIGURES: usize = 24;
/// Maximum number of values of an axis with separate curves.
const FAMILY: usize = 6;
/// Cases that did not come to their end, of which the page has the words.
const MAX_WORDS: usize = 20;

const HALF: (f64, f64) = (490.0, 300.0);
const WIDE: (f64, f64) = (1000.0, 340.0);

/// The page.
#[must_use]
pub fn html(page: &Page<'_>) -> String {
    let Page { table, .. } = page;
    let mut text = format!(
        "<main>\n<h1>{}</h1>\n<p class=\"lead\">A sweep of the scene {}.</p>\n",
        escape(page.name),
        escape(page.scene)
    );
    text.push_str("<h2>Summary</h2>\n<table>\n");
    for (row, words) in page.summary {
        let _ = writeln!(text, "<tr><th>{row}</th><td>{}</td></tr>", escape(words));
    }
    text.push_str("</table>\n");
    figures(&mut text, page);
    failures(&mut text, table);
    text.push_str("<h2>Run it again</h2>\n<pre>");
    text.push_str(&escape(&page.commands.join("\n")));
    text.push_str("</pre>\n</main>\n");
    let title = format!("{}: sweep of {}", page.name, page.scene);
    output::page::html(&title, &[PAGE_STYLE], &text, &[HOVER_SCRIPT])
}

/// The cases that did not come to their end.
fn failures(text: &mut String, table: &Table) {
    let failed = || table.rows.iter().filter(|row| row[table.axes] != OK);
    let count = failed().count();
    if count == 0 {
        return;
    }
    let _ = write!(
        text,
        "<h2>Not ok</h2>\n<p>{count} of {} cases did not come to their end: a red mark, or hatched, in the \
         drawings.</p>\n<table>\n",
        table.rows.len()
    );
    for row in failed().take(MAX_WORDS) {
        let values = table.header[1..table.axes].iter().zip(&row[1..]);
        let values: Vec<String> = values.map(|(axis, cell)| format!("{axis} = {cell}")).collect();
        let _ = writeln!(
            text,
            "<tr><th>{}</th><td>{}<br>{}</td></tr>",
            escape(&format!("case {}", row[0])),
            escape(&values.join(", ")),
            escape(&row[table.axes]),
        );
    }
    text.push_str("</table>\n");
    if count > MAX_WORDS {
        let _ = writeln!(text, "<p>… and {} more.</p>", count - MAX_WORDS);
    }
}

/// A figure of a column, and where the table has it.
struct Shown<'p> {
    column: &'p Column,
    statistic: Statistic,
    place: usize,
}

impl Shown<'_> {
    fn unit(&self) -> &str {
        if self.statistic == Statistic::TimeOfMax { "s" } else { &self.column.unit }
    }

    fn title(&self) -> String {
        format!("{}.{}", self.column.name, self.statistic.name())
    }

    fn label(&self) -> String {
        with_unit(&self.title(), self.unit())
    }

    /// Its value in a row of the table, of a case that came to its end.
    fn value(&self, table: &Table, row: &[String]) -> Option<f64> {
        if row[table.axes] == OK { row[self.place].parse().ok() } else { None }
    }
}

fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// The drawings.
fn figures(text: &mut String, page: &Page<'_>) {
    let Page { spec, columns, table, .. } = *page;
    // The time of a maximum is drawn only if nothing else is requested.
    let timeless = |of: &&Statistic| **of != Statistic::TimeOfMax || spec.statistics.len() == 1;
    let drawn: Vec<Statistic> = spec.statistics.iter().filter(timeless).copied().collect();
    let shown = |column: &Column, statistic: Statistic| {
        table.column(&format!("{}.{}", column.name, statistic.name()))
    };
    let all: Vec<Shown<'_>> = columns
        .iter()
        .flat_map(|column| drawn.iter().map(move |statistic| (column, *statistic)))
        .filter_map(|(column, statistic)| {
            Some(Shown { column, statistic, place: shown(column, statistic)? })
        })
        .collect();
    let axes = Coordinates::of_varying(spec, table);
    let mut figures = match &axes[..] {
        _ if all.is_empty() => Vec::new(),
        [] => Vec::new(),
        [axis] if spec.sample.is_none() => all
            .chunk_by(|one, other| one.column == other.column)
            .filter_map(|of_column| curves(table, axis, of_column))
            .collect(),
        [one, other] if spec.sample.is_none() => {
            let few = |axis: &Coordinates| !axis.is_numeric || axis.names.len() <= FAMILY;
            let (x, by) = match (few(one), few(other)) {
                (true, false) => (other, one),
                (true, true) if other.is_numeric && one.names.len() < other.names.len() => {
                    (other, one)
                }
                (true, true) if !one.is_numeric => (other, one),
                _ => (one, other),
            };
            let draw = |shown: &Shown<'_>| match few(by) {
                true => family(table, x, by, shown),
                false => Some(map(table, x, by, shown)),
            };
            all.iter().filter_map(draw).collect()
        }
        many => {
            let pairs = all.iter().flat_map(|shown| many.iter().map(move |axis| (shown, axis)));
            pairs.filter_map(|(shown, axis)| points(table, axis, shown)).collect()
        }
    };
    if figures.is_empty() {
        return;
    }
    let left_out = figures.len().saturating_sub(MAX_FIGURES);
    figures.truncate(MAX_FIGURES);
    let wide = figures.len() == 1;
    let _ = writeln!(text, "<h2>Figures</h2>\n<div class=\"{}\">", if wide { "" } else { "grid" });
    for figure in figures {
        let _ = write!(text, "<figure>\n<figcaption><strong>{}</strong>", escape(&figure.title));
        for (row, name) in figure.keys.iter().enumerate() {
            // The page's colours are those of the drawings, in their order.
            let colour = match row % COLOURS.len() {
                0 => String::new(),
                row => format!("-{}", row + 1),
            };
            let _ = write!(
                text,
                "<span class=\"key\"><i style=\"background:var(--accent{colour})\"></i>{}</span>",
                escape(name)
            );
        }
        let drawing = (figure.draw)(if wide { WIDE } else { HALF });
        let _ = writeln!(text, "</figcaption>\n{drawing}</figure>");
    }
    text.push_str("</div>\n");
    if left_out > 0 {
        let _ = writeln!(text, "<p>{left_out} more figures are in the table and not drawn.</p>");
    }
}

/// A drawing of any size, and its title.
struct Figure<'f> {
    title: String,
    keys: Vec<String>,
    draw: Box<dyn Fn((f64, f64)) -> String + 'f>,
}

/// All figures of a column over one axis.
fn curves<'f>(table: &Table, axis: &'f Coordinates, shown: &[Shown<'_>]) -> Option<Figure<'f>> {
    let first = shown.first()?;
    let series: Vec<Series> = shown
        .iter()
        .map(|one| Series {
            name: one.statistic.name().to_owned(),
            points: axis.sorted(table.rows.iter().map(|row| (row, one.value(table, row)))),
        })
        .collect();
    let label =
        if shown.len() > 1 { with_unit(&first.column.name, first.unit()) } else { first.label() };
    let title = if shown.len() > 1 { first.column.name.clone() } else { first.title() };
    drawing(axis, series, label, title, axis.is_numeric)
}

/// A figure over one axis, a curve for each value of another.
fn family<'f>(
    table: &Table,
    x: &'f Coordinates,
    by: &Coordinates,
    shown: &Shown<'_>,
) -> Option<Figure<'f>> {
    let of = |(name, words): (&String, &String)| {
        let rows = table.rows.iter().filter(|row| by.cell(row) == name);
        let points = x.sorted(rows.map(|row| (row, shown.value(table, row))));
        Series { name: format!("{} = {words}", by.short), points }
    };
    let series = by.names.iter().zip(&by.words).map(of).collect();
    drawing(x, series, shown.label(), shown.title(), x.is_numeric)
}

/// A figure of every case over one of its axes.
fn points<'f>(table: &Table, axis: &'f Coordinates, shown: &Shown<'_>) -> Option<Figure<'f>> {
    let points = axis.sorted(table.rows.iter().map(|row| (row, shown.value(table, row))));
    let series = vec![Series { name: String::new(), points }];
    drawing(axis, series, shown.label(), shown.title(), false)
}

fn drawing<'f>(
    axis: &'f Coordinates,
    series: Vec<Series>,
    label: String,
    title: String,
    joined: bool,
) -> Option<Figure<'f>> {
    let values = series.iter().flat_map(|one| one.points.iter().filter_map(|(_, value)| *value));
    let y = Scale::of_numbers(values, false, true, label)?;
    let named = series.iter().filter(|one| !one.name.is_empty());
    let keys = match series.len() {
        1 => Vec::new(),
        _ => named.map(|one| one.name.clone()).collect(),
    };
    let x = &axis.scale;
    let draw = move |size| lines::svg(&Drawing { size, x, y: &y, series: &series, joined });
    Some(Figure { title, keys, draw: Box::new(draw) })
}

/// A figure over two axes in colours.
fn map<'f>(table: &Table, x: &Coordinates, y: &Coordinates, shown: &Shown<'_>) -> Figure<'f> {
    let cells = [x.names.len(), y.names.len()];
    let mut values = vec![None; cells[0] * cells[1]];
    for row in &table.rows {
        if let (Some(along), Some(above)) = (x.row(row), y.row(row)) {
            values[above * cells[0] + along] = shown.value(table, row);
        }
    }
    let [x, y] = [x, y].map(|axis| Scale::of_names(axis.words.clone(), axis.scale.label.clone()));
    let title = shown.label();
    let said = title.clone();
    let draw =
        move |size| heat::svg(&Heat { title: &said, size, x: &x, y: &y, cells, values: &values });
    Figure { title, keys: Vec::new(), draw: Box::new(draw) }
}
