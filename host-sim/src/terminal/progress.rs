//! Progress of long runs: a bar on a terminal, lines elsewhere.

use std::fmt;
use std::io::Write;
use std::time::{Duration, Instant};

use dbd_plant::digits::significant;
use indicatif::style::TemplateError;
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};

/// Shorter runs show no progress.
const PATIENCE: Duration = Duration::from_millis(500);

/// Interval of progress lines without a terminal.
const SILENCE: Duration = Duration::from_secs(20);

/// A bar on standard error that appears once a run takes longer than half a second; or, where standard
/// error is a file or a pipe, a line for each part of the work, and for counted work now and then.
pub struct Progress<'p> {
    start: Instant,
    shown: bool,
    unit: &'static str,
    bar: Option<ProgressBar>,
    waiting: Option<ProgressBar>,
    lines: Option<Lines<'p>>,
    /// Whether all work is counted, so that its rate is known from the beginning.
    counts_alone: bool,
}

/// Lines instead of a bar.
struct Lines<'p> {
    to: &'p mut dyn Write,
    /// Time of the last line about counted work; `None` before the first.
    last: Option<Instant>,
}

impl<'p> Progress<'p> {
    /// A run begins; `shown` where there is a terminal to show it on.
    #[must_use]
    pub fn new(shown: bool) -> Self {
        let start = Instant::now();
        let (bar, waiting, lines) = (None, None, None);
        Self { start, shown, unit: "steps", bar, waiting, lines, counts_alone: true }
    }

    /// Work in several parts begins, one of which is counted in a unit: with bars where there is a
    /// terminal, else with lines.
    #[must_use]
    pub fn of(terminal: bool, unit: &'static str, lines: &'p mut dyn Write) -> Self {
        let lines = (!terminal).then_some(Lines { to: lines, last: None });
        Self { unit, lines, counts_alone: false, ..Self::new(terminal) }
    }

    /// Counted work only, with its rate; without a terminal, short work prints no line.
    #[must_use]
    pub fn of_many(terminal: bool, unit: &'static str, lines: &'p mut dyn Write) -> Self {
        let last = Some(Instant::now());
        let lines = (!terminal).then_some(Lines { to: lines, last });
        Self { unit, lines, ..Self::new(terminal) }
    }

    /// Other counted work begins, in its unit; it is also shown only if it takes long.
    pub fn restart(&mut self, unit: &'static str) {
        self.finish();
        (self.unit, self.start) = (unit, Instant::now());
        if let Some(lines) = &mut self.lines {
            lines.last = Some(self.start);
        }
    }

    /// Work of unknown length begins: shows its name and the time so far.
    pub fn begin(&mut self, what: &'static str) {
        self.finish();
        if self.shown {
            let bar = ProgressBar::new_spinner().with_elapsed(self.start.elapsed());
            let bar = bar.with_message(what);
            bar.enable_steady_tick(PATIENCE);
            self.waiting = Some(bar);
        }
        self.say(what);
    }

    /// Prints a line after the time so far. A closed reader is ignored.
    fn say(&mut self, what: &str) {
        let seconds = self.start.elapsed().as_secs_f64();
        if let Some(lines) = &mut self.lines {
            let _ = writeln!(lines.to, "{seconds:6.1} s  {what}").and_then(|()| lines.to.flush());
        }
    }

    /// The rate of counted work, and its remaining time.
    fn pace(&self, done: u64, all: u64) -> Option<String> {
        let rate = done as f64 / self.start.elapsed().as_secs_f64();
        let left = all.saturating_sub(done) as f64 / rate;
        let known = rate > 0.0 && left.is_finite() && self.counts_alone;
        known.then(|| format!(", {} a second, {left:.0} s left", significant(rate, 3)))
    }

    /// Sets the number of finished steps.
    pub fn update(&mut self, steps: u64, all: u64) {
        if let Some(lines) = &mut self.lines {
            if lines.last.is_none_or(|last| last.elapsed() >= SILENCE) {
                lines.last = Some(Instant::now());
                let percent = (100 * u128::from(steps)) / u128::from(all.max(1));
                let pace = self.pace(steps, all).unwrap_or_default();
                self.say(&format!("{percent} % of {all} {}{pace}", self.unit));
            }
            return;
        }
        if !self.shown || (self.bar.is_none() && self.start.elapsed() < PATIENCE) {
            return;
        }
        if let Some(waiting) = self.waiting.take() {
            waiting.finish_and_clear();
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(all).with_elapsed(self.start.elapsed());
            match style(self.unit, self.counts_alone) {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        bar.set_position(steps);
    }

    /// The run is over.
    pub fn finish(&mut self) {
        for bar in [self.bar.take(), self.waiting.take()].into_iter().flatten() {
            bar.finish_and_clear();
        }
    }
}

/// The style of a bar: it uses the width left by the figures, which take precedence on a narrow terminal.
fn style(unit: &'static str, has_pace: bool) -> Result<ProgressStyle, TemplateError> {
    let pace = if has_pace { "{pace}  " } else { "" };
    let template =
        format!("{{percent:>3}} % of {{human_len}} {unit}  {pace}{{eta}} left  {{wide_bar}}");
    let style = ProgressStyle::with_template(&template)?;
    Ok(style.with_key("pace", move |state: &ProgressState, to: &mut dyn fmt::Write| {
        let _ = write!(to, "{} a second", HumanCount(state.per_sec() as u64));
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_terminal_each_part_is_a_line() {
        let mut said = Vec::new();
        let mut progress = Progress::of(false, "evaluations", &mut said);
        progress.begin("reference solution");
        (0..1000).for_each(|done| progress.update(done, 1000));
        progress.begin("measuring times");
        progress.finish();
        let said = String::from_utf8(said).unwrap();
        let lines: Vec<&str> = said.lines().filter_map(|line| line.split(" s  ").nth(1)).collect();
        assert_eq!(lines, ["reference solution", "0 % of 1000 evaluations", "measuring times"]);
    }
}
