//! Where two runs first differ, and where one first leaves a band.

use std::fmt;

use dbd_plant::digits::significant;
use dbd_plant::time::display;
use serde::Serialize;

/// The first number that differs, in the order of a trace's columns.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct First {
    /// \[s\] the time of the first common sample that differs.
    pub time: f64,
    /// Its step in A and in B.
    pub steps: [u64; 2],
    /// The steps of the common sample before, which was equal; `None` where there is none.
    pub equal_steps: Option<[u64; 2]>,
    /// What differs: a trace's column, `turns.0`, or `state` if only the hash of all words differs.
    pub component: String,
    /// Its body.
    pub body: Option<String>,
    /// Its quantity: `position`, `orientation`, `velocity`, `angular-velocity`, `energy`, `turns`, `readout`, `state`.
    pub quantity: &'static str,
    /// Its unit; empty without one.
    pub unit: String,
    /// Its value in A and in B; a NaN is null.
    pub values: [f64; 2],
    /// How many numbers of the coarser precision lie between; `None` from a NaN.
    pub ulps: Option<u64>,
    /// How many numbers of this sample differ.
    pub differing: usize,
    /// How many were compared.
    pub numbers: usize,
}

impl fmt::Display for First {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [step, other] = self.steps;
        write!(f, "t = {}, ", display(self.time))?;
        match step == other {
            true => write!(f, "step {step}: {}", self.what()),
            false => write!(f, "step {step} of A and {other} of B: {}", self.what()),
        }
    }
}

impl First {
    /// The difference without its time.
    #[must_use]
    pub fn what(&self) -> String {
        if self.component == "state" {
            return format!(
                "the hash of the stored state, although all {} common numbers are equal",
                self.numbers
            );
        }
        let [a, b] = self.values;
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let apart = significant((b - a).abs(), 3);
        let apart = match self.ulps {
            // Values equal after rounding to the coarser precision.
            Some(0) => {
                format!(" ({apart}{unit} apart, equal when rounded to the coarser precision)")
            }
            Some(ulps) => format!(" ({apart}{unit} apart, {ulps} ULP)"),
            None => String::new(),
        };
        format!(
            "{} is {a:?}{unit} in A, {b:?}{unit} in B{apart}; {} of {} numbers differ there",
            self.component, self.differing, self.numbers
        )
    }
}

/// The first sample at which a quantity is beyond its band.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Beyond {
    /// \[s\] when.
    pub time: f64,
    /// The step in A and in B.
    pub steps: [u64; 2],
    /// The quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// The body with the largest deviation.
    pub body: Option<String>,
    /// The deviation; `None` if one is not a number.
    pub distance: Option<f64>,
    /// \[`unit`\] the band.
    pub band: f64,
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, unit, band, .. } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let of = self.body.as_ref().map(|body| format!(" of {body}")).unwrap_or_default();
        let off = match self.distance {
            Some(distance) => format!("differs by {}{unit}", significant(distance, 4)),
            None => "is a number in one run only".into(),
        };
        let time = display(self.time);
        write!(
            f,
            "t = {time}, step {}: {quantity}{of} {off}, its band is {band:?}{unit}",
            self.steps[0]
        )
    }
}
