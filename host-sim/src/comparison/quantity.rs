//! The distance of a quantity of two runs over all common samples.
//!
//! `distances, numbers between => RMS, largest with time and body, most numbers between`.

use dbd_plant::number_format::Digits;
use serde::Serialize;

/// A quantity of two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quantity {
    /// Its name: `position`, `energy.total`, that of a read-out's column.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Root of the mean square of the distances, over samples and bodies; `None` where a number is missing in one
    /// run and not in the other.
    pub rms: Option<f64>,
    /// The largest distance, likewise.
    pub largest: Option<f64>,
    /// Its body.
    pub body: Option<String>,
    /// \[s\] its time.
    pub time: Option<f64>,
    /// Numbers of the coarser precision between the two there, of the component with the largest difference; `None` for
    /// a NaN.
    pub ulps: Option<u64>,
    /// The permitted deviation.
    pub band: Option<f64>,
    #[serde(skip)]
    sum: f64,
    #[serde(skip)]
    count: u64,
}

impl Quantity {
    /// A quantity without samples.
    #[must_use]
    pub fn new(name: &str, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            rms: Some(0.0),
            largest: Some(0.0),
            body: None,
            time: None,
            ulps: Some(0),
            band: None,
            sum: 0.0,
            count: 0,
        }
    }

    /// Whether it was the same in every sample.
    #[must_use]
    pub fn is_equal(&self) -> bool {
        self.time.is_none()
    }

    /// Adds the distance at a sample; a NaN counts as larger than any.
    pub(super) fn push(&mut self, distance: f64, time: f64, body: Option<&str>, ulps: Option<u64>) {
        self.count += 1;
        self.sum += distance * distance;
        self.rms = Some((self.sum / self.count as f64).sqrt()).filter(|rms| rms.is_finite());
        let larger = self.largest.is_some_and(|largest| {
            let within = distance <= largest;
            !within
        });
        if larger {
            self.largest = Some(distance).filter(|distance| distance.is_finite());
            self.body = body.map(str::to_owned);
            self.time = Some(time);
            self.ulps = ulps;
        }
    }
}

/// How many numbers lie between two, counted in the coarser of two precisions; `None` for a NaN.
#[must_use]
pub fn ulps(digits: [Digits; 2], values: [f64; 2]) -> Option<u64> {
    let [a, b] = values;
    match digits.contains(&Digits::Single) {
        true => {
            let [a, b] = [a, b].map(|value| f64::from(value as f32));
            dbd_golden::Digits::Single.ulps(a, b)
        }
        false => dbd_golden::Digits::Double.ulps(a, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantity_keeps_its_largest_and_its_mean() {
        let mut quantity = Quantity::new("position", "m");
        assert!(quantity.is_equal());
        for (distance, time, body) in
            [(0.0, 0.0, "a"), (3.0, 1.0, "a"), (4.0, 1.0, "b"), (1.0, 2.0, "a")]
        {
            quantity.push(distance, time, Some(body), Some(distance as u64));
        }
        assert_eq!((quantity.rms, quantity.largest), (Some(6.5_f64.sqrt()), Some(4.0)));
        assert_eq!((quantity.body.as_deref(), quantity.time), (Some("b"), Some(1.0)));
        assert_eq!(quantity.ulps, Some(4));
        quantity.push(f64::INFINITY, 3.0, None, None);
        quantity.push(9.0, 4.0, None, Some(9));
        assert_eq!((quantity.rms, quantity.largest, quantity.time), (None, None, Some(3.0)));
    }

    #[test]
    fn numbers_are_counted_in_the_coarser_precision() {
        let (single, double) = (Digits::Single, Digits::Double);
        let third = 1.0 / 3.0;
        assert_eq!(ulps([single, double], [f64::from(third as f32), third]), Some(0));
        assert_eq!(ulps([double, double], [1.0, 1.0 + f64::EPSILON]), Some(1));
        assert_eq!(ulps([single, single], [1.0, 1.0 + f64::from(f32::EPSILON)]), Some(1));
        assert_eq!(ulps([double, double], [1.0, f64::NAN]), None);
    }
}
