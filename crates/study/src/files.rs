//! Results of a study: `trade.csv`, the charts, the page.
//!
//! `study => files in a folder`. Each appears when it is complete.

use std::io;
use std::path::Path;

use dbd_plant::digits::{approximate, significant};
use dbd_plant::time::{display, rounded};
use dbd_report::output::set::FileSet;
use dbd_scene::Scene;
use dbd_scene::default_step::LARGEST_TURN;
use serde::Serialize;

use crate::advice::{Advice, advice, remark};
use crate::cache::Head;
use crate::chart::{Chart, svg};
use crate::command::Command;
use crate::front_table::table as table_of;
use crate::page::html;
use crate::point::{Machine, Point, front};
use crate::precisions::of_precisions;
use crate::stability::MARGIN;
use crate::survey::Trade;
use crate::timing::{CALM, ROUNDS};
use crate::variants::{Compared, SPATIAL};
use crate::variants_table::{TITLE, meaning, text as variants_text};
use crate::words::{capital, percent};

/// Columns of `trade.csv`.
pub const COLUMNS: [&str; 24] = [
    "scheme",
    "newton",
    "damping",
    "precision",
    "orientation",
    "kernel",
    "step",
    "steps",
    "stable",
    "error",
    "energy_rms",
    "energy_peak",
    "evaluations_per_second",
    "host_seconds_per_second",
    "host_spread",
    "target_instructions_per_second",
    "host_front",
    "target_front",
    "lost",
    "advisable",
    "host_seconds_least_per_second",
    "order",
    "finest_step",
    "stable_step_in_space",
];

/// \[1/s\] instructions of a Cortex-M4F at 168 MHz, 1.5 cycles each: an estimate, see docs/target.md.
const REAL_TIME: f64 = 168e6 / 1.5;

/// Text for a terminal, in pieces.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A sentence, which a narrow terminal breaks; without its line feed.
    Sentence(String),
    /// Lines to be left as they are: tables, command lines.
    Lines(String),
}

/// A survey to be reported.
#[derive(Clone, Copy)]
pub struct Report<'r> {
    /// The scene.
    pub scene: &'r Scene,
    /// Its name for the user.
    pub called: &'r str,
    /// The survey.
    pub trade: &'r Trade,
}

/// A survey as JSON.
#[derive(Serialize)]
pub struct Json<'r> {
    scene: &'r str,
    /// \[s\].
    window: f64,
    samples: u32,
    /// \[s\] the requested period that every step divides.
    period: Option<f64>,
    /// Of a perturbation at the window's end.
    growth: f64,
    /// \[m\] uncertainty of the reference solution.
    uncertainty: f64,
    /// Advice for this machine.
    advice: Vec<Advised>,
    points: &'r [Point],
    /// The scene and its variants.
    variants: &'r [Compared],
}

/// Choice for an accuracy, and its command line.
#[derive(Serialize)]
struct Advised {
    sentence: String,
    command: String,
}

/// The chart of the target, where steps were counted.
const TARGET: &str = "trade-cortex-m4f.svg";

impl<'r> Report<'r> {
    /// Writes all files into a folder.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let mut files = FileSet::new(folder);
        self.add_to(&mut files)?;
        files.finish()?.publish()
    }

    /// Writes all files and adds them to others. Removes an old chart of the target if there is no new one.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn add_to(&self, files: &mut FileSet) -> io::Result<()> {
        let Self { scene, called, trade } = *self;
        table(files, &trade.points)?;
        let conditions = conditions(trade);
        let chart = Chart {
            scene: &scene.name,
            description: &scene.description,
            window: trade.head.window(),
            uncertainty: trade.head.uncertainty,
            points: &trade.points,
            command: Command::new(scene, called),
            real_time_instructions: REAL_TIME,
            conditions: &conditions,
            variants: &trade.variants,
        };
        files.write("trade.svg", &svg(&chart, Machine::Host))?;
        if trade.points.iter().any(|point| point.target_instructions.is_some()) {
            files.write(TARGET, &svg(&chart, Machine::Target))?;
        } else {
            files.without(TARGET);
        }
        files.write("trade.html", &html(&chart))
    }

    /// Text for a terminal: for both machines the Pareto front, the choices and their command lines.
    #[must_use]
    pub fn pieces(&self) -> Vec<Piece> {
        let Self { scene, called, trade } = *self;
        let mut pieces = vec![Piece::Lines(format!("{}\n", scene.name))];
        let sentences = |lines: Vec<String>| lines.into_iter().map(Piece::Sentence);
        pieces.extend(sentences(conditions(trade)));
        let command = Command::new(scene, called);
        let points = &trade.points;
        for (machine, name) in
            [(Machine::Host, "one core of this machine"), (Machine::Target, "Cortex-M4F")]
        {
            if points.iter().all(|point| point.cost(machine).is_none()) {
                continue;
            }
            let table = table_of(points, machine);
            pieces.push(Piece::Lines(format!("\n{name}: Pareto front\n{table}\n")));
            pieces.extend(remark(points, machine).map(|remark| Piece::Sentence(remark.into())));
            for advice in advice(points, machine, trade.head.uncertainty) {
                pieces.push(Piece::Sentence(advice.sentence));
                let line = command.line(&points[advice.row]);
                pieces.extend(line.map(|line| Piece::Lines(format!("    {line}\n"))));
            }
            if machine == Machine::Target
                && let Some(sentence) = of_precisions(points, trade.head.uncertainty)
            {
                pieces.push(Piece::Sentence(sentence));
            }
        }
        if !trade.variants.is_empty() {
            let table = variants_text(&trade.variants);
            pieces.push(Piece::Lines(format!("\n{TITLE}\n{table}")));
            let meaning = meaning(&trade.variants).into_iter().map(str::to_owned);
            pieces.extend(sentences(meaning.collect()));
        }
        pieces
    }

    /// Output for programs.
    #[must_use]
    pub fn json(&self) -> Json<'r> {
        let Head { grid, growth, uncertainty, .. } = self.trade.head;
        let (scene, points) = (self.scene.name.as_str(), self.trade.points.as_slice());
        let (window, samples, period) = (grid.window(), grid.samples, self.trade.period);
        let command = Command::new(self.scene, self.called);
        let advised = |advice: Advice| {
            let command = command.line(&points[advice.row]).unwrap_or_default();
            Advised { sentence: capital(&advice.sentence), command }
        };
        let advice = advice(points, Machine::Host, uncertainty).into_iter().map(advised).collect();
        let variants = self.trade.variants.as_slice();
        Json { scene, window, samples, period, growth, uncertainty, advice, points, variants }
    }
}

