//! A program below valgrind's callgrind.
//!
//! `program, functions, arguments => instructions`: exactly, and alike each time.

use std::path::Path;

use anyhow::{Context as _, Result};

use crate::command::{output, program};

/// Instructions that a program spends in the functions that `functions`, a pattern, names, and in
/// what they call.
///
/// # Errors
/// Where the program does not run below callgrind, or that says nothing that is understood.
pub fn count(path: &Path, functions: &str, arguments: &[&str]) -> Result<u64> {
    let mut command = program("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--log-fd=1"]);
    command.arg(format!("--toggle-collect={functions}"));
    let said = output(command.arg(path).args(arguments))?;
    collected(&said).with_context(|| format!("callgrind printed no count:\n{said}"))
}

/// The count in what callgrind says. None at all means that it did not meet the function.
fn collected(said: &str) -> Option<u64> {
    let line = said.lines().find_map(|line| line.split_once("Collected : "))?.1;
    line.trim().parse().ok().filter(|count| *count > 0)
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
