//! Hardware in the loop without hardware: the firmware's plant and controller in QEMU, the other end here.
//!
//! `images, host-sim => frames compared bit for bit, on a clean line, a bad one, a broken one, in real time`. QEMU
//! has the board's UART as a Unix socket.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::ScopedJoinHandle;
use std::time::Duration;

use anyhow::{Context as _, Result, anyhow, bail};
use serde_json::Value;

use crate::bits::host;
use crate::boards;
use crate::built::{Program, build, host_sim};
use crate::chip::{Toolchain, emulator, firmware, setup};
use crate::command::{cargo, find, output, program, root, shown};

/// The firmware's program.
const HIL: &str = "hil";
/// The scene of both ends.
const SCENE: &str = "cart-pendulum";
/// Steps per frame: a tick of 1 ms.
const STEPS: &str = "2";
/// \[µs\] from tick to tick.
const PERIOD: &str = "1000";
/// Instructions of 8 ns, as fast as the host can; asleep it passes at once to what is due next.
const FAST: &str = "shift=3,sleep=off";
/// The same, and asleep it waits as long as a board does.
const PACED: &str = "shift=3";
/// Inputs by a seed.
const NOISE: &str = "noise:0.5:1";
/// 1 % of the frames corrupted, 1 % lost.
const BAD_LINE: &str = "corrupt=1%,drop=1%,seed=7";
/// The page with the controller in Python.
const PAGE: &str = "docs/hil.md";
/// Ticks of the controller on the chip.
const TICKS: &str = "300";
/// Real time for a program in QEMU.
const TIME_LIMIT: Duration = Duration::from_secs(300);
/// \[rad\] the joint's angle with the pendulum upright, and how near it must be after four seconds.
const UPRIGHT: f64 = -0.087_266;
const NEAR: f64 = 0.02;

/// `cargo xtask hil`.
///
/// # Errors
/// As [`step`].
pub fn run(long: bool) -> Result<()> {
    let toolchain = setup::complete()?;
    let built = build(cargo().args([
        "build",
        "--release",
        "--package",
        "firmware",
        "--bin",
        firmware::PLANT,
    ]))?;
    step(&toolchain, &host::plant(&built)?, &[], long)
}

