//! Geoms apart from their mass: contact surfaces and visible shapes.

use nalgebra::{Isometry3, Vector3};

use crate::defaults::Attributes;
use crate::error::Fault;
use crate::mass::Solid;
use crate::notation::number;
use crate::place::Place;

/// A geom that might touch another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    /// Its body.
    pub(crate) body: usize,
    /// Its position in the file.
    pub(crate) place: Place,
    /// Description.
    pub(crate) words: String,
    /// `contype` bits.
    pub(crate) kind: u32,
    /// `conaffinity` bits.
    pub(crate) affinity: u32,
    /// Its name.
    pub(crate) name: Option<String>,
    /// Its form.
    pub(crate) form: Form,
    /// Its pose in the frame of its body.
    pub(crate) pose: Isometry3<f64>,
    /// Its friction.
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
    /// Spheres and points that contact a plane: positions in its axes \[m\] and radii \[m\]; none unless it is a
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

/// Friction of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grip {
    /// Priority: the friction of the higher one applies, of both if equal.
    priority: f64,
    /// `condim`: 1 without friction, 6 with rolling resistance.
    dimension: f64,
    /// \[1, m\] coefficients of friction, of rolling resistance.
    friction: [f64; 2],
    /// \[m\] contact margin.
    margin: f64,
}

impl Grip {
    /// The friction of a geom or, with `[0, 3]` as the indices of its coefficients, of a pair.
    ///
    /// # Errors
    /// If a value is not a number.
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

    /// The friction of two surfaces.
    pub(crate) fn and(self, other: Self) -> Self {
        // The margin is that of both, regardless of priority.
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

    /// The keys of a contact with this tangential damping \[N·s/m\], each `key = value`.
    pub(crate) fn keys(&self, damping: f64) -> Vec<String> {
        let [friction, rolling] = self.friction;
        let mut keys = Vec::new();
        if self.dimension > 1.0 && friction > 0.0 {
            keys.push(format!("friction = {}\ndamping = {}", number(friction), number(damping)));
        }
        if self.dimension > 4.0 && rolling > 0.0 {
            keys.push(format!("rolling = {}", number(rolling)));
        }
        keys
    }

    /// \[m\] contact margin.
    pub(crate) fn margin(&self) -> f64 {
        self.margin
    }
}

/// A visible geom.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    /// Its body.
    pub(crate) body: usize,
    /// Its solid; its axis is z.
    pub(crate) solid: Solid,
    /// Its pose in the frame of its body.
    pub(crate) pose: Isometry3<f64>,
    /// `#rrggbb`, if given.
    pub(crate) colour: Option<String>,
    /// Its position in the file.
    pub(crate) place: Place,
    /// Description.
    pub(crate) words: String,
}

impl Look {
    /// The visible shape of a geom; none if it is transparent.
    ///
    /// # Errors
    /// If its colour is invalid.
    pub(crate) fn of(
        given: &Attributes<'_>,
        body: usize,
        solid: Solid,
        pose: Isometry3<f64>,
        words: &str,
    ) -> Result<Option<Self>, Fault> {
        // A colour does not affect the motion: an invalid one is replaced by the default.
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
