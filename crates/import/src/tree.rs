//! All bodies, each in the frame of its parent, with their joints, masses and sites.
//!
//! `<worldbody> => bodies in file order, parents first`. A `<frame>` transforms its contents.

use std::collections::BTreeMap;

use dbd_scene::nearest;
use nalgebra::{Isometry3, Unit, Vector3};

use crate::body::{self, Freedom, Joint};
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::geom::{Look, Surface};
use crate::lacks;
use crate::mass::Mass;
use crate::mesh::Meshes;
use crate::notation::fitting;
use crate::omission::{Kind, Omissions};
use crate::place::Place;
use crate::settings::Settings;
use crate::weigh::{Masses, Scales, Within};

/// Index of the world among the bodies.
pub(crate) const WORLD: usize = 0;

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body {
    /// Its name, or a generated one.
    pub(crate) name: String,
    /// Its position in the file.
    pub(crate) place: Place,
    /// Its parent, which precedes it.
    pub(crate) parent: usize,
    /// Its pose in its parent's frame.
    pub(crate) pose: Isometry3<f64>,
    /// Its joint.
    pub(crate) joint: Option<Joint>,
    /// The first of its carriers: the bodies before it, one for each joint except the last, which MuJoCo treats as one
    /// body; its own index if it has at most one joint.
    pub(crate) chain: usize,
    /// Its mass in its own frame.
    pub(crate) mass: Mass,
    /// The origin of its mass.
    pub(crate) mass_words: Vec<(String, Place)>,
    /// Its first unknown mass: reason and position.
    pub(crate) unweighed: Option<(String, Place)>,
    /// The compensated fraction of its weight.
    pub(crate) weightless: f64,
}

/// All bodies.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The world first.
    pub(crate) bodies: Vec<Body>,
    /// The geoms.
    pub(crate) surfaces: Vec<Surface>,
    /// Their visible shapes.
    pub(crate) looks: Vec<Look>,
    /// Sites by name: the body and the pose in its frame.
    pub(crate) sites: BTreeMap<String, (usize, Isometry3<f64>)>,
    /// Notes for the user.
    pub(crate) notes: Vec<String>,
    names: BTreeMap<String, usize>,
}

/// Reader of bodies.
struct Reader<'r> {
    scales: Scales<'r>,
    tree: Tree,
    joints: BTreeMap<String, Place>,
}

/// Reads all bodies.
///
/// # Errors
/// If an element or value is invalid.
pub(crate) fn read(
    root: &Element,
    settings: &Settings,
    defaults: &Defaults,
    meshes: &mut Meshes,
    omissions: &mut Omissions,
) -> Result<Tree, Fault> {
    let world = Body {
        name: "world".into(),
        place: root.place,
        parent: WORLD,
        pose: Isometry3::identity(),
        joint: None,
        chain: WORLD,
        mass: Mass::default(),
        mass_words: Vec::new(),
        unweighed: None,
        weightless: 0.0,
    };
    let tree = Tree {
        bodies: vec![world],
        surfaces: Vec::new(),
        looks: Vec::new(),
        sites: BTreeMap::new(),
        notes: Vec::new(),
        names: BTreeMap::from([("world".into(), WORLD)]),
    };
    let joints = BTreeMap::new();
    let (surfaces, looks, notes) = (Vec::new(), Vec::new(), Vec::new());
    let scales = Scales { settings, defaults, meshes, omissions, surfaces, looks, notes };
    let mut reader = Reader { scales, tree, joints };
    for section in root.sections("worldbody") {
        let frame = settings.pose(&Attributes::own(section))?;
        let within = Within { body: WORLD, class: MAIN, frame: &frame };
        reader.hold(section, within, &mut Masses::default())?;
    }
    let Scales { surfaces, looks, notes, .. } = reader.scales;
    let mut tree = Tree { surfaces, looks, notes, ..reader.tree };
    if tree.bodies.len() == 1 {
        return Err(Fault::at(
            root.place,
            "the model has no bodies",
            "add a <body> to a <worldbody>",
        ));
    }
    let total: f64 = tree.bodies.iter().map(|body| body.mass.mass).sum();
    if settings.total_mass > 0.0 && total > 0.0 {
        let factor = settings.total_mass / total;
        for body in &mut tree.bodies {
            body.mass = body.mass.scaled(factor);
            let words = format!("scaled by {factor} for settotalmass={}", settings.total_mass);
            body.mass_words.push((words, settings.compiler));
        }
    }
    Ok(tree)
}

