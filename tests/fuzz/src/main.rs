//! The program of campaigns: see `cargo xtask fuzz --help`.

use std::alloc::System;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use anyhow::{Context as _, Result, bail};
use cap::Cap;
use clap::{Args, Parser, Subcommand};
use dbd_fuzz::campaign::{Campaign, Extent, text};
use dbd_fuzz::command_line::{AS_HOST_SIM, PROGRAM};
use dbd_fuzz::execution::{execute, watch};
use dbd_fuzz::target::Target;
use dbd_fuzz::worker::{Work, work};
use dbd_fuzz::{corpus, targets};
use host_sim::cli::main_with;
use host_sim::terminal::Console;

/// What one input may take: hundreds of times what the largest scene that ships does.
const MAX_MEMORY: usize = 256 << 20;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, MAX_MEMORY);

/// Random input for scenes, snapshots, steps and the command line.
#[derive(Parser)]
#[command(name = "dbd-fuzz")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Runs targets on all cores and says what they found; exit code 1 where that is anything
    Run(RunArguments),
    /// Runs inputs again, each named TARGET-…; those that failed before where none is named
    Replay {
        /// Their files.
        files: Vec<PathBuf>,
        /// Shows them.
        #[arg(long)]
        show: bool,
    },
    /// Runs blocks of a target; what `run` calls
    #[command(hide = true)]
    Worker(WorkerArguments),
}

#[derive(Args)]
struct RunArguments {
    /// Seconds for all targets together.
    #[arg(required_unless_present = "inputs")]
    seconds: Option<f64>,
    /// Inputs per target instead, always the same of a seed.
    #[arg(long, conflicts_with = "seconds")]
    inputs: Option<u64>,
    /// The target; all where none is named.
    #[arg(long = "target", value_name = "NAME")]
    targets: Vec<String>,
    /// From what inputs are made [default: the clock].
    #[arg(long)]
    seed: Option<u64>,
    /// Processes at a time [default: the cores].
    #[arg(long)]
    workers: Option<u64>,
    /// Seconds that an input may take.
    #[arg(long, default_value_t = 60.0)]
    limit: f64,
    /// Folder of the inputs that fail.
    #[arg(long, default_value = "target/fuzz-findings")]
    findings: PathBuf,
}

#[derive(Args)]
struct WorkerArguments {
    target: String,
    #[arg(long)]
    seed: u64,
    #[arg(long)]
    first: u64,
    #[arg(long)]
    stride: u64,
    #[arg(long)]
    end: u64,
    #[arg(long)]
    time: Option<f64>,
    #[arg(long)]
    limit: f64,
    #[arg(long)]
    findings: PathBuf,
    #[arg(long)]
    trace: Option<PathBuf>,
}

fn main() -> ExitCode {
    if std::env::args_os().nth(1).is_some_and(|first| first == AS_HOST_SIM) {
        return as_host_sim();
    }
    let outcome = match Cli::parse().command {
        Command::Run(arguments) => run(&arguments),
        Command::Replay { files, show } => replay(&files, show),
        Command::Worker(arguments) => worker(&arguments).map(|()| true),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// The command line itself, as its own program runs it.
fn as_host_sim() -> ExitCode {
    let (mut out, mut err) = (io::stdout(), io::stderr());
    let mut console = Console::plain(&mut out, &mut err);
    main_with(std::env::args_os().skip(1), &mut console).into()
}

fn target(name: &str) -> Result<&'static dyn Target> {
    let known = targets::ALL.map(Target::name).join(", ");
    targets::of_name(name).with_context(|| format!("no target `{name}`; there are {known}"))
}

fn seconds(seconds: f64) -> Result<Duration> {
    Duration::try_from_secs_f64(seconds).with_context(|| format!("{seconds} s is no time"))
}

/// Whether nothing was found.
fn run(arguments: &RunArguments) -> Result<bool> {
    let mut chosen: Vec<&dyn Target> = Vec::new();
    for name in &arguments.targets {
        chosen.push(target(name)?);
    }
    if chosen.is_empty() {
        chosen = targets::ALL.to_vec();
    }
    let clock = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(1, |time| time.as_secs());
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get() as u64);
    let here = std::env::current_dir()?;
    let campaign = Campaign {
        program: std::env::current_exe()?,
        seed: arguments.seed.unwrap_or_else(clock),
        workers: arguments.workers.unwrap_or(cores).max(1),
        limit: seconds(arguments.limit)?,
        // Workers have another folder.
        findings: here.join(&arguments.findings),
    };
    println!("seed {}, {} workers", campaign.seed, campaign.workers);
    // One target alone has all the time.
    let shares: f64 = chosen.iter().map(|target| target.share()).sum();
    let part = |target: &dyn Target| if chosen.len() == 1 { 1.0 } else { target.share() / shares };
    let mut reports = Vec::new();
    for &target in &chosen {
        let extent = match (arguments.inputs, arguments.seconds) {
            (Some(inputs), _) => Extent::Inputs(inputs),
            (None, all) => Extent::Time(seconds(all.unwrap_or(0.0) * part(target))?),
        };
        reports.push((target, campaign.run(target, extent)?));
    }
    print!("{}", text(&reports, &here));
    let found: u64 = reports.iter().map(|(_, report)| report.sum.findings).sum();
    if found > 0 {
        println!("\n{found} failures; again: cargo xtask fuzz --replay FILE");
    }
    Ok(found == 0)
}

/// Whether none fails.
fn replay(files: &[PathBuf], show: bool) -> Result<bool> {
    PROGRAM.get_or_init(|| std::env::current_exe().unwrap_or_default());
    let whole: Vec<PathBuf> = match files {
        [] => corpus::files(&corpus::failed()),
        files => files.iter().map(std::path::absolute).collect::<io::Result<_>>()?,
    };
    watch(Duration::from_secs(60));
    let mut good = true;
    for file in &whole {
        good &= replay_one(file, show)?;
    }
    Ok(good)
}

fn replay_one(file: &Path, show: bool) -> Result<bool> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let Some(target) = targets::of_file(&name) else {
        bail!("{name} does not begin with the name of a target");
    };
    let input = fs::read(file).with_context(|| format!("cannot read {}", file.display()))?;
    if show {
        println!("{}", target.shown(&input));
    }
    let outcome = execute(target, &input);
    match &outcome {
        Ok(reach) => println!("{name}: {reach:?}"),
        Err(finding) => println!("{name}: FAILS: {}", finding.message),
    }
    Ok(outcome.is_ok())
}

fn worker(arguments: &WorkerArguments) -> Result<()> {
    PROGRAM.get_or_init(|| std::env::current_exe().unwrap_or_default());
    let WorkerArguments { seed, first, stride, end, .. } = *arguments;
    let time = arguments.time.map_or(Ok(Duration::MAX), seconds)?;
    let limit = seconds(arguments.limit)?;
    let (findings, trace) = (arguments.findings.clone(), arguments.trace.clone());
    let task = Work { seed, first, stride, end, time, limit, findings, trace };
    work(target(&arguments.target)?, &task)
}
