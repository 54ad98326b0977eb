//! A build script in one call: a scene becomes Rust source that the crate includes.
//!
//! `scene file => OUT_DIR/STEM.rs, lines for cargo`. `build.rs` is
//! `fn main() { dbd_scene::build("scenes/four-bar.toml") }`, the crate has
//! `include!(concat!(env!("OUT_DIR"), "/four-bar.rs"))` in a module and `dbd-kernel` among its dependencies. Contents
//! of the source: [`export::source`](crate::export::source).

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

/// Fraction of the stability limit at t = 0 that allows for its change during motion.
const MARGIN: f64 = 0.85;

/// Writes the source of a scene in single precision, stepped by leapfrog:
/// `scenes/my.toml` becomes `OUT_DIR/my.rs`. The path is relative to the crate's `Cargo.toml`.
///
/// An error in the scene ends the build script with its position and a remedy; probable mistakes become warnings of
/// cargo. [`Build`] has options.
pub fn build(scene: impl AsRef<Path>) {
    Build::scene(scene).write();
}

/// Options of a build script.
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

/// The result of a build script.
#[derive(Clone, Debug)]
pub struct Built {
    /// The scene.
    pub scene: Scene,
    /// The Rust source.
    pub source: String,
    /// Probable mistakes, one per line with its position.
    pub warnings: Vec<String>,
}

/// Reasons why nothing was written. Displayed on one line: position, problem, remedy.
#[derive(Debug)]
pub enum BuildError {
    /// The scene cannot be read or is invalid.
    Scene(SceneError),
    /// An option of the build script is invalid: problem and remedy.
    Option(String, String),
    /// No step divides both the duration and the sampling interval of the scene in this file.
    NoStep(String),
    /// An input of the scene in this file is out of the range of a precision.
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

    /// Registers a user-defined law; `path` is the path of its type, on which the built crate must also depend:
    /// `.law::<my_laws::Drag>("my_laws::Drag")`.
    pub fn law<L: Law>(self, path: &str) -> Self {
        crate::laws::register::<L>(path);
        self
    }

    /// Changes a value of the file, `PATH=VALUE` as in `host-sim run --set`. May be called repeatedly.
    pub fn set(mut self, change: &str) -> Self {
        self.changes.push(change.to_owned());
        self
    }

    /// `f32`, `f64` or `fixed`. May be called repeatedly. Default: `f32`.
    pub fn precision(mut self, name: &str) -> Self {
        self.precisions.push(name.to_owned());
        self
    }

    /// The scheme by its name, as on the command line. Default: `leapfrog`.
    pub fn scheme(mut self, name: &str) -> Self {
        self.scheme = Some(name.to_owned());
        self
    }

    /// Newton iterations of the dbd schemes.
    pub fn newton(mut self, iterations: u32) -> Self {
        self.newton = Some(iterations);
        self
    }

    /// ρ∞ of generalized-alpha, 0 to 0.8: the amplitude factor per step of unresolved vibration. Default: 0.5.
    pub fn rho(mut self, rho: f64) -> Self {
        self.rho = Some(rho);
        self
    }

    /// `sweeps`, `joint-wise` or `explicit`, for schemes that support all. Default: that of the scheme.
    pub fn damping(mut self, name: &str) -> Self {
        self.damping = Some(name.to_owned());
        self
    }

    /// The step: seconds, or a text with a unit, `"20us"`. Default: that of the scene, otherwise the default of
    /// `host-sim run`.
    pub fn step(mut self, step: impl Display) -> Self {
        self.step = Some(step.to_string());
        self
    }

    /// Omits the tables that drive inputs: the program sets all inputs. Each starts with the first value of its
    /// table.
    pub fn without_tables(mut self) -> Self {
        self.without_tables = true;
        self
    }

    /// File name in `OUT_DIR`, for scenes that are written more than once. Default: the name of the scene file with
    /// `.rs`.
    pub fn output(mut self, name: &str) -> Self {
        self.output = Some(name.to_owned());
        self
    }

    /// Writes the source into `OUT_DIR`, prints the lines for cargo, and exits with code 1 on errors.
    pub fn write(&self) {
        let folder = std::env::var_os("OUT_DIR").map(PathBuf::from);
        // Failures to write to cargo are ignored.
        if !self.write_into(folder.as_deref(), &mut io::stdout()).unwrap_or(true) {
            std::process::exit(1)
        }
    }

    /// Writes the source into a folder and lines for cargo; `false` on errors.
    fn write_into(&self, folder: Option<&Path>, cargo: &mut dyn io::Write) -> io::Result<bool> {
        writeln!(cargo, "{}", self.watched())?;
        let written = self.source().and_then(|built| {
            let Some(folder) = folder else {
                let help = "cargo sets it for build scripts; use host-sim export elsewhere";
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

    /// The line that tells cargo on which file the source depends.
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
    /// # Errors [`BuildError`], except for write errors.
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
        // Messages show the path as given, independent of the working directory.
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
                "{called}: the step of {} may be unstable with {}: ω·h = {:.3} with the bound of the \
                 highest frequency at t = 0, the limit is {limit:.4}; use a step of at most {}",
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
                let message = format!("{called} is planar, but {name} has no planar model");
                return Err(BuildError::Option(message, "use f32, or remove `planar`".into()));
            }
            let most = scheme.longest(*precision, bound);
            if step > most {
                let message = format!(
                    "{called}: the stiffness of the joints limits the step to {} with {} in {name}; it is {}",
                    display(crate::time::at_most(most)),
                    scheme.name(),
                    display(step),
                );
                return Err(BuildError::Option(
                    message,
                    "use a shorter step, softer joints or f64".into(),
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
                let message = format!("{name} cannot represent the step of {}", display(step));
                return Err(BuildError::Option(message, "use a longer step or f64".into()));
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
                let message = format!("unknown precision \"{name}\"");
                let names = ExportPrecision::ALL.map(ExportPrecision::name);
                let help = format!("expected one of {}", names.join(", "));
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

/// Parses a step to seconds.
fn step(text: &str) -> Result<f64, BuildError> {
    let wrong = |error: TimeError| {
        BuildError::Option(format!("\"{text}\" is not a valid step"), error.to_string())
    };
    text.parse::<Time>().map(Time::seconds).map_err(wrong)
}

impl BuildError {
    fn scheme(error: SchemeError) -> Self {
        Self::Option(error.to_string(), error.help().to_owned())
    }

    /// The line with which cargo reports the error and fails the build.
    #[must_use]
    pub fn line(&self) -> String {
        format!("cargo::error={}", on_one_line(&self.to_string()))
    }
}

/// A message on one line, as cargo requires.
fn on_one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

impl Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => {
                // The message of an unreadable file includes the file name.
                if let (Some(line), Some(column)) = (error.line(), error.column()) {
                    write!(f, "{}:{line}:{column}: ", error.file())?;
                }
                write!(f, "{} ({})", error.message(), error.help())
            }
            Self::Option(message, help) => write!(f, "{message} ({help})"),
            Self::NoStep(file) => write!(
                f,
                "{file}: no step divides both `duration` and `every` (give another `every` or a `step`)"
            ),
            Self::Input(file, error) => {
                write!(f, "{file}:{}: {error} (use a smaller value or f64)", error.line)
            }
            Self::Write(file, reason) => write!(f, "cannot write {}: {reason}", file.display()),
        }
    }
}

impl std::error::Error for BuildError {}

#[cfg(test)]
mod tests;
