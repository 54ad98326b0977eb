//! The picture of the house: crates from left to right, their modules from the ground up.
//!
//! `Cargo.toml of all crates, module lists => SVG`. A crate stands in a column right of all that it
//! uses; an arrow leads to each crate that no other arrow leads to by a longer way. Within a crate
//! a row is a point of the list in `lib.rs`, the first at the bottom; pointing at a row shows its
//! words.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;

use crate::rules::Floor;

/// A crate: its folder, and the folders of the crates that it uses.
pub type Crates = BTreeMap<String, BTreeSet<String>>;

/// The crates of the workspace that are libraries, tests and tools apart.
pub fn crates(root: &Path) -> Crates {
    let read = |path: &Path| -> toml::Table {
        let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        text.parse().unwrap_or_else(|error| panic!("{path:?}: {error}"))
    };
    let workspace = &read(&root.join("Cargo.toml"))["workspace"];
    let members = workspace["members"].as_array().into_iter().flatten();
    let members: Vec<&str> = members.filter_map(toml::Value::as_str).collect();
    let folder_of = |package: &str| {
        let path = workspace["dependencies"].get(package)?.get("path")?.as_str()?;
        Some(path.to_owned())
    };
    let libraries = members.iter().filter(|name| root.join(name).join("src/lib.rs").exists());
    libraries
        .map(|name| {
            let manifest = read(&root.join(name).join("Cargo.toml"));
            let uses = ["dependencies", "build-dependencies"].into_iter();
            let uses = uses.filter_map(|kind| manifest.get(kind)?.as_table());
            let uses = uses.flat_map(|table| table.keys()).filter_map(|name| folder_of(name));
            ((*name).to_owned(), uses.collect())
        })
        .collect()
}

/// Everything that a crate uses, directly or not.
fn below(crates: &Crates, name: &str) -> BTreeSet<String> {
    let uses = crates.get(name).into_iter().flatten();
    uses.flat_map(|used| below(crates, used).into_iter().chain([used.clone()])).collect()
}

/// The columns of crates: each as near as may be to the first that uses it.
fn columns(crates: &Crates) -> BTreeMap<String, usize> {
    fn depth(crates: &Crates, name: &str) -> usize {
        let uses = crates.get(name).into_iter().flatten();
        uses.map(|used| depth(crates, used) + 1).max().unwrap_or(0)
    }
    let of = |name: &String| {
        let users = crates.iter().filter(|(_, uses)| uses.contains(name));
        let first = users.map(|(user, _)| depth(crates, user)).min();
        (name.clone(), first.map_or_else(|| depth(crates, name), |first| first - 1))
    };
    crates.keys().map(of).collect()
}

const CHIP: f64 = 18.0;
const ROW: f64 = 24.0;
const HEAD: f64 = 26.0;
/// The widest row before it is broken.
const WIDEST: f64 = 290.0;

fn width_of(name: &str) -> f64 {
    6.3 * name.chars().count() as f64 + 12.0
}

/// Names in rows that are not too wide.
fn broken(names: &[String]) -> Vec<Vec<&str>> {
    let mut rows: Vec<Vec<&str>> = vec![Vec::new()];
    let mut width = 0.0;
    for name in names {
        width += width_of(name) + 4.0;
        if width > WIDEST {
            rows.push(Vec::new());
            width = width_of(name);
        }
        let last = rows.len() - 1;
        rows[last].push(name);
    }
    rows
}

/// A crate's box with what stands in it.
struct Panel {
    name: String,
    /// Rows from the top down, each with its words.
    rows: Vec<(Vec<String>, String)>,
    corner: [f64; 2],
    size: [f64; 2],
}

