//! `cargo xtask audit`: what the linked steps of the shipped models must not reach.
//!
//! `roots, linked alone => symbols and instructions => findings`. Every check is then repeated on
//! an image with one planted fault, which it must find: a check that cannot fail says nothing.

use anyhow::{Result, bail};

use crate::image::Image;
use crate::steps::Steps;
use crate::toolchain::Toolchain;
use crate::{firmware, setup};

/// A thing that must not be there.
struct Check {
    /// What it is.
    name: &'static str,
    /// The feature of the firmware that plants it.
    plant: &'static str,
    findings: fn(&Image) -> Vec<String>,
}

const CHECKS: [Check; 4] = [
    Check { name: "panic", plant: "plant-panic", findings: panics },
    Check { name: "allocation", plant: "plant-alloc", findings: allocations },
    Check { name: "fused multiply-add", plant: "plant-fma", findings: fused },
    Check { name: "soft float in an f32 step", plant: "plant-soft-float", findings: soft_float },
];

/// `cargo xtask audit`.
///
/// # Errors
/// Where a check fails on the clean image, or does not fail on the image with its plant.
pub fn run() -> Result<()> {
    let toolchain = setup::complete()?;
    let mut steps = Steps::default();
    add_steps(&toolchain, &mut steps);
    steps.finish()
}

/// The audit as steps: the clean image, then one per plant.
pub fn add_steps(toolchain: &Toolchain, steps: &mut Steps) {
    steps.step("audit of the linked steps", || clean(toolchain));
    for check in &CHECKS {
        let title = format!("audit finds a planted fault: {}", check.name);
        steps.step(&title, || planted(toolchain, check));
    }
}

fn clean(toolchain: &Toolchain) -> Result<()> {
    let image = Image::read(&firmware::build_audit(toolchain, None)?)?;
    let roots: Vec<&str> = roots(&image).collect();
    println!("{} steps, {} functions linked", roots.len(), image.functions().count());
    if roots.is_empty() {
        bail!("the image holds no step");
    }
    let mut failed = Vec::new();
    for check in &CHECKS {
        let findings = (check.findings)(&image);
        println!("{:<28} {}", check.name, if findings.is_empty() { "none" } else { "FOUND" });
        for finding in &findings {
            println!("    {finding}");
        }
        if !findings.is_empty() {
            failed.push(check.name);
        }
    }
    if !failed.is_empty() {
        bail!("the linked steps reach: {}", failed.join(", "));
    }
    Ok(())
}

fn planted(toolchain: &Toolchain, check: &Check) -> Result<()> {
    let image = Image::read(&firmware::build_audit(toolchain, Some(check.plant))?)?;
    let findings = (check.findings)(&image);
    let Some(finding) = findings.first() else {
        bail!("{} was planted and not found", check.name);
    };
    println!("found {}, the first: {finding}", findings.len());
    Ok(())
}

/// Roots are named `audit::roots::SCENE::SCHEME_PRECISION`.
fn roots(image: &Image) -> impl Iterator<Item = &str> {
    let scene = |name: &&str| {
        let root = name.strip_prefix("audit::roots::");
        root.is_some_and(|root| root.ends_with("_f32") || root.ends_with("_f64"))
    };
    image.symbols().filter(scene)
}

fn panics(image: &Image) -> Vec<String> {
    symbols_with(image, &["panic", "unwrap", "core::fmt", "slice_index"])
}

fn allocations(image: &Image) -> Vec<String> {
    symbols_with(image, &["__rust_alloc", "__rg_alloc", "GlobalAlloc", "alloc::alloc"])
}

fn symbols_with(image: &Image, parts: &[&str]) -> Vec<String> {
    let bad = |name: &&str| parts.iter().any(|part| name.contains(part));
    image.symbols().filter(bad).map(str::to_owned).collect()
}

/// A fused operation rounds once where the host rounds twice. `vmla`, which LLVM emits, is not
/// fused: it rounds the product.
fn fused(image: &Image) -> Vec<String> {
    let mut findings = Vec::new();
    for function in image.functions() {
        for mnemonic in &function.mnemonics {
            if ["vfma", "vfms", "vfnma", "vfnms"].iter().any(|fused| mnemonic.starts_with(fused)) {
                findings.push(format!("{mnemonic} in {}", function.name));
            }
        }
    }
    findings
}

fn soft_float(image: &Image) -> Vec<String> {
    let mut findings = Vec::new();
    for root in roots(image).filter(|name| name.ends_with("_f32")) {
        for function in image.reach(root).unwrap_or_default() {
            if is_soft_float(&function.name) {
                findings.push(format!("{} from {root}", function.name));
            }
        }
    }
    findings
}

/// The run-time routines of single and double precision, by the names of the Arm run-time ABI
/// and by those of the compiler's library.
fn is_soft_float(name: &str) -> bool {
    if let Some(routine) = name.strip_prefix("__aeabi_") {
        // `d…`, `f…`: arithmetic; `cd…`, `cf…`: comparison; `…2d`, `…2f`: conversion.
        return routine.starts_with(['d', 'f', 'c'])
            || routine.ends_with("2d")
            || routine.ends_with("2f");
    }
    let stem = name.rsplit("::").next().unwrap_or(name);
    ["df2", "df3", "sf2", "sf3", "sidf", "sisf", "didf", "disf", "dfsi", "sfsi", "dfdi", "sfdi"]
        .iter()
        .any(|end| stem.starts_with("__") && stem.ends_with(end))
        || name.contains("compiler_builtins::float")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soft_float_routines_are_known_by_name() {
        for name in [
            "__aeabi_dmul",
            "__aeabi_f2d",
            "__aeabi_i2d",
            "__aeabi_dcmplt",
            "__adddf3",
            "compiler_builtins::float::mul::__muldf3",
            "compiler_builtins::float::cmp::cmp::<f64>",
        ] {
            assert!(is_soft_float(name), "{name}");
        }
        for name in ["__aeabi_memclr4", "__aeabi_memcpy", "__aeabi_uldivmod", "libm::math::sqrtf"] {
            assert!(!is_soft_float(name), "{name}");
        }
    }
}
