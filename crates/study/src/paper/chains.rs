//! Section 2.2: chains of ten links, open and closed.

use dbd_plant::plant;

use crate::paper::context::{Context, PaperError, advance, dbd};
use crate::paper::finding::{APPROXIMATE, Finding, Row, assumptions};

/// \[s\] between velocities whose difference is a mean acceleration.
const INTERVAL: f64 = 0.01;

/// \[s\] of the run.
const WINDOW: f64 = 2.0;

/// Scene, and the paper's RMS acceleration \[m/s²\], solver steps and seconds.
const CHAINS: [(&str, f64, f64, f64); 3] = [
    ("chain-closed", 6.51, 32_319.0, 6.11),
    ("chain-open-60", 10.86, 34_429.0, 4.52),
    ("chain-open-30", 3.72, 19_614.0, 3.00),
];

/// The chains.
pub(super) fn chains(context: &Context<'_>) -> Result<Finding, PaperError> {
    let mut rows = Vec::new();
    let mut elements = Vec::new();
    for (name, acceleration, steps, seconds) in CHAINS {
        let scene = context.scene(name)?;
        let step = scene.step.unwrap_or(2e-5);
        let every = (INTERVAL / step).round();
        let mut plant = plant(&scene, &dbd(0)?, step)?;
        let mut before = plant.state().bodies;
        let (mut sum, mut count) = (0.0, 0_u32);
        for _ in 0..(WINDOW / INTERVAL).round() as u64 {
            advance(plant.as_mut(), every as u64)?;
            let now = plant.state().bodies;
            for (now, before) in now.iter().zip(&before) {
                let mean = (now.velocity - before.velocity) * (1.0 / (every * step));
                sum += mean.dot(mean);
                count += 1;
            }
            before = now;
        }
        let ours = (sum / f64::from(count)).sqrt();
        let quantity = format!("{name}, RMS acceleration");
        rows.push(Row::compared(quantity, "m/s²", acceleration, ours, APPROXIMATE));
        rows.push(Row::open(
            format!("{name}, solver steps in {seconds} s"),
            "",
            Some(steps),
            Some((WINDOW / step).round()),
            "an adaptive solver's steps over a duration that the text does not give; here a constant step",
        ));
        elements.push((scene.model.bodies.len(), scene.joints.iter().map(|j| j.tsdas).sum()));
    }
    let [(bodies, closed), (_, open), _]: [(usize, usize); 3] =
        [elements[0], elements[1], elements[2]];
    rows.push(Row::claim(
        "A closed loop costs a step no more than its further joint",
        closed - open == 6 && bodies == 10,
        format!("{closed} TSDAs closed, {open} open, on {bodies} bodies"),
    ));
    rows.push(Row::open(
        "constraints of either chain",
        "",
        Some(56.0),
        None,
        "ten revolutes hold 50 degrees of freedom, eleven 55; which joints hold 56 is not said",
    ));
    Ok(Finding {
        assumptions: assumptions(&[
            "The RMS is over all ten links' centres of mass and 2 s, of mean accelerations over 10 ms: the joints' vibration is not in it.",
            "Joints of 1 MN/m; the paper solves ideal joints.",
        ]),
        rows,
        ..Finding::default()
    })
}
