//! The origin of measured data, to detect data older than their sources.
//!
//! `data file => docs/results/provenance.csv: commit, date, its own fingerprint, that of its sources`. Measuring
//! commands record their files here; `cargo xtask test` fails if a file was changed without a record, or if its
//! sources have changed since. Counts on the target depend on the sample that every test recounts, figures of
//! motion on the golden bits, proofs on the proved sources. Stale data that are kept
//! (`cargo xtask provenance --stale`) are marked below each of their tables.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};

use crate::command::{output, program, root};

const FILE: &str = "docs/results/provenance.csv";
const HEAD: &str = "file,commit,date,own,stands_on,stale\n";

const SAMPLE: &[&str] = &["docs/costs-baseline.csv"];
const INSTRUCTIONS: &[&str] = &["docs/instructions-baseline.csv"];
const BITS: &[&str] = &["tests/bits/hashes.csv", "tests/bits/fixed.csv"];
const NUMBERS: &[&str] = &[
    "kernel/src/arctangent.rs",
    "kernel/src/fixed",
    "kernel/src/real.rs",
    "kernel/src/square_root.rs",
];
const ADVICE: &str = "cargo test --release -p dbd-tests --test trade advice_of_all -- --ignored, then cargo xtask provenance";
const SURVEY: &str = "host-sim trade, DBD_COLLECT (docs/trade.md), then cargo xtask provenance";

/// A file of data.
#[derive(Clone, Copy, Debug)]
struct Data {
    file: &'static str,
    /// Files and folders: if one of them has changed, the data are stale.
    stands_on: &'static [&'static str],
    /// The command that measures it again.
    command: &'static str,
}

const fn data(
    file: &'static str,
    stands_on: &'static [&'static str],
    command: &'static str,
) -> Data {
    Data { file, stands_on, command }
}

const DATA: [Data; 19] = [
    data("docs/costs.csv", SAMPLE, "cargo xtask cost"),
    data("docs/costs-mix.csv", SAMPLE, "cargo xtask cost"),
    data("docs/results/guards.csv", SAMPLE, "cargo xtask cost --guards"),
    data("docs/results/elements.csv", SAMPLE, "cargo xtask cost --elements"),
    data("docs/results/cores.csv", SAMPLE, "cargo xtask cost --cores"),
    data("docs/results/instructions.csv", INSTRUCTIONS, "cargo xtask instructions --baseline"),
    data("docs/results/bench.json", INSTRUCTIONS, "cargo xtask bench"),
    data("docs/results/ensembles.csv", INSTRUCTIONS, "cargo xtask bench"),
    // The test looks at how work grows with smaller chains, and how it does is what matters.
    data("docs/results/growth.csv", &[], "cargo xtask growth"),
    data("docs/results/bits.csv", BITS, "cargo xtask bits"),
    data("docs/results/precisions.csv", BITS, "cargo xtask precisions"),
    data("docs/results/trade.csv", BITS, SURVEY),
    data("docs/results/timing.csv", BITS, SURVEY),
    data("docs/results/precisions-on-chip.csv", BITS, SURVEY),
    data("docs/results/advice.csv", BITS, ADVICE),
    data("docs/results/real-time.csv", BITS, "cargo xtask real-time"),
    data("docs/results/peers.csv", BITS, "docs/validation/peers.py, then cargo xtask provenance"),
    data("docs/results/proof.csv", NUMBERS, "cargo xtask prove"),
    // Other programs, with their versions in the rows.
    data("docs/results/engines.csv", &[], "see its head, then cargo xtask provenance"),
];

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Note {
    commit: String,
    date: String,
    own: String,
    stands_on: String,
    /// That for which it is kept although it is stale; empty where it is not.
    stale: String,
}

type Notes = BTreeMap<String, Note>;

/// The step of `cargo xtask test`.
///
/// # Errors
/// Where a file has no note, was changed without one, or is stale, or a page's table was written from older data; each
/// with the command that renews it.
pub fn check() -> Result<()> {
    let text = std::fs::read_to_string(root().join(FILE))
        .with_context(|| format!("cannot read {FILE}"))?;
    let notes = read(&text);
    let mut faults = faults(&DATA, &notes, &present)?;
    for page in pages()? {
        let text = std::fs::read_to_string(&page)
            .with_context(|| format!("cannot read {}", page.display()))?;
        let name = page.strip_prefix(root()).unwrap_or(&page).display().to_string();
        faults.extend(older_tables(&name, &text, &notes));
    }
    if !faults.is_empty() {
        bail!("{}", faults.join("\n"));
    }
    println!("{} data files match the present sources", DATA.len());
    Ok(())
}

