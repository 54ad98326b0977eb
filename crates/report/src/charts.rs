//! Curves of a run, and the selection for its page.
//!
//! `(scene, mechanism) => charts and the order of their values; curves => charts`. Quantities that never moved are
//! listed as still; round-off relative to the quantity's scale is not movement. For a mechanism of many parts those
//! that move most have charts.

use std::collections::{BTreeSet, HashMap};

use crate::picture::Mechanism;
use dbd_plant::Plan;
use dbd_plant::number_format::{Digits, NumberFormat};
use dbd_scene::Scene;

use crate::curves::{Curves, Drawn, Extent, MAX_POINTS};
use crate::data::{Chart, Line, Section, Thinned};
use crate::measure::{joint_sizes, size};
use crate::packed::{F32s, F64s};

/// Values of all lines of a page: 5.4 bytes of text each.
const ROOM: usize = 75_000;
/// Lines of bodies, and of joints, that are drawn at most.
const MAX_OF_BODIES: usize = 240;
const MAX_OF_JOINTS: usize = 80;

/// Movement below this fraction of its quantity's scale is round-off, by the digits of forces.
const ROUND_OFF: [f64; 2] = [1e-6, 1e-10];
/// The same of the total energy, which is summed in double precision either way.
const ROUND_OFF_OF_ENERGY: f64 = 1e-13;

/// A chart before there are values.
#[derive(Clone, Debug)]
struct Planned {
    chart: Chart,
    /// Whether its values are differences from the first.
    deviation: bool,
    /// The least scale of its quantity.
    scale: f64,
}

/// The charts of a run, in the order of its values.
#[derive(Clone, Debug, Default)]
pub struct Charts {
    planned: Vec<Planned>,
}

/// Charts with their curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finished {
    /// \[s\] their times.
    pub times: F64s,
    /// Where they show less than was sampled.
    pub thinned: Option<Thinned>,
    /// The charts.
    pub charts: Vec<Chart>,
    /// Bodies without charts.
    pub bodies_left_out: usize,
    /// Joints without charts.
    pub joints_left_out: usize,
}

impl Charts {
    /// The charts of a scene's runs. Their values, in order: kinetic, potential and total energy \[J\];
    /// each sensor's columns; each input; each joint's largest extension \[m\] and force \[N\]; of each
    /// body that is no spider position \[m\], rotation \[rad\], speed \[m/s\] and rate \[rad/s\]; each of
    /// `others`, numbers with a name and a unit that are not the scene's.
    #[must_use]
    pub fn of(
        scene: &Scene,
        mechanism: &Mechanism,
        plan: &Plan,
        others: &[(String, String)],
    ) -> Self {
        let mut charts = Self::default();
        charts.add(Section::Energy, ["Energy", "energy", "J"], &["kinetic", "potential"]);
        let total = ["Change of the total energy", "total energy", "J"];
        charts.add(Section::Energy, total, &[""]).deviation = true;
        charts.readouts(scene);
        for input in &scene.inputs {
            let texts =
                [input.name.as_str(), quantity_of_input(input.kind, input.unit), input.unit];
            charts.add(Section::Inputs, texts, &[""]);
        }
        charts.joints(scene, mechanism);
        charts.bodies(mechanism, plan.duration);
        for (name, unit) in others {
            charts.add(Section::Readouts, [name, "recorded", unit], &[""]);
        }
        charts
    }

    fn add(&mut self, section: Section, texts: [&str; 3], names: &[&str]) -> &mut Planned {
        let [title, quantity, unit] = texts.map(str::to_owned);
        let line = |name: &&str| Line {
            name: (*name).into(),
            values: F32s::default(),
            initial: f64::NAN,
            deviation: false,
            still: false,
            low: f64::NAN,
            high: f64::NAN,
        };
        let lines = names.iter().map(line).collect();
        let chart = Chart { section, title, quantity, unit, body: None, joint: None, lines };
        self.planned.push(Planned { chart, deviation: false, scale: 0.0 });
        let last = self.planned.len() - 1;
        &mut self.planned[last]
    }

    /// A chart for each read-out; two for an inertial measurement unit, whose quantities are two.
    fn readouts(&mut self, scene: &Scene) {
        for readout in &scene.readouts {
            for columns in readout.columns.chunks(3) {
                let unit = columns.first().map_or("", |(_, unit)| unit);
                let names: Vec<&str> =
                    columns.iter().map(|(column, _)| column.trim_start_matches('.')).collect();
                let texts = [readout.name.as_str(), quantity(readout.kind, unit), unit];
                let planned = self.add(Section::Readouts, texts, &names);
                // The displacement of a point is more visible than its position.
                planned.deviation = readout.kind == "point";
            }
        }
    }

