//! Bands: how far a run may be from the golden one.
//!
//! `quantity or name => largest distance`. A body's position, velocity and angular velocity are off by the
//! length of the difference, its orientation by the angle of the turn between the two.

use crate::component::Quantity;

/// The largest distances that are accepted, one for each quantity of a body and each recorded value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bands<'a> {
    /// \[m\] of a body's centre of mass.
    pub position: f64,
    /// \[rad\] of the turn between two orientations.
    pub orientation: f64,
    /// \[m/s\].
    pub velocity: f64,
    /// \[rad/s\].
    pub angular_velocity: f64,
    /// \[unit of each\] of recorded values by name; the name of a read-out is that of all its
    /// columns.
    pub values: &'a [(&'a str, f64)],
    /// \[unit of each\] of values that are not named; without it every one must be.
    pub others: Option<f64>,
}

impl<'a> Bands<'a> {
    /// The same number for everything, in SI units.
    #[must_use]
    pub const fn all(band: f64) -> Self {
        Self {
            position: band,
            orientation: band,
            velocity: band,
            angular_velocity: band,
            values: &[],
            others: Some(band),
        }
    }

    /// That of a quantity.
    #[must_use]
    pub const fn of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Position => self.position,
            Quantity::Orientation => self.orientation,
            Quantity::Velocity => self.velocity,
            Quantity::AngularVelocity => self.angular_velocity,
        }
    }

    /// That of a value.
    #[must_use]
    pub fn of_value(&self, name: &str) -> Option<f64> {
        let named = self.values.iter().find(|(of, _)| is_of(name, of));
        named.map(|(_, band)| *band).or(self.others)
    }

    /// The first name with a band that is that of none of these values.
    #[must_use]
    pub fn unknown(&self, values: &[&str]) -> Option<&'a str> {
        let known = |of: &str| values.iter().any(|name| is_of(name, of));
        self.values.iter().map(|(of, _)| *of).find(|of| !known(of))
    }
}

/// Whether a column is that of a read-out, or one of its columns.
fn is_of(column: &str, readout: &str) -> bool {
    column == readout || column.strip_prefix(readout).is_some_and(|end| end.starts_with('.'))
}

/// How a run is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance<'a> {
    /// Bit for bit.
    Bits,
    /// Within bands, in the golden run's own scheme and precision: where what drives the plant does not
    /// have the same bits everywhere.
    Within(Bands<'a>),
    /// Within bands, in whatever scheme and precision.
    AnyMethod(Bands<'a>),
}

impl<'a> Tolerance<'a> {
    /// Its bands.
    #[must_use]
    pub fn bands(&self) -> Option<&Bands<'a>> {
        match self {
            Tolerance::Bits => None,
            Tolerance::Within(bands) | Tolerance::AnyMethod(bands) => Some(bands),
        }
    }
}
