//! Bands as text: `1e-6`, `position=1e-6,orientation=1e-5,velocity=1e-3,angular-velocity=1e-2,angle=1e-4`.
//!
//! `text => bands`. A number alone applies to everything not named in the list.

use std::borrow::ToOwned as _;
use std::format;
use std::str::FromStr;
use std::string::{String, ToString as _};
use std::vec::Vec;

use crate::bands::Bands;
use crate::component::Quantity;

/// Bands that own their names.
#[derive(Clone, Debug, PartialEq)]
pub struct BandList {
    /// In the order of [`Quantity::ALL`].
    quantities: [f64; 4],
    values: Vec<(String, f64)>,
    others: Option<f64>,
}

impl BandList {
    /// The bands with borrowed names.
    pub fn with<A>(&self, look: impl FnOnce(Bands<'_>) -> A) -> A {
        let values: Vec<(&str, f64)> =
            self.values.iter().map(|(name, band)| (name.as_str(), *band)).collect();
        let [position, orientation, velocity, angular_velocity] = self.quantities;
        let others = self.others;
        let values = &values[..];
        look(Bands { position, orientation, velocity, angular_velocity, values, others })
    }
}

/// An error in a text of bands.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BandListError(String);

impl FromStr for BandList {
    type Err = BandListError;

    fn from_str(text: &str) -> Result<Self, BandListError> {
        let refused = |what: String| Err(BandListError(what));
        let (mut named, mut others) = (Vec::<(String, f64)>::new(), None);
        for part in text.split(',') {
            let (name, number) = match part.rsplit_once('=') {
                Some((name, number)) => (Some(name.trim()), number.trim()),
                None => (None, part.trim()),
            };
            let band = number.parse::<f64>().ok().filter(|band| *band >= 0.0 && band.is_finite());
            let Some(band) = band else {
                return refused(format!(
                    "`{number}` is not a valid band: give a finite number ≥ 0"
                ));
            };
            match name {
                Some(name) if named.iter().any(|(of, _)| of == name) => {
                    return refused(format!("`{name}` has two bands: give one"));
                }
                Some(name) => named.push((name.to_owned(), band)),
                None if others.is_some() => {
                    return refused("two numbers without a name: give one".to_string());
                }
                None => others = Some(band),
            }
        }
        let mut quantities = [0.0; 4];
        for (place, quantity) in quantities.iter_mut().zip(Quantity::ALL) {
            let own = named.iter().position(|(of, _)| of == quantity.name());
            match own.map(|own| named.remove(own).1).or(others) {
                Some(band) => *place = band,
                None => {
                    let (name, unit) = (quantity.name(), quantity.unit());
                    return refused(format!(
                        "no band for the {name}: give `{name}=…` ({unit}), or a single number for all"
                    ));
                }
            }
        }
        Ok(Self { quantities, values: named, others })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_read() {
        let all: BandList = "1e-6".parse().unwrap();
        all.with(|bands| assert_eq!(bands, Bands::all(1e-6)));
        let text = "position=1e-6, orientation=2e-6,velocity=3e-6,angular-velocity=4e-6,tool=5";
        let list: BandList = text.parse().unwrap();
        list.with(|bands| {
            assert_eq!((bands.position, bands.orientation), (1e-6, 2e-6));
            assert_eq!((bands.velocity, bands.angular_velocity), (3e-6, 4e-6));
            assert_eq!((bands.of_value("tool.x"), bands.of_value("tools")), (Some(5.0), None));
        });
        let mixed: BandList = "1e-6,angle=1e-3".parse().unwrap();
        mixed.with(|bands| {
            assert_eq!((bands.of_value("angle"), bands.of_value("b")), (Some(1e-3), Some(1e-6)));
        });
    }

    #[test]
    fn what_is_no_band_is_refused_with_its_reason() {
        for (text, why) in [
            ("", "`` is not a valid band"),
            ("-1", "`-1` is not a valid band"),
            ("nan", "`nan` is not a valid band"),
            ("inf", "`inf` is not a valid band"),
            ("1,2", "two numbers"),
            ("1,angle=1,angle=2", "`angle` has two bands"),
            ("position=1", "no band for the orientation"),
            ("position=x", "`x` is not a valid band"),
        ] {
            let refused = text.parse::<BandList>().unwrap_err().to_string();
            assert!(refused.contains(why), "{text}: {refused}");
        }
    }
}