    fn joints(&mut self, scene: &Scene, mechanism: &Mechanism) {
        let sizes = joint_sizes(mechanism);
        let seconds = scene.joints.iter().map(|info| (&info.name, info.between[1].as_str()));
        let seconds: HashMap<_, _> = seconds.collect();
        for (row, joint) in mechanism.joints.iter().enumerate() {
            let second = seconds.get(&joint.name).copied().unwrap_or("its second body");
            let title = format!("{}: largest extension of its springs", joint.name);
            let planned = self.add(Section::Joints, [&title, "extension", "m"], &[""]);
            planned.chart.joint = Some(row);
            planned.scale = sizes[row];
            let title = format!("{}: force on {second}", joint.name);
            let planned = self.add(Section::Joints, [&title, "force", "N"], &[""]);
            planned.chart.joint = Some(row);
        }
    }

    fn bodies(&mut self, mechanism: &Mechanism, duration: f64) {
        let size = size(mechanism);
        for (row, body) in mechanism.bodies.iter().enumerate() {
            if mechanism.is_spider(row) {
                continue;
            }
            let axes = ["x", "y", "z"];
            let name = body.name.as_str();
            let charts: [(&str, &str, &[&str], bool, f64); 4] = [
                ("position", "m", &axes, true, size),
                ("turn", "rad", &axes, true, 1.0),
                ("speed", "m/s", &[""], false, size / duration),
                ("rate", "rad/s", &[""], false, 1.0 / duration),
            ];
            for (quantity, unit, names, deviation, scale) in charts {
                let planned = self.add(Section::Motion, [name, quantity, unit], names);
                planned.chart.body = Some(row);
                planned.deviation = deviation;
                planned.scale = scale;
            }
        }
    }

    /// Of every line in order whether it is kept as differences from its first value.
    #[must_use]
    pub fn deviations(&self) -> Vec<bool> {
        let lines = |planned: &Planned| vec![planned.deviation; planned.chart.lines.len()];
        self.planned.iter().flat_map(lines).collect()
    }

    /// The charts with the curves of their lines.
    #[must_use]
    pub fn finish(self, curves: &Curves, number_format: NumberFormat) -> Finished {
        let mut planned = self.planned;
        let first = |row: &mut usize, planned: &Planned| {
            let first = *row;
            *row += planned.chart.lines.len();
            Some(first)
        };
        let rows: Vec<usize> = planned.iter().scan(0, first).collect();
        let scales = scales(&planned, &rows, curves.extents());
        let digits = if number_format.velocity == Digits::Single { 0 } else { 1 };
        for ((planned, row), scale) in planned.iter_mut().zip(&rows).zip(scales) {
            let total = planned.chart.section == Section::Energy && planned.deviation;
            let share = if total { ROUND_OFF_OF_ENERGY } else { ROUND_OFF[digits] };
            for (at, line) in planned.chart.lines.iter_mut().enumerate() {
                let extent = curves.extents()[row + at];
                line.initial = extent.initial;
                line.deviation = planned.deviation;
                (line.low, line.high) = (extent.low, extent.high);
                line.still = extent.range() <= share * scale;
            }
        }
        let left_out = [
            left_out(&planned, |chart| chart.body, MAX_OF_BODIES),
            left_out(&planned, |chart| chart.joint, MAX_OF_JOINTS),
        ];
        let mut charts: Vec<(Chart, usize)> = Vec::new();
        for (Planned { chart, .. }, row) in planned.into_iter().zip(rows) {
            let out = |part: Option<usize>, left: &BTreeSet<usize>| {
                part.is_some_and(|part| left.contains(&part))
            };
            if !out(chart.body, &left_out[0]) && !out(chart.joint, &left_out[1]) {
                charts.push((chart, row));
            }
        }
        let moving = |(chart, row): &(Chart, usize)| {
            let lines = chart.lines.iter().enumerate().filter(|(_, line)| !line.still);
            lines.map(|(at, _)| row + at).collect::<Vec<_>>()
        };
        let chosen: Vec<usize> = charts.iter().flat_map(moving).collect();
        let points = (ROOM / chosen.len().max(1)).min(MAX_POINTS);
        let Drawn { times, lines } = curves.drawn(&chosen, points);
        let mut charts: Vec<Chart> = charts.into_iter().map(|(chart, _)| chart).collect();
        let places = charts.iter_mut().flat_map(|chart| &mut chart.lines);
        for (line, values) in places.filter(|line| !line.still).zip(lines) {
            line.values = F32s(values);
        }
        charts.sort_by_key(|chart| chart.section);
        let samples = curves.samples();
        let thinned = Thinned { samples, points: times.len() };
        Finished {
            thinned: (samples > times.len() as u64).then_some(thinned),
            times: F64s(times),
            charts,
            bodies_left_out: left_out[0].len(),
            joints_left_out: left_out[1].len(),
        }
    }
}

