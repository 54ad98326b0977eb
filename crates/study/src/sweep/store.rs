//! Rows of finished cases in a folder: a case is found by its key, independent of its sweep.
//!
//! `folder, shard => rows by key; row => one more line`. Each shard has a file, `3-of-8.rows`, that one program at a
//! time appends to: a line per finished case, with its checksum first. A program that is killed, or runs into a full
//! disk, leaves at most one incomplete line, which the next one removes. If a line's checksum is wrong, the file is
//! renamed to `3-of-8.rows.damaged`, reported, and rewritten from its valid lines: only the cases of the others run
//! again. The files of all shards are read.

use std::collections::HashMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use dbd_report::output::file::PendingFile;
use dbd_scene::file;

use crate::sweep::key::{Digest, Key};
use crate::sweep::shard::Shard;

/// A file with damaged lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// The file.
    pub file: PathBuf,
    /// Its new name; `None` if another program is writing to it.
    pub aside: Option<PathBuf>,
    /// How many lines are damaged.
    pub lines: usize,
}

/// Rows of finished cases.
#[derive(Debug, Default)]
pub struct Store {
    rows: HashMap<Key, Vec<String>>,
    /// Files that were damaged.
    pub damages: Vec<Damage>,
    /// Cases of which two different rows were found: one of two machines computed wrongly.
    pub doubtful: Vec<Key>,
    own: Option<Own>,
}

/// The file that this program adds to.
#[derive(Debug)]
struct Own {
    file: File,
    /// Its length up to the last complete line.
    length: u64,
    /// Held while it is open.
    _lock: Option<File>,
}

const END: &str = ".rows";

impl Store {
    /// The rows of a folder; empty if it does not exist.
    ///
    /// # Errors
    /// If a file cannot be read, or a damaged one cannot be renamed.
    pub fn read(folder: &Path) -> io::Result<Self> {
        let mut store = Self::default();
        for path in files(folder)? {
            let lock = match lock(&path) {
                Ok(lock) => Some(lock),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => None,
                Err(error) => return Err(error),
            };
            store.take(&path, lock.is_some())?;
        }
        Ok(store)
    }

    /// The rows of an existing folder, and the file of this shard to append to.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] if another program writes to this shard's file; other errors if files cannot be
    /// read or written.
    pub fn open(folder: &Path, shard: Shard) -> io::Result<Self> {
        let path = folder.join(shard.name() + END);
        let lock = lock(&path)?;
        let mut store = Self::default();
        for other in files(folder)?.into_iter().filter(|other| *other != path) {
            let free = self::lock(&other).is_ok();
            store.take(&other, free)?;
        }
        let length = if path.exists() { store.take(&path, true)? } else { 0 };
        let file = OpenOptions::new().append(true).create(true).open(&path)?;
        // Text after the last complete line comes from a killed program.
        file.set_len(length)?;
        store.own = Some(Own { file, length, _lock: lock });
        Ok(store)
    }

    /// Reads a file's rows; returns its length up to the last complete line.
    fn take(&mut self, path: &Path, mend: bool) -> io::Result<u64> {
        let bytes = file::read(path, u64::MAX)?;
        let Lines { whole, damaged, length } = Lines::of(&bytes);
        // One reader for all lines: making one takes longer than reading a line.
        let records: String = whole.iter().map(|(_, record)| format!("{record}\n")).collect();
        let mut options = csv::ReaderBuilder::new();
        let reader = options.has_headers(false).flexible(true).from_reader(records.as_bytes());
        for ((key, _), record) in whole.iter().zip(reader.into_records()) {
            let cells: Vec<String> = record?.iter().map(str::to_owned).collect();
            match self.rows.get(key) {
                Some(known) if *known != cells => self.doubtful.push(*key),
                Some(_) => {}
                None => drop(self.rows.insert(*key, cells)),
            }
        }
        if damaged == 0 {
            return Ok(length);
        }
        let mut kept = length;
        let aside = if mend { Some(aside(path)?) } else { None };
        if let Some(aside) = &aside {
            // A copy first: if interrupted, one of the two has the valid lines.
            fs::copy(path, aside)?;
            let lines = whole.iter().map(|(key, record)| line(*key, record));
            let text: String = lines.collect();
            let folder = path.parent().unwrap_or(Path::new("."));
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let mut file = PendingFile::create(folder, &name)?;
            file.write_all(text.as_bytes())?;
            file.complete()?;
            kept = text.len() as u64;
        }
        self.damages.push(Damage { file: path.to_owned(), aside, lines: damaged });
        Ok(kept)
    }

