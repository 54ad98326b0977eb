//! Scenes: a TOML file becomes a checked, assembled model.
//!
//! `text → tables with spans → checked elements → assembled model`. Every refusal names file,
//! line, column, what is wrong and what would be right. The sums and roots of the assembly have
//! one written order and trigonometry is libm's, so a scene gives the same bits on every host.

mod assembly;
mod body;
pub mod build;
mod closure;
mod columns;
pub mod default_step;
mod defaults;
mod derived;
mod direction;
mod drive;
mod elimination;
mod error;
pub mod export;
mod extents;
mod facts;
mod fault;
pub mod file;
mod file_lines;
pub mod fitting;
mod geometry;
mod hinge;
mod inertia;
mod input;
mod joints;
pub mod laws;
mod links;
mod lint;
mod load;
mod lookup;
mod names;
mod nearest;
mod orientation;
mod origin;
mod pair;
pub mod parameters;
mod parts;
pub mod planar;
mod point_on_line;
mod points;
mod precise;
pub mod quantity;
mod readout;
mod runtime;
mod settle;
mod shortened;
pub mod single;
mod solid;
mod spring;
mod start;
mod target;
mod text;
pub mod time;
mod torsion_spring;
mod tsda;
pub mod vocabulary;
mod write;
mod written;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

pub use build::{Build, build};
pub use columns::{BODY_COLUMNS, ENERGY_COLUMNS, TIME_COLUMN, TraceColumns, UnlikeColumn};
pub use derived::DerivedBody;
pub use elimination::{Eliminated, Elimination};
pub use error::{Refusal, SceneError};
pub use extents::Misfit;
pub use facts::{ElementDamping, ElementFrequency, Facts, Island, JointElement, JointFacts};
pub use geometry::GeometryInfo;
pub use hinge::Hinge;
pub use input::InputInfo;
pub use joints::{Assembled, JointInfo, Moved, OpenJoint, Realisation};
pub use laws::InteractionInfo;
pub use lint::{OneSided, Severity, Warning};
pub use lookup::{UnfitInput, UnknownName};
pub use nearest::nearest;
pub use origin::Setting;
pub use planar::Planar;
pub use readout::ReadoutInfo;
pub use runtime::{SceneModel, widen};
pub use settle::{Restless, Settled};
pub use shortened::shortened;
pub use solid::Solid;
pub use text::is_name;

use dbd_kernel::{BodyState, F64};

use crate::assembly::{Assembly, Resolved};
use crate::error::Source;
use crate::file_lines::FileLines;
use crate::hinge::Known;
use crate::origin::Origin;
use crate::parameters::{Changed, Changes, Log, Parameter, SceneNumber};
use crate::target::Elements;
use crate::text::{Number, Numbers, Seconds, Switch, Table, Text};
use crate::write::Writer;
use crate::written::{Angles, WrittenAngle};

const KEYS: &[&str] = &[
    "name",
    "description",
    "gravity",
    "assemble",
    "duration",
    "step",
    "every",
    "planar",
    "settle",
    "realisation",
    "start",
    "points",
    "defaults",
    "parameters",
    "body",
    "joint",
    "tsda",
    "point_on_line",
    "torsion_spring",
    "interaction",
    "coupling",
    "load",
    "input",
    "readout",
    "geometry",
];

