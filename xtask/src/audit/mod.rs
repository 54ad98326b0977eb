//! `cargo xtask audit`: forbidden functions in the linked steps and calls of a running model.
//!
//! `roots, linked alone => functions that each reaches => findings`. One image holds the clean roots
//! and those with a planted fault, which each check must find: a check that cannot fail proves
//! nothing.

mod checks;
mod image;
mod roots;

use std::collections::BTreeMap;

use anyhow::{Result, bail};

use crate::chip::{Toolchain, firmware, setup};
use crate::steps::Steps;

use checks::{CHECKS, Check};
pub use image::{Image, instruction};
pub use roots::Root;
use roots::{CALLS, DOUBLE, ENDS, LAWFUL, MODELS, PRECISIONS, SCHEMES, STEPPING, planted};

/// `cargo xtask audit`.
///
/// # Errors
/// Where a root is missing or not clean, or a check does not find its planted fault.
pub fn run() -> Result<()> {
    let toolchain = setup::complete()?;
    let mut steps = Steps::default();
    add_steps(&toolchain, &mut steps);
    steps.finish()
}

/// The audit as steps: the image, its clean roots, one step per planted fault.
pub fn add_steps(toolchain: &Toolchain, steps: &mut Steps) {
    let mut image = None;
    steps.step("audit: the roots are linked", || {
        image = Some(Image::read(&firmware::build_audit(toolchain)?)?);
        Ok(())
    });
    let Some(image) = image else { return };
    steps.step("audit: every root is clean", || clean(&image));
    for check in &CHECKS {
        let title = format!("audit: a planted fault is found: {}", check.name);
        steps.step(&title, || find_planted(&image, check));
    }
}

/// The forbidden functions that each root reaches, by symbol.
type Findings = BTreeMap<String, Vec<String>>;

fn clean(image: &Image) -> Result<()> {
    let mut findings = Findings::new();
    for symbol in image.symbols() {
        if let Some(root) = Root::parse(symbol) {
            findings.insert(symbol.to_owned(), inspect(image, &root)?);
        }
    }
    println!("{}", table(&findings));
    let mut faulty = 0;
    for (root, findings) in findings.iter().filter(|(_, findings)| !findings.is_empty()) {
        faulty += 1;
        println!("{root} reaches:");
        findings.iter().for_each(|finding| println!("    {finding}"));
    }
    let missing = missing(&findings);
    if faulty > 0 || !missing.is_empty() {
        bail!("{faulty} roots are not clean; missing: [{}]", missing.join(", "));
    }
    Ok(())
}

/// All findings in what a root reaches.
fn inspect(image: &Image, root: &Root) -> Result<Vec<String>> {
    let reach = image.reach(&root.symbol())?;
    let mut findings = Vec::new();
    for check in CHECKS.iter().filter(|c| !c.single_only || root.is_single()) {
        for function in &reach {
            let found = (check.findings)(function);
            findings.extend(found.into_iter().map(|finding| format!("{}: {finding}", check.name)));
        }
    }
    Ok(findings)
}

/// The check finds its own planted fault.
fn find_planted(image: &Image, check: &Check) -> Result<()> {
    let root = planted(check.plant);
    let reach = image.reach(&root)?;
    let findings: Vec<String> = reach.into_iter().flat_map(check.findings).collect();
    let Some(finding) = findings.first() else {
        bail!("the planted fault {} was not found", check.name);
    };
    println!("{root} reaches {finding}");
    Ok(())
}

/// Whether a scheme's steps are among the roots in a precision.
fn is_there(scheme: &str, precision: &str) -> bool {
    precision == PRECISIONS[0] || DOUBLE.contains(&scheme)
}

