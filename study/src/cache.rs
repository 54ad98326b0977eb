//! What is known already: one line of JSON per result, appended as it comes.
//!
//! `folder, key => file, results`. Scene, build and window have a file of their own. A survey that is
//! interrupted leaves the lines it has; the next one goes on behind the last whole one, and one that
//! is complete is read and nothing more. One survey at a time has a file.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::grid::Grid;
use crate::timing::Cost;

/// The window of a survey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// Of scene, build and options.
    pub key: u64,
    /// The times that are compared.
    pub grid: Grid,
    /// By how much a perturbation has grown at its end.
    pub growth: f64,
    /// \[m\] how far the truth's second opinion is away at most.
    pub uncertainty: f64,
    /// Whether bodies turn about more than one axis.
    pub in_space: bool,
}

impl Head {
    /// \[s\] over which trajectories are compared.
    #[must_use]
    pub fn window(&self) -> f64 {
        self.grid.window()
    }
}

/// A result, by the name of its stepper and the steps per interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Entry {
    /// The first line.
    Head(Head),
    /// How far off a way is.
    Accuracy {
        /// Its label.
        way: String,
        /// Steps per interval.
        steps: u64,
        /// Whether it came to the end.
        stable: bool,
        /// Whether it lost its way.
        lost: bool,
        /// \[m\].
        error: Option<f64>,
        /// \[J\].
        energy_rms: Option<f64>,
        /// \[J\].
        energy_peak: Option<f64>,
    },
    /// How long a step of a method may be.
    Limit {
        /// Its label.
        way: String,
        /// \[s\] the largest stable step.
        step: f64,
    },
    /// What a step of a way takes.
    Cost {
        /// Its label.
        way: String,
        /// Its time.
        cost: Cost,
    },
}

/// The results so far.
#[derive(Debug, Default)]
pub struct Cache {
    /// The window, once known.
    pub head: Option<Head>,
    /// Accuracies by label and steps per interval.
    pub accuracies: BTreeMap<(String, u64), Entry>,
    /// \[s\] largest stable steps by label.
    pub limits: BTreeMap<String, f64>,
    /// Costs by label.
    pub costs: BTreeMap<String, Cost>,
    file: Option<File>,
}

impl Cache {
    /// The results of a key that a folder holds.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] where another survey has the file; where it cannot be written.
    pub fn open(folder: &Path, key: u64) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        let path = path(folder, key);
        let mut file = options.read(true).write(true).create(true).truncate(false).open(path)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => io::ErrorKind::WouldBlock.into(),
            TryLockError::Error(error) => error,
        })?;
        let mut text = Vec::new();
        file.read_to_end(&mut text)?;
        let mut cache = Self::default();
        let mut good = 0;
        for line in text.split_inclusive(|byte| *byte == b'\n') {
            let Ok(entry) = serde_json::from_slice(line) else { break };
            let is_head = matches!(&entry, Entry::Head(head) if head.key == key);
            if !line.ends_with(b"\n") || (good == 0 && !is_head) {
                break;
            }
            cache.keep(&entry);
            good += line.len() as u64;
        }
        // What follows the last whole line is the end of a survey that was killed.
        if good < text.len() as u64 {
            file.set_len(good)?;
        }
        file.seek(SeekFrom::Start(good))?;
        cache.file = Some(file);
        Ok(cache)
    }

    /// Results that are kept nowhere.
    #[must_use]
    pub fn nowhere() -> Self {
        Self::default()
    }

    /// Adds a result.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn add(&mut self, entry: Entry) -> io::Result<()> {
        self.keep(&entry);
        match &mut self.file {
            Some(file) => append(file, &entry),
            None => Ok(()),
        }
    }

    fn keep(&mut self, entry: &Entry) {
        match entry {
            Entry::Head(head) => self.head = Some(*head),
            Entry::Accuracy { way, steps, .. } => {
                self.accuracies.insert((way.clone(), *steps), entry.clone());
            }
            Entry::Limit { way, step } => {
                self.limits.insert(way.clone(), *step);
            }
            Entry::Cost { way, cost } => {
                self.costs.insert(way.clone(), *cost);
            }
        }
    }
}

