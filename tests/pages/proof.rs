//! What the developer's commands proved, from the files that they wrote.

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, rows};

const FILE: &str = "docs/results/proof.csv";

fn of(proof: &str) -> Vec<Row> {
    let rows: Vec<_> = rows(FILE).into_iter().filter(|row| row.is(&[("proof", proof)])).collect();
    assert!(!rows.is_empty(), "{FILE} holds no {proof}");
    rows
}

#[test]
fn no_root_is_wrong() {
    let mut lines = Vec::new();
    for row in of("square root") {
        assert!(row.is(&[("figure", "wrong"), ("value", "0")]), "{row:?}");
        let all = row.is(&[("precision", "f32")]);
        assert!(
            row.number("inputs")
                == if all { 4_294_967_296.0 } else { row.number("inputs").max(1e8) }
        );
        let texts = ["of", "precision"].map(|column| row.text(column).to_owned());
        let counts = ["inputs", "value"].map(|column| grouped(row.text(column)));
        lines.push(texts.into_iter().chain(counts).collect());
    }
    assert_eq!(lines.len(), 4);
    block("docs/proof.md", "roots", &table(&["root", "precision", "inputs", "wrong"], &lines));
}

#[test]
fn all_arctangents_in_single_precision() {
    let mut lines: Vec<Vec<String>> = Vec::new();
    for pair in of("arctangent").chunks(2) {
        let [rad, ulp] = pair else { panic!("{pair:?}") };
        assert!(rad.is(&[("figure", "rad")]) && ulp.is(&[("figure", "ulp")]), "{pair:?}");
        let bound = if rad.is(&[("precision", "f32")]) { 4.8e-7 } else { 8.9e-16 };
        assert!(rad.number("value") < bound && ulp.number("value") < 4.0, "{pair:?}");
        lines.push(vec![
            rad.text("of").to_owned(),
            rad.text("precision").to_owned(),
            grouped(rad.text("inputs")),
            format!("{:.1e}", rad.number("value")),
            figure(ulp.number("value"), 3),
        ]);
    }
    let head = ["angle", "precision", "inputs", "error [rad]", "error [ulp]"];
    block("docs/proof.md", "all arctangents", &table(&head, &lines));
}

#[test]
fn golden_bits_are_the_same_everywhere() {
    let mut lines = Vec::new();
    for row in rows("docs/results/bits.csv") {
        assert!(row.number("hashes") > 0.0 && row.number("tests") > 0.0, "{row:?}");
        let columns = ["build", "byte_order", "optimisation", "hashes", "tests", "relayed"];
        lines.push(columns.map(|column| row.text(column).to_owned()).to_vec());
    }
    let orders = ["little", "big"].map(|order| lines.iter().any(|line| line[1] == order));
    assert_eq!(orders, [true; 2]);
    let head = ["build", "byte order", "optimisation", "equal hashes", "tests", "runs in halves"];
    block("docs/proof.md", "bits", &table(&head, &lines));
}

#[test]
fn guards_cost_little_beside_their_step() {
    let mut lines = Vec::new();
    for row in rows("docs/results/guards.csv") {
        let [step, every] = ["step", "every_step"].map(|column| row.number(column));
        assert!(every < 0.05 * step, "{row:?}");
        let name = ["scene", "scheme", "precision"].map(|column| row.text(column));
        let counts = ["step", "every_step", "look_mean", "look_most", "look_at_energy"];
        let counts = counts.map(|column| grouped(row.text(column)));
        lines.push([name.join(" ")].into_iter().chain(counts).collect());
    }
    let head = [
        "instructions on a Cortex-M4F",
        "a step",
        "its guards",
        "a check by the monitor, mean",
        "most",
        "and at the energy",
    ];
    block("docs/extremes.md", "guards", &table(&head, &lines));
}