    /// The cells of a case that is finished.
    #[must_use]
    pub fn get(&self, key: Key) -> Option<&[String]> {
        self.rows.get(&key).map(Vec::as_slice)
    }

    /// Whether a case is finished.
    #[must_use]
    pub fn holds(&self, key: Key) -> bool {
        self.rows.contains_key(&key)
    }

    /// Adds a finished case.
    ///
    /// # Errors
    /// If it cannot be written; existing rows stay intact.
    pub fn add(&mut self, key: Key, cells: &[String]) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(cells)?;
        let record = writer.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
        let record = String::from_utf8(record).map_err(io::Error::other)?;
        let record = record.trim_end_matches('\n').to_owned();
        if let Some(own) = &mut self.own {
            let line = line(key, &record);
            // In one call, so that a line is there or not.
            if let Err(error) = own.file.write_all(line.as_bytes()) {
                // The next program would also remove it.
                let _ = own.file.set_len(own.length);
                return Err(error);
            }
            own.length += line.len() as u64;
        }
        self.rows.insert(key, cells.to_vec());
        Ok(())
    }
}

/// The files of a folder in alphabetical order.
fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(error),
    };
    let mut files: Vec<PathBuf> =
        entries.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    let is_rows = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(END) && !name.starts_with('.')
    };
    files.retain(is_rows);
    files.sort();
    Ok(files)
}

/// The lock on a file of rows; `None` if the system has no locks. It is a separate file, because a damaged one is
/// replaced.
fn lock(path: &Path) -> io::Result<Option<File>> {
    let file = OpenOptions::new()
        .write(true)
        .create(true)
        .truncate(false)
        .open(path.with_extension("lock"))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::WouldBlock.into()),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// A name for a damaged file that nothing has yet.
fn aside(path: &Path) -> io::Result<PathBuf> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let candidate = |n: u32| {
        let number = if n == 1 { String::new() } else { format!("-{n}") };
        path.with_file_name(format!("{name}.damaged{number}"))
    };
    let free = (1..10_000).map(candidate).find(|path| !path.exists());
    free.ok_or_else(|| io::Error::other(format!("too many damaged copies of {}", path.display())))
}

/// The lines of a file.
struct Lines<'b> {
    whole: Vec<(Key, &'b str)>,
    damaged: usize,
    /// Where the last line ends that has an end.
    length: u64,
}

impl<'b> Lines<'b> {
    fn of(bytes: &'b [u8]) -> Self {
        let mut lines = Self { whole: Vec::new(), damaged: 0, length: 0 };
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            let Some(line_text) = line.strip_suffix(b"\n") else { break };
            match read(line_text) {
                Some(row) => lines.whole.push(row),
                None => lines.damaged += 1,
            }
            lines.length += line.len() as u64;
        }
        lines
    }
}

/// A case on a line: sum, key, cells.
fn line(key: Key, record: &str) -> String {
    let text = format!("{key} {record}");
    format!("{} {text}\n", sum(&text))
}

/// The row on a line, if it is valid.
fn read(line: &[u8]) -> Option<(Key, &str)> {
    let text = std::str::from_utf8(line).ok()?;
    let (written, text) = text.split_once(' ')?;
    // Compared as text: another spelling of the number is damage, too.
    if written != sum(text) {
        return None;
    }
    let (key, record) = text.split_once(' ')?;
    Some((Key(u128::from_str_radix(key, 16).ok()?), record))
}

