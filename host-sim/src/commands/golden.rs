//! `host-sim run --golden`: a run compared with a golden file, or the file written if requested.
//!
//! `(file, bands, blessing), samples => verdict`. A file of another run is reported before the run begins.

use std::fmt::Write as _;
use std::path::PathBuf;

use dbd_golden::recording::RecordingError;
use dbd_golden::subject::BodyNumbers;
use dbd_golden::{
    BandList, Blessing, GoldenError, GoldenFile, Mismatch, Moment, Recording, Tolerance, Verdict,
};
use dbd_plant::time::display;
use dbd_plant::{Method, Plan, PlantError, plant};
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

use crate::report::{GoldenOutcome, NotGolden};
use crate::simulate::Sample;

/// The reference of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct GoldenOptions {
    /// The golden file.
    pub file: PathBuf,
    /// Permitted deviations, for any method; bit for bit if `None`.
    pub bands: Option<BandList>,
    /// Whether the file is written.
    pub blessing: Blessing,
}

/// Why a run cannot be compared.
#[derive(Debug, Error, Diagnostic)]
pub enum GoldenRefusal {
    /// The file is missing, unreadable, damaged or of another run.
    #[error(transparent)]
    File(#[from] GoldenError),
    /// The file is to be written, and bands are stated.
    #[error("--golden-band cannot be used when a golden file is written (DBD_BLESS=golden)")]
    #[diagnostic(help("write the file without --golden-band"))]
    Bands,
    /// The run cannot be recorded.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// There is no such plant.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
}

/// A run in progress with its golden file.
pub struct GoldenWatch<'o> {
    options: &'o GoldenOptions,
    recording: Recording,
    opened: dbd_golden::file::Opened,
}

impl GoldenOptions {
    fn with_tolerance<A>(&self, look: impl FnOnce(Tolerance<'_>) -> A) -> A {
        match &self.bands {
            None => look(Tolerance::Bits),
            Some(list) => list.with(|bands| look(Tolerance::AnyMethod(bands))),
        }
    }

    /// Starts the comparison of a run: reads the file and compares its header.
    ///
    /// # Errors
    /// [`GoldenRefusal`]; nothing was written then.
    pub fn begin(
        &self,
        scene: &Scene,
        method: &Method,
        plan: &Plan,
    ) -> Result<GoldenWatch<'_>, GoldenRefusal> {
        if self.bands.is_some() && self.blessing == Blessing::Yes {
            return Err(GoldenRefusal::Bands);
        }
        let plant = plant(scene, method, plan.step)?;
        let names: Vec<&str> = scene.readouts.iter().map(|info| info.name.as_str()).collect();
        let recording = Recording::of_scene(scene, plant.as_ref(), plan.stride, &names)?;
        let file = GoldenFile::new(&self.file);
        let opened =
            self.with_tolerance(|tolerance| file.open(&recording, &tolerance, self.blessing))?;
        Ok(GoldenWatch { options: self, recording, opened })
    }
}

impl GoldenWatch<'_> {
    /// Takes a sample.
    ///
    /// # Errors
    /// Where it cannot be recorded.
    pub fn sample(&mut self, sample: &Sample<'_>) -> Result<(), RecordingError> {
        self.recording.sample(&Seen(sample), sample.readings)
    }

    /// Compares the whole run, or writes the file. `called` is the scene on a command
    /// line, with the changes of its values.
    #[must_use]
    pub fn finish(self, plan: &Plan, called: &str) -> GoldenOutcome {
        let Self { options, recording, opened } = self;
        let file = options.file.display().to_string();
        let checked = options.with_tolerance(|tolerance| opened.check(&recording, &tolerance));
        let (verdict, words, failure) = match checked {
            Ok(verdict) => {
                let is = match &verdict {
                    Verdict::Blessed { .. } => "blessed",
                    Verdict::Same(summary) if summary.is_equal() => "equal",
                    Verdict::Same(_) => "within",
                };
                (is, verdict.to_string(), None)
            }
            Err(error) => {
                let (words, help) = (error.to_string(), finer(&error, plan, called));
                ("different", words.clone(), Some(NotGolden { words, help }))
            }
        };
        GoldenOutcome { file, verdict, words, failure }
    }
}

/// Instructions for finding the exact step between two samples.
fn finer(error: &GoldenError, plan: &Plan, called: &str) -> Option<String> {
    let GoldenError::Different { mismatch, .. } = error else { return None };
    let Mismatch::Difference(found) = &**mismatch else { return None };
    if found.beyond.is_some() {
        // With another method every step differs.
        return None;
    }
    let equal = found.equal.filter(|equal| equal + 1 < found.step)?;
    let mut help = format!("the first step that differs is one of {} to {}", equal + 1, found.step);
    let (every, duration) = (display(plan.step), display(plan.time(found.step)));
    let _ = write!(
        help,
        "; to find it, bless a file of every step with the program of the golden run, and compare \
         with this one: run {called} … --every {every} --duration {duration} --golden fine.golden"
    );
    Some(help)
}

/// A sample as a moment.
struct Seen<'s>(&'s Sample<'s>);

impl Moment for Seen<'_> {
    fn steps_done(&self) -> u64 {
        self.0.state.step
    }

    fn state_hash(&self) -> u64 {
        self.0.hash
    }

    fn body_numbers(&self, row: usize) -> Option<BodyNumbers> {
        let body = self.0.state.bodies.get(row)?;
        let [x, y, z] = body.position.to_f64();
        let [qw, qx, qy, qz] = body.orientation.to_f64();
        let [vx, vy, vz] = body.velocity.to_f64();
        let [wx, wy, wz] = body.angular_velocity.to_f64();
        Some([x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz])
    }

    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.0.state.turns.get(spring).copied()
    }
}
