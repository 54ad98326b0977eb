//! The folder of a sweep's results.
//!
//! `(--out, SPEC.toml) => OUT/SPEC/{cases/, sweep.csv, sweep.html, sweep.json, reports/}`. Finished cases may belong
//! to any sweep; the table of another sweep is replaced only with --overwrite. The files appear together, `sweep.json`
//! last.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use dbd_report::output::file;
use dbd_report::output::set::FileSet;
use dbd_scene::file::read_text;
use dbd_study::sweep::shard::Shard;
use dbd_study::sweep::store::Store;
use dbd_study::sweep::table::Table;
use serde::Deserialize;

use crate::commands::folder::FolderError;
use crate::commands::sweep::error::SweepError;
use crate::commands::sweep::outcome::SweepOutcome;
use crate::terminal::SceneFile;
use crate::terminal::text::json;

/// Names of the results; the last marks the set complete and names its sweep.
const RESULTS: [&str; 4] = ["sweep.csv", PARQUET, "sweep.html", SEAL];
const PARQUET: &str = "sweep.parquet";
const SEAL: &str = "sweep.json";

/// The folders of a sweep's results.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    out: PathBuf,
    stem: String,
    /// The folder of the table.
    pub place: PathBuf,
    /// The folder of finished cases.
    pub cases: PathBuf,
}

/// The sweep as recorded with its table.
#[derive(Deserialize)]
struct Owner {
    sweep_file: String,
    sweep_hash: String,
}

impl SweepFolder {
    /// The folder of a sweep; nothing is made yet.
    ///
    /// # Errors
    /// Where it holds the table of another sweep, which is not to be replaced.
    pub fn of(out: &Path, file: &SceneFile, overwrite: bool) -> Result<Self, FolderError> {
        let place = out.join(&file.stem);
        let owner = read_text(place.join(SEAL)).ok();
        let owner: Option<Owner> = owner.and_then(|text| serde_json::from_str(&text).ok());
        if let Some(Owner { sweep_file, sweep_hash }) = owner.filter(|_| !overwrite) {
            // A copy is the same sweep, and so is a file that was moved with its results.
            let is_this = sweep_file == file.place
                || sweep_hash == file.hash
                || !Path::new(&sweep_file).exists();
            if !is_this {
                return Err(FolderError::Taken { folder: place, other: sweep_file });
            }
        }
        let cases = place.join("cases");
        Ok(Self { out: out.to_owned(), stem: file.stem.clone(), place, cases })
    }

    /// Makes the folder and opens a shard's file of finished cases. Temporary files of killed programs are removed.
    ///
    /// # Errors
    /// If they cannot be written to, or another program uses the shard.
    pub fn open(&self, shard: Shard) -> Result<Store, SweepError> {
        self.make()?;
        let reason = |reason| FolderError::Unwritable { folder: self.cases.clone(), reason };
        fs::create_dir_all(&self.cases).map_err(reason)?;
        file::sweep(&self.cases, &[&format!("{}.rows", shard.name())]);
        Store::open(&self.cases, shard).map_err(|error| match error.kind() {
            io::ErrorKind::WouldBlock => {
                SweepError::Busy { file: self.cases.join(format!("{}.rows", shard.name())) }
            }
            _ => SweepError::Write(error),
        })
    }

    fn make(&self) -> Result<(), FolderError> {
        let failed = |reason| FolderError::Unwritable { folder: self.place.clone(), reason };
        let folder = file::folder(&self.out, &self.stem).map_err(failed)?;
        file::sweep(&folder, &[&RESULTS[..], &["writable"]].concat());
        Ok(())
    }

    /// Writes the table, its page and its description.
    ///
    /// # Errors
    /// If they cannot be written; the previous files remain, or none.
    pub fn write(
        &self,
        table: &Table,
        page: &str,
        outcome: &SweepOutcome,
    ) -> Result<(), SweepError> {
        self.make()?;
        let mut files = FileSet::new(&self.place);
        let add = |files: &mut FileSet| {
            let mut file = files.begin("sweep.csv")?;
            table.csv(&mut file)?;
            files.add(file);
            #[cfg(feature = "parquet")]
            {
                let mut file = files.begin(PARQUET)?;
                dbd_study::sweep::parquet::write(table, &mut file)?;
                files.add(file);
            }
            // A file of another build does not belong to this table.
            #[cfg(not(feature = "parquet"))]
            files.without(PARQUET);
            files.write("sweep.html", page)?;
            files.write(SEAL, &json(outcome))?;
            Ok(())
        };
        let written = add(&mut files).and_then(|()| files.finish());
        written.and_then(|whole| whole.publish()).map_err(SweepError::Write)
    }
}
