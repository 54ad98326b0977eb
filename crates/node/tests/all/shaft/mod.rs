//! A machine that is no plant of the kernel: a rotor of inertia 1 kg·m² on frictionless bearings.
//!
//! `(torque, step) => angle, rate`. It shows that another solver may stand behind the drivers, and it
//! gives the tests a truth that is known in closed form.

use dbd_kernel::plant::InputError;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{BodyIndex, Cause, F32, Failure, InputIndex, TorsionIndex, Vec3};
use dbd_node::Machine;

/// \[s\].
pub const STEP: f64 = 1.0 / 1024.0;
pub const TORQUE: InputIndex = InputIndex(0);
pub const ANGLE: Readout<F32> = Readout::JointAngle { spring: TorsionIndex(0), offset: 0.0 };
pub const RATE: Readout<F32> = Readout::JointRate { spring: TorsionIndex(0) };
/// Its y is the angle.
pub const POINT: Readout<F32> =
    Readout::Point { body: BodyIndex(0), point: Vec3::new(0.0, 0.0, 0.0) };
/// Specific force (1, −2, 9.80665), rate (0, 0, rate).
pub const IMU: Readout<F32> = Readout::Imu { body: BodyIndex(0), point: Vec3::new(0.0, 0.0, 0.0) };

/// The rotor.
#[derive(Debug, Default)]
pub struct Shaft {
    pub angle: f32,
    pub rate: f32,
    pub torque: f32,
    pub steps: u64,
    /// The step that fails.
    pub breaks_at: Option<u64>,
}

impl Machine for Shaft {
    type Real = f32;
    type Precision = F32;

    fn set_input(&mut self, input: InputIndex, value: f32) -> Result<(), InputError> {
        if input != TORQUE {
            return Err(InputError::Unknown(input));
        }
        if !value.is_finite() {
            return Err(InputError::NotFinite(input));
        }
        self.torque = value;
        Ok(())
    }

    fn read(&self, readout: &Readout<F32>) -> Option<Reading<f32>> {
        match *readout {
            Readout::JointAngle { spring: TorsionIndex(0), .. } => {
                Some(Reading::Scalar(self.angle))
            }
            Readout::JointRate { spring: TorsionIndex(0) } => Some(Reading::Scalar(self.rate)),
            Readout::Point { body: BodyIndex(0), .. } => {
                Some(Reading::Vector(Vec3::new(0.0, self.angle, 0.0)))
            }
            Readout::Imu { body: BodyIndex(0), .. } => Some(Reading::Imu {
                specific_force: Vec3::new(1.0, -2.0, 9.80665),
                rate: Vec3::new(0.0, 0.0, self.rate),
            }),
            _ => None,
        }
    }

    fn advance(&mut self, steps: u64) -> Result<(), Failure> {
        for _ in 0..steps {
            if self.status().is_err() {
                break;
            }
            self.rate += self.torque * STEP as f32;
            self.angle += self.rate * STEP as f32;
            self.steps += 1;
        }
        self.status()
    }

    fn status(&self) -> Result<(), Failure> {
        match self.breaks_at {
            Some(step) if self.steps >= step => {
                let cause = Cause::NonFinite { body: BodyIndex(0) };
                Err(Failure { cause, step })
            }
            _ => Ok(()),
        }
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn step_size(&self) -> f64 {
        STEP
    }
}
