//! A list of steps: each is run, timed and counted; a failure does not stop the others.
//!
//! `(title, action)* => numbered lines, verdict`. The last line is `N passed, N failed`.

use std::time::{Duration, Instant};

use anyhow::{Result, bail};

/// The steps done so far.
#[derive(Default)]
pub struct Steps {
    done: Vec<Step>,
}

struct Step {
    title: String,
    time: Duration,
    failure: Option<String>,
}

impl Steps {
    /// Runs one step and prints how it went.
    pub fn step(&mut self, title: &str, action: impl FnOnce() -> Result<()>) {
        let number = self.done.len() + 1;
        println!("\n== {number}. {title}");
        let start = Instant::now();
        let failure = action().err().map(|error| format!("{error:#}"));
        let step = Step { title: title.to_owned(), time: start.elapsed(), failure };
        if let Some(failure) = &step.failure {
            eprintln!("error: {failure}");
        }
        println!("{}", step.line(number));
        self.done.push(step);
    }

    /// Prints the table of steps, the failures and the count.
    ///
    /// # Errors
    /// Where a step failed.
    pub fn finish(self) -> Result<()> {
        println!("\n== steps");
        for (i, step) in self.done.iter().enumerate() {
            println!("{}", step.line(i + 1));
        }
        let failed: Vec<_> = self.done.iter().filter(|s| s.failure.is_some()).collect();
        for step in &failed {
            let failure = step.failure.as_deref().unwrap_or_default();
            println!("failed: {}: {failure}", step.title);
        }
        println!("{} passed, {} failed", self.done.len() - failed.len(), failed.len());
        if !failed.is_empty() {
            bail!("{} of {} steps failed", failed.len(), self.done.len());
        }
        Ok(())
    }
}

impl Step {
    fn line(&self, number: usize) -> String {
        let verdict = if self.failure.is_some() { "FAILED" } else { "ok" };
        format!("{number:>3}  {verdict:<6} {:>7.1} s  {}", self.time.as_secs_f64(), self.title)
    }
}
