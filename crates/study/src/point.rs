//! A point of the study: a method, its cost and its error.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

/// Who steps.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Stepper {
    /// The kernel's scheme, `dbd`, or the std reference's: `std leapfrog`,
    /// `std linearly-implicit-euler` ….
    pub scheme: String,
    /// Newton iterations, for the schemes that have them.
    pub newton: Option<u32>,
    /// The damping mode if it is not the scheme's default: `explicit`, `joint-wise`.
    pub damping: Option<String>,
    /// `f64`, `f32` ….
    pub precision: String,
    /// `quaternion`, `euler-321` ….
    pub orientation: String,
    /// Whether it is the kernel, and not a reference in plain std Rust.
    pub kernel: bool,
}

/// Result of a stepper at a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Who steps.
    #[serde(flatten)]
    pub stepper: Stepper,
    /// \[s\] the step.
    pub step: f64,
    /// Steps over the window.
    pub steps: u64,
    /// Whether the run came to its end without growth of energy; accuracy is `None` otherwise.
    pub stable: bool,
    /// Whether its error exceeds the displacement of the reference solution.
    pub lost: bool,
    /// Whether it may be advised: its step is [`MARGIN`](crate::stability::MARGIN) below the largest stable one, and a
    /// run accepts it without a warning.
    pub advisable: bool,
    /// \[m\] root mean square over bodies and samples of the distance from the reference solution, see
    /// [`Metric`](crate::reference::metric::Metric).
    pub error: Option<f64>,
    /// \[J\] root mean square of the energy's error; `None` where dampers, loads or inputs change it.
    pub energy_rms: Option<f64>,
    /// \[J\] the largest energy error likewise.
    pub energy_peak: Option<f64>,
    /// Force evaluations per simulated second.
    pub evaluations: f64,
    /// \[s\] of a host's core per simulated second, the least of the measurements: other work on the
    /// machine can only lengthen them.
    pub host_seconds_least: f64,
    /// \[s\] the median likewise.
    pub host_seconds: f64,
    /// Half the range of the middle half of the measurements over the median.
    pub host_spread: f64,
    /// Instructions per simulated second on Cortex-M4F, where they were counted.
    pub target_instructions: Option<f64>,
    /// \[s\] of a planar scene the largest step that is also stable in space, where it may leave the plane; infinite,
    /// in JSON null, if every step is.
    pub step_in_space: Option<f64>,
    /// How the error falls with the step here.
    pub fall: Fall,
}

/// Cause of a reduced convergence order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// Damper passes around a step: order 2.
    SweptDampers,
    /// Dampers at the velocities of an evaluation.
    ExplicitDampers,
    /// Loads that begin or end, tables that bend or jump, within steps.
    LoadsAndTables,
}

/// How the error of a stepper falls at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fall {
    /// By which power of the step the error falls from here on; `None` where that was not measured.
    pub order: Option<f64>,
    /// The order that the scheme states without dampers.
    pub stated: Option<u32>,
    /// Cause of the reduced order.
    pub cause: Option<Cause>,
    /// \[s\] the step of the ladder below which no step is more accurate, in other precisions than double: limited by
    /// rounding.
    pub finest: Option<f64>,
}

/// The precision whose square root is approximate: shown for comparison, never advised.
const APPROXIMATE: &str = "f32-micromath";

impl Stepper {
    /// Whether it may be advised: the kernel and the references with exact square roots.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.precision != APPROXIMATE
    }

    /// The options of `host-sim run` that choose it; `None` for a reference.
    #[must_use]
    pub fn options(&self) -> Option<String> {
        if !self.kernel {
            return None;
        }
        let mut options = format!("--scheme {}", self.scheme);
        if let Some(newton) = self.newton.filter(|newton| *newton > 0) {
            options += &format!(" --newton {newton}");
        }
        if let Some(damping) = &self.damping {
            options += &format!(" --damping {damping}");
        }
        options += &format!(" --precision {}", self.precision);
        if self.orientation != "quaternion" {
            options += &format!(" --orientation {}", self.orientation);
        }
        Some(options)
    }

    /// Its name: `leapfrog f32`, `dbd +1 f64`, `leapfrog f64, euler-321`.
    #[must_use]
    pub fn label(&self) -> String {
        let mut label = self.scheme.clone();
        if let Some(newton) = self.newton.filter(|newton| *newton > 0) {
            label += &format!(" +{newton}");
        }
        if let Some(damping) = &self.damping {
            label += &format!(" ({damping})");
        }
        label += &format!(" {}", self.precision);
        if self.orientation != "quaternion" {
            label += &format!(", {}", self.orientation);
        }
        label
    }
}

/// A machine whose cost is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Machine {
    /// Seconds of a host's core per simulated second.
    Host,
    /// Instructions of a Cortex-M4F per simulated second.
    Target,
}

impl Point {
    /// Its cost on a machine, where known.
    #[must_use]
    pub fn cost(&self, machine: Machine) -> Option<f64> {
        match machine {
            Machine::Host => Some(self.host_seconds_least),
            Machine::Target => self.target_instructions,
        }
    }

    /// Its cost and its error \[m\], where it has both, is not lost and may be advised.
    #[must_use]
    pub fn kept(&self, machine: Machine) -> Option<(f64, f64)> {
        if self.lost || !self.advisable { None } else { self.drawn(machine) }
    }

