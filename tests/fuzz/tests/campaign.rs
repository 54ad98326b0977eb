//! A short campaign, always the same; the inputs that failed before; and that faults are found.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Output};

use dbd_fuzz::planted::{ABORT, BROKEN, HANG, MEMORY, OVERFLOW, PANIC, PlantedTarget};
use dbd_fuzz::{block, corpus, targets};

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_dbd-fuzz"))
}

fn campaign(target: &str, [inputs, seed]: [u64; 2], limit: &str, findings: &Path) -> Output {
    let mut command = program();
    command.args(["run", "--target", target, "--seed", &seed.to_string(), "--limit", limit]);
    command.args(["--inputs", &inputs.to_string()]).arg("--findings").arg(findings);
    // A trace of calls takes time, and more on a busy machine.
    command.env("RUST_BACKTRACE", "0");
    command.output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs a block or more of a target.
fn finds_nothing(target: &str, inputs: u64) {
    let findings = tempfile::tempdir().unwrap();
    let done = campaign(target, [inputs, 2297], "60", findings.path());
    let said = text(&done.stdout);
    assert_eq!(done.status.code(), Some(0), "{said}{}", text(&done.stderr));
    let row = said.lines().find(|line| line.starts_with(target)).unwrap();
    let counts: Vec<u64> = row.split_whitespace().filter_map(|count| count.parse().ok()).collect();
    // Executions, and of them those that were not refused.
    assert!(counts[0] + counts[2] >= inputs && counts[1] * 20 > counts[0], "{row}");
}

#[test]
fn scenes() {
    finds_nothing("scene", 4_000);
}

#[test]
fn snapshots() {
    finds_nothing("snapshot", 10_000);
}

#[test]
fn steps() {
    finds_nothing("step", 40_000);
}

#[test]
fn lines() {
    finds_nothing("line", 50_000);
}

#[test]
fn command_lines() {
    finds_nothing("command-line", 200);
}

#[test]
fn what_failed_before_fails_no_more() {
    let files = corpus::files(&corpus::failed());
    assert!(!files.is_empty());
    let done = program().arg("replay").output().unwrap();
    let said = text(&done.stdout);
    assert_eq!(done.status.code(), Some(0), "{said}{}", text(&done.stderr));
    assert_eq!(said.lines().count(), files.len(), "{said}");
}

/// Whatever a fault does to its process, it is found, kept under its target's name, and the
/// campaign goes on.
#[test]
fn planted_faults_are_found() {
    let findings = tempfile::tempdir().unwrap();
    let done = campaign("planted", [120, 8], "2", findings.path());
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    let said = text(&done.stdout);
    for message in [
        "planted.rs",
        "attempt to add with overflow",
        "it is whole: planted",
        "an input takes too long",
        "an input ends the process",
        "memory allocation of",
    ] {
        assert!(said.contains(message), "{message}: {said}");
    }
    let files = corpus::files(findings.path());
    let kept: BTreeSet<Vec<u8>> = files.iter().map(|file| std::fs::read(file).unwrap()).collect();
    for fault in [PANIC, OVERFLOW, BROKEN] {
        assert!(kept.contains(fault), "{}: {said}", text(fault));
    }
    for fault in [HANG, MEMORY, ABORT] {
        assert!(kept.iter().any(|input| input.ends_with(fault)), "{}: {said}", text(fault));
    }
    for file in files {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        assert_eq!(targets::of_file(&name).map(|target| target.name()), Some("planted"));
        let kept = std::fs::read(&file).unwrap();
        if block::file_name(&PlantedTarget, &kept) == name {
            continue;
        }
        // It was made smaller, and fails alone.
        let again = program().arg("replay").arg(&file).output().unwrap();
        assert_eq!(again.status.code(), Some(1), "{name}");
    }
}
