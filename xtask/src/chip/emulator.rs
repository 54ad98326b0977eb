//! Runs a built program in QEMU and decodes its defmt frames into lines.
//!
//! `image => lines, verdict`. QEMU is cargo's runner for the target (`.cargo/config.toml`).

use std::io::Read as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail};
use defmt_decoder::{DecodeError, StreamDecoder, Table};

/// Runs `command`, which is to start the image in QEMU; shows its lines and returns them.
///
/// # Errors
/// Where the image has no defmt data, the program fails, or it takes longer than `limit`.
pub fn run(command: &mut Command, image: &Path, limit: Option<Duration>) -> Result<Vec<String>> {
    let elf = std::fs::read(image).with_context(|| format!("cannot read {}", image.display()))?;
    let table = Table::parse(&elf)?.context("the image has no defmt data")?;
    let mut decoder = table.new_stream_decoder();
    let mut child = command.stdout(Stdio::piped()).spawn().context("cannot start the emulator")?;
    let chunks = read(&mut child)?;
    let start = Instant::now();
    let mut lines = Vec::new();
    loop {
        let chunk = match limit {
            None => chunks.recv().map_err(RecvTimeoutError::from),
            Some(limit) => chunks.recv_timeout(limit.saturating_sub(start.elapsed())),
        };
        match chunk {
            Ok(chunk) => decode(&mut *decoder, &chunk, &mut lines)?,
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                child.kill()?;
                child.wait()?;
                bail!("the program ran longer than {} s (--long sets no limit)", {
                    start.elapsed().as_secs()
                });
            }
        }
    }
    let status = child.wait()?;
    if !status.success() {
        let last = lines.last().map_or("it printed nothing", String::as_str);
        bail!("the program failed ({status}): {last}");
    }
    Ok(lines)
}

/// The child's output as it comes.
fn read(child: &mut Child) -> Result<Receiver<Vec<u8>>> {
    let mut output = child.stdout.take().context("the emulator has no output")?;
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(count @ 1..) = output.read(&mut buffer) {
            if sender.send(buffer[..count].to_vec()).is_err() {
                break;
            }
        }
    });
    Ok(receiver)
}

fn decode(decoder: &mut dyn StreamDecoder, chunk: &[u8], lines: &mut Vec<String>) -> Result<()> {
    decoder.received(chunk);
    loop {
        match decoder.decode() {
            Ok(frame) => {
                let message = frame.display_message().to_string();
                let line = match frame.level() {
                    Some(level) => format!("{}: {message}", level.as_str()),
                    None => message,
                };
                println!("{line}");
                lines.push(line);
            }
            Err(DecodeError::UnexpectedEof) => return Ok(()),
            Err(DecodeError::Malformed) => bail!("the program printed what defmt cannot decode"),
        }
    }
}