/// A check sum of 64 bits, 16 hexadecimal digits.
fn sum(text: &str) -> String {
    let bits = Digest::new().with(text).bits();
    format!("{:016x}", (bits >> 64) as u64 ^ bits as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(n: u128) -> Vec<String> {
        vec!["ok".into(), format!("a, \"quoted\" {n}"), String::new(), "0.1".into()]
    }

    fn filled(folder: &Path, shard: Shard, keys: std::ops::Range<u128>) {
        let mut store = Store::open(folder, shard).unwrap();
        for n in keys {
            store.add(Key(n), &cells(n)).unwrap();
        }
    }

    fn shard(text: &str) -> Shard {
        text.parse().unwrap()
    }

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn rows_of_all_shares_are_found_again() {
        let folder = tempfile::tempdir().unwrap();
        filled(folder.path(), shard("1/2"), 0..10);
        filled(folder.path(), shard("2/2"), 5..15);
        filled(folder.path(), shard("1/2"), 20..22);
        let store = Store::read(folder.path()).unwrap();
        assert!(store.damages.is_empty() && store.doubtful.is_empty());
        for n in (0..15).chain(20..22) {
            assert_eq!(store.get(Key(n)), Some(&cells(n)[..]), "{n}");
        }
        assert!(!store.holds(Key(15)) && !store.holds(Key(22)));
        assert!(Store::read(&folder.path().join("none")).unwrap().get(Key(1)).is_none());
    }

    /// For any truncation, the rows before are kept, and appended rows are readable.
    #[test]
    fn a_line_without_an_end_is_taken_off() {
        let folder = tempfile::tempdir().unwrap();
        filled(folder.path(), Shard::WHOLE, 0..3);
        let file = folder.path().join("1-of-1.rows");
        let whole = fs::read(&file).unwrap();
        let ends: Vec<usize> =
            whole.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(at, _)| at).collect();
        for end in 0..whole.len() {
            fs::write(&file, &whole[..end]).unwrap();
            filled(folder.path(), Shard::WHOLE, 7..8);
            let store = Store::read(folder.path()).unwrap();
            assert!(store.damages.is_empty());
            let there = ends.iter().filter(|at| **at < end).count() as u128;
            for n in 0..3 {
                assert_eq!(store.holds(Key(n)), n < there, "{end}");
            }
            assert_eq!(store.get(Key(7)), Some(&cells(7)[..]));
        }
    }

    /// Whatever happens to a byte: the file is named and set aside, the other rows stay.
    #[test]
    fn a_damaged_file_is_set_aside_and_loses_the_damaged_line_alone() {
        let folder = tempfile::tempdir().unwrap();
        filled(folder.path(), Shard::WHOLE, 0..3);
        let file = folder.path().join("1-of-1.rows");
        let whole = fs::read(&file).unwrap();
        let second = whole.iter().position(|byte| *byte == b'\n').unwrap() + 1;
        let third = second + whole[second..].iter().position(|byte| *byte == b'\n').unwrap() + 1;
        for at in second..third - 1 {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << (at % 8);
            fs::write(&file, &bytes).unwrap();
            let store = Store::read(folder.path()).unwrap();
            let [damage] = &store.damages[..] else { panic!("{at}") };
            // A line that became two is two.
            assert!(damage.lines == 1 || bytes[at] == b'\n', "{damage:?}");
            let aside = damage.aside.clone().unwrap();
            assert_eq!(fs::read(&aside).unwrap(), bytes);
            assert_eq!([0, 1, 2].map(|n| store.holds(Key(n))), [true, false, true]);
            let again = Store::read(folder.path()).unwrap();
            assert!(again.damages.is_empty() && again.get(Key(2)) == Some(&cells(2)[..]));
            fs::remove_file(aside).unwrap();
        }
        assert_eq!(names(folder.path()), ["1-of-1.lock", "1-of-1.rows"]);
        // Nothing of a file that is something else.
        fs::write(&file, "neither rows\nnor sums\n").unwrap();
        filled(folder.path(), Shard::WHOLE, 4..5);
        let store = Store::read(folder.path()).unwrap();
        assert!(store.holds(Key(4)) && !store.holds(Key(0)));
        assert!(names(folder.path()).contains(&"1-of-1.rows.damaged".to_owned()));
    }

    #[test]
    fn one_program_at_a_time_adds_to_a_share() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), shard("1/2")).unwrap();
        let busy = Store::open(folder.path(), shard("1/2")).unwrap_err();
        assert_eq!(busy.kind(), io::ErrorKind::WouldBlock);
        filled(folder.path(), shard("2/2"), 0..1);
        assert!(Store::read(folder.path()).unwrap().holds(Key(0)));
        drop(store);
        assert!(Store::open(folder.path(), shard("1/2")).is_ok());
    }

    #[test]
    fn two_rows_of_one_case_that_differ_are_told() {
        let folder = tempfile::tempdir().unwrap();
        filled(folder.path(), shard("1/2"), 0..2);
        let text = line(Key(1), "another");
        fs::write(folder.path().join("2-of-2.rows"), text).unwrap();
        assert_eq!(Store::read(folder.path()).unwrap().doubtful, [Key(1)]);
    }
}
