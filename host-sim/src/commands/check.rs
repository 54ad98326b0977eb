//! `host-sim check`: properties of a scene, without running it.
//!
//! `scene => counts, degrees of freedom, constraints and assembly error per joint, highest
//! frequency, warnings, notes`. Warnings report probable mistakes; they do not
//! change the exit code.

use dbd_kernel::BodyIndex;
use dbd_plant::digits::significant;
use dbd_plant::frequencies::advised_text;
use dbd_plant::time::{display, rounded};
use std::f64::consts::TAU;

use dbd_plant::{DampingName, Frequencies, Method, PrecisionName};
use dbd_scene::single::slow_start;
use dbd_scene::{
    InputInfo, InteractionInfo, JointFacts, JointInfo, ReadoutInfo, Realisation, Scene,
};
use dbd_study::costs::Costs;
use dbd_study::estimate::instructions;
use serde::Serialize;

use crate::commands::assembled::{AssembledCheck, SettledCheck};
use crate::commands::derived::{DerivedCheck, derived, lines as derived_lines};
use crate::commands::planar::PlaneCheck;
use crate::commands::rounding::of_noise;
use crate::commands::stability::StabilityCheck;
use crate::commands::warnings::{of_step, with_notes};
use crate::terminal::Look;

/// Properties of a scene before it runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Its name.
    pub scene: String,
    /// Bodies.
    pub bodies: usize,
    /// TSDAs.
    pub tsdas: usize,
    /// Torsion springs.
    pub torsion_springs: usize,
    /// The interactions: label, law, bodies, dampers.
    pub interactions: Vec<InteractionCheck>,
    /// Loads.
    pub loads: usize,
    /// The inputs: name, type, unit and whether a table drives it.
    pub inputs: Vec<InputCheck>,
    /// The read-outs: name, type and units of their columns.
    pub readouts: Vec<ReadoutCheck>,
    /// The joints.
    pub joints: Vec<JointCheck>,
    /// Bodies given by links, shapes or tensors with products of inertia, with the derived values.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub derived: Vec<DerivedCheck>,
    /// Freedoms that the joints leave: constraints that loops imply count once, motions that exist to
    /// first order only do not count. `None` where too many bodies hang together.
    pub freedoms_by_rank: Option<usize>,
    /// 6 per body less the rank of the constraints at t = 0; more where that pose is singular.
    pub first_order_freedoms: Option<usize>,
    /// Equations of motion: 6 per body.
    pub equations: usize,
    /// Equations of a solver with constraints (Franco & Degani 2026, Table 7a).
    pub constraint_equations: usize,
    /// The plane of the scene, or the elements outside it.
    pub plane: PlaneCheck,
    /// Groups of bodies that nothing connects with each other.
    pub islands: usize,
    /// \[m\] the largest assembly error of a joint.
    pub assembly_error: f64,
    /// Displacements that closed the joints, if the scene has a table `assemble`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assembled: Option<AssembledCheck>,
    /// Displacements that brought it to equilibrium, if it has `settle = true`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settled: Option<SettledCheck>,
    /// \[Hz\] upper bound of the highest frequency at t = 0.
    pub frequency_bound_hz: f64,
    /// \[Hz\] estimate of the highest frequency at t = 0.
    pub frequency_estimate_hz: f64,
    /// The element with the highest natural frequency; `None` without elements.
    pub fastest_element: Option<FastestElement>,
    /// \[s\] 1/ω of the bound, or less if a body rotates fast; `None` without either limit.
    pub advised_step: Option<f64>,
    /// \[s\] the scene's own step, where it gives one.
    pub step: Option<f64>,
    /// Estimated cost of a step of leapfrog in f32 on Cortex-M4F, from bodies and elements.
    pub estimated_instructions: Option<EstimateCheck>,
    /// The largest stable step of a method, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability: Option<StabilityCheck>,
    /// Warnings of probable mistakes.
    pub warnings: Vec<String>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Estimated instructions of a step on Cortex-M4F.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EstimateCheck {
    /// With the scheme's own damping method.
    pub sweeps: f64,
    /// With joint-wise damping.
    pub joint_wise: f64,
}

