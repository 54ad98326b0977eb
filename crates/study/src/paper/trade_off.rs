//! Section 4.7: the step at which a matrix solver costs as much.

use std::f64::consts::TAU;

use dbd_kernel::State;

use crate::modes::modes;
use crate::paper::context::{Context, PaperError, dbd};
use crate::paper::finding::{Curve, Finding, Plot, Row, assumptions};
use crate::paper::fit::least_squares;
use crate::timing::costs;
use crate::ways::Way;

/// Section 4.7: scene, frequency \[Hz\], the paper's step \[s\].
const STEPS: [(&str, f64, f64); 4] = [
    ("macpherson", 250.0, 0.55e-3),
    ("four-bar", 500.0, 0.13e-3),
    ("five-bar-b", 500.0, 0.13e-3),
    ("six-bar", 500.0, 0.13e-3),
];

/// Fig. 26: bodies, constraints per body.
const SYSTEMS: [[f64; 2]; 4] = [[20.0, 2.0], [20.0, 5.0], [50.0, 2.0], [50.0, 5.0]];

/// Fig. 26.
pub(super) fn equal_cost(context: &Context<'_>) -> Result<Finding, PaperError> {
    let ways = [Way::Kernel(dbd(0)?), Way::LinearlyImplicitEuler];
    let mut rows = Vec::new();
    let (mut plane, mut times) = (Vec::new(), [Vec::new(), Vec::new()]);
    for name in ["four-bar", "six-bar", "3rrr", "3ruu", "two-3ruu"] {
        let scene = context.scene(name)?;
        let found = costs(&scene, &ways, 1e-5, &mut |_, _| ());
        let tsdas: usize = scene.joints.iter().map(|joint| joint.tsdas).sum();
        plane.push(vec![1.0, scene.model.bodies.len() as f64, tsdas as f64]);
        times.iter_mut().zip(&found).for_each(|(times, cost)| times.push(cost.least));
    }
    for (name, frequency, paper) in STEPS {
        let scene = context.scene(name)?;
        let found = costs(&scene, &ways, 1e-5, &mut |_, _| ());
        let ours = found[1].least / found[0].least / (TAU * TAU * frequency);
        rows.push(Row::open(
            format!("{name}, {frequency} Hz: step of equal cost"),
            "s",
            Some(paper),
            Some(ours),
            "the paper's curve of ADAMS in Fig. 17 is not in its text; here a sparse linearly implicit solver",
        ));
    }
    rows.push(Row::open(
        "four- to six-bar: step of equal energy loss",
        "s",
        Some(2e-6),
        None,
        "it needs ADAMS: generalized-alpha's drift over its cost is in fig-23",
    ));
    let scene = context.scene("macpherson")?;
    let frequencies = modes(&scene.model, &State::initial(&scene.model))?.frequencies;
    let within = frequencies.iter().filter(|f| (15.0..=250.0).contains(*f)).count();
    rows.push(Row::claim(
        "A MacPherson axle of twenty bodies has at least six modes between some 20 and 250 Hz",
        within >= 6 && scene.model.bodies.len() == 20,
        format!("{within} of {} modes", frequencies.len()),
    ));
    let mut curves = Vec::new();
    let fits = times.map(|times| least_squares(&plane, &times));
    if let [Some((own, _)), Some((matrix, _))] = &fits {
        let at = |fit: &[f64], [bodies, constraints]: [f64; 2]| {
            // Six springs constrain five degrees of freedom.
            let springs = bodies * constraints * 6.0 / 5.0;
            fit[0] + fit[1] * bodies + fit[2] * springs
        };
        for system in SYSTEMS {
            let ratio = at(matrix, system) / at(own, system);
            if ratio <= 0.0 {
                continue;
            }
            let step = |frequency: f64| ratio / (TAU * TAU * frequency);
            let points = [10.0, 100.0, 1e3, 1e4].map(|f| [f, step(f)]).into();
            let name = format!("{} bodies, {} constraints each", system[0], system[1]);
            curves.push(Curve { name, paper: false, line: true, points });
        }
        let first = |row: usize| curves.get(row).map(|curve: &Curve| curve.points[0][1]);
        let pairs = [[0, 2], [1, 3]].map(|[few, many]| Some(first(many)? / first(few)?));
        rows.push(Row::claim(
            "With more bodies a matrix solver needs a longer step for the same cost",
            pairs.iter().all(|ratio| ratio.is_some_and(|ratio| ratio > 1.0)),
            format!("50 bodies over 20: {:.2?}", pairs.map(Option::unwrap_or_default)),
        ));
    }
    curves.push(Curve {
        name: "paper: MacPherson, four- to six-bar".into(),
        paper: true,
        line: false,
        points: vec![[250.0, 0.55e-3], [500.0, 0.13e-3]],
    });
    let plots = vec![Plot {
        name: String::new(),
        title: "Step of a matrix solver that costs as much as DBD".into(),
        axes: ["frequency [Hz]".into(), "step of equal cost [s]".into()],
        logarithmic: [true, true],
        curves,
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&[
            "DBD's step is the paper's 1/((2π)²f), times of a step are those of this PC, of both solvers linear in bodies and springs.",
        ]),
        rows,
        plots,
        ..Finding::default()
    })
}