impl Reader<'_> {
    /// Reads the contents of a body or a frame.
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
                    let frame =
                        within.frame * self.scales.settings.pose(&Attributes::own(child))?;
                    let class = self.class(child, within.class)?;
                    self.hold(child, Within { class, frame: &frame, ..within }, masses)?;
                }
                "joint" | "freejoint" => self.joint(child, within)?,
                "inertial" => {
                    let mass = body::inertial(&Attributes::own(child), self.scales.settings)?;
                    masses.inertial = Some((mass.seen_from(within.frame), child.place));
                }
                "geom" => self.scales.geom(child, within, masses)?,
                "site" => {
                    let given = self.scales.defaults.of(child, within.class)?;
                    if let Some(name) = child.text("name") {
                        let pose = within.frame * self.scales.settings.pose(&given)?;
                        self.tree.sites.insert(name.to_owned(), (within.body, pose));
                    }
                }
                "composite" | "flexcomp" | "attach" | "replicate" | "plugin" => {
                    let what =
                        format!("<{}>, which generates parts that are not in the file", child.name);
                    self.scales.omissions.add(Kind::Generated, child.place, what);
                }
                // Cameras, lights and unknown names.
                _ => {}
            }
        }
        Ok(())
    }

    fn class<'c>(&self, element: &'c Element, class: &'c str) -> Result<&'c str, Fault> {
        let Some(given) = element.attribute("childclass") else { return Ok(class) };
        self.scales.defaults.check(&given.value, given.place)?;
        Ok(&given.value)
    }

    fn body(&mut self, element: &Element, within: Within<'_>) -> Result<(), Fault> {
        let given = Attributes::own(element);
        let chain = self.tree.bodies.len();
        let number = chain + joints_in(element).saturating_sub(1);
        let name = match element.text("name").filter(|name| !name.is_empty()) {
            Some(name) => name.to_owned(),
            None => format!("body-{number}"),
        };
        if let Some(earlier) = self.tree.names.insert(name.clone(), number) {
            let line = self.tree.bodies[earlier].place.line;
            let message = format!("body `{name}` is already defined in line {line}");
            let place = given.place("name");
            return Err(Fault::at(place, message, "give a unique name other than \"world\""));
        }
        if given.flag("mocap", false)? {
            let what = format!("mocap body `{name}` stays fixed");
            self.scales.omissions.add(Kind::Mocap, element.place, what);
        }
        let name = self.tree.own_name(&name);
        let body = Body {
            name: name.clone(),
            place: element.place,
            parent: within.body,
            pose: within.frame * self.scales.settings.pose(&given)?,
            joint: None,
            chain,
            mass: Mass::default(),
            mass_words: Vec::new(),
            unweighed: None,
            weightless: given.number("gravcomp")?.unwrap_or(0.0),
        };
        for carrier in chain..=number {
            let mut one = body.clone();
            if carrier > chain {
                (one.parent, one.pose) = (carrier - 1, Isometry3::identity());
            }
            if carrier < number {
                one.name = self.tree.own_name(&format!("{}.carrier", body.name));
                one.weightless = 0.0;
            }
            self.tree.bodies.push(one);
        }
        let class = self.class(element, within.class)?;
        let mut masses = Masses::default();
        let inside = Within { body: number, class, frame: &Isometry3::identity() };
        self.hold(element, inside, &mut masses)?;
        let weighed = self.scales.weigh(&name, masses);
        let body = &mut self.tree.bodies[number];
        (body.mass, body.mass_words, body.unweighed) =
            (weighed.mass, weighed.words, weighed.unknown);
        Ok(())
    }

    fn joint(&mut self, element: &Element, within: Within<'_>) -> Result<(), Fault> {
        let (name, place) = (element.text("name"), element.place);
        if within.body == WORLD {
            return Err(Fault::at(
                place,
                "a joint cannot belong to the world",
                "put the joint in a <body>",
            ));
        }
        if let Some(earlier) = name.and_then(|name| self.joints.insert(name.to_owned(), place)) {
            let message = format!("the joint name is already used in line {}", earlier.line);
            return Err(Fault::at(place, message, "give a unique name"));
        }
        let given = if element.name == "freejoint" {
            Attributes::own(element)
        } else {
            self.scales.defaults.of(element, within.class)?
        };
        let mut joint = match element.name.as_str() {
            "freejoint" => body::free_joint(name, place),
            _ => body::joint(&given, self.scales.settings)?,
        };
        joint.anchor =
            within.frame * nalgebra::Point3::from(joint.anchor) - nalgebra::Point3::origin();
        joint.axis = Unit::new_unchecked(within.frame.rotation * joint.axis.into_inner());
        let body = &self.tree.bodies[within.body];
        let (chain, called) = (body.chain, name.unwrap_or(&body.name).to_owned());
        let bodies = &mut self.tree.bodies;
        if joint.freedom == Freedom::Free && bodies[chain].parent != WORLD {
            let help = "put the free body directly in the world";
            return Err(Fault::at(place, "a free joint in a nested body", help));
        }
        if joint.freedom == Freedom::Free && chain < within.body {
            let help = "remove the other joints of the body";
            return Err(Fault::at(place, "a free joint combined with other joints", help));
        }
        if element.name == "joint" {
            lacks::of_joint(&given, &joint, &called, self.scales.settings, self.scales.omissions)?;
        }
        // MuJoCo applies the joints of a body in order; each of its carriers has one of them.
        let next = bodies[chain..=within.body].iter_mut().find(|body| body.joint.is_none());
        if let Some(body) = next {
            body.joint = Some(joint);
        }
        Ok(())
    }
}