/// `cargo xtask provenance --stale FILE…`: keeps files as they are although what they stand on has changed, or only some of
/// their rows were measured anew; their tables say so.
///
/// # Errors
/// Where one has no row, or the table cannot be written.
pub fn keep(files: &[impl AsRef<str>]) -> Result<()> {
    let mut notes = read(&std::fs::read_to_string(root().join(FILE)).unwrap_or_default());
    for file in files.iter().map(AsRef::as_ref) {
        let data = DATA.iter().find(|data| data.file == file);
        let data = data.with_context(|| format!("{file} is not a data file"))?;
        let note = notes
            .get_mut(file)
            .with_context(|| format!("{file} has no record of its measurement"))?;
        note.own = present(&[data.file])?;
        note.stale = present(data.stands_on)?;
    }
    write(&notes)
}

/// `cargo xtask provenance FILE…`: notes files as measured now.
///
/// # Errors
/// Where one is no file of data, or the table cannot be written.
pub fn note(files: &[impl AsRef<str>]) -> Result<()> {
    let mut notes = read(&std::fs::read_to_string(root().join(FILE)).unwrap_or_default());
    let commit = output(program("git").args(["log", "-1", "--format=%h,%cs"]))?;
    let (commit, date) = commit.trim().split_once(',').context("git printed no commit")?;
    for file in files.iter().map(AsRef::as_ref) {
        let data = DATA.iter().find(|data| data.file == file);
        let data = data.with_context(|| format!("{file} is not a data file"))?;
        let note = Note {
            commit: commit.to_owned(),
            date: date.to_owned(),
            own: present(&[file])?,
            stands_on: present(data.stands_on)?,
            stale: String::new(),
        };
        notes.insert(file.to_owned(), note);
    }
    write(&notes)
}

fn write(notes: &Notes) -> Result<()> {
    let row = |(file, note): (&String, &Note)| {
        let Note { commit, date, own, stands_on, stale } = note;
        format!("{file},{commit},{date},{own},{stands_on},{stale}\n")
    };
    let text = HEAD.to_owned() + &notes.iter().map(row).collect::<String>();
    std::fs::write(root().join(FILE), text).with_context(|| format!("cannot write {FILE}"))
}

fn read(text: &str) -> Notes {
    let row = |line: &str| {
        let words: Vec<String> = line.split(',').map(str::to_owned).collect();
        let [file, commit, date, own, stands_on, stale] = <[String; 6]>::try_from(words).ok()?;
        Some((file, Note { commit, date, own, stands_on, stale }))
    };
    text.lines().skip(1).filter_map(row).collect()
}

/// The pages with tables.
fn pages() -> Result<Vec<PathBuf>> {
    let mut files = vec![root().join("README.md")];
    list(&root().join("docs"), &mut files)?;
    files.retain(|file| file.extension().is_some_and(|ending| ending == "md"));
    Ok(files)
}

/// The tables of a page that were written from other data than those noted.
fn older_tables(page: &str, text: &str, notes: &Notes) -> Vec<String> {
    let lines = text.lines().filter(|line| line.starts_with("Data: "));
    let older = |line: &str, (file, note): (&String, &Note)| {
        let name = file.rsplit('/').next().unwrap_or(file);
        let named = line.contains(&format!(" {name} of "));
        let Note { commit, date, stale, .. } = note;
        let end = if stale.is_empty() { ")" } else { ", stale)" };
        let fresh = line.contains(&format!(" {name} of {commit} ({date}{end}"));
        (named && !fresh).then(|| {
            format!("{page}: a table has older data of {file} than those noted: cargo xtask tables")
        })
    };
    let of_line = |line| notes.iter().filter_map(move |note| older(line, note));
    lines.flat_map(of_line).collect()
}

