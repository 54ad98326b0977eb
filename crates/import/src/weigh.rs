//! The mass of a body: from its `<inertial>`, else from its geoms.
//!
//! `geoms, meshes, <inertial> => mass of a body`. Which source applies is known once all are read.

use nalgebra::Isometry3;

use crate::body;
use crate::defaults::Defaults;
use crate::element::Element;
use crate::error::Fault;
use crate::geom::{Form, Grip, Look, Surface};
use crate::mass::Mass;
use crate::mesh::{Meshes, REMEDY};
use crate::omission::{Kind, Omissions};
use crate::place::Place;
use crate::settings::{InertiaSource, Settings};

/// Masses of a body, before the source is selected.
#[derive(Default)]
pub(crate) struct Masses {
    /// From an `<inertial>`.
    pub(crate) inertial: Option<(Mass, Place)>,
    geoms: Vec<(Weight, Place, String)>,
}

/// The mass of a geom.
enum Weight {
    /// Known.
    Known(Mass),
    /// A mesh at a pose, with a mass or a density.
    Mesh(String, Isometry3<f64>, Option<f64>, f64),
    /// Unknown, with the reason.
    Unknown(&'static str),
}

/// Context of an element.
#[derive(Clone, Copy)]
pub(crate) struct Within<'w> {
    /// Its body.
    pub(crate) body: usize,
    /// The default class there.
    pub(crate) class: &'w str,
    /// Its frame in that of the body.
    pub(crate) frame: &'w Isometry3<f64>,
}

/// Reader of geoms and masses.
pub(crate) struct Scales<'r> {
    /// Settings of the file.
    pub(crate) settings: &'r Settings,
    /// Classes.
    pub(crate) defaults: &'r Defaults,
    /// Meshes.
    pub(crate) meshes: &'r mut Meshes,
    /// Items without a counterpart.
    pub(crate) omissions: &'r mut Omissions,
    /// The geoms so far.
    pub(crate) surfaces: Vec<Surface>,
    /// Their visible shapes.
    pub(crate) looks: Vec<Look>,
    /// Notes for the user.
    pub(crate) notes: Vec<String>,
}

/// The mass of a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Weighed {
    /// In its own frame.
    pub(crate) mass: Mass,
    /// Its origin.
    pub(crate) words: Vec<(String, Place)>,
    /// Its first unknown contribution: reason and position.
    pub(crate) unknown: Option<(String, Place)>,
}

