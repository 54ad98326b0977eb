//! Section 4.2: the largest step over the frequency.

use std::f64::consts::TAU;

use dbd_kernel::State;
use dbd_scene::Scene;

use crate::paper::context::{Context, PaperError, dbd};
use crate::paper::finding::{Curve, Finding, Plot, Row, Tolerance, assumptions};
use crate::paper::spectrum;
use crate::stability::Vibration;

/// Mechanisms of Fig. 18; the first alone follows 1/(2πf) there.
const MECHANISMS: [&str; 6] = ["four-bar", "five-bar-a", "five-bar-b", "six-bar", "3rrr", "3ruu"];

/// \[N/m\] of the joints' springs.
const STIFFNESSES: [f64; 5] = [2e5, 2e6, 2e7, 2e8, 1e9];

/// Factors of the first body's mass.
const MASSES: [f64; 3] = [1.0, 6.0, 40.0];

/// The paper's average errors, 1.53 % and 5.44 %, and as much for the search.
const TOLERANCE: Tolerance = Tolerance { within: 0.08, factor: 2.2 };

/// A point of Fig. 18.
struct Point {
    /// \[Hz\] highest of the pose.
    highest: f64,
    /// \[s\] with 0 and 1 Newton iterations.
    largest: [f64; 2],
}

fn point(scene: &Scene) -> Result<Option<Point>, PaperError> {
    let Some(vibration) = Vibration::about(&scene.model, &State::initial(&scene.model)) else {
        return Ok(None);
    };
    let mut largest = [0.0; 2];
    for (newton, largest) in (0..).zip(&mut largest) {
        *largest = vibration.first_range(&dbd(newton)?)?.largest_step;
    }
    Ok(Some(Point { highest: vibration.frequency / TAU, largest }))
}

/// The scene with joints of a stiffness and a first body heavier by a factor.
fn changed(scene: &Scene, stiffness: f64, mass: f64) -> Result<Scene, PaperError> {
    let mut scene = scene.with(&format!("joint.*.stiffness={stiffness:e}"))?;
    let body = &mut scene.model.bodies[0];
    let inertia = body.inertia.to_f64().map(|inertia| inertia * mass);
    *body = dbd_kernel::Body::from_f64(body.mass * mass, inertia);
    Ok(scene)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    values.iter().sum::<f64>() / values.len() as f64
}

/// Fig. 18, all mechanisms, stiffnesses and masses.
pub(super) fn largest(context: &Context<'_>) -> Result<Finding, PaperError> {
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    let mut all = Vec::new();
    for name in MECHANISMS {
        let shipped = context.scene(name)?;
        let mut points = Vec::new();
        for stiffness in STIFFNESSES {
            for mass in MASSES {
                points.extend(point(&changed(&shipped, stiffness, mass)?)?);
            }
        }
        let product = |newton: usize| mean(points.iter().map(|p| p.largest[newton] * p.highest));
        let once = TAU * product(1);
        let relation = if name == "four-bar" { 1.0 } else { TAU.recip() };
        rows.push(
            Row::compared(
                format!("{name}: largest step · 2πf, one Newton iteration"),
                "",
                relation,
                once,
                TOLERANCE,
            )
            .noted(if name == "four-bar" {
                "f the highest frequency"
            } else {
                "f the highest frequency; the paper's step is 2π times as small"
            }),
        );
        rows.push(Row::extra(
            format!("{name}: largest step · 2πf, no iteration"),
            "",
            TAU * product(0),
        ));
        for newton in [0, 1] {
            curves.push(Curve {
                name: format!("{name}, N = {newton}"),
                paper: false,
                line: false,
                points: points.iter().map(|p| [p.highest, p.largest[newton]]).collect(),
            });
        }
        let joint = shipped.joints.len() / 2;
        let dominant = spectrum::of(&shipped, joint, spectrum::Sampling::PAPER)?.dominant();
        if let Some(at) = point(&shipped)?.filter(|_| dominant > 0.0) {
            rows.push(Row::open(
                format!("{name}: largest step · (2π)²f, one iteration, f dominant"),
                "",
                Some(if name == "four-bar" { TAU } else { 1.0 }),
                Some(at.largest[1] * TAU * TAU * dominant),
                "which frequency dominates depends on which springs are changed, which the text does not say",
            ));
        }
        all.extend(points);
    }
    let spread = |newton: usize| {
        let z: Vec<f64> = all.iter().map(|p| TAU * p.highest * p.largest[newton]).collect();
        let (low, high) =
            z.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), z| (low.min(*z), high.max(*z)));
        high / low - 1.0
    };
    rows.push(Row::claim(
        "One relation of the form h = c/f holds for every mechanism, stiffness and mass",
        spread(0) < 0.1 && spread(1) < 0.1,
        format!(
            "c varies by {:.1} % without and {:.1} % with an iteration over {} systems",
            100.0 * spread(0),
            100.0 * spread(1),
            all.len()
        ),
    ));
    let [low, high] = [100.0, 40_000.0];
    for (name, factor) in [("paper: 1/(2πf)", TAU), ("paper: 1/((2π)²f)", TAU * TAU)] {
        let points = [low, high].map(|f| [f, 1.0 / (factor * f)]).into();
        curves.push(Curve { name: name.into(), paper: true, line: true, points });
    }
    let plots = vec![Plot {
        name: String::new(),
        title: "Largest stable step over the highest frequency".into(),
        axes: ["frequency [Hz]".into(), "largest step [s]".into()],
        logarithmic: [true, true],
        curves,
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&[
            "Stability about the pose at t = 0, frozen, over at least 600 steps; stiffnesses 0.2 to 1000 MN/m, the first body's mass and inertia 1, 6 and 40 times what they are.",
            "The paper does not say how many Newton iterations its convergence takes: none and one are both measured.",
        ]),
        rows,
        plots,
        ..Finding::default()
    })
}

/// Two points of it, as the scenes ship.
pub(super) fn shipped(context: &Context<'_>) -> Result<Finding, PaperError> {
    let mut rows = Vec::new();
    for (name, relation) in [("four-bar", 1.0), ("3rrr", TAU.recip())] {
        let Some(point) = point(&context.scene(name)?)? else { continue };
        rows.push(Row::compared(
            format!("{name}: largest step · 2πf, one Newton iteration"),
            "",
            relation,
            TAU * point.highest * point.largest[1],
            TOLERANCE,
        ));
        rows.push(Row::extra(
            format!("{name}: largest step · 2πf, no iteration"),
            "",
            TAU * point.highest * point.largest[0],
        ));
    }
    Ok(Finding {
        assumptions: assumptions(&[
            "f is the highest frequency of the pose at t = 0. All mechanisms: fig-18.",
        ]),
        rows,
        ..Finding::default()
    })
}
