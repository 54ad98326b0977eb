//! Sine and cosine of an angle, the angle of a vector.
//!
//! An angle given in degrees is a rounded number of radians. A double nearest to a whole number of thousandths of a
//! degree is taken as that angle: cos 60° is 0.5.

use core::f64::consts::FRAC_PI_2;

use crate::precise::Precise;

/// π.
pub(crate) const PI: Precise = Precise::new(core::f64::consts::PI, 1.224_646_799_147_353_2e-16);

/// π/2.
const QUARTER: Precise = Precise::new(FRAC_PI_2, 6.123_233_995_736_766e-17);

/// \[rad\] Beyond it a double hardly resolves the angle within a revolution.
const LARGE: f64 = 1e9;

/// Sine and cosine of an angle \[rad\].
pub(crate) fn sine_and_cosine(angle: f64) -> (Precise, Precise) {
    if angle.abs() > LARGE {
        let (sine, cosine) = libm::sincos(angle);
        return (sine.into(), cosine.into());
    }
    let thousandths = libm::round(angle.to_degrees() * 1e3);
    if (thousandths / 1e3).to_radians() == angle {
        let quarters = libm::round(thousandths / 9e4);
        let share = Precise::from(thousandths - 9e4 * quarters) / Precise::from(9e4);
        return turned(quarters, share * QUARTER);
    }
    of_radians(Precise::from(angle))
}

/// Sine and cosine of exactly this angle \[rad\].
fn of_radians(angle: Precise) -> (Precise, Precise) {
    let quarters = libm::round(angle.nearest() / FRAC_PI_2);
    turned(quarters, angle - QUARTER * Precise::from(quarters))
}

/// Sine and cosine of a number of quarter revolutions plus at most an eighth.
fn turned(quarters: f64, rest: Precise) -> (Precise, Precise) {
    let square = -(rest * rest);
    // Taylor series; the truncation error is below 1e-34 of the first term.
    let (mut sine, mut cosine) = (rest, Precise::ONE);
    let (mut odd, mut even) = (rest, Precise::ONE);
    for n in 1..=15_u32 {
        let n = 2.0 * f64::from(n);
        even = even * square / Precise::from((n - 1.0) * n);
        cosine = cosine + even;
        odd = odd * square / Precise::from(n * (n + 1.0));
        sine = sine + odd;
    }
    match libm::fmod(quarters, 4.0) as i32 {
        0 => (sine, cosine),
        1 | -3 => (cosine, -sine),
        2 | -2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// \[rad\] The angle of (x, y) from the x axis, from −π to π.
pub(crate) fn arctangent(y: Precise, x: Precise) -> f64 {
    let first = libm::atan2(y.nearest(), x.nearest());
    // One step of Newton.
    let (sine, cosine) = of_radians(Precise::from(first));
    let (across, along) = (y * cosine - x * sine, x * cosine + y * sine);
    if along.nearest() == 0.0 {
        return first;
    }
    (Precise::from(first) + across / along).nearest()
}
