//! Positions of values along a side of a drawing, and round ticks.
//!
//! `(values, logarithmic) => relative position, ticks`. Values without numbers are evenly spaced, each with a tick.

use dbd_plant::digits::significant;

use crate::plot::SI;

/// Digits of a tick.
const DIGITS: usize = 4;

/// One side of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
    /// Names instead of round numbers.
    names: Vec<String>,
    /// Its label.
    pub label: String,
}

impl Scale {
    /// A scale for these numbers; `None` if there are none. `room` adds a margin.
    #[must_use]
    pub fn of_numbers(
        values: impl Iterator<Item = f64>,
        logarithmic: bool,
        room: bool,
        label: String,
    ) -> Option<Self> {
        let drawn = |value: &f64| value.is_finite() && (!logarithmic || *value > 0.0);
        let taken = |value: f64| if logarithmic { value.log10() } else { value };
        let values: Vec<f64> = values.filter(drawn).map(taken).collect();
        let low = values.iter().copied().reduce(f64::min)?;
        let high = values.iter().copied().reduce(f64::max)?;
        // Constant values are flat, without their rounding.
        let least = (1e-6 * low.abs().max(high.abs())).max(f64::MIN_POSITIVE);
        let (mut low, mut high) = (low, high);
        if high - low < least {
            let half = if low == 0.0 { 1.0 } else { 0.05 * low.abs() };
            (low, high) = (low - half, high + half);
        } else if room {
            let padding = 0.06 * (high - low);
            (low, high) = (low - padding, high + padding);
        }
        // Ends whose distance is beyond all numbers have no picture.
        (high - low).is_finite().then(|| Self { low, high, logarithmic, names: Vec::new(), label })
    }

    /// A scale of evenly spaced names.
    #[must_use]
    pub fn of_names(names: Vec<String>, label: String) -> Self {
        let high = names.len() as f64 - 0.5;
        Self { low: -0.5, high, logarithmic: false, names, label }
    }

    /// The relative position of a value; `None` outside the scale.
    #[must_use]
    pub fn at(&self, value: f64) -> Option<f64> {
        let value = if self.logarithmic { value.log10() } else { value };
        let share = (value - self.low) / (self.high - self.low);
        (-1e-9..=1.0 + 1e-9).contains(&share).then_some(share)
    }

    /// The relative position of a value, clamped to the ends.
    #[must_use]
    pub fn clamped(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// A value with its quantity and unit: `body.cart.mass = 2 kg`; for names the value is a row.
    #[must_use]
    pub fn said(&self, value: f64) -> String {
        let (quantity, unit) = match self.label.split_once(" [") {
            Some((quantity, unit)) => (quantity, unit.trim_end_matches(']')),
            None => (self.label.as_str(), ""),
        };
        let unit = if unit == SI { "" } else { unit };
        let named = if value >= 0.0 { self.names.get(value as usize) } else { None };
        let words = named.cloned().unwrap_or_else(|| significant(value, 5).replace('-', "−"));
        format!("{quantity} = {words} {unit}").trim_end().to_owned()
    }

    /// About the given number of ticks at most: relative positions and texts.
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        if !self.names.is_empty() {
            let every = self.names.len().div_ceil(most.max(1));
            let named = self.names.iter().enumerate().step_by(every);
            let place = |row: usize| (row as f64 + 0.5) / self.names.len() as f64;
            return named.map(|(row, name)| (place(row), name.clone())).collect();
        }
        let range = self.high - self.low;
        let values: Vec<f64> = if self.logarithmic && range > 1.5 {
            let every = (range / most.max(1) as f64).ceil().max(1.0);
            multiples(self.low, self.high, every).map(|n| 10_f64.powf(n)).collect()
        } else {
            let (low, high) = match self.logarithmic {
                true => (10_f64.powf(self.low), 10_f64.powf(self.high)),
                false => (self.low, self.high),
            };
            let coarse = (high - low) / most.max(1) as f64;
            let decade = 10_f64.powf(coarse.log10().floor());
            let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * decade);
            let step = steps.into_iter().find(|step| *step >= coarse).unwrap_or(steps[3]);
            multiples(low, high, step).collect()
        };
        let tick = |value: f64| Some((self.at(value)?, shown(value, range)));
        values.into_iter().filter_map(tick).collect()
    }
}

/// The multiples of a step between two numbers, a hundred at most.
fn multiples(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let first = (low / step - 1e-9).ceil();
    let count = ((high / step + 1e-9).floor() - first).clamp(-1.0, 100.0) as i32;
    (0..=count).map(move |n| (first + f64::from(n)) * step)
}

/// A tick's number; values much smaller than the range are rounding.
fn shown(value: f64, range: f64) -> String {
    let value = if value.abs() < 1e-9 * range { 0.0 } else { value };
    significant(value, DIGITS).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(scale: &Scale, most: usize) -> Vec<String> {
        scale.ticks(most).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round() {
        let scale = |values: &[f64], logarithmic| {
            Scale::of_numbers(values.iter().copied(), logarithmic, false, String::new()).unwrap()
        };
        assert_eq!(texts(&scale(&[0.0, 1.0], false), 5), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(texts(&scale(&[1e3, 1e6], true), 5), ["1000", "10000", "100000", "1e6"]);
        assert_eq!(texts(&scale(&[2.0, 5.0], true), 4), ["2", "3", "4", "5"]);
        assert_eq!(scale(&[1e3, 1e5], true).at(1e4), Some(0.5));
        assert_eq!(scale(&[1.0, 3.0], true).at(-1.0), None);
        let names = Scale::of_names(["a", "b"].map(String::from).to_vec(), String::new());
        assert_eq!(names.ticks(9), [(0.25, "a".to_owned()), (0.75, "b".to_owned())]);
        assert_eq!(names.at(1.0), Some(0.75));
        let named = Scale { label: "body.cart.mass".into(), ..names };
        assert_eq!(named.said(1.0), "body.cart.mass = b");
        let numbered = Scale { label: "gravity [m/s²]".into(), ..scale(&[-9.81, 1.0], false) };
        assert_eq!(numbered.said(-9.81), "gravity = −9.81 m/s²");
    }

    #[test]
    fn any_numbers_have_a_scale_or_none() {
        for values in
            [&[0.0][..], &[5e-324], &[1e300, -1e300], &[3.0, 3.0 + 1e-15], &[1e-300, 1e300]]
        {
            for logarithmic in [false, true] {
                let values = values.iter().copied();
                let Some(scale) = Scale::of_numbers(values, logarithmic, true, String::new())
                else {
                    continue;
                };
                let ticks = scale.ticks(5);
                assert!(ticks.len() < 102 && ticks.iter().all(|(at, _)| (-0.1..1.1).contains(at)));
            }
        }
        assert!(Scale::of_numbers([f64::NAN].into_iter(), false, true, String::new()).is_none());
    }
}
