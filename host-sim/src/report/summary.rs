//! `summary.json` and its table: the settings and results of a run.
//!
//! Keys and their order are fixed. For a failed run, `steps` and `duration` state how far it
//! came, and `energy_final` and `state_hash` are those of the last row of its trace.

use dbd_plant::digits::significant;
use dbd_plant::frequencies::advised_text;
use dbd_plant::time::{display, rounded};
use dbd_scene::Scene;
use dbd_scene::parameters::Changed;
use serde::{Deserialize, Serialize};

use crate::report::golden::GoldenOutcome;
use crate::report::statistics::ReadoutFigures;
use crate::simulate::watch::{EnergyStop, EnergyWatch, Watched};
use crate::simulate::{EnergyBalance, Engagement};
use crate::terminal::SceneFile;
use crate::terminal::text::json;

/// The summary of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The scene's name.
    pub scene: String,
    /// The scheme's name.
    pub scheme: &'static str,
    /// Newton iterations per step; `None` for a scheme without any.
    pub newton: Option<u32>,
    /// ρ∞, of the scheme that has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho: Option<f64>,
    /// The damping method, if it is not the scheme's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<&'static str>,
    /// The precision's name.
    pub precision: &'static str,
    /// The representation of orientations.
    pub orientation: &'static str,
    /// The plane that a planar scene ran in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<String>,
    /// \[s\] the step.
    pub step: f64,
    /// Steps done.
    pub steps: u64,
    /// \[s\] simulated time.
    pub duration: f64,
    /// Samples: rows of the trace.
    pub samples: u64,
    /// Force evaluations performed.
    pub force_evaluations: u64,
    /// Those of a step of the method if nothing changes between steps; no key.
    #[serde(skip)]
    pub evaluations_per_step: u32,
    /// \[s\] time on the clock spent stepping.
    pub wall_seconds: f64,
    /// Time on the clock over simulated time.
    pub srt: f64,
    /// \[J\] total energy at t = 0.
    pub energy_initial: f64,
    /// \[J\] total energy of the last sample.
    pub energy_final: f64,
    /// \[W\] least-squares slope of the total energy over the samples.
    pub energy_drift_rate: f64,
    /// \[J\] RMS of E − E(0) over the samples; `None` if energy is not conserved by the scene.
    pub energy_rms_error: Option<f64>,
    /// \[m\] largest |L − L0| or |e| over samples and the joints' elements.
    pub max_joint_extension: f64,
    /// The joint of that and its time \[s\]; `None` where none opened; no key.
    #[serde(skip)]
    pub max_joint_extension_at: Option<(String, f64)>,
    /// \[Hz\] upper bound of the highest frequency at t = 0.
    pub frequency_bound_hz: f64,
    /// \[Hz\] estimate of the highest frequency at t = 0.
    pub frequency_estimate_hz: f64,
    /// \[s\] 1/ω of the bound, or less if a body rotates fast; `None` without either limit.
    pub advised_step: Option<f64>,
    /// FNV-1a 64 over the state's words, 16 hexadecimal digits; `None` without a sample.
    pub state_hash: Option<String>,
    /// The torsion springs' revolution counts in the last row, which are part of the hash but of no column.
    pub turns: Vec<i32>,
    /// FNV-1a 64 over the bytes of `trace.csv`, 16 hexadecimal digits; `None` where none was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace_hash: Option<String>,
    /// `ok`, or a sentence that names the failure.
    pub status: String,
    /// The version of host-sim that ran it.
    pub version: &'static str,
    /// The format of the trace.
    pub trace_format: u32,
    /// The whole path of the scene's file, or `built in` or `standard input`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_file: Option<String>,
    /// FNV-1a 64 of the file's text, 16 hexadecimal digits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_hash: Option<String>,
    /// The values of the file that were changed for this run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<SetValue>,
    /// Displacements that closed the joints of the scene, if it has a table `assemble`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assembled: Option<String>,
    /// Displacements that brought the scene to equilibrium, if it has `settle = true`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settled: Option<String>,
    /// The joint that opened by the largest share of its free length; `None` where none has one.
    pub widest_joint: Option<JointOpening>,
    /// The engagements of stops, ropes and contacts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub engagements: Vec<Engagement>,
    /// The energy balance of a completed run, for a scene with loads, inputs, or
    /// interactions with dampers or memories.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_balance: Option<EnergyBalance>,
    /// The watch over the energy, where there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub watch_energy: Option<EnergyWatch>,
    /// The result of the comparison with a golden run, if there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub golden: Option<GoldenOutcome>,
    /// \[Hz\] the lowest modes at t = 0, ascending, where they were asked for; negative for an unstable
    /// mode, 0 for a free one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<Vec<f64>>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Figures of the read-outs, an entry per column.
    pub readouts: Vec<ReadoutFigures>,
}

