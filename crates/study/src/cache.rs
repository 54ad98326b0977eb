//! Cached results: one line per result, a checksum and JSON, appended as they arrive.
//!
//! `folder, key => file, results`. There is one file per scene, build and window. An interrupted study leaves its
//! lines; the next one continues after the last complete line, and a complete file is only read. A line whose checksum
//! does not match its text and the key, and all lines after it, come from a damaged disk or another scene and are
//! ignored. A file is locked by one study at a time.

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
use crate::variants::Compared;

/// The window of a survey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// Of scene, build and options.
    pub key: u64,
    /// The times that are compared.
    pub grid: Grid,
    /// By how much a perturbation has grown at its end.
    pub growth: f64,
    /// \[m\] largest distance between the reference solution and that of the second integrator.
    pub uncertainty: f64,
    /// Whether bodies rotate about more than one axis.
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
    /// Error of a method.
    Accuracy {
        /// Its label.
        way: String,
        /// Steps per interval.
        steps: u64,
        /// Whether it came to the end.
        stable: bool,
        /// Whether it is lost.
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
    /// The scene and its variants.
    Variants(Vec<Compared>),
    /// Cost of a step of a method.
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
    /// The scene and its variants, once known.
    pub variants: Option<Vec<Compared>>,
    /// Its file and key.
    file: Option<(File, u64)>,
}

impl Cache {
    /// The results of a key in a folder.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] if another study has the file; other errors if it cannot be written.
    pub fn open(folder: &Path, key: u64) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        let path = path(folder, key);
        if path.exists() && !path.is_file() {
            return Err(io::Error::other(format!("{} is not a regular file", path.display())));
        }
        let mut file = options.read(true).write(true).create(true).truncate(false).open(path)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => io::ErrorKind::WouldBlock.into(),
            TryLockError::Error(error) => error,
        })?;
        let mut text = Vec::new();
        file.read_to_end(&mut text)?;
        let (mut cache, good) = Self::read(key, &text);
        // Text after the last complete line comes from a killed study, or damage.
        if good < text.len() as u64 {
            file.set_len(good)?;
        }
        file.seek(SeekFrom::Start(good))?;
        cache.file = Some((file, key));
        Ok(cache)
    }

    /// The results of a key in a file's bytes, and their length in bytes.
    fn read(key: u64, text: &[u8]) -> (Self, u64) {
        let mut cache = Self::default();
        let mut good = 0;
        for line in text.split_inclusive(|byte| *byte == b'\n') {
            let Some(entry) = read(key, line) else { break };
            let is_head = matches!(&entry, Entry::Head(head) if head.key == key);
            if good == 0 && !is_head {
                break;
            }
            cache.keep(&entry);
            good += line.len() as u64;
        }
        (cache, good)
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
            Some((file, key)) => append(file, *key, &entry),
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
            Entry::Variants(all) => self.variants = Some(all.clone()),
            Entry::Cost { way, cost } => {
                self.costs.insert(way.clone(), *cost);
            }
        }
    }
}

/// The result on a line, if it is complete and of this key.
fn read(key: u64, line: &[u8]) -> Option<Entry> {
    let text = std::str::from_utf8(line.strip_suffix(b"\n")?).ok()?;
    let (sum, json) = text.split_once(' ')?;
    // Compared as text: another spelling of the number is damage, too.
    if sum != check_sum(key, json) {
        return None;
    }
    serde_json::from_str(json).ok()
}

/// FNV-1a 64 of a key and a text, 16 hexadecimal digits: no byte can change and leave it as it is.
fn check_sum(key: u64, text: &str) -> String {
    let bytes = key.to_le_bytes().into_iter().chain(text.bytes());
    let sum = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{sum:016x}")
}

fn append(file: &mut File, key: u64, entry: &Entry) -> io::Result<()> {
    let json = serde_json::to_string(entry).map_err(io::Error::other)?;
    // JSON has no infinity: values that cannot be read back are not stored.
    if serde_json::from_str::<Entry>(&json).is_err() {
        return Ok(());
    }
    let line = format!("{} {json}\n", check_sum(key, &json));
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

/// Identity of this build: size and time of the program.
#[must_use]
pub fn build() -> String {
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
        // Values without a JSON representation are kept in memory only.
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

    /// For any damaged byte or truncation, only written results are read.
    #[test]
    fn a_damaged_file_gives_no_wrong_result() {
        let folder = tempfile::tempdir().unwrap();
        let mut cache = Cache::open(folder.path(), 7).unwrap();
        cache.add(Entry::Head(head(7))).unwrap();
        let cost = Cost { least: 1e-7, median: 1e-7, spread: 0.1 };
        cache.add(Entry::Cost { way: "x".into(), cost }).unwrap();
        cache.add(accuracy(3)).unwrap();
        drop(cache);
        let whole = std::fs::read(path(folder.path(), 7)).unwrap();
        let read = |bytes: &[u8]| {
            let (cache, good) = Cache::read(7, bytes);
            assert!(cache.head.is_none_or(|found| found == head(7)));
            assert!(cache.costs.values().all(|found| *found == cost));
            assert!(cache.accuracies.values().all(|found| *found == accuracy(3)));
            let found =
                [usize::from(cache.head.is_some()), cache.costs.len(), cache.accuracies.len()];
            assert!(whole.starts_with(&bytes[..good as usize]));
            found
        };
        assert_eq!(read(&whole), [1, 1, 1]);
        let lines: Vec<&[u8]> = whole.split_inclusive(|byte| *byte == b'\n').collect();
        let begin_of_last = lines[0].len() + lines[1].len();
        for at in 0..whole.len() {
            for bit in 0..8 {
                let mut bytes = whole.clone();
                bytes[at] ^= 1 << bit;
                assert_eq!(read(&bytes)[2], 0, "bit {bit} of byte {at}");
            }
            assert_eq!(
                read(&whole[..at]),
                [usize::from(at >= lines[0].len()), usize::from(at >= begin_of_last), 0]
            );
        }
        // Lines of other types, of another key, in another order, without their sums.
        let retyped = String::from_utf8(lines[2].to_vec()).unwrap().replace("3,", "\"3\",");
        let other = format!("{} {}", check_sum(8, "{}"), "{}\n");
        let bare = [lines[0], &lines[1][17..]].concat();
        for bytes in [
            [lines[0], retyped.as_bytes()].concat(),
            [lines[0], other.as_bytes()].concat(),
            [lines[1], lines[0], lines[2]].concat(),
            [&[0; 64], whole.as_slice()].concat(),
            bare,
            vec![0xff; 100],
        ] {
            assert_eq!(read(&bytes)[1..], [0, 0]);
        }
        // The file of another scene under this one's name.
        let mut other = Cache::open(folder.path(), 8).unwrap();
        other.add(Entry::Head(head(8))).unwrap();
        other.add(accuracy(5)).unwrap();
        drop(other);
        assert_eq!(read(&std::fs::read(path(folder.path(), 8)).unwrap()), [0, 0, 0]);
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
