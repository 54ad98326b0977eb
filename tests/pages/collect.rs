//! From surveys to `docs/results`: with `DBD_COLLECT=OUT` in the environment the rows of every scene
//! whose survey lies in `OUT/SCENE/trade.csv` are written anew, the others stay.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::sync::Once;

use dbd_study::advice::choice;
use dbd_study::need::{Need, paper_need};
use dbd_study::point::{Fall, Machine, Point, Stepper, is_paper};
use dbd_tests::results::{Row, path, rows, rows_of};

use crate::ACCURACIES;

/// Collects once, where asked to.
pub fn collect() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let Some(out) = std::env::var_os("DBD_COLLECT") else { return };
        let surveyed = |name: &str| {
            let file = path(&out.to_string_lossy()).join(name).join("trade.csv");
            fs::read_to_string(file).ok().map(|text| points(&text))
        };
        renew("docs/results/trade.csv", |name| Some(choices(name, &surveyed(name)?)));
        renew("docs/results/timing.csv", |name| Some(times(name, &surveyed(name)?)));
        renew("docs/results/precisions-on-chip.csv", |name| {
            Some(by_precision(name, &surveyed(name)?))
        });
    });
}

/// Writes a table with new rows for each scene that has some.
fn renew(file: &str, new: impl Fn(&str) -> Option<String>) {
    let path = path(file);
    let text = fs::read_to_string(&path).unwrap();
    let written = renewed(&text, new);
    fs::write(&path, written).unwrap();
}

/// A table with new rows, where the scene's first row was, for each scene that has some.
fn renewed(text: &str, new: impl Fn(&str) -> Option<String>) -> String {
    let head = text.lines().filter(|line| line.starts_with('#')).count() + 1;
    let (mut written, mut done) = (String::new(), Vec::new());
    for (i, line) in text.lines().enumerate() {
        let name = line.split(',').next().unwrap_or_default();
        let rows = if i < head { None } else { new(name) };
        match rows {
            None => written += &format!("{line}\n"),
            Some(_) if done.contains(&name) => {}
            Some(rows) => {
                written += &rows;
                done.push(name);
            }
        }
    }
    written
}

/// The points of a survey's table.
fn points(text: &str) -> Vec<Point> {
    let point = |row: &Row| {
        let text = |column| Some(row.text(column)).filter(|text| !text.is_empty());
        let number = |column| text(column).map(|text| text.parse().unwrap());
        Point {
            stepper: Stepper {
                scheme: row.text("scheme").into(),
                newton: text("newton").map(|newton| newton.parse().unwrap()),
                damping: text("damping").map(Into::into),
                precision: row.text("precision").into(),
                orientation: row.text("orientation").into(),
                kernel: row.text("kernel") == "true",
            },
            step: row.number("step"),
            steps: row.number("steps") as u64,
            stable: row.text("stable") == "true",
            lost: row.text("lost") == "true",
            advisable: row.text("advisable") == "true",
            error: number("error"),
            energy_rms: number("energy_rms"),
            energy_peak: number("energy_peak"),
            evaluations: row.number("evaluations_per_second"),
            host_seconds_least: row.number("host_seconds_least_per_second"),
            host_seconds: row.number("host_seconds_per_second"),
            host_spread: row.number("host_spread"),
            target_instructions: number("target_instructions_per_second"),
            step_in_space: number("stable_step_in_space"),
            fall: Fall::default(),
        }
    };
    rows_of(text).iter().map(point).collect()
}

