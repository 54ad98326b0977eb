//! Names that a project may have: cargo's rules for packages, and none that its dependencies have.

use std::fmt;

use miette::Diagnostic;
use thiserror::Error;

/// What a crate cannot be called: keywords, names that cargo or the compiler keeps, file names that
/// Windows keeps.
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
    "aux",
    "con",
    "nul",
    "prn",
    "com1",
    "com2",
    "com3",
    "com4",
    "com5",
    "com6",
    "com7",
    "com8",
    "com9",
    "lpt1",
    "lpt2",
    "lpt3",
    "lpt4",
    "lpt5",
    "lpt6",
    "lpt7",
    "lpt8",
    "lpt9",
];

/// Crates that the project uses.
const USED: &[&str] =
    &["cortex-m", "cortex-m-rt", "dbd-kernel", "dbd-scene", "libm", "semihosting"];

/// Letters of a name: what file systems and registries take.
const LONGEST: usize = 64;

/// Why a project cannot be called so.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("a project cannot be called \"{}\": {why}", dbd_scene::shortened(name))]
pub struct NameError {
    name: String,
    why: String,
}

impl Diagnostic for NameError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let rule = "a name has letters a to z, digits, - and _, and begins with a letter";
        Some(Box::new(match right(&self.name) {
            Some(name) => format!("{rule}: {name}"),
            None => format!("{rule}: my-plant"),
        }))
    }
}

/// Whether a project may be called so.
///
/// # Errors
/// Where cargo would refuse the name or warn of it, or a dependency has it.
pub fn check(name: &str) -> Result<(), NameError> {
    match problem(name) {
        Some(why) => Err(NameError { name: name.to_owned(), why }),
        None => Ok(()),
    }
}

fn problem(name: &str) -> Option<String> {
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
    let lower = name.to_ascii_lowercase();
    if KEPT.contains(&lower.as_str()) {
        return Some("Rust, cargo or an operating system keeps this name".into());
    }
    let same = |used: &&str| used.replace('-', "_") == lower.replace('-', "_");
    USED.iter().any(same).then(|| "a crate that it uses has this name".into())
}

/// The nearest right name.
fn right(name: &str) -> Option<String> {
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
}
