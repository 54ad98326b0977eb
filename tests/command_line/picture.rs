//! `check --svg`, and the picture in a report.

use std::fs;

use host_sim::terminal::Exit;

use crate::{Folder, PENDULUM, call};

#[test]
fn check_writes_a_picture_or_prints_it() {
    let folder = Folder::new();
    let file = folder.path("four-bar.svg");
    let done = call(&["check", "four-bar", "--svg", file.to_str().unwrap()]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    assert!(done.out.contains(&format!("written  {}", file.display())), "{}", done.out);
    let written = fs::read_to_string(&file).unwrap();
    for part in ["<svg ", ">crank<", ">coupler<", ">rocker<", "4 revolute joints"] {
        assert!(written.contains(part), "{part}");
    }
    let printed = call(&["check", "four-bar", "--svg", "-"]);
    assert_eq!((printed.exit, printed.err.as_str()), (Exit::Done, ""));
    assert!(printed.out == written, "the same bytes");
    // An older picture is replaced, a changed value shows, JSON stays JSON.
    let longer = "body.crank.mass=2.5";
    let arguments = ["check", "four-bar", "--json", "--set", longer, "--svg"];
    let done = call(&[&arguments[..], &[file.to_str().unwrap()]].concat());
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(serde_json::from_str::<serde_json::Value>(&done.out).is_ok());
    assert!(fs::read_to_string(&file).unwrap().contains("<title>crank, 2.5 kg</title>"));
}

#[test]
fn what_is_no_picture_is_not_replaced() {
    let folder = Folder::new();
    let taken = folder.scene(PENDULUM);
    let done = call(&["check", &taken, "--svg", &taken]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""));
    assert!(
        done.err.contains("is not an SVG") && done.err.contains("another file"),
        "{}",
        done.err
    );
    assert_eq!(fs::read_to_string(&taken).unwrap(), PENDULUM);
    let nowhere = folder.path("no/such/a.svg");
    let done = call(&["check", &taken, "--svg", nowhere.to_str().unwrap()]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Failed, ""));
    assert!(done.err.contains("cannot write"), "{}", done.err);
    let done = call(&["check", &taken, "--svg", "-", "--json"]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""));
    assert!(done.err.contains("--svg FILE"), "{}", done.err);
    let left: Vec<_> = fs::read_dir(folder.path(".")).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

/// Before all else; for readers without scripts, and light or dark as their screen is.
#[test]
fn a_report_begins_with_the_picture() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    folder.run(&scene, &["--duration", "1ms"]);
    let page = fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    let (picture, summary) = (page.find("class=\"mechanism\""), page.find("<h2>Summary"));
    assert!(picture.unwrap() < summary.unwrap());
    assert!(page.contains(">TSDA<") && page.contains(">bob<"));
    assert!(picture < page.find("<script") && page.contains("prefers-color-scheme: dark"));
}
