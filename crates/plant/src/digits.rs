//! Rounded numbers for display.
//!
//! `number, digits => text`. The texts are not read back; exact values are displayed with all digits.

use crate::time::{display, rounded};

/// A number with the given count of significant digits, without trailing zeros.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.*e}", digits.max(1) - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    let last = digits as i32 - 1 - exponent;
    if (-3..digits.max(6) as i32).contains(&exponent) {
        trim(&format!("{value:.*}", usize::try_from(last).unwrap_or(0)))
    } else {
        format!("{}e{exponent}", trim(mantissa))
    }
}

/// A time with four significant digits and its unit.
#[must_use]
pub fn approximate(seconds: f64) -> String {
    display(rounded(seconds, 4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_as_many_digits_as_they_need() {
        let shown = [
            (0.0, "0"),
            (1234.5678, "1235"),
            (0.001_234_56, "0.001235"),
            (1.5e-7, "1.5e-7"),
            (-2.0e-9, "-2e-9"),
            (123_456.0, "123456"),
            (1e12, "1e12"),
            (f64::INFINITY, "inf"),
            (-0.5, "-0.5"),
        ];
        for (value, text) in shown {
            assert_eq!(significant(value, 4), text);
        }
        assert_eq!(approximate(2.897_654_3e-4), "289.8us");
    }
}
