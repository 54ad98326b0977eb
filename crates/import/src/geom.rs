//! Geoms beside their mass: what might touch another, what can be seen.

use nalgebra::{Isometry3, Vector3};

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
    /// Its name.
    pub(crate) name: Option<String>,
    /// What it is.
    pub(crate) form: Form,
    /// Its pose in the frame of its body.
    pub(crate) pose: Isometry3<f64>,
    /// How it rubs.
    pub(crate) grip: Grip,
}

/// The form of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// A half-space below its z axis.
    Plane,
    /// A solid; its axis is z.
    Solid(Solid),
    /// Any other.
    Other,
}

impl Form {
    /// Spheres and points by which it meets a plane: places in its axes \[m\] and radii \[m\]; none where it is no
    /// sphere, capsule or box.
    pub(crate) fn spheres(self) -> Vec<(Vector3<f64>, f64)> {
        match self {
            Self::Solid(Solid::Sphere(radius)) => vec![(Vector3::zeros(), radius)],
            Self::Solid(Solid::Capsule(radius, half)) => {
                [-half, half].map(|z| (Vector3::new(0.0, 0.0, z), radius)).to_vec()
            }
            Self::Solid(Solid::Box([x, y, z])) => {
                let signs = [-1.0, 1.0];
                let corners = signs.iter().flat_map(|i| signs.iter().map(move |j| (i, j)));
                corners
                    .flat_map(|(i, j)| signs.map(|k| (Vector3::new(i * x, j * y, k * z), 0.0)))
                    .collect()
            }
            Self::Plane | Self::Solid(_) | Self::Other => Vec::new(),
        }
    }
}

/// How a surface rubs on another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grip {
    /// Whose friction counts: the higher, both where they are equal.
    priority: f64,
    /// What of the friction counts: nothing at 1, rolling at 6.
    dimension: f64,
    /// \[1, m\] coefficients of friction, of rolling resistance.
    friction: [f64; 2],
    /// \[m\] by how much it is felt farther out.
    margin: f64,
}

impl Grip {
    /// That of a geom or, with `[0, 3]` as the places of its coefficients, of a pair.
    ///
    /// # Errors
    /// Where a value is no number.
    pub(crate) fn of(given: &Attributes<'_>, [slide, roll]: [usize; 2]) -> Result<Self, Fault> {
        let friction = given.numbers("friction", 1, 5)?.unwrap_or_default();
        let part = |place: usize, default| friction.get(place).copied().unwrap_or(default);
        Ok(Self {
            priority: given.number("priority")?.unwrap_or(0.0),
            dimension: given.magnitude("condim", 3.0)?,
            friction: [part(slide, 1.0), part(roll, 1e-4)],
            margin: given.number("margin")?.unwrap_or(0.0) - given.number("gap")?.unwrap_or(0.0),
        })
    }

    /// That of two surfaces.
    pub(crate) fn and(self, other: Self) -> Self {
        // Whatever the priority, a margin is that of both.
        let margin = self.margin.max(other.margin);
        if self.priority != other.priority {
            let decides = if self.priority > other.priority { self } else { other };
            return Self { margin, ..decides };
        }
        let most = |i: usize| self.friction[i].max(other.friction[i]);
        Self {
            priority: self.priority,
            dimension: self.dimension.max(other.dimension),
            friction: [most(0), most(1)],
            margin,
        }
    }

    /// \[1\] coefficient of friction.
    pub(crate) fn friction(&self) -> f64 {
        if self.dimension > 1.0 { self.friction[0] } else { 0.0 }
    }

    /// \[m\] moment of rolling resistance over the normal force.
    pub(crate) fn rolling(&self) -> f64 {
        if self.dimension > 4.0 { self.friction[1] } else { 0.0 }
    }

    /// \[m\] by how much the surfaces are felt farther out.
    pub(crate) fn margin(&self) -> f64 {
        self.margin
    }
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
