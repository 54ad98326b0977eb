//! The controller in a project of `host-sim new firmware`: reads the plant's sensors and drives its motors.

use crate::controller::voltages;
use crate::model::*;

/// What the controller does before each step. A read-out without a value stops the motors.
pub fn control(plant: &mut BalanceRobotPlant) {
    let readouts = [
        &BALANCE_ROBOT_READOUT_PITCH_F32,
        &BALANCE_ROBOT_READOUT_LEFT_TURN_F32,
        &BALANCE_ROBOT_READOUT_RIGHT_TURN_F32,
        &BALANCE_ROBOT_READOUT_PITCH_RATE_F32,
        &BALANCE_ROBOT_READOUT_LEFT_RATE_F32,
        &BALANCE_ROBOT_READOUT_RIGHT_RATE_F32,
    ];
    let seen = readouts.map(|readout| plant.read(readout).and_then(|reading| reading.scalar()));
    let is_blind = seen.iter().any(Option::is_none);
    let seen = seen.map(Option::unwrap_or_default);
    let [left, right] = if is_blind { [0.0; 2] } else { voltages(seen) };
    // An input refuses only what is not a number; the drive then holds its last voltage.
    let _ = plant.set_input_real(BALANCE_ROBOT_INPUT_LEFT_MOTOR, left);
    let _ = plant.set_input_real(BALANCE_ROBOT_INPUT_RIGHT_MOTOR, right);
}
