//! Meaning of a number of a sample: body or read-out, quantity, unit.
//!
//! `column => name, unit`. The text type is generic, so that the same code serves a target, where names are borrowed,
//! and a PC, where they are owned.

use core::fmt::{self, Display};

/// Ends of a body's columns, after its name.
pub(crate) const ENDS: [&str; 13] =
    [".x", ".y", ".z", ".qw", ".qx", ".qy", ".qz", ".vx", ".vy", ".vz", ".wx", ".wy", ".wz"];

/// A quantity of a body, which has a band.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// \[m\].
    Position,
    /// \[rad\].
    Orientation,
    /// \[m/s\].
    Velocity,
    /// \[rad/s\].
    AngularVelocity,
}

impl Quantity {
    /// All of them, in the order of a body's columns.
    pub const ALL: [Quantity; 4] =
        [Quantity::Position, Quantity::Orientation, Quantity::Velocity, Quantity::AngularVelocity];

    /// The quantity of one of the 13 columns of a body.
    #[must_use]
    pub const fn of_column(column: usize) -> Self {
        match column {
            0..3 => Quantity::Position,
            3..7 => Quantity::Orientation,
            7..10 => Quantity::Velocity,
            _ => Quantity::AngularVelocity,
        }
    }

    /// Its columns among the 13 of a body.
    #[must_use]
    pub const fn columns(self) -> core::ops::Range<usize> {
        match self {
            Quantity::Position => 0..3,
            Quantity::Orientation => 3..7,
            Quantity::Velocity => 7..10,
            Quantity::AngularVelocity => 10..13,
        }
    }

    /// Its name, as on a command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Position => "position",
            Quantity::Orientation => "orientation",
            Quantity::Velocity => "velocity",
            Quantity::AngularVelocity => "angular-velocity",
        }
    }

    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Quantity::Position => "m",
            Quantity::Orientation => "rad",
            Quantity::Velocity => "m/s",
            Quantity::AngularVelocity => "rad/s",
        }
    }
}

/// A column of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component<N> {
    /// A number of a body.
    Body {
        /// The body's name.
        body: N,
        /// Which of its 13 numbers, from 0.
        column: usize,
    },
    /// A turn count.
    Turns {
        /// The torsion spring's index.
        spring: usize,
    },
    /// A read-out, an input or another number that was recorded.
    Value {
        /// Its name.
        name: N,
    },
    /// A stored word without a column.
    State,
}

impl<N> Component<N> {
    /// Its quantity, if it belongs to a body.
    #[must_use]
    pub fn quantity(&self) -> Option<Quantity> {
        match self {
            Component::Body { column, .. } => Some(Quantity::of_column(*column)),
            _ => None,
        }
    }

    /// The same with another text type for its name.
    pub fn map<M>(self, with: &mut impl FnMut(N) -> M) -> Component<M> {
        match self {
            Component::Body { body, column } => Component::Body { body: with(body), column },
            Component::Turns { spring } => Component::Turns { spring },
            Component::Value { name } => Component::Value { name: with(name) },
            Component::State => Component::State,
        }
    }
}

impl<N: Display> Display for Component<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Component::Body { body, column } => {
                write!(f, "{body}{}", ENDS.get(*column).unwrap_or(&""))
            }
            Component::Turns { spring } => write!(f, "turns.{spring}"),
            Component::Value { name } => name.fmt(f),
            Component::State => f.write_str("the stored state"),
        }
    }
}
