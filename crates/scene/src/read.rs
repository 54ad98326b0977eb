//! Reading a scene: its text becomes a checked, assembled [`Scene`].
//!
//! `text, changes => scene`.

use std::collections::BTreeMap;
use std::path::Path;

use toml::de::DeTable;

use crate::assembly::{Assembly, Resolved};
use crate::error::{SceneError, Source};
use crate::file_lines::FileLines;
use crate::known::Known;
use crate::origin::Origin;
use crate::parameters::{self, Changes, SceneNumber};
use crate::scene::Scene;
use crate::target::Elements;
use crate::text::{self, Number, Numbers, Seconds, Switch, Table, Text};
use crate::write::Writer;
use crate::written::{Angles, Log};
use crate::{
    body, defaults, file, geometry, input, interaction, joints, load, over, point_on_line,
};
use crate::{readout, reduction, settle, start, torsion_spring, tsda};

pub(crate) const KEYS: &[&str] = &[
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

/// The parsed text of a scene, to be read with many sets of changes.
#[derive(Clone, Debug)]
pub struct SceneText<'t> {
    text: &'t str,
    file: &'t str,
    document: DeTable<'t>,
}

impl<'t> SceneText<'t> {
    /// Parses a text; `file` is its name in messages.
    ///
    /// # Errors
    /// Where it is not TOML.
    pub fn parse(text: &'t str, file: &'t str) -> Result<Self, SceneError> {
        Ok(Self { text, file, document: text::parse(Source::of(file, text))? })
    }

    /// The scene with changes, as [`Scene::parse_with`] reads it.
    ///
    /// # Errors
    /// As [`Scene::parse_with`].
    pub fn scene(&self, changes: &[impl AsRef<str>]) -> Result<Scene, SceneError> {
        let all = Changes::read(self.text, changes)?;
        let document = self.document.clone();
        Scene::read_document(document, self.file, &all, None, |_, _, _| Ok(()))
            .map(|(scene, ())| scene)
    }
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

    /// Reads a scene from its text; `file` is its name in messages.
    ///
    /// # Errors
    /// Where the scene is refused.
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        Self::parse_with(text, file, &[""; 0])
    }

    /// Reads a scene from its text with values changed by their paths, each `PATH=VALUE`
    /// ([`parameters`]): `body.cart.mass=1.2`, `joint.*.stiffness=1e6`, `step=20us`. Later changes override earlier
    /// ones.
    ///
    /// # Errors
    /// Where a change refers to nothing or the changed scene is refused; an error in a change is shown in its text,
    /// with `--set` as [`SceneError::file`].
    pub fn parse_with(
        text: &str,
        file: &str,
        changes: &[impl AsRef<str>],
    ) -> Result<Self, SceneError> {
        Self::read(text, file, changes, None, |_, _, _| Ok(())).map(|(scene, ())| scene)
    }

    /// The long form of a scene: a text with the same bits in which every pose and position is a number in SI, with
    /// joints closed and changes applied. Comments stay where their item stays.
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

    /// The long form of this scene in its current state: states at t = 0 that differ from the file are written to
    /// `[start]`, and it does not settle again.
    ///
    /// # Errors
    /// None for a scene that was read from its text alone; else as [`Scene::parse_with`].
    pub fn long_text(&self) -> Result<String, SceneError> {
        let (file, text) = self.origin.file();
        // Settling has already been done.
        let changes = self.changes.iter().filter(|change| !change.starts_with("settle="));
        let changes: Vec<&String> = changes.collect();
        let write = |_: &Self, root: &Table<'_>, resolved: &_| {
            Writer::new(root, self, resolved, text).write()
        };
        Self::read(text, file, &changes, None, write).map(|(_, text)| text)
    }

    /// All numbers written in the scene's file, with the changes, by their paths: the values that [`Self::parse_with`]
    /// and [`Self::with`] can change.
    ///
    /// # Errors
    /// None for a scene that was read from its text alone; else as [`Self::parse_with`].
    pub fn numbers(&self) -> Result<Vec<SceneNumber>, SceneError> {
        let log = Log::default();
        let (file, text) = self.origin.file();
        let list = |scene: &Self, root: &Table<'_>, _: &_| {
            let named = scene.parameters.iter().map(SceneNumber::of);
            Ok(named.chain(parameters::numbers(&log, root.entries())).collect())
        };
        Self::read(text, file, &self.changes, Some(&log), list).map(|(_, numbers)| numbers)
    }

    /// Reads a scene and calls a function while its tables and names are available.
    fn read<T>(
        text: &str,
        file: &str,
        changes: &[impl AsRef<str>],
        log: Option<&Log>,
        then: impl FnOnce(&Self, &Table<'_>, &BTreeMap<usize, Resolved>) -> Result<T, SceneError>,
    ) -> Result<(Self, T), SceneError> {
        let all = Changes::read(text, changes)?;
        let document = text::parse(all.source(file))?;
        Self::read_document(document, file, &all, log, then)
    }

    fn read_document<'t, T>(
        mut document: DeTable<'t>,
        file: &'t str,
        changes: &'t Changes,
        log: Option<&Log>,
        then: impl FnOnce(&Self, &Table<'_>, &BTreeMap<usize, Resolved>) -> Result<T, SceneError>,
    ) -> Result<(Self, T), SceneError> {
        let source = changes.source(file);
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
        let tsda::Raw { names: mut raw_names, rows: raw_tsdas } =
            tsda::read_all(&root, planar, &mut assembly, &mut elements)?;
        raw_names.extend(point_on_line::read_all(&root, &mut assembly, &mut elements)?);
        let mut torsion_names = torsion_spring::read_all(&root, &mut assembly, &mut elements)?;
        let laws = interaction::read_all(&root, &places, &mut assembly, &mut elements)?;
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
        over::read_all(&root, &mut assembly, &inputs, &readouts)?;
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
            file_lines: FileLines::of(&root, raw_tsdas),
            origin: Origin::of(source, &root),
            written_angles: Vec::new(),
            derived,
            parameters: parameters::all(&root, &scope),
            changes: changes.given.clone(),
            changed,
            raw_names,
            law_names: laws.labels,
            law_places: laws.places,
        };
        if planar {
            let reduced =
                reduction::reduced(&scene).map_err(|unplanar| unplanar.refuse(&scene, &root))?;
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
}
