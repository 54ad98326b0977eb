//! Leads the tool of a delta robot along a circle: three joint servos with feed-forward.
//!
//! `(path, arms' counts) => duties and directions, four times per millisecond`. Every 2.5 ms the circle's
//! next point becomes joint angles by the inverse kinematics of rigid links; between such knots angle,
//! rate and acceleration come from the cubic through four of them (Catmull & Rom 1974). Each arm's
//! torque is that of springs, friction and inertia along the path, plus stiffness and damping on
//! the error.

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;

use super::as5047p::{COUNTS, Shaft};
use super::servo::{ControlError, Drive, Rate};

/// \[ns\] from tick to tick.
pub const TICK: u32 = 250_000;
/// Ticks from knot to knot.
const TICKS: u16 = 10;
/// \[s\] from knot to knot.
const KNOT: f32 = 2.5e-3;

/// Parameters, measured and chosen at the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Turns of a motor, and of the encoder on its shaft, per turn of its arm.
    pub gear: f32,
    /// \[N·m\] at the arm at full duty.
    pub full_torque: f32,
    /// \[N·m/rad\] of the arms' balance springs.
    pub spring: f32,
    /// \[N·m·s/rad\] friction of motor and gear.
    pub friction: f32,
    /// \[kg·m²\] inertia moved by an arm.
    pub inertia: f32,
    /// \[N·m/rad\] stiffness on the error.
    pub stiffness: f32,
    /// \[N·m·s/rad\] on its rate.
    pub damping: f32,
}

impl Constants {
    /// Of the scene's delta robot with gears of 20 and servo drives of 800 N·m at the arm.
    pub const DELTA: Self = Self {
        gear: 20.0,
        full_torque: 800.0,
        spring: 400.0,
        friction: 60.0,
        inertia: 11.0,
        stiffness: 1e4,
        damping: 100.0,
    };
}

/// \[m\] the circle's radius, and the tool's height.
const RADIUS: f32 = 0.1;
const HEIGHT: f32 = -1.011_612_6;
/// \[s\] a round, and how long the tool takes to get onto the circle.
const ROUND: f32 = 1.0;
const START: f32 = 1.0;
/// The directions of the three arms, sine and cosine.
const ARMS: [[f32; 2]; 3] = [[0.0, 1.0], [0.866_025_4, -0.5], [-0.866_025_4, -0.5]];

/// \[m\] where the tool should be at a time \[s\].
#[must_use]
pub fn path(time: f32) -> [f32; 3] {
    let begun = if time < 0.0 {
        0.0
    } else if time < START {
        time / START
    } else {
        1.0
    };
    // A quintic from rest to rest.
    let share = begun * begun * begun * (10.0 + begun * (6.0 * begun - 15.0));
    let round = time / ROUND;
    let turn = core::f32::consts::TAU * (round - libm::floorf(round));
    let radius = RADIUS * share;
    [radius * libm::sinf(turn), radius * libm::cosf(turn), HEIGHT]
}

/// \[rad\] the angle at which an arm holds the tool at a point, joints and links rigid: by the law of
/// cosines for an arm of 0.524 m whose elbow lies 1.244 m from the tool's joint; the arm's own joint
/// is 0.2 m further out than the tool's.
#[must_use]
pub fn arm([x, y, z]: [f32; 3], [sine, cosine]: [f32; 2]) -> f32 {
    let out = 0.2 - x * cosine - y * sine;
    let across = y * cosine - x * sine;
    let reach = libm::sqrtf(out * out + z * z);
    // 1.244² − 0.524² and 2·0.524.
    let bend = (1.272_96 - out * out - across * across - z * z) / (1.048 * reach);
    libm::atan2f(z, out) + libm::acosf(bend)
}

/// Measurements and outputs of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// \[rad\] the arms.
    pub angles: [f32; 3],
    /// \[rad\] how far they are behind.
    pub off: [f32; 3],
}

/// One arm: its encoder, its motor and the knots about now.
#[derive(Debug)]
struct Arm<S, P, D> {
    shaft: Shaft<S>,
    motor: Drive<P, D>,
    rate: Rate,
    /// The home position's counts, where the arm is horizontal.
    home: Option<i32>,
    /// \[rad\] two knots past and two to come; now is between the middle ones.
    knots: [f32; 4],
}

/// The controller.
#[derive(Debug)]
pub struct Follow<S, P, D> {
    arms: [Arm<S, P, D>; 3],
    constants: Constants,
    /// Ticks since the knot before now, and the number of the last knot.
    tick: u16,
    knot: u32,
}

impl<S: SpiDevice, P: SetDutyCycle, D: OutputPin> Follow<S, P, D> {
    /// The controller of three arms: an encoder, a duty and a direction of each. It begins at home,
    /// the arms horizontal.
    pub fn new(arms: [(S, P, D); 3], constants: Constants) -> Self {
        let mut axis = 0;
        let arms = arms.map(|(spi, duty, direction)| {
            let motor = Drive::new(axis, duty, direction);
            axis += 1;
            let rate = Rate::new(1e9 / TICK as f32, 0.5);
            Arm { shaft: Shaft::new(spi), motor, rate, home: None, knots: [0.0; 4] }
        });
        let mut follow = Self { arms, constants, tick: 0, knot: 0 };
        // Knots −1 to 2, of which those up to 0 are the rest before the start.
        (0..4).for_each(|_| follow.plan());
        follow
    }

