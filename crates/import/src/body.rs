//! One body: its joints, geoms and sites, in its own frame.
//!
//! `attributes => joint, geom, inertial`.

use nalgebra::{Isometry3, Matrix3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::defaults::Attributes;
use crate::error::Fault;
use crate::mass::{Mass, Solid};
use crate::place::{Place, Source};
use crate::settings::{Settings, along};

/// Degrees of freedom of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// Rotation about an axis.
    Hinge,
    /// Translation along an axis.
    Slide,
    /// All rotations.
    Ball,
    /// All six degrees of freedom.
    Free,
}

impl Freedom {
    /// Its number of coordinates in a keyframe.
    pub(crate) fn coordinates(self) -> usize {
        match self {
            Self::Hinge | Self::Slide => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }

    /// Its name in MJCF.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Hinge => "hinge",
            Self::Slide => "slide",
            Self::Ball => "ball",
            Self::Free => "free",
        }
    }

    /// Unit of its coordinate, of a force on it, of its inertia.
    pub(crate) fn units(self) -> [&'static str; 3] {
        match self {
            Self::Slide => ["m", "N", "kg"],
            _ => ["rad", "N·m", "kg·m²"],
        }
    }
}

/// A joint between a body and its parent.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Joint {
    /// Its name, if it has one.
    pub(crate) name: Option<String>,
    /// Its position in the file.
    pub(crate) place: Place,
    /// Its degrees of freedom.
    pub(crate) freedom: Freedom,
    /// \[m\] its anchor in the body's frame.
    pub(crate) anchor: Vector3<f64>,
    /// Its axis in the body's frame.
    pub(crate) axis: Unit<Vector3<f64>>,
    /// \[rad, m\] its coordinate at the file's pose.
    pub(crate) reference: f64,
    /// \[rad, m\] its coordinate where its spring is at rest.
    pub(crate) spring_reference: f64,
    /// \[N·m/rad, N/m\]
    pub(crate) stiffness: f64,
    /// \[N·m·s/rad, N·s/m\]
    pub(crate) damping: f64,
    /// \[rad, m\] range of its coordinate, whether enforced or not.
    pub(crate) range: Option<[f64; 2]>,
    /// Whether the range is enforced.
    pub(crate) limited: bool,
    /// \[N·m, N\] dry friction.
    pub(crate) friction: f64,
    /// \[kg·m², kg\] inertia that an actuator's rotor adds.
    pub(crate) armature: f64,
    /// Whether it is locked at the file's pose.
    pub(crate) locked: bool,
}

impl Joint {
    /// Its name, or else its kind.
    pub(crate) fn called(&self) -> String {
        let word = self.freedom.word();
        self.name.as_ref().map_or(word.to_owned(), |name| format!("{word} `{name}`"))
    }

    /// The joint as an element of the file.
    pub(crate) fn source(&self) -> Source {
        let name = self.name.as_ref().map_or(String::new(), |name| format!(" name=\"{name}\""));
        (format!("<joint{name} type=\"{}\">", self.freedom.word()), self.place)
    }
}

/// Reads a `<joint>`.
pub(crate) fn joint(given: &Attributes<'_>, settings: &Settings) -> Result<Joint, Fault> {
    let freedoms = [Freedom::Hinge, Freedom::Slide, Freedom::Ball, Freedom::Free];
    let word = given.word("type", &freedoms.map(Freedom::word))?;
    let freedom = freedoms[word.unwrap_or(0)];
    let axis = given.vector("axis")?.unwrap_or_else(Vector3::z);
    let axis = Unit::try_new(axis, 1e-150).ok_or_else(|| {
        let place = given.get("axis").map_or(given.element.place, |axis| axis.place);
        Fault::at(place, "`axis` is 0", "expected a vector of nonzero length")
    })?;
    let scaled = |value: f64| if freedom == Freedom::Slide { value } else { settings.angle(value) };
    // Further numbers are coefficients of higher powers; `lacks` reports them.
    let linear = |name: &str| -> Result<f64, Fault> {
        let value = given.numbers(name, 1, 3)?.map_or(0.0, |numbers| numbers[0]);
        if value < 0.0 {
            let place = given.get(name).map_or(given.element.place, |one| one.place);
            return Err(Fault::at(
                place,
                format!("`{name}` is {value:?}"),
                "expected a number ≥ 0",
            ));
        }
        Ok(value)
    };
    let off = |flag: &str, value: f64| if settings.is_off(flag) { 0.0 } else { value };
    Ok(Joint {
        name: given.element.text("name").map(str::to_owned),
        place: given.element.place,
        freedom,
        anchor: given.vector("pos")?.unwrap_or_default(),
        axis,
        reference: scaled(given.number("ref")?.unwrap_or(0.0)),
        spring_reference: scaled(given.number("springref")?.unwrap_or(0.0)),
        stiffness: off("spring", linear("stiffness")?),
        damping: off("damper", linear("damping")?),
        range: given.numbers("range", 2, 2)?.map(|range| [scaled(range[0]), scaled(range[1])]),
        limited: given.limited("limited", "range", settings.automatic_limits)?
            && !settings.is_off("limit"),
        friction: off("frictionloss", given.magnitude("frictionloss", 0.0)?),
        armature: given.magnitude("armature", 0.0)?,
        locked: false,
    })
}