fn append(file: &mut File, entry: &Entry) -> io::Result<()> {
    let mut line = serde_json::to_string(entry).map_err(io::Error::other)?;
    // JSON has no infinity: what would not be read again is not kept.
    if serde_json::from_str::<Entry>(&line).is_err() {
        return Ok(());
    }
    line.push('\n');
    // In one call, so that a line is there or not.
    file.write_all(line.as_bytes())
}

/// The file of a key in a folder.
#[must_use]
pub fn path(folder: &Path, key: u64) -> PathBuf {
    folder.join(format!("trade-{key:016x}.cache"))
}

/// The key of a scene in this build with a longest window \[s\] and steps that divide `unit` \[s\].
#[must_use]
pub fn key(scene: &Scene, longest: f64, unit: f64) -> u64 {
    let mut hash = DefaultHasher::new();
    format!("{scene:?} {longest:?} {unit:?} {}", build()).hash(&mut hash);
    hash.finish()
}

/// What tells this build from another: size and time of the program.
fn build() -> String {
    let data = std::env::current_exe().and_then(std::fs::metadata);
    let time = |data: &std::fs::Metadata| data.modified().ok()?.duration_since(UNIX_EPOCH).ok();
    match data {
        Ok(data) => format!("{} {:?}", data.len(), time(&data)),
        Err(_) => env!("CARGO_PKG_VERSION").into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(key: u64) -> Head {
        let grid = Grid::new(1e-3, 0.1);
        Head { key, grid, growth: 3.0, uncertainty: 1e-12, in_space: true }
    }

    fn accuracy(steps: u64) -> Entry {
        let way = "leapfrog f64".into();
        let (error, energy_peak) = (Some(0.1 + 0.2), Some(1.0 / 3.0));
        let (stable, lost) = (true, false);
        Entry::Accuracy { way, steps, stable, lost, error, energy_rms: None, energy_peak }
    }

    #[test]
    fn results_are_found_again_to_the_last_bit_and_another_keys_stay() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut cache = Cache::open(folder, 7).unwrap();
        cache.add(Entry::Head(head(7))).unwrap();
        cache.add(accuracy(3)).unwrap();
        let cost = Cost { least: 1e-7 / 3.0, median: 1e-7, spread: 0.1 };
        cache.add(Entry::Cost { way: "x".into(), cost }).unwrap();
        // What JSON cannot say is known to this survey and not kept.
        let endless = Cost { least: f64::INFINITY, ..cost };
        cache.add(Entry::Cost { way: "y".into(), cost: endless }).unwrap();
        assert!(cache.costs["y"].least.is_infinite());
        drop(cache);
        let whole = std::fs::read(path(folder, 7)).unwrap();
        // The last line was not finished.
        let mut file = OpenOptions::new().append(true).open(path(folder, 7)).unwrap();
        file.write_all(b"{\"Accuracy\":{\"way\":\"leap").unwrap();
        drop(file);
        let mut cache = Cache::open(folder, 7).unwrap();
        assert_eq!(std::fs::read(path(folder, 7)).unwrap(), whole);
        assert_eq!(cache.head, Some(head(7)));
        assert_eq!(cache.accuracies.values().collect::<Vec<_>>(), [&accuracy(3)]);
        assert_eq!(cache.costs, BTreeMap::from([("x".into(), cost)]));
        cache.add(accuracy(5)).unwrap();
        drop(cache);
        assert_eq!(Cache::open(folder, 7).unwrap().accuracies.len(), 2);
        let other = Cache::open(folder, 8).unwrap();
        assert!(other.head.is_none() && other.accuracies.is_empty());
        assert_eq!(Cache::open(folder, 7).unwrap().accuracies.len(), 2);
    }

    #[test]
    fn one_survey_at_a_time_has_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::open(folder.path(), 7).unwrap();
        let error = Cache::open(folder.path(), 7).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::WouldBlock);
        assert!(Cache::open(folder.path(), 8).is_ok());
        drop(cache);
        assert!(Cache::open(folder.path(), 7).is_ok());
    }
}
