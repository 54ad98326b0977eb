//! Charts of synthetic ladders from orders, floors and limits. `DBD_DRAW=folder` writes them and a page there.

use dbd_report::output::dark::unpaired;
use dbd_report::output::markup::escape;

use crate::advice::choice;
use crate::chart::drawing::*;
use crate::chart::layout::{NARROW, WIDE};
use crate::command::Command;
use crate::point::tests::point;
use crate::point::{Machine, Point};
use crate::words::shown;

/// Order, error at 1 ms \[m\], evaluations per step, largest stable step \[s\] of a scheme.
const SCHEMES: [(&str, i32, f64, f64, f64); 8] = [
    ("dbd", 1, 2e-2, 3.0, 1.6e-4),
    ("dbd-p1", 1, 3e-2, 2.0, 6.4e-4),
    ("semi-implicit-euler", 1, 1e-2, 1.0, 6.4e-4),
    ("leapfrog", 2, 1e-3, 1.0, 6.4e-4),
    ("pefrl", 4, 4e-4, 4.0, 1.3e-3),
    ("blanes-moan-s6", 4, 1e-4, 6.0, 1.3e-3),
    ("rk4", 4, 2e-3, 4.0, 6.4e-4),
    ("linearly-implicit-euler", 1, 2e-2, 15.0, 1e-2),
];

/// The ladder of a scheme: its row of `SCHEMES`, Newton iterations, precision, orientation.
fn ladder(
    row: usize,
    newton: Option<u32>,
    precision: &str,
    orientation: &str,
) -> impl Iterator<Item = Point> {
    let (scheme, order, error, evaluations, limit) = SCHEMES[row];
    (0..8).map(move |rung| {
        let step = 1.28e-3 / 2_f64.powi(rung);
        let single = precision == "f32";
        let evaluations = evaluations + f64::from(newton.unwrap_or(0));
        let slow = if orientation == "quaternion" { 1.0 } else { 1.6 };
        let cost = 1e-6 * evaluations / step * slow * if single { 0.8 } else { 1.0 };
        let floor = if single { 3e-8 / step.sqrt() * 3e-2 } else { 1e-12 };
        let sum = error * (step / 1e-3).powi(order) + floor;
        let mut point = point(scheme, step, cost, (step <= limit).then_some(sum));
        point.stepper.newton = newton;
        point.stepper.precision = precision.into();
        point.stepper.orientation = orientation.into();
        point.stepper.kernel = scheme != "linearly-implicit-euler";
        point.energy_rms = Some(sum * 3.0);
        point.target_instructions =
            point.stepper.kernel.then_some(cost * if single { 3e8 } else { 6e9 });
        point
    })
}

/// Twelve steppers with eight steps each.
pub(crate) fn ladders() -> Vec<Point> {
    (0..SCHEMES.len())
        .flat_map(|row| ladder(row, None, "f64", "quaternion"))
        .chain(ladder(0, Some(1), "f64", "quaternion"))
        .chain(ladder(3, None, "f32", "quaternion"))
        .chain(ladder(4, None, "f32", "quaternion"))
        .chain(ladder(3, None, "f64", "euler-321"))
        .collect()
}

/// All schemes in all precisions and orientations.
fn crowd() -> Vec<Point> {
    let mut points = Vec::new();
    for orientation in ["quaternion", "euler-321"] {
        for precision in ["f64", "f32"] {
            for row in 0..SCHEMES.len() - 1 {
                points.extend(ladder(row, None, precision, orientation));
            }
            points.extend(ladder(0, Some(1), precision, orientation));
        }
    }
    points.extend(ladder(SCHEMES.len() - 1, None, "f64", "quaternion"));
    points
}

/// Their chart.
pub(crate) fn chart(points: &[Point]) -> Chart<'_> {
    Chart {
        scene: "crank <&> slider",
        description: "A made-up scene.",
        window: 2.0,
        uncertainty: 2e-10,
        points,
        command: Command::default(),
        real_time_instructions: 168e6 / 1.5,
        conditions: &[],
        variants: &[],
    }
}