    /// Likewise, whether or not it is lost or may be advised.
    #[must_use]
    pub fn drawn(&self, machine: Machine) -> Option<(f64, f64)> {
        let cost = self.cost(machine).filter(|cost| cost.is_finite() && *cost > 0.0)?;
        let error = self.error.filter(|error| self.stable && error.is_finite() && *error >= 0.0)?;
        Some((cost, error))
    }
}

/// Whether it is the paper's scheme: explicit, no Newton iteration, in double
/// precision; on the target also in single, which its FPU has.
#[must_use]
pub fn is_paper(stepper: &Stepper, machine: Machine) -> bool {
    let single = machine == Machine::Target && stepper.precision == "f32";
    stepper.kernel
        && stepper.scheme == "dbd"
        && stepper.newton.unwrap_or(0) == 0
        && stepper.damping.is_none()
        && (stepper.precision == "f64" || single)
        && stepper.orientation == "quaternion"
}

/// Number of kernel methods with known cost on a machine, without micromath.
#[must_use]
pub fn counted(points: &[Point], machine: Machine) -> usize {
    let known = |point: &&Point| point.stepper.kernel && point.cost(machine).is_some();
    let steppers = points.iter().filter(known).map(|point| &point.stepper);
    steppers.filter(|stepper| stepper.is_exact()).collect::<BTreeSet<_>>().len()
}

/// Rows of the Pareto front on a machine: no other point has at most the error at at most the cost. Ascending in cost.
/// Approximate arithmetic and lost points are excluded.
#[must_use]
pub fn front(points: &[Point], machine: Machine) -> Vec<usize> {
    let mut rows: Vec<(f64, f64, usize)> = points
        .iter()
        .enumerate()
        .filter(|(_, point)| point.stepper.is_exact())
        .filter_map(|(row, point)| point.kept(machine).map(|(cost, error)| (cost, error, row)))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut least = f64::INFINITY;
    rows.retain(|(_, error, _)| {
        let better = *error < least;
        least = least.min(*error);
        better
    });
    rows.into_iter().map(|(.., row)| row).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A point of the kernel with a cost on both machines and an error.
    pub(crate) fn point(scheme: &str, step: f64, cost: f64, error: Option<f64>) -> Point {
        Point {
            stepper: Stepper {
                scheme: scheme.into(),
                newton: None,
                damping: None,
                precision: "f64".into(),
                orientation: "quaternion".into(),
                kernel: true,
            },
            step,
            steps: (1.0 / step) as u64,
            stable: error.is_some(),
            lost: false,
            advisable: true,
            error,
            energy_rms: None,
            energy_peak: None,
            evaluations: 1.0 / step,
            host_seconds_least: cost,
            host_seconds: 1.02 * cost,
            host_spread: 0.05,
            target_instructions: Some(cost * 1e9),
            step_in_space: None,
            fall: Fall::default(),
        }
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let points = [
            point("a", 1e-3, 1.0, Some(1e-3)),
            point("b", 1e-3, 2.0, Some(2e-3)),
            point("c", 1e-4, 3.0, Some(1e-5)),
            point("d", 1e-4, 3.0, Some(1e-4)),
            point("e", 1e-2, 0.5, None),
            point("f", 1e-5, 9.0, Some(1e-5)),
        ];
        assert_eq!(front(&points, Machine::Host), [0, 2]);
        let mut uncounted = points.clone();
        uncounted[0].target_instructions = None;
        assert_eq!(front(&uncounted, Machine::Target), [1, 2]);
        assert_eq!(counted(&uncounted, Machine::Target), 5);
    }

    #[test]
    fn what_is_loose_or_lost_beats_nothing() {
        let mut points = [point("a", 1e-3, 1.0, Some(1e-3)), point("b", 1e-3, 2.0, Some(1e-4))];
        points[0].lost = true;
        assert_eq!(front(&points, Machine::Host), [1]);
        assert_eq!(points[0].drawn(Machine::Host), Some((1.0, 1e-3)));
        points[0].lost = false;
        points[0].stepper.precision = APPROXIMATE.into();
        assert_eq!(front(&points, Machine::Host), [1]);
        assert_eq!(counted(&points, Machine::Host), 1);
    }

    #[test]
    fn options_are_those_of_the_command_line() {
        let mut stepper = point("dbd", 1.0, 1.0, None).stepper;
        assert_eq!(stepper.options().unwrap(), "--scheme dbd --precision f64");
        stepper.newton = Some(1);
        stepper.damping = Some("explicit".into());
        stepper.orientation = "euler-321".into();
        let all =
            "--scheme dbd --newton 1 --damping explicit --precision f64 --orientation euler-321";
        assert_eq!(stepper.options().unwrap(), all);
        stepper.kernel = false;
        assert_eq!(stepper.options(), None);
    }

    #[test]
    fn labels_name_what_is_not_usual() {
        let mut stepper = point("dbd", 1.0, 1.0, None).stepper;
        assert_eq!(stepper.label(), "dbd f64");
        stepper.newton = Some(1);
        stepper.orientation = "euler-321".into();
        assert_eq!(stepper.label(), "dbd +1 f64, euler-321");
    }
}
