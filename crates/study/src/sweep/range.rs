//! Values from one end to the other: linear or logarithmic.
//!
//! `(from, to, fraction) => value`. The ends are exact; values between are rounded to twelve significant digits, so
//! that a range from 0 to 1 contains 0.3 and not 0.30000000000000004, and logarithms are libm's: the same values on
//! every machine.

use dbd_plant::time::rounded;

use crate::sweep::value::Value;

/// Significant digits of computed values.
const DIGITS: usize = 12;

/// A range of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The first value.
    pub from: f64,
    /// The last one.
    pub to: f64,
    /// Whether ratios are even rather than differences; both ends are > 0 then.
    pub logarithmic: bool,
    /// Suffix of the numbers, a unit with its blank; empty for plain numbers.
    pub unit: Option<String>,
}

impl Range {
    /// The value at a fraction, 0 to 1.
    #[must_use]
    pub fn at(&self, share: f64) -> Value {
        let Self { from, to, .. } = *self;
        let number = if share <= 0.0 {
            from
        } else if share >= 1.0 {
            to
        } else if self.logarithmic {
            let [from, to] = [from, to].map(libm::log);
            rounded(libm::exp(from * (1.0 - share) + to * share), DIGITS)
        } else {
            rounded(from * (1.0 - share) + to * share, DIGITS)
        };
        match &self.unit {
            Some(unit) => Value::with_unit(number, unit),
            None => Value::number(number),
        }
    }

    /// The given number of values, including the ends.
    #[must_use]
    pub fn values(&self, count: usize) -> Vec<Value> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|i| self.at(i as f64 / last)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(range: &Range, count: usize) -> Vec<String> {
        range.values(count).into_iter().map(|value| value.cell).collect()
    }

    #[test]
    fn values_are_even_and_round() {
        let linear = Range { from: 0.0, to: 1.0, logarithmic: false, unit: None };
        assert_eq!(cells(&linear, 6), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(cells(&linear, 1), ["0.0"]);
        let decades = Range { from: 1e3, to: 1e9, logarithmic: true, unit: None };
        let expected = [
            "1000.0",
            "10000.0",
            "100000.0",
            "1000000.0",
            "10000000.0",
            "100000000.0",
            "1000000000.0",
        ];
        assert_eq!(cells(&decades, 7), expected);
        let degrees = Range { from: 90.0, to: 0.0, logarithmic: false, unit: Some(" deg".into()) };
        assert_eq!(cells(&degrees, 3), ["90.0 deg", "45.0 deg", "0.0 deg"]);
        // Wide, and with ends that no rounding may touch.
        let wide = Range { from: -1.0 / 3.0, to: f64::MAX, logarithmic: false, unit: None };
        assert_eq!(cells(&wide, 2), ["-0.3333333333333333", "1.7976931348623157e308"]);
        assert!(cells(&wide, 5).iter().all(|cell| cell.parse::<f64>().unwrap().is_finite()));
    }
}
