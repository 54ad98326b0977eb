//! What `host-sim` says when it is not told what to do.

use clap::Command;

use crate::terminal::look::HEAD;
use crate::terminal::{Catalogue, Look};

/// What to type first, and what it does.
const STEPS: [(&str, &str); 5] = [
    ("host-sim run four-bar", "simulates; then open out/four-bar/report.html"),
    ("host-sim check four-bar", "what it is made of, what is probably not meant"),
    ("host-sim new scene my-crank", "a mechanism of your own to begin with, my-crank.toml"),
    ("host-sim trade four-bar", "which scheme and step are best; takes minutes"),
    ("host-sim new firmware my-plant", "a project that steps one on a microcontroller"),
];

/// What the program is, first steps, commands and scenes.
pub(super) fn first_steps(program: &Command, catalogue: &Catalogue, look: Look) -> String {
    let about = program.get_about().map(ToString::to_string).unwrap_or_default();
    let head = |text: &str| look.paint(HEAD, text);
    let steps = STEPS.map(|(command, does)| (format!("  {command}"), does.to_owned()));
    let commands: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
    let lists = [
        ("Scenes", catalogue.names().join(", ") + ", or a .toml file of your own"),
        ("Commands", commands.join(", ") + "; host-sim COMMAND --help shows each with examples"),
    ];
    format!(
        "{about}.\n\n{}\n{}\n{}",
        head("First steps:"),
        look.table(&steps),
        look.table(&lists.map(|(name, text)| (head(&format!("{name}:")), text))),
    )
}
