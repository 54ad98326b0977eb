//! A plant at the far end of a serial line as a machine of a node.
//!
//! `inputs => frame; frame => sensors`, once per step. The plant steps in lockstep: a step is asked for until its outputs
//! arrive, so a line that loses frames changes no bit.

use dbd_kernel::plant::InputError;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Cause, F32, Failure, InputIndex, Vec3};
use dbd_link::ControllerEnd;
use dbd_link::controller_end::{Unanswered, Wait, ask, outputs_at, welcome};
use dbd_link::device::numbers_of;
use dbd_link::message::{
    Hello, Identity, Inputs, Message, Outputs, Refusal, Settings, Statistics, Values,
};

use crate::log;

/// Times that a step is asked for.
const TRIES: u32 = 200;
/// Number of messages to the plant that the session is over.
const FAREWELLS: u32 = 3;

/// The plant at the far end. Its session is over when it is dropped.
pub struct Remote<'l, L: Wait> {
    line: &'l mut L,
    end: ControllerEnd,
    inputs: &'static [InputIndex],
    sensors: &'static [Readout<F32>],
    step_size: f64,
    values: Values,
    newest: Outputs,
    status: Result<(), Failure>,
}

impl<'l, L: Wait> Remote<'l, L> {
    /// Opens a session with a plant of this identity, and waits until the plant answers. `session` is another number
    /// than that of a session that this plant may still have open. `None` where the plant refuses, which is logged.
    pub fn open(
        line: &'l mut L,
        session: u16,
        identity: Identity,
        inputs: &'static [InputIndex],
        sensors: &'static [Readout<F32>],
    ) -> Option<Self> {
        let mut end = ControllerEnd::new(session);
        let step_size = identity.step;
        let hello = Message::Hello(Hello { identity, settings: Settings::default() });
        // The plant may be switched on later.
        let welcome = match ask(&mut end, line, u32::MAX, &hello, welcome) {
            Ok(welcome) => welcome,
            Err(Unanswered::Refused(Refusal::Identity(mismatch, _))) => {
                log!(error, "remote plant: mismatch of {}", mismatch.name());
                return None;
            }
            Err(_) => {
                log!(error, "remote plant: the session was refused");
                return None;
            }
        };
        let values = inputs.iter().map(|_| 0.0).collect();
        let (newest, status) = (welcome.outputs, Ok(()));
        Some(Self { line, end, inputs, sensors, step_size, values, newest, status })
    }

    /// The hash of the plant's state after the last step.
    pub fn hash(&self) -> u64 {
        self.newest.hash
    }

    /// Counts at the controller's end.
    pub fn statistics(&self) -> &Statistics {
        self.end.statistics()
    }

    fn step(&mut self) -> Result<(), Failure> {
        let step = self.newest.step;
        let inputs = Message::Inputs(Inputs { step, values: self.values.clone() });
        let answer = ask(&mut self.end, self.line, TRIES, &inputs, outputs_at(step + 1));
        match answer {
            Ok(outputs) if outputs.running => {
                self.newest = outputs;
                return Ok(());
            }
            Ok(outputs) => {
                log!(error, "remote plant: failure at step {}", outputs.step);
                self.newest = outputs;
            }
            Err(Unanswered::Refused(_)) => log!(error, "remote plant: step {} was refused", step),
            Err(Unanswered::Silent) => log!(error, "remote plant: no answer to step {}", step),
        }
        // The plant does not send the cause: there are no further steps.
        Err(Failure { cause: Cause::Steps, step: step + 1 })
    }
}

impl<L: Wait> dbd_node::Machine for Remote<'_, L> {
    type Real = f32;
    type Precision = F32;

    fn set_input(&mut self, input: InputIndex, value: f32) -> Result<(), InputError> {
        if !value.is_finite() {
            return Err(InputError::NotFinite(input));
        }
        let place = self.inputs.iter().position(|own| *own == input);
        let held = place.and_then(|place| self.values.get_mut(place));
        *held.ok_or(InputError::Unknown(input))? = f64::from(value);
        Ok(())
    }

    fn read(&self, readout: &Readout<F32>) -> Option<Reading<f32>> {
        let place = self.sensors.iter().position(|own| own == readout)?;
        let before = self.sensors.get(..place)?.iter().map(numbers_of).sum();
        let numbers = self.newest.values.get(before..)?.get(..numbers_of(readout))?;
        if numbers.iter().any(|number| number.is_nan()) {
            return None;
        }
        // They were of single precision before.
        match *numbers {
            [value] => Some(Reading::Scalar(value as f32)),
            [x, y, z] => Some(Reading::Vector(Vec3::new(x as f32, y as f32, z as f32))),
            [x, y, z, a, b, c] => Some(Reading::Imu {
                specific_force: Vec3::new(x as f32, y as f32, z as f32),
                rate: Vec3::new(a as f32, b as f32, c as f32),
            }),
            _ => None,
        }
    }

    fn advance(&mut self, steps: u64) -> Result<(), Failure> {
        for _ in 0..steps {
            if self.status.is_err() {
                break;
            }
            self.status = self.step();
        }
        self.status
    }

    fn status(&self) -> Result<(), Failure> {
        self.status
    }

    fn steps(&self) -> u64 {
        self.newest.step
    }

    fn step_size(&self) -> f64 {
        self.step_size
    }
}