/// How far a joint opened, seen at the samples and about a thousand times over the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointOpening {
    /// The joint's name.
    pub name: String,
    /// \[m\] largest |L − L0| or |e| of its elements, less its clearance.
    pub extension: f64,
    /// \[m\] the largest free length of its elements.
    pub free_length: f64,
    /// \[s\] when.
    pub time: f64,
}

/// A value of the scene's file that was changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetValue {
    /// Its path, `body.cart.mass`.
    pub path: String,
    /// The value in the file; `None` if it has none.
    pub before: Option<String>,
    /// The value in this run.
    pub now: String,
}

impl SetValue {
    /// All that were changed of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Vec<Self> {
        let value = |changed: &Changed| {
            let Changed { path, before, now } = changed.clone();
            Self { path, before, now }
        };
        scene.changed.iter().map(value).collect()
    }

    /// The report for people.
    #[must_use]
    pub fn text(&self) -> String {
        let before = self.before.as_deref().unwrap_or("none");
        format!("{} = {} (in the file: {before})", self.path, self.now)
    }
}

impl Summary {
    /// As JSON with a final line feed.
    #[must_use]
    pub fn json(&self) -> String {
        json(self)
    }

    /// Sets the file of the scene.
    pub fn of_file(&mut self, file: Option<&SceneFile>) {
        self.scene_file = file.map(|file| file.place.clone());
        self.scene_hash = file.map(|file| file.hash.clone());
    }

    /// Records the result of the energy watch, and whether it ended the run.
    pub fn of_watch(&mut self, watch: Option<EnergyWatch>, stop: Option<EnergyStop>) {
        self.watch_energy = watch;
        if let Some(stop) = stop {
            self.status = format!("{stop}; {}", stop.advice());
        }
    }

    /// The count of force evaluations, with its reason where it is higher than the method's.
    fn evaluations(&self) -> String {
        let (count, each) = (self.force_evaluations, u64::from(self.evaluations_per_step));
        // A method that reuses the last evaluation of a step has one more, the first.
        let anew = count.saturating_sub(self.steps * each + 1);
        if anew == 0 {
            return format!("{count} ({each} per step)");
        }
        format!("{count} ({each} per step, {anew} repeated after changes of a table or a load)")
    }

    /// The largest extension with its joint and time.
    fn extension(&self) -> String {
        let extension = format!("{} m", significant(self.max_joint_extension, 4));
        match &self.max_joint_extension_at {
            Some((joint, time)) => {
                format!("{extension}, of `{joint}` at t = {}", display(rounded(*time, 6)))
            }
            None => extension,
        }
    }