    /// The next knot.
    fn plan(&mut self) {
        let point = path((self.knot as f32 - 1.0) * KNOT);
        self.knot = self.knot.wrapping_add(1);
        for (arm, direction) in self.arms.iter_mut().zip(ARMS) {
            let [_, a, b, c] = arm.knots;
            arm.knots = [a, b, c, self::arm(point, direction)];
        }
    }

    /// One tick.
    ///
    /// # Errors
    /// [`ControlError`] of the first arm that fails.
    pub fn tick(&mut self) -> Result<Seen, ControlError> {
        let Constants { gear, full_torque, spring, friction, inertia, stiffness, damping } =
            self.constants;
        let along = f32::from(self.tick) / f32::from(TICKS);
        let mut seen = Seen::default();
        let outputs = seen.angles.iter_mut().zip(&mut seen.off);
        for ((axis, arm), (shown, behind)) in (0_u8..).zip(&mut self.arms).zip(outputs) {
            let counts = arm.shaft.counts().map_err(|error| ControlError::Encoder(axis, error))?;
            let home = *arm.home.get_or_insert(counts);
            let turned = counts.wrapping_sub(home) as f32;
            let angle = turned * (core::f32::consts::TAU / COUNTS as f32 / gear);
            let [now, rate, bend] = interpolate(arm.knots, along);
            let off = now - angle;
            let known = spring * now + friction * rate + inertia * bend;
            let torque = known + stiffness * off + damping * arm.rate.next(off);
            arm.motor.set(torque / full_torque)?;
            (*shown, *behind) = (angle, off);
        }
        self.tick += 1;
        if self.tick == TICKS {
            self.tick = 0;
            self.plan();
        }
        Ok(seen)
    }

    /// Ticks, at the pace of a delay; what `look` sees of each.
    ///
    /// # Errors
    /// [`ControlError`] of the first tick that fails.
    pub fn run(
        &mut self,
        delay: &mut impl DelayNs,
        ticks: u32,
        mut look: impl FnMut(Seen),
    ) -> Result<(), ControlError> {
        for _ in 0..ticks {
            look(self.tick()?);
            delay.delay_ns(TICK);
        }
        Ok(())
    }
}

/// Value, rate and acceleration between the second and the third of four knots; the acceleration
/// is linear between those at the two.
fn interpolate([a, b, c, d]: [f32; 4], along: f32) -> [f32; 3] {
    let slopes = [0.5 * (c - a), 0.5 * (d - b)];
    let rise = c - b;
    let [square, cube] =
        [3.0 * rise - 2.0 * slopes[0] - slopes[1], slopes[0] + slopes[1] - 2.0 * rise];
    let value = b + along * (slopes[0] + along * (square + along * cube));
    let rate = slopes[0] + along * (2.0 * square + along * (3.0 * cube));
    let bends = [a - 2.0 * b + c, b - 2.0 * c + d];
    let bend = bends[0] + along * (bends[1] - bends[0]);
    [value, rate * (1.0 / KNOT), bend * (1.0 / (KNOT * KNOT))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_reach_the_tool() {
        for i in 0..40 {
            let point = path(0.05 * i as f32);
            for [sine, cosine] in ARMS {
                let angle = arm(point, [sine, cosine]);
                // In the arm's plane: elbow and the tool's joint, which is 0.1 m from its middle.
                let [out, up] = [0.3 + 0.524 * libm::cosf(angle), -0.524 * libm::sinf(angle)];
                let [x, y, z] = point;
                let along = x * cosine + y * sine + 0.1;
                let across = y * cosine - x * sine;
                let gap = (out - along) * (out - along) + across * across + (up - z) * (up - z);
                assert!((libm::sqrtf(gap) - 1.244).abs() < 1e-5, "{i}: {gap}");
            }
        }
    }

    #[test]
    fn between_knots_a_parabola_is_exact() {
        let at = |s: f32| 0.5 + 0.25 * s + 0.125 * s * s;
        for along in [0.0, 0.25, 0.5, 0.75] {
            let [value, rate, bend] = interpolate([-1.0, 0.0, 1.0, 2.0].map(at), along);
            assert_eq!(value, at(along));
            assert!((rate * KNOT - (0.25 + 0.25 * along)).abs() < 1e-6);
            assert!((bend * KNOT * KNOT - 0.25).abs() < 1e-6);
        }
    }

    #[test]
    fn the_path_begins_at_rest_and_is_a_circle() {
        assert_eq!(path(-1.0), [0.0, 0.0, HEIGHT]);
        let [x, y, _] = path(1e-2);
        assert!(x * x + y * y < 1e-9);
        for time in [1.0, 1.3, 7.9] {
            let [x, y, z] = path(time);
            assert!((libm::sqrtf(x * x + y * y) - RADIUS).abs() < 1e-6 && z == HEIGHT, "{time}");
        }
    }
}
