//! A watch over the energy of a run.
//!
//! `(limit, scene, energies of samples) => the first sample beyond`. Where nothing gives or takes energy
//! its change from the start is watched, either way. Dampers take some: then it is the rise above
//! the least so far, which no damper makes. Loads and inputs give and take: then it is what the
//! energy balance leaves unexplained, either way.

use std::fmt;
use std::str::FromStr;

use dbd_plant::digits::significant;
use dbd_plant::judge::conserves_energy;
use dbd_plant::time::display;
use dbd_scene::Scene;
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

/// \[J\] A limit that was asked for: positive and finite.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct EnergyLimit(f64);

/// Why a text is no limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("a limit is a positive, finite number of joules, for example 1e-3")]
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

/// What of the total energy is watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Watched {
    /// `|E − E(0)|`.
    Change,
    /// E less the least of the samples before.
    Rise,
    /// The magnitude of what the energy balance leaves unexplained.
    Balance,
}

/// A watch and what it saw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnergyWatch {
    /// \[J\] what is allowed.
    pub limit: f64,
    /// What of.
    pub watched: Watched,
    /// \[J\] the most that was seen.
    pub largest: f64,
    /// \[s\] when it was beyond the limit, if it was.
    pub stopped_at: Option<f64>,
    /// \[J\] at t = 0, or the least so far.
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

    /// Looks at the sample at `time` \[s\]: its total energy \[J\], and what its balance, if it has one, leaves
    /// unexplained \[J\].
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

    /// What ended the run, where the energy was beyond the limit.
    #[must_use]
    pub fn stop(&self) -> Option<EnergyStop> {
        let time = self.stopped_at?;
        Some(EnergyStop { time, figure: self.largest, limit: self.limit, watched: self.watched })
    }
}

/// A run that its watch ended.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub struct EnergyStop {
    /// \[s\] the time of the first sample beyond.
    pub time: f64,
    /// \[J\] how large what is watched was.
    pub figure: f64,
    /// \[J\] what was allowed.
    pub limit: f64,
    /// What was watched.
    pub watched: Watched,
}

impl EnergyStop {
    /// What helps.
    #[must_use]
    pub fn advice(&self) -> &'static str {
        match self.watched {
            Watched::Change => "a shorter step or another scheme keeps the energy closer",
            Watched::Balance => {
                "a shorter step, another scheme or explicit dampers keep the energy closer to what \
                 loads, inputs and dampers give and take"
            }
            Watched::Rise => "a shorter step or another scheme; no damper raises the energy",
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
                    "the total energy of the sample at t = {time} is {figure} J off that at t = 0"
                )?;
            }
            Watched::Rise => {
                write!(
                    f,
                    "the total energy of the sample at t = {time} is {figure} J above the least before"
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
