//! Arguments that several commands take.
//!
//! `words => scene's name, choice by its name`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use dbd_plant::Named;

/// Takes a choice by its name; what it is shows in the help.
pub fn names<N: Named + Send + Sync>() -> impl TypedValueParser<Value = N> {
    let values =
        N::ALL.iter().map(|choice| PossibleValue::new(choice.name()).help(choice.summary()));
    PossibleValuesParser::new(values)
        .try_map(|name| N::of_name(&name).ok_or("there is no such name"))
}

/// What names a scene.
#[derive(Clone, Debug, Args)]
pub struct SceneArgument {
    /// A scene by name (see list), a path to a .toml file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub scene: String,
    /// Changes one value of the scene by its path, as often as wanted; * and ? stand for letters of a
    /// name: body.cart.mass=1.2, joint.*.stiffness=1e6, step=20us
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Three freedoms per body in the scene's plane, as --set planar=true; refused where anything leaves it
    #[arg(long)]
    pub planar: bool,
    /// Starts where the scene rests under its loads, as --set settle=true
    #[arg(long)]
    pub settle: bool,
}

impl SceneArgument {
    /// The same for a command that brings the scene to rest itself.
    #[must_use]
    pub fn unsettled(&self) -> Self {
        let mut set = self.set.clone();
        set.push("settle=false".to_owned());
        Self { set, settle: false, ..self.clone() }
    }

    /// The changes of the scene.
    #[must_use]
    pub fn changes(&self) -> Vec<String> {
        let planar = self.planar.then(|| "planar=true".to_owned());
        let settle = self.settle.then(|| "settle=true".to_owned());
        self.set.iter().cloned().chain(planar).chain(settle).collect()
    }
}
