//! Why a plant, the value of an input or a state was refused.
//!
//! `condition => error that names it`. Each is a few bytes, without text; the text is made when it is displayed.

use crate::extents::Excess;
use crate::index::{BodyIndex, InputIndex};

/// Why a plant could not be created.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum PlantError {
    /// The step is not a positive finite number in the model's precision.
    Step(f64),
    /// A part of the model is out of the precision's range.
    Extent(Excess),
    /// The scheme has a matrix, and the model has no elimination order or one that does not fit; see
    /// [`Planned`](crate::model::Planned).
    Plan,
    /// The step is longer than the precision allows for joints as stiff as the model's; the longest allowed step \[s\].
    Stiff(f64),
    /// The scheme does not support the memory of the law of this name: it steps back in time, or evaluates more than
    /// once per step.
    Memory(&'static str),
    /// The scheme does not support driven bodies, as this one.
    Driven(BodyIndex),
}

impl core::fmt::Display for PlantError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            PlantError::Step(step) => {
                write!(f, "the step must be a positive finite time, not {step} s")
            }
            PlantError::Extent(excess) => excess.fmt(f),
            PlantError::Plan => f.write_str("the model has no elimination order for this scheme"),
            PlantError::Memory(law) => {
                write!(f, "the scheme does not support the memory of law `{law}`")
            }
            PlantError::Driven(body) => {
                write!(f, "the scheme does not support driven bodies, as body {}", body.0)
            }
            PlantError::Stiff(most) => {
                write!(
                    f,
                    "the joints are too stiff for this step; this precision allows at most {most} s"
                )
            }
        }
    }
}

impl core::error::Error for PlantError {}

/// Why an input could not be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[non_exhaustive]
pub enum InputError {
    /// The model has no such input.
    Unknown(InputIndex),
    /// A table or another source of the scene drives it.
    Table(InputIndex),
    /// The value is infinite or not a number in the model's precision.
    NotFinite(InputIndex),
    /// The displacement of the ground is out of the precision's range.
    Extent(InputIndex),
}

impl core::fmt::Display for InputError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            InputError::Unknown(input) => write!(f, "the model has no input {}", input.0),
            InputError::Table(input) => {
                write!(f, "input {} is driven by a table or a source and cannot be set", input.0)
            }
            InputError::NotFinite(input) => write!(f, "input {}: the value is not finite", input.0),
            InputError::Extent(input) => {
                write!(f, "input {}: the displacement exceeds the fixed-point range", input.0)
            }
        }
    }
}

impl core::error::Error for InputError {}

/// Why a state could not be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[non_exhaustive]
pub enum StateError {
    /// It differs from the model in the number of bodies, torsion springs or inputs.
    Count,
    /// A number of this body is infinite or not a number.
    NotFinite(BodyIndex),
    /// The position of this body is out of the precision's range.
    Extent(BodyIndex),
    /// The orientation of this body is not a unit quaternion within 1e-3.
    Orientation(BodyIndex),
    /// This body is not in the plane of the model.
    OffPlane(BodyIndex),
    /// The signal of this input is infinite, not a number or out of the precision's range.
    Signal(InputIndex),
    /// The memory of a law is infinite or not a number.
    Law,
}

impl core::fmt::Display for StateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            StateError::Count => {
                write!(
                    f,
                    "the state and the model differ in the number of bodies, springs or inputs"
                )
            }
            StateError::NotFinite(body) => {
                write!(f, "the state of body {} is not finite", body.0)
            }
            StateError::Extent(body) => {
                write!(f, "the position of body {} exceeds the fixed-point range", body.0)
            }
            StateError::Orientation(body) => {
                write!(f, "the orientation of body {} is not a unit quaternion", body.0)
            }
            StateError::OffPlane(body) => {
                write!(f, "the state of body {} is not in the plane of the model", body.0)
            }
            StateError::Law => f.write_str("the memory of a law is not finite"),
            StateError::Signal(input) => write!(f, "the signal of input {} is not finite", input.0),
        }
    }
}

impl core::error::Error for StateError {}
