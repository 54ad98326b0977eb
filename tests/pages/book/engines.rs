//! What the kernel reaches beside other programs, in the README.
//!
//! `docs/results/{engines,timing,bits}.csv, docs/costs.csv, a short run => table`.

use dbd_tests::page::{block, figure, table};
use dbd_tests::results::{Row, cost, rows};

use crate::book::figures::at_equal_cost;

/// Microseconds per step of the kernel, from nanoseconds.
fn own_time(scene: &str, scheme: &str, precision: &str) -> String {
    let wanted = [("scene", scene), ("scheme", scheme), ("precision", precision)];
    let all = rows("docs/results/timing.csv");
    figure(1e-3 * all.iter().find(|row| row.is(&wanted)).unwrap().number("ns_per_step"), 2)
}

/// Code and model in flash / RAM with stack \[kB\]; a dash for a step that the audit's image lacks.
fn memory(scheme: &str, precision: &str) -> String {
    let counted = cost("four-bar", scheme, precision);
    let bytes = |columns: [&str; 2]| -> Option<f64> {
        columns.iter().map(|column| counted.text(column).parse::<f64>().ok()).sum()
    };
    let kilo = |columns| bytes(columns).map_or("–".into(), |bytes| figure(1e-3 * bytes, 2));
    let flash = kilo(["text_bytes", "rodata_bytes"]);
    format!("{flash} / {} kB", kilo(["plant_ram_bytes", "stack_bytes"]))
}

/// On how many builds and machines how many hashes, or more, were found equal.
fn bits() -> String {
    let builds = rows("docs/results/bits.csv");
    let hashes = builds.iter().map(|row| row.number("hashes"));
    let fewest = hashes.fold(f64::INFINITY, f64::min);
    format!("{fewest} hashes equal on {} builds and machines", builds.len())
}

fn own(name: &str, [scheme, precision]: [&str; 2], off: f64) -> Vec<String> {
    vec![
        format!("**this kernel**, {name}, {precision}"),
        own_time("four-bar", scheme, precision),
        own_time("six-bar", scheme, precision),
        "springs".into(),
        format!("{} m", figure(off, 2)),
        bits(),
        memory(scheme, precision),
    ]
}

/// Another program's row; what was not measured is a dash.
fn other(row: &Row) -> Vec<String> {
    let version = row.text("version");
    let program = format!("{} {version}", row.text("program"));
    let dash = || "–".to_owned();
    let remark = Some(row.text("remark")).filter(|text| !text.is_empty() && *text != CLEVER);
    vec![
        format!("{}, {}, {}", program.trim(), row.text("method"), row.text("precision")),
        row.text("four_bar_us").into(),
        row.text("six_bar_us").into(),
        row.text("joints").into(),
        remark.map_or_else(dash, Into::into),
        dash(),
        dash(),
    ]
}

/// A remark on what it is, not on how well it does.
const CLEVER: &str = "the method without cleverness";

#[test]
fn the_readme_says_what_was_measured() {
    let [single, double, fourth] = at_equal_cost();
    let mut lines = vec![
        own("leapfrog", ["leapfrog", "f32"], single),
        own("leapfrog", ["leapfrog", "f64"], double),
        own("pefrl (four evaluations)", ["pefrl", "f64"], fourth),
    ];
    lines.extend(rows("docs/results/engines.csv").iter().map(other));
    let head = ["", "four-bar [µs/step]", "six-bar [µs/step]", "joints", "off", "bits", "memory"];
    block("README.md", "reach", &table(&head, &lines));
    // A version that nobody wrote down would be a figure of nothing.
    for row in rows("docs/results/engines.csv") {
        let named = !row.text("version").is_empty();
        assert!(named || row.text("program").contains('C'), "{row:?}");
    }
}
