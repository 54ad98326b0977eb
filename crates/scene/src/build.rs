//! A build script in one call: a scene becomes Rust source that the crate includes.
//!
//! `scene file => OUT_DIR/STEM.rs, lines for cargo`. `build.rs` is
//! `fn main() { dbd_scene::build("scenes/four-bar.toml") }`, the crate has
//! `include!(concat!(env!("OUT_DIR"), "/four-bar.rs"))` in a module of its own and `dbd-kernel`
//! among its dependencies. What is in the source: [`export::source`](crate::export::source).

use std::fmt::{self, Display};
use std::io;
use std::path::{Path, PathBuf};

use dbd_kernel::laws::Law;
use dbd_kernel::{F32, Fixed, State, frequency};

use crate::default_step::{STEPS_PER_PERIOD, fastest_spin, longest, shortest_period};
use crate::error::SceneError;
use crate::export::{Export, ExportPrecision, ExportScheme, SchemeError, source};
use crate::extents::{UnfitInput, check_extents, check_inputs};
use crate::fitting::Span;
use crate::lint::{Severity, warnings};
use crate::scene::Scene;
use crate::single::slow_start;
use crate::time::{Time, TimeError, display};

/// The share of a stability limit at t = 0 that leaves room for a motion.
const MARGIN: f64 = 0.85;

/// Writes the source of a scene in single precision, stepped by leapfrog:
/// `scenes/my.toml` becomes `OUT_DIR/my.rs`. The path is relative to the crate's `Cargo.toml`.
///
/// What is wrong with the scene ends the build script with its place and with what would be right;
/// what is probably not meant is a warning of cargo's. [`Build`] has the options.
pub fn build(scene: impl AsRef<Path>) {
    Build::scene(scene).write();
}

/// A build script's call with options.
///
/// ```no_run
/// dbd_scene::Build::scene("scenes/four-bar.toml")
///     .precision("f32")
///     .scheme("pefrl")
///     .step("50us")
///     .write();
/// ```
#[derive(Clone, Debug)]
#[must_use = "nothing is written before `write`"]
pub struct Build {
    scene: PathBuf,
    output: Option<String>,
    precisions: Vec<String>,
    scheme: Option<String>,
    newton: Option<u32>,
    rho: Option<f64>,
    damping: Option<String>,
    step: Option<String>,
    without_tables: bool,
    changes: Vec<String>,
}

/// What a build script makes of a scene.
#[derive(Clone, Debug)]
pub struct Built {
    /// The scene.
    pub scene: Scene,
    /// The Rust source.
    pub source: String,
    /// What is probably not meant, each on a line of its own with its place.
    pub warnings: Vec<String>,
}

/// Why nothing was written. Displayed on one line: place, what is wrong, what would be right.
#[derive(Debug)]
pub enum BuildError {
    /// The scene cannot be read or is refused.
    Scene(SceneError),
    /// An option of the build script is not right; what it is and what would be right.
    Option(String, String),
    /// No step divides both the scene's duration and its sampling interval; the scene's file.
    NoStep(String),
    /// A precision cannot hold what an input is given; the scene's file.
    Input(String, UnfitInput),
    /// The source cannot be written.
    Write(PathBuf, io::Error),
}

impl Build {
    /// A scene file, relative to the crate's `Cargo.toml`.
    pub fn scene(path: impl AsRef<Path>) -> Self {
        Self {
            scene: path.as_ref().to_owned(),
            output: None,
            precisions: Vec::new(),
            scheme: None,
            newton: None,
            rho: None,
            damping: None,
            step: None,
            without_tables: false,
            changes: Vec::new(),
        }
    }

    /// Makes a law of one's own known; `path` is that of its type, which the crate that is built depends on, too:
    /// `.law::<my_laws::Drag>("my_laws::Drag")`.
    pub fn law<L: Law>(self, path: &str) -> Self {
        crate::laws::register::<L>(path);
        self
    }

    /// A value that is another than in the file, `PATH=VALUE` as of `host-sim run --set`; called twice,
    /// both.
    pub fn set(mut self, change: &str) -> Self {
        self.changes.push(change.to_owned());
        self
    }

    /// `f32`, `f64` or `fixed`; called twice, both. Without it `f32`.
    pub fn precision(mut self, name: &str) -> Self {
        self.precisions.push(name.to_owned());
        self
    }

    /// The scheme by its name, as on the command line. Without it `leapfrog`.
    pub fn scheme(mut self, name: &str) -> Self {
        self.scheme = Some(name.to_owned());
        self
    }

    /// Newton iterations of the dbd schemes.
    pub fn newton(mut self, iterations: u32) -> Self {
        self.newton = Some(iterations);
        self
    }