/// Conditions of the measurements.
fn conditions(trade: &Trade) -> Vec<String> {
    let Head { grid, growth, uncertainty, .. } = trade.head;
    let widest = trade.points.iter().map(|point| point.host_spread).fold(0.0, f64::max);
    let spread = match widest > CALM {
        true => format!("this machine was busy: times vary by up to {}", percent(widest)),
        false => format!("they vary by {} at most", percent(widest)),
    };
    let build =
        if cfg!(debug_assertions) { "a debug build: times are not meaningful" } else { "release" };
    let mut lines = vec![
        format!(
            "compared over {}, during which a perturbation grows by a factor of {}; the reference \
             solution is accurate to {:.0e} m",
            display(rounded(grid.window(), 12)),
            significant(growth, 2),
            uncertainty,
        ),
        format!(
            "error: root mean square, over bodies and {} samples, of the distance from DOP853 at \
             1e-12; a body's distance combines that of its centre of mass and, at right angles, the \
             angle between the attitudes times the root mean square distance of its mass from its \
             centre of mass",
            grid.samples,
        ),
        "a step counts as unstable if it exceeds the largest stable step about the pose at t = 0, with \
         dampers and motion out of the plane included (check --stability), or if the run fails; it \
         counts as lost if its error exceeds the displacement of the reference solution: its error is \
         shown, but it is not advised"
            .into(),
        format!(
            "advised steps are {} below the largest stable one, because frequencies change along a \
             motion, rotate no body by more than {LARGEST_TURN} rad, and respect the bound of the \
             frequency",
            percent(MARGIN),
        ),
        format!(
            "times: minimum of {ROUNDS} or more rounds in which the methods alternate on one thread, {}, \
             {}, {build}; {spread}; one step size of each method is timed and represents all its steps",
            std::env::consts::ARCH,
            std::env::consts::OS,
        ),
        format!(
            "Cortex-M4F: instructions per step {}; real time assumes 168 MHz and 1.5 cycles per instruction",
            match trade.estimated {
                true => {
                    "estimated from bodies and elements, within 10 % of the counted number for \
                     leapfrog in f32; `cargo cost` of a new firmware project counts them"
                }
                false => "counted in QEMU (docs/costs.csv)",
            },
        ),
    ];
    lines.extend(trade.period.map(|period| format!("every step divides {}", display(period))));
    lines.extend(of_plane(&trade.variants));
    lines
}

/// Of which model the steps of a planar scene are.
fn of_plane(variants: &[Compared]) -> Option<String> {
    let own = variants.first().filter(|own| own.planar)?;
    let spatial = variants.iter().find(|one| one.name == SPATIAL)?;
    let steps = [spatial, own].map(|one| one.stable_step.map_or("any".into(), approximate));
    let [space, plane] = steps;
    Some(format!(
        "the scene is planar: stability, advice and times are those of its model in the plane; in \
         space it may leave the plane; leapfrog is stable up to {space} in space, up to {plane} in the \
         plane"
    ))
}

fn table(files: &mut FileSet, points: &[Point]) -> io::Result<()> {
    let mut rows = csv::Writer::from_writer(files.begin("trade.csv")?);
    rows.write_record(COLUMNS)?;
    let fronts = [Machine::Host, Machine::Target].map(|machine| front(points, machine));
    let number = |value: Option<f64>| value.map(|value| format!("{value:?}")).unwrap_or_default();
    for (row, point) in points.iter().enumerate() {
        let stepper = &point.stepper;
        let newton = stepper.newton.map(|n| n.to_string()).unwrap_or_default();
        rows.write_record([
            stepper.scheme.as_str(),
            &newton,
            stepper.damping.as_deref().unwrap_or_default(),
            &stepper.precision,
            &stepper.orientation,
            &stepper.kernel.to_string(),
            &format!("{:?}", point.step),
            &point.steps.to_string(),
            &point.stable.to_string(),
            &number(point.error),
            &number(point.energy_rms),
            &number(point.energy_peak),
            &format!("{:?}", point.evaluations),
            &format!("{:?}", point.host_seconds),
            &format!("{:?}", point.host_spread),
            &number(point.target_instructions),
            &fronts[0].contains(&row).to_string(),
            &fronts[1].contains(&row).to_string(),
            &point.lost.to_string(),
            &point.advisable.to_string(),
            &format!("{:?}", point.host_seconds_least),
            &number(point.fall.order),
            &number(point.fall.finest),
            &number(point.step_in_space),
        ])?;
    }
    let file = rows.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    files.add(file);
    Ok(())
}