impl EstimateCheck {
    fn of(scene: &Scene) -> Option<Self> {
        let costs = Costs::shipped();
        let leapfrog = Method::default().with_precision(PrecisionName::F32);
        let joint_wise = leapfrog.with_damping(DampingName::JointWise).ok()?;
        Some(Self {
            sweeps: instructions(scene, &leapfrog, &costs)?,
            joint_wise: instructions(scene, &joint_wise, &costs)?,
        })
    }

    fn text(&self) -> String {
        let [own, joint_wise] =
            [self.sweeps, self.joint_wise].map(|count| significant(rounded(count, 2), 2));
        let damped = match own == joint_wise {
            true => String::new(),
            false => format!(", {joint_wise} with joint-wise damping"),
        };
        format!("about {own} instructions per step of leapfrog in f32{damped}, estimated")
    }
}

/// The element with the highest natural frequency.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FastestElement {
    /// Its name in messages.
    pub name: String,
    /// \[Hz\] alone between its two bodies.
    pub frequency_hz: f64,
    /// That over the median of the joints, or of all elements where there are no joints.
    pub over_median: Option<f64>,
}

/// Properties of a joint before the scene runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointCheck {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// Its elements if they are not TSDAs: `bushing`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub realisation: Option<&'static str>,
    /// Its bodies.
    pub between: [String; 2],
    /// Degrees of freedom that it constrains.
    pub holds: u32,
    /// Its TSDAs.
    pub tsdas: usize,
    /// \[m\] free length of its elements.
    pub free_length: f64,
    /// \[m\] the shortest and the longest of its elements at t = 0.
    pub initial_length: [f64; 2],
    /// \[m\] the largest |L − L0| at t = 0.
    pub assembly_error: f64,
    /// \[m/s\] the largest rate of a TSDA's length at t = 0, from the bodies' velocities.
    pub stretching_rate: f64,
}

/// Properties of an interaction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InteractionCheck {
    /// Its name, or its name in messages: ``interaction 1 (world–bar)``.
    pub name: String,
    /// Its law.
    pub law: &'static str,
    /// Its bodies: two, of a coupling more.
    pub between: Vec<String>,
    /// Its dampers; some may have a coefficient of 0.
    pub dampers: usize,
}

impl InteractionCheck {
    fn of(interaction: &InteractionInfo, scene: &Scene) -> Self {
        let body = |index: BodyIndex| match index.is_world() {
            true => "world".to_owned(),
            false => scene.body_names[index.row()].clone(),
        };
        let InteractionInfo { law, bodies, dampers, .. } = *interaction;
        let bodies = bodies.iter().chain(&interaction.further);
        let name = interaction.name().unwrap_or(&interaction.label).to_owned();
        Self { name, law, between: bodies.copied().map(body).collect(), dampers }
    }
}

/// Properties of an input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputCheck {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// The unit of its value.
    pub unit: &'static str,
    /// Whether a table of the scene drives it.
    pub table: bool,
}

/// Properties of a read-out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReadoutCheck {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// Its columns in the trace.
    pub columns: Vec<String>,
    /// Their units.
    pub units: Vec<&'static str>,
}

impl InputCheck {
    fn of(input: &InputInfo) -> Self {
        let InputInfo { name, kind, unit, table, .. } = input;
        Self { name: name.clone(), kind, unit, table: *table }
    }
}

impl ReadoutCheck {
    fn of(readout: &ReadoutInfo) -> Self {
        let ReadoutInfo { name, kind, columns, .. } = readout;
        Self {
            name: name.clone(),
            kind,
            columns: columns.iter().map(|(column, _)| format!("{name}{column}")).collect(),
            units: columns.iter().map(|(_, unit)| *unit).collect(),
        }
    }
}