fn faults(
    all: &[Data],
    notes: &Notes,
    present: &dyn Fn(&[&str]) -> Result<String>,
) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for Data { file, stands_on, command } in all {
        let Some(note) = notes.get(*file) else {
            faults.push(format!("{file} has no row in {FILE}: {command}"));
            continue;
        };
        let Note { commit, date, .. } = note;
        if note.own != present(&[file])? {
            faults.push(format!("{file} was changed since it was measured ({date}): {command}"));
        }
        let now = present(stands_on)?;
        if note.stands_on != now && note.stale != now {
            let on = stands_on.join(", ");
            faults.push(format!(
                "{file} is stale: measured at {commit} ({date}), and {on} changed since: {command}; or \
                 cargo xtask provenance --stale {file}"
            ));
        }
    }
    Ok(faults)
}

/// FNV-1a 64 of files and of those in folders, in the order of their names; of sources without comments and unit tests,
/// which measure nothing.
fn present(paths: &[&str]) -> Result<String> {
    let mut files = Vec::new();
    for path in paths {
        list(&root().join(path), &mut files)?;
    }
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    files.retain(|file| file.file_name().is_none_or(|name| name != "tests.rs"));
    for file in files {
        let text = std::fs::read_to_string(&file)
            .with_context(|| format!("cannot read {}", file.display()))?;
        let source = file.extension().is_some_and(|extension| extension == "rs");
        for line in text.lines().map(str::trim) {
            if source && line.starts_with("//") {
                continue;
            }
            for byte in line.bytes().chain([b'\n']) {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
    }
    Ok(format!("{hash:016x}"))
}

fn list(path: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    if !path.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    let entries = std::fs::read_dir(path)?.map(|entry| Ok(entry?.path()));
    let mut entries = entries.collect::<Result<Vec<_>>>()?;
    entries.sort();
    entries.iter().try_for_each(|entry| list(entry, files))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Data; 2] = [data("a.csv", &["b.csv"], "measure a"), data("c.csv", &[], "do c")];

    fn noted(own: &str, stands_on: &str) -> Notes {
        read(&format!("{HEAD}a.csv,abc1234,2026-11-25,{own},{stands_on}\nc.csv,d,e,c.csv,,\n"))
    }

    fn found(notes: &Notes) -> Vec<String> {
        faults(&ALL, notes, &|paths| Ok(paths.join("+"))).unwrap()
    }

    #[test]
    fn data_that_are_as_noted_have_no_fault() {
        assert!(found(&noted("a.csv", "b.csv,")).is_empty());
    }

    #[test]
    fn stale_changed_and_unknown_data_are_named_with_their_command() {
        let stale = found(&noted("a.csv", "another,"));
        assert!(
            stale.len() == 1 && stale[0].contains("a.csv is stale: measured at abc1234"),
            "{stale:?}"
        );
        assert!(stale[0].contains("b.csv changed since: measure a; or "), "{stale:?}");
        assert!(found(&noted("a.csv", "another,b.csv")).is_empty(), "it is kept");
        assert!(!found(&noted("a.csv", "another,one more")).is_empty(), "it changed again");
        let changed = found(&noted("another", "b.csv,"));
        assert!(changed.len() == 1 && changed[0].contains("was changed since"), "{changed:?}");
        assert_eq!(found(&Notes::new()).len(), 2);
    }

    #[test]
    fn a_table_of_older_data_is_named() {
        let notes = noted("a.csv", "b.csv,");
        let found = |line: &str| older_tables("docs/x.md", line, &notes);
        assert!(found("Data: a.csv of abc1234 (2026-11-25), c.csv of d (e).").is_empty());
        assert!(found("Prose: a.csv of another (2026-11-20).").is_empty());
        let older = found("Data: c.csv of d (e), a.csv of abc1230 (2026-11-20).");
        assert!(older.len() == 1 && older[0].contains("docs/x.md: a table has older"), "{older:?}");
        assert_eq!(found("Data: a.csv of abc1234 (2026-11-25, stale).").len(), 1);
        let kept = noted("a.csv", "b.csv,b.csv");
        let marked = "Data: a.csv of abc1234 (2026-11-25, stale).";
        assert!(older_tables("docs/x.md", marked, &kept).is_empty());
    }

    #[test]
    fn every_file_of_data_is_there_and_so_is_what_it_stands_on() {
        for data in DATA {
            assert!(present(&[data.file]).is_ok(), "{}", data.file);
            assert!(present(data.stands_on).is_ok(), "{}", data.file);
        }
    }
}
