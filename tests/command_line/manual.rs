//! `host-sim manual`: a page for each command.

use std::fs;

use host_sim::terminal::Exit;

use crate::{Folder, call};

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new();
    let pages = folder.path("man1");
    let done = call(&["manual", pages.to_str().unwrap()]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let commands = call(&["--help"]).out;
    let commands = commands.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let is_name = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    let names = commands.lines().filter(is_name).filter_map(|line| line.split_whitespace().next());
    let names: Vec<&str> = names.collect();
    assert!(names.contains(&"run") && names.contains(&"manual"), "{names:?}");
    for name in names {
        let page = fs::read_to_string(pages.join(format!("host-sim-{name}.1"))).unwrap();
        assert!(page.contains(".SH NAME") && !page.contains('\u{1b}'), "{name}: {page}");
        let examples = page.contains("Examples:") || name == "new";
        assert!(examples, "{name}: {page}");
    }
    let below = fs::read_to_string(pages.join("host-sim-new-firmware.1")).unwrap();
    assert!(below.contains("host\\-sim new firmware"), "{below}");
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = Folder::new();
    let file = folder.path("taken");
    fs::write(&file, "").unwrap();
    let done = call(&["manual", file.join("man1").to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Failed);
    assert!(done.err.contains("cannot write manual pages") && done.err.contains("taken"));
}