/// Checks a scene.
#[must_use]
pub fn check(scene: &Scene) -> Check {
    let model = &scene.model;
    let frequencies = Frequencies::of(scene);
    let facts = dbd_scene::facts(scene);
    let made_of = |joint: &JointInfo| match joint.realisation {
        Realisation::Tsda => None,
        other => Some(other.name()),
    };
    let joint = |(joint, facts): (&JointInfo, &JointFacts)| JointCheck {
        name: joint.name.clone(),
        kind: joint.kind,
        realisation: made_of(joint),
        between: joint.between.clone(),
        holds: joint.holds,
        tsdas: joint.tsdas,
        free_length: facts.free_length,
        initial_length: facts.initial_length,
        assembly_error: facts.assembly_error,
        stretching_rate: facts.stretching_rate,
    };
    let joints: Vec<JointCheck> = scene.joints.iter().zip(&facts.joints).map(joint).collect();
    let fastest = facts.fastest().filter(|element| element.frequency > 0.0);
    let mut check = Check {
        fastest_element: fastest.map(|element| FastestElement {
            name: element.name.clone(),
            frequency_hz: element.frequency / TAU,
            over_median: facts.median_frequency().map(|median| element.frequency / median),
        }),
        scene: scene.name.clone(),
        bodies: model.bodies.len(),
        tsdas: model.tsda_count(),
        torsion_springs: scene.torsion_springs(),
        interactions: dbd_scene::interactions(scene)
            .iter()
            .map(|interaction| InteractionCheck::of(interaction, scene))
            .collect(),
        loads: model.loads.len(),
        inputs: scene.inputs.iter().map(InputCheck::of).collect(),
        readouts: scene.readouts.iter().map(ReadoutCheck::of).collect(),
        derived: derived(scene),
        freedoms_by_rank: facts.freedoms,
        first_order_freedoms: facts.first_order_freedoms,
        equations: facts.equations,
        constraint_equations: facts.constraint_equations,
        plane: PlaneCheck::of(scene),
        islands: facts.islands.len(),
        assembly_error: joints.iter().map(|joint| joint.assembly_error).fold(0.0, f64::max),
        joints,
        assembled: AssembledCheck::of(scene),
        settled: SettledCheck::of(scene),
        frequency_bound_hz: frequencies.bound_hz(),
        frequency_estimate_hz: frequencies.estimate_hz(),
        advised_step: frequencies.advised_step(),
        step: scene.step,
        estimated_instructions: EstimateCheck::of(scene),
        stability: None,
        warnings: Vec::new(),
        notes: Vec::new(),
    };
    if let Some(step) = scene.step {
        let method = Method::default();
        check.warnings = of_step(scene, &frequencies, &method, step, "the scene's step");
    }
    let [warnings, notes] = with_notes(scene, &facts);
    check.warnings.extend(warnings);
    check.notes.extend(notes);
    let single = Method::default().with_precision(PrecisionName::F32);
    if let Some(step) = scene.step.or(check.advised_step) {
        let slow = slow_start(scene, step, "in f32 the step");
        check.notes.extend(slow);
    }
    check.notes.extend(of_noise(scene, &single, None).map(|noise| format!("in f32 {noise}")));
    check
}

