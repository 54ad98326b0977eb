//! Advice in sentences: which method to choose for an accuracy.
//!
//! `points => advice`. A choice is a measured point; the cost of the paper's scheme at the same accuracy is
//! interpolated between its own points and marked as such.

use std::fmt;

use dbd_plant::digits::{approximate, significant};
use dbd_plant::time::{display, rounded};

use crate::need::{Need, PaperNeed, paper_need};
use crate::point::{Cause, Fall, Machine, Point, counted, is_paper};
use crate::timing::CALM;
use crate::words::{Cost, named, percent, shown, times};

/// Decimal exponents of the accuracies spoken of, in metres.
const DECADES: std::ops::RangeInclusive<i32> = -9..=-3;

/// The row of the cheapest point of the kernel with at most the given error \[m\]; of references with `kernel` false.
#[must_use]
pub fn choice(points: &[Point], machine: Machine, target: f64, kernel: bool) -> Option<usize> {
    let of = |point: &Point| point.stepper.kernel == kernel && point.stepper.is_exact();
    let rows = points.iter().enumerate().filter(|(_, point)| of(point));
    let good = rows.filter_map(|(row, point)| {
        let (cost, error) = point.kept(machine)?;
        (error <= target).then_some((cost, error, row))
    });
    good.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)))
        .map(|(.., row)| row)
}

/// Choice for an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Decimal exponent of the accuracy \[m\].
    pub decade: i32,
    /// The chosen point's row.
    pub row: usize,
    /// In words.
    pub sentence: String,
}

/// One for each power of ten from 1 mm down to 1 nm that some point of the kernel reaches, down to the uncertainty
/// \[m\] of the reference solution.
#[must_use]
pub fn advice(points: &[Point], machine: Machine, uncertainty: f64) -> Vec<Advice> {
    let among = match machine {
        Machine::Host => String::new(),
        Machine::Target => match counted(points, machine) {
            1 => " (the only method with counted instructions)".into(),
            many => format!(" (of {many} methods with counted instructions)"),
        },
    };
    let paper = points.iter().filter(|point| is_paper(&point.stepper, machine));
    let paper_spread = paper.map(|point| point.host_spread).fold(0.0, f64::max);
    DECADES
        .rev()
        .map(|decade| (decade, power_of_ten(decade)))
        .filter(|(_, target)| *target >= uncertainty)
        .filter_map(|(decade, target)| {
            let row = choice(points, machine, target, true)?;
            let chosen = &points[row];
            let (cost, _) = chosen.kept(machine)?;
            let mut sentence = format!(
                "for 1e{decade} m choose{among} {}, step {} ({})",
                named(&chosen.stepper),
                display(chosen.step),
                Cost(cost, machine),
            );
            if is_paper(&chosen.stepper, machine) {
                sentence += ": the paper's scheme";
            } else if let Some(PaperNeed { need, precision }) = paper_need(points, machine, target)
            {
                let whose = match machine {
                    Machine::Host => String::new(),
                    Machine::Target => format!(" in {precision}"),
                };
                sentence += &format!("; the paper's scheme{whose} {}", Against(need, cost));
            }
            let reference = choice(points, machine, target, false).map(|row| &points[row]);
            let cheaper = reference
                .and_then(|point| Some((point, point.kept(machine)?.0 / cost)))
                .filter(|(_, ratio)| *ratio < 1.0);
            if let Some((point, ratio)) = cheaper {
                let (who, step) = (named(&point.stepper), shown(point.step));
                let ratio = times(ratio);
                sentence +=
                    &format!("; the reference {who}, step {step}, needs {ratio} times as much");
            }
            sentence += &limits(points, row);
            if let Some(least) = chosen.step_in_space.filter(|least| *least < chosen.step) {
                sentence +=
                    &format!("; stable only in the plane, in space up to {}", approximate(least));
            }
            let widest = chosen.host_spread.max(paper_spread);
            if machine == Machine::Host && widest > CALM {
                let spread = percent(widest);
                sentence += &format!("; timed on a busy machine: times vary by {spread}");
            }
            Some(Advice { decade, row, sentence })
        })
        .collect()
}

/// Measured limits of a choice's convergence with smaller steps.
fn limits(points: &[Point], row: usize) -> String {
    let chosen = &points[row];
    let mut text = String::new();
    if let Fall { order: Some(order), stated: Some(stated), cause: Some(cause), .. } = chosen.fall {
        let why = match cause {
            Cause::SweptDampers => "dampers act in passes before and after each step",
            Cause::ExplicitDampers => "its dampers are explicit",
            Cause::LoadsAndTables => "loads or tables change within its steps",
        };
        let order = significant(rounded(order, 2), 2);
        text += &format!("; its convergence order here is {order}, not {stated}: {why}");
    }
    if let Some(finest) = chosen.fall.finest {
        let usable = |point: &&Point| point.stepper == chosen.stepper && point.advisable;
        let largest = points.iter().filter(usable).map(|point| point.step).fold(0.0, f64::max);
        let precision = &chosen.stepper.precision;
        text += &match finest >= largest {
            true => format!("; in {precision} its largest usable step is the most accurate"),
            false => {
                format!("; in {precision} steps below {} are not more accurate", shown(finest))
            }
        };
    }
    text
}

