//! Bands: allowed distance of a run from the golden one.
//!
//! `quantity or name => largest distance`. The distance of a body's position, velocity and angular velocity is the
//! length of the difference, that of its orientation the angle of the rotation between the two.

use crate::component::Quantity;

/// The largest accepted distances, one for each quantity of a body and each recorded value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bands<'a> {
    /// \[m\] of a body's centre of mass.
    pub position: f64,
    /// \[rad\] of the rotation between two orientations.
    pub orientation: f64,
    /// \[m/s\].
    pub velocity: f64,
    /// \[rad/s\].
    pub angular_velocity: f64,
    /// \[unit of each\] of recorded values by name; the name of a read-out is that of all its
    /// columns.
    pub values: &'a [(&'a str, f64)],
    /// \[unit of each\] of values not named; without it every value must be named.
    pub others: Option<f64>,
}

impl<'a> Bands<'a> {
    /// The same number for all, in SI units.
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

    /// The band of a quantity.
    #[must_use]
    pub const fn of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Position => self.position,
            Quantity::Orientation => self.orientation,
            Quantity::Velocity => self.velocity,
            Quantity::AngularVelocity => self.angular_velocity,
        }
    }

    /// The band of a value.
    #[must_use]
    pub fn of_value(&self, name: &str) -> Option<f64> {
        let named = self.values.iter().find(|(of, _)| is_of(name, of));
        named.map(|(_, band)| *band).or(self.others)
    }

    /// The first name with a band that matches none of these values.
    #[must_use]
    pub fn unknown(&self, values: &[&str]) -> Option<&'a str> {
        let known = |of: &str| values.iter().any(|name| is_of(name, of));
        self.values.iter().map(|(of, _)| *of).find(|of| !known(of))
    }
}

/// Whether a column belongs to a read-out.
fn is_of(column: &str, readout: &str) -> bool {
    column == readout || column.strip_prefix(readout).is_some_and(|end| end.starts_with('.'))
}

/// How a run is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance<'a> {
    /// Bit for bit.
    Bits,
    /// Within bands, in the golden run's scheme and precision: for plants whose driver is not bit-identical everywhere.
    Within(Bands<'a>),
    /// Within bands, in any scheme and precision.
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