/// Roots that there must be.
fn expected() -> impl Iterator<Item = Root> {
    let ends = STEPPING.into_iter().chain(ENDS).map(Root::end);
    let both = PRECISIONS.into_iter().flat_map(|precision| {
        let steps = MODELS.into_iter().flat_map(move |model| {
            let schemes = SCHEMES.into_iter().filter(move |scheme| is_there(scheme, precision));
            schemes.map(move |scheme| Root::step(model, scheme, precision))
        });
        let call = move |what| Root::call(what, MODELS[1], "leapfrog", precision);
        steps.chain(CALLS.into_iter().map(call))
    });
    let laws = ["f32", "fixed"].into_iter().flat_map(|precision| {
        LAWFUL.into_iter().map(move |model| Root::step(model, "leapfrog", precision))
    });
    both.chain(ends).chain(laws)
}

fn missing(findings: &Findings) -> Vec<String> {
    expected().map(|root| root.symbol()).filter(|root| !findings.contains_key(root)).collect()
}

/// Verdicts by scheme and precision, by call, and of the further models.
fn table(findings: &Findings) -> String {
    let cell = |roots: &[Root]| {
        let all: Option<Vec<_>> = roots.iter().map(|root| findings.get(&root.symbol())).collect();
        match all {
            _ if roots.is_empty() => "–",
            None => "MISSING",
            Some(all) if all.iter().all(|findings| findings.is_empty()) => "clean",
            Some(_) => "FAULTY",
        }
    };
    let line = |title: &str, roots: &dyn Fn(&str) -> Vec<Root>| {
        let [single, double] = PRECISIONS.map(|precision| cell(&roots(precision)));
        format!("{title:<32} {single:<8} {double}\n")
    };
    let mut text = format!("{:<32} {:<8} {}\n", "step", PRECISIONS[0], PRECISIONS[1]);
    for scheme in SCHEMES {
        text += &line(scheme, &|precision| {
            let there = is_there(scheme, precision);
            MODELS.into_iter().filter(|_| there).map(|m| Root::step(m, scheme, precision)).collect()
        });
    }
    text += "\nbetween steps\n";
    for call in CALLS {
        text += &line(call, &|precision| vec![Root::call(call, MODELS[1], "leapfrog", precision)]);
    }
    text += "\nbetween plant and drivers\n";
    for end in STEPPING.into_iter().chain(ENDS) {
        text += &format!("{end:<32} {}\n", cell(&[Root::end(end)]));
    }
    let further = findings.iter().filter(|(symbol, _)| {
        Root::parse(symbol)
            .is_some_and(|root| root.what == "step" && !MODELS.contains(&root.model.as_str()))
    });
    let (count, clean) = further.fold((0, 0), |(count, clean), (_, found)| {
        (count + 1, clean + u32::from(found.is_empty()))
    });
    text += &format!("\nsteps of the further models: {count}, clean: {clean}\n");
    text + &format!("models of the schemes' steps: {}", MODELS.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_that_is_not_there_or_not_clean_shows() {
        let mut findings: Findings = expected().map(|root| (root.symbol(), Vec::new())).collect();
        findings.insert(Root::step("3rrr", "leapfrog", "f32").symbol(), Vec::new());
        assert!(missing(&findings).is_empty());
        let all = table(&findings);
        assert!(!all.contains("MISSING") && !all.contains("FAULTY"), "{all}");
        let further = 1 + 2 * LAWFUL.len();
        assert!(all.contains(&format!("further models: {further}, clean: {further}")), "{all}");
        let faulty = Root::step("every-kind", "pefrl", "f32").symbol();
        findings.insert(faulty, vec!["panic: x".to_owned()]);
        findings.remove(&Root::step("four-bar", "rk4", "f32").symbol());
        let all = table(&findings);
        let row = |scheme: &str| {
            let line = all.lines().find(|line| line.starts_with(scheme)).unwrap();
            line.split_whitespace().skip(1).map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(row("pefrl"), ["FAULTY", "–"]);
        assert_eq!(row("leapfrog"), ["clean", "clean"]);
        assert_eq!(row("rk4"), ["MISSING", "–"]);
        assert_eq!(missing(&findings), ["audit.step.four-bar.rk4.f32"]);
    }
}
