//! A sweep that may begin: its file is read, its scene loaded, every axis checked.
//!
//! `(SPEC.toml, case) => row, key, report, command lines`. Nothing is written but reports.

use std::path::Path;

use dbd_study::command::quoted;
use dbd_sweep::Spec;
use dbd_sweep::cases::Cases;
use dbd_sweep::check::{CheckError, Trial as _, check};
use dbd_sweep::columns::{Column, columns};
use dbd_sweep::key::{Digest, Key};
use dbd_sweep::row::{self, Row};

use crate::commands::folder::Destination;
use crate::commands::run::{RunError, RunOptions, run};
use crate::commands::sweep::case::Bench;
use crate::commands::sweep::error::SweepError;
use crate::terminal::catalogue::is_path;
use crate::terminal::{Catalogue, Found, SceneFile};

/// What of the program makes other rows: its version and, where it was built in its repository, its sources.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("DBD_SOURCES"));

/// A sweep that may begin: its file is read and every axis checked.
pub struct Sweep {
    /// Its file, read.
    pub spec: Spec,
    /// Where that lies.
    pub file: SceneFile,
    /// Its scene.
    pub found: Found,
    /// The columns that it has figures of.
    pub columns: Vec<Column>,
    /// What a command line calls the scene.
    called: String,
    /// What messages call its file.
    name: String,
    /// The hash of all that its cases have in common.
    base: Digest,
}

impl Sweep {
    /// Reads a sweep's file and its scene, and tries every axis. Nothing is written.
    ///
    /// # Errors
    /// Where one of them is refused.
    pub fn load(catalogue: &Catalogue, path: &Path) -> Result<Self, SweepError> {
        let spec = Spec::load(path)?;
        let called = spec.scene.text.as_str();
        if called == "-" {
            let help = "a scene by name, or a path to a .toml file: each share reads it anew";
            let message = "a sweep's scene does not come from standard input";
            return Err(spec.source.refuse(spec.scene.place.clone(), message, help).into());
        }
        let beside = path.parent().unwrap_or(Path::new("")).join(called);
        let called = match is_path(called) {
            true => beside.display().to_string(),
            false => called.to_owned(),
        };
        let found = catalogue.load(&called)?;
        let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let file = SceneFile::new(stem, place.display().to_string(), &spec.source.text);
        let name = format!("{}.toml", found.file.stem);
        let bench = Bench { text: &found.text, file: &name };
        let scene = check(&spec, &bench).map_err(|error| match error {
            CheckError::Refused(refusal) => SweepError::from(refusal),
            CheckError::Scene(error) => SweepError::Load(error.into()),
        })?;
        let columns = columns(&spec, &scene)?;
        let mut base = Digest::new().with("sweep 1").with(VERSION).with(&found.text);
        for column in &columns {
            base = base.with(&column.name);
        }
        Ok(Self { spec, file, found, called, name, columns, base })
    }

    /// Whether a row has the cells of this sweep's columns.
    #[must_use]
    pub fn fits(&self, cells: &[String]) -> bool {
        cells.len() == row::length(self.columns.len())
    }

    /// The row of a case.
    #[must_use]
    pub fn run(&self, case: usize) -> Row {
        let cases = Cases::new(&self.spec);
        let bench = Bench { text: &self.found.text, file: &self.name };
        // Every combination was looked at.
        let method = cases.method(case).unwrap_or_default();
        bench.run(&cases.changes(case), &method, &self.columns)
    }

    /// Writes what `run` writes of a case below a folder; one that is refused has none.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn report(&self, case: usize, folder: &Path) -> Result<(), RunError> {
        let cases = Cases::new(&self.spec);
        let bench = Bench { text: &self.found.text, file: &self.name };
        let Ok(scene) = bench.scene(&cases.changes(case)) else { return Ok(()) };
        let stem = format!("case-{:06}", case + 1);
        let file = SceneFile { stem, ..self.found.file.clone() };
        let out = Destination { out: folder.join("reports"), file, overwrite: true };
        let options = RunOptions {
            out: Some(out),
            called: Some(self.called.clone()),
            ..RunOptions::new(cases.method(case).unwrap_or_default())
        };
        match run(&scene, &options, &mut |_, _| ()) {
            Err(error @ (RunError::Write(_) | RunError::Folder(_))) => Err(error),
            _ => Ok(()),
        }
    }

    /// Command lines: the sweep, and its first case alone.
    #[must_use]
    pub fn commands(&self, spec: &Path) -> Vec<String> {
        let cases = Cases::new(&self.spec);
        let changes = cases.changes(0);
        let set: String = changes.iter().map(|one| format!(" --set {}", quoted(one))).collect();
        let method = cases.method(0).unwrap_or_default();
        let options: [(&str, Option<String>); 5] = [
            ("scheme", Some(method.scheme_name().into())),
            ("newton", method.newton().filter(|n| *n > 0).map(|n| n.to_string())),
            ("damping", method.foreign_damping().map(|damping| damping.name().into())),
            ("precision", Some(method.precision_name().into())),
            ("orientation", Some(method.orientation_name().into())),
        ];
        let given = options.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let options: String = given.map(|(name, value)| format!(" --{name} {value}")).collect();
        vec![
            format!("host-sim sweep {}", quoted(&spec.display().to_string())),
            format!("host-sim run {}{set}{options}", quoted(&self.called)),
        ]
    }

    /// The key of a case.
    #[must_use]
    pub fn key(&self, case: usize) -> Key {
        let cases = Cases::new(&self.spec);
        let method = cases.method(case).unwrap_or_default();
        let newton = method.newton().map_or(String::new(), |newton| newton.to_string());
        let method = [
            method.scheme_name(),
            &newton,
            method.damping().name(),
            method.precision_name(),
            method.orientation_name(),
        ];
        let key = method.iter().fold(self.base, |key, word| key.with(word));
        Key(cases.changes(case).iter().fold(key, |key, change| key.with(change)).bits())
    }
}
