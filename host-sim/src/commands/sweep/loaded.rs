//! A sweep that may begin: its file is read, its scene loaded, every axis checked.
//!
//! `(SPEC.toml, case) => row, key, report, command lines`. Nothing is written but reports.

use std::collections::HashMap;
use std::path::Path;

use dbd_kernel::GeneralizedAlpha;
use dbd_plant::Method;
use dbd_scene::SceneText;
use dbd_study::command::quoted;
use dbd_study::sweep::Spec;
use dbd_study::sweep::cases::Cases;
use dbd_study::sweep::check::{CheckError, check};
use dbd_study::sweep::columns::{Column, columns};
use dbd_study::sweep::key::{Digest, Key};
use dbd_study::sweep::row::{self, Row};

use crate::commands::folder::Destination;
use crate::commands::run::{RunError, RunOptions, run};
use crate::commands::sweep::case::Bench;
use crate::commands::sweep::error::SweepError;
use crate::simulate::lanes;
use crate::terminal::catalogue::is_path;
use crate::terminal::{Catalogue, Found, SceneFile};

/// The program's part of the key of a row: its version and, if built in its repository, its sources.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("DBD_SOURCES"));

/// The changes that set sampling and duration of a case.
const PLAN: [&str; 3] = ["step=", "duration=", "every="];

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
    /// The scene's name on the command line.
    called: String,
    /// Its file's name in messages.
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
            let help = "give a scene by name or a path to a .toml file: each shard reads it again";
            let message = "the scene of a sweep cannot come from standard input";
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
        let text =
            SceneText::parse(&found.text, &name).map_err(|error| SweepError::Load(error.into()))?;
        let scene = check(&spec, &Bench { text: &text }).map_err(|error| match error {
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

    /// The parsed text of its scene.
    ///
    /// # Errors
    /// None for a sweep that was loaded.
    pub fn text(&self) -> Result<SceneText<'_>, SweepError> {
        SceneText::parse(&self.found.text, &self.name)
            .map_err(|error| SweepError::Load(error.into()))
    }

    /// Whether a row has the cells of this sweep's columns.
    #[must_use]
    pub fn fits(&self, cells: &[String]) -> bool {
        cells.len() == row::length(self.columns.len())
    }

    /// The rows of cases, as many at once as [`Self::parts`] puts together.
    #[must_use]
    pub fn run(&self, text: &SceneText<'_>, cases: &[usize]) -> Vec<Row> {
        let all = Cases::new(&self.spec);
        let bench = Bench { text };
        // Every combination was checked.
        let case = |case: &usize| (all.changes(*case), all.method(*case).unwrap_or_default());
        bench.run(&cases.iter().map(case).collect::<Vec<_>>(), &self.columns)
    }

    /// Cases in batches, so that those of one method and step can run in lockstep: as many as there are
    /// lanes, fewer if some threads would be idle.
    #[must_use]
    pub fn parts(&self, cases: &[usize], threads: usize) -> Vec<Vec<usize>> {
        let all = Cases::new(&self.spec);
        let fair = cases.len().div_ceil(threads.max(1));
        let mut parts: Vec<Vec<usize>> = Vec::new();
        // The incomplete batch of each kind.
        let mut open: HashMap<Vec<String>, usize> = HashMap::new();
        for case in cases {
            let method = all.method(*case).unwrap_or_default();
            let most = lanes(&method).min(fair).max(1);
            let of_plan = |change: &String| PLAN.iter().any(|key| change.starts_with(key));
            let changes = all.changes(*case).into_iter().filter(of_plan);
            let kind: Vec<String> = words(&method).into_iter().chain(changes).collect();
            let part = *open.entry(kind.clone()).or_insert(parts.len());
            if part == parts.len() {
                parts.push(Vec::with_capacity(most));
            }
            parts[part].push(*case);
            if parts[part].len() >= most {
                open.remove(&kind);
            }
        }
        parts
    }

    /// Writes what `run` writes of a case below a folder; one that is refused has none.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn report(&self, text: &SceneText<'_>, case: usize, folder: &Path) -> Result<(), RunError> {
        let cases = Cases::new(&self.spec);
        let Ok(scene) = text.scene(&cases.changes(case)) else { return Ok(()) };
        let stem = format!("case-{:06}", case + 1);
        let file = SceneFile { stem, ..self.found.file.clone() };
        let out = Destination { out: folder.join("reports"), file, overwrite: true };
        let options = RunOptions {
            out: Some(out),
            called: Some(self.called.clone()),
            ..RunOptions::new(cases.method(case).unwrap_or_default())
        };
        match run(&scene, &options, &mut |_, _, _| ()) {
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
        let options: [(&str, Option<String>); 6] = [
            ("scheme", Some(method.scheme_name().into())),
            ("newton", method.newton().filter(|n| *n > 0).map(|n| n.to_string())),
            ("rho", given_rho(&method).map(|rho| rho.to_string())),
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
        let key = words(&method).iter().fold(self.base, |key, word| key.with(word));
        Key(cases.changes(case).iter().fold(key, |key, change| key.with(change)).bits())
    }
}

/// ρ∞ if it is not the default.
fn given_rho(method: &Method) -> Option<f64> {
    method.rho().filter(|rho| *rho != GeneralizedAlpha::RHO)
}

/// A method as text.
fn words(method: &Method) -> Vec<String> {
    let newton = method.newton().map_or(String::new(), |newton| newton.to_string());
    let [scheme, precision] = [method.scheme_name(), method.precision_name()].map(String::from);
    let damping = method.damping().name().to_owned();
    let mut words = vec![scheme, newton, damping, precision, method.orientation_name().to_owned()];
    // Keys of cases without it stay unchanged.
    words.extend(given_rho(method).map(|rho| rho.to_string()));
    words
}
