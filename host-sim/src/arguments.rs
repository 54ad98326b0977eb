//! Arguments that several commands take.
//!
//! `words => choice by its name`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dbd_plant::Named;

/// Takes a choice by its name; what it is shows in the help.
pub fn names<N: Named + Send + Sync>() -> impl TypedValueParser<Value = N> {
    let values =
        N::ALL.iter().map(|choice| PossibleValue::new(choice.name()).help(choice.summary()));
    PossibleValuesParser::new(values)
        .try_map(|name| N::of_name(&name).ok_or("there is no such name"))
}