/// The step of `cargo xtask test`: `plant` is the host's program of controllers with their plants.
///
/// # Errors
/// Where a bit differs, a frame is accepted that should not be, or an end does not recover.
pub fn step(toolchain: &Toolchain, plant: &Path, programs: &[Program], long: bool) -> Result<()> {
    let folder = std::env::temp_dir().join(format!("dbd-hil-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let bench = Bench {
        image: firmware::build(toolchain, HIL)?,
        board: boards::image(toolchain, "hil-plant")?,
        host_sim: host_sim(programs)?,
        folder: folder.clone(),
    };
    let checked = bench.all(plant, long);
    std::fs::remove_dir_all(&folder)?;
    checked
}

/// What every run needs.
struct Bench {
    image: PathBuf,
    board: PathBuf,
    host_sim: PathBuf,
    folder: PathBuf,
}

impl Bench {
    fn all(&self, plant: &Path, long: bool) -> Result<()> {
        let noise = ["--controller", NOISE, "--answer", "20ms"];
        let clean = self.driven(FAST, &noise)?;
        let hash = clean.text("hash")?;
        clean.count("compared", 10_000)?;
        clean.count("/own/bad", 0)?;
        clean.count("/plant/bad", 0)?;
        clean.tell("clean line");

        // Fewer where minutes count; with all of them the state must be that of the clean line.
        let duration = if long { "10s" } else { "3s" };
        let short = [&noise[..], &["--duration", duration]].concat();
        let bad = self.driven(FAST, &[&short[..], &["--disturb", BAD_LINE]].concat())?;
        for part in ["/own/repeated", "/own/bad", "/plant/bad", "/plant/repeated"] {
            if bad.number(part)? == 0 {
                bail!("the line was disturbed, but {part} is 0");
            }
        }
        bad.tell("bad line");
        let silence = if long { "3000:60s" } else { "3000:1s" };
        let silent = self.driven(FAST, &[&short[..], &["--silence", silence]].concat())?;
        silent.count("reconnected", 1)?;
        silent.same(&bad.text("hash")?)?;
        if long {
            silent.same(&hash)?;
        }
        silent.tell("line that broke");
        let policies: &[&str] = if long { &["hold", "zero", "stop"] } else { &["zero"] };
        for policy in policies {
            let real_time = ["--real-time", "--when-late", policy, "--silence", "1000:1s"];
            let options = [&noise[..], &real_time, &["--disturb", BAD_LINE, "--duration", "2s"]];
            let paced = self.driven(PACED, &options.concat())?;
            paced.count("reconnected", 1)?;
            if paced.number("/plant/timeouts")? == 0 || paced.number("compared")? < 500 {
                bail!(
                    "the silence was not detected, or too few frames were compared: {}",
                    paced.said
                );
            }
            paced.tell(&format!("real time, {policy}"));
        }
        self.python()?;
        self.stranger()?;
        self.reverse(plant)?;
        self.other_board()
    }

    /// The page's controller balances the pendulum.
    fn python(&self) -> Result<()> {
        if find("python3").is_none() {
            println!("skipped the controller in Python: python3 is missing");
            return Ok(());
        }
        let page = std::fs::read_to_string(root().join(PAGE))?;
        let code = page.split("```python\n").nth(1).and_then(|rest| rest.split("```").next());
        let code = code.with_context(|| format!("{PAGE} contains no controller in Python"))?;
        let (script, trace) = (self.folder.join("balance.py"), self.folder.join("trace.csv"));
        std::fs::write(&script, code)?;
        let controller = format!("python3 {}", script.display());
        let trace_text = trace.display().to_string();
        let options = ["--controller", &controller, "--trace", &trace_text, "--duration", "4s"];
        let balanced = self.driven(FAST, &options)?;
        balanced.count("compared", 4_000)?;
        let rows = std::fs::read_to_string(&trace)?;
        let column =
            rows.lines().next().and_then(|head| head.split(',').position(|name| name == "angle"));
        let last = column.zip(rows.lines().last()).and_then(|(at, row)| row.split(',').nth(at));
        let angle: f64 = last.context("the trace has no angle")?.parse()?;
        if (angle - UPRIGHT).abs() > NEAR {
            bail!("the pendulum is at {angle} rad, upright is {UPRIGHT} rad");
        }
        balanced.tell(&format!(
            "balanced by {} lines of Python, {:.4} rad from upright at the end",
            code.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')).count(),
            angle - UPRIGHT
        ));
        Ok(())
    }

    /// The same program on another chip, with its community's HAL.
    fn other_board(&self) -> Result<()> {
        let socket = self.folder.join("board.sock");
        let mut qemu = program("qemu-system-arm");
        qemu.args([
            "-M",
            "netduinoplus2",
            "-display",
            "none",
            "-monitor",
            "none",
            "-serial",
            "null",
        ]);
        qemu.arg("-serial").arg(format!("unix:{},server=on,wait=off", socket.display()));
        qemu.args(["-icount", PACED, "-kernel"]).arg(&self.board);
        let mut chip = qemu.spawn().context("cannot start QEMU")?;
        let port = format!("unix:{}", socket.display());
        let mut command = program(&self.host_sim);
        command.args(["hil", SCENE, "--port", &port, "--steps", STEPS, "--json"]);
        command.args(["--controller", NOISE, "--duration", "0.5s"]);
        let said = output(&mut command);
        chip.kill()?;
        chip.wait()?;
        let report =
            Report { said: serde_json::from_str(&said?).context("host-sim printed no JSON")? };
        report.count("compared", 500)?;
        report.tell("STM32F405, clean line");
        Ok(())
    }

    /// Another model at this end: nothing runs.
    fn stranger(&self) -> Result<()> {
        let refused =
            self.tried(FAST, &["--set", "body.cart.mass=0.941", "--patience", "2s"], false)?;
        let said = String::from_utf8_lossy(&refused.stderr);
        if refused.status.code() != Some(1) || !said.contains("model (constants or initial state)")
        {
            bail!("another model was accepted: {said}");
        }
        println!("another model is refused");
        Ok(())
    }

    /// The plant here, the controller in QEMU: the trace of both on one machine.
    fn reverse(&self, plant: &Path) -> Result<()> {
        let alone = host::lines(program(plant).args([SCENE, TICKS]))?;
        let socket = self.folder.join("reverse.sock");
        let port = format!("unix:{}", socket.display());
        let served = || {
            let mut serve = program(&self.host_sim);
            serve.args(["hil", SCENE, "--serve", "--port", &port, "--json", "--patience", "60s"]);
            serde_json::from_str::<Value>(&output(&mut serve)?).context("host-sim printed no JSON")
        };
        let (lines, served) = std::thread::scope(|scope| {
            let chip = scope.spawn(|| {
                let mut command = self.qemu(&socket, PACED, &format!("controller {TICKS}"));
                emulator::run(&mut command, &self.image, Some(TIME_LIMIT))
            });
            let served = served();
            (joined(chip), served)
        });
        let (lines, served) = (lines?, served?);
        let reported = |lines: &[String]| -> Vec<String> {
            let is_reported =
                |line: &&String| line.starts_with("loop ") || line.starts_with("last ");
            lines.iter().filter(is_reported).cloned().collect()
        };
        if reported(&alone).is_empty() || reported(&alone) != reported(&lines) {
            bail!("the controller on the chip behaves differently with a remote plant");
        }
        println!(
            "the controller on the chip, its plant here: {TICKS} ticks bit-identical to both on one machine, {} steps",
            served["steps"]
        );
        Ok(())
    }

    /// Runs the plant in QEMU and its controller here; the report.
    fn driven(&self, clock: &str, options: &[&str]) -> Result<Report> {
        let done = self.tried(clock, options, true)?;
        let (said, error) =
            (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
        if !done.status.success() {
            bail!("host-sim hil {} ended with {}\n{said}{error}", options.join(" "), done.status);
        }
        let report =
            Report { said: serde_json::from_str(&said).context("host-sim printed no JSON")? };
        report.count("different", 0)?;
        Ok(report)
    }

    /// The same, however it ends; `ends` says whether the plant ends by itself.
    fn tried(&self, clock: &str, options: &[&str], ends: bool) -> Result<Output> {
        let socket = self.folder.join("plant.sock");
        _ = std::fs::remove_file(&socket);
        let mut qemu = self.qemu(&socket, clock, &format!("plant {SCENE} {PERIOD} once"));
        let mut child = None;
        std::thread::scope(|scope| {
            let chip = if ends {
                Some(scope.spawn(move || emulator::run(&mut qemu, &self.image, Some(TIME_LIMIT))))
            } else {
                child = Some(qemu.stdout(Stdio::null()).spawn().context("cannot start QEMU")?);
                None
            };
            let port = format!("unix:{}", socket.display());
            let mut command = program(&self.host_sim);
            command.args(["hil", SCENE, "--port", &port, "--steps", STEPS, "--json"]).args(options);
            println!("$ {}", shown(&command));
            let done = command.output().context("cannot run host-sim");
            if let Some(done) = done.as_ref().ok().filter(|done| ends && !done.status.success()) {
                // Before the plant, which waits for another controller, is ended.
                eprintln!("{}", String::from_utf8_lossy(&done.stderr));
            }
            if let Some(child) = &mut child {
                child.kill()?;
                child.wait()?;
            }
            if let Some(chip) = chip {
                joined(chip)?;
            }
            done
        })
    }

    fn qemu(&self, socket: &Path, clock: &str, arguments: &str) -> Command {
        let mut qemu = program("qemu-system-arm");
        qemu.args(["-M", "mps2-an386", "-display", "none", "-monitor", "none", "-serial"]);
        qemu.arg(format!("unix:{},server=on,wait=off", socket.display()));
        qemu.args(["-semihosting-config", "enable=on,target=native", "-icount", clock, "-kernel"]);
        qemu.arg(&self.image).args(["-append", arguments]);
        qemu
    }
}

/// What the emulator's thread came to.
fn joined(chip: ScopedJoinHandle<'_, Result<Vec<String>>>) -> Result<Vec<String>> {
    chip.join().map_err(|_| anyhow!("the emulator's thread panicked"))?
}

/// What `host-sim hil --json` said.
struct Report {
    said: Value,
}

impl Report {
    fn at(&self, path: &str) -> Option<&Value> {
        if path.starts_with('/') { self.said.pointer(path) } else { self.said.get(path) }
    }

    fn number(&self, path: &str) -> Result<u64> {
        self.at(path).and_then(Value::as_u64).with_context(|| format!("no {path} in {}", self.said))
    }

    fn text(&self, path: &str) -> Result<String> {
        let text = self.at(path).and_then(Value::as_str).map(str::to_owned);
        text.with_context(|| format!("no {path} in {}", self.said))
    }

    fn count(&self, path: &str, expected: u64) -> Result<()> {
        let found = self.number(path)?;
        if found != expected {
            bail!("{path} is {found}, expected {expected}: {}", self.said);
        }
        Ok(())
    }

    /// The state is that of a run on a clean line.
    fn same(&self, hash: &str) -> Result<()> {
        let found = self.text("hash")?;
        if found != hash {
            bail!("the state's hash is {found}, on a clean line it was {hash}");
        }
        Ok(())
    }

    fn tell(&self, what: &str) {
        let ms = |name: &str| {
            self.said["latency"][name]
                .as_f64()
                .map_or_else(String::new, |s| format!("{:.3}", s * 1e3))
        };
        println!(
            "{what}: {} frames compared, {} different; latency 50 % {} ms, 99 % {} ms, most {} ms; \
             own {}; plant {}; disturbed {}",
            self.said["compared"],
            self.said["different"],
            ms("p50"),
            ms("p99"),
            ms("most"),
            self.said["own"],
            self.said["plant"],
            self.said["disturbed"]
        );
    }
}
