//! The variables of an FMU and their roles.
//!
//! `instance => variables`, whose index is the value reference: time, inputs, outputs, parameters. The model
//! description and the interface both read this list.

use std::collections::BTreeSet;

use dbd_plant::instance::{Instance, InstanceError, SceneNumber};
use dbd_scene::BODY_COLUMNS;

use crate::names::structured;

/// Number of communication steps for a scene without a sampling interval.
const SAMPLES: f64 = 500.0;

/// Numbers of a scene that concern its run, which the importer controls.
const OF_THE_RUN: [&str; 3] = ["duration", "step", "every"];

/// The role of a variable in the plant.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// The independent variable.
    Time,
    /// An input of the instance, by index.
    Input(usize),
    /// An output, by index; whether inputs may act on it directly.
    Output(usize, bool),
    /// A parameter, by path.
    Parameter(String),
}

/// A variable of an FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name, structured if [`Description::is_structured`].
    pub name: String,
    /// Its role in the plant.
    pub role: Role,
    /// The SI unit; empty for a plain number.
    pub unit: String,
    /// \[`unit`\] its initial value; `None` if computed.
    pub start: Option<f64>,
    /// \[`unit`\] the smallest and the largest accepted value; infinite without bounds.
    pub range: [f64; 2],
    /// A short description.
    pub description: String,
}

/// The description of an FMU for importers.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The scene's name.
    pub name: String,
    /// The scene's description.
    pub description: String,
    /// \[s\] the scene's duration.
    pub duration: f64,
    /// \[s\] the plant's step.
    pub step: f64,
    /// \[s\] a suitable communication step: the scene's sampling interval rounded to whole steps of the plant.
    pub communication_step: f64,
    /// Whether all names follow FMI's structured naming.
    pub is_structured: bool,
    /// The variables; the index of each is its value reference.
    pub variables: Vec<Variable>,
}

impl Description {
    /// The description of an instance at t = 0.
    ///
    /// # Errors
    /// Only those that instantiation would have reported.
    pub fn of(instance: &Instance) -> Result<Self, InstanceError> {
        let (scene, step) = (instance.scene(), instance.step_size());
        let every = scene.every.unwrap_or(scene.duration / SAMPLES);
        let mut listed = vec![listed("time", Role::Time, "s", None, "time".into())];
        for (place, input) in instance.inputs().iter().enumerate() {
            let what = format!("input of the type {}, held until it is set again", input.kind);
            let role = Role::Input(place);
            let variable = self::listed(&input.name, role, input.unit, Some(input.start), what);
            listed.push(Variable { range: input.range, ..variable });
        }
        let states = scene.body_names.len() * BODY_COLUMNS.len();
        for (place, output) in instance.outputs().iter().enumerate() {
            let role = Role::Output(place, place >= states);
            let what = output.description.clone();
            listed.push(self::listed(&output.name, role, output.unit, None, what));
        }
        for SceneNumber { path, value, unit } in instance.parameters()? {
            if !OF_THE_RUN.contains(&path.as_str()) {
                let what = format!("parameter of the scene, {path}");
                let role = Role::Parameter(path.clone());
                listed.push(self::listed(&path, role, &unit, Some(value), what));
            }
        }
        let is_structured = name_all(&mut listed);
        Ok(Self {
            name: scene.name.clone(),
            description: scene.description.clone(),
            duration: scene.duration,
            step,
            communication_step: (every / step).round().max(1.0) * step,
            is_structured,
            variables: listed,
        })
    }
}

fn listed(name: &str, role: Role, unit: &str, start: Option<f64>, description: String) -> Variable {
    let range = [f64::NEG_INFINITY, f64::INFINITY];
    Variable { name: name.into(), role, unit: unit.into(), start, range, description }
}

/// Gives each variable a unique name; returns whether all are structured.
fn name_all(variables: &mut [Variable]) -> bool {
    let names: Option<Vec<String>> = variables.iter().map(|v| structured(&v.name)).collect();
    let is_structured = names.is_some();
    let mut taken = BTreeSet::new();
    for (row, variable) in variables.iter_mut().enumerate() {
        let own = names.as_ref().map_or(&variable.name, |names| &names[row]);
        let kind = match variable.role {
            Role::Time | Role::Output(..) => "output",
            Role::Input(_) => "input",
            Role::Parameter(_) => "parameter",
        };
        let mut name = own.clone();
        while !taken.insert(name.clone()) {
            name = format!("{kind}.{name}");
        }
        variable.name = name;
    }
    is_structured
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_there_once() {
        let of = |name: &str, role| listed(name, role, "", None, String::new());
        let mut variables = [
            of("drive", Role::Input(0)),
            of("drive", Role::Output(0, true)),
            of("upper arm.x", Role::Output(1, false)),
        ];
        assert!(name_all(&mut variables));
        let names = variables.each_ref().map(|variable| variable.name.as_str());
        assert_eq!(names, ["drive", "output.drive", "'upper arm'.x"]);
        variables[0].name = "Körper".into();
        assert!(!name_all(&mut variables));
    }
}
