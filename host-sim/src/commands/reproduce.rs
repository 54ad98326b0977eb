//! `host-sim reproduce`: the results of the method's paper, measured again.
//!
//! `(items) => findings => OUT/reproduce/{reproduce.html,reproduce.md,reproduce.json,ITEM.csv,ITEM.svg}`; each
//! finding is stored at once, so that an interrupted call resumes and a second one is
//! immediate.

use std::io;
use std::path::{Path, PathBuf};

use dbd_report::output::file;
use dbd_report::output::set::FileSet;
use dbd_study::paper::{Finding, ITEMS, Item, PaperError, item, page, plot, store};
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::terminal::Catalogue;
use crate::terminal::text;

/// The folder of the results below `--out`.
const FOLDER: &str = "reproduce";

/// Why results could not be measured or written.
#[derive(Debug, Error, Diagnostic)]
pub enum ReproduceError {
    /// No item has this name.
    #[error("unknown item `{name}` of the paper; known items: {}", known())]
    #[diagnostic(code(host_sim::reproduce))]
    Unknown {
        /// What was asked for.
        name: String,
    },
    /// An item cannot be measured.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Paper(#[from] PaperError),
    /// Results cannot be written.
    #[error("cannot write the results to {}: {reason}", folder.display())]
    Write {
        /// The folder.
        folder: PathBuf,
        /// Why.
        reason: io::Error,
    },
}

/// The names of all items.
#[must_use]
pub fn known() -> String {
    ITEMS.iter().map(|item| item.name).collect::<Vec<_>>().join(", ")
}

/// The items of these names; all, or the quick ones, where none is named.
///
/// # Errors
/// [`ReproduceError::Unknown`].
pub fn items(names: &[String], all: bool) -> Result<Vec<&'static Item>, ReproduceError> {
    if names.is_empty() || all {
        return Ok(ITEMS.iter().filter(|item| all || item.quick).collect());
    }
    let of =
        |name: &String| item(name).ok_or_else(|| ReproduceError::Unknown { name: name.clone() });
    let mut items = names.iter().map(of).collect::<Result<Vec<_>, _>>()?;
    // In the paper's order, without duplicates.
    items.sort_by_key(|wanted| ITEMS.iter().position(|item| item.name == wanted.name));
    items.dedup_by_key(|item| item.name);
    Ok(items)
}

/// Measures items or reads their stored findings; `progress` is called with each measured item. The findings, and the
/// folder of their files.
///
/// # Errors
/// [`ReproduceError`].
pub fn reproduce(
    items: &[&'static Item],
    out: &Path,
    progress: &mut dyn FnMut(&'static Item),
) -> Result<(Vec<Finding>, PathBuf), ReproduceError> {
    let unwritable = |folder: &Path| {
        let folder = folder.to_owned();
        move |reason| ReproduceError::Write { folder, reason }
    };
    let folder = file::folder(out, FOLDER).map_err(unwritable(&out.join(FOLDER)))?;
    let scenes = |name: &str| Catalogue::shipped(name);
    let mut findings = Vec::with_capacity(items.len());
    for item in items {
        let key = store::key(item, &scenes);
        let finding = match store::kept(&folder, item, &key) {
            Some(finding) => finding,
            None => {
                progress(item);
                let finding = item.measure(&scenes)?;
                store::keep(&folder, item, &key, &finding).map_err(unwritable(&folder))?;
                finding
            }
        };
        findings.push(finding);
    }
    write(&folder, &findings).map_err(unwritable(&folder))?;
    Ok((findings, folder))
}

/// The JSON output: every finding with its verdict.
#[must_use]
pub fn json(findings: &[Finding]) -> String {
    #[derive(Serialize)]
    struct One<'f> {
        verdict: &'static str,
        #[serde(flatten)]
        finding: &'f Finding,
    }
    let verdict = |finding: &Finding| finding.verdict().map_or("", |verdict| verdict.words());
    let all: Vec<One<'_>> =
        findings.iter().map(|finding| One { verdict: verdict(finding), finding }).collect();
    text::json(&all)
}

fn write(folder: &Path, findings: &[Finding]) -> io::Result<()> {
    let mut files = FileSet::new(folder);
    for finding in findings {
        let name = &finding.item;
        files.write(&format!("{name}.csv"), &page::csv(finding).map_err(io::Error::other)?)?;
        for drawn in &finding.plots {
            files.write(&format!("{name}{}.svg", drawn.name), &plot::svg(drawn))?;
        }
    }
    let conditions = format!(
        "Measured by host-sim {} on this machine; the paper: Franco & Degani, Appl. Sci. 2026, 16, 2297.",
        env!("CARGO_PKG_VERSION")
    );
    files.write("reproduce.html", &page::html(findings, &conditions))?;
    files.write("reproduce.md", &page::markdown(findings))?;
    files.write("reproduce.json", &json(findings))?;
    files.finish()?.publish()
}
