//! `host-sim compare` on the command line.

use crate::commands::compare::words::text;
use crate::commands::compare::{CompareArguments, Compared, compare_runs};
use crate::comparison::Verdict;
use crate::error::Error;
use crate::terminal::text::json;
use crate::terminal::{Catalogue, Console, Exit, Progress};

pub(super) fn compare(
    catalogue: &Catalogue,
    arguments: &CompareArguments,
    console: &mut Console<'_>,
) -> Result<Exit, Error> {
    let bars = console.terminal && !arguments.quiet;
    let mut silence = std::io::sink();
    let mut progress = Progress::of_many(bars, "samples", &mut silence);
    let done = compare_runs(catalogue, arguments, &mut |done, all| progress.update(done, all));
    progress.finish();
    let Compared { comparison, record, folder } = done?;
    if arguments.json {
        console.print(&json(&record))?;
    } else if !arguments.quiet {
        let mut text = text(&comparison, console.look);
        if let Some(folder) = folder {
            text += &format!("\nwritten  {}/{{report.html,compare.json}}\n", folder.display());
        }
        console.print(&text)?;
    }
    Ok(match comparison.verdict() {
        Verdict::Equal | Verdict::Within => Exit::Done,
        Verdict::Different => Exit::Failed,
    })
}