/// The scale of each chart's quantity: the largest value of all charts of the same one.
fn scales(planned: &[Planned], rows: &[usize], extents: &[Extent]) -> Vec<f64> {
    let largest = |planned: &Planned, row: usize| {
        let lines = &extents[row..row + planned.chart.lines.len()];
        let values = lines.iter().flat_map(|extent| match planned.deviation {
            true => [extent.initial, extent.initial + extent.low, extent.initial + extent.high],
            false => [extent.initial, extent.low, extent.high],
        });
        let finite = values.filter(|value| value.is_finite());
        finite.fold(planned.scale, |most, value| most.max(value.abs()))
    };
    let quantity = |planned: &Planned| {
        let Chart { section, quantity, unit, .. } = &planned.chart;
        // The total energy and its parts are one quantity.
        let quantity = if *section == Section::Energy { "" } else { quantity.as_str() };
        (*section, quantity.to_owned(), unit.clone())
    };
    let mut of = std::collections::BTreeMap::new();
    for (planned, row) in planned.iter().zip(rows) {
        let most = of.entry(quantity(planned)).or_insert(0.0_f64);
        *most = most.max(largest(planned, *row));
    }
    planned.iter().map(|planned| of[&quantity(planned)]).collect()
}

/// The parts that move least, where the lines of all are too many.
fn left_out(
    planned: &[Planned],
    part: impl Fn(&Chart) -> Option<usize>,
    most: usize,
) -> BTreeSet<usize> {
    // Per part its moving lines, and its movement in the first of its quantities that moves.
    let mut parts: std::collections::BTreeMap<usize, (usize, f64)> = Default::default();
    for Planned { chart, scale, .. } in planned {
        let Some(part) = part(chart) else { continue };
        let (lines, movement) = parts.entry(part).or_default();
        for line in chart.lines.iter().filter(|line| !line.still) {
            *lines += 1;
            // Ranked by a joint's extension, and a body's displacement and rotation.
            if *scale > 0.0 && chart.unit != "m/s" && chart.unit != "rad/s" {
                *movement = movement.max((line.high - line.low) / scale);
            }
        }
    }
    let mut order: Vec<(usize, (usize, f64))> = parts.into_iter().collect();
    order.sort_by(|a, b| b.1.1.total_cmp(&a.1.1).then(a.0.cmp(&b.0)));
    let mut lines = 0;
    let beyond = |(_, (own, _)): &(usize, (usize, f64))| {
        // A still one also takes space.
        lines += (*own).max(1);
        lines > most
    };
    let first = order.iter().position(beyond).unwrap_or(order.len());
    order[first..].iter().map(|(part, _)| *part).collect()
}

/// Quantity of a sensor type.
fn quantity(kind: &str, unit: &str) -> &'static str {
    match (kind, unit) {
        ("joint_angle", _) => "angle",
        ("joint_rate" | "joint_travel_rate", _) | ("imu", "rad/s") => "rate",
        ("joint_travel", _) => "travel",
        ("point", _) => "position",
        ("point_velocity", _) => "velocity",
        ("tsda_force", _) => "tension",
        ("joint_force", _) => "force",
        ("imu", _) => "specific force",
        ("interaction", _) => quantity_of_unit(unit),
        _ => "input",
    }
}

/// Quantity of a unit.
fn quantity_of_unit(unit: &str) -> &'static str {
    match unit {
        "N·m" => "torque",
        "N" => "force",
        "rad" => "angle",
        "m" => "distance",
        "rad/s" | "m/s" => "rate",
        "V" => "voltage",
        "A" => "current",
        _ => "value",
    }
}

/// Quantity of an input type.
fn quantity_of_input(kind: &str, unit: &str) -> &'static str {
    match kind {
        "torque" | "joint_torque" => "torque",
        "actuator" => "tension",
        "gravity" => "gravity",
        "velocity" | "angular_velocity" => "rate",
        "anchor" => "shift",
        "drive" | "signal" | "free_length" => quantity_of_unit(unit),
        _ => "force",
    }
}
