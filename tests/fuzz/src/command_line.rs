//! The target `command-line`: arguments of any sort, and a scene file of any content.
//!
//! `bytes => arguments, scene file => exit code, text, files`. In-process in a folder of its own;
//! what reads standard input, and one in some else, as a process. No exit code but 0, 1 and 2, and
//! with 2 a word of why and a folder as it was. A run that would rightly take long is not begun.

mod budget;
mod folder;
mod words;

use std::ffi::OsString;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use fastrand::Rng;
use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};

use crate::scene::{fnv, text};
use crate::target::{Finding, Reach, Target};
use folder::Folder;
pub use words::Arguments;

/// The first argument that makes this program the command line itself.
pub const AS_HOST_SIM: &str = "host-sim";

/// One in so many inputs is run as a process.
const PROCESSES: u64 = 32;

/// A process that has not ended by then hangs.
const LONGEST: Duration = Duration::from_secs(60);

/// The command line.
pub struct CommandLineTarget;

/// The program that is the command line when called with [`AS_HOST_SIM`]; without it nothing is run
/// as a process.
pub static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

impl Target for CommandLineTarget {
    fn name(&self) -> &'static str {
        "command-line"
    }

    fn share(&self) -> f64 {
        0.15
    }

    fn block(&self) -> u64 {
        100
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        let scene = if random.u8(..4) == 0 { text(random) } else { words::valid_scene(random) };
        let words = words::random(random);
        let is_sweep = words.first().is_some_and(|word| word == words::SWEEP);
        let scene = if is_sweep && random.u8(..8) > 0 { words::sweep(random) } else { scene };
        Arguments { words, scene }.bytes()
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let arguments = Arguments::of(input);
        if !(budget::stays(&arguments) && budget::is_short(&arguments)) {
            return Ok(Reach::Skipped);
        }
        // One folder for all that a thread runs: to make one takes as long as a command.
        folder::with(|folder| {
            folder.place(&arguments.scene)?;
            let before = folder.listing();
            let done = run(folder, &arguments, fnv(input))?;
            let after = folder.listing();
            let untouched = before == after;
            if !untouched {
                folder.soil();
            }
            done.check(untouched, || format!("{before:?} became {after:?}"))
        })
    }

    fn shown(&self, input: &[u8]) -> String {
        let Arguments { words, scene } = Arguments::of(input);
        format!("host-sim {words:?}\n--- scene.toml\n{}", String::from_utf8_lossy(&scene))
    }
}

/// What a command came to.
struct Done {
    code: i32,
    said: Vec<u8>,
}

impl Done {
    fn check(&self, untouched: bool, files: impl FnOnce() -> String) -> Result<Reach, Finding> {
        let said = || String::from_utf8_lossy(&self.said).into_owned();
        let known = matches!(self.code, 0..=2);
        Finding::unless(known, "exit codes are 0, 1 and 2", || {
            format!("{} {}", self.code, said())
        })?;
        if self.code == Exit::Refused as i32 {
            Finding::unless(untouched, "nothing is written on exit 2", || {
                format!("{} {}", files(), said())
            })?;
        }
        let silent = self.code != Exit::Done as i32 && self.said.is_empty();
        Finding::unless(!silent, "who fails says why", || self.code.to_string())?;
        let panicked = self.said.windows(12).any(|part| part == b"panicked at ");
        Finding::unless(!panicked, "no process panics", said)?;
        Ok(if self.code == Exit::Refused as i32 { Reach::Refused } else { Reach::Taken })
    }
}

fn run(folder: &Folder, arguments: &Arguments, choice: u64) -> Result<Done, Finding> {
    let reads_input = arguments.words.iter().any(|word| word == "-");
    match PROGRAM.get() {
        Some(program) if reads_input || choice.is_multiple_of(PROCESSES) => {
            process(program, folder.path(), arguments)
        }
        _ if reads_input => Ok(Done { code: 0, said: Vec::new() }),
        _ => Ok(in_process(arguments)),
    }
}

fn in_process(arguments: &Arguments) -> Done {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let program = OsString::from(AS_HOST_SIM);
    let words = std::iter::once(program).chain(arguments.words.iter().cloned());
    let exit = main_with(words, &mut console);
    Done { code: exit as i32, said: err }
}

/// A process with the scene on its standard input.
fn process(program: &Path, folder: &Path, arguments: &Arguments) -> Result<Done, Finding> {
    let failed = |error: std::io::Error| Finding::new("a process can be run", error);
    let mut err = tempfile::tempfile().map_err(failed)?;
    let mut command = Command::new(program);
    command.arg(AS_HOST_SIM).args(&arguments.words).current_dir(folder);
    command.stdin(Stdio::piped()).stdout(Stdio::null());
    command.stderr(err.try_clone().map_err(failed)?);
    let mut child = command.spawn().map_err(failed)?;
    let input = child.stdin.take();
    let code = std::thread::scope(|scope| {
        scope.spawn(move || {
            // A process that does not read is none that fails.
            let _ = input.map(|mut input| input.write_all(&arguments.scene));
        });
        let begun = Instant::now();
        loop {
            if let Some(status) = child.try_wait().map_err(failed)? {
                return Ok(status.code());
            }
            if begun.elapsed() > LONGEST {
                let _ = child.kill();
                let _ = child.wait();
                return Err(Finding::new("every command ends", format!("{arguments:?}")));
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    })?;
    use std::io::{Read as _, Seek as _};
    let mut said = Vec::new();
    err.rewind().and_then(|()| err.read_to_end(&mut said)).map_err(failed)?;
    let code = code.ok_or_else(|| {
        Finding::new("no process is ended by a signal", String::from_utf8_lossy(&said))
    })?;
    Ok(Done { code, said })
}
