//! Names that a project may have: cargo's rules for packages, and none that its dependencies have.

use std::fmt;

use miette::Diagnostic;
use thiserror::Error;

/// What a crate cannot be called: keywords, names that cargo or the compiler keeps.
const KEPT: &[&str] = &[
    "abstract",
    "alloc",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "build",
    "const",
    "continue",
    "core",
    "crate",
    "deps",
    "do",
    "dyn",
    "else",
    "enum",
    "examples",
    "extern",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "incremental",
    "let",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "proc-macro",
    "proc_macro",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "std",
    "struct",
    "super",
    "test",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
];

/// Names of devices, which Windows keeps.
const DEVICES: &[&str] = &[
    "aux", "con", "nul", "prn", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8",
    "com9", "lpt1", "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9",
];

/// Crates that the project uses.
const USED: &[&str] = &[
    "cortex-m",
    "cortex-m-rt",
    "dbd-kernel",
    "dbd-scene",
    "libm",
    "riscv",
    "riscv-rt",
    "semihosting",
];

/// Letters of a name: what file systems and registries take.
const LONGEST: usize = 64;

/// Why a project or a scene cannot be called so.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("\"{}\" is not a valid name for a {what}: {why}", dbd_scene::shortened(name))]
pub struct NameError {
    /// What is to have the name.
    what: &'static str,
    name: String,
    why: String,
}

impl Diagnostic for NameError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let rule = "a name has letters a to z, digits, - and _, and begins with a letter";
        let (problem, example) = match self.what {
            SCENE => (letters as fn(&str) -> Option<String>, "my-scene"),
            _ => (problem as fn(&str) -> Option<String>, "my-plant"),
        };
        let name = right(&self.name, problem).unwrap_or_else(|| example.into());
        Some(Box::new(format!("{rule}: {name}")))
    }
}

/// Whether a project may be called so.
///
/// # Errors
/// Where cargo would refuse the name or warn of it, or a dependency has it.
pub fn check(name: &str) -> Result<(), NameError> {
    match problem(name) {
        Some(why) => Err(NameError { what: "project", name: name.to_owned(), why }),
        None => Ok(()),
    }
}

const SCENE: &str = "scene";

/// Whether a scene, and so its file and the folder of its results, may be called so.
///
/// # Errors
/// Where a file system or a shell would have trouble with it.
pub fn check_scene(name: &str) -> Result<(), NameError> {
    match letters(name) {
        Some(why) => Err(NameError { what: SCENE, name: name.to_owned(), why }),
        None => Ok(()),
    }
}

/// What is wrong with a name whatever it is of.
fn letters(name: &str) -> Option<String> {
    let Some(first) = name.chars().next() else { return Some("it is empty".into()) };
    if let Some(odd) = name.chars().find(|c| !(c.is_ascii_alphanumeric() || "-_".contains(*c))) {
        return Some(format!("it has a {odd:?}"));
    }
    if !first.is_ascii_alphabetic() {
        return Some(format!("it begins with {first:?}"));
    }
    if name.len() > LONGEST {
        return Some(format!("it has more than {LONGEST} letters"));
    }
    DEVICES
        .contains(&name.to_ascii_lowercase().as_str())
        .then(|| "an operating system keeps this name".into())
}

fn problem(name: &str) -> Option<String> {
    if let Some(why) = letters(name) {
        return Some(why);
    }
    let lower = name.to_ascii_lowercase();
    if KEPT.contains(&lower.as_str()) {
        return Some("Rust or cargo keeps this name".into());
    }
    let same = |used: &&str| used.replace('-', "_") == lower.replace('-', "_");
    USED.iter().any(same).then(|| "a crate that it uses has this name".into())
}

/// The nearest right name.
fn right(name: &str, problem: fn(&str) -> Option<String>) -> Option<String> {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
    let name: String = name.chars().map(plain).take(LONGEST - 6).collect();
    let name = name.trim_start_matches(|c: char| !c.is_ascii_alphabetic()).trim_end_matches('-');
    let name = name.to_ascii_lowercase();
    let candidates = [name.clone(), format!("{name}-plant")];
    candidates.into_iter().find(|name| problem(name).is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cargos_rules_hold_and_a_right_name_is_proposed() {
        for name in ["my-plant", "a", "Plant_2"] {
            assert_eq!(check(name), Ok(()));
        }
        for (name, why, right) in [
            ("", "is empty", "my-plant"),
            ("my plant", "has a ' '", "my-plant"),
            ("2-plants", "begins with '2'", "plants"),
            ("-x", "begins with '-'", "x"),
            ("größe", "has a 'ö'", "gr--e"),
            ("test", "keeps this name", "test-plant"),
            ("Self", "keeps this name", "self-plant"),
            ("NUL", "keeps this name", "nul-plant"),
            ("dbd_kernel", "a crate that it uses", "dbd_kernel-plant"),
            ("..", "has a '.'", "my-plant"),
            (&"x".repeat(65), "more than 64", "xxx"),
        ] {
            let error = check(name).unwrap_err();
            let help = error.help().unwrap().to_string();
            assert!(error.to_string().contains(why), "{error}");
            assert!(help.contains(&format!("letter: {right}")), "{name}: {help}");
        }
    }

    #[test]
    fn a_scene_may_have_a_name_that_a_crate_may_not() {
        for name in ["test", "dbd-kernel", "a_1"] {
            assert_eq!(check_scene(name), Ok(()));
        }
        for (name, right) in [("nul", "nul-plant"), ("a b", "a-b"), ("", "my-scene")] {
            let error = check_scene(name).unwrap_err();
            assert!(error.to_string().contains("is not a valid name for a scene"), "{error}");
            assert!(error.help().unwrap().to_string().contains(&format!("letter: {right}")));
        }
    }
}
