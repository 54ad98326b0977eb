//! The compared times, and the valid steps that reach them.
//!
//! `(scene, window, period) => interval, samples; steps per interval => step`. Steps of a run must divide duration and
//! sampling interval, those with a controller also its period. So the interval of the comparison is an integer multiple
//! or fraction of the longest such step, and every step of a study divides both.

use dbd_plant::time::{display, rounded};
use dbd_scene::Scene;
use dbd_scene::fitting::{self, Span};
use serde::{Deserialize, Serialize};

/// Intervals of a window, at most; at least half as many.
pub const SAMPLES: u32 = 50;

/// Relative tolerance for equal times.
const SAME: f64 = 1e-9;

/// A step may be shortened by up to this fraction to a round number.
const ROUNDER: f64 = 0.05;

/// \[rad\] ten of the largest stable steps, at the highest frequency.
const TENFOLD: f64 = 10.0 * std::f64::consts::PI;

/// Digits of a step: enough that rounding moves no sample beyond the rounding of its time.
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

/// \[s\] the longest step that a run of the scene accepts and that divides a period \[s\], if one is requested. `None`
/// if no step does.
///
/// Without a period and a sampling interval of the scene, the steps divide a power of ten that is at least ten times
/// the stable step at `highest` \[rad/s\], if the duration is a multiple of it: round numbers, at the cost of a tenth
/// of the largest step.
#[must_use]
pub fn unit(scene: &Scene, period: Option<f64>, highest: f64) -> Option<f64> {
    let accepted =
        Span::new(scene.duration, scene.every).map_or(scene.duration, |span| span.longest());
    let round = || {
        let exponent = (TENFOLD / highest).log10().ceil();
        let power = format!("1e{exponent}").parse().unwrap_or(accepted);
        let fits = scene.every.is_none() && fitting::whole(accepted / power).is_some();
        if fits { power } else { accepted }
    };
    match period {
        Some(period) => Some(Span::new(accepted, Some(period))?.longest()),
        None => Some(if highest > 0.0 { round() } else { accepted }),
    }
}

impl Grid {
    /// The grid of steps that divide `unit` \[s\] in a window of at most `longest` \[s\].
    #[must_use]
    pub fn new(unit: f64, longest: f64) -> Self {
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

    /// \[s\] the time that every step divides.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.interval / self.stride as f64
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

    /// \[s\] the step for the given number per interval.
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

    fn grid(scene: &Scene, window: f64) -> Grid {
        Grid::new(unit(scene, None, 0.0).unwrap(), window)
    }

    #[test]
    fn every_step_divides_the_period_that_is_asked_for() {
        for (duration, every) in [(0.5, "every = 1e-3"), (10.0, "every = 0.02"), (2.0, "")] {
            let scene = scene(duration, every);
            for period in [1e-3, 8e-5, 1.5e-3, 0.5, 3e-4] {
                let unit = unit(&scene, Some(period), 1e4).unwrap();
                for window in [duration, 0.0123, 1e-4] {
                    let grid = Grid::new(unit, window);
                    for limit in [1.0, 3.3e-4, 8.547e-5, 1.234e-6] {
                        let step = grid.step(grid.steps(limit));
                        for time in [period, duration, scene.every.unwrap_or(duration)] {
                            assert!(
                                fitting::whole(time / step).is_some(),
                                "{time} {step}: {every} {period} {window}"
                            );
                        }
                    }
                }
            }
            assert_eq!(unit(&scene, Some(std::f64::consts::PI), 1e4), None);
        }
    }

    #[test]
    fn without_a_sampling_interval_steps_divide_a_power_of_ten() {
        // 190 us and shorter: ten of the largest fit into 10 ms.
        let highest = 3.0 / 190e-6;
        let plain = scene(5.0, "");
        assert_eq!(unit(&plain, None, highest), Some(1e-2));
        let step = Grid::new(1e-2, 0.5).step(Grid::new(1e-2, 0.5).steps(190e-6));
        assert!(fitting::whole(1e-2 / step).is_some() && step > 0.95 * 190e-6, "{step}");
        assert_eq!(unit(&scene(0.123, ""), None, highest), Some(0.123));
        assert_eq!(unit(&scene(5.0, "every = 0.02"), None, highest), Some(0.02));
        assert_eq!(unit(&plain, None, 0.0), Some(5.0));
    }

    #[test]
    fn every_step_is_one_that_a_run_accepts() {
        for (duration, every) in
            [(0.5, "every = 1e-3"), (10.0, "every = 0.02"), (2.0, ""), (1.0, "every = 0.3")]
        {
            let scene = scene(duration, every);
            for window in [duration, 0.37 * duration, 0.0123, 1e-4] {
                let grid = grid(&scene, window);
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
        // A rounder number is used if one is near.
        let grid = grid(&scene(0.5, "every = 1e-3"), 0.5);
        assert_eq!(display(grid.step(grid.steps(8.3e-6))), "8us");
    }

    #[test]
    fn an_interval_that_no_step_divides_is_replaced() {
        let scene = scene(1.0, "every = 0.314159265358979");
        let option = every(&scene).unwrap();
        assert_eq!(option, "--every 1s");
        let step = StepRequest::Given(grid(&scene, 1.0).step(1234));
        assert!(plan(&Request { step, duration: 1.0, every: Some(1.0) }).is_ok());
        assert_eq!(every(&self::scene(1.0, "")), None);
    }
}
