//! Errors of the builder: why an element could not be added.

use crate::index::BodyIndex;

/// Why an element could not be added; the builder is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
#[non_exhaustive]
pub enum BuildError {
    /// The capacity for this part is used up.
    Full(Part),
    /// No such body.
    UnknownBody(BodyIndex),
    /// An element between a body and itself.
    SameBody(BodyIndex),
    /// A quantity outside of its range, or not finite.
    OutOfRange(Quantity),
}

/// The lists of limited capacity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Part {
    /// Bodies.
    Bodies,
    /// Groups.
    Groups,
    /// Points.
    Points,
    /// TSDAs.
    Tsdas,
    /// Point bushings.
    Bushings,
    /// Damping coefficients.
    Dampers,
    /// Torsion springs.
    Torsions,
    /// Loads.
    Loads,
    /// Points on lines.
    Lines,
    /// Inputs.
    Inputs,
    /// Knots of tables.
    Knots,
    /// Revolute joints of bushings.
    Revolutes,
    /// Universal joints.
    Universals,
}

/// The quantities that can be out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Quantity {
    /// Mass: positive.
    Mass,
    /// Principal inertia: positive, each at most the sum of the other two.
    Inertia,
    /// A position, orientation or velocity: finite.
    State,
    /// Gravity: finite.
    Gravity,
    /// A point: finite.
    Point,
    /// Stiffness: finite, not negative.
    Stiffness,
    /// Damping: finite, not negative.
    Damping,
    /// Free length: finite, not negative.
    FreeLength,
    /// Clearance: finite, not negative; not supported by point bushings.
    Clearance,
    /// An axis: finite and not 0.
    Axis,
    /// A preload, force or torque: finite.
    Load,
    /// A window of time that ends before it begins, or NaN.
    Window,
    /// A joint's points: one or more centres, each with one leg or three, shared or separate.
    Arms,
}

impl core::fmt::Display for BuildError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            BuildError::Full(part) => write!(f, "capacity exceeded: {part:?}"),
            BuildError::UnknownBody(body) => write!(f, "unknown body {}", body.0),
            BuildError::SameBody(body) => write!(f, "an element joins body {} to itself", body.0),
            BuildError::OutOfRange(quantity) => write!(f, "{quantity:?} is out of range"),
        }
    }
}

impl core::error::Error for BuildError {}
