//! Charts of ladders like those measured, from orders, floors and limits. `DBD_DRAW=folder` leaves
//! them and a page there to look at.

use super::*;
use crate::time::rounded;
use crate::trade::point::tests::point;

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
    for orientation in ["quaternion", "euler-321", "euler-321-single"] {
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
        real_time_instructions: 168e6 / 1.5,
        conditions: &[],
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
        if let Ok(folder) = std::env::var("DBD_DRAW") {
            std::fs::write(format!("{folder}/{machine:?}.svg"), &drawing).unwrap();
        }
        let real_time = if machine == Machine::Host { 1.0 } else { chart.real_time_instructions };
        for point in points.iter().filter(|point| point.cost(machine).is_some()) {
            let title = format!("<title>{}</title>", escape(&hover(point, machine, real_time)));
            assert_eq!(drawing.matches(&title).count(), 1, "{title}");
        }
        assert!(drawing.contains("paper&apos;s") || drawing.contains("paper's scheme (dbd f64)"));
        assert!(!drawing.contains("NaN") && !drawing.contains("inf"));
        assert!(!drawing.contains("<&>"));
        assert_eq!(drawing, svg(&chart, machine));
        // Nothing lies outside of the drawing.
        for (name, most) in [("x", WIDTH), ("cx", WIDTH), ("y", HEIGHT), ("cy", HEIGHT)] {
            for value in attributes(&drawing, name) {
                let value: f64 = value.parse().unwrap();
                assert!((0.0..=most).contains(&value), "{name} {value}");
            }
        }
    }
}

/// Shares of the front's points that are named; those named must hold all choices for powers of ten.
fn share_named(points: &[Point], drawing: &str, machine: Machine) -> f64 {
    let front = front(points, machine);
    let named = |row: &&usize| {
        let point = &points[**row];
        let step = display(rounded(point.step, 3));
        drawing.contains(&format!(">{} · {step}<", point.stepper.label()))
    };
    for exponent in -9..=-4 {
        let target = 10_f64.powi(exponent);
        let Some(row) = front.iter().find(|row| points[**row].error.unwrap() <= target) else {
            continue;
        };
        assert!(named(&row), "1e{exponent}: {:?}", points[*row]);
    }
    front.iter().filter(named).count() as f64 / front.len() as f64
}

#[test]
fn the_front_is_named_with_its_steps() {
    let few = ladders();
    let drawing = svg(&chart(&few), Machine::Host);
    assert!(share_named(&few, &drawing, Machine::Host) > 0.66);
    let many = crowd();
    for machine in [Machine::Host, Machine::Target] {
        let drawing = svg(&chart(&many), machine);
        if let Ok(folder) = std::env::var("DBD_DRAW") {
            std::fs::write(format!("{folder}/Crowd{machine:?}.svg"), &drawing).unwrap();
        }
        assert!(share_named(&many, &drawing, machine) > 0.66);
        assert_eq!(drawing.matches(">paper's scheme (dbd f64)<").count(), 1);
    }
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
    points.clear();
    assert!(svg(&chart(&points), Machine::Host).contains("No point"));
}
