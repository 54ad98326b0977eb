//! Names of a scene and its parts as Rust identifiers and in comments.

/// Attribute of items that a program need not use.
pub(super) const UNUSED: &str = "#[allow(dead_code)]\n";

/// The scene's name as a Rust constant: `four-bar` becomes `FOUR_BAR`; a leading digit gets a `_`.
#[must_use]
pub fn constant_name(scene: &str) -> String {
    let name: String = scene
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' })
        .collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) { format!("_{name}") } else { name }
}

/// The scene's name as a Rust type: `four-bar` becomes `FourBar`.
#[must_use]
pub fn type_name(scene: &str) -> String {
    let words = scene.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let name: String = words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_ascii_uppercase() + rest
        })
        .collect();
    match name.chars().next() {
        None => "Scene".into(),
        Some(first) if first.is_ascii_digit() => format!("_{name}"),
        Some(_) => name,
    }
}

/// A name as code in a documentation comment: enclosed by more backticks than it contains in a row.
pub(super) fn quoted(name: &str) -> String {
    if !name.contains('`') {
        return format!("`{name}`");
    }
    let longest = name.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    format!("{fence} {name} {fence}")
}

/// Names of items of a kind as parts of constants; duplicates get a number.
#[must_use]
pub fn constant_names<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut constants: Vec<String> = Vec::new();
    for name in names {
        let mut constant = constant_name(name);
        while constants.contains(&constant) {
            constant = format!("{constant}_{}", constants.len() + 1);
        }
        constants.push(constant);
    }
    constants
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        assert_eq!(constant_name("four-bar"), "FOUR_BAR");
        assert_eq!(constant_name("3rrr-1"), "_3RRR_1");
        assert_eq!(type_name("five-bar-a"), "FiveBarA");
        assert_eq!(type_name("3ruu"), "_3ruu");
        assert_eq!(type_name("ü"), "Scene");
        let names = ["a b", "a-b", "c"].into_iter();
        assert_eq!(constant_names(names), ["A_B", "A_B_2", "C"]);
    }

    #[test]
    fn names_with_quotes_stay_within_their_comment() {
        assert_eq!(quoted("four-bar"), "`four-bar`");
        assert_eq!(quoted("a`b``"), "``` a`b`` ```");
    }
}
