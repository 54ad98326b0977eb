//! Coordinates of hinges, slides and tendons, on which springs, dampers and inputs act.
//!
//! `joints, tendons => coordinates; laws`. A law is the force along its coordinate, `stiffness·(rest − x) + bias −
//! damping·x'`, with x relative to the start of the scene.

use nalgebra::Vector3;

use crate::part::Side;

/// A linear force along a coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Law {
    /// \[N·m/rad, N/m\]
    pub(crate) stiffness: f64,
    /// \[N·m·s/rad, N·s/m\]
    pub(crate) damping: f64,
    /// \[rad, m\] rest position of the spring.
    pub(crate) rest: f64,
    /// \[N·m, N\] constant force.
    pub(crate) bias: f64,
}

impl Law {
    /// Whether it exerts no force.
    pub(crate) fn is_none(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0 && self.bias == 0.0
    }

    /// \[rad, m\] where its force except damping is 0; `rest` without stiffness.
    pub(crate) fn zero(&self) -> f64 {
        if self.bias == 0.0 { self.rest } else { self.rest + self.bias / self.stiffness }
    }
}

/// A coordinate, in world axes at the start of the scene.
#[derive(Clone, Debug)]
pub(crate) enum Coordinate {
    /// Rotation of the second body relative to the first.
    Turn {
        /// The joint, and which of its axes; none: no joint connects the bodies.
        joint: Option<(String, Option<&'static str>)>,
        /// The bodies; the axis is fixed in the first.
        between: [Side; 2],
        /// Its axis.
        axis: Vector3<f64>,
        /// Whether the axis is fixed in the second body.
        is_of_second: bool,
    },
    /// Translation of the second body along an axis of the first.
    Slide {
        /// The joint, and whether its travel is the opposite of the coordinate; none: no joint has this coordinate.
        joint: Option<(String, bool)>,
        /// The bodies.
        between: [Side; 2],
        /// \[m\] a point of the second on the axis.
        at: Vector3<f64>,
        /// The axis.
        axis: Vector3<f64>,
        /// \[m\] travel.
        travel: f64,
    },
    /// The distance of two points.
    Length {
        /// The bodies.
        between: [Side; 2],
        /// \[m\] the points.
        points: [Vector3<f64>; 2],
    },
    /// Translation of a part in the plane of a planar scene.
    Shift {
        /// The part.
        part: usize,
        /// \[m\] the translated point.
        at: Vector3<f64>,
        /// Direction of translation.
        axis: Vector3<f64>,
        /// Its normal in the plane.
        across: Vector3<f64>,
    },
    /// Translation of the second body along an axis of the first, beside another translation.
    Level {
        /// The bodies.
        between: [Side; 2],
        /// \[m\] the translated point.
        at: Vector3<f64>,
        /// Direction of translation.
        axis: Vector3<f64>,
        /// Direction of the other translation, perpendicular to it.
        across: Vector3<f64>,
    },
}

impl Coordinate {
    /// Unit of a force along it, of an inertia.
    pub(crate) fn units(&self) -> [&'static str; 2] {
        match self {
            Self::Turn { .. } => ["N·m", "kg·m²"],
            _ => ["N", "kg"],
        }
    }

    /// Whether an input acts along a TSDA.
    pub(crate) fn needs_line(&self) -> bool {
        matches!(self, Self::Slide { joint: None, .. } | Self::Length { .. })
    }
}
