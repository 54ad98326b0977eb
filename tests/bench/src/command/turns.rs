//! Ways that are measured in turn.
//!
//! `(ways, rounds) => time of each in each round => least, median, spread; ratios round by round`. Each round has
//! every way once, forwards and backwards in turn: what else the machine does meets all of them, and a drift of its
//! clock cancels.

use serde::Serialize;

/// A figure of so many rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The least: other work can only lengthen a time.
    pub least: f64,
    /// The median.
    pub median: f64,
    /// Half the range of the middle half, over the median.
    pub spread: f64,
}

impl Figure {
    /// Of the values of all rounds; `None` of none, or where one is no number.
    #[must_use]
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        if values.is_empty() || values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        values.sort_by(f64::total_cmp);
        let at = |quarters: usize| values[(quarters * (values.len() - 1)).div_ceil(4)];
        Some(Self { least: values[0], median: at(2), spread: 0.5 * (at(3) - at(1)) / at(2) })
    }
}

/// Measures so many ways in so many rounds; a row of times per way. `heard` hears of each round that begins.
pub fn in_turn(
    ways: usize,
    rounds: usize,
    heard: &mut dyn FnMut(usize),
    mut measure: impl FnMut(usize) -> f64,
) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::with_capacity(rounds); ways];
    for round in 0..rounds {
        heard(round);
        for turn in 0..ways {
            let way = if round % 2 == 0 { turn } else { ways - 1 - turn };
            times[way].push(measure(way));
        }
    }
    times
}

/// What `others` take over what `own` takes, round by round.
#[must_use]
pub fn ratio(others: &[f64], own: &[f64]) -> Option<Figure> {
    Figure::of(others.iter().zip(own).map(|(other, own)| other / own).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_the_least_the_median_and_what_lies_between() {
        let figure = Figure::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]).unwrap();
        assert_eq!(figure, Figure { least: 1.0, median: 3.0, spread: 1.0 / 3.0 });
        let even = Figure::of(vec![1.0, 2.0, 3.0, 4.0]).unwrap();
        assert_eq!((even.least, even.median), (1.0, 3.0));
        assert!(Figure::of(Vec::new()).is_none() && Figure::of(vec![1.0, f64::NAN]).is_none());
    }

    #[test]
    fn rounds_go_forwards_and_backwards() {
        let (mut order, mut begun) = (Vec::new(), Vec::new());
        let times = in_turn(3, 4, &mut |round| begun.push(round), |way| {
            order.push(way);
            order.len() as f64
        });
        assert_eq!(order, [0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0]);
        assert_eq!((times[1].as_slice(), begun), (&[2.0, 5.0, 8.0, 11.0][..], vec![0, 1, 2, 3]));
    }

    /// A machine that slows down while it is measured lengthens the times, not the ratio.
    #[test]
    fn a_drift_cancels_in_the_ratio() {
        let mut slower = 1.0;
        let times = in_turn(2, 100, &mut |_| (), |way| {
            slower *= 1.01;
            slower * [1.0, 2.0][way]
        });
        let ratio = ratio(&times[1], &times[0]).unwrap();
        assert!((ratio.median - 2.0).abs() < 0.03, "{ratio:?}");
        assert!(Figure::of(times[0].clone()).unwrap().spread > 0.2);
    }
}