/// Values of an attribute.
fn attributes<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let start = format!(" {name}=\"");
    text.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_point_is_drawn_once_with_its_numbers() {
    let points = ladders();
    let chart = chart(&points);
    for machine in [Machine::Host, Machine::Target] {
        let drawing = svg(&chart, machine);
        let real_time = if machine == Machine::Host { 1.0 } else { chart.real_time_instructions };
        for point in points.iter().filter(|point| point.cost(machine).is_some()) {
            let title = format!("<title>{}</title>", escape(&hover(point, machine, real_time)));
            assert_eq!(drawing.matches(&title).count(), 1, "{title}");
        }
        assert!(drawing.contains("paper&apos;s") || drawing.contains("paper's scheme (dbd f64)"));
        assert!(!drawing.contains("NaN") && !drawing.contains("inf"));
        assert!(!drawing.contains("<&>"));
        assert_eq!(drawing, svg(&chart, machine));
        // Nothing lies outside of the drawing, nothing stays light in the dark.
        let narrow = narrow_svg(&chart, machine);
        for (drawing, of) in [(&drawing, &WIDE), (&narrow, &NARROW)] {
            let mosts = [("x", of.width), ("cx", of.width), ("y", of.height), ("cy", of.height)];
            for (name, most) in mosts {
                for value in attributes(drawing, name) {
                    let value: f64 = value.parse().unwrap();
                    assert!((0.0..=most).contains(&value), "{name} {value}");
                }
            }
            assert_eq!(unpaired(drawing), [""; 0]);
        }
        assert_eq!(narrow.matches("<title>").count(), drawing.matches("<title>").count());
    }
}

/// A scene with many methods has a legend of many lines: the drawing grows with it.
#[test]
fn a_long_legend_has_room() {
    let mut points = ladders();
    let first = points[0].clone();
    for way in 0..40 {
        let mut point = first.clone();
        point.stepper.scheme = format!("another scheme {way}");
        points.push(point);
    }
    let chart = chart(&points);
    for (drawing, least) in [
        (svg(&chart, Machine::Host), WIDE.height),
        (narrow_svg(&chart, Machine::Host), NARROW.height),
    ] {
        let height: f64 = attributes(&drawing, "height")[0].parse().unwrap();
        let lowest = attributes(&drawing, "y").into_iter().map(|y| y.parse::<f64>().unwrap());
        let lowest = lowest.fold(0.0, f64::max);
        assert!(height > least && lowest + 8.0 < height, "{lowest} {height}");
    }
}

/// For each power of ten that the kernel reaches: its line is labelled, its choice named and numbered.
fn choices_are_named(points: &[Point], drawing: &str, machine: Machine) {
    for exponent in -9..=-4 {
        let accuracy = 10_f64.powi(exponent);
        let Some(row) = choice(points, machine, accuracy, true) else { continue };
        let name = format!("{} · {}", points[row].stepper.label(), shown(points[row].step));
        assert!(drawing.contains(&format!(">{name}<")), "1e{exponent}: {name}");
        assert!(drawing.contains(&format!(">1e{exponent}<")), "1e{exponent} has no label");
    }
    // Each number is at its mark and at least once in the panel.
    for number in 1..=4 {
        assert!(drawing.matches(&format!(">{number}</text>")).count() >= 2, "{number}");
    }
}

#[test]
fn what_to_choose_is_named_for_each_power_of_ten() {
    for (name, points) in [("Few", ladders()), ("Crowd", crowd())] {
        for machine in [Machine::Host, Machine::Target] {
            let drawing = svg(&chart(&points), machine);
            if let Ok(folder) = std::env::var("DBD_DRAW") {
                std::fs::write(format!("{folder}/{name}{machine:?}.svg"), &drawing).unwrap();
            }
            choices_are_named(&points, &drawing, machine);
            assert_eq!(drawing.matches(">paper's scheme (dbd f64)<").count(), 1);
        }
    }
}

#[test]
fn the_papers_line_is_there_where_double_precision_was_not_counted() {
    let mut points = crowd();
    for point in points.iter_mut().filter(|point| point.stepper.precision == "f64") {
        point.target_instructions = None;
    }
    let drawing = svg(&chart(&points), Machine::Target);
    assert!(drawing.contains(">paper's scheme (dbd f32)<"));
    assert!(!drawing.contains(">paper's scheme (dbd f64)<"));
    assert!(drawing.contains("stroke-width=\"5\" stroke-dasharray=\"7 4\""));
}

#[test]
fn odd_points_make_no_odd_drawing() {
    let mut points = vec![
        point("dbd", 1e-3, f64::NAN, Some(1e-3)),
        point("dbd", 1e-4, 0.0, Some(1e-3)),
        point("dbd", 1e-5, 1.0, Some(0.0)),
        point("dbd", 1e-6, 2.0, Some(f64::INFINITY)),
    ];
    let drawing = svg(&chart(&points), Machine::Host);
    assert!(!drawing.contains("NaN") && !drawing.contains("inf"), "{drawing}");
    points.iter_mut().for_each(|point| (point.error, point.host_seconds_least) = (Some(0.0), 1.0));
    assert!(svg(&chart(&points), Machine::Host).contains("Nothing to draw: every error is zero."));
    points.clear();
    assert!(svg(&chart(&points), Machine::Host).contains("no point has a cost"));
}
