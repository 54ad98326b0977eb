//! Resolution of positions and orientations in single precision, and whether a body starts too slowly for it.
//!
//! `(state at t = 0, step) => a sentence`. A step adds h·v to a position; rounding changes it by up to half of its last
//! digit, in the same direction every step while the velocity hardly changes.

use dbd_kernel::State;

use crate::scene::Scene;
use crate::time::{display, rounded};

/// \[rad\] rotation of a body by the last digit of a unit quaternion in single precision.
pub const LAST_TURN: f64 = f32::EPSILON as f64;

/// \[1\] Largest fraction of a body's motion that rounding may change, at the velocity of t = 0, without a warning.
const REPORTED: f64 = 0.1;

/// \[m\] last digit of a position in single precision, for its largest coordinate.
#[must_use]
pub fn last_digit(position: [f64; 3]) -> f64 {
    let largest = position.iter().fold(0.0, |most: f64, c| most.max(c.abs())) as f32;
    f64::from(largest.next_up()) - f64::from(largest)
}

/// The warning about the slowest body for a step of `step` \[s\] in single precision, if it is too slow; `whose` begins
/// the sentence: `the step`.
#[must_use]
pub fn slow_start(scene: &Scene, step: f64, whose: &str) -> Option<String> {
    let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let state = State::initial(&scene.model);
    let bodies = state.bodies.iter().zip(&scene.body_names);
    let speeds = bodies.flat_map(|(body, name)| {
        let way = (length(body.velocity.to_f64()), last_digit(body.position.to_f64()), "m");
        let turn = (length(body.angular_velocity.to_f64()), LAST_TURN, "rad");
        [way, turn]
            .map(|(speed, digit, unit)| (name, speed, digit, unit, 0.5 * digit / (step * speed)))
    });
    let moving = speeds.filter(|(_, speed, ..)| *speed > 0.0);
    let (name, speed, digit, unit, share) = moving.max_by(|a, b| a.4.total_cmp(&b.4))?;
    (share > REPORTED).then(|| {
        format!(
            "{whose} of {} is too short for single precision: body `{name}` starts at {} {unit}/s, \
             but its {} is resolved to {} {unit}, so {} of its motion may be lost at this \
             velocity; use a longer step or the precision fixed",
            display(step),
            two(speed),
            if unit == "m" { "position" } else { "orientation" },
            two(digit),
            if share >= 0.5 { "all".into() } else { format!("{} %", two(100.0 * share)) },
        )
    })
}

/// A number with two significant digits.
fn two(number: f64) -> String {
    format!("{:?}", rounded(number, 2))
}