/// Why no advice can be given; `None` where it can.
#[must_use]
pub fn remark(points: &[Point], machine: Machine) -> Option<&'static str> {
    let drawn = || points.iter().filter_map(|point| point.drawn(machine));
    let costs = points.iter().filter_map(|point| point.cost(machine));
    if !costs.into_iter().any(|cost| cost.is_finite() && cost > 0.0) {
        Some("no point has a cost")
    } else if drawn().next().is_none() {
        Some("no step is stable")
    } else if drawn().all(|(_, error)| error == 0.0) {
        Some("every error is zero")
    } else if points.iter().all(|point| point.kept(machine).is_none()) {
        Some("none of the tested steps can be advised")
    } else {
        None
    }
}

/// The nearest f64 to a power of ten, which `powi` need not be.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Cost of the paper's scheme relative to another.
struct Against(Need, f64);

impl fmt::Display for Against {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ratio = |cost: f64| times(cost / self.1);
        match self.0 {
            Need::Largest { cost, step } => {
                let (ratio, step) = (ratio(cost), shown(step));
                write!(f, "needs {ratio} times as much at {step}, its largest step here")
            }
            Need::Between { cost } => write!(f, "needs about {} times as much", ratio(cost)),
            Need::Beyond { cost, order } => {
                let (ratio, order) = (ratio(cost), significant(order, 2));
                write!(f, "needs about {ratio} times as much, by extrapolation at order {order}")
            }
            Need::MoreThan { cost } => {
                let ratio = ratio(cost);
                write!(f, "needs more than {ratio} times as much, by extrapolation")
            }
            Need::Never => f.write_str("does not reach this accuracy"),
            Need::Unstable => f.write_str("has no stable step here"),
            Need::Uncounted => f.write_str("was not counted here"),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::point::Stepper;
    use crate::point::tests::point;

    /// The paper's scheme at order 1, and a better one at order 4.
    pub(crate) fn ladder() -> Vec<Point> {
        let paper = [1e-3, 1e-4, 1e-5].map(|h| point("dbd", h, 1e-6 / h, Some(h)));
        let better = [1e-3, 1e-4].map(|h| point("pefrl", h, 2e-6 / h, Some(9e7 * h.powi(4))));
        paper.into_iter().chain(better).chain([point("rk4", 1e-2, 1e-9, None)]).collect()
    }

    pub(crate) fn sentences(points: &[Point], machine: Machine, uncertainty: f64) -> Vec<String> {
        advice(points, machine, uncertainty).into_iter().map(|advice| advice.sentence).collect()
    }

    #[test]
    fn the_chips_sentences_say_what_was_counted() {
        let mut points = ladder();
        let mut single = points[1].clone();
        single.stepper.precision = "f32".into();
        points.push(single);
        for point in points.iter_mut().filter(|p| is_paper(&p.stepper, Machine::Host)) {
            point.target_instructions = None;
        }
        let said = sentences(&points, Machine::Target, 1e-5);
        assert_eq!(
            said.last().unwrap(),
            "for 1e-5 m choose (of 3 methods with counted instructions) pefrl, f64, step 100us (20 \
             million instructions per simulated second); the paper's scheme in f32 does not reach this accuracy"
        );
        assert!(said.iter().all(|sentence| !sentence.contains("stable")));
        let alone = [points[4].clone()];
        let said = sentences(&alone, Machine::Target, 1e-5).pop().unwrap();
        assert!(
            said.contains(" choose (the only method with counted instructions) pefrl, f64, "),
            "{said}"
        );
        let said = sentences(&ladder(), Machine::Target, 1e-5).pop().unwrap();
        assert!(
            said.ends_with("; the paper's scheme in f64 needs about 5 times as much"),
            "{said}"
        );
    }

    #[test]
    fn loose_arithmetic_is_not_advised_and_zeros_are_called_so() {
        let mut points = ladder();
        points.truncate(3);
        let mut approximate = points[0].clone();
        approximate.stepper.precision = "f32-micromath".into();
        (approximate.error, approximate.host_seconds_least) = (Some(0.0), 1e-9);
        points.push(approximate);
        assert!(sentences(&points, Machine::Host, 0.0).iter().all(|s| !s.contains("micromath")));
        assert_eq!(remark(&points, Machine::Host), None);
        points.iter_mut().for_each(|point| point.error = Some(0.0));
        assert_eq!(remark(&points, Machine::Host), Some("every error is zero"));
    }

    #[test]
    fn each_decade_reached_has_its_cheapest_point() {
        let mut points = ladder();
        assert_eq!(
            sentences(&points, Machine::Host, 0.0),
            [
                "for 1e-3 m choose dbd, f64, step 1ms (0.001 s of a core per simulated second): \
                 the paper's scheme",
                "for 1e-4 m choose pefrl, f64, step 1ms (0.002 s of a core per simulated second); \
                 the paper's scheme needs about 5 times as much",
                "for 1e-5 m choose pefrl, f64, step 100us (0.02 s of a core per simulated \
                 second); the paper's scheme needs about 5 times as much",
                "for 1e-6 m choose pefrl, f64, step 100us (0.02 s of a core per simulated \
                 second); the paper's scheme needs about 50 times as much, by extrapolation at \
                 order 1",
                "for 1e-7 m choose pefrl, f64, step 100us (0.02 s of a core per simulated \
                 second); the paper's scheme needs about 500 times as much, by extrapolation at \
                 order 1",
                "for 1e-8 m choose pefrl, f64, step 100us (0.02 s of a core per simulated \
                 second); the paper's scheme needs more than 500 times as much, by extrapolation",
            ]
        );
        // Accuracies below the uncertainty of the reference solution have no advice.
        assert_eq!(sentences(&points, Machine::Host, 5e-7).len(), 4);
        // A reference is not chosen, but mentioned if it is cheaper.
        let mut reference = point("naive", 1e-3, 0.01, Some(1e-6));
        reference.stepper.kernel = false;
        points.push(reference);
        let said = sentences(&points, Machine::Host, 0.0);
        assert!(said[3].starts_with("for 1e-6 m choose pefrl"), "{}", said[3]);
        assert!(said[3].ends_with("; the reference naive, f64, step 1ms, needs 0.5 times as much"));
        assert!(!said[4].contains("reference"));
    }

    #[test]
    fn what_limits_a_choice_is_said_with_it() {
        let mut points = ladder();
        let said = |points: &[Point]| sentences(points, Machine::Host, 1e-5).pop().unwrap();
        assert!(!said(&points).contains("order"));
        let (order, stated, finest) = (Some(1.04), Some(4), None);
        for point in points.iter_mut().filter(|point| point.stepper.scheme == "pefrl") {
            point.fall = Fall { order, stated, cause: Some(Cause::LoadsAndTables), finest };
        }
        let text = said(&points);
        assert!(
            text.ends_with(
                "; its convergence order here is 1, not 4: loads or tables change within its steps"
            ),
            "{text}"
        );
        for point in points.iter_mut().filter(|point| point.stepper.scheme == "pefrl") {
            point.stepper.precision = "f32".into();
            point.fall = Fall { order, stated, cause: None, finest: Some(1e-4) };
        }
        let text = said(&points);
        assert!(text.ends_with("; in f32 steps below 100us are not more accurate"), "{text}");
        points.iter_mut().for_each(|point| point.fall.finest = Some(1e-3));
        let text = sentences(&points, Machine::Host, 1e-4).pop().unwrap();
        assert!(text.ends_with("; in f32 its largest usable step is the most accurate"), "{text}");
    }

    #[test]
    fn a_step_that_only_the_plane_bears_is_said_to() {
        let mut points = ladder();
        points.iter_mut().for_each(|point| point.step_in_space = Some(5e-4));
        let said = sentences(&points, Machine::Host, 0.0);
        let words = "; stable only in the plane, in space up to 500us";
        assert!(said[1].ends_with(words) && said[1].contains("step 1ms"), "{}", said[1]);
        assert!(!said[2].contains("plane") && said[2].contains("step 100us"), "{}", said[2]);
    }

    #[test]
    fn times_that_scatter_are_said_to() {
        let mut points = ladder();
        points
            .iter_mut()
            .filter(|p| p.stepper.scheme == "pefrl")
            .for_each(|p| p.host_spread = 0.35);
        let said = sentences(&points, Machine::Host, 1e-5);
        assert!(!said[0].contains("busy"), "{}", said[0]);
        assert!(said[1].ends_with("; timed on a busy machine: times vary by 35 %"), "{}", said[1]);
        let said = sentences(&points, Machine::Target, 1e-5);
        assert!(said.iter().all(|said| !said.contains("busy")));
        // A ratio is no better known than the paper's time in it.
        let mut points = ladder();
        points[0].host_spread = 8.0;
        assert!(sentences(&points, Machine::Host, 1e-5)[1].ends_with("times vary by 800 %"));
    }

    #[test]
    fn the_least_time_decides() {
        // Three quarters of one method's measurements met other work.
        let mut points = ladder();
        points
            .iter_mut()
            .filter(|p| p.stepper.scheme == "pefrl")
            .for_each(|p| p.host_seconds *= 35.0);
        assert_eq!(
            points[choice(&points, Machine::Host, 1e-4, true).unwrap()].stepper.scheme,
            "pefrl"
        );
    }

    #[test]
    fn the_paper_is_one_stepper() {
        let mut stepper = point("dbd", 1.0, 1.0, None).stepper;
        let is = |stepper: &Stepper| is_paper(stepper, Machine::Host);
        assert!(is(&stepper));
        stepper.newton = Some(0);
        assert!(is(&stepper));
        stepper.newton = Some(1);
        assert!(!is(&stepper));
        stepper.newton = None;
        stepper.precision = "f32".into();
        assert!(!is(&stepper) && is_paper(&stepper, Machine::Target));
    }
}
