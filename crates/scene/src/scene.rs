//! A scene that was read: its model with names, points and line numbers.
//!
//! Data and accessors only; [`read`](crate::read) creates scenes, checks are functions of `&Scene`.

use std::borrow::Cow;

use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyState, F64, InputIndex};

use crate::columns::{ENERGY_COLUMNS, TIME_COLUMN, of_body};
use crate::derived::DerivedBody;
use crate::error::SceneError;
use crate::file_lines::{FileLines, LawPlace};
use crate::geometry::GeometryInfo;
use crate::input::InputInfo;
use crate::joints::{Assembled, JointInfo, Moved};
use crate::nearest::nearest;
use crate::origin::{Origin, Setting};
use crate::parameters::{Changed, Parameter};
use crate::planar::Planar;
use crate::readout::ReadoutInfo;
use crate::runtime::SceneModel;
use crate::written::WrittenAngle;

/// A checked and assembled scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The scene's name.
    pub name: String,
    /// Description in free text; empty by default.
    pub description: String,
    /// \[s\] simulated time.
    pub duration: f64,
    /// \[s\] step size, if given in the scene.
    pub step: Option<f64>,
    /// \[s\] sampling interval, if given in the scene.
    pub every: Option<f64>,
    /// Names of the bodies in the model's order, spiders after those of the scene file.
    pub body_names: Vec<String>,
    /// The joints in scene order.
    pub joints: Vec<JointInfo>,
    /// The bodies moved to close its joints, with a table `assemble`.
    pub assembled: Option<Assembled>,
    /// The bodies moved to bring it to rest, with `settle = true`.
    pub settled: Option<Settled>,
    /// Names of the torsion springs in messages, in the model's order: `torsion_spring 1 (world–crank)`; those that
    /// count revolutions for a read-out follow those of the scene file.
    pub torsion_names: Vec<String>,
    /// The inputs in scene order.
    pub inputs: Vec<InputInfo>,
    /// The read-outs in scene order.
    pub readouts: Vec<ReadoutInfo>,
    /// Appearance of bodies and the ground, in scene order; not part of the model.
    pub geometry: Vec<GeometryInfo>,
    /// Derived values of bodies whose mass, inertia or axes are not written as numbers, in scene order.
    pub derived: Vec<DerivedBody>,
    /// The values of `[parameters]`, in the order of the file, with changes applied.
    pub parameters: Vec<Parameter>,
    /// The changes of the file's values as given, each `PATH=VALUE`.
    pub changes: Vec<String>,
    /// The effects of the changes.
    pub changed: Vec<Changed>,
    /// The assembled model in double precision; every other precision is a rounding of it.
    pub model: SceneModel<F64>,
    /// The scene in its plane, with `planar = true`; this model is then stepped.
    pub planar: Option<Planar>,
    /// The states at which joints are assembled: those at t = 0 without `start` and `settle`.
    pub(crate) assembled_states: Vec<BodyState<F64>>,
    pub(crate) file_lines: FileLines,
    pub(crate) origin: Origin,
    pub(crate) written_angles: Vec<WrittenAngle>,
    /// Names of raw TSDAs, then points on lines, in messages.
    pub(crate) raw_names: Vec<String>,
    /// Names of the interactions in messages, in the order of the model's laws.
    pub(crate) law_names: Vec<String>,
    /// The numbers of their tables.
    pub(crate) law_places: Vec<LawPlace>,
}

/// The result of bringing a scene to rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settled {
    /// The bodies that were moved, in the order of the scene.
    pub moved: Vec<Moved>,
    /// Number of computed steps.
    pub iterations: usize,
    /// \[N\] largest force on a body at rest; for a planar scene in its plane.
    pub force: f64,
    /// \[N·m\] largest torque on a body at rest.
    pub torque: f64,
}

/// An unknown name in a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene `{scene}` has no {kind} `{name}`{}", .meant.as_ref().map_or(String::new(), |m| format!("; did you mean `{m}`?")))]
pub struct UnknownName {
    /// The scene.
    pub scene: String,
    /// `input` or `readout`.
    pub kind: &'static str,
    /// The unknown name.
    pub name: String,
    /// The suggested name.
    pub meant: Option<String>,
}

impl Scene {
    /// The error of a setting in the scene file that conflicts with a value given elsewhere, at its position in the
    /// file. `None` where the file does not give the setting.
    #[must_use]
    pub fn refuse(&self, setting: Setting, message: &str, help: &str) -> Option<SceneError> {
        self.origin.refuse(setting, message, help)
    }

    /// The model that is stepped; for a planar scene the one in its plane, whose axes are not the world's.
    #[must_use]
    pub fn stepped(&self) -> &SceneModel<F64> {
        self.planar.as_ref().map_or(&self.model, |planar| &planar.model)
    }

