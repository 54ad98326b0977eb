//! Drives the gate of the scene `gate-opener`: it opens, waits, and closes; a voltage from time and angle.

/// \[s\] the time at which it closes.
const CLOSES: f32 = 12.5;

/// \[rad\] the angles at which the limit switches of the open and the closed gate end a motion.
const ENDS: [f32; 2] = [1.565, 0.0];

/// \[V, V/s\] the voltage on the way, near an end, and its rise at the start.
const VOLTAGES: [f32; 3] = [24.0, 6.0, 48.0];

/// \[rad\] the angle before an end from which the gate creeps.
const CREEP: f32 = 0.08;

/// \[V\] of the motor after `time` \[s\] at an angle of the gate \[rad\].
pub fn voltage(time: f32, angle: f32) -> f32 {
    let [open, closed] = ENDS;
    let (sign, left, since) = match time < CLOSES {
        true => (1.0, open - angle, time),
        false => (-1.0, angle - closed, time - CLOSES),
    };
    let [full, slow, rise] = VOLTAGES;
    let most = if left > CREEP { full } else { slow };
    if left > 0.0 { sign * most.min(rise * since) } else { 0.0 }
}
