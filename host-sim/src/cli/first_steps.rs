//! The output of `host-sim` without a command.

use clap::Command;

use crate::terminal::look::HEAD;
use crate::terminal::{Catalogue, Look};

/// The first commands to try, with their descriptions.
const STEPS: [(&str, &str); 5] = [
    ("host-sim run four-bar", "simulates; then open out/four-bar/report.html"),
    ("host-sim check four-bar", "its parts, and warnings of probable mistakes"),
    ("host-sim new scene my-crank", "writes a mechanism to start from, my-crank.toml"),
    ("host-sim trade four-bar", "compares schemes and steps; takes minutes"),
    (
        "host-sim new firmware my-plant",
        "writes a project that runs a mechanism on a microcontroller",
    ),
];

/// The program's description, first steps, commands and scenes.
pub(super) fn first_steps(program: &Command, catalogue: &Catalogue, look: Look) -> String {
    let about = program.get_about().map(ToString::to_string).unwrap_or_default();
    let head = |text: &str| look.paint(HEAD, text);
    let steps = STEPS.map(|(command, does)| (format!("  {command}"), does.to_owned()));
    let commands: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
    let lists = [
        ("Scenes", catalogue.names().join(", ") + ", or your own .toml file"),
        (
            "Commands",
            commands.join(", ") + "; host-sim COMMAND --help describes one, with examples",
        ),
    ];
    format!(
        "{about}.\n\n{}\n{}\n{}",
        head("First steps:"),
        look.table(&steps),
        look.table(&lists.map(|(name, text)| (head(&format!("{name}:")), text))),
    )
}
