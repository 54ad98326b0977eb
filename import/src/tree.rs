//! All bodies, each in the frame of its parent, with their joints, masses and sites.
//!
//! `<worldbody> => bodies in the order of the file, parents first`. A `<frame>` moves what it holds.

use std::collections::BTreeMap;

use dbd_scene::nearest;
use nalgebra::{Isometry3, Unit, Vector3};

use crate::body::{self, Freedom, Geom, Joint};
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::geom::{Look, Surface};
use crate::lacks;
use crate::mass::{Mass, Solid};
use crate::notation::fitting;
use crate::omission::{Kind, Omissions};
use crate::place::Place;
use crate::settings::{InertiaSource, Settings};

/// The number of the world among the bodies.
pub(crate) const WORLD: usize = 0;

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body {
    /// Its name, or one made for it.
    pub(crate) name: String,
    /// Where it stands.
    pub(crate) place: Place,
    /// Its parent, which stands before it.
    pub(crate) parent: usize,
    /// Its pose in its parent's frame.
    pub(crate) pose: Isometry3<f64>,
    /// Its joints.
    pub(crate) joints: Vec<Joint>,
    /// How many coordinates a keyframe gives for it; more than those of its joints where some were left out.
    pub(crate) coordinates: usize,
    /// Its mass in its own frame.
    pub(crate) mass: Mass,
    /// Where its mass comes from, in words.
    pub(crate) mass_words: Vec<(String, Place)>,
    /// The share of its weight that is taken off it.
    pub(crate) weightless: f64,
}

/// All bodies.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The world first.
    pub(crate) bodies: Vec<Body>,
    /// The geoms.
    pub(crate) surfaces: Vec<Surface>,
    /// What of them can be seen.
    pub(crate) looks: Vec<Look>,
    /// Sites by name: the body and the pose in its frame.
    pub(crate) sites: BTreeMap<String, (usize, Isometry3<f64>)>,
    names: BTreeMap<String, usize>,
}

/// Where something stands.
#[derive(Clone, Copy)]
struct Within<'w> {
    body: usize,
    class: &'w str,
    frame: &'w Isometry3<f64>,
}

struct Reader<'r> {
    settings: &'r Settings,
    defaults: &'r Defaults,
    omissions: &'r mut Omissions,
    tree: Tree,
    joints: BTreeMap<String, Place>,
}

/// Masses of a body, before it is known which counts.
#[derive(Default)]
struct Masses {
    inertial: Option<(Mass, Place)>,
    geoms: Vec<(Mass, Place, String)>,
    unknown: Vec<(Place, String)>,
}

/// Reads all bodies.
///
/// # Errors
/// Where something is none of what it can be.
pub(crate) fn read(
    root: &Element,
    settings: &Settings,
    defaults: &Defaults,
    omissions: &mut Omissions,
) -> Result<Tree, Fault> {
    let world = Body {
        name: "world".into(),
        place: root.place,
        parent: WORLD,
        pose: Isometry3::identity(),
        joints: Vec::new(),
        coordinates: 0,
        mass: Mass::default(),
        mass_words: Vec::new(),
        weightless: 0.0,
    };
    let tree = Tree {
        bodies: vec![world],
        surfaces: Vec::new(),
        looks: Vec::new(),
        sites: BTreeMap::new(),
        names: BTreeMap::from([("world".into(), WORLD)]),
    };
    let mut reader = Reader { settings, defaults, omissions, tree, joints: BTreeMap::new() };
    for section in root.sections("worldbody") {
        let frame = settings.pose(&Attributes::own(section))?;
        let within = Within { body: WORLD, class: MAIN, frame: &frame };
        reader.hold(section, within, &mut Masses::default())?;
    }
    let mut tree = reader.tree;
    if tree.bodies.len() == 1 {
        return Err(Fault::at(root.place, "has no bodies", "<body>s in a <worldbody>"));
    }
    let total: f64 = tree.bodies.iter().map(|body| body.mass.mass).sum();
    if settings.total_mass > 0.0 && total > 0.0 {
        let factor = settings.total_mass / total;
        for body in &mut tree.bodies {
            body.mass = body.mass.scaled(factor);
            let words = format!("times {factor} for settotalmass={}", settings.total_mass);
            body.mass_words.push((words, settings.compiler));
        }
    }
    Ok(tree)
}

