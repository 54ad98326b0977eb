//! State feedback for the scene `balance-robot`: two voltages from pitch and wheels, once per millisecond.
//!
//! The gains are those of the linear regulator for weights 300, 5, 5, 10, 0.1, 0.1 on the states below and 1 on each
//! voltage, for the linear system about the upright robot. `tests/linear/gains.rs` computes them.

/// Read-outs of the scene, in the order of [`voltages`].
pub const STATES: [&str; 6] =
    ["pitch", "left_turn", "right_turn", "pitch_rate", "left_rate", "right_rate"];

/// Inputs of the scene, in the order of [`voltages`].
pub const MOTORS: [&str; 2] = ["left_motor", "right_motor"];

/// \[V/rad, V·s/rad\] of the left motor; those of the right motor are these with left and right exchanged.
pub const GAINS: [f32; 6] = [-55.91, 0.0, -2.236, -12.2, -0.836, -1.177];

/// \[V\] of the left and the right motor.
pub fn voltages(seen: [f32; 6]) -> [f32; 2] {
    let [pitch, left, right, pitch_rate, left_rate, right_rate] = seen;
    let [k, own, other, rate, own_rate, other_rate] = GAINS;
    let lean = k * pitch + rate * pitch_rate;
    [
        -(lean + own * left + other * right + own_rate * left_rate + other_rate * right_rate),
        -(lean + own * right + other * left + own_rate * right_rate + other_rate * left_rate),
    ]
}
