//! Whether what is published can be: the metadata of every crate, and what its package holds.
//!
//! `cargo's metadata => what is missing`. Packages are made, not built: their sources are those that
//! the other steps build.

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

use crate::command::{cargo, output};

/// What every package holds.
const FILES: [&str; 4] = ["Cargo.toml", "README.md", "LICENSE-MIT", "LICENSE-APACHE"];
/// What else a package needs beside its sources.
const NEEDED: [(&str, &str); 2] =
    [("host-sim", "scenes/four-bar.toml"), ("host-sim", "templates/firmware/Cargo.toml.in")];
/// Most keywords, and letters of one, that the registry takes.
const KEYWORDS: usize = 5;
const KEYWORD: usize = 20;

/// Makes the packages of all crates that are published.
///
/// # Errors
/// Where metadata or a file is missing, or cargo refuses a package; all that is missing is named.
pub fn check() -> Result<()> {
    let text =
        output(cargo().args(["metadata", "--no-deps", "--offline", "--format-version", "1"]))?;
    let metadata: Value = serde_json::from_str(&text).context("cargo printed no JSON")?;
    let packages = metadata["packages"].as_array().context("cargo listed no packages")?;
    let published: Vec<&Value> = packages.iter().filter(|package| is_published(package)).collect();
    let names: Vec<&str> = published.iter().map(|package| name(package)).collect();
    let mut missing: Vec<String> =
        published.iter().flat_map(|package| lacks(package, &names)).collect();
    for name in &names {
        let list = output(cargo().args(["package", "--list", "--allow-dirty", "--package", name]))?;
        let needed = NEEDED.iter().filter(|(package, _)| package == name).map(|(_, file)| file);
        let absent =
            FILES.iter().chain(needed).filter(|file| !list.lines().any(|line| line == **file));
        missing.extend(absent.map(|file| format!("{name}: the package lacks {file}")));
    }
    if !missing.is_empty() {
        bail!("{}", missing.join("\n"));
    }
    let selected = names.iter().flat_map(|name| ["--package", name]);
    let mut package = cargo();
    package
        .args(["package", "--no-verify", "--allow-dirty", "--offline", "--quiet"])
        .args(selected);
    output(&mut package)?;
    println!("packages of {} crates: {}", names.len(), names.join(", "));
    Ok(())
}

/// Name and version of the crates that are published.
///
/// # Errors
/// Where cargo does not tell.
pub fn published() -> Result<Vec<(String, String)>> {
    let text = output(cargo().args(["metadata", "--no-deps", "--format-version", "1"]))?;
    let metadata: Value = serde_json::from_str(&text).context("cargo printed no JSON")?;
    let packages = metadata["packages"].as_array().context("cargo listed no packages")?;
    let version = |one: &Value| one["version"].as_str().unwrap_or_default().to_owned();
    let published = packages.iter().filter(|one| is_published(one));
    Ok(published.map(|one| (name(one).to_owned(), version(one))).collect())
}

fn name(package: &Value) -> &str {
    package["name"].as_str().unwrap_or_default()
}

/// `publish = false` is an empty list of registries.
fn is_published(package: &Value) -> bool {
    package["publish"].as_array().is_none_or(|registries| !registries.is_empty())
}

/// What the registry, docs.rs or people who look for a crate miss.
fn lacks(package: &Value, published: &[&str]) -> Vec<String> {
    let mut missing = Vec::new();
    for key in ["description", "license", "readme", "rust_version", "documentation"] {
        if package[key].as_str().is_none_or(str::is_empty) {
            missing.push(format!("no {}", key.replace('_', "-")));
        }
    }
    let words = |key: &str| -> Vec<&str> {
        package[key].as_array().into_iter().flatten().filter_map(Value::as_str).collect()
    };
    let keywords = words("keywords");
    if keywords.is_empty() || keywords.len() > KEYWORDS {
        missing.push(format!("{} keywords, not 1 to {KEYWORDS}", keywords.len()));
    }
    missing.extend(
        keywords
            .iter()
            .filter(|word| word.len() > KEYWORD)
            .map(|word| format!("keyword {word} is too long")),
    );
    if words("categories").is_empty() {
        missing.push("no categories".into());
    }
    if package["metadata"]["docs"]["rs"]["all-features"] != true {
        missing.push("no [package.metadata.docs.rs] all-features = true".into());
    }
    for dependency in package["dependencies"].as_array().into_iter().flatten() {
        // One of the repository that users get, too.
        if dependency["path"].is_null() || dependency["kind"] == "dev" {
            continue;
        }
        let on = dependency["name"].as_str().unwrap_or_default();
        if dependency["req"] == "*" {
            missing.push(format!("the dependency on {on} has no version"));
        }
        if !published.contains(&on) {
            missing.push(format!("it depends on {on}, which is not published"));
        }
    }
    missing.into_iter().map(|what| format!("{}: {what}", name(package))).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_missing_is_named() {
        let whole = json!({
            "name": "dbd-a", "publish": null, "description": "d", "license": "MIT", "readme": "README.md",
            "rust_version": "1.89", "documentation": "https://docs.rs/dbd-a", "keywords": ["k"],
            "categories": ["simulation"], "metadata": {"docs": {"rs": {"all-features": true}}},
            "dependencies": [{"name": "dbd-b", "path": "/b", "req": "^0.1.0", "kind": null}],
        });
        assert!(is_published(&whole));
        assert_eq!(lacks(&whole, &["dbd-a", "dbd-b"]), [""; 0]);
        assert_eq!(
            lacks(&whole, &["dbd-a"]),
            ["dbd-a: it depends on dbd-b, which is not published"]
        );
        let own = json!({"name": "xtask", "publish": []});
        assert!(!is_published(&own));
        let mut bare =
            json!({"name": "dbd-a", "publish": null, "keywords": ["a keyword of many letters"]});
        bare["dependencies"] = json!([{"name": "dbd-a", "path": "/a", "req": "*", "kind": null}]);
        let missing = lacks(&bare, &["dbd-a"]);
        for part in [
            "no description",
            "no rust-version",
            "is too long",
            "no categories",
            "all-features",
            "has no version",
        ] {
            assert!(missing.iter().any(|line| line.contains(part)), "{part}: {missing:?}");
        }
    }
}
