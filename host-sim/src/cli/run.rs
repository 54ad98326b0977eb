//! `host-sim run` on the command line.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_golden::{BandList, Blessing};
use dbd_plant::time::{Time, display};
use dbd_plant::{DampingName, Method, Named as _, OrientationName, PrecisionName, SchemeName};
use dbd_scene::Scene;
use dbd_study::ideal::{Ideal, ideal};

use crate::arguments::{SceneArgument, names};
use crate::cli::named::{ResultsArguments, damped, leaving, load};
use crate::commands::advise::positive;
use crate::commands::golden::GoldenOptions;
use crate::commands::run::{Outcome, RunOptions, Stage, run};
use crate::error::Error;
use crate::simulate::EnergyLimit;
use crate::terminal::{Catalogue, Console, Exit, Found, Look, Progress};

#[derive(Debug, Args)]
pub(super) struct RunArguments {
    #[command(flatten)]
    pub(super) scene: SceneArgument,
    /// Time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    scheme: SchemeName,
    /// Newton iterations per step of the dbd schemes, at most 8 [default: 0]
    #[arg(long, value_name = "N")]
    newton: Option<u32>,
    /// Spectral radius of generalized-alpha at infinite frequency, 0 to 0.8: the fraction of an unresolved
    /// vibration that remains per step [default: 0.5]
    #[arg(long, value_name = "RHO", allow_hyphen_values = true)]
    rho: Option<f64>,
    /// Damping method [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    damping: Option<DampingName>,
    /// Approximate ideal joints: choose joint stiffness, model, scheme and step for an error of the motion of at most
    /// this, e.g. 0.1mm, root mean square over bodies and time
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true,
        conflicts_with_all = ["scheme", "newton", "rho", "damping", "step", "precision", "orientation"])]
    ideal: Option<String>,
    /// Step, e.g. 20us [default: the scene's, else the advised one, shortened to fit]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    step: Option<Time>,
    /// Simulated time, e.g. 0.5s [default: the scene's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    duration: Option<Time>,
    /// Precision of all arithmetic in a step
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name())]
    precision: PrecisionName,
    /// Representation of orientations
    #[arg(long, value_parser = names::<OrientationName>(), default_value = OrientationName::default().name())]
    orientation: OrientationName,
    /// Sampling interval, e.g. 1ms [default: the scene's, else about 500 samples]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    every: Option<Time>,
    /// Stop at the first sample whose total energy has changed by more than this, in joules; with dampers
    /// only, whose energy has risen by more
    #[arg(long, value_name = "LIMIT", allow_hyphen_values = true)]
    watch_energy: Option<EnergyLimit>,
    /// Compare bit for bit with the golden run in a file; DBD_BLESS=golden in the environment writes the file
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    golden: Option<PathBuf>,
    /// Compare within bands instead, for any scheme and precision: 1e-6 for all in SI units, or
    /// position=1e-6,orientation=1e-6,velocity=1e-3,angular-velocity=1e-3,READOUT=1e-3
    #[arg(long, value_name = "BANDS", requires = "golden", allow_hyphen_values = true)]
    golden_band: Option<BandList>,
    /// Find the N lowest undamped modes about the pose at t = 0; at most 200 bodies
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u16).range(1..))]
    modes: Option<u16>,
    /// Do not write report.html
    #[arg(long)]
    no_report: bool,
    /// Also write the animation as glTF: SCENE.glb
    #[arg(long)]
    gltf: bool,
    #[command(flatten)]
    results: ResultsArguments,
    /// Print only errors
    #[arg(long)]
    quiet: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn run_scene(
    catalogue: &Catalogue,
    arguments: &RunArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let method = Method::new(arguments.scheme, arguments.newton, arguments.precision)?;
    let method = leaving(method, arguments.rho)?;
    let method = damped(method, arguments.damping)?.with_orientation(arguments.orientation);
    method.check_built()?;
    let Found { scene, file, .. } = load(catalogue, &arguments.scene)?;
    let given = arguments.step.map(Time::seconds);
    let (scene, method, step) = match &arguments.ideal {
        None => (scene, method, given),
        Some(text) => {
            let found = ideally(&scene, arguments, text, console)?;
            (found.scene, found.method, Some(found.step))
        }
    };
    let options = RunOptions {
        method,
        step,
        duration: arguments.duration.map(Time::seconds),
        every: arguments.every.map(Time::seconds),
        watch_energy: arguments.watch_energy,
        golden: arguments.golden.as_ref().map(|file| GoldenOptions {
            file: file.clone(),
            bands: arguments.golden_band.clone(),
            blessing: Blessing::from_environment(),
        }),
        modes: arguments.modes.map(usize::from),
        out: Some(arguments.results.destination(&file)),
        report: !arguments.no_report,
        gltf: arguments.gltf,
        called: Some(arguments.scene.scene.clone()),
    };
    let mut silence = std::io::sink();
    let lines: &mut dyn std::io::Write =
        if arguments.quiet { &mut silence } else { &mut *console.err };
    let mut progress = Progress::of_many(console.terminal && !arguments.quiet, "steps", lines);
    let mut before = Stage::Stepping;
    let outcome = run(&scene, &options, &mut |stage, done, all| {
        if stage != before {
            before = stage;
            progress.restart("evaluations at most in search of a stable step");
        }
        progress.update(done, all);
    });
    progress.finish();
    let outcome = outcome?;
    let printed = if arguments.json {
        console.print(&outcome.summary.json())
    } else if !arguments.quiet {
        console.print(&summary_table(&outcome, &options, console.look))
    } else {
        Ok(())
    };
    if arguments.json {
        for warning in outcome.summary.warnings.iter().filter(|_| !arguments.quiet) {
            console.warn(warning);
        }
    }
    let golden = outcome.summary.golden.as_ref();
    if let Some(golden) = golden.filter(|golden| golden.verdict == "blessed") {
        // Never silently.
        console.note(&golden.words);
    }
    let ended_by = outcome.ended_by().or(outcome.differs());
    if let Some(ended_by) = ended_by {
        console.report(ended_by);
    }
    printed?;
    Ok(if ended_by.is_some() { Exit::Failed } else { Exit::Done })
}