impl Check {
    /// The report for people.
    #[must_use]
    pub fn text(&self, look: Look) -> String {
        let advised = advised_text(self.advised_step, self.frequency_bound_hz);
        let step = self.step.map_or_else(|| "– (the advised step is used)".into(), display);
        let fastest = match &self.fastest_element {
            Some(FastestElement { name, frequency_hz, over_median }) => {
                let median = over_median
                    .map(|ratio| format!(", {} times the median", significant(ratio, 3)));
                format!(
                    "{name}: {} Hz alone{}",
                    significant(*frequency_hz, 4),
                    median.unwrap_or_default()
                )
            }
            None => "– (nothing vibrates)".into(),
        };
        let freedoms = match [self.freedoms_by_rank, self.first_order_freedoms] {
            [Some(all), Some(first)] if all != first => {
                format!("{all}; {first} to first order, because the pose is singular")
            }
            [all, _] => all.map_or_else(|| "– (too many bodies)".into(), |all| all.to_string()),
        };
        let mut rows = vec![
            ("scene", self.scene.clone()),
            ("bodies", self.bodies.to_string()),
            ("joints", self.joints.len().to_string()),
            ("TSDAs", self.tsdas.to_string()),
            ("torsion springs", self.torsion_springs.to_string()),
            ("interactions", self.interactions.len().to_string()),
            ("loads", self.loads.to_string()),
            ("inputs", self.inputs.len().to_string()),
            ("read-outs", self.readouts.len().to_string()),
            ("degrees of freedom", freedoms),
            (
                "equations",
                format!("{}; {} with constraints", self.equations, self.constraint_equations),
            ),
            ("plane", self.plane.text()),
            ("islands", self.islands.to_string()),
            ("assembly error", format!("{} m", significant(self.assembly_error, 3))),
            (
                "highest frequency",
                format!(
                    "≤ {} Hz (estimate {} Hz)",
                    significant(self.frequency_bound_hz, 5),
                    significant(self.frequency_estimate_hz, 5)
                ),
            ),
            ("fastest element", fastest),
            ("advised step", advised),
            ("step of the scene", step),
        ];
        let estimate = self.estimated_instructions.as_ref().map(EstimateCheck::text);
        rows.extend(estimate.map(|text| ("Cortex-M4F", text)));
        rows.extend(self.assembled.iter().flat_map(AssembledCheck::rows));
        rows.extend(self.settled.iter().map(|settled| ("settled", settled.sentence())));
        rows.extend(self.stability.iter().flat_map(StabilityCheck::rows));
        rows.extend(self.warnings.iter().map(|warning| ("warning", warning.clone())));
        rows.extend(self.notes.iter().map(|note| ("note", note.clone())));
        let mut text = look.table(&rows);
        if !self.joints.is_empty() {
            text.push('\n');
            text.push_str(&self.joint_lines(look));
        }
        if !self.interactions.is_empty() {
            text.push('\n');
            text.push_str(&self.interaction_lines(look));
        }
        if !self.derived.is_empty() {
            text.push('\n');
            text.push_str(&derived_lines(&self.derived, look));
        }
        if !(self.inputs.is_empty() && self.readouts.is_empty()) {
            text.push('\n');
            text.push_str(&self.signal_lines(look));
        }
        text
    }

    fn joint_lines(&self, look: Look) -> String {
        let head = [
            "joint",
            "type",
            "between",
            "holds",
            "TSDAs",
            "L0 [m]",
            "L(0) [m]",
            "error [m]",
            "rate [m/s]",
        ];
        let line = |joint: &JointCheck| {
            [
                joint.name.clone(),
                match joint.realisation {
                    Some(made_of) => format!("{}, {made_of}", joint.kind),
                    None => joint.kind.into(),
                },
                joint.between.join("–"),
                joint.holds.to_string(),
                joint.tsdas.to_string(),
                significant(joint.free_length, 5),
                lengths(joint.initial_length),
                significant(joint.assembly_error, 3),
                significant(joint.stretching_rate, 3),
            ]
        };
        look.columns(Some(head), &self.joints.iter().map(line).collect::<Vec<_>>())
    }

    fn interaction_lines(&self, look: Look) -> String {
        let line = |interaction: &InteractionCheck| {
            let InteractionCheck { name, law, between, dampers } = interaction;
            [name.clone(), (*law).into(), between.join("–"), dampers.to_string()]
        };
        let lines: Vec<_> = self.interactions.iter().map(line).collect();
        look.columns(Some(["interaction", "law", "between", "dampers"]), &lines)
    }

    fn signal_lines(&self, look: Look) -> String {
        let mut lines = Vec::new();
        lines.extend(self.inputs.iter().map(|input| {
            let by = if input.table { "table" } else { "caller" };
            [&input.name, input.kind, input.unit, by].map(str::to_owned)
        }));
        lines.extend(self.readouts.iter().map(|readout| {
            let mut units = readout.units.clone();
            units.dedup();
            [&readout.name, readout.kind, &units.join(", "), "read-out"].map(str::to_owned)
        }));
        look.columns(Some(["signal", "type", "unit", "driven by"]), &lines)
    }
}

/// One length, or two where they differ by more than rounding.
fn lengths([shortest, longest]: [f64; 2]) -> String {
    let [a, b] = [shortest, longest].map(|length| significant(length, 5));
    if a == b { a } else { format!("{a} to {b}") }
}
