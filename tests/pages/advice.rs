//! Tables of docs/advise.md.

use dbd_plant::PrecisionName;
use dbd_study::recommend::MCUS;
use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, rows};

#[test]
fn advice_is_as_it_was_held() {
    let mcus: Vec<Vec<String>> = MCUS
        .iter()
        .map(|mcu| {
            let factor = |precision| figure(mcu.factor(precision).expect("a supported one"), 3);
            let clock = format!("{} MHz", mcu.clock * 1e-6);
            let name = format!("`{}`", mcu.name);
            let basis = mcu.basis.to_owned();
            let factors =
                [PrecisionName::F32, PrecisionName::Fixed, PrecisionName::F64].map(factor);
            [vec![name, clock, mcu.cycles.to_string()], factors.to_vec(), vec![basis]].concat()
        })
        .collect();
    let head = [
        "`--mcu`",
        "usual clock",
        "cycles per instruction (estimated)",
        "instructions over Cortex-M4F: f32",
        "fixed",
        "f64",
        "basis",
    ];
    block("docs/advise.md", "microcontrollers", &table(&head, &mcus));

    let all = rows("docs/results/advice.csv");
    let random = |row: &&Row| row.text("scene").starts_with("random ");
    let (random, shipped): (Vec<&Row>, Vec<&Row>) = all.iter().partition(random);
    let number = |row: &Row, column: &str| match row.text(column) {
        "" => "–".to_owned(),
        _ => figure(row.number(column), 2),
    };
    let mut lines: Vec<Vec<String>> = shipped
        .iter()
        .map(|row| {
            let damping = match row.text("damping") {
                "" => String::new(),
                damping => format!(", {damping}"),
            };
            let way = format!("{}{damping}, {}", row.text("scheme"), row.text("precision"));
            vec![
                row.text("scene").to_owned(),
                row.text("model").to_owned(),
                way,
                format!("{} µs", figure(1e6 * row.number("step_s"), 3)),
                number(row, "share_of_stable"),
                row.text("limit").to_owned(),
                number(row, "error_m"),
                number(row, "error_elsewhere_m"),
                figure(100.0 * row.number("load_168mhz"), 2),
                grouped(row.text("steps")),
                row.text("stable").to_owned(),
            ]
        })
        .collect();
    let sum = |what: &dyn Fn(&Row) -> bool| random.iter().filter(|row| what(row)).count();
    let share = |row: &Row| row.text("share_of_stable").parse::<f64>().unwrap_or(0.0);
    let limited: Vec<f64> = random
        .iter()
        .filter(|row| row.text("limit") == "vibration")
        .map(|row| share(row))
        .collect();
    let range = |values: &[f64]| {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        format!("{} to {}", figure(least, 2), figure(most, 2))
    };
    lines.push(vec![
        format!("{} at random", random.len()),
        "any".into(),
        "any".into(),
        "any".into(),
        if limited.is_empty() { "–".into() } else { range(&limited) },
        format!("vibration in {}", limited.len()),
        "any".into(),
        "any".into(),
        "any".into(),
        "any".into(),
        format!(
            "yes in {}; {} of them come apart later",
            sum(&|row| row.text("stable") == "yes"),
            sum(&|row| !row.text("ends_s").is_empty()),
        ),
    ]);
    let head = [
        "scene",
        "model",
        "method",
        "step",
        "of the stable one",
        "limit",
        "error [m]",
        "by a second solver [m]",
        "load at 168 MHz [%]",
        "steps",
        "stable",
    ];
    block("docs/advise.md", "advice", &table(&head, &lines));
}
