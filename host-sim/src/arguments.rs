//! Arguments that several commands take.
//!
//! `words => scene's name, choice by its name`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use dbd_plant::Named;

/// Parses a choice by its name; the help describes each choice.
pub fn names<N: Named + Send + Sync>() -> impl TypedValueParser<Value = N> {
    let values =
        N::ALL.iter().map(|choice| PossibleValue::new(choice.name()).help(choice.summary()));
    PossibleValuesParser::new(values).try_map(|name| N::of_name(&name).ok_or("unknown name"))
}

/// Selects all kinds.
const ALL: &str = "all";

/// A kind of element that a conversion may leave out, or all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ignored<K> {
    /// All kinds.
    All,
    /// One kind.
    One(K),
}

impl<K: Copy> Ignored<K> {
    /// The chosen kinds among all.
    #[must_use]
    pub fn all_of(chosen: &[Self], all: &[K]) -> Vec<K> {
        let kinds = chosen.iter().flat_map(|ignored| match ignored {
            Self::One(kind) => std::slice::from_ref(kind),
            Self::All => all,
        });
        kinds.copied().collect()
    }
}

/// Parses a kind by its name, or `all`; `words` gives the name and the description of a kind.
pub fn ignorable<K: Copy + Send + Sync + 'static>(
    all: &'static [K],
    words: fn(K) -> [&'static str; 2],
) -> impl TypedValueParser<Value = Ignored<K>> {
    let kinds = all.iter().map(|kind| words(*kind));
    let kinds = kinds.chain([[ALL, "all kinds"]]);
    let values = kinds.map(|[name, about]| PossibleValue::new(name).help(about));
    PossibleValuesParser::new(values).map(move |name| {
        let kind = all.iter().find(|kind| words(**kind)[0] == name);
        kind.map_or(Ignored::All, |kind| Ignored::One(*kind))
    })
}

/// The argument that names a scene.
#[derive(Clone, Debug, Args)]
pub struct SceneArgument {
    /// A scene by name (see list), a path to a .toml file, or - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub scene: String,
    /// Set one value of the scene by its path; may be repeated; * and ? match characters of a
    /// name: body.cart.mass=1.2, joint.*.stiffness=1e6, step=20us
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Use three degrees of freedom per body, as --set planar=true; an error if the scene is not planar
    #[arg(long)]
    pub planar: bool,
    /// Start in the static equilibrium under the loads, as --set settle=true
    #[arg(long)]
    pub settle: bool,
}

impl SceneArgument {
    /// The same for a command that settles the scene itself.
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
