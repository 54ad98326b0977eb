//! A list of steps: each is run, timed and counted; a failure does not stop the others.
//!
//! `(title, action)* => numbered lines, verdict`. The last line is `N passed, N failed`.

use std::time::{Duration, Instant};

use anyhow::{Result, bail};

use crate::attended::attended;

/// The steps done so far.
#[derive(Default)]
pub struct Steps {
    done: Vec<Step>,
}

/// A step that is done.
pub struct Step {
    /// What it does.
    pub title: String,
    /// How long it took.
    pub time: Duration,
    failure: Option<String>,
    skipped: Option<String>,
}

impl Steps {
    /// Runs one step and prints how it went.
    pub fn step(&mut self, title: &str, action: impl FnOnce() -> Result<()>) {
        let number = self.done.len() + 1;
        println!("\n== {number}. {title}");
        let start = Instant::now();
        let failure = attended(title, action).err().map(|error| format!("{error:#}"));
        let (title, time) = (title.to_owned(), start.elapsed());
        let step = Step { title, time, failure, skipped: None };
        if let Some(failure) = &step.failure {
            eprintln!("error: {failure}");
        }
        println!("{}", step.line(number));
        self.done.push(step);
    }

    /// Leaves a step out and says why; it counts neither as passed nor as failed.
    pub fn skip(&mut self, title: &str, why: &str) {
        let number = self.done.len() + 1;
        println!("\n== {number}. {title}\nskipped: {why}");
        let (title, skipped) = (title.to_owned(), Some(why.to_owned()));
        let step = Step { title, time: Duration::ZERO, failure: None, skipped };
        println!("{}", step.line(number));
        self.done.push(step);
    }

    /// The steps done so far, in order.
    pub fn done(&self) -> &[Step] {
        &self.done
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
        let skipped: Vec<_> = self.done.iter().filter(|s| s.skipped.is_some()).collect();
        for step in &skipped {
            let why = step.skipped.as_deref().unwrap_or_default();
            println!("skipped: {}: {why}", step.title);
        }
        let passed = self.done.iter().filter(|step| step.passed()).count();
        let left_out = match skipped.len() {
            0 => String::new(),
            count => format!(", {count} skipped"),
        };
        println!("{passed} passed, {} failed{left_out}", failed.len());
        if !failed.is_empty() {
            bail!("{} of {} steps failed", failed.len(), self.done.len());
        }
        Ok(())
    }
}

impl Step {
    /// Whether it was done and did not fail.
    pub fn passed(&self) -> bool {
        self.failure.is_none() && self.skipped.is_none()
    }

    fn line(&self, number: usize) -> String {
        let verdict = match (&self.failure, &self.skipped) {
            (Some(_), _) => "FAILED",
            (None, Some(_)) => "skipped",
            (None, None) => "ok",
        };
        format!("{number:>3}  {verdict:<7} {:>7.1} s  {}", self.time.as_secs_f64(), self.title)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_step_does_not_stop_the_others() {
        let mut steps = Steps::default();
        steps.step("one", || bail!("for a reason"));
        steps.step("two", || Ok(()));
        assert_eq!(steps.done().iter().map(Step::passed).collect::<Vec<_>>(), [false, true]);
        assert!(steps.finish().is_err());
    }

    #[test]
    fn a_skipped_step_is_neither_passed_nor_failed() {
        let mut steps = Steps::default();
        steps.step("one", || Ok(()));
        steps.skip("two", "there is no such program");
        assert_eq!(steps.done().iter().map(Step::passed).collect::<Vec<_>>(), [true, false]);
        assert!(steps.done()[1].line(2).contains("skipped"));
        assert!(steps.finish().is_ok());
    }
}