/// Number of joints of a body, including those in its frames.
fn joints_in(element: &Element) -> usize {
    let of = |child: &Element| match child.name.as_str() {
        "joint" | "freejoint" => 1,
        "frame" => joints_in(child),
        _ => 0,
    };
    element.children.iter().map(of).sum()
}

impl Tree {
    /// The body with a name.
    pub(crate) fn body(&self, name: &Attribute) -> Result<usize, Fault> {
        self.names
            .get(&name.value)
            .copied()
            .ok_or_else(|| Self::unknown("body", name, self.names.keys().map(String::as_str)))
    }

    /// The site with a name.
    pub(crate) fn site(&self, name: &Attribute) -> Result<(usize, Isometry3<f64>), Fault> {
        self.sites
            .get(&name.value)
            .copied()
            .ok_or_else(|| Self::unknown("site", name, self.sites.keys().map(String::as_str)))
    }

    /// The body of the joint with a name.
    pub(crate) fn joint(&self, name: &Attribute) -> Result<usize, Fault> {
        let named = |body: &Body| body.joint.as_ref()?.name.clone();
        let found = self.bodies.iter().position(|body| named(body).as_deref() == Some(&name.value));
        found.ok_or_else(|| {
            let names: Vec<String> = self.bodies.iter().filter_map(named).collect();
            Self::unknown("joint", name, names.iter().map(String::as_str))
        })
    }

    /// Whether a body is a carrier, which has no mass in the file.
    pub(crate) fn carries(&self, body: usize) -> bool {
        self.bodies.get(body + 1).is_some_and(|next| next.chain <= body)
    }

    /// The parent of a body in the file.
    pub(crate) fn parent(&self, body: usize) -> usize {
        self.bodies[self.bodies[body].chain].parent
    }

    /// An unused body name: the desired one, or that with a number.
    fn own_name(&self, wanted: &str) -> String {
        let wanted = fitting(wanted);
        let numbered = (2..).map(|number| format!("{wanted}-{number}"));
        let mut names = std::iter::once(wanted.clone()).chain(numbered);
        let taken = |name: &String| self.bodies.iter().any(|body| body.name == *name);
        names.find(|name| !taken(name)).unwrap_or(wanted)
    }

    /// The refusal of an unknown name.
    pub(crate) fn unknown<'n>(
        kind: &str,
        name: &Attribute,
        known: impl Iterator<Item = &'n str>,
    ) -> Fault {
        let meant = nearest(&name.value, known).map(|meant| format!(": did you mean `{meant}`?"));
        let message = format!("unknown {kind} `{}`", name.value);
        Fault::at(
            name.place,
            message,
            format!("expected the name of a {kind}{}", meant.unwrap_or_default()),
        )
    }
}

/// A point transformed by a pose.
pub(crate) fn moved(pose: &Isometry3<f64>, point: Vector3<f64>) -> Vector3<f64> {
    pose.translation.vector + pose.rotation * point
}