impl Reader<'_> {
    /// Reads what a body or a frame holds.
    fn hold(
        &mut self,
        element: &Element,
        within: Within<'_>,
        masses: &mut Masses,
    ) -> Result<(), Fault> {
        for child in &element.children {
            match child.name.as_str() {
                "body" => self.body(child, within)?,
                "frame" => {
                    let frame = within.frame * self.settings.pose(&Attributes::own(child))?;
                    let class = self.class(child, within.class)?;
                    self.hold(child, Within { class, frame: &frame, ..within }, masses)?;
                }
                "joint" | "freejoint" => self.joint(child, within)?,
                "inertial" => {
                    let mass = body::inertial(&Attributes::own(child), self.settings)?;
                    masses.inertial = Some((mass.seen_from(within.frame), child.place));
                }
                "geom" => self.geom(child, within, masses)?,
                "site" => {
                    let given = self.defaults.of(child, within.class)?;
                    if let Some(name) = child.text("name") {
                        let pose = within.frame * self.settings.pose(&given)?;
                        self.tree.sites.insert(name.to_owned(), (within.body, pose));
                    }
                }
                "composite" | "flexcomp" | "attach" | "replicate" | "plugin" => {
                    let what =
                        format!("<{}>, which makes parts that are not in the file", child.name);
                    self.omissions.add(Kind::Generated, child.place, what);
                }
                // Cameras, lights, and what has no known name.
                _ => {}
            }
        }
        Ok(())
    }

    fn class<'c>(&self, element: &'c Element, class: &'c str) -> Result<&'c str, Fault> {
        let Some(given) = element.attribute("childclass") else { return Ok(class) };
        self.defaults.class_of(&given.value, given.place)?;
        Ok(&given.value)
    }

    fn body(&mut self, element: &Element, within: Within<'_>) -> Result<(), Fault> {
        let given = Attributes::own(element);
        let number = self.tree.bodies.len();
        let name = match element.text("name").filter(|name| !name.is_empty()) {
            Some(name) => name.to_owned(),
            None => format!("body-{}", number),
        };
        if let Some(earlier) = self.tree.names.insert(name.clone(), number) {
            let line = self.tree.bodies[earlier].place.line;
            let message = format!("a body `{name}` is there already, line {line}");
            let place = given.place("name");
            return Err(Fault::at(place, message, "a name of its own, not \"world\""));
        }
        let fits = fitting(&name);
        let numbered = (2..).map(|number| format!("{fits}-{number}"));
        let taken = |name: &String| self.tree.bodies.iter().any(|body| body.name == *name);
        let mut names = std::iter::once(fits.clone()).chain(numbered);
        let name = names.find(|name| !taken(name)).unwrap_or(fits);
        if given.flag("mocap", false)? {
            let what = format!("body `{name}`, which is moved from outside, stands still");
            self.omissions.add(Kind::Mocap, element.place, what);
        }
        self.tree.bodies.push(Body {
            name,
            place: element.place,
            parent: within.body,
            pose: within.frame * self.settings.pose(&given)?,
            joints: Vec::new(),
            coordinates: 0,
            mass: Mass::default(),
            mass_words: Vec::new(),
            weightless: given.number("gravcomp")?.unwrap_or(0.0),
        });
        let class = self.class(element, within.class)?;
        let mut masses = Masses::default();
        let inside = Within { body: number, class, frame: &Isometry3::identity() };
        self.hold(element, inside, &mut masses)?;
        self.weigh(number, masses)
    }

    fn joint(&mut self, element: &Element, within: Within<'_>) -> Result<(), Fault> {
        let number = self.tree.bodies[within.body].joints.len();
        let (name, place) = (element.text("name"), element.place);
        if within.body == WORLD {
            return Err(Fault::at(place, "stands in the world", "a joint stands in a <body>"));
        }
        if let Some(earlier) = name.and_then(|name| self.joints.insert(name.to_owned(), place)) {
            let message = format!("this joint's name is there already, line {}", earlier.line);
            return Err(Fault::at(place, message, "a name of its own"));
        }
        let given = if element.name == "freejoint" {
            Attributes::own(element)
        } else {
            self.defaults.of(element, within.class)?
        };
        let mut joint = match element.name.as_str() {
            "freejoint" => body::free_joint(name, place),
            _ => body::joint(&given, self.settings)?,
        };
        joint.anchor =
            within.frame * nalgebra::Point3::from(joint.anchor) - nalgebra::Point3::origin();
        joint.axis = Unit::new_unchecked(within.frame.rotation * joint.axis.into_inner());
        let body = &mut self.tree.bodies[within.body];
        if joint.freedom == Freedom::Free && body.parent != WORLD {
            let help = "only a body of the world is free; others have their parent";
            return Err(Fault::at(place, "a free joint of a body within another", help));
        }
        body.coordinates += joint.freedom.coordinates();
        let called = joint.name.clone().unwrap_or_else(|| body.name.clone());
        if number > 0 {
            let first = body.joints[0].name.clone().unwrap_or_else(|| "the first".into());
            let what = format!(
                "{} `{called}` of body `{}` beside {first}: one joint per body is taken",
                joint.freedom.word(),
                body.name
            );
            self.omissions.add(Kind::Joints, place, what);
            return Ok(());
        }
        if element.name == "joint" {
            lacks::of_joint(&given, &joint, &called, self.settings, self.omissions)?;
        }
        self.tree.bodies[within.body].joints.push(joint);
        Ok(())
    }

    fn geom(
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
        };
        let unseen = surface.kind == 0 && surface.affinity == 0;
        self.tree.surfaces.push(surface);
        if given.text("fluidshape").is_some_and(|shape| shape != "none") {
            let what = format!("{words}: resistance of a medium");
            self.omissions.add(Kind::Fluid, element.place, what);
        }
        let group = given.number("group")?.unwrap_or(0.0);
        let [least, most] = self.settings.inertia_groups;
        let mass = given.number("mass")?;
        let density = given.number("density")?.unwrap_or(1000.0);
        let massless = mass.map_or(density == 0.0, |mass| mass == 0.0);
        // Geoms that touch nothing are gone where that is asked for, mass and all.
        let dropped = self.settings.discard_visual && unseen;
        if let Some(solid) = geom.solid.filter(|_| !dropped) {
            let pose = within.frame * geom.pose;
            self.tree.looks.extend(Look::of(&given, within.body, solid, pose, &words)?);
        }
        let counted = (least..=most).contains(&group) && !dropped;
        if !counted || massless || matches!(geom.word, "plane" | "hfield") {
            return Ok(());
        }
        match geom {
            Geom { solid: Some(solid), pose, .. } if !given.flag("shellinertia", false)? => {
                let mass = mass.unwrap_or_else(|| density * solid.volume());
                let own = weight(&solid, mass, &(within.frame * pose));
                masses.geoms.push((own, element.place, words));
            }
            _ => masses.unknown.push((element.place, words)),
        }
        Ok(())
    }

    /// The mass of a body of what was found in it.
    fn weigh(&mut self, number: usize, masses: Masses) -> Result<(), Fault> {
        let inertial = match self.settings.inertia {
            InertiaSource::Geoms => None,
            _ => masses.inertial,
        };
        let body = &mut self.tree.bodies[number];
        if let Some((mass, place)) = inertial {
            body.mass = mass;
            body.mass_words.push(("<inertial>".into(), place));
        } else if self.settings.inertia != InertiaSource::Inertial {
            for (mass, place, words) in masses.geoms {
                body.mass = body.mass.and(&mass);
                body.mass_words.push((words, place));
            }
            for (place, words) in masses.unknown {
                let what = format!("{words}: its mass and inertia in body `{}`", body.name);
                self.omissions.add(Kind::Mesh, place, what);
            }
        }
        let [least, least_moment] = self.settings.bounds;
        if body.mass.mass < least {
            body.mass.mass = least;
            body.mass_words.push((format!("boundmass={least}"), self.settings.compiler));
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
        Ok(())
    }
}

