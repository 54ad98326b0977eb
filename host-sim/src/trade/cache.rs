//! What is known already: one line of JSON per result, appended as it comes.
//!
//! `file, key => results`. A survey that is interrupted leaves the lines it has; the next one of the
//! same scene and build goes on from them, and one that is complete is read and nothing more. A
//! line that is not whole is not there.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::{self, Write as _};
use std::path::Path;
use std::time::UNIX_EPOCH;

use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

/// The window of a survey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// Of scene, build and options.
    pub key: u64,
    /// \[s\] over which trajectories are compared.
    pub window: f64,
    /// By how much a perturbation has grown at its end.
    pub growth: f64,
    /// \[m\] how far the truth's second opinion is away at most.
    pub uncertainty: f64,
    /// Whether bodies turn about more than one axis.
    pub in_space: bool,
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
        /// \[m\].
        error: Option<f64>,
        /// \[J\].
        energy_rms: Option<f64>,
        /// \[J\].
        energy_peak: Option<f64>,
    },
    /// What a step of a way takes.
    Cost {
        /// Its label.
        way: String,
        /// \[s\].
        seconds: f64,
        /// A share.
        spread: f64,
    },
}

/// The results so far.
#[derive(Debug, Default)]
pub struct Cache {
    /// The window, once known.
    pub head: Option<Head>,
    /// Accuracies by label and steps per interval.
    pub accuracies: BTreeMap<(String, u64), Entry>,
    /// Costs by label.
    pub costs: BTreeMap<String, (f64, f64)>,
    file: Option<File>,
}

impl Cache {
    /// The results in a file that belong to a key; a file of another key is begun anew.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn open(path: &Path, key: u64) -> io::Result<Self> {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let entries: Vec<Entry> =
            whole.lines().map_while(|line| serde_json::from_str(line).ok()).collect();
        let mut cache = Self::default();
        if matches!(entries.first(), Some(Entry::Head(head)) if head.key == key) {
            entries.iter().for_each(|entry| cache.keep(entry));
            let mut file = OpenOptions::new().write(true).truncate(true).open(path)?;
            for entry in &entries {
                append(&mut file, entry)?;
            }
            cache.file = Some(file);
        } else {
            cache.file = Some(File::create(path)?);
        }
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
            Entry::Cost { way, seconds, spread } => {
                self.costs.insert(way.clone(), (*seconds, *spread));
            }
        }
    }
}

fn append(file: &mut File, entry: &Entry) -> io::Result<()> {
    let mut line = serde_json::to_string(entry).map_err(io::Error::other)?;
    line.push('\n');
    // In one call, so that a line is there or not.
    file.write_all(line.as_bytes())
}

/// The key of a scene in this build with a longest window \[s\].
#[must_use]
pub fn key(scene: &Scene, longest: f64) -> u64 {
    let mut hash = DefaultHasher::new();
    format!("{scene:?} {longest:?} {}", build()).hash(&mut hash);
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

    #[test]
    fn results_are_found_again_to_the_last_bit_and_another_keys_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cache");
        let head = Head { key: 7, window: 0.1, growth: 3.0, uncertainty: 1e-12, in_space: true };
        let error = Some(0.1 + 0.2);
        let accuracy = |steps| Entry::Accuracy {
            way: "leapfrog f64".into(),
            steps,
            stable: true,
            error,
            energy_rms: None,
            energy_peak: Some(1.0 / 3.0),
        };
        let mut cache = Cache::open(&path, 7).unwrap();
        cache.add(Entry::Head(head)).unwrap();
        cache.add(accuracy(3)).unwrap();
        cache.add(Entry::Cost { way: "x".into(), seconds: 1e-7 / 3.0, spread: 0.1 }).unwrap();
        // The last line was not finished.
        drop(cache);
        let mut file = OpenOptions::new().append(true).open(&path).unwrap();
        file.write_all(b"{\"Accuracy\":{\"way\":\"leap").unwrap();
        drop(file);
        let mut cache = Cache::open(&path, 7).unwrap();
        assert_eq!(cache.head, Some(head));
        assert_eq!(cache.accuracies.values().collect::<Vec<_>>(), [&accuracy(3)]);
        assert_eq!(cache.costs["x"], (1e-7 / 3.0, 0.1));
        cache.add(accuracy(5)).unwrap();
        drop(cache);
        assert_eq!(Cache::open(&path, 7).unwrap().accuracies.len(), 2);
        let other = Cache::open(&path, 8).unwrap();
        assert!(other.head.is_none() && other.accuracies.is_empty());
        assert!(std::fs::read_to_string(&path).unwrap().is_empty());
    }
}
