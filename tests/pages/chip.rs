//! What the precisions cost on a chip at equal accuracy, from surveys.

use dbd_tests::page::{block, figure, table};
use dbd_tests::results::{Row, rows};

use crate::collect::collect;

const ACCURACY: &str = "1e-6";

#[test]
fn fixed_point_is_cheapest_where_single_precision_ends() {
    collect();
    let all = rows("docs/results/precisions-on-chip.csv");
    let mut names: Vec<&str> = all.iter().map(|row| row.text("scene")).collect();
    names.dedup();
    let mut lines = Vec::new();
    for name in names {
        let of = |precision: &str| -> Option<&Row> {
            let wanted = [("scene", name), ("accuracy_m", ACCURACY), ("precision", precision)];
            all.iter().find(|row| row.is(&wanted))
        };
        let cost = |row: &Row| row.number("instructions_per_second");
        let [single, fixed, double] = ["f32", "fixed", "f64"].map(of);
        let (fixed, double) = (fixed.unwrap(), double.unwrap());
        assert!(cost(fixed) < cost(double) / 10.0, "{name}");
        let cell = |row: Option<&Row>| {
            row.map_or("–".into(), |row| {
                format!("{}, `{}`", figure(cost(row), 2), row.text("scheme"))
            })
        };
        lines.push(vec![
            name.to_owned(),
            cell(single),
            cell(Some(fixed)),
            cell(Some(double)),
            figure(cost(double) / cost(fixed), 2),
            single.map_or("–".into(), |single| figure(cost(fixed) / cost(single), 2)),
        ]);
    }
    assert!(lines.len() >= 8);
    let head = ["scene", "f32", "fixed", "f64", "f64 over fixed", "fixed over f32"];
    block("docs/trade.md", "precisions on a chip", &table(&head, &lines));
}