/// The picture of the crates, with the rooms of those that have a list.
pub fn svg(crates: &Crates, floors: &BTreeMap<String, Vec<Floor>>) -> String {
    let columns = columns(crates);
    let mut panels: Vec<Panel> = Vec::new();
    let (mut x, mut height) = (10.0, 0.0_f64);
    for column in 0..=columns.values().copied().max().unwrap_or(0) {
        let (mut y, mut widest) = (10.0, 0.0_f64);
        let first = panels.len();
        for name in columns.iter().filter(|(_, at)| **at == column).map(|(name, _)| name) {
            let mut rows = Vec::new();
            for floor in floors.get(name).into_iter().flatten().rev() {
                for row in broken(&floor.modules).into_iter().rev() {
                    rows.push((row.into_iter().map(Into::into).collect(), floor.words.clone()));
                }
            }
            let wide = |(row, _): &(Vec<String>, String)| {
                row.iter().map(|name| width_of(name) + 4.0).sum::<f64>() + 16.0
            };
            let width = rows.iter().map(wide).fold(width_of(name) + 40.0, f64::max);
            let size = [width, HEAD + ROW * rows.len() as f64 + 6.0];
            panels.push(Panel { name: name.clone(), rows, corner: [x, y], size });
            y += size[1] + 24.0;
            widest = widest.max(width);
        }
        for panel in &mut panels[first..] {
            panel.size[0] = widest;
        }
        height = height.max(y);
        x += widest + 44.0;
    }
    // Every column stands in the middle.
    for column in 0..panels.len() {
        let same: Vec<usize> = (0..panels.len())
            .filter(|i| panels[*i].corner[0] == panels[column].corner[0])
            .collect();
        if same[0] == column {
            let last = &panels[same[same.len() - 1]];
            let free = height - (last.corner[1] + last.size[1] + 24.0);
            for i in same {
                panels[i].corner[1] += free / 2.0;
            }
        }
    }
    draw(crates, &panels, [x - 34.0, height - 14.0])
}

fn draw(crates: &Crates, panels: &[Panel], [width, height]: [f64; 2]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"ui-monospace, Menlo, Consolas, monospace\" font-size=\"10.5\">\n\
         <title>Crates from left to right, each uses those that its arrows lead to; modules from the \
         ground up, each uses those below it</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <defs><marker id=\"a\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" \
         markerHeight=\"7\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" fill=\"#4a6a8a\"/></marker></defs>\n"
    );
    for panel in panels {
        let uses = &crates[&panel.name];
        let longer = |used: &String| uses.iter().any(|other| below(crates, other).contains(used));
        for used in uses.iter().filter(|used| !longer(used)) {
            let Some(to) = panels.iter().find(|panel| panel.name == *used) else { continue };
            let start = [panel.corner[0], panel.corner[1] + panel.size[1] / 2.0];
            let end = [to.corner[0] + to.size[0] + 1.0, to.corner[1] + to.size[1] / 2.0];
            let middle = (start[0] + end[0]) / 2.0;
            let _ = writeln!(
                svg,
                "<path d=\"M{:.0} {:.0}C{middle:.0} {:.0} {middle:.0} {:.0} {:.0} {:.0}\" fill=\"none\" \
                 stroke=\"#4a6a8a\" stroke-width=\"1.4\" marker-end=\"url(#a)\"/>",
                start[0], start[1], start[1], end[1], end[0], end[1]
            );
        }
    }
    for panel in panels {
        let [x, y] = panel.corner;
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"{:.0}\" height=\"{:.0}\" rx=\"5\" fill=\"#f3f6f9\" \
             stroke=\"#4a6a8a\"/>\n\
             <text x=\"{:.0}\" y=\"{:.0}\" font-size=\"13\" font-weight=\"bold\" fill=\"#1d3348\">{}/</text>",
            panel.size[0],
            panel.size[1],
            x + 8.0,
            y + 18.0,
            panel.name
        );
        for (i, (row, words)) in panel.rows.iter().enumerate() {
            let top = y + HEAD + ROW * i as f64;
            let mut left = x + 8.0;
            let words = words.replace('&', "&amp;").replace('<', "&lt;");
            let _ = writeln!(svg, "<g><title>{words}</title>");
            for name in row {
                let width = width_of(name);
                let _ = writeln!(
                    svg,
                    "<rect x=\"{left:.0}\" y=\"{top:.0}\" width=\"{width:.0}\" height=\"{CHIP}\" rx=\"3\" \
                     fill=\"#fff\" stroke=\"#9fb3c8\"/><text x=\"{:.0}\" y=\"{:.0}\" \
                     fill=\"#1d3348\">{name}</text>",
                    left + 6.0,
                    top + 12.8
                );
                left += width + 4.0;
            }
            svg += "</g>\n";
        }
    }
    svg + "</svg>\n"
}
