//! The controller in a project of `host-sim new firmware` whose scene has no `table` at its motor: the controller sets the
//! voltage.

use crate::controller::voltage;
use crate::model::*;

/// What the controller does before each step. A read-out without a value stops the motor.
pub fn control(plant: &mut GateOpenerPlant) {
    let time = plant.state().step as f32 * GATE_OPENER_STEP as f32;
    let reading = plant.read(&GATE_OPENER_READOUT_ANGLE_SENSOR_F32);
    let angle = reading.and_then(|reading| reading.scalar());
    let voltage = angle.map_or(0.0, |angle| voltage(time, angle));
    // An input refuses only what is not a number; the drive then holds its last voltage.
    let _ = plant.set_input_real(GATE_OPENER_INPUT_MOTOR, voltage);
}