impl Scales<'_> {
    /// Reads a `<geom>`: its mass, contact surface and visible shape.
    pub(crate) fn geom(
        &mut self,
        element: &Element,
        within: Within<'_>,
        masses: &mut Masses,
    ) -> Result<(), Fault> {
        let given = self.defaults.of(element, within.class)?;
        let geom = body::geom(&given, self.settings)?;
        let words = match (&geom.solid, element.text("name")) {
            (Some(solid), Some(name)) => format!("geom `{name}`, {}", solid.words()),
            (Some(solid), None) => format!("geom, {}", solid.words()),
            (None, Some(name)) => format!("geom `{name}`, {}", geom.word),
            (None, None) => format!("geom, {}", geom.word),
        };
        let bits = |name: &str| -> Result<u32, Fault> { Ok(given.magnitude(name, 1.0)? as u32) };
        let surface = Surface {
            body: within.body,
            place: element.place,
            words: words.clone(),
            kind: bits("contype")?,
            affinity: bits("conaffinity")?,
            name: element.text("name").map(str::to_owned),
            form: match geom.solid {
                Some(solid) => Form::Solid(solid),
                None if geom.word == "plane" => Form::Plane,
                None => Form::Other,
            },
            pose: within.frame * geom.pose,
            grip: Grip::of(&given, [0, 2])?,
        };
        let unseen = surface.kind == 0 && surface.affinity == 0;
        self.surfaces.push(surface);
        if given.text("fluidshape").is_some_and(|shape| shape != "none") {
            let what = format!("{words}: drag of a medium");
            self.omissions.add(Kind::Fluid, element.place, what);
        }
        let group = given.number("group")?.unwrap_or(0.0);
        let [least, most] = self.settings.inertia_groups;
        let mass = given.number("mass")?;
        let density = given.number("density")?.unwrap_or(1000.0);
        let massless = mass.map_or(density == 0.0, |mass| mass == 0.0);
        // Geoms without contacts are discarded on request, including their mass.
        let dropped = self.settings.discard_visual && unseen;
        if let Some(solid) = geom.solid.filter(|_| !dropped) {
            let pose = within.frame * geom.pose;
            self.looks.extend(Look::of(&given, within.body, solid, pose, &words)?);
        }
        let counted = (least..=most).contains(&group) && !dropped;
        if !counted || massless || matches!(geom.word, "plane" | "hfield") {
            return Ok(());
        }
        let pose = within.frame * geom.pose;
        let weight = match (geom.solid, geom.mesh) {
            (Some(solid), _) if !given.flag("shellinertia", false)? => {
                let mass = mass.unwrap_or_else(|| density * solid.volume());
                Weight::Known(Mass::principal(mass, solid.moments(mass), &pose))
            }
            (Some(_), _) => Weight::Unknown("shells of shapes are not supported"),
            (None, Some(mesh)) => Weight::Mesh(mesh, pose, mass, density),
            (None, None) => Weight::Unknown(
                "shapes fitted to meshes and signed distance fields are not supported",
            ),
        };
        masses.geoms.push((weight, element.place, words));
        Ok(())
    }

    /// The mass of a body from its geoms or `<inertial>`.
    pub(crate) fn weigh(&mut self, called: &str, masses: Masses) -> Weighed {
        let inertial = match self.settings.inertia {
            InertiaSource::Geoms => None,
            _ => masses.inertial,
        };
        let mut body = Weighed::default();
        if let Some((mass, place)) = inertial {
            body.mass = mass;
            body.words.push(("<inertial>".into(), place));
        } else if self.settings.inertia != InertiaSource::Inertial {
            for (weight, place, words) in masses.geoms {
                let found = match weight {
                    Weight::Known(mass) => Ok((mass, words.clone())),
                    Weight::Unknown(why) => Err(why.to_owned()),
                    Weight::Mesh(mesh, pose, mass, density) => match self.meshes.bulk(&mesh) {
                        Ok(bulk) => {
                            if let Some(enclosed) = bulk.enclosed {
                                self.notes.push(format!(
                                    "mesh `{mesh}` has a volume of {:.4e} m³ by the rule of its `inertia`; its faces \
                                     enclose {enclosed:.4e}: use inertia=\"exact\" for that",
                                    bulk.size()
                                ));
                            }
                            let words = format!("{words} `{mesh}`: {}", bulk.words);
                            let mass = mass.unwrap_or_else(|| density * bulk.size());
                            Ok((bulk.mass(mass, &pose), words))
                        }
                        Err(why) => Err(format!("mesh `{mesh}`, {why}")),
                    },
                };
                match found {
                    Ok((mass, words)) => {
                        body.mass = body.mass.and(&mass);
                        body.words.push((words, place));
                    }
                    Err(why) => {
                        let what = format!("{words}: its mass in body `{called}`: {why}; {REMEDY}");
                        self.omissions.add(Kind::Mesh, place, what);
                        body.unknown.get_or_insert((why, place));
                    }
                }
            }
        }
        let [least, least_moment] = self.settings.bounds;
        if body.mass.mass < least {
            body.mass.mass = least;
            body.words.push((format!("boundmass={least}"), self.settings.compiler));
        }
        if least_moment > 0.0 {
            body.mass = body.mass.with_moments(|moments| moments.map(|m| m.max(least_moment)));
        }
        if self.settings.balance {
            body.mass = body.mass.with_moments(|[a, b, c]| {
                let impossible = a + b < c || b + c < a || a + c < b;
                if impossible { [(a + b + c) / 3.0; 3] } else { [a, b, c] }
            });
        }
        body
    }
}
