//! Section 4.3: how stiffness and step move the tool of the 3RRR.

use std::f64::consts::TAU;

use dbd_plant::{Frequencies, plant};
use dbd_scene::Scene;

use crate::paper::context::{Context, PaperError, advance, dbd, place};
use crate::paper::finding::{Curve, Finding, Plot, Row, Tolerance, assumptions};

/// Table 8: stiffness \[N/m\], frequency \[Hz\], step \[s\], error \[mm\].
const TABLE: [[f64; 4]; 17] = [
    [2e6, 337.0, 7.52e-5, 3.1],
    [2e6, 337.0, 1e-5, 3.1],
    [2e6, 337.0, 1e-6, 3.1],
    [2e6, 337.0, 1e-7, 3.1],
    [5e6, 524.0, 4.85e-5, 1.2],
    [5e6, 524.0, 1e-5, 1.2],
    [5e6, 524.0, 1e-6, 1.2],
    [5e6, 524.0, 5e-7, 1.2],
    [5e6, 524.0, 1e-7, 1.2],
    [5e7, 1656.0, 1.5e-5, 0.12],
    [5e7, 1656.0, 1e-6, 0.11],
    [5e7, 1656.0, 5e-7, 0.11],
    [5e7, 1656.0, 1e-7, 0.11],
    [5e8, 5137.0, 4.6e-6, 2.0e-5],
    [5e8, 5137.0, 1e-6, 5.6e-6],
    [5e8, 5137.0, 1e-7, 5.3e-7],
    [5e8, 5137.0, 5e-8, 2.5e-7],
];

/// The reference's stiffness and step.
const REFERENCE: [f64; 2] = [5e8, 5e-9];

/// \[s\] of the comparison, and between its samples.
const WINDOW: f64 = 0.05;
const SAMPLES: u32 = 50;

/// A pose that is not published and a duration that is not either.
const TOLERANCE: Tolerance = Tolerance { within: 0.15, factor: 3.0 };

/// Positions of the tool \[m\] after every interval, interpolated linearly between steps.
fn path(scene: &Scene, step: f64) -> Result<Vec<[f64; 3]>, PaperError> {
    let tool = place(scene, "tool")?;
    let mut plant = plant(scene, &dbd(0)?, step)?;
    let mut path = Vec::new();
    for sample in 1..=SAMPLES {
        let time = WINDOW * f64::from(sample) / f64::from(SAMPLES);
        let steps = (time / step + 1e-9).floor();
        let further = steps as u64 - plant.steps();
        advance(plant.as_mut(), further)?;
        let body = plant.state().bodies[tool];
        let after = time - steps * step;
        let place = body.position + body.velocity * after;
        path.push(place.to_f64());
    }
    Ok(path)
}

/// \[m\] mean distance.
fn offset(path: &[[f64; 3]], reference: &[[f64; 3]]) -> f64 {
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    path.iter().zip(reference).map(distance).sum::<f64>() / path.len() as f64
}

/// Table 8.
pub(super) fn offsets(context: &Context<'_>) -> Result<Finding, PaperError> {
    let shipped = context.scene("3rrr")?;
    let of = |stiffness: f64| shipped.with(&format!("joint.*.stiffness={stiffness:e}"));
    let reference = path(&of(REFERENCE[0])?, REFERENCE[1])?;
    let (mut rows, mut curves): (Vec<Row>, Vec<[Curve; 2]>) = (Vec::new(), Vec::new());
    let mut last = 0.0;
    for [stiffness, frequency, step, error] in TABLE {
        let scene = of(stiffness)?;
        let label = format!("k = {:.0} MN/m", 1e-6 * stiffness);
        if stiffness != last {
            let ours = Frequencies::of(&scene).estimate / TAU;
            let quantity = format!("{label}: frequency");
            let row = Row::compared(quantity, "Hz", frequency, ours, TOLERANCE);
            rows.push(row.noted("here the highest of the pose; the paper's is the dominant one"));
            let curve = |name: String, paper| Curve { name, paper, line: true, points: Vec::new() };
            let names = [format!("paper, {label}"), format!("dbd, {label}")];
            let [paper, ours] = names;
            curves.push([curve(paper, true), curve(ours, false)]);
        }
        last = stiffness;
        let ours = 1e3 * offset(&path(&scene, step)?, &reference);
        let quantity = format!("{label}, h = {step:e} s: offset");
        if stiffness < REFERENCE[0] {
            rows.push(Row::compared(quantity, "mm", error, ours, TOLERANCE));
        } else {
            let row = Row::compared(quantity, "mm", 1e3 * error, ours, TOLERANCE);
            rows.push(row.noted(format!(
                "the table's {error:e} read as metres; read as millimetres, as it is headed, the ratio is {:.0}",
                ours / error
            )));
        }
        if let Some([paper, own]) = curves.last_mut() {
            let factor = if stiffness < REFERENCE[0] { 1.0 } else { 1e3 };
            paper.points.push([step, factor * error]);
            own.points.push([step, ours]);
        }
    }
    let ours = |stiffness: f64| {
        let label = format!("k = {:.0} MN/m, h", 1e-6 * stiffness);
        let found = rows.iter().filter(move |row| row.quantity.starts_with(&label));
        found.filter_map(|row| row.ours).collect::<Vec<f64>>()
    };
    let spread = |values: &[f64]| {
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
        high / low
    };
    let (soft, middle) = (ours(2e6), ours(5e7));
    let by_step = spread(&soft).max(spread(&middle));
    let by_stiffness = soft[0] / middle[0];
    let claim = Row::claim(
        "The step hardly matters, the stiffness does",
        by_step < 1.5 && by_stiffness > 5.0,
        format!(
            "over steps by a factor of {by_step:.2} at most, from 2 to 50 MN/m by {by_stiffness:.1}"
        ),
    );
    rows.push(claim);
    let plots = vec![Plot {
        name: String::new(),
        title: "Offset of the tool over the step".into(),
        axes: ["step [s]".into(), "offset [mm]".into()],
        logarithmic: [true, true],
        curves: curves.into_iter().flatten().collect(),
        map: None,
    }];
    Ok(Finding {
        assumptions: assumptions(&[
            "The text gives no duration: 0.05 s here, mean distance of the tool's centre over 50 samples. The pose is this project's.",
            "dbd without iterations. The reference is the paper's: 500 MN/m, 5 ns.",
        ]),
        rows,
        plots,
        ..Finding::default()
    })
}
