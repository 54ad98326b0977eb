//! What was aimed at, beside what is.
//!
//! `rows => goals, met or not`. A time that scatters more than the goal is narrow decides nothing.

use serde::Serialize;

use super::ensembles::Together;
use super::fit::exponent;
use super::nets::Net;
use super::ways::Row;

/// A figure and what it ought to be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Goal {
    /// What the figure is.
    pub what: String,
    /// The figure.
    pub figure: f64,
    /// How far it may be off by the scatter of the times.
    pub scatter: f64,
    /// The least that it ought to be, where there is one.
    pub at_least: Option<f64>,
    /// The most, likewise.
    pub at_most: Option<f64>,
    /// Whether it is met.
    pub verdict: Verdict,
}

/// Whether a goal is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It is.
    Met,
    /// It is not.
    NotMet,
    /// The times scatter too much to tell.
    TooNoisy,
    /// It is not, and the cores had other work: threads of plants that share nothing gained too little, too.
    CoresBusy,
}

/// What two threads of plants that share nothing gain where both their cores have nothing else to do.
const FREE: f64 = 1.9;

/// How far the exponent of growth may be from 1.
const GROWTH: f64 = 0.03;

impl Goal {
    fn new(what: String, figure: f64, scatter: f64, [low, high]: [Option<f64>; 2]) -> Self {
        let holds = |figure: f64| {
            low.is_none_or(|low| figure >= low) && high.is_none_or(|high| figure <= high)
        };
        let verdict = match (holds(figure - scatter), holds(figure + scatter)) {
            (true, true) => Verdict::Met,
            (false, false) if !holds(figure) => Verdict::NotMet,
            _ => Verdict::TooNoisy,
        };
        Self { what, figure, scatter, at_least: low, at_most: high, verdict }
    }

    /// As people read it, without its name.
    #[must_use]
    pub fn text(&self) -> String {
        let Self { figure, scatter, .. } = self;
        let goal = match (self.at_least, self.at_most) {
            (Some(low), Some(high)) => format!("{low} to {high}"),
            (Some(low), None) => format!("at least {low}"),
            (None, Some(high)) => format!("at most {high}"),
            (None, None) => "none".to_owned(),
        };
        let verdict = match self.verdict {
            Verdict::Met => "met",
            Verdict::NotMet => "not met",
            Verdict::TooNoisy => "times scatter too much to tell",
            Verdict::CoresBusy => "not met, the cores had other work",
        };
        format!("{figure:.2} ± {scatter:.2}, goal {goal}: {verdict}")
    }
}

/// The goals that the rows say something about.
#[must_use]
pub fn goals(rows: &[Row], ensembles: &[Together], nets: &[Net]) -> Vec<Goal> {
    let nets = nets.iter().filter_map(large_net);
    growth(rows).into_iter().chain(ensembles.iter().filter_map(lockstep)).chain(nets).collect()
}

/// The time of nets of about a thousand bodies, the largest that was aimed at.
fn large_net(net: &Net) -> Option<Goal> {
    let time = net.body_step_s.filter(|_| (900..=1_100).contains(&net.bodies))?;
    let what = format!("ns per body and step, net of {} point masses", net.bodies);
    let figure = 1e9 * time.least;
    Some(Goal::new(what, figure, figure * time.spread, [None, Some(1_500.0)]))
}

/// Ensembles on AVX2, which is what was aimed at.
fn lockstep(ensemble: &Together) -> Option<Goal> {
    let Together { precision, instructions, threads, .. } = ensemble;
    if *instructions != "avx2" {
        return None;
    }
    let goal = |beside: &str, figure: f64, spread: f64, least: f64| {
        let what = format!("{threads} × {precision} on {instructions} over {beside}");
        Goal::new(what, figure, figure * spread, [Some(least), None])
    };
    if *threads == 1 {
        let least = if *precision == "f64" { 3.2 } else { 5.0 };
        let over_alone = ensemble.over_alone?;
        return Some(goal("one by one", over_alone.median, over_alone.spread, least));
    }
    let (figure, spread) = ensemble.over_one_thread.zip(ensemble.over_one_thread_spread)?;
    let mut goal = goal("one thread", figure, spread, 1.8);
    let free = ensemble.alone_over_one_thread.is_none_or(|cores| cores >= FREE);
    if goal.verdict != Verdict::Met && !free {
        goal.verdict = Verdict::CoresBusy;
    }
    Some(goal)
}

