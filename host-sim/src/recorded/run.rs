//! A recorded run by the path that a user gives.
//!
//! `folder of a run | trace.csv | summary.json | golden file | console's log => head, rows`.

use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use dbd_scene::file::open;

use crate::recorded::golden;
use crate::recorded::head::Head;
use crate::recorded::row::Row;
use crate::recorded::trace::TraceReader;
use crate::recorded::unreadable::Unreadable;

/// The files that `run` writes.
const TRACE: &str = "trace.csv";
const SUMMARY: &str = "summary.json";

/// A recorded run.
#[derive(Debug)]
pub struct Recorded {
    /// What it is.
    pub head: Head,
    rows: Rows,
}

#[derive(Debug)]
enum Rows {
    Trace(Box<TraceReader>),
    Golden { rows: Vec<Row>, next: usize },
}

impl Recorded {
    /// Opens a recorded run.
    ///
    /// # Errors
    /// If there is no run, it cannot be read, or its head is damaged.
    pub fn open(path: &Path) -> Result<Self, Unreadable> {
        let trace = |file: &Path, summary: &Path| {
            let (head, reader) = TraceReader::open(file, summary)?;
            Ok(Self { head, rows: Rows::Trace(Box::new(reader)) })
        };
        match files(path)? {
            Files::Run { file, summary } => trace(&file, &summary),
            Files::Golden => {
                let (head, rows) = golden::read(path)?;
                Ok(Self { head, rows: Rows::Golden { rows, next: 0 } })
            }
        }
    }

    /// The next row; `None` after the last, if the run is complete.
    ///
    /// # Errors
    /// An error in the row or in the whole run.
    pub fn next_row(&mut self) -> Result<Option<&Row>, Unreadable> {
        match &mut self.rows {
            Rows::Trace(reader) => reader.next_row(),
            Rows::Golden { rows, next } => {
                *next += 1;
                Ok(rows.get(*next - 1))
            }
        }
    }
}

enum Files {
    Run { file: PathBuf, summary: PathBuf },
    Golden,
}

/// The files that a path refers to.
fn files(path: &Path) -> Result<Files, Unreadable> {
    let Ok(of) = fs::metadata(path) else {
        let missing = Unreadable::new(path, "no such file or folder");
        let meant = Path::new("out").join(path);
        let remedy = match meant.join(SUMMARY).exists() {
            true => format!("did you mean {}?", meant.display()),
            false => "give the folder of a run (out/four-bar), its trace.csv or summary.json, or a golden file".into(),
        };
        return Err(missing.with_remedy(remedy));
    };
    if of.is_dir() {
        let (file, summary) = (path.join(TRACE), path.join(SUMMARY));
        return both(path, file, summary);
    }
    if !of.is_file() {
        return Err(Unreadable::new(path, "is neither a file nor a folder"));
    }
    let beside = |name: &str| path.with_file_name(name);
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => both(path, path.to_owned(), beside(SUMMARY)),
        Some("json") => both(path, beside(TRACE), path.to_owned()),
        _ => {
            // A trace with another name would have no summary.
            let mut start = [0; 5];
            let read = open(path).and_then(|mut file| file.read(&mut start));
            read.map_err(|reason| Unreadable::system(path, &reason))?;
            match &start {
                b"time," => both(path, path.to_owned(), beside(SUMMARY)),
                _ => Ok(Files::Golden),
            }
        }
    }
}

/// The runs in the folders of a folder, a few of them.
fn below(folder: &Path) -> String {
    let folders = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut runs: Vec<String> = folders
        .filter(|folder| folder.join(SUMMARY).is_file())
        .map(|folder| folder.display().to_string())
        .collect();
    runs.sort();
    runs.truncate(4);
    runs.join(" or ")
}

/// A trace and its summary, if both exist.
fn both(called: &Path, file: PathBuf, summary: PathBuf) -> Result<Files, Unreadable> {
    let remedy = "a trace is read with the summary.json beside it, which says of what it is: precision, step, how far \
                  the run came; name the folder of a run, as `run` has written it";
    match (file.is_file(), summary.is_file()) {
        (true, true) => Ok(Files::Run { file, summary }),
        (false, false) => {
            let problem = format!("contains no run: {TRACE} and {SUMMARY} are missing");
            let meant = below(called);
            let remedy =
                if meant.is_empty() { remedy.to_owned() } else { format!("did you mean {meant}?") };
            Err(Unreadable::new(called, problem).with_remedy(remedy))
        }
        (true, false) => {
            Err(Unreadable::new(&file, format!("{SUMMARY} is missing next to it"))
                .with_remedy(remedy))
        }
        (false, true) => {
            Err(Unreadable::new(&summary, format!("{TRACE} is missing next to it"))
                .with_remedy(remedy))
        }
    }
}
