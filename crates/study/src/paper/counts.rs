//! Tables 7a and 7b: equations, bodies and TSDAs of ten systems.

use crate::paper::context::{Context, PaperError, TEN};
use crate::paper::finding::{EXACT, Finding, Row, Tolerance, assumptions};
use crate::paper::fit::least_squares;

/// Table 7a: equations with constraints and without.
const EQUATIONS: [[f64; 2]; 10] = [
    [35.0, 18.0],
    [46.0, 24.0],
    [59.0, 30.0],
    [70.0, 36.0],
    [81.0, 42.0],
    [131.0, 66.0],
    [142.0, 72.0],
    [153.0, 78.0],
    [306.0, 156.0],
    [365.0, 186.0],
];

/// Table 7b: bodies, TSDAs, time of a step \[ms\].
pub(super) const ELEMENTS: [[f64; 3]; 10] = [
    [3.0, 24.0, 0.267],
    [4.0, 30.0, 0.270],
    [5.0, 42.0, 0.284],
    [6.0, 48.0, 0.301],
    [7.0, 54.0, 0.304],
    [11.0, 66.0, 0.406],
    [12.0, 78.0, 0.423],
    [13.0, 90.0, 0.430],
    [26.0, 180.0, 0.626],
    [31.0, 222.0, 0.692],
];

/// Section 4.1: c, a and b of τ = c + a·bodies + b·TSDAs \[ms\], and the fit's RMSE.
const FIT: [f64; 4] = [0.2175, 0.0298, -0.0020, 0.0077];

/// Last digits of the printed values.
const PRINTED: Tolerance = Tolerance { within: 0.02, factor: 1.5 };

/// Table 7a.
pub(super) fn equations(context: &Context<'_>) -> Result<Finding, PaperError> {
    let mut rows = Vec::new();
    for (name, [constrained, free]) in TEN.into_iter().zip(EQUATIONS) {
        let facts = dbd_scene::facts(&context.scene(name)?);
        let ours = facts.constraint_equations as f64;
        rows.push(Row::compared(format!("{name}, constraints"), "", constrained, ours, EXACT));
        let ours = facts.equations as f64;
        rows.push(Row::compared(format!("{name}, DBD"), "", free, ours, EXACT));
    }
    Ok(Finding {
        assumptions: assumptions(&[
            "Constraint equations are those of the joints that the paper names for its multibody model, one revolute each of a closed loop made spherical and one cylindrical where a loop would be over-constrained.",
        ]),
        rows,
        ..Finding::default()
    })
}

/// Table 7b, without its times: those are of another machine; the fit through them is done again.
pub(super) fn elements(context: &Context<'_>) -> Result<Finding, PaperError> {
    let mut rows = Vec::new();
    for (name, [bodies, tsdas, _]) in TEN.into_iter().zip(ELEMENTS) {
        let scene = context.scene(name)?;
        let ours = scene.model.bodies.len() as f64;
        rows.push(Row::compared(format!("{name}, bodies"), "", bodies, ours, EXACT));
        let joints: usize = scene.joints.iter().map(|joint| joint.tsdas).sum();
        let ours = (joints + scene.raw_names().len()) as f64;
        let row = Row::compared(format!("{name}, TSDAs"), "", tsdas, ours, EXACT);
        rows.push(if ours == tsdas {
            row
        } else {
            row.noted(
                "six per revolute, two revolutes per universal joint; the paper's own Table 7a needs this number of revolutes",
            )
        });
    }
    let plane: Vec<Vec<f64>> = ELEMENTS.iter().map(|[n, m, _]| vec![1.0, *n, *m]).collect();
    let times = ELEMENTS.map(|[.., time]| time);
    if let Some((found, rmse)) = least_squares(&plane, &times) {
        let names = ["fit of the paper's times, c", "a", "b", "RMSE"];
        let ours = [found[0], found[1], found[2], rmse];
        for ((name, paper), ours) in names.into_iter().zip(FIT).zip(ours) {
            rows.push(Row::compared(name, "ms", paper, ours, PRINTED));
        }
    }
    Ok(Finding {
        assumptions: assumptions(&[
            "Bodies without the ground; spiders of universal joints are bodies.",
            "The paper's times are not measured again here: see fig-17.",
        ]),
        rows,
        ..Finding::default()
    })
}
