//! The times that are compared, and the steps that reach them and that a run accepts.
//!
//! `(scene, window) => interval, samples; steps per interval => step`. A run wants steps of which
//! duration and sampling interval are whole multiples. So the interval of the comparison is a whole
//! multiple or part of the longest such step, and every step of a survey is a whole part of both.

use dbd_plant::fitting::Span;
use dbd_plant::time::{display, rounded};
use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

/// Intervals of a window, at most; at least half as many.
pub const SAMPLES: u32 = 50;

/// Relative: two times nearer than that are one.
const SAME: f64 = 1e-9;

/// A step up to this share shorter is taken where that makes it a round number.
const ROUNDER: f64 = 0.05;

/// Digits of a step: so many that rounding moves no sample beyond the rounding of its time.
const DIGITS: usize = 15;

/// Equal intervals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// \[s\] between two samples.
    pub interval: f64,
    /// How many intervals.
    pub samples: u32,
    /// Steps per interval are a multiple of this.
    stride: u64,
}

impl Grid {
    /// The grid of a scene in a window of at most `longest` \[s\].
    #[must_use]
    pub fn new(scene: &Scene, longest: f64) -> Self {
        let unit = unit(scene);
        let wanted = longest / f64::from(SAMPLES);
        let (interval, stride) = if wanted < unit {
            (unit / (unit / wanted * (1.0 + SAME)).floor(), 1)
        } else {
            let stride = (wanted / unit * (1.0 - SAME)).ceil();
            (stride * unit, stride as u64)
        };
        let samples = (longest / interval * (1.0 + SAME)).floor().max(1.0) as u32;
        Self { interval, samples, stride }
    }

    /// \[s\] its end.
    #[must_use]
    pub fn window(&self) -> f64 {
        self.interval * f64::from(self.samples)
    }

    /// \[s\] all samples' times, t = 0 first.
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        (0..=self.samples).map(|row| self.interval * f64::from(row)).collect()
    }

    /// \[s\] the step of so many per interval.
    #[must_use]
    pub fn step(&self, steps: u64) -> f64 {
        rounded(self.interval / steps as f64, DIGITS)
    }

    /// Steps per interval for a step of at most `limit` \[s\]: the roundest nearby.
    #[must_use]
    pub fn steps(&self, limit: f64) -> u64 {
        let least = (self.interval / limit / self.stride as f64).ceil().max(1.0);
        let most = (least * (1.0 + ROUNDER)).floor();
        // Rounder numbers lie within a hundred of any.
        let counts = (0..100).map(|n| least + f64::from(n)).take_while(|count| *count <= most);
        let steps = counts.map(|count| count as u64 * self.stride);
        steps.min_by_key(|steps| display(self.step(*steps)).len()).unwrap_or(self.stride)
    }
}

/// \[s\] the longest step that a run of the scene accepts.
fn unit(scene: &Scene) -> f64 {
    Span::new(scene.duration, scene.every).map_or(scene.duration, |span| span.longest())
}

/// The option of a run that lets a scene's steps fit where no step divides both its duration and its
/// sampling interval.
#[must_use]
pub fn every(scene: &Scene) -> Option<String> {
    let fits = Span::new(scene.duration, scene.every).is_some();
    (!fits).then(|| format!("--every {}", display(scene.duration)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use dbd_plant::plan::{Request, StepRequest, plan};

    fn scene(duration: f64, every: &str) -> Scene {
        let text = format!(
            "name = \"a\"\nduration = {duration}\n{every}\n[[body]]\nname = \"b\"\nmass = 1.0\nposition = [0.0, 0.0, 0.0]\n\
             inertia = [1.0, 1.0, 1.0]\n"
        );
        Scene::parse(&text, "a.toml").unwrap()
    }

    #[test]
    fn every_step_is_one_that_a_run_accepts() {
        for (duration, every) in
            [(0.5, "every = 1e-3"), (10.0, "every = 0.02"), (2.0, ""), (1.0, "every = 0.3")]
        {
            let scene = scene(duration, every);
            for window in [duration, 0.37 * duration, 0.0123, 1e-4] {
                let grid = Grid::new(&scene, window);
                assert!((25..=50).contains(&grid.samples), "{grid:?}");
                assert!(grid.window() <= window * (1.0 + 1e-9));
                assert!(grid.window() > 0.9 * window, "{window} {grid:?}");
                for limit in [1.0, 3.3e-4, 8.547e-5, 1.234e-6] {
                    let steps = grid.steps(limit);
                    let step = grid.step(steps);
                    assert!(step <= limit * (1.0 + 1e-9), "{step:e} {limit:e}");
                    assert!((step * steps as f64 / grid.interval - 1.0).abs() < 1e-14);
                    let step = display(step).parse::<dbd_plant::time::Time>().unwrap().seconds();
                    let step = StepRequest::Given(step);
                    let request = Request { step, duration, every: scene.every };
                    assert!(plan(&request).is_ok(), "{every} {window} {limit}");
                }
            }
        }
        // A rounder number is taken where one is near.
        let grid = Grid::new(&scene(0.5, "every = 1e-3"), 0.5);
        assert_eq!(display(grid.step(grid.steps(8.3e-6))), "8us");
    }

    #[test]
    fn an_interval_that_no_step_divides_is_replaced() {
        let scene = scene(1.0, "every = 0.314159265358979");
        let option = every(&scene).unwrap();
        assert_eq!(option, "--every 1s");
        let step = StepRequest::Given(Grid::new(&scene, 1.0).step(1234));
        assert!(plan(&Request { step, duration: 1.0, every: Some(1.0) }).is_ok());
        assert_eq!(every(&self::scene(1.0, "")), None);
    }
}
