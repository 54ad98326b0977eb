//! The results of the method's paper: what takes seconds is measured again and held against
//! `docs/results/paper.json`, from which the table of `docs/paper.md` is rendered.
//!
//! `DBD_COLLECT=OUT cargo test -p dbd-tests --test dynamics paper` writes that file from the results of
//! `host-sim reproduce --all --out OUT`.

use std::process::Command;
use std::sync::Once;

use dbd_study::paper::page::columns;
use dbd_study::paper::{Finding, ITEMS, Verdict};
use dbd_tests::page::{block, table};
use dbd_tests::results::path;
use host_sim::terminal::Catalogue;
use serde_json::{Value, json};

const FILE: &str = "docs/results/paper.json";

/// Writes the file from new results once, where asked to.
fn collect() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let Some(out) = std::env::var_os("DBD_COLLECT") else { return };
        let text =
            std::fs::read_to_string(path(&out.to_string_lossy()).join("reproduce/reproduce.json"));
        let mut findings: Vec<Value> = serde_json::from_str(&text.unwrap()).unwrap();
        findings.iter_mut().for_each(|finding| finding["plots"] = json!([]));
        let commit =
            Command::new("git").args(["describe", "--always", "--dirty"]).output().unwrap();
        let commit = String::from_utf8(commit.stdout).unwrap();
        let whole = json!({ "commit": commit.trim(), "findings": findings });
        std::fs::write(path(FILE), serde_json::to_string_pretty(&whole).unwrap() + "\n").unwrap();
    });
}

/// The commit of the data, and the findings, without plots.
fn kept() -> (String, Vec<Finding>) {
    collect();
    let whole: Value = serde_json::from_str(&std::fs::read_to_string(path(FILE)).unwrap()).unwrap();
    let commit = whole["commit"].as_str().unwrap().to_owned();
    (commit, serde_json::from_value(whole["findings"].clone()).unwrap())
}

#[test]
fn quick_items_have_the_values_and_verdicts_of_the_table() {
    let (_, kept) = kept();
    for item in ITEMS.iter().filter(|item| item.quick) {
        let found = item.measure(&|name| Catalogue::shipped(name)).unwrap();
        let kept = kept.iter().find(|kept| kept.item == item.name);
        let kept = kept.unwrap_or_else(|| panic!("{FILE} lacks {}", item.name));
        let rows = |finding: &Finding| finding.rows.iter().map(columns).collect::<Vec<_>>();
        assert_eq!(rows(&found), rows(kept), "{}: {FILE} is of another state", item.name);
        assert_eq!(found.assumptions, kept.assumptions, "{}", item.name);
    }
}

#[test]
fn the_page_has_every_item_with_its_verdict() {
    let (commit, kept) = kept();
    let names: Vec<&str> = kept.iter().map(|finding| finding.item.as_str()).collect();
    assert_eq!(names, ITEMS.map(|item| item.name));
    let lines: Vec<Vec<String>> = kept
        .iter()
        .map(|finding| {
            let count = |verdict| {
                let rows = finding.rows.iter().filter(|row| row.verdict == Some(verdict));
                match rows.count() {
                    0 => "–".to_owned(),
                    count => count.to_string(),
                }
            };
            vec![
                format!("`{}`", finding.item),
                format!("{}: {}", finding.place, finding.title),
                count(Verdict::Reproduced),
                count(Verdict::ReproducedUpToFactor),
                count(Verdict::NotReproducible),
                count(Verdict::Contradicted),
            ]
        })
        .collect();
    let head = [
        "item",
        "of the paper",
        "reproduced",
        "up to a factor",
        "not from the text",
        "contradicted",
    ];
    let text = table(&head, &lines);
    block("docs/paper.md", "paper", &format!("Rows by verdict, measured at {commit}.\n\n{text}"));
}