    /// The report for people: names and texts with units.
    #[must_use]
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let newton = match self.newton {
            Some(1) => ", 1 Newton iteration".into(),
            Some(n) if n > 1 => format!(", {n} Newton iterations"),
            _ => String::new(),
        };
        let rho = self.rho.map(|rho| format!(", rho {rho}")).unwrap_or_default();
        let rms = match self.energy_rms_error {
            Some(error) => format!("{} J", significant(error, 4)),
            None => "– (dampers, interactions, loads or inputs change the energy)".into(),
        };
        let damping = self.damping.map(|name| format!(", {name} damping")).unwrap_or_default();
        let method = format!(
            "{}{newton}{rho}{damping}, {}, {}",
            self.scheme, self.precision, self.orientation
        );
        let plane = self.plane.as_ref().map(|plane| format!(", in the plane {plane}"));
        let method = method + &plane.unwrap_or_default();
        let frequency = format!(
            "≤ {} Hz (estimate {} Hz)",
            significant(self.frequency_bound_hz, 5),
            significant(self.frequency_estimate_hz, 5),
        );
        let wall = format!(
            "{} s, {} × simulated time",
            significant(self.wall_seconds, 3),
            significant(self.srt, 3),
        );
        let span = format!(
            "{} × {} = {}, {} samples",
            self.steps,
            display(self.step),
            display(self.duration),
            self.samples,
        );
        let advised = advised_text(self.advised_step, self.frequency_bound_hz);
        let widest = match &self.widest_joint {
            Some(JointOpening { name, extension, free_length, time }) => format!(
                "`{name}`: {} m, {} % of its free length, at t = {}",
                significant(*extension, 3),
                significant(100.0 * extension / free_length, 3),
                display(rounded(*time, 6)),
            ),
            None => "– (no joint has a free length)".into(),
        };
        let mut rows = vec![
            ("scene", self.scene.clone()),
            ("method", method),
            ("steps", span),
            ("force evaluations", self.evaluations()),
            ("wall time", wall),
            ("energy, initial", format!("{} J", significant(self.energy_initial, 10))),
            ("energy, final", format!("{} J", significant(self.energy_final, 10))),
            ("energy, drift rate", format!("{} W", significant(self.energy_drift_rate, 4))),
            ("energy, RMS error", rms),
            ("joint extension, largest", self.extension()),
            ("widest joint", widest),
            ("highest frequency", frequency),
            ("advised step", advised),
            ("state hash", self.state_hash.clone().unwrap_or_else(|| "– (no sample)".into())),
        ];
        rows.extend(
            self.energy_balance.as_ref().map(|balance| ("energy, balance", account(balance))),
        );
        if let Some(watch) = &self.watch_energy {
            let [largest, limit] =
                [watch.largest, watch.limit].map(|joules| significant(joules, 4));
            let of = match watch.watched {
                Watched::Change => "change from the start",
                Watched::Rise => "rise above the previous minimum",
                Watched::Balance => "residual of the balance",
            };
            rows.push(("energy, watched", format!("{of} ≤ {largest} J, {limit} J allowed")));
        }
        if let Some(golden) = &self.golden {
            // The message describes a difference in detail.
            let words = match &golden.failure {
                Some(_) => "the run differs",
                None => golden.words.lines().next().unwrap_or_default(),
            };
            rows.push(("golden", format!("{}: {words}", golden.file)));
        }
        let modes = self.modes.as_ref().map(|modes| ("lowest modes", frequencies(modes)));
        rows.extend(modes);
        rows.extend(self.assembled.iter().map(|moved| ("assembled", moved.clone())));
        rows.extend(self.settled.iter().map(|moved| ("settled", moved.clone())));
        rows.extend(self.readouts.iter().map(|figures| ("read-out", readout(figures))));
        rows.extend(self.engagements.iter().map(|engagement| ("engaged", engagement.words())));
        rows.extend(self.set.iter().map(|value| ("set", value.text())));
        rows.push(("status", self.status.clone()));
        rows.extend(self.warnings.iter().map(|warning| ("warning", warning.clone())));
        rows
    }
}

/// The energy balance and its residual: `loads +1.2 J, dampers −0.3 J; 2e-9 J remain`.
fn account(balance: &EnergyBalance) -> String {
    let EnergyBalance { loads, inputs, anchors, dampers, laws, remains } = *balance;
    let joules = |value: f64| significant(value, 4).replace('-', "−");
    let parts = [
        ("loads", loads),
        ("inputs", inputs),
        ("moved ground", anchors),
        ("dampers", -dampers),
        ("interactions", -laws),
    ];
    let parts = parts.into_iter().filter(|(_, value)| *value != 0.0);
    let parts = parts.map(|(name, value)| {
        format!("{name} {}{} J", if value > 0.0 { "+" } else { "" }, joules(value))
    });
    let parts: Vec<String> = parts.collect();
    let work = if parts.is_empty() { "no work".into() } else { parts.join(", ") };
    format!("{work}; {} J remain", joules(remains))
}

/// Frequencies as text, free modes counted: `5 × 0 Hz, 3.68 Hz, 12.1 Hz`.
fn frequencies(modes: &[f64]) -> String {
    let alike = modes.chunk_by(|one, other| *one == 0.0 && *other == 0.0);
    let said = alike.map(|group| match group {
        [one] => format!("{} Hz", significant(*one, 4).replace('-', "−")),
        free => format!("{} × 0 Hz", free.len()),
    });
    said.collect::<Vec<_>>().join(", ")
}

/// The figures of a read-out column for people.
fn readout(figures: &ReadoutFigures) -> String {
    let ReadoutFigures { name, unit, min, max, rms, last, time_of_max } = figures;
    let shown = |figure: &Option<f64>| figure.map_or("–".into(), |value| significant(value, 4));
    let time = time_of_max.map_or("–".into(), |time| display(rounded(time, 6)));
    format!(
        "`{name}`: {} to {} {unit}, RMS {}, at the end {}, largest at t = {time}",
        shown(min),
        shown(max),
        shown(rms),
        shown(last),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_that_nothing_holds_are_counted() {
        assert_eq!(frequencies(&[-1.0, 0.0, 0.0, 3.67891]), "−1 Hz, 2 × 0 Hz, 3.679 Hz");
        assert_eq!(frequencies(&[0.0]), "0 Hz");
    }
}
