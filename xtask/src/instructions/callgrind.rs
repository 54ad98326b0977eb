//! A program below valgrind's callgrind.
//!
//! `program, arguments => instructions per step`: of one function and what it calls, exactly and alike each time.

use std::path::Path;

use anyhow::{Context as _, Result};

use crate::command::{find, output, program};

/// What to do where it is missing.
pub const REMEDY: &str = "apt-get install valgrind, or your system's package of it";

/// The function that is counted.
const FUNCTION: &str = "*counted_steps*";

/// Whether there is valgrind on this machine.
pub fn is_there() -> bool {
    find("valgrind").is_some()
}

/// Instructions per step, rounded.
///
/// # Errors
/// Where the program does not run below callgrind, or that says nothing that is understood.
pub fn per_step(steps: &Path, what: &str, how: &str, count: u64) -> Result<u64> {
    let mut command = program("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--log-fd=1"]);
    command.arg(format!("--toggle-collect={FUNCTION}"));
    let said = output(command.arg(steps).args([what, how, &count.to_string()]))?;
    let collected =
        collected(&said).with_context(|| format!("callgrind said no count:\n{said}"))?;
    Ok((collected as f64 / count as f64).round() as u64)
}

/// The count in what callgrind says. None at all means that it did not meet the function.
fn collected(said: &str) -> Option<u64> {
    let line = said.lines().find_map(|line| line.split_once("Collected : "))?.1;
    line.trim().parse().ok().filter(|count| *count > 0)
}

/// Floating-point operations of a step in double precision.
///
/// # Errors
/// Where the program does not run.
pub fn flops(steps: &Path, what: &str) -> Result<f64> {
    let said = output(program(steps).args([what, "flops", "1"]))?;
    let flops = said.split_whitespace().next().and_then(|word| word.parse().ok());
    flops.with_context(|| format!("no flops in `{said}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_count_is_found_among_what_callgrind_says() {
        let said = "==7== For counts\n68e580a53cbaea73\n==7== Collected : 111573\n==7== I refs: 1";
        assert_eq!(collected(said), Some(111_573));
        assert_eq!(collected("==7== Collected : 0\n"), None);
        assert_eq!(collected("no such program"), None);
    }
}
