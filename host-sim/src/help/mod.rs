//! The examples at the end of each command's help, one text file each.
//!
//! In a file, a line `  # …` describes the command in the next line, `  host-sim …`, which may end in
//! `| …` or `> …`. A test of the command line parses all of them.

/// The text of a file below a heading in the style of the help.
macro_rules! examples {
    ($file:literal) => {
        concat!("\u{1b}[1m\u{1b}[4mExamples:\u{1b}[0m\n", include_str!($file))
    };
}

/// Examples of `advise`.
pub const ADVISE: &str = examples!("advise.txt");
/// Examples of `check`.
pub const CHECK: &str = examples!("check.txt");
/// Examples of `compare`.
pub const COMPARE: &str = examples!("compare.txt");
/// Examples of `completions`.
pub const COMPLETIONS: &str = examples!("completions.txt");
/// Examples of `export`.
pub const EXPORT: &str = examples!("export.txt");
/// Examples of `fmu`.
pub const FMU: &str = examples!("fmu.txt");
/// Examples of `hil`.
pub const HIL: &str = examples!("hil.txt");
/// Examples of `import`.
pub const IMPORT: &str = examples!("import.txt");
/// Examples of `linearise`.
pub const LINEARISE: &str = examples!("linearise.txt");
/// Examples of `list`.
pub const LIST: &str = examples!("list.txt");
/// Examples of `manual`.
pub const MANUAL: &str = examples!("manual.txt");
/// Examples of `modes`.
pub const MODES: &str = examples!("modes.txt");
/// Examples of `new c`.
pub const NEW_C: &str = examples!("new-c.txt");
/// Examples of `new firmware`.
pub const NEW_FIRMWARE: &str = examples!("new-firmware.txt");
/// Examples of `new laws`.
pub const NEW_LAWS: &str = examples!("new-laws.txt");
/// Examples of `new scene`.
pub const NEW_SCENE: &str = examples!("new-scene.txt");
/// Examples of `play`.
pub const PLAY: &str = examples!("play.txt");
/// Examples of `relax`.
pub const RELAX: &str = examples!("relax.txt");
/// Examples of `report`.
pub const REPORT: &str = examples!("report.txt");
/// Examples of `reproduce`.
pub const REPRODUCE: &str = examples!("reproduce.txt");
/// Examples of `run`.
pub const RUN: &str = examples!("run.txt");
/// Examples of `schema`.
pub const SCHEMA: &str = examples!("schema.txt");
/// Examples of `sweep`.
pub const SWEEP: &str = examples!("sweep.txt");
/// Examples of `trade`.
pub const TRADE: &str = examples!("trade.txt");