/// How the time of a step grows with the bodies of a chain.
fn growth(rows: &[Row]) -> Option<Goal> {
    let points: Vec<(f64, f64, f64)> = rows
        .iter()
        .filter_map(|row| {
            let time = row.f64_s?;
            Some((row.size.links? as f64, time.least, time.spread))
        })
        .collect();
    let (figure, scatter) = grown(&points)?;
    let links = |pick: fn(f64, f64) -> f64| {
        points.iter().map(|point| point.0).reduce(pick).unwrap_or_default()
    };
    let what = format!("time ∝ bodies^x, {} to {}", links(f64::min), links(f64::max));
    Some(Goal::new(what, figure, scatter, [Some(1.0 - GROWTH), Some(1.0 + GROWTH)]))
}

/// The exponent of points (bodies, time, spread of the time) and how far the spreads may move it.
fn grown(points: &[(f64, f64, f64)]) -> Option<(f64, f64)> {
    let of = |scale: [f64; 2]| {
        let last = points.len().checked_sub(1)?;
        let scaled = points.iter().enumerate().map(|(row, (links, time, spread))| {
            let sign = scale[0] + (scale[1] - scale[0]) * row as f64 / last.max(1) as f64;
            // Above zero, however far the times lie apart.
            let factor = 1.0 + sign.abs() * spread;
            (*links, if sign < 0.0 { time / factor } else { time * factor })
        });
        exponent(&scaled.collect::<Vec<_>>())
    };
    let figure = of([0.0, 0.0])?;
    // The spreads at their worst: the short chains too fast, the long ones too slow.
    Some((figure, (of([-1.0, 1.0])? - figure).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_is_met_missed_or_lost_in_the_noise() {
        let verdict = |figure: f64, scatter: f64| {
            Goal::new(String::new(), figure, scatter, [Some(0.97), Some(1.03)]).verdict
        };
        assert_eq!(verdict(1.0, 0.01), Verdict::Met);
        assert_eq!(verdict(1.2, 0.01), Verdict::NotMet);
        assert_eq!(verdict(1.02, 0.05), Verdict::TooNoisy);
        assert_eq!(verdict(1.04, 0.02), Verdict::TooNoisy);
        let text = Goal::new(String::new(), 3.5, 0.1, [Some(3.2), None]).text();
        assert_eq!(text, "3.50 ± 0.10, goal at least 3.2: met");
    }

    #[test]
    fn threads_that_cores_do_not_carry_are_told_from_threads_that_wait() {
        let verdict = |gained: f64, cores: f64| {
            let ensemble = Together {
                name: String::new(),
                precision: "f64",
                instructions: "avx2",
                threads: 2,
                instances: 8,
                over_alone: None,
                over_one_thread: Some(gained),
                over_one_thread_spread: Some(0.01),
                alone_over_one_thread: Some(cores),
            };
            lockstep(&ensemble).unwrap().verdict
        };
        assert_eq!(verdict(1.9, 1.7), Verdict::Met);
        assert_eq!(verdict(1.6, 1.7), Verdict::CoresBusy);
        assert_eq!(verdict(1.6, 1.95), Verdict::NotMet);
        assert_eq!(verdict(1.795, 1.95), Verdict::TooNoisy);
    }

    #[test]
    fn times_that_scatter_by_more_than_themselves_have_an_exponent_and_a_scatter() {
        let (figure, scatter) = grown(&[(2.0, 1.0, 3.0), (4.0, 2.0, 3.0)]).unwrap();
        // Four times too fast, four times too slow: 16 on a doubling.
        assert!((figure - 1.0).abs() < 1e-12 && (scatter - 4.0).abs() < 1e-12);
        assert!(grown(&[]).is_none());
    }
}