/// The joint of a `<freejoint>`.
pub(crate) fn free_joint(name: Option<&str>, place: Place) -> Joint {
    Joint {
        name: name.map(str::to_owned),
        place,
        freedom: Freedom::Free,
        anchor: Vector3::zeros(),
        axis: Vector3::z_axis(),
        reference: 0.0,
        spring_reference: 0.0,
        stiffness: 0.0,
        damping: 0.0,
        range: None,
        limited: false,
        friction: 0.0,
        armature: 0.0,
        locked: false,
    }
}

/// A geom.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Geom {
    /// Its shape; `None` where the file does not determine a volume.
    pub(crate) solid: Option<Solid>,
    /// Its `type`, or the source of its shape.
    pub(crate) word: &'static str,
    /// Its mesh.
    pub(crate) mesh: Option<String>,
    /// Its pose in the body's frame.
    pub(crate) pose: Isometry3<f64>,
}

const TYPES: [&str; 9] =
    ["sphere", "plane", "hfield", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"];

/// Reads a `<geom>`.
pub(crate) fn geom(given: &Attributes<'_>, settings: &Settings) -> Result<Geom, Fault> {
    let word = TYPES[given.word("type", &TYPES)?.unwrap_or(0)];
    let mut pose = settings.pose(given)?;
    // A shape fitted to a mesh gets its size from the mesh.
    if given.get("mesh").is_some() || matches!(word, "plane" | "hfield" | "mesh" | "sdf") {
        let mesh = given.text("mesh").filter(|_| word == "mesh").map(str::to_owned);
        let word = if given.get("mesh").is_some() { "mesh" } else { word };
        return Ok(Geom { solid: None, word, mesh, pose });
    }
    let needed = match word {
        "sphere" => 1,
        "capsule" | "cylinder" => 2,
        _ => 3,
    };
    let ends = given.numbers("fromto", 6, 6)?.filter(|_| word != "sphere");
    let mut size = given.numbers("size", 1, 3)?.unwrap_or_default();
    if let Some(ends) = ends {
        let [from, to] = [&ends[..3], &ends[3..]].map(Vector3::from_column_slice);
        let Some(direction) = Unit::try_new(to - from, 1e-150) else {
            let help = "give two different points";
            return Err(Fault::at(given.place("fromto"), "`fromto` has zero length", help));
        };
        pose = Isometry3::from_parts(Translation3::from((from + to) * 0.5), along(&direction));
        let half = (to - from).norm() * 0.5;
        size.truncate(1);
        size = match (size.first(), needed) {
            (Some(radius), 2) => vec![*radius, half],
            (Some(radius), _) => vec![*radius, *radius, half],
            (None, _) => Vec::new(),
        };
    }
    if size.len() < needed || size.iter().take(needed).any(|size| *size <= 0.0) {
        let place = given.get("size").map_or(given.element.place, |size| size.place);
        let message = format!("`size` of a {word} is {size:?}");
        return Err(Fault::at(
            place,
            message,
            format!("expected {needed} numbers > 0, or fewer with `fromto`"),
        ));
    }
    let solid = match word {
        "sphere" => Solid::Sphere(size[0]),
        "capsule" => Solid::Capsule(size[0], size[1]),
        "cylinder" => Solid::Cylinder(size[0], size[1]),
        "ellipsoid" => Solid::Ellipsoid([size[0], size[1], size[2]]),
        _ => Solid::Box([size[0], size[1], size[2]]),
    };
    Ok(Geom { solid: Some(solid), word, mesh: None, pose })
}

/// Reads an `<inertial>`.
pub(crate) fn inertial(given: &Attributes<'_>, settings: &Settings) -> Result<Mass, Fault> {
    let place = given.element.place;
    let Some(mass) = given.number("mass")?.filter(|mass| *mass >= 0.0) else {
        return Err(Fault::at(place, "<inertial> has no `mass` ≥ 0", "give mass=\"…\" in kg"));
    };
    if given.get("pos").is_none() {
        return Err(Fault::at(
            place,
            "<inertial> has no `pos`",
            "give pos=\"x y z\", the centre of mass",
        ));
    }
    let frame = settings.pose(given)?;
    let diagonal = given.numbers("diaginertia", 3, 3)?;
    let Some(full) = given.numbers("fullinertia", 6, 6)? else {
        let moments = diagonal.unwrap_or_else(|| vec![0.0; 3]);
        return Ok(Mass::principal(mass, [moments[0], moments[1], moments[2]], &frame));
    };
    if diagonal.is_some() || frame.rotation != UnitQuaternion::identity() {
        let message = "`fullinertia` conflicts with `diaginertia` or an orientation";
        return Err(Fault::at(given.place("fullinertia"), message, "give only one of them"));
    }
    let [xx, yy, zz, xy, xz, yz] = [full[0], full[1], full[2], full[3], full[4], full[5]];
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    Ok(Mass::tensor(mass, &tensor, &frame))
}
