//! Runs a program in QEMU that prints over its UART and never ends by itself.
//!
//! `command => lines until "end"`. QEMU's standard input and output are that UART, with QEMU's own keys: the host
//! ends the run as one would at a terminal, and the program needs nothing that a board does not have.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail};

/// The program's last line.
const END: &str = "end";
/// The first word of the last line of a program that gave up.
const ERROR: &str = "error:";
/// Ctrl-A x: QEMU ends.
const QUIT: &[u8] = b"\x01x";
/// What the program may still say after its first word of an error.
const GRACE: Duration = Duration::from_millis(500);

/// Runs `command`, which is to start the image in QEMU; shows its lines and returns them without the last.
///
/// # Errors
/// Where the program says that it failed, ends without its last line, or takes longer than `limit`.
pub fn run(command: &mut Command, limit: Duration) -> Result<Vec<String>> {
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().context("cannot start the emulator")?;
    let lines = read(&mut child)?;
    let outcome = listen(&lines, limit);
    // Where it has ended already, its status says how.
    _ = child.stdin.take().context("the emulator has no input")?.write_all(QUIT);
    let status = child.wait()?;
    match outcome {
        Err(error) if !status.success() => {
            Err(error.context(format!("the emulator ended with {status}")))
        }
        outcome => outcome,
    }
}

/// The lines up to the last one.
fn listen(lines: &Receiver<String>, limit: Duration) -> Result<Vec<String>> {
    let start = Instant::now();
    let mut heard: Vec<String> = Vec::new();
    loop {
        let line = lines.recv_timeout(limit.saturating_sub(start.elapsed()));
        if let Ok(line) = &line {
            println!("{line}");
        }
        match line {
            Ok(line) if line == END => return Ok(heard),
            Ok(line) if line.starts_with(ERROR) => {
                // A panic's message goes on in the next line.
                let rest = std::iter::from_fn(|| lines.recv_timeout(GRACE).ok());
                let words: Vec<String> = std::iter::once(line).chain(rest).collect();
                bail!("the program failed: {}", words.join(" "));
            }
            Ok(line) => heard.push(line),
            Err(RecvTimeoutError::Timeout) => bail!(
                "the program did not end within {} s; its last line: {}",
                limit.as_secs(),
                heard.last().map_or("none", String::as_str)
            ),
            Err(RecvTimeoutError::Disconnected) => bail!("the program did not print `{END}`"),
        }
    }
}

/// The child's lines as they come.
fn read(child: &mut Child) -> Result<Receiver<String>> {
    let output = child.stdout.take().context("the emulator has no output")?;
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    Ok(receiver)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(lines: &[&str]) -> Result<Vec<String>> {
        let (sender, receiver) = channel();
        for line in lines {
            sender.send((*line).to_owned()).unwrap();
        }
        drop(sender);
        listen(&receiver, Duration::from_secs(1))
    }

    #[test]
    fn a_program_that_says_its_last_word_has_run() {
        assert_eq!(heard(&["one", "two", "end", "more"]).unwrap(), ["one", "two"]);
    }

    #[test]
    fn a_program_that_gives_up_or_breaks_off_has_not() {
        let error = heard(&["one", "error: panicked at x.rs:1:2:", "late", "end"]).unwrap_err();
        assert!(format!("{error}").contains("x.rs:1:2: late"), "{error}");
        assert!(heard(&["one", "two"]).is_err());
    }

    #[test]
    fn a_program_that_stands_still_is_ended() {
        let (sender, receiver) = channel();
        sender.send("one".to_owned()).unwrap();
        let error = listen(&receiver, Duration::from_millis(50)).unwrap_err();
        assert!(format!("{error}").contains("last line: one"), "{error}");
    }
}
