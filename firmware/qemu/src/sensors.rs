//! Sensors and motors on a fixed script, as hashes: the same bits on a PC and on the chip.
//!
//! `() => lines "sensors STREAM HASH"`. Each hash is FNV-1a over what a part gives in a thousand steps of a
//! rotor, whose angle is known; [`GOLDEN`] contains them, and a difference is reported. A changed
//! bit is a changed interface: it needs a reason, as those of the plants do.

use dbd_kernel::geometry::Float;
use dbd_kernel::lanes::Named;
use dbd_kernel::plant::InputError;
use dbd_kernel::random::Stream;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::words::{Fnv1a, Word, WordVisitor as _};
use dbd_kernel::{BodyIndex, Failure, Geometry, InputIndex, Real, TorsionIndex, Vec3};
use dbd_node::encoder::Counting as _;
use dbd_node::i2c::I2cPart as _;
use dbd_node::motor::Bridge as _;
use dbd_node::spi::SpiPart as _;
use dbd_node::{
    As5047p, Channel, Encoder, EncoderParameters, Errors, Fault, ImuParameters, Machine, Motor,
    MotorParameters, Mpu6000, Node, Number, Part, Probe, Sensor, Shared as _, Supply,
};

use core::cell::RefCell;

use crate::say;

/// What each stream hashes to, on every machine.
pub const GOLDEN: [(&str, u64); 10] = [
    ("normal-f32", 0x5757_b65f_0327_e3fd),
    ("normal-f64", 0x65da_32c0_d069_7bf9),
    ("sensor-f32", 0xfbda_a0b6_4dd1_93fe),
    ("sensor-f64", 0xaa30_00de_4c17_3e42),
    ("motor-f32", 0xee1f_37ce_4a4d_427d),
    ("motor-f64", 0x6d21_ea9c_7980_ef20),
    ("encoder-f32", 0x2dca_2f32_3bb6_0036),
    ("encoder-f64", 0x346e_3ca9_32d4_514e),
    ("imu-f32", 0xd1a2_d76b_187b_eac5),
    ("imu-f64", 0x7cb2_37d3_ab37_f8e5),
];

/// Steps of each script.
const STEPS: usize = 1_000;
/// \[s\] of a step.
const STEP: f64 = 5e-4;

/// Prints all lines; `false` where one is not the golden one.
// Compiled with the program that calls it, not with the library, which the audit links too.
#[inline]
pub fn run() -> bool {
    let mut well = true;
    for ((stream, golden), hash) in GOLDEN.iter().zip(hashes()) {
        let Ok(hash) = hash else {
            say!("sensors {} is not wired", stream);
            return false;
        };
        say!("sensors {} {:016x}", stream, hash);
        if hash != *golden {
            say!("sensors {} should be {:016x}", stream, golden);
            well = false;
        }
    }
    well
}

/// The hashes in the order of [`GOLDEN`].
fn hashes() -> [Result<u64, Fault>; GOLDEN.len()] {
    [
        Ok(normal::<f32>()),
        Ok(normal::<f64>()),
        sensor::<f32>(),
        sensor::<f64>(),
        motor::<f32>(),
        motor::<f64>(),
        encoder::<f32>(),
        encoder::<f64>(),
        imu::<f32>(),
        imu::<f64>(),
    ]
}

/// Normal numbers.
fn normal<R: Real>() -> u64 {
    let (mut stream, mut hash) = (Stream::new(1, "normal", 0), Fnv1a::new());
    for _ in 0..STEPS {
        hash.word(stream.normal::<R>().word());
    }
    hash.finish()
}

const ERRORS: Errors =
    Errors { noise: 0.01, bias: 0.02, walk: 0.1, resolution: 1e-3, range: [-0.4, 0.5], seed: 2 };

/// A sensor with every error, three samples late, on a saw tooth.
fn sensor<R: Number>() -> Result<u64, Fault> {
    let mut sensor = Sensor::<R, 3>::new("sensor", 0, ERRORS, STEP).map_err(|_| Fault::NotWired)?;
    let mut hash = Fnv1a::new();
    for step in 0..STEPS {
        let mask = R::from_f64((step % 100) as f64 * 0.012 - 0.6);
        hash.word(sensor.sample(mask).word());
    }
    Ok(hash.finish())
}

/// A rotor without a motor's drive, or with it, with hashed results.
fn turned<R, D>(
    parts: D,
    mut set: impl FnMut(usize),
    mut take: impl FnMut(&Rotor<R>, &mut Fnv1a) -> Result<(), Fault>,
) -> Result<u64, Fault>
where
    R: Number + Named,
    D: Part<Rotor<R>>,
{
    let rotor = Rotor { angle: R::ZERO, rate: R::ONE, torque: R::ZERO, steps: 0 };
    let mut node = Node::new(rotor, parts).map_err(|_| Fault::NotWired)?;
    let mut hash = Fnv1a::new();
    for step in 0..STEPS {
        set(step);
        node.step()?;
        take(node.machine(), &mut hash)?;
    }
    Ok(hash.finish())
}

