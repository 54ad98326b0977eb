//! Sections 3.2 and 4.1: cost of a step over the size of a system.

use crate::paper::context::{Context, PaperError, TEN, dbd, scheme};
use crate::paper::counts::ELEMENTS;
use crate::paper::finding::{Curve, Finding, Plot, Row, Tolerance, assumptions};
use crate::paper::fit::{exponent, least_squares};
use crate::timing::costs;
use crate::ways::Way;
use dbd_plant::SchemeName;

/// Section 3.2.
const FACTOR: f64 = 15.8;

/// Ball on a spring.
pub(super) fn factor(context: &Context<'_>) -> Result<Finding, PaperError> {
    let scene = context.scene("spring-ball")?;
    let kernel = Way::Kernel(scheme(SchemeName::SemiImplicitEuler)?);
    let ways = [kernel, Way::NaiveSemiImplicitEuler];
    let times = costs(&scene, &ways, 1e-3, &mut |_, _| ());
    let factor = times[1].least / times[0].least;
    Ok(Finding {
        assumptions: assumptions(&[
            "The paper's factor is MATLAB over ADAMS. Here it is a std program in the usual form, heap and dynamic dispatch, over the kernel, for the same scheme and the same scene.",
        ]),
        rows: vec![
            Row::open(
                "time of a step, prototype over compiled code",
                "",
                Some(FACTOR),
                Some(factor),
                "neither of the paper's two programs is published; a factor of one pair of programs says nothing of another",
            ),
            Row::extra("time of a step, kernel", "ns", 1e9 * times[0].least),
        ],
        ..Finding::default()
    })
}

/// Fig. 17.
pub(super) fn growth(context: &Context<'_>) -> Result<Finding, PaperError> {
    let ways = [Way::Kernel(dbd(0)?), Way::LinearlyImplicitEuler];
    let (mut plane, mut times) = (Vec::new(), [Vec::new(), Vec::new()]);
    let mut curves = [Vec::new(), Vec::new()];
    for name in TEN {
        let scene = context.scene(name)?;
        let facts = dbd_scene::facts(&scene);
        let found = costs(&scene, &ways, 1e-5, &mut |_, _| ());
        let tsdas: usize = scene.joints.iter().map(|joint| joint.tsdas).sum();
        plane.push(vec![1.0, scene.model.bodies.len() as f64, tsdas as f64]);
        for (way, cost) in found.iter().enumerate() {
            times[way].push(1e3 * cost.least);
        }
        curves[0].push([facts.equations as f64, 1e3 * found[0].least]);
        curves[1].push([facts.constraint_equations as f64, 1e3 * found[1].least]);
    }
    let mut rows = Vec::new();
    if let Some((found, rmse)) = least_squares(&plane, &times[0]) {
        let mean = times[0].iter().sum::<f64>() / times[0].len() as f64;
        rows.push(Row::claim(
            "Time of a step is linear in bodies and TSDAs",
            rmse < 0.05 * mean,
            format!(
                "τ = {:.4} + {:.4}·bodies + {:.5}·TSDAs µs, RMSE {:.1} % of the mean (paper: 2.0 %)",
                1e3 * found[0],
                1e3 * found[1],
                1e3 * found[2],
                100.0 * rmse / mean
            ),
        ));
    }
    let tolerance = Tolerance { within: 0.15, factor: 3.0 };
    if let Some(ours) = exponent(&curves[0]) {
        rows.push(Row::compared("growth exponent over equations, DBD", "", 1.0, ours, tolerance));
    }
    if let Some(ours) = exponent(&curves[1]) {
        rows.push(Row::open(
            "growth exponent over equations, matrix solver",
            "",
            Some(2.0),
            Some(ours),
            "the paper's exponent is that of ADAMS; this one is of a linearly implicit solver with a sparse matrix",
        ));
    }
    let paper: Vec<[f64; 2]> =
        ELEMENTS.iter().map(|[bodies, _, time]| [6.0 * bodies, *time]).collect();
    let normalised = paper.iter().map(|[x, time]| [*x, time / FACTOR]).collect();
    let curve = |name: &str, paper, points| Curve { name: name.into(), paper, line: true, points };
    let [ours, matrix] = curves;
    let plots = vec![Plot {
        name: String::new(),
        title: "Time of a step over the number of equations".into(),
        axes: ["number of equations".into(), "τ [ms]".into()],
        logarithmic: [true, true],
        curves: vec![
            curve("paper, DBD", true, paper),
            curve("paper, DBD over 15.8 (DBD*)", true, normalised),
            curve("dbd f64, this PC", false, ours),
            curve("sparse linearly implicit solver, this PC", false, matrix),
        ],
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&[
            "The paper gives its ADAMS points only in a figure; a matrix solver of this project replaces ADAMS.",
            "Least of at least fifteen measurements, thread time; the axes are logarithmic because machines differ by three decades.",
        ]),
        rows,
        plots,
        ..Finding::default()
    })
}