/// The scene with nearly ideal joints, its method and step; prints the choice.
fn ideally(
    scene: &Scene,
    arguments: &RunArguments,
    text: &str,
    console: &mut Console<'_>,
) -> Result<Ideal, Error> {
    let tolerance = positive("ideal", "m", "0.1mm", text)?;
    let duration = arguments.duration.map_or(scene.duration, Time::seconds);
    let shown = console.terminal && !arguments.quiet;
    let mut progress = Progress::of(shown, "runs", &mut *console.err);
    let mut runs = 0;
    let every = arguments.every.map(Time::seconds).or(scene.every);
    let found = ideal(scene, tolerance, (duration, every), &mut || {
        runs += 1;
        progress.update(runs, runs + 1);
    });
    progress.finish();
    let found = found?;
    if !arguments.quiet {
        console.note(&chosen(&found));
    }
    Ok(found)
}

/// The choice, with the error contributed by each part.
fn chosen(found: &Ideal) -> String {
    let set: String = found.set.iter().map(|set| format!(" --set {set}")).collect();
    let model = match found.by_model > 0.0 {
        true => format!(", model `{}` {:.1e} m", found.model, found.by_model),
        false => String::new(),
    };
    format!(
        "ideal joints, error {:.1e} m (step {:.1e} m, joint stiffness {:.0e} N/m {:.1e} m{model}):{set} --scheme {} --step {}",
        found.off(),
        found.by_step,
        found.stiffness,
        found.by_joints,
        found.method.scheme_name(),
        display(found.step),
    )
}

fn summary_table(outcome: &Outcome, options: &RunOptions, look: Look) -> String {
    let mut rows = outcome.summary.rows();
    if let Some(folder) = &outcome.folder {
        let page = if options.report { ",report.html" } else { "" };
        let animation = options.out.as_ref().filter(|_| options.gltf);
        let animation = animation.map(|out| format!(",{}", out.animation())).unwrap_or_default();
        let files = format!("trace.csv,summary.json{page}{animation}");
        rows.push(("written", format!("{}/{{{files}}}", folder.display())));
    }
    look.table(&rows)
}
