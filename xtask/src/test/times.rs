//! The times of the steps and of the slowest tests, as docs/development.md shows them.
//!
//! `steps, slowest tests, machine => section between two marks`. Nothing else of the page is
//! touched; where it has no such section, one is added at its end.

use anyhow::{Context as _, Result, bail};

use crate::chip::Toolchain;
use crate::command::{output, program, root};
use crate::steps::{Step, Steps};

use super::cases::{Case, cores};

const FILE: &str = "docs/development.md";
const BEGIN: &str = "<!-- times: written by `cargo xtask test --write-times` -->";
const END: &str = "<!-- end of the times -->";

/// Writes the section.
///
/// # Errors
/// Where a step failed, for then its time says nothing, or the page cannot be read or written.
pub fn write(steps: &Steps, slowest: &[Case], toolchain: &Toolchain) -> Result<()> {
    if !steps.done().iter().all(Step::passed) {
        bail!("a step failed or was skipped: no times are written");
    }
    let section = section(&machine(toolchain)?, steps.done(), slowest);
    let file = root().join(FILE);
    let page = std::fs::read_to_string(&file).with_context(|| format!("cannot read {FILE}"))?;
    std::fs::write(&file, replace(&page, &section)?)
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("\nwritten: {FILE}");
    Ok(())
}

/// Cores and compilers in words.
fn machine(toolchain: &Toolchain) -> Result<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = output(program(rustc).arg("--version"))?;
    let version: Vec<&str> = version.split_whitespace().take(2).collect();
    let cores = cores();
    let model = processor(&std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default());
    let (host, target) = (version.join(" "), toolchain.describe_compiler()?);
    Ok(format!("{cores} cores{model}, host {host}, target {target}"))
}

/// The processor's name with its clock, where the system tells.
fn processor(info: &str) -> String {
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map(|(_, name)| format!(" ({})", name.trim())).unwrap_or_default()
}

fn section(machine: &str, steps: &[Step], slowest: &[Case]) -> String {
    let mut text = format!("{BEGIN}\n\nOn {machine}:\n\n| step | time, s |\n| --- | ---: |\n");
    for step in steps {
        text += &format!("| {} | {:.1} |\n", step.title, step.time.as_secs_f64());
    }
    let total: f64 = steps.iter().map(|step| step.time.as_secs_f64()).sum();
    text += &format!("| **all** | **{total:.1}** |\n\n");
    text += "The slowest tests:\n\n| test | time, s |\n| --- | ---: |\n";
    for case in slowest {
        text += &format!("| `{}` | {:.1} |\n", case.name, case.seconds);
    }
    text + "\n" + END
}

/// The page with this section.
///
/// # Errors
/// Where one of the two marks is missing or they stand the wrong way round.
fn replace(page: &str, section: &str) -> Result<String> {
    match (page.find(BEGIN), page.find(END)) {
        (None, None) => Ok(format!("{}\n\n{section}\n", page.trim_end())),
        (Some(begin), Some(end)) if begin < end => {
            Ok(format!("{}{section}{}", &page[..begin], &page[end + END.len()..]))
        }
        _ => bail!("{FILE}: the marks of the times section do not match"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::cases::Outcome;
    use super::*;

    #[test]
    fn only_the_section_is_replaced() {
        let case = Case { name: "kernel a::b".to_owned(), seconds: 2.25, outcome: Outcome::Passed };
        let section = section("2 cores", &[], &[case]);
        assert!(section.contains("| `kernel a::b` | 2.2 |"), "{section}");
        let page = replace("# Development\n", &section).unwrap() + "\n## Further\n";
        assert!(page.starts_with("# Development\n\n<!--"));
        let again = replace(&page, &format!("{BEGIN}\nnew\n{END}")).unwrap();
        assert_eq!(again, format!("# Development\n\n{BEGIN}\nnew\n{END}\n\n## Further\n"));
        assert!(replace(BEGIN, &section).is_err());
    }

    #[test]
    fn the_processor_is_named() {
        let info = "processor\t: 0\nmodel name\t: A Processor 2.0\n";
        assert_eq!(processor(info), " (A Processor 2.0)");
        assert_eq!(processor(""), "");
    }
}