    /// The elements that are stepped, in the world's axes: those of [`Self::stepped`] for a planar scene.
    #[must_use]
    pub fn in_world(&self) -> Cow<'_, SceneModel<F64>> {
        match &self.planar {
            Some(planar) => Cow::Owned(planar.in_world(&self.model, &planar.model)),
            None => Cow::Borrowed(&self.model),
        }
    }

    /// The states at which joints are assembled: those at t = 0 without `start` and `settle`, where joint coordinates
    /// are 0.
    #[must_use]
    pub fn assembled_states(&self) -> &[BodyState<F64>] {
        &self.assembled_states
    }

    /// Table and number of the table of the scene file that an interaction belongs to, by its row in the model:
    /// `("joint", 2)` for limits of the third joint, `("interaction", 0)` for the first interaction.
    #[must_use]
    pub fn table_of_interaction(&self, row: usize) -> Option<(&'static str, usize)> {
        self.law_places.get(row).copied()
    }

    /// Detaches every input from its table, so that the caller sets it; see [`SceneModel::release_all`].
    pub fn release_all(&mut self) {
        self.model.release_all();
        if let Some(planar) = &mut self.planar {
            planar.model.release_all();
        }
    }

    /// Names of the raw TSDAs, then the points on lines, in messages, in the order of their groups:
    /// "tsda `strut` (shell–knuckle)".
    #[must_use]
    pub fn raw_names(&self) -> &[String] {
        &self.raw_names
    }

    /// Names of the interactions in messages, in the order of the model's rows of laws: "interaction `stop`
    /// (world–bar)".
    #[must_use]
    pub fn law_names(&self) -> &[String] {
        &self.law_names
    }

    /// Number of torsion springs of the scene file, without those that only count revolutions.
    #[must_use]
    pub fn torsion_springs(&self) -> usize {
        self.file_lines.torsion_springs.len()
    }

    /// The input with a name, to set it on a plant.
    ///
    /// # Errors
    /// Where the name is unknown.
    pub fn input(&self, name: &str) -> Result<InputIndex, UnknownName> {
        let names = self.inputs.iter().map(|input| input.name.as_str());
        let found = self.inputs.iter().find(|input| input.name == name);
        found.map(|input| input.index).ok_or_else(|| self.unknown("input", name, names))
    }

    /// The read-out with a name, to read it from a plant.
    ///
    /// # Errors
    /// Where the name is unknown.
    pub fn readout(&self, name: &str) -> Result<Readout<F64>, UnknownName> {
        let names = self.readouts.iter().map(|readout| readout.name.as_str());
        let found = self.readouts.iter().find(|readout| readout.name == name);
        found.map(|found| found.readout).ok_or_else(|| self.unknown("readout", name, names))
    }

    /// The names of a trace's columns in order.
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        let mut columns = vec![TIME_COLUMN.to_owned()];
        columns.extend(self.body_names.iter().flat_map(|body| of_body(body)));
        columns.extend(ENERGY_COLUMNS.map(str::to_owned));
        for readout in &self.readouts {
            columns.extend(readout.columns.iter().map(|(end, _)| readout.name.clone() + end));
        }
        columns
    }

    /// The name of a body of the model; empty for an invalid index.
    #[must_use]
    pub fn body_name(&self, row: usize) -> &str {
        self.body_names.get(row).map_or("", String::as_str)
    }

    /// The line of the scene file, from 1, on which a joint begins.
    #[must_use]
    pub fn line_of_joint(&self, row: usize) -> Option<usize> {
        self.file_lines.joints.get(row).copied()
    }

    /// The line of the scene file, from 1, on which an input begins.
    #[must_use]
    pub fn line_of_input(&self, row: usize) -> Option<usize> {
        self.file_lines.inputs.get(row).copied()
    }

    /// The line of the scene file, from 1, on which an interaction begins, by its row in the model.
    #[must_use]
    pub fn line_of_interaction(&self, row: usize) -> Option<usize> {
        let (table, number) = *self.law_places.get(row)?;
        let lines = &self.file_lines;
        let lines = match table {
            "joint" => &lines.joints,
            "input" => &lines.inputs,
            "readout" => &lines.readouts,
            "coupling" => &lines.couplings,
            "tsda" => &lines.tsdas,
            "torsion_spring" => &lines.torsion_springs,
            _ => &lines.interactions,
        };
        lines.get(number).copied()
    }

    /// The line of the scene file, from 1, on which an element begins: rows of
    /// [`element_frequencies`](crate::element_frequencies) and [`element_dampings`](crate::element_dampings). Springs
    /// that only count revolutions have none.
    #[must_use]
    pub fn line_of_element(&self, row: usize) -> Option<usize> {
        let lines = &self.file_lines;
        let first = self.joints.len() + self.raw_names.len() + self.torsion_names.len();
        if let Some(law) = row.checked_sub(first) {
            return self.line_of_interaction(law);
        }
        let all = lines.joints.iter().chain(lines.raws()).chain(&lines.torsion_springs);
        all.copied().nth(row)
    }

    /// The line of the scene file, from 1, on which a body begins, or the joint that creates it.
    #[must_use]
    pub fn line_of_body(&self, row: usize) -> Option<usize> {
        self.file_lines.bodies.get(row).copied().or_else(|| {
            let name = self.body_names.get(row)?;
            let brings = |joint: &JointInfo| joint.spider.as_ref() == Some(name);
            self.line_of_joint(self.joints.iter().position(brings)?)
        })
    }

    fn unknown<'n>(
        &self,
        kind: &'static str,
        name: &str,
        known: impl Iterator<Item = &'n str>,
    ) -> UnknownName {
        let meant = nearest(name, known).map(str::to_owned);
        UnknownName { scene: self.name.clone(), kind, name: name.to_owned(), meant }
    }
}
