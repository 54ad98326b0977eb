//! A watch over the energy of a run.
//!
//! `(limit, scene, energies of samples) => the first sample beyond`. For a conservative scene the magnitude of the
//! energy change from the start is watched. With dampers it is the rise above the
//! minimum so far, which no damper causes. With loads and inputs it is the magnitude of
//! the residual of the energy balance.

use std::fmt;
use std::str::FromStr;

use dbd_plant::digits::significant;
use dbd_plant::monitor::conserves_energy;
use dbd_plant::time::display;
use dbd_scene::Scene;
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

/// \[J\] A given limit: positive and finite.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct EnergyLimit(f64);

/// An invalid limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("give a positive, finite number of joules, for example 1e-3")]
pub struct EnergyLimitError;

impl EnergyLimit {
    /// \[J\].
    #[must_use]
    pub fn joules(self) -> f64 {
        self.0
    }
}

impl FromStr for EnergyLimit {
    type Err = EnergyLimitError;

    fn from_str(text: &str) -> Result<Self, EnergyLimitError> {
        let number = text.trim();
        let number = number.strip_suffix('J').map_or(number, str::trim_end);
        let limit = number.parse().ok().filter(|limit: &f64| *limit > 0.0 && limit.is_finite());
        limit.map(Self).ok_or(EnergyLimitError)
    }
}

/// The watched quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Watched {
    /// `|E − E(0)|`.
    Change,
    /// E minus the minimum of the previous samples.
    Rise,
    /// The magnitude of the residual of the energy balance.
    Balance,
}

/// A watch and its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnergyWatch {
    /// \[J\] the limit.
    pub limit: f64,
    /// The watched quantity.
    pub watched: Watched,
    /// \[J\] the largest value so far.
    pub largest: f64,
    /// \[s\] when the limit was exceeded, if it was.
    pub stopped_at: Option<f64>,
    /// \[J\] the energy at t = 0, or the minimum so far.
    #[serde(skip)]
    reference: Option<f64>,
}

impl EnergyWatch {
    /// A watch over a scene's run.
    #[must_use]
    pub fn new(scene: &Scene, limit: EnergyLimit) -> Self {
        let model = &scene.model;
        let driven = !(model.loads.is_empty() && model.inputs.is_empty());
        let watched = match driven {
            true => Watched::Balance,
            false if conserves_energy(scene) => Watched::Change,
            false => Watched::Rise,
        };
        Self { limit: limit.joules(), watched, largest: 0.0, stopped_at: None, reference: None }
    }

    /// Checks the sample at `time` \[s\]: its total energy \[J\] and the residual of its balance \[J\], if it has
    /// one.
    pub fn look(&mut self, time: f64, energy: f64, remains: Option<f64>) {
        let reference = *self.reference.get_or_insert(energy);
        let figure = match self.watched {
            Watched::Change => (energy - reference).abs(),
            Watched::Rise => {
                self.reference = Some(reference.min(energy));
                energy - reference
            }
            Watched::Balance => remains.unwrap_or(energy - reference).abs(),
        };
        self.largest = self.largest.max(figure);
        if figure > self.limit {
            self.stopped_at.get_or_insert(time);
        }
    }

    /// The reason for the end of the run, if the limit was exceeded.
    #[must_use]
    pub fn stop(&self) -> Option<EnergyStop> {
        let time = self.stopped_at?;
        Some(EnergyStop { time, figure: self.largest, limit: self.limit, watched: self.watched })
    }
}

/// A run that its watch ended.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub struct EnergyStop {
    /// \[s\] the time of the first sample beyond the limit.
    pub time: f64,
    /// \[J\] the watched quantity.
    pub figure: f64,
    /// \[J\] the limit.
    pub limit: f64,
    /// The watched quantity.
    pub watched: Watched,
}

impl EnergyStop {
    /// The remedy.
    #[must_use]
    pub fn advice(&self) -> &'static str {
        match self.watched {
            Watched::Change => "use a shorter step or another scheme",
            Watched::Balance => {
                "use a shorter step, another scheme or explicit dampers, for a smaller residual of the \
                 energy balance"
            }
            Watched::Rise => "use a shorter step or another scheme; dampers never raise the energy",
        }
    }
}

impl fmt::Display for EnergyStop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (time, figure) = (display(self.time), significant(self.figure, 4));
        let limit = significant(self.limit, 4);
        match self.watched {
            Watched::Change => {
                write!(
                    f,
                    "the total energy of the sample at t = {time} differs by {figure} J from that at t = 0"
                )?;
            }
            Watched::Rise => {
                write!(
                    f,
                    "the total energy of the sample at t = {time} is {figure} J above the previous minimum"
                )?;
            }
            Watched::Balance => {
                write!(
                    f,
                    "the work of loads, inputs and dampers leaves {figure} J of the total energy \
                     unexplained at the sample at t = {time}"
                )?;
            }
        }
        write!(f, ", beyond the limit of {limit} J")
    }
}

impl Diagnostic for EnergyStop {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.advice()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_a_positive_number() {
        for text in ["1e-3", "0.001 J", "1e-3J", "+1e-3"] {
            assert_eq!(text.parse(), Ok(EnergyLimit(1e-3)), "{text}");
        }
        for text in ["", "J", "0", "-1", "nan", "inf", "1e999", "1mJ", "0x1", "1,5", "much"] {
            assert_eq!(text.parse::<EnergyLimit>(), Err(EnergyLimitError), "{text}");
        }
    }

    #[test]
    fn a_change_counts_either_way_and_a_rise_from_the_least() {
        let watch = |watched, energies: &[f64]| {
            let mut watch = EnergyWatch {
                limit: 1.0,
                watched,
                largest: 0.0,
                stopped_at: None,
                reference: None,
            };
            for (i, energy) in energies.iter().enumerate() {
                watch.look(i as f64, *energy, None);
            }
            (watch.largest, watch.stopped_at)
        };
        assert_eq!(watch(Watched::Change, &[5.0, 4.5, 5.75]), (0.75, None));
        assert_eq!(watch(Watched::Change, &[5.0, 3.5, 5.0]), (1.5, Some(1.0)));
        assert_eq!(watch(Watched::Rise, &[5.0, 1.0, 2.0, 1.5]), (1.0, None));
        assert_eq!(watch(Watched::Rise, &[5.0, 1.0, 2.0, 0.5, 1.75, 9.0]), (8.5, Some(4.0)));
    }
}
