//! What rounding does to energies, precision by precision.
//!
//! `docs/results/precisions.csv, docs/costs.csv => blocks of docs/precision.md`, a row per scene and precision.

use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::{Row, rows};

const PAGE: &str = "docs/precision.md";
const SCENES: [&str; 5] = ["hexagon", "four-bar", "3rrr", "3ruu", "double-wishbone"];
const PRECISIONS: [&str; 3] = ["f64", "f32", "fixed"];
const STIFFNESSES: [&str; 3] = ["1e5", "9e6", "5e8"];

/// The runs of the file.
struct Runs(Vec<Row>);

impl Runs {
    fn read() -> Self {
        Self(rows("docs/results/precisions.csv"))
    }

    /// The run of a scene in a precision: scheme, stiffness, whether damped, how far from the origin \[m\].
    fn of(
        &self,
        [scene, scheme, stiffness, precision]: [&str; 4],
        damped: bool,
        from_origin: &str,
    ) -> &Row {
        let wanted = [
            ("scene", scene),
            ("scheme", scheme),
            ("stiffness", stiffness),
            ("precision", precision),
            ("damped", if damped { "true" } else { "false" }),
            ("from_origin_m", from_origin),
        ];
        let found = self.0.iter().find(|row| row.is(&wanted));
        found.unwrap_or_else(|| panic!("docs/results/precisions.csv has no {wanted:?}"))
    }
}

/// Instructions of a step, where they were counted.
fn instructions(scene: &str, precision: &str) -> Option<f64> {
    let wanted = [("scene", scene), ("scheme", "leapfrog"), ("precision", precision)];
    let counted = rows("docs/costs.csv").into_iter().find(|row| row.is(&wanted));
    counted.map(|row| row.number("instructions_mean"))
}

fn shown(count: Option<f64>) -> String {
    count.map_or_else(|| "–".to_owned(), |count| grouped(&format!("{count:.0}")))
}

#[test]
fn rounding_is_as_measured() {
    let runs = Runs::read();
    let mut text = Vec::new();
    for scene in SCENES {
        let run = |precision, damped, place| {
            runs.of([scene, "leapfrog", "9e6", precision], damped, place)
        };
        for precision in PRECISIONS {
            let (here, away) = (run(precision, false, "0"), run(precision, false, "10"));
            let damped = run(precision, true, "0");
            let beside = |value: f64| {
                if precision == "f64" { "–".to_owned() } else { figure(value, 2) }
            };
            text.push(vec![
                format!("`{scene}`"),
                format!("`{precision}`"),
                figure(here.number("own_max_j"), 2),
                figure(here.number("kept_max_j"), 2),
                figure(away.number("kept_max_j"), 2),
                beside(damped.number("apart_max_j")),
                beside(here.number("off_m")),
                shown(instructions(scene, precision)),
            ]);
        }
    }
    let steps = |row: &Row| grouped(row.text("steps"));
    let run = runs.of(["hexagon", "leapfrog", "9e6", "fixed"], false, "0");
    let damped = runs.of(["hexagon", "leapfrog", "9e6", "fixed"], true, "0");
    let over = format!("Over {} steps, damped over {}:\n\n", steps(run), steps(damped));
    let head = [
        "scene",
        "precision",
        "energy swings by [J]",
        "of it rounding [J]",
        "10 m away [J]",
        "damped, from f64 [J]",
        "off [m]",
        "Cortex-M4F [instructions]",
    ];
    block(PAGE, "rounding", &(over + &table(&head, &text)));
}

#[test]
fn long_runs_are_as_measured() {
    let runs = Runs::read();
    let mut text = Vec::new();
    for stiffness in STIFFNESSES {
        for precision in PRECISIONS {
            let run = |precision| {
                runs.of(["hexagon", "semi-implicit-euler", stiffness, precision], false, "0")
            };
            let (own, double) = (run(precision), run("f64"));
            text.push(vec![
                stiffness.to_owned(),
                figure(own.number("step_s") * 1e6, 2),
                format!("`{precision}`"),
                figure(own.number("own_max_j"), 2),
                figure(own.number("own_max_j") / double.number("own_max_j"), 2),
                figure(own.number("kept_max_j"), 2),
                figure(own.number("slope_w"), 2),
                figure(own.number("model_max_j"), 2),
            ]);
        }
    }
    let head = [
        "stiffness [N/m]",
        "step [µs]",
        "precision",
        "energy swings by [J]",
        "of f64's",
        "of it rounding [J]",
        "drift [W]",
        "by the model's constants [J]",
    ];
    let run = runs.of(["hexagon", "semi-implicit-euler", "9e6", "fixed"], false, "0");
    let over = format!("Over {} steps:\n\n", grouped(run.text("steps")));
    block(PAGE, "long runs", &(over + &table(&head, &text)));
}

/// Fixed point has no place where it is finer: far from the origin nothing gets worse. Runs differ as chance does;
/// `tests/dynamics/fixed.rs` has one bit for bit.
#[test]
fn ten_metres_away_fixed_point_is_what_it_is_at_the_origin() {
    let runs = Runs::read();
    for scene in SCENES {
        for stiffness in STIFFNESSES {
            for damped in [false, true] {
                let at = |place, column| {
                    runs.of([scene, "leapfrog", stiffness, "fixed"], damped, place).number(column)
                };
                let [here, away] = ["0", "10"].map(|place| at(place, "own_rms_j"));
                assert!(
                    away < 4.0 * here + 1e-12,
                    "{scene} {stiffness} {damped}: {here:e} {away:e}"
                );
            }
        }
    }
}
