//! Stored instruction counts, which reveal the cost of a change.
//!
//! `counts, file of counts by compiler and target => verdict`. Counts differ from compiler to compiler and from
//! target to target: each pair has its own rows. Without rows, the counts are shown but not compared.

use anyhow::{Context as _, Result, bail};

use crate::command::root;

/// Permitted relative deviation of a count from the baseline.
const BAND: f64 = 0.02;

/// A file of counts.
#[derive(Clone, Copy, Debug)]
pub struct Baseline {
    /// Its path from the root.
    pub file: &'static str,
    /// The columns that name a count.
    pub names: &'static str,
    /// The command that writes it.
    pub command: &'static str,
}

/// The toolchain of the counts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// The compiler with its version.
    pub compiler: String,
    /// The target's triple.
    pub target: String,
}

/// A count: the words of its name, instructions.
pub type Count = (String, u64);

/// A row of the file.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    key: Key,
    /// Words, one per column.
    name: String,
    count: u64,
}

impl Baseline {
    /// Compares counts with those of the file.
    ///
    /// # Errors
    /// Where it cannot be read, a count is outside the band, or rows are missing.
    pub fn check(&self, key: &Key, counts: &[Count]) -> Result<()> {
        let text = std::fs::read_to_string(root().join(self.file));
        let rows = self.read(&text.with_context(|| format!("cannot read {}", self.file))?)?;
        self.check_rows(key, &rows, counts)
    }

    /// Writes counts as those of their key, beside those of others.
    ///
    /// # Errors
    /// Where reading or writing fails.
    pub fn write(&self, key: &Key, counts: &[Count]) -> Result<()> {
        let file = root().join(self.file);
        let mut rows = match std::fs::read_to_string(&file) {
            Ok(text) => self.read(&text)?,
            Err(_) => Vec::new(),
        };
        rows.retain(|row| row.key != *key);
        rows.extend(counts.iter().map(|(name, count)| Row {
            key: key.clone(),
            name: name.clone(),
            count: *count,
        }));
        let text = self.csv(&rows);
        std::fs::write(&file, text).with_context(|| format!("cannot write {}", self.file))?;
        println!("written: {}, rows of {} for {}", self.file, key.compiler, key.target);
        Ok(())
    }

    fn check_rows(&self, key: &Key, rows: &[Row], counts: &[Count]) -> Result<()> {
        let Key { compiler, target } = key;
        let names = self.names.replace(',', " ");
        let own: Vec<&Row> = rows.iter().filter(|row| row.key == *key).collect();
        if own.is_empty() {
            println!("\n{names:<50} {:>10}", "now");
            counts.iter().for_each(|(name, count)| println!("{name:<50} {count:>10}"));
            println!(
                "{} has no rows of {compiler} for {target}: the counts are shown but not compared",
                self.file
            );
            return Ok(());
        }
        println!("\n{names:<50} {:>10} {:>10} {:>9}", "baseline", "now", "change");
        let mut outside = Vec::new();
        for (name, count) in counts {
            let Some(known) = own.iter().find(|known| known.name == *name) else {
                outside.push(format!("{name} has no baseline"));
                continue;
            };
            let change = *count as f64 / known.count.max(1) as f64 - 1.0;
            println!("{name:<50} {:>10} {count:>10} {:>+7.2} %", known.count, 100.0 * change);
            if change.abs() > BAND {
                outside.push(format!("{name} changed by {:+.2} %", 100.0 * change));
            }
        }
        let counted_too = |known: &&Row| counts.iter().any(|(name, _)| *name == known.name);
        let missing = own.iter().filter(|known| !counted_too(known));
        outside.extend(missing.map(|known| format!("{} was not counted", known.name)));
        if !outside.is_empty() {
            bail!("{} (if intended: {})", outside.join("; "), self.command);
        }
        println!("all within ±{:.0} % of the baseline of {compiler} for {target}", 100.0 * BAND);
        Ok(())
    }

    fn header(&self) -> String {
        format!("compiler,target,{},instructions", self.names)
    }

    fn csv(&self, rows: &[Row]) -> String {
        let mut text = self.header() + "\n";
        for Row { key: Key { compiler, target }, name, count } in rows {
            text += &format!("{compiler},{target},{},{count}\n", name.replace(' ', ","));
        }
        text
    }

    fn read(&self, text: &str) -> Result<Vec<Row>> {
        if text.lines().next() != Some(&*self.header()) {
            bail!("the header of {} is not {}", self.file, self.header());
        }
        let row = |line: &str| {
            let columns: Vec<&str> = line.split(',').collect();
            let [compiler, target, name @ .., count] = &columns[..] else { return None };
            let is_whole = name.len() == self.names.split(',').count();
            let key = Key { compiler: (*compiler).to_owned(), target: (*target).to_owned() };
            is_whole.then_some(Row { key, name: name.join(" "), count: count.parse().ok()? })
        };
        let lines = text.lines().skip(1);
        lines.map(|line| row(line).with_context(|| format!("{}: `{line}`", self.file))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: Baseline =
        Baseline { file: "counts.csv", names: "scene,scheme", command: "cargo xtask count" };

    fn key(compiler: &str, target: &str) -> Key {
        Key { compiler: compiler.to_owned(), target: target.to_owned() }
    }

    fn here() -> Key {
        key("rustc 1.96.0", "thumbv7em-none-eabihf")
    }

    fn counts(of: [u64; 2]) -> Vec<Count> {
        ["four-bar dbd+1", "gripper leapfrog"].map(str::to_owned).into_iter().zip(of).collect()
    }

    fn rows() -> Vec<Row> {
        let row = |(name, count)| Row { key: here(), name, count };
        counts([10_000, 50_000]).into_iter().map(row).collect()
    }

    #[test]
    fn a_count_stays_in_its_band() {
        let check_rows = |of| FILE.check_rows(&here(), &rows(), &counts(of));
        assert!(check_rows([10_190, 49_010]).is_ok());
        assert!(check_rows([10_210, 50_000]).is_err());
        assert!(check_rows([10_000, 48_990]).is_err());
    }

    #[test]
    fn a_row_too_few_or_too_many_is_an_error() {
        let both = counts([10_000, 50_000]);
        assert!(FILE.check_rows(&here(), &rows(), &both[..1]).is_err());
        assert!(FILE.check_rows(&here(), &rows()[..1], &both).is_err());
    }

    #[test]
    fn a_key_without_rows_is_not_judged() {
        for other in [key("rustc 1.95.0", &here().target), key(&here().compiler, "x86_64")] {
            assert!(FILE.check_rows(&other, &rows(), &counts([1, 2])).is_ok());
        }
    }

    #[test]
    fn the_file_reads_back() {
        assert_eq!(FILE.read(&FILE.csv(&rows())).unwrap(), rows());
        assert!(FILE.read("scene\n").is_err());
        let header = FILE.header();
        for line in ["a,b,c,d,e", "a,b,c,1", "a,b,c,d,e,1"] {
            assert!(FILE.read(&format!("{header}\n{line}\n")).is_err(), "{line}");
        }
    }
}