/// The rows of a scene in `trade.csv`.
fn choices(name: &str, points: &[Point]) -> String {
    let mut text = String::new();
    let window = points.iter().map(|point| point.step * point.steps as f64).fold(0.0, f64::max);
    let window = (window * 1e9).round() / 1e9;
    for (machine, called) in [(Machine::Host, "pc"), (Machine::Target, "cortex-m4f")] {
        let methods = rows("docs/costs.csv").iter().filter(|r| r.text("scene") == name).count();
        // A scene that was counted with one method has nothing to choose from.
        if machine == Machine::Target && methods < 10 {
            continue;
        }
        for accuracy in ACCURACIES {
            let target = accuracy.parse().unwrap();
            let _ = write!(text, "{name},{called},{window},{accuracy},");
            let Some(row) = choice(points, machine, target, true) else {
                text += ",,,never,\n";
                continue;
            };
            let (chosen, paper) = (&points[row], paper_need(points, machine, target));
            let (cost, _) = chosen.kept(machine).unwrap();
            let (ratio, known) = match paper.as_ref().map(|paper| paper.need) {
                _ if is_paper(&chosen.stepper, machine) => (None, "itself"),
                Some(Need::Largest { cost, .. }) => (Some(cost), "at-largest-step"),
                Some(Need::Between { cost }) => (Some(cost), "measured"),
                Some(Need::Beyond { cost, .. }) => (Some(cost), "extrapolated"),
                Some(Need::MoreThan { cost }) => (Some(cost), "beyond"),
                other => panic!("{name} at {accuracy}: {other:?}"),
            };
            let ratio = ratio.map(|paper| two_digits(paper / cost)).unwrap_or_default();
            let precision = paper.map(|paper| paper.precision).unwrap_or_default();
            let stepper = &chosen.stepper;
            let way = stepper.damping.as_ref().map(|damping| format!(" {damping}"));
            let scheme = format!("{}{}", stepper.scheme, way.unwrap_or_default());
            let _ = writeln!(text, "{scheme},{},{ratio},{known},{precision}", stepper.precision);
        }
    }
    text
}

/// The rows of a scene in `precisions-on-chip.csv`: the cheapest way in each precision.
fn by_precision(name: &str, points: &[Point]) -> String {
    let mut text = String::new();
    for accuracy in ACCURACIES {
        for precision in ["f32", "fixed", "f64"] {
            let of = |point: &&Point| point.stepper.precision == precision;
            let own: Vec<Point> = points.iter().filter(of).cloned().collect();
            let Some(row) = choice(&own, Machine::Target, accuracy.parse().unwrap(), true) else {
                continue;
            };
            let (cost, _) = own[row].kept(Machine::Target).unwrap();
            let (scheme, step) = (&own[row].stepper.scheme, own[row].step);
            let _ = writeln!(text, "{name},{accuracy},{precision},{scheme},{step:e},{cost:.3e}");
        }
    }
    text
}

/// A ratio to two digits, as a plain number.
fn two_digits(ratio: f64) -> String {
    format!("{}", format!("{ratio:.1e}").parse::<f64>().unwrap())
}

/// The rows of a scene in `timing.csv`.
fn times(name: &str, points: &[Point]) -> String {
    let mut text = String::new();
    for (scheme, called, precision) in [
        ("leapfrog", "leapfrog", "f64"),
        ("leapfrog", "leapfrog", "f32"),
        ("pefrl", "pefrl", "f64"),
        ("dbd", "dbd", "f64"),
        ("std leapfrog", "std leapfrog", "f64"),
        ("std linearly-implicit-euler", "std linearly implicit Euler", "f64"),
    ] {
        let of = |point: &&Point| {
            let s = &point.stepper;
            let plain = s.newton.unwrap_or(0) == 0 && s.damping.is_none();
            s.scheme == scheme && s.precision == precision && plain && s.orientation == "quaternion"
        };
        // All steps of a method have one time; the first says it.
        let Some(point) = points.iter().find(of) else { continue };
        let ns = (1e9 * point.host_seconds * point.step).round();
        let _ = writeln!(text, "{name},{called},{precision},{ns}");
    }
    text
}

#[test]
fn a_survey_becomes_rows() {
    use dbd_study::files::Report;
    use dbd_study::{TradeOptions, survey};
    use dbd_tests::scene;

    let scene = scene("spring-ball");
    let shipped = Some(scene.clone());
    let options = TradeOptions { window: Some(1e-3), period: None, cache: None, shipped };
    let trade = survey(&scene, &options, &mut |_| ()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let report = Report { scene: &scene, called: "spring-ball", trade: &trade };
    report.write(folder.path()).unwrap();
    let text = fs::read_to_string(Path::new(folder.path()).join("trade.csv")).unwrap();
    let read = points(&text);
    assert_eq!(read.len(), trade.points.len());
    let rows = choices("spring-ball", &read);
    assert_eq!(rows.lines().count(), ACCURACIES.len(), "{rows}");
    assert!(rows.starts_with("spring-ball,pc,0.001,1e-4,"), "{rows}");
    assert!(times("spring-ball", &read).contains("spring-ball,leapfrog,f64,"));
    let old = "# a\nscene,b\nx,1\nspring-ball,2\nspring-ball,3\ny,4\n";
    let new = renewed(old, |name| (name == "spring-ball").then(|| "spring-ball,5\n".into()));
    assert_eq!(new, "# a\nscene,b\nx,1\nspring-ball,5\ny,4\n");
}