    /// ρ∞ of generalized-alpha, 0 to 0.8: what is left per step of a vibration that it does not resolve.
    /// Without it 0.5.
    pub fn rho(mut self, rho: f64) -> Self {
        self.rho = Some(rho);
        self
    }

    /// `sweeps`, `joint-wise` or `explicit`, for schemes that have all. Without it the scheme's own.
    pub fn damping(mut self, name: &str) -> Self {
        self.damping = Some(name.to_owned());
        self
    }

    /// The step: seconds, or a text with a unit, `"20us"`. Without it the scene's, else the one that
    /// `host-sim run` takes.
    pub fn step(mut self, step: impl Display) -> Self {
        self.step = Some(step.to_string());
        self
    }

    /// Leaves out the tables that drive inputs: the program drives all of them. Each begins with the
    /// first value of its table.
    pub fn without_tables(mut self) -> Self {
        self.without_tables = true;
        self
    }

    /// The file's name in `OUT_DIR`, where a scene is written more than once. Without it the
    /// scene file's, ending in `.rs`.
    pub fn output(mut self, name: &str) -> Self {
        self.output = Some(name.to_owned());
        self
    }

    /// Writes the source into `OUT_DIR`, tells cargo, and ends the build script with exit code 1 where
    /// something is wrong.
    pub fn write(&self) {
        let folder = std::env::var_os("OUT_DIR").map(PathBuf::from);
        // What cargo does not read it does not need.
        if !self.write_into(folder.as_deref(), &mut io::stdout()).unwrap_or(true) {
            std::process::exit(1)
        }
    }

    /// Writes the source into a folder and lines for cargo; `false` where something is wrong.
    fn write_into(&self, folder: Option<&Path>, cargo: &mut dyn io::Write) -> io::Result<bool> {
        writeln!(cargo, "{}", self.watched())?;
        let written = self.source().and_then(|built| {
            let Some(folder) = folder else {
                let help = "cargo sets it for a build script; elsewhere: host-sim export";
                return Err(BuildError::Option("OUT_DIR is not set".into(), help.into()));
            };
            let file = folder.join(self.file_name());
            match std::fs::write(&file, &built.source) {
                Ok(()) => Ok(built.warnings),
                Err(reason) => Err(BuildError::Write(file, reason)),
            }
        });
        match &written {
            Ok(warnings) => {
                for warning in warnings {
                    writeln!(cargo, "cargo::warning={}", on_one_line(warning))?;
                }
            }
            Err(error) => writeln!(cargo, "{}", error.line())?,
        }
        Ok(written.is_ok())
    }

    /// The line that tells cargo what the source is made from.
    #[must_use]
    pub fn watched(&self) -> String {
        format!("cargo::rerun-if-changed={}", self.scene.display())
    }

    /// The name of the file that [`Self::write`] writes.
    #[must_use]
    pub fn file_name(&self) -> String {
        let stem = || self.scene.file_stem().unwrap_or_default().to_string_lossy();
        self.output.clone().unwrap_or_else(|| format!("{}.rs", stem()))
    }

