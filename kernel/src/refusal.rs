//! Why a plant, the value of an input or a state was refused.
//!
//! `condition => error that names it`. Each is a few bytes, without text; the text is made where it is
//! shown.

use crate::extents::Excess;
use crate::index::{BodyIndex, InputIndex};

/// Why a plant could not be made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum PlantError {
    /// The step is not a positive finite number in the model's precision.
    Step(f64),
    /// A part of the model is beyond what the precision holds.
    Extent(Excess),
    /// The scheme has a matrix, and the model no plan for it, or that of another one; see
    /// [`Planned`](crate::model::Planned).
    Plan,
    /// The step is longer than the precision bears for joints as stiff as the model's: at most so many \[s\].
    Stiff(f64),
    /// The scheme cannot bring on the memory of the law of this name: it steps back in time, or evaluates more than
    /// once per step.
    Memory(&'static str),
}

impl core::fmt::Display for PlantError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            PlantError::Step(step) => {
                write!(f, "the step must be a positive finite time, not {step} s")
            }
            PlantError::Extent(excess) => excess.fmt(f),
            PlantError::Plan => f.write_str("the model has no plan of elimination for the scheme"),
            PlantError::Memory(law) => {
                write!(f, "the scheme cannot bring on what a law `{law}` remembers")
            }
            PlantError::Stiff(most) => {
                write!(
                    f,
                    "joints as stiff as these bear a step of {most} s at most in this precision"
                )
            }
        }
    }
}

impl core::error::Error for PlantError {}

/// Why an input could not be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum InputError {
    /// The model has no such input.
    Unknown(InputIndex),
    /// A table or another source of the scene drives it.
    Table(InputIndex),
    /// The value is infinite or not a number in the model's precision.
    NotFinite(InputIndex),
    /// The ground would be moved farther than the precision holds.
    Extent(InputIndex),
}

impl core::fmt::Display for InputError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            InputError::Unknown(input) => write!(f, "the model has no input {}", input.0),
            InputError::Table(input) => {
                write!(f, "input {} follows a table or another source", input.0)
            }
            InputError::NotFinite(input) => write!(f, "input {}: the value is not finite", input.0),
            InputError::Extent(input) => {
                write!(f, "input {}: fixed-point numbers do not hold the displacement", input.0)
            }
        }
    }
}

impl core::error::Error for InputError {}

/// Why a plant could not take a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum StateError {
    /// It has another number of bodies, torsion springs or inputs than the model.
    Count,
    /// A number of this body is infinite or not a number.
    NotFinite(BodyIndex),
    /// This body is farther from the origin than the precision holds.
    Extent(BodyIndex),
    /// The orientation of this body is no unit quaternion within 1e-3.
    Orientation(BodyIndex),
    /// This body leaves the plane that the model lies in.
    OffPlane(BodyIndex),
    /// The signal of this input is infinite, not a number or beyond what the precision holds.
    Signal(InputIndex),
    /// What a law remembers is infinite or not a number.
    Law,
}

impl core::fmt::Display for StateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            StateError::Count => {
                write!(f, "the state has other counts of bodies, springs or inputs than the model")
            }
            StateError::NotFinite(body) => {
                write!(f, "the state of body {} is not finite", body.0)
            }
            StateError::Extent(body) => {
                write!(f, "body {} is farther away than fixed-point numbers hold", body.0)
            }
            StateError::Orientation(body) => {
                write!(f, "the orientation of body {} is no unit quaternion", body.0)
            }
            StateError::OffPlane(body) => {
                write!(f, "the state of body {} leaves the plane of the model", body.0)
            }
            StateError::Law => f.write_str("what a law remembers is not finite"),
            StateError::Signal(input) => write!(f, "the signal of input {} is not finite", input.0),
        }
    }
}

impl core::error::Error for StateError {}
