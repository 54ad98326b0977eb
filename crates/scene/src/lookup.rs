//! Inputs and read-outs of a scene by their names.

use dbd_kernel::index::InputIndex;
use dbd_kernel::readouts::Readout;
use dbd_kernel::{F64, Geometry};

use crate::{Scene, nearest};

/// A name that a scene does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene `{scene}` has no {kind} `{name}`{}", .meant.as_ref().map_or(String::new(), |m| format!("; did you mean `{m}`?")))]
pub struct UnknownName {
    /// The scene.
    pub scene: String,
    /// `input` or `readout`.
    pub kind: &'static str,
    /// The name that was asked for.
    pub name: String,
    /// The one that was probably meant.
    pub meant: Option<String>,
}

/// An input whose value or table a precision cannot hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the input `{input}` (line {line}) has a value, a rise or a time that {precision} cannot hold"
)]
pub struct UnfitInput {
    /// The input.
    pub input: String,
    /// The line on which it begins.
    pub line: usize,
    /// The precision's name.
    pub precision: &'static str,
}

impl Scene {
    /// The input of a name, to set it on a plant.
    ///
    /// # Errors
    /// Where the scene has none of that name.
    pub fn input(&self, name: &str) -> Result<InputIndex, UnknownName> {
        let names = self.inputs.iter().map(|input| input.name.as_str());
        let found = self.inputs.iter().find(|input| input.name == name);
        found.map(|input| input.index).ok_or_else(|| self.unknown("input", name, names))
    }

    /// The read-out of a name, to read it from a plant.
    ///
    /// # Errors
    /// Where the scene has none of that name.
    pub fn readout(&self, name: &str) -> Result<Readout<F64>, UnknownName> {
        let names = self.readouts.iter().map(|readout| readout.name.as_str());
        let found = self.readouts.iter().find(|readout| readout.name == name);
        found.map(|found| found.readout).ok_or_else(|| self.unknown("readout", name, names))
    }

    /// Whether a precision holds what inputs are given.
    ///
    /// # Errors
    /// The first input that it does not.
    pub fn check_inputs<P: Geometry>(&self) -> Result<(), UnfitInput> {
        let Some(index) = self.model.convert::<P>().unfit_input() else { return Ok(()) };
        let row = usize::from(index.0);
        let input = self.inputs.get(row).map_or_else(String::new, |input| input.name.clone());
        let line = self.file_lines.inputs.get(row).copied().unwrap_or_default();
        Err(UnfitInput { input, line, precision: P::NAME })
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
