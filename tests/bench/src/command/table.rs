//! What a bench came to, as people read it.

use dbd_plant::digits::significant;
use dbd_study::timing::CALM;

use host_sim::terminal::Look;
use host_sim::terminal::look::HEAD;

use super::outcome::Outcome;
use super::turns::Figure;
use super::ways::{Other, Row};

const COLUMNS: [&str; 10] =
    ["system", "bodies", "TSDAs", "least", "median", "±%", "f32", "std", "plain", "bound"];

impl Outcome {
    /// Tables that fit a terminal.
    #[must_use]
    pub fn text(&self, look: Look) -> String {
        let lines: Vec<[String; 10]> = self.systems.iter().map(line).collect();
        let mut text = look.columns(Some(COLUMNS), &lines) + "\n";
        text += &look.table(&[
            ("least, median, ±%", "ns per step of the kernel in f64, half the range of the middle half of the rounds".to_owned()),
            ("f32, std, plain", "time over that of f64, round by round, the median: the kernel in f32; the std reference (Vec, nalgebra, Box<dyn Element>); a plain loop over the same elements".to_owned()),
            ("bound", "time of f64 over that of its flops, two in a cycle of the clock".to_owned()),
        ]);
        text += &self.together(look);
        text += &self.fitted(look);
        text += &self.aimed_at(look);
        text
    }

    fn together(&self, look: Look) -> String {
        let Some(first) = self.ensembles.first() else { return String::new() };
        let lines: Vec<[String; 8]> = self
            .ensembles
            .iter()
            .map(|ensemble| {
                [
                    ensemble.precision.to_owned(),
                    ensemble.instructions.to_owned(),
                    ensemble.threads.to_string(),
                    ensemble.instances.to_string(),
                    cell(ensemble.over_alone.map(|ratio| ratio.median), 2),
                    cell(ensemble.over_alone.map(|ratio| 100.0 * ratio.spread), 0),
                    cell(ensemble.over_one_thread, 2),
                    cell(ensemble.alone_over_one_thread, 2),
                ]
            })
            .collect();
        let head = [
            "numbers",
            "instructions",
            "threads",
            "instances",
            "faster",
            "±%",
            "over one thread",
            "one by one",
        ];
        let title =
            format!("\nensembles of {}, beside the same instances one by one\n", first.name);
        let reported = look.table(&[
            ("over one thread", "what threads bring the ensemble, the median of the rounds' ratios".to_owned()),
            ("one by one", "what they bring the instances by themselves, which share nothing: less where the cores have other work".to_owned()),
        ]);
        title + &look.columns(Some(head), &lines) + "\n" + &reported
    }

    fn fitted(&self, look: Look) -> String {
        let Some(fit) = &self.fit else { return String::new() };
        let cells = fit.parts.iter().map(|part| {
            let ns = |seconds: f64| significant(seconds * 1e9, 3);
            [format!("per {}", part.of), ns(part.time_s), ns(part.error_s)]
        });
        let lines: Vec<[String; 3]> = cells.collect();
        let head = Some(["fitted", "ns", "± ns"]);
        let left = format!("relative errors of {:.1} % are left\n", 100.0 * fit.residual);
        format!("\n{}{left}", look.columns(head, &lines))
    }

    fn aimed_at(&self, look: Look) -> String {
        let goals: Vec<(String, String)> =
            self.goals.iter().map(|goal| (goal.what.clone(), goal.text())).collect();
        let mut text = String::new();
        if !goals.is_empty() {
            text = format!("\n{}{}", look.paint(HEAD, "goals\n"), look.table(&goals));
        }
        let warnings: Vec<(&str, String)> =
            self.warnings().into_iter().map(|warning| ("warning", warning)).collect();
        if !warnings.is_empty() {
            text += &format!("\n{}", look.table(&warnings));
        }
        text
    }

    /// What makes figures doubtful.
    fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.checked {
            let text = "this program checks its arithmetic, which takes time: cargo run --release does not";
            warnings.push(text.to_owned());
        }
        if self.largest_spread > CALM {
            warnings.push(format!(
                "times scatter by up to {:.0} %: other work on this machine; ratios bear it, the least times hardly, \
                 all else does not",
                100.0 * self.largest_spread
            ));
        }
        warnings
    }
}

fn line(row: &Row) -> [String; 10] {
    let size = &row.size;
    let ns = |pick: fn(&Figure) -> f64| cell(row.f64_s.map(|time| pick(&time) * 1e9), 0);
    [
        size.name.clone(),
        size.bodies.to_string(),
        size.tsdas.to_string(),
        ns(|time| time.least),
        ns(|time| time.median),
        cell(row.f64_s.map(|time| 100.0 * time.spread), 0),
        over(&row.f32),
        over(&row.std),
        over(&row.plain),
        cell(row.over_flop_bound.map(|ratio| ratio.median), 2),
    ]
}

fn over(other: &Other) -> String {
    cell(other.over_kernel.map(|ratio| ratio.median), 2)
}

/// A number with so many decimals, or that there is none.
fn cell(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.decimals$}"))
}