/// A checked and assembled scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The scene's name.
    pub name: String,
    /// What it is, free text; empty where the file gives none.
    pub description: String,
    /// \[s\] simulated time.
    pub duration: f64,
    /// \[s\] the step, where the scene gives one.
    pub step: Option<f64>,
    /// \[s\] the sampling interval, where the scene gives one.
    pub every: Option<f64>,
    /// Names of the bodies in the model's order, spiders after those of the scene file.
    pub body_names: Vec<String>,
    /// The joints in scene order.
    pub joints: Vec<JointInfo>,
    /// What was moved to close its joints, where it has a table `assemble`.
    pub assembled: Option<Assembled>,
    /// What was moved to bring it to rest, where it says `settle = true`.
    pub settled: Option<Settled>,
    /// What messages call the torsion springs, in the model's order:
    /// `torsion_spring 1 (world–crank)`; after those of the scene file the ones that count the
    /// turns of a read-out's joint.
    pub torsion_names: Vec<String>,
    /// The inputs in scene order.
    pub inputs: Vec<InputInfo>,
    /// The read-outs in scene order.
    pub readouts: Vec<ReadoutInfo>,
    /// What bodies and the ground look like, in scene order; the model knows nothing of it.
    pub geometry: Vec<GeometryInfo>,
    /// What came of bodies whose mass, inertia or axes are not written as numbers, in scene order.
    pub derived: Vec<DerivedBody>,
    /// The values that `[parameters]` names, in the order of the file, as they are with the changes.
    pub parameters: Vec<Parameter>,
    /// The changes of the file's values as they were given, each `PATH=VALUE`.
    pub changes: Vec<String>,
    /// What they changed.
    pub changed: Vec<Changed>,
    /// The assembled model in double precision; every other precision is a rounding of it.
    pub model: SceneModel<F64>,
    /// The scene in its plane, where it says `planar = true`: what steps is this model then.
    pub planar: Option<Planar>,
    /// The states at which joints are assembled: those at t = 0 but for `start` and `settle`.
    assembled_states: Vec<BodyState<F64>>,
    file_lines: FileLines,
    origin: Origin,
    written_angles: Vec<WrittenAngle>,
    /// What messages call raw TSDAs, then points on lines.
    raw_names: Vec<String>,
    /// What messages call the interactions, in the order of the model's laws.
    law_names: Vec<String>,
    /// The numbers of their tables.
    law_places: Vec<laws::LawPlace>,
}

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// Where the file cannot be read or the scene is refused.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let called = path.display().to_string();
        match file::read_text(path) {
            Ok(text) => Self::parse(&text, &called),
            Err(reason) => Err(SceneError::Unreadable { file: called, reason }),
        }
    }

    /// Reads a scene from its text; `file` is what messages call it.
    ///
    /// # Errors
    /// Where the scene is refused.
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        Self::parse_with(text, file, &[""; 0])
    }

    /// Reads a scene from its text with values changed by their paths, each `PATH=VALUE`
    /// ([`parameters`]): `body.cart.mass=1.2`, `joint.*.stiffness=1e6`, `step=20us`. Later ones go
    /// before earlier ones.
    ///
    /// # Errors
    /// Where a change leads nowhere or the changed scene is refused; what is wrong with a change is
    /// shown in it, and [`SceneError::file`] is `--set` then.
    pub fn parse_with(
        text: &str,
        file: &str,
        changes: &[impl AsRef<str>],
    ) -> Result<Self, SceneError> {
        Self::read(text, file, changes, None, |_, _, _| Ok(())).map(|(scene, ())| scene)
    }

    /// The long form of a scene: the text of one with the same bits whose every pose and place is a number in SI,
    /// where the joints are closed, with the changes. Comments stay where what they stand at does.
    ///
    /// # Errors
    /// As [`Scene::parse_with`].
    pub fn long_form(
        text: &str,
        file: &str,
        changes: &[impl AsRef<str>],
    ) -> Result<String, SceneError> {
        let write = |scene: &Self, root: &Table<'_>, resolved: &_| {
            Writer::new(root, scene, resolved, text).write()
        };
        Self::read(text, file, changes, None, write).map(|(_, text)| text)
    }

    /// The long form of this scene as it is now, wherever its bodies are: states at t = 0 that are not those of the
    /// file stand in `[start]`, and it does not settle again.
    ///
    /// # Errors
    /// None for a scene that was read from its text alone; else as [`Scene::parse_with`].
    pub fn long_text(&self) -> Result<String, SceneError> {
        let (file, text) = self.origin.file();
        // What it says of settling has been done.
        let changes = self.changes.iter().filter(|change| !change.starts_with("settle="));
        let changes: Vec<&String> = changes.collect();
        let write = |_: &Self, root: &Table<'_>, resolved: &_| {
            Writer::new(root, self, resolved, text).write()
        };
        Self::read(text, file, &changes, None, write).map(|(_, text)| text)
    }

    /// All numbers that the scene's file writes, with the changes, by their paths: what
    /// [`Self::parse_with`] and [`Self::with`] can give otherwise.
    ///
    /// # Errors
    /// None for a scene that was read from its text alone; else as [`Self::parse_with`].
    pub fn numbers(&self) -> Result<Vec<SceneNumber>, SceneError> {
        let log = Log::default();
        let (file, text) = self.origin.file();
        let list = |scene: &Self, root: &Table<'_>, _: &_| {
            let named = scene.parameters.iter().map(SceneNumber::of);
            Ok(named.chain(log.numbers(root.entries())).collect())
        };
        Self::read(text, file, &self.changes, Some(&log), list).map(|(_, numbers)| numbers)
    }

    /// Reads a scene and does something while its tables are there, knowing what values stand for.
    fn read<T>(
        text: &str,
        file: &str,
        changes: &[impl AsRef<str>],
        log: Option<&Log>,
        then: impl FnOnce(&Self, &Table<'_>, &BTreeMap<usize, Resolved>) -> Result<T, SceneError>,
    ) -> Result<(Self, T), SceneError> {
        let given = changes.iter().map(|change| change.as_ref().to_owned()).collect();
        let changes = Changes::read(text, changes)?;
        let source = changes.source(file);
        let mut document = text::parse(source)?;
        let before = match changes.is_empty() {
            true => None,
            false => parameters::read(&text::root(source, &document), None).ok(),
        };
        let changed = changes.apply(file, &mut document)?;
        let root = text::root(source, &document);
        root.only(&[KEYS])?;
        let scope = parameters::read(&root, before.as_ref())?;
        let angles = Angles::default();
        let source = Source { scope: Some(&scope), log, angles: Some(&angles), ..source };
        let root = text::root(source, &document);
        let name = root.required("name", Text::Name)?;
        let description = root.optional("description", Text::Any)?.unwrap_or_default();
        let duration = root.required("duration", Seconds::positive())?;
        let step = root.optional("step", Seconds::positive())?;
        let every = root.optional("every", Seconds::positive())?;
        let planar = root.optional("planar", Switch)?.unwrap_or_default();
        let settle = root.optional("settle", Switch)?.unwrap_or_default();
        let gravity = root.optional("gravity", Numbers(Number::any("m/s²")))?;

        let mut assembly = Assembly::default();
        assembly.set_gravity(gravity.unwrap_or_default());
        defaults::check(&root)?;
        let derived = body::read_all(&root, &mut assembly)?;
        let assembled = joints::assemble(&root, &mut assembly)?;
        let mut elements = Elements::default();
        let (joints, places) = joints::read_all(&root, &mut assembly, &mut elements)?;
        let mut raw_names = tsda::read_all(&root, &mut assembly, &mut elements)?;
        raw_names.extend(point_on_line::read_all(&root, &mut assembly, &mut elements)?);
        let mut torsion_names = torsion_spring::read_all(&root, &mut assembly, &mut elements)?;
        let laws = laws::read_all(&root, &places, &mut assembly, &mut elements)?;
        load::read_all(&root, &mut assembly)?;
        let mut known = Known {
            assembly: &mut assembly,
            elements: &elements,
            joints: &joints,
            places: &places,
            quantities: &laws.quantities,
        };
        let inputs = input::read_all(&root, &mut known)?;
        let readouts = readout::read_all(&root, &mut known, &inputs, &mut torsion_names)?;
        let mut known = Known {
            assembly: &mut assembly,
            elements: &elements,
            joints: &joints,
            places: &places,
            quantities: &laws.quantities,
        };
        input::read_over(&root, &mut known, &inputs, &readouts)?;
        let geometry = geometry::read_all(&root, &assembly)?;
        let resolved = assembly.resolved();
        let started = start::read(&root, &assembly)?;
        let (model, body_names) = assembly.finish();
        let assembled_states = model.initial.clone();
        let mut scene = Self {
            name,
            description,
            duration,
            step,
            every,
            body_names,
            joints,
            assembled,
            settled: None,
            torsion_names,
            inputs,
            readouts,
            geometry,
            model,
            planar: None,
            assembled_states,
            file_lines: FileLines::of(&root)?,
            origin: Origin::of(source, &root),
            written_angles: Vec::new(),
            derived,
            parameters: parameters::all(&root, &scope),
            changes: given,
            changed,
            raw_names,
            law_names: laws.labels,
            law_places: laws.places,
        };
        if planar {
            let reduced = scene.reduced().map_err(|unplanar| unplanar.refuse(&scene, &root))?;
            scene.planar = Some(reduced);
        }
        start::apply(&root, &mut scene, started)?;
        if settle {
            scene.settled = Some(settle::settle(&root, &mut scene)?);
        }
        let done = then(&scene, &root, &resolved)?;
        scene.written_angles = angles.all();
        Ok((scene, done))
    }

    /// The scene with one more change of its file's values, `PATH=VALUE`.
    ///
    /// # Errors
    /// Where the changed scene is refused.
    pub fn with(&self, change: &str) -> Result<Self, SceneError> {
        let mut changes = self.changes.clone();
        changes.push(change.to_owned());
        let (file, text) = self.origin.file();
        Self::parse_with(text, file, &changes)
    }

    /// The refusal of a setting of the scene file at its place there: what was asked for elsewhere,
    /// a duration, a step, does not go with it. `None` where the file does not give it.
    #[must_use]
    pub fn refuse(&self, setting: Setting, message: &str, help: &str) -> Option<SceneError> {
        self.origin.refuse(setting, message, help)
    }

    /// The model that steps: of a planar scene the one in its plane, whose axes are not the world's.
    #[must_use]
    pub fn stepped(&self) -> &SceneModel<F64> {
        self.planar.as_ref().map_or(&self.model, |planar| &planar.model)
    }

    /// The elements that step, in the world's axes: those of [`Self::stepped`] where the scene is planar.
    #[must_use]
    pub fn in_world(&self) -> Cow<'_, SceneModel<F64>> {
        match &self.planar {
            Some(planar) => Cow::Owned(planar.in_world(&self.model, &planar.model)),
            None => Cow::Borrowed(&self.model),
        }
    }

    /// Takes every input from its table, so that the caller drives it, as [`SceneModel::release_all`].
    pub fn release_all(&mut self) {
        self.model.release_all();
        if let Some(planar) = &mut self.planar {
            planar.model.release_all();
        }
    }

    /// What messages call the raw TSDAs, then the points on lines, in the order of their groups:
    /// "tsda `strut` (shell–knuckle)".
    #[must_use]
    pub fn raw_names(&self) -> &[String] {
        &self.raw_names
    }

    /// What messages call the interactions, in the order of the model's rows of laws:
    /// "interaction `stop` (world–bar)".
    #[must_use]
    pub fn law_names(&self) -> &[String] {
        &self.law_names
    }

    /// Torsion springs of the scene file, without those that only count turns.
    #[must_use]
    pub fn torsion_springs(&self) -> usize {
        self.file_lines.torsion_springs.len()
    }
}

/// The page's programs compile.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod page {}

#[cfg(test)]
mod example {
    use super::Scene;

    /// A scene of two bodies, `arm` turned and off the origin and `hand` spinning, and of these
    /// elements.
    pub(crate) fn with(elements: &str) -> Scene {
        let text = format!(
            r#"
            name = "two bodies"
            duration = 1
            [[body]]
            name = "arm"
            mass = 2
            inertia = [0.3, 0.2, 0.4]
            position = [0.5, -1, 0.25]
            orientation = {{ axis = [1, 2, -2], angle = 0.7 }}
            [[body]]
            name = "hand"
            mass = 1
            inertia = [0.1, 0.1, 0.1]
            position = [1, 0, 0]
            orientation = {{ euler_321 = [0.3, -0.2, 1.1] }}
            angular_velocity = [0, 0, 3]
            {elements}
            "#
        );
        Scene::parse(&text, "example.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
    }
}

#[cfg(test)]
mod tests;