/// A solid's mass at its pose.
fn weight(solid: &Solid, mass: f64, pose: &Isometry3<f64>) -> Mass {
    Mass::principal(mass, solid.moments(mass), pose)
}

impl Tree {
    /// The body of a name.
    pub(crate) fn body(&self, name: &Attribute) -> Result<usize, Fault> {
        self.names
            .get(&name.value)
            .copied()
            .ok_or_else(|| Self::unknown("body", name, self.names.keys().map(String::as_str)))
    }

    /// The site of a name.
    pub(crate) fn site(&self, name: &Attribute) -> Result<(usize, Isometry3<f64>), Fault> {
        self.sites
            .get(&name.value)
            .copied()
            .ok_or_else(|| Self::unknown("site", name, self.sites.keys().map(String::as_str)))
    }

    /// The body of the joint of a name; `None` where that was left out.
    pub(crate) fn joint(&self, name: &str) -> Option<usize> {
        let is = |joint: &Joint| joint.name.as_deref() == Some(name);
        self.bodies.iter().position(|body| body.joints.iter().any(is))
    }

    /// The refusal of a name that nothing has.
    pub(crate) fn unknown<'n>(
        kind: &str,
        name: &Attribute,
        known: impl Iterator<Item = &'n str>,
    ) -> Fault {
        let meant = nearest(&name.value, known).map(|meant| format!(": did you mean `{meant}`?"));
        let message = format!("there is no {kind} `{}`", name.value);
        Fault::at(name.place, message, format!("the name of a {kind}{}", meant.unwrap_or_default()))
    }
}

/// A point as a vector, moved by a pose.
pub(crate) fn moved(pose: &Isometry3<f64>, point: Vector3<f64>) -> Vector3<f64> {
    pose.translation.vector + pose.rotation * point
}
