//! A progress bar for runs that take their time.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Runs that are shorter show nothing.
const PATIENCE: Duration = Duration::from_millis(500);

/// A bar on standard error that appears once a run takes longer than half a second.
pub struct Progress {
    start: Instant,
    shown: bool,
    unit: &'static str,
    bar: Option<ProgressBar>,
    waiting: Option<ProgressBar>,
}

impl Progress {
    /// A run begins; `shown` where there is a terminal to show it on.
    #[must_use]
    pub fn new(shown: bool) -> Self {
        Self::of(shown, "steps")
    }

    /// Likewise for work that is counted in another unit.
    #[must_use]
    pub fn of(shown: bool, unit: &'static str) -> Self {
        Self { start: Instant::now(), shown, unit, bar: None, waiting: None }
    }

    /// Something begins of which nobody knows how long it takes: its name and the time so far.
    pub fn begin(&mut self, what: &'static str) {
        self.finish();
        if self.shown {
            let bar = ProgressBar::new_spinner().with_elapsed(self.start.elapsed());
            let bar = bar.with_message(what);
            bar.enable_steady_tick(PATIENCE);
            self.waiting = Some(bar);
        }
    }

    /// So many steps of all are done.
    pub fn update(&mut self, steps: u64, all: u64) {
        if !self.shown || (self.bar.is_none() && self.start.elapsed() < PATIENCE) {
            return;
        }
        if let Some(waiting) = self.waiting.take() {
            waiting.finish_and_clear();
        }
        let bar = self.bar.get_or_insert_with(|| {
            let unit = self.unit;
            let template = format!(
                "{{bar:40}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {unit}  {{eta}} left"
            );
            let bar = ProgressBar::new(all).with_elapsed(self.start.elapsed());
            match ProgressStyle::with_template(&template) {
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
