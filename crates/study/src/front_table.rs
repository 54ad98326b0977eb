//! The Pareto front as a table.
//!
//! `(points, machine) => headings, rows, text`.

use dbd_plant::digits::significant;
use dbd_plant::time::rounded;

use crate::need::{Need, paper_need};
use crate::point::{Machine, Point, front, is_paper};
use crate::words::{shown, times};

/// Headings of the front's table, their units beneath.
#[must_use]
pub fn headings(machine: Machine) -> [[&'static str; 2]; 6] {
    let cost = match machine {
        Machine::Host => ["cost", "core s/s"],
        Machine::Target => ["cost", "10⁶ instr/s"],
    };
    [
        ["error", "m"],
        ["stepper", ""],
        ["step", ""],
        cost,
        ["paper's scheme", "times this"],
        ["energy rms", "J"],
    ]
}

/// The front's rows: cells beneath [`headings`], the cheapest first.
#[must_use]
pub fn rows(points: &[Point], machine: Machine) -> Vec<(usize, [String; 6])> {
    front(points, machine)
        .into_iter()
        .filter_map(|row| {
            let point = &points[row];
            let (cost, error) = point.kept(machine)?;
            let unit = if machine == Machine::Host { 1.0 } else { 1e-6 };
            let paper = match paper_need(points, machine, error).map(|paper| paper.need) {
                _ if is_paper(&point.stepper, machine) => "itself".into(),
                None | Some(Need::Uncounted | Need::Unstable) => "–".into(),
                Some(Need::MoreThan { cost: needed }) => format!("> {} *", times(needed / cost)),
                Some(Need::Never) => "never".into(),
                Some(Need::Largest { cost: needed, .. }) => format!("≤ {}", times(needed / cost)),
                Some(Need::Between { cost: needed }) => times(needed / cost),
                Some(Need::Beyond { cost: needed, .. }) => format!("{} *", times(needed / cost)),
            };
            let cells = [
                format!("{error:.1e}"),
                point.stepper.label(),
                shown(point.step),
                significant(rounded(cost * unit, 3), 3),
                paper,
                point.energy_rms.map_or("–".into(), |energy| format!("{energy:.1e}")),
            ];
            Some((row, cells))
        })
        .collect()
}

/// The front for the terminal.
#[must_use]
pub fn table(points: &[Point], machine: Machine) -> String {
    let rows = rows(points, machine);
    if rows.is_empty() {
        return String::new();
    }
    let headings = headings(machine);
    let cells = |line: usize| headings.map(|heading| heading[line].to_owned());
    let lines: Vec<[String; 6]> =
        [cells(0), cells(1)].into_iter().chain(rows.into_iter().map(|(_, cells)| cells)).collect();
    let width = |column: usize| lines.iter().map(|row| row[column].chars().count()).max();
    let widths: [usize; 6] = std::array::from_fn(|column| width(column).unwrap_or(0));
    let mut text = String::new();
    for row in &lines {
        let padded: Vec<String> = row
            .iter()
            .zip(widths)
            .enumerate()
            .map(|(column, (cell, width))| match column {
                1 => format!("{cell:<width$}"),
                _ => format!("{cell:>width$}"),
            })
            .collect();
        text += padded.join("  ").trim_end();
        text.push('\n');
    }
    if lines.iter().any(|row| row[4].ends_with('*')) {
        text += "* extrapolated from its last two steps\n";
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advice::remark;
    use crate::advice::tests::{ladder, sentences};

    #[test]
    fn the_table_is_the_front() {
        let mut points = ladder();
        let text = table(&points, Machine::Target);
        let steppers: Vec<&str> = text.lines().filter(|line| line.contains("f64")).collect();
        assert_eq!(steppers.len(), front(&points, Machine::Target).len());
        assert!(steppers[0].contains("dbd f64") && steppers[0].contains("itself"), "{text}");
        assert!(text.contains('*') && text.ends_with("last two steps\n"), "{text}");
        for point in &mut points {
            point.target_instructions = None;
        }
        assert_eq!(table(&points, Machine::Target), "");
        assert!(sentences(&points, Machine::Target, 0.0).is_empty());
        assert_eq!(remark(&points, Machine::Target), Some("no point has a cost"));
    }
}
