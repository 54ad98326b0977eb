//! Description of a session for its page: names, units, choices, geometry.
//!
//! `session => description`.

use dbd_plant::{
    DampingName, Frequencies, Method, Named as _, PrecisionName, SchemeName, time::display,
};
use dbd_report::data::{Run, Trace};
use dbd_report::recording::traces;
use serde::Serialize;

use crate::session::asked::Set;
use crate::session::frame::Layout;
use crate::session::live::{Session, readouts};

/// Maximum number of listed numbers of a scene; the others are only in the text.
const MAX_NUMBERS: usize = 20_000;

/// Content of a page in addition to its frames.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Opened {
    /// The scene's name.
    pub name: String,
    /// Description.
    pub description: String,
    /// \[s\] how long `run` simulates it.
    pub duration: f64,
    /// \[s\] the step.
    pub step: f64,
    /// Steps of that run.
    pub steps: u64,
    /// The scheme's name.
    pub scheme: &'static str,
    /// The damping's.
    pub damping: &'static str,
    /// The precision's.
    pub precision: &'static str,
    /// Whether it is stepped in its plane.
    pub planar: bool,
    /// The drawn mechanism, as in a report.
    pub run: Run,
    /// Points with a drawn path.
    pub traces: Vec<Trace>,
    /// The inputs.
    pub inputs: Vec<Handle>,
    /// The outputs.
    pub outputs: Vec<Shown>,
    /// The first output that is a sensor.
    pub readouts: usize,
    /// All numbers of the scene.
    pub numbers: Vec<Number>,
    /// Its named parameters.
    pub parameters: Vec<Number>,
    /// Number of unlisted numbers.
    pub numbers_left_out: usize,
    /// Warnings.
    pub warnings: Vec<String>,
    /// \[s\] the longest step that is stable at t = 0; `None` where any is.
    pub limit: Option<f64>,
    /// The same run on the command line.
    pub command: String,
    /// Available choices.
    pub choices: Choices,
    /// Offsets of the parts of a frame.
    pub layout: Layout,
    /// Changes of the scene, by path.
    pub set: Set,
}

/// An input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Handle {
    /// Its name.
    pub name: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its type.
    pub kind: &'static str,
    /// \[`unit`\] its held value.
    pub value: Option<f64>,
    /// Its index among the inputs.
    pub row: usize,
}

/// An output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Shown {
    /// The column's name.
    pub name: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Description.
    pub description: String,
}

/// A number of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// Its path.
    pub path: String,
    /// \[`unit`\] its value.
    pub value: f64,
    /// Its SI unit.
    pub unit: String,
}

/// Methods by name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Choices {
    /// Schemes, each with its damping modes, the default first.
    pub schemes: Vec<Scheme>,
    /// Precisions.
    pub precisions: Vec<&'static str>,
}

/// A scheme.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Scheme {
    /// Its name.
    pub name: &'static str,
    /// Damping modes.
    pub dampings: Vec<&'static str>,
}

impl Session {
    /// Content of the page in addition to frames.
    #[must_use]
    pub fn opened(&self) -> Opened {
        let instance = &self.instance;
        let (scene, plant) = (instance.scene(), instance.plant());
        let method = plant.method();
        let limit = method.stability_limit() / Frequencies::of(scene).bound;
        let outputs = instance.outputs().iter().map(|output| Shown {
            name: output.name.clone(),
            unit: output.unit,
            description: output.description.clone(),
        });
        let inputs = instance.inputs().iter().enumerate().map(|(row, input)| Handle {
            name: input.name.clone(),
            unit: input.unit,
            kind: input.kind,
            value: instance.input_value(row),
            row,
        });
        let numbers = instance.parameters().unwrap_or_default();
        let named = scene.parameters.len();
        let number = |number: &dbd_scene::parameters::SceneNumber| Number {
            path: number.path.clone(),
            value: number.value,
            unit: number.unit.clone(),
        };
        Opened {
            name: scene.name.clone(),
            description: scene.description.clone(),
            duration: scene.duration,
            step: instance.step_size(),
            steps: self.plan.steps,
            scheme: method.scheme_name(),
            damping: method.damping().name(),
            precision: method.precision_name(),
            planar: scene.planar.is_some(),
            run: Run { mechanism: Some(self.mechanism.clone()), ..Run::default() },
            traces: traces(scene),
            inputs: inputs.collect(),
            outputs: outputs.collect(),
            readouts: readouts(scene),
            numbers: numbers.iter().skip(named).take(MAX_NUMBERS).map(number).collect(),
            parameters: numbers.iter().take(named).map(number).collect(),
            numbers_left_out: numbers.len().saturating_sub(named + MAX_NUMBERS),
            warnings: dbd_scene::warnings(scene).iter().map(ToString::to_string).collect(),
            limit: limit.is_finite().then_some(limit),
            command: self.command(method),
            choices: choices(),
            layout: self.layout(),
            set: self.asked.set.clone(),
        }
    }

    fn command(&self, method: &Method) -> String {
        let settings = &self.asked.settings;
        let newton = settings.newton.map(|n| format!(" --newton {n}")).unwrap_or_default();
        let rho = settings.rho.map(|rho| format!(" --rho {rho}")).unwrap_or_default();
        let damping = settings.damping.as_ref().map(|way| format!(" --damping {way}"));
        let (_, set) = self.scene_text();
        format!(
            "host-sim run {}{set} --scheme {}{newton}{rho}{} --precision {} --step {}",
            self.asked.file,
            method.scheme_name(),
            damping.unwrap_or_default(),
            method.precision_name(),
            display(self.instance.step_size()),
        )
    }
}

fn choices() -> Choices {
    let scheme = |scheme: &SchemeName| {
        let method = Method::new(*scheme, None, PrecisionName::F64).ok()?;
        let own = method.damping().name();
        let others = DampingName::ALL.iter().filter(|way| method.with_damping(**way).is_ok());
        let others = others.map(|way| way.name()).filter(|name| *name != own);
        Some(Scheme { name: scheme.name(), dampings: std::iter::once(own).chain(others).collect() })
    };
    let built = |precision: &&PrecisionName| {
        let method = Method::new(SchemeName::default(), None, **precision);
        method.is_ok_and(|method| method.check_built().is_ok())
    };
    let precisions = PrecisionName::ALL.iter().filter(built).map(|precision| precision.name());
    Choices {
        schemes: SchemeName::ALL.iter().filter_map(scheme).collect(),
        precisions: precisions.collect(),
    }
}