    /// The source, without writing it.
    ///
    /// # Errors
    /// [`BuildError`], but for the one of writing.
    pub fn source(&self) -> Result<Built, BuildError> {
        let precisions = self.precisions()?;
        let scheme = self.scheme.as_deref().unwrap_or(ExportScheme::default().name());
        let scheme = ExportScheme::named(scheme, self.newton, self.damping.as_deref())
            .and_then(|scheme| match self.rho {
                Some(rho) => scheme.with_rho(rho),
                None => Ok(scheme),
            })
            .map_err(BuildError::scheme)?;
        let asked = self.step.as_deref().map(step).transpose()?;
        // As it was given, in messages too, wherever cargo runs the script.
        let called = self.scene.display().to_string();
        let text = crate::file::read_text(self.path())
            .map_err(|reason| SceneError::Unreadable { file: called.clone(), reason });
        let mut scene = text
            .and_then(|text| Scene::parse_with(&text, &called, &self.changes))
            .map_err(BuildError::Scene)?;
        if self.without_tables {
            scene.release_all();
        }
        let state = State::initial(scene.stepped());
        let bound = frequency::bound(scene.stepped(), &state);
        let step = match asked.or(scene.step) {
            Some(step) => step,
            None => {
                let (spin, _) = fastest_spin(&state);
                let of = |precision: &ExportPrecision| {
                    longest(bound, spin, scheme.bears(*precision), scene.duration)
                };
                let resolved = shortest_period(scene.stepped()) / STEPS_PER_PERIOD;
                let limit = precisions.iter().map(of).fold(resolved, f64::min);
                let span = Span::new(scene.duration, scene.every);
                span.ok_or_else(|| BuildError::NoStep(called.clone()))?.round_step(limit)
            }
        };
        let mut warnings: Vec<String> = warnings(&scene)
            .into_iter()
            .filter(|warning| warning.severity == Severity::Warning)
            .map(|warning| {
                let line = warning.line.map_or(String::new(), |line| format!(":{line}"));
                format!("{called}{line}: {}: {}", warning.name, warning.text)
            })
            .collect();
        let limit = scheme.stability_limit();
        if bound * step > limit {
            warnings.push(format!(
                "{called}: the step of {} may be beyond what {} bears: ω·h = {:.3} with the bound of the \
                 highest frequency at t = 0, the limit is {limit:.4}; a step of at most {}",
                display(step),
                scheme.name(),
                bound * step,
                display(crate::time::rounded(MARGIN * limit / bound, 2)),
            ));
        }
        if precisions.contains(&ExportPrecision::F32) {
            let slow = slow_start(&scene, step, "the step");
            warnings.extend(slow.map(|slow| format!("{called}: {slow}")));
        }
        for precision in &precisions {
            let name = precision.name();
            if scene.planar.is_some() && !precision.has_planes() {
                let message = format!("{called} is planar, and {name} has no plane");
                return Err(BuildError::Option(message, "f32, or without `planar`".into()));
            }
            let most = scheme.longest(*precision, bound);
            if step > most {
                let message = format!(
                    "{called}: joints as stiff as these take a step of at most {} with {} in {name}, not of {}",
                    display(crate::time::at_most(most)),
                    scheme.name(),
                    display(step),
                );
                return Err(BuildError::Option(
                    message,
                    "a shorter step, softer joints, or f64".into(),
                ));
            }
            let held = match precision {
                ExportPrecision::F64 => continue,
                ExportPrecision::F32 => check_inputs::<F32>(&scene),
                ExportPrecision::Fixed => {
                    if let Err(misfit) = check_extents::<Fixed>(&scene, step) {
                        let help = misfit.remedy.replace("--precision f64", "f64");
                        return Err(BuildError::Option(format!("{called}: {misfit}"), help));
                    }
                    check_inputs::<Fixed>(&scene)
                }
            };
            let single = step as f32;
            if !(single > 0.0 && single.is_finite()) {
                let message = format!("{name} does not hold the step of {}", display(step));
                return Err(BuildError::Option(message, "a longer step, or f64".into()));
            }
            held.map_err(|error| BuildError::Input(called.clone(), error))?;
        }
        let source = source(&scene, &Export { precisions, scheme, step });
        Ok(Built { scene, source, warnings })
    }

    fn path(&self) -> PathBuf {
        let root = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
        Path::new(&root).join(&self.scene)
    }

    fn precisions(&self) -> Result<Vec<ExportPrecision>, BuildError> {
        let mut precisions = Vec::new();
        for name in &self.precisions {
            let Some(one) = ExportPrecision::ALL.into_iter().find(|one| one.name() == name) else {
                let message = format!("there is no precision \"{name}\"");
                let names = ExportPrecision::ALL.map(ExportPrecision::name);
                let help = format!("one of {}", names.join(", "));
                return Err(BuildError::Option(message, help));
            };
            if !precisions.contains(&one) {
                precisions.push(one);
            }
        }
        if precisions.is_empty() {
            precisions.push(ExportPrecision::F32);
        }
        Ok(precisions)
    }
}

/// \[s\] a step as it was given.
fn step(text: &str) -> Result<f64, BuildError> {
    let wrong = |error: TimeError| {
        BuildError::Option(format!("the step \"{text}\" is none"), error.to_string())
    };
    text.parse::<Time>().map(Time::seconds).map_err(wrong)
}

impl BuildError {
    fn scheme(error: SchemeError) -> Self {
        Self::Option(error.to_string(), error.help().to_owned())
    }

    /// The line that fails a build and that cargo shows.
    #[must_use]
    pub fn line(&self) -> String {
        format!("cargo::error={}", on_one_line(&self.to_string()))
    }
}

/// A message as cargo takes it.
fn on_one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

impl Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => {
                // The message of a file that cannot be read names it itself.
                if let (Some(line), Some(column)) = (error.line(), error.column()) {
                    write!(f, "{}:{line}:{column}: ", error.file())?;
                }
                write!(f, "{} ({})", error.message(), error.help())
            }
            Self::Option(message, help) => write!(f, "{message} ({help})"),
            Self::NoStep(file) => write!(
                f,
                "{file}: no step divides both `duration` and `every` (another `every`, or a `step`)"
            ),
            Self::Input(file, error) => {
                write!(f, "{file}:{}: {error} (a smaller value, or f64)", error.line)
            }
            Self::Write(file, reason) => write!(f, "cannot write {}: {reason}", file.display()),
        }
    }
}

impl std::error::Error for BuildError {}

#[cfg(test)]
mod tests;
