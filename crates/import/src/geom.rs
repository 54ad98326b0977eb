//! Geoms beside their mass: what might touch another, what can be seen.

use nalgebra::Isometry3;

use crate::defaults::Attributes;
use crate::error::Fault;
use crate::mass::Solid;
use crate::place::Place;

/// A geom that might touch another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    /// Its body.
    pub(crate) body: usize,
    /// Where it stands.
    pub(crate) place: Place,
    /// What it is, in words.
    pub(crate) words: String,
    /// The bits that it shows to others.
    pub(crate) kind: u32,
    /// The bits of others that it meets.
    pub(crate) affinity: u32,
}

/// A geom that can be seen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    /// Its body.
    pub(crate) body: usize,
    /// What it is; its axis is z.
    pub(crate) solid: Solid,
    /// Its pose in the frame of its body.
    pub(crate) pose: Isometry3<f64>,
    /// `#rrggbb`, where it is given.
    pub(crate) colour: Option<String>,
    /// Where it stands.
    pub(crate) place: Place,
    /// What it is, in words.
    pub(crate) words: String,
}

impl Look {
    /// What can be seen of a geom; nothing where it is transparent.
    ///
    /// # Errors
    /// Where its colour is none.
    pub(crate) fn of(
        given: &Attributes<'_>,
        body: usize,
        solid: Solid,
        pose: Isometry3<f64>,
        words: &str,
    ) -> Result<Option<Self>, Fault> {
        // A colour moves nothing: one that cannot be read is left to the picture's default.
        let rgba = given.numbers("rgba", 4, 4).ok().flatten();
        if rgba.as_ref().is_some_and(|rgba| rgba[3] <= 0.0) {
            return Ok(None);
        }
        let digits = |part: &f64| format!("{:02x}", (255.0 * part.clamp(0.0, 1.0)).round() as u8);
        let colour = rgba.map(|rgba| {
            rgba.iter().take(3).map(digits).fold("#".to_owned(), |all, part| all + &part)
        });
        let (place, words) = (given.element.place, words.to_owned());
        Ok(Some(Self { body, solid, pose, colour, place, words }))
    }
}
