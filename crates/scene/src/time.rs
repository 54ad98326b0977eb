//! Times on the command line and in reports: `20us`, `0.02ms`, `5e-2s`.
//!
//! `text => seconds` and back. A text is read as in a scene ([`quantity`](crate::quantity)): `20us` is the f64
//! nearest to 20e-6, the same as `0.02ms` and `2e-5`, a number of seconds; 20.0·1e-6 would differ.

use std::fmt;
use std::str::FromStr;

use crate::quantity::{dimension_of, evaluate};

/// A positive, finite time \[s\].
///
/// Displayed with the unit that gives the shortest number; the text reads back to the same bits.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Time(f64);

/// Why a text is not a time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimeError {
    /// Not a decimal number, with or without a unit.
    #[error(
        "a time is a number of seconds, or a number with a unit (s, ms, us, ns, min), for example 20us"
    )]
    Malformed,
    /// Zero, negative, or beyond the range of an f64.
    #[error("a time must be positive and finite")]
    Range,
}

impl Time {
    /// A time in seconds.
    ///
    /// # Errors
    /// [`TimeError::Range`] where it is not positive and finite.
    pub fn from_seconds(seconds: f64) -> Result<Self, TimeError> {
        if seconds > 0.0 && seconds.is_finite() { Ok(Self(seconds)) } else { Err(TimeError::Range) }
    }

    /// \[s\].
    #[must_use]
    pub fn seconds(self) -> f64 {
        self.0
    }
}

impl FromStr for Time {
    type Err = TimeError;

    fn from_str(text: &str) -> Result<Self, TimeError> {
        Self::from_seconds(seconds(text)?)
    }
}

/// \[s\] the value of a text: a number of seconds, or a value in a unit of time; of any sign.
///
/// # Errors
/// [`TimeError::Malformed`]; [`TimeError::Range`] on overflow.
pub fn seconds(text: &str) -> Result<f64, TimeError> {
    match evaluate(text) {
        Ok(time) if time.dimension.is_none() || time.dimension == dimension_of("s") => {
            Ok(time.value)
        }
        Err(fault) if fault.is_too_large => Err(TimeError::Range),
        Ok(_) | Err(_) => Err(TimeError::Malformed),
    }
}

/// Splits `-1.5e-3` into `-1.5` and −3; `None` where it is not a decimal number.
fn split_exponent(number: &str) -> Option<(&str, i32)> {
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse().ok()?),
        None => (number, 0),
    };
    let digits = mantissa.strip_prefix(['+', '-']).unwrap_or(mantissa);
    let is_decimal = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.')
        && digits.bytes().filter(|b| *b == b'.').count() <= 1
        && digits.bytes().any(|b| b.is_ascii_digit());
    is_decimal.then_some((mantissa, exponent))
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&display(self.0))
    }
}

/// A time \[s\] with the unit that gives the shortest number: `20us`, `0.5s`, `0s`.
///
/// Only the decimal exponent of the shortest text is shifted, so a positive time reads back to
/// the same bits.
#[must_use]
pub fn display(seconds: f64) -> String {
    if seconds == 0.0 || !seconds.is_finite() {
        return format!("{seconds}s");
    }
    let shortest = format!("{seconds:e}");
    let Some((mantissa, exponent)) = split_exponent(&shortest) else {
        return format!("{seconds}s");
    };
    let (unit, shift) = match exponent {
        -1.. => ("s", 0),
        -3..=-2 => ("ms", -3),
        -6..=-4 => ("us", -6),
        _ => ("ns", -9),
    };
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", mantissa),
    };
    format!("{sign}{}{unit}", place_point(&digits.replace('.', ""), exponent - shift))
}

/// A time rounded to the given number of significant digits.
#[must_use]
pub fn rounded(seconds: f64, digits: usize) -> f64 {
    format!("{seconds:.*e}", digits.max(1) - 1).parse().unwrap_or(seconds)
}

/// An upper limit of a time, rounded down to four significant digits.
#[must_use]
pub fn at_most(seconds: f64) -> f64 {
    let near = rounded(seconds, 4);
    let unit = 10_f64.powi(near.log10().floor() as i32 - 3);
    if near <= seconds { near } else { rounded(near - unit, 4) }
}

/// Writes `d.ddd·10^exponent`, given the digits without their point.
fn place_point(digits: &str, exponent: i32) -> String {
    // Beyond this a number is clearer with an exponent.
    if !(-4..=9).contains(&exponent) {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        return format!("{first}{point}{rest}e{exponent}");
    }
    let whole = usize::try_from(exponent + 1).unwrap_or(0);
    if whole == 0 {
        let zeros = usize::try_from(-exponent - 1).unwrap_or(0);
        format!("0.{}{digits}", "0".repeat(zeros))
    } else if digits.len() <= whole {
        format!("{digits}{}", "0".repeat(whole - digits.len()))
    } else {
        let (before, after) = digits.split_at(whole);
        format!("{before}.{after}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<f64, TimeError> {
        text.parse::<Time>().map(Time::seconds)
    }

    #[test]
    fn a_unit_only_shifts_the_exponent() {
        for text in [
            "20us", "20µs", "20μs", "0.02ms", "2e-5s", "2e-5", "0.00002", "20000ns", ".02ms",
            "2.e1us",
        ] {
            assert_eq!(read(text).map(f64::to_bits), Ok(2e-5_f64.to_bits()), "{text}");
        }
        assert_eq!(read("5e-2s"), Ok(0.05));
        assert_eq!(read("3"), Ok(3.0));
        assert_eq!(read("100ns"), Ok(1e-7));
        assert_eq!(read("+1E+3 ms"), Ok(1.0));
        assert_eq!(read("5min"), Ok(300.0));
        // A product would round twice and miss the nearest number.
        assert_ne!(read("20us"), Ok(20.0 * 1e-6));
    }

    #[test]
    fn what_is_not_a_time_is_refused() {
        for text in
            ["", "us", "fast", "1,5ms", "1.2.3s", "0x10s", "infs", "nans", "1e5e5s", "5m", "2 * L"]
        {
            assert_eq!(read(text), Err(TimeError::Malformed), "{text}");
        }
        for text in ["0us", "-1ms", "1e999s", "1e-999s", "0.0s", "1e-2147483648ns"] {
            assert_eq!(read(text), Err(TimeError::Range), "{text}");
        }
    }

    #[test]
    fn what_is_displayed_reads_back_to_the_same_bits() {
        let shown = [
            (2e-5, "20us"),
            (1e-3, "1ms"),
            (0.5, "0.5s"),
            (1.0, "1s"),
            (2.5e-4, "250us"),
            (1.25e-8, "12.5ns"),
            (0.02, "20ms"),
            (3600.0, "3600s"),
            (1.0 / 3.0, "0.3333333333333333s"),
        ];
        for (seconds, text) in shown {
            assert_eq!(display(seconds), text);
        }
        let mut seconds = 1.234_567_890_123e-13;
        while seconds < 1e13 {
            let text = display(seconds);
            assert_eq!(read(&text).map(f64::to_bits), Ok(seconds.to_bits()), "{text}");
            seconds *= 1.7;
        }
        assert_eq!(display(0.0), "0s");
        assert_eq!(rounded(62.0 * 2e-5, 12).to_bits(), 1.24e-3_f64.to_bits());
    }
}