impl<L: Wait> Drop for Remote<'_, L> {
    fn drop(&mut self) {
        let farewell = |answer| matches!(answer, Message::Farewell).then_some(());
        // A plant that does not hear it notes that a new session begins.
        _ = ask(&mut self.end, self.line, FAREWELLS, &Message::Goodbye, farewell);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use dbd_link::Line;
    use dbd_node::Machine as _;

    use super::*;
    use crate::hil::plants::{self, CART_PENDULUM_INPUTS, CART_PENDULUM_SENSORS, End};
    use crate::models::cart_pendulum::CartPendulumF32;

    /// A line to a plant in this program, which is cut after some frames.
    struct Cut {
        plant: End<CartPendulumF32, 1, 4>,
        answers: VecDeque<u8>,
        left: u32,
    }

    impl Line for Cut {
        fn send(&mut self, frame: &[u8]) {
            if let Some(left) = self.left.checked_sub(1) {
                self.left = left;
                for byte in frame {
                    self.plant.receive(*byte, &mut |frame: &[u8]| self.answers.extend(frame));
                }
            }
        }
    }

    impl Wait for Cut {
        fn byte(&mut self) -> Option<u8> {
            self.answers.pop_front()
        }
    }

    fn line(left: u32) -> Cut {
        let plant = plants::cart_pendulum(0).expect("the scene's step");
        Cut { plant, answers: VecDeque::new(), left }
    }

    fn opened(line: &mut Cut) -> Remote<'_, Cut> {
        let identity = line.plant.identity().clone();
        Remote::open(line, 1, identity, &CART_PENDULUM_INPUTS, &CART_PENDULUM_SENSORS)
            .expect("the same plant")
    }

    #[test]
    fn sensors_and_inputs_are_those_of_the_plant() {
        let mut line = line(u32::MAX);
        let mut remote = opened(&mut line);
        let [drive] = CART_PENDULUM_INPUTS;
        assert_eq!(remote.set_input(drive, 2.5), Ok(()));
        assert_eq!(remote.set_input(drive, f32::NAN), Err(InputError::NotFinite(drive)));
        let other = InputIndex(7);
        assert_eq!(remote.set_input(other, 0.0), Err(InputError::Unknown(other)));
        assert_eq!((remote.advance(3), remote.steps()), (Ok(()), 3));
        let read = CART_PENDULUM_SENSORS.map(|sensor| remote.read(&sensor));
        assert_eq!(remote.read(&Readout::Input { input: drive }), None);
        drop(remote);
        let plant = line.plant.device().plant();
        assert_eq!(read, CART_PENDULUM_SENSORS.map(|sensor| plant.read(&sensor)));
        assert!(read.iter().all(Option::is_some));
        assert!(!line.plant.is_open());
    }

    #[test]
    fn a_silent_plant_is_a_failure_that_latches() {
        let mut line = line(2);
        let mut remote = opened(&mut line);
        assert_eq!(remote.advance(1), Ok(()));
        let failed = Err(Failure { cause: Cause::Steps, step: 2 });
        assert_eq!((remote.advance(5), remote.steps()), (failed, 1));
        let sent = remote.statistics().sent;
        assert_eq!((remote.advance(1), remote.statistics().sent), (failed, sent));
        assert_eq!(sent, 2 + TRIES);
    }

    #[test]
    fn another_plant_is_refused() {
        let mut line = line(u32::MAX);
        let identity = Identity { step: 1.0, ..line.plant.identity().clone() };
        assert!(Remote::open(&mut line, 1, identity, &[], &[]).is_none());
        assert_eq!(line.plant.statistics().refused, 1);
    }
}
