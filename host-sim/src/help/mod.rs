//! The examples at the end of each command's help, a file of text for each.
//!
//! In a file a line `  # …` says what the command in the next line does, a line `  host-sim …`, which may end in
//! `| …` or `> …`. A test of the command line parses all of them, so that none rots.

/// The text of a file below a heading that looks as those of the help.
macro_rules! examples {
    ($file:literal) => {
        concat!("\u{1b}[1m\u{1b}[4mExamples:\u{1b}[0m\n", include_str!($file))
    };
}

/// Of `advise`.
pub const ADVISE: &str = examples!("advise.txt");
/// Of `check`.
pub const CHECK: &str = examples!("check.txt");
/// Of `compare`.
pub const COMPARE: &str = examples!("compare.txt");
/// Of `completions`.
pub const COMPLETIONS: &str = examples!("completions.txt");
/// Of `export`.
pub const EXPORT: &str = examples!("export.txt");
/// Of `fmu`.
pub const FMU: &str = examples!("fmu.txt");
/// Of `hil`.
pub const HIL: &str = examples!("hil.txt");
/// Of `import`.
pub const IMPORT: &str = examples!("import.txt");
/// Of `linearise`.
pub const LINEARISE: &str = examples!("linearise.txt");
/// Of `list`.
pub const LIST: &str = examples!("list.txt");
/// Of `modes`.
pub const MODES: &str = examples!("modes.txt");
/// Of `new c`.
pub const NEW_C: &str = examples!("new-c.txt");
/// Of `new firmware`.
pub const NEW_FIRMWARE: &str = examples!("new-firmware.txt");
/// Of `new laws`.
pub const NEW_LAWS: &str = examples!("new-laws.txt");
/// Of `new scene`.
pub const NEW_SCENE: &str = examples!("new-scene.txt");
/// Of `play`.
pub const PLAY: &str = examples!("play.txt");
/// Of `relax`.
pub const RELAX: &str = examples!("relax.txt");
/// Of `reproduce`.
pub const REPRODUCE: &str = examples!("reproduce.txt");
/// Of `run`.
pub const RUN: &str = examples!("run.txt");
/// Of `schema`.
pub const SCHEMA: &str = examples!("schema.txt");
/// Of `sweep`.
pub const SWEEP: &str = examples!("sweep.txt");
/// Of `trade`.
pub const TRADE: &str = examples!("trade.txt");