/// A motor with lag, limit, back-EMF and friction, on duties of both signs.
fn motor<R: Number + Named>() -> Result<u64, Fault> {
    let parameters = MotorParameters {
        supply: Supply::Voltage { full: 24.0, resistance: 1.5, back_emf: 0.05 },
        torque_constant: 0.05,
        most_current: 8.0,
        lag: 2e-3,
        friction: 0.02,
        friction_speed: 3.0,
        ratio: 7.5,
        most_duty: 999,
    };
    let motor = Motor::<Float<R>>::new("motor", TORQUE, parameters);
    let motor = RefCell::new(
        motor.with_speed(Probe::scalar("rate", Readout::JointRate { spring: TorsionIndex(0) })),
    );
    let duty = |step: usize| {
        let _ = motor.with(|motor| {
            motor.set_duty(Channel::Forwards, (step * 37 % 1_000) as u16);
            motor.set_reversed(step % 250 > 125);
            motor.set_enabled(step % 100 != 99);
        });
    };
    turned::<R, _>(&motor, duty, |rotor, hash| {
        let (current, drive) = motor.with(|motor| (motor.current(), motor.output()))?;
        [current, drive, rotor.angle].iter().for_each(|value| hash.word(value.word()));
        Ok(())
    })
}

/// An encoder that is noisy and late, its counts and its chip's frames.
fn encoder<R: Number + Named>() -> Result<u64, Fault> {
    let errors = Errors { noise: 1e-3, walk: 0.01, seed: 3, ..Errors::NONE };
    let parameters = EncoderParameters { every: 2, errors, ..EncoderParameters::at_joint(16_384) };
    let probe = Probe::<Float<R>>::scalar(
        "encoder",
        Readout::JointAngle { spring: TorsionIndex(0), offset: R::ZERO },
    );
    let chip = RefCell::new(As5047p::new(Encoder::<_, 2>::new(probe, parameters)));
    turned::<R, _>(
        &chip,
        |_| {},
        |_, hash| {
            chip.with(|chip| {
                hash.word(Word::I32(chip.counts()));
                chip.select();
                let frame = [0xff, 0xff].map(|byte| chip.exchange(byte));
                chip.release();
                hash.word(Word::I32(i32::from(u16::from_be_bytes(frame))));
            })
        },
    )
}

/// An inertial measurement unit's registers, by I2C.
fn imu<R: Number + Named>() -> Result<u64, Fault> {
    let accelerometer = Errors { noise: 0.05, bias: 0.2, walk: 0.01, seed: 4, ..Errors::NONE };
    let gyroscope = Errors { noise: 1e-3, bias: 0.01, walk: 1e-3, seed: 4, ..Errors::NONE };
    let parameters = ImuParameters { accelerometer, gyroscope, ..ImuParameters::default() };
    let origin = Float::<R>::local_from_f64([0.0; 3]);
    let readout = Readout::<Float<R>>::Imu { body: BodyIndex(0), point: origin };
    let imu = RefCell::new(Mpu6000::<_, 1>::new("imu", readout, parameters));
    // Out of sleep; 500 Hz; then the next full scales.
    let wake = [[0x6b, 0], [0x1a, 1], [0x19, 1], [0x1b, 1 << 3], [0x1c, 2 << 3]];
    let write = |step: usize| {
        let _ = imu.with(|imu| {
            for [register, value] in wake.get(step).into_iter().copied() {
                imu.start(false);
                [register, value].iter().for_each(|&byte| imu.take(byte));
                imu.finish();
            }
        });
    };
    turned::<R, _>(&imu, write, |_, hash| {
        imu.with(|imu| {
            imu.start(false);
            imu.take(0x3a);
            imu.start(true);
            (0..15).for_each(|_| hash.word(Word::I32(i32::from(imu.give()))));
            imu.finish();
        })
    })
}

const TORQUE: InputIndex = InputIndex(0);

/// A rotor of 0.1 kg·m² that begins with 1 rad/s.
struct Rotor<R> {
    angle: R,
    rate: R,
    torque: R,
    steps: u64,
}

impl<R: Number + Named> Machine for Rotor<R> {
    type Real = R;
    type Precision = Float<R>;

    fn set_input(&mut self, input: InputIndex, value: R) -> Result<(), InputError> {
        if input == TORQUE {
            self.torque = value;
            Ok(())
        } else {
            Err(InputError::Unknown(input))
        }
    }

    fn read(&self, readout: &Readout<Float<R>>) -> Option<Reading<R>> {
        match readout {
            Readout::JointAngle { .. } => Some(Reading::Scalar(self.angle)),
            Readout::JointRate { .. } => Some(Reading::Scalar(self.rate)),
            Readout::Imu { .. } => Some(Reading::Imu {
                specific_force: Vec3::new(self.angle, -self.angle, self.rate),
                rate: Vec3::new(self.rate, R::ZERO, -self.rate),
            }),
            _ => None,
        }
    }

    fn advance(&mut self, steps: u64) -> Result<(), Failure> {
        let step = R::from_f64(STEP);
        for _ in 0..steps {
            self.rate = self.rate + self.torque * R::from_f64(10.0) * step;
            self.angle = self.angle + self.rate * step;
            self.steps += 1;
        }
        Ok(())
    }

    fn status(&self) -> Result<(), Failure> {
        Ok(())
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn step_size(&self) -> f64 {
        STEP
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_bits_are_those_of_every_machine() {
        assert!(super::run());
    }
}
