//! Logarithmic axes: positions of values, ticks and their labels.
//!
//! `(values, pixels) => axis; value => pixel`.

/// A logarithmic axis from one pixel to another.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Decimal logarithm at `from`.
    low: f64,
    /// Decimal logarithm at `to`.
    high: f64,
    from: f64,
    to: f64,
    /// [pixels] width of a label.
    spacing: f64,
}

/// A value with a grid line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Its decade's exponent.
    pub decade: i32,
    /// First digit, 1 to 9.
    pub digit: u8,
    /// Whether there is text.
    pub labelled: bool,
}

/// [decades] an axis shows at least.
const SHORTEST: f64 = 1.0;

impl Axis {
    /// An axis for all values, which are positive and finite, with free pixels at both ends; `None` without values.
    pub fn new(
        values: impl Iterator<Item = f64>,
        (from, to): (f64, f64),
        (before, after): (f64, f64),
        spacing: f64,
    ) -> Option<Self> {
        let logarithms = values.filter(|value| *value > 0.0 && value.is_finite()).map(f64::log10);
        let (mut low, mut high) = logarithms
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), l| (low.min(l), high.max(l)));
        if low > high {
            return None;
        }
        let lack = (SHORTEST - (high - low)).max(0.0);
        (low, high) = (low - lack / 2.0, high + lack / 2.0);
        let per_pixel = (high - low) / ((to - from).abs() - before - after).max(1.0);
        Some(Self {
            low: low - before * per_pixel,
            high: high + after * per_pixel,
            from,
            to,
            spacing,
        })
    }

    /// The pixel of a value; those beyond the axis at its ends.
    pub fn at(&self, value: f64) -> f64 {
        let logarithm = if value > 0.0 { value.log10() } else { f64::NEG_INFINITY };
        let share = (logarithm.clamp(self.low, self.high) - self.low) / (self.high - self.low);
        self.from + share * (self.to - self.from)
    }

    /// Whether a value lies on it.
    pub fn holds(&self, value: f64) -> bool {
        value > 0.0 && (self.low..=self.high).contains(&value.log10())
    }

    /// The same pixels for values `scale` divided by these.
    pub fn inverse(&self, scale: f64) -> Self {
        let scale = scale.log10();
        Self {
            low: scale - self.high,
            high: scale - self.low,
            from: self.to,
            to: self.from,
            ..*self
        }
    }

    /// Its grid, ascending; every decade is labelled if labels have the given pixels each.
    pub fn ticks(&self) -> Vec<Tick> {
        let (first, last) = (self.low.floor() as i32, self.high.floor() as i32);
        let decade = (self.to - self.from).abs() / (self.high - self.low);
        let stride = (self.spacing / decade).ceil().max(1.0) as i32;
        let few = self.high - self.low < 2.5;
        let mut ticks = Vec::new();
        for decade in first..=last {
            for digit in 1..=9 {
                let labelled = match digit {
                    1 => decade % stride == 0,
                    2 | 5 => few,
                    _ => false,
                };
                let tick = Tick { decade, digit, labelled };
                if self.holds(tick.value()) {
                    ticks.push(tick);
                }
            }
        }
        ticks
    }
}

impl Tick {
    /// Its value.
    pub fn value(self) -> f64 {
        f64::from(self.digit) * 10_f64.powi(self.decade)
    }

    /// With an SI prefix: `20 µm`.
    pub fn prefixed(self, unit: &str) -> String {
        const PREFIXES: [&str; 11] = ["f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"];
        let prefix = usize::try_from(self.decade.div_euclid(3) + 5).ok();
        match prefix.and_then(|prefix| PREFIXES.get(prefix)) {
            Some(prefix) => {
                let zeros = "0".repeat(self.decade.rem_euclid(3) as usize);
                format!("{}{zeros} {prefix}{unit}", self.digit).trim_end().into()
            }
            None => format!("{} {unit}", self.scientific()).trim_end().into(),
        }
    }

    /// `2e-5`.
    pub fn scientific(self) -> String {
        format!("{}e{}", self.digit, self.decade)
    }

    /// Without an exponent where that is short: `0.02`, `2000`.
    pub fn plain(self) -> String {
        match self.decade {
            0..=4 => format!("{}{}", self.digit, "0".repeat(self.decade as usize)),
            -3..=-1 => format!("0.{}{}", "0".repeat((-self.decade - 1) as usize), self.digit),
            _ => self.scientific(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_values_and_the_space_around_them() {
        let axis =
            Axis::new([1e-6, 1e-2].into_iter(), (100.0, 700.0), (100.0, 100.0), 60.0).unwrap();
        assert!((axis.at(1e-6) - 200.0).abs() < 1e-9);
        assert!((axis.at(1e-2) - 600.0).abs() < 1e-9);
        assert!((axis.at(1e-4) - 400.0).abs() < 1e-9);
        assert_eq!(axis.at(0.0).to_bits(), 100_f64.to_bits());
        // The inverse of a value lies where the value lies.
        let inverse = axis.inverse(1.0);
        assert!((inverse.at(1e4) - axis.at(1e-4)).abs() < 1e-9);
        assert!(Axis::new([0.0, f64::NAN].into_iter(), (0.0, 1.0), (0.0, 0.0), 60.0).is_none());
    }

    #[test]
    fn ticks_are_decades_and_on_a_short_axis_more() {
        let labels = |low: f64, high: f64| -> Vec<String> {
            let axis = Axis::new([low, high].into_iter(), (0.0, 600.0), (0.0, 0.0), 16.0).unwrap();
            let ticks = axis.ticks();
            assert!(ticks.windows(2).all(|two| two[0].value() < two[1].value()));
            ticks.iter().filter(|tick| tick.labelled).map(|tick| tick.prefixed("m")).collect()
        };
        assert_eq!(labels(0.9e-6, 2e-3), ["1 µm", "10 µm", "100 µm", "1 mm"]);
        assert_eq!(labels(1.9, 9.0), ["2 m", "5 m", "10 m"]);
        // Every decade while there is room.
        assert_eq!(labels(1e-15, 1e2).len(), 18);
        assert!(labels(1e-40, 1e40).len() <= 600 / 16 + 1);
        let tick = |digit, decade| Tick { decade, digit, labelled: true };
        assert_eq!(tick(2, -2).plain(), "0.02");
        assert_eq!(tick(5, 3).plain(), "5000");
        assert_eq!(tick(1, 20).prefixed("m"), "1e20 m");
    }
}
