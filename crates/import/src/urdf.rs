//! ROS's URDF as equivalent MJCF elements.
//!
//! `<robot> => <mujoco>`. Links become nested bodies with the positions of the URDF text, so that messages refer to it.
//! A link without a joint is fixed to the ground, as in MuJoCo. URDF does not specify gravity: 9.81 m/s² along −z is
//! used.

use std::collections::{BTreeMap, BTreeSet};

use dbd_scene::nearest;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::defaults::Attributes;
use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::omission::{Kind, Omissions};
use crate::place::Place;
use crate::schema;

/// Elements of a robot; those in the second list do not affect the motion.
const ROBOT: [&[&str]; 2] = [
    &["link", "joint", "transmission", "mujoco"],
    &["material", "gazebo", "sensor", "version", "ros2_control", "link_name", "self_collide"],
];

/// Elements of a link and a joint.
const LINK: &[&str] = &[
    "inertial",
    "visual",
    "collision",
    "contact",
    "material",
    "self_collision_checking",
    "collision_checking",
    "self_filter",
];
const JOINT: &[&str] = &[
    "origin",
    "parent",
    "child",
    "axis",
    "calibration",
    "dynamics",
    "limit",
    "mimic",
    "safety_controller",
];

/// Elements that only `xacro` interprets.
const MACROS: &[&str] = &["macro", "property", "arg", "include", "if", "unless"];

/// The types of joints.
const TYPES: [&str; 6] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];

/// Maximum length of a chain of links, as for nested elements.
const DEPTH: usize = 400;

/// The tree of MJCF.
///
/// # Errors
/// If links and joints do not form a tree, or a value is invalid.
pub(crate) fn mujoco(robot: &Element, omissions: &mut Omissions) -> Result<Element, Fault> {
    for child in &robot.children {
        if MACROS.contains(&child.name.as_str()) {
            let help = "run `xacro FILE > FILE.urdf` first: macros are not expanded";
            return Err(Fault::at(
                child.place,
                format!("<{}> belongs to a macro", child.name),
                help,
            ));
        }
    }
    schema::children(robot, &ROBOT.concat(), omissions);
    let mut links = BTreeMap::new();
    for link in robot.sections("link") {
        schema::children(link, LINK, omissions);
        let name = required(link, "name", "<link name=\"…\">")?;
        if links.insert(name.value.as_str(), link).is_some() {
            let message = format!("link `{}` is defined twice", name.value);
            return Err(Fault::at(name.place, message, "give each link a unique name"));
        }
    }
    let joints = robot.sections("joint").map(|joint| Joint::read(joint, &links, omissions));
    let joints = joints.collect::<Result<Vec<_>, _>>()?;
    if links.is_empty() {
        let help = "add a <link>; expand macros first: `xacro FILE > FILE.urdf`";
        return Err(Fault::at(robot.place, "the robot has no links", help));
    }
    let mut held = BTreeSet::new();
    for joint in &joints {
        if !held.insert(joint.child.value.as_str()) {
            let message = format!("link `{}` is the child of two joints", joint.child.value);
            let help = "expected a tree; close the loop with a [[joint]] in the scene";
            return Err(Fault::at(joint.child.place, message, help));
        }
    }
    let mut on = BTreeMap::<&str, Vec<&Joint<'_>>>::new();
    for joint in &joints {
        on.entry(joint.parent.value.as_str()).or_default().push(joint);
    }
    let tree = Robot { links, on };
    let mut world = empty("worldbody", robot.place);
    let mut count = 0;
    for (name, link) in &tree.links {
        if held.contains(name) {
            continue;
        }
        let ground = *name == "world";
        let body = tree.body(link, &[], (0, &mut count))?;
        if ground {
            world.children.extend(body.children.into_iter().filter(|c| c.name != "inertial"));
        } else {
            world.children.push(body);
        }
    }
    if count < tree.links.len() {
        let circle = tree.links.iter().find(|(name, _)| held.contains(*name));
        let place = circle.map_or(robot.place, |(_, link)| link.place);
        let message = "the links form a cycle";
        return Err(Fault::at(place, message, "expected a tree with one root link"));
    }
    let given = |name: &str, value: &str| attribute(name, value, robot.place);
    let mut compiler = empty("compiler", robot.place);
    compiler.attributes =
        vec![given("angle", "radian"), given("eulerseq", "XYZ"), given("inertiafromgeom", "false")];
    // This name indicates that no time step is given.
    let mut mujoco = empty("robot", robot.place);
    mujoco
        .attributes
        .extend(robot.attribute("name").map(|name| attribute("model", &name.value, name.place)));
    mujoco.children = vec![compiler];
    // MuJoCo-specific section of a URDF.
    for section in robot.sections("mujoco") {
        let own = |one: &&Element| matches!(one.name.as_str(), "compiler" | "option");
        mujoco.children.extend(section.children.iter().filter(own).cloned());
    }
    mujoco.children.push(world);
    mujoco.children.push(equalities(robot, &joints, omissions)?);
    mujoco.children.push(motors(robot, &joints, omissions)?);
    Ok(mujoco)
}

/// A joint as it is written.
struct Joint<'e> {
    element: &'e Element,
    name: &'e Attribute,
    kind: &'static str,
    parent: &'e Attribute,
    child: &'e Attribute,
}

impl<'e> Joint<'e> {
    fn read(
        element: &'e Element,
        links: &BTreeMap<&str, &Element>,
        omissions: &mut Omissions,
    ) -> Result<Self, Fault> {
        schema::children(element, JOINT, omissions);
        let name = required(element, "name", "<joint name=\"…\" type=\"…\">")?;
        let kind = required(element, "type", &TYPES.join(", "))?;
        let Some(known) = TYPES.into_iter().find(|known| *known == kind.value) else {
            let message = format!("unknown joint type `{}`", kind.value);
            return Err(Fault::at(kind.place, message, TYPES.join(", ")));
        };
        let end = |which: &str| -> Result<&'e Attribute, Fault> {
            let help = format!("<{which} link=\"…\"/>");
            let Some(end) = element.sections(which).next() else {
                let message = format!("{} has no <{which}>", element.called());
                return Err(Fault::at(element.place, message, help));
            };
            let link = required(end, "link", &help)?;
            if links.contains_key(link.value.as_str()) {
                return Ok(link);
            }
            let meant = nearest(&link.value, links.keys().copied());
            let help = meant.map_or_else(
                || "expected the name of a link".to_owned(),
                |meant| format!("did you mean `{meant}`?"),
            );
            Err(Fault::at(link.place, format!("unknown link `{}`", link.value), help))
        };
        let (parent, child) = (end("parent")?, end("child")?);
        for (part, kind) in [("limit", Kind::Limit), ("dynamics", Kind::Spring)] {
            if let (Some(part), "planar") = (element.sections(part).next(), known) {
                let what = format!("{}: <{}> of a planar joint", element.called(), part.name);
                omissions.add(kind, part.place, what);
            }
        }
        Ok(Self { element, name, kind: known, parent, child })
    }

    /// Whether it has one degree of freedom, as a hinge or a slide.
    fn moves(&self) -> bool {
        matches!(self.kind, "revolute" | "continuous" | "prismatic")
    }

    /// A number within one of its elements, 0 if absent.
    fn number(&self, part: &str, name: &str) -> Result<Option<f64>, Fault> {
        let Some(part) = self.element.sections(part).next() else { return Ok(None) };
        Attributes::own(part).number(name)
    }

    /// As MJCF joints; none without degrees of freedom.
    fn freedoms(&self) -> Result<Vec<Element>, Fault> {
        if self.kind != "planar" {
            return Ok(self.freedom()?.into_iter().collect());
        }
        // The axis is normal to the plane.
        let given = self.element.sections("axis").next();
        let axis = given.map(|axis| Attributes::own(axis).vector("xyz")).transpose()?.flatten();
        let normal = axis.unwrap_or_else(Vector3::x);
        let least = normal.iamin();
        let first = normal.cross(&Vector3::ith(least, 1.0));
        let axes =
            [("-x", "slide", first), ("-y", "slide", normal.cross(&first)), ("", "hinge", normal)];
        let one = |(end, kind, axis): (&str, &str, Vector3<f64>)| {
            let mut joint = empty("joint", self.element.place);
            let values = [
                ("name", format!("{}{end}", self.name.value)),
                ("type", kind.to_owned()),
                ("axis", three(axis)),
            ];
            let values = values.iter().map(|(name, value)| attribute(name, value, self.name.place));
            joint.attributes.extend(values);
            joint
        };
        Ok(axes.map(one).to_vec())
    }

    /// As an MJCF joint of one degree of freedom or six; `None` without.
    fn freedom(&self) -> Result<Option<Element>, Fault> {
        let mut joint = empty("joint", self.element.place);
        let kind = match self.kind {
            "revolute" | "continuous" => "hinge",
            "prismatic" => "slide",
            "floating" => {
                joint.name = "freejoint".into();
                joint.attributes.push(attribute("name", &self.name.value, self.name.place));
                return Ok(Some(joint));
            }
            _ => return Ok(None),
        };
        let mut add = |name: &str, value: &str, place: Place| {
            joint.attributes.push(attribute(name, value, place));
        };
        add("name", &self.name.value, self.name.place);
        add("type", kind, self.element.place);
        match self.element.sections("axis").next().and_then(|axis| axis.attribute("xyz")) {
            Some(axis) => add("axis", &axis.value, axis.place),
            None => add("axis", "1 0 0", self.element.place),
        }
        if let Some(limit) = self.element.sections("limit").next()
            && self.kind != "continuous"
        {
            let given = Attributes::own(limit);
            let end = |name: &str| given.number(name).map(|end| end.unwrap_or(0.0));
            let (lower, upper) = (end("lower")?, end("upper")?);
            // As in MuJoCo, equal bounds mean no range.
            if lower < upper {
                add("range", &format!("{lower:?} {upper:?}"), limit.place);
            } else if lower > upper {
                let message = format!("`lower` {lower} is above `upper` {upper}");
                return Err(Fault::at(limit.place, message, "give lower below upper"));
            }
        }
        if let Some(dynamics) = self.element.sections("dynamics").next() {
            for (name, to) in [("damping", "damping"), ("friction", "frictionloss")] {
                if let Some(number) = dynamics.attribute(name) {
                    add(to, &number.value, number.place);
                }
            }
        }
        Ok(Some(joint))
    }
}

/// Links by name, and the joints on each.
struct Robot<'e> {
    links: BTreeMap<&'e str, &'e Element>,
    on: BTreeMap<&'e str, Vec<&'e Joint<'e>>>,
}

impl Robot<'_> {
    /// A link with its descendants, held by joints in this order; `count` links so far.
    fn body(
        &self,
        link: &Element,
        joints: &[&Joint<'_>],
        (depth, count): (usize, &mut usize),
    ) -> Result<Element, Fault> {
        if depth > DEPTH {
            let message = format!("the link is in a chain of more than {DEPTH} links");
            return Err(Fault::at(link.place, message, "use a shorter chain"));
        }
        *count += 1;
        let mut body = empty("body", link.place);
        let name = link.text("name").unwrap_or_default();
        let place = link.attribute("name").map_or(link.place, |name| name.place);
        body.attributes.push(attribute("name", name, place));
        match joints {
            [] => {}
            [joint] => {
                body.attributes.extend(pose(joint.element)?);
                body.children.extend(joint.freedoms()?);
            }
            _ => several(joints, &mut body)?,
        }
        body.children.extend(inertial(link)?);
        for (section, touches) in [("visual", false), ("collision", true)] {
            for one in link.sections(section) {
                body.children.extend(geom(one, touches)?);
            }
        }
        for joint in self.on.get(name).into_iter().flatten() {
            let mut joints = vec![*joint];
            while let Some(next) = self.beyond(joints[joints.len() - 1], *count + joints.len()) {
                joints.push(next);
            }
            *count += joints.len() - 1;
            let last = joints[joints.len() - 1];
            if let Some(child) = self.links.get(last.child.value.as_str()) {
                body.children.push(self.body(child, &joints, (depth + 1, count))?);
            }
        }
        Ok(body)
    }

    /// The joint beyond a link without mass and shapes between two joints, which together are several joints of one
    /// body; `count` links so far, fewer than all unless links form a cycle.
    fn beyond(&self, joint: &Joint<'_>, count: usize) -> Option<&Joint<'_>> {
        let name = joint.child.value.as_str();
        let link = self.links.get(name).filter(|_| count < self.links.len() && joint.moves())?;
        let is_bare = ["inertial", "visual", "collision"]
            .iter()
            .all(|part| link.sections(part).next().is_none());
        match self.on.get(name).map(Vec::as_slice) {
            Some([next]) if is_bare && next.moves() => Some(next),
            _ => None,
        }
    }
}

/// Several joints of one body, given in its frame.
fn several(joints: &[&Joint<'_>], body: &mut Element) -> Result<(), Fault> {
    let mut frame = Isometry3::identity();
    let mut made = Vec::new();
    // The frame of the last joint is the body's.
    for joint in joints.iter().rev() {
        let Some(mut freedom) = joint.freedom()? else { continue };
        let given = joint.element.sections("axis").next();
        let axis = given.map(|axis| Attributes::own(axis).vector("xyz")).transpose()?.flatten();
        let axis = frame.rotation.inverse() * axis.unwrap_or_else(Vector3::x);
        let at = frame.inverse().translation.vector;
        let place = joint.element.place;
        freedom.attributes.retain(|attribute| attribute.name != "axis");
        freedom.attributes.push(attribute("axis", &three(axis), place));
        freedom.attributes.push(attribute("pos", &three(at), place));
        made.push(freedom);
        frame = isometry(joint.element)? * frame;
    }
    let place = joints.first().map_or(body.place, |joint| joint.element.place);
    let [x, y, z, w] = frame.rotation.coords.into();
    body.attributes.push(attribute("pos", &three(frame.translation.vector), place));
    body.attributes.push(attribute("quat", &format!("{w:?} {x:?} {y:?} {z:?}"), place));
    body.children.extend(made.into_iter().rev());
    Ok(())
}

/// Three numbers of an attribute.
fn three(v: Vector3<f64>) -> String {
    format!("{:?} {:?} {:?}", v.x, v.y, v.z)
}

/// The frame given by an `<origin>`.
fn isometry(element: &Element) -> Result<Isometry3<f64>, Fault> {
    let Some(origin) = element.sections("origin").next().map(Attributes::own) else {
        return Ok(Isometry3::identity());
    };
    let at = origin.vector("xyz")?.unwrap_or_default();
    let rpy = origin.vector("rpy")?.unwrap_or_default();
    let turn = UnitQuaternion::from_euler_angles(rpy.x, rpy.y, rpy.z);
    Ok(Isometry3::from_parts(Translation3::from(at), turn))
}

/// `pos` and `euler` of an `<origin>`.
fn pose(element: &Element) -> Result<Vec<Attribute>, Fault> {
    let Some(origin) = element.sections("origin").next() else { return Ok(Vec::new()) };
    let given = |from: &str, to: &str| {
        origin.attribute(from).map(|given| attribute(to, &given.value, given.place))
    };
    Ok(given("xyz", "pos").into_iter().chain(given("rpy", "euler")).collect())
}

/// The mass of a link, with its inertia in the link's axes.
fn inertial(link: &Element) -> Result<Option<Element>, Fault> {
    let Some(section) = link.sections("inertial").next() else { return Ok(None) };
    let part = |name: &str| {
        section.sections(name).next().ok_or_else(|| {
            let message = format!("<inertial> of {} has no <{name}>", link.called());
            Fault::at(section.place, message, "give <mass value=\"…\"/> and <inertia ixx=\"…\" …/>")
        })
    };
    let (mass, inertia) = (part("mass")?, part("inertia")?);
    let value = required(mass, "value", "kg")?;
    let given = Attributes::own(inertia);
    let number = |name: &str| given.number(name).map(|number| number.unwrap_or(0.0));
    let [xx, yy, zz] = [number("ixx")?, number("iyy")?, number("izz")?];
    let [xy, xz, yz] = [number("ixy")?, number("ixz")?, number("iyz")?];
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let mut made = empty("inertial", section.place);
    made.attributes.push(attribute("mass", &value.value, value.place));
    let origin = section.sections("origin").next();
    let origin = origin.map(Attributes::own);
    let angles = origin.as_ref().map_or(Ok(None), |origin| origin.vector("rpy"))?;
    let turn = angles
        .map_or_else(Rotation3::identity, |rpy| Rotation3::from_euler_angles(rpy.x, rpy.y, rpy.z));
    let turned = turn * tensor * turn.inverse();
    let six = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let six: Vec<String> = six.iter().map(|at| format!("{:?}", turned[*at])).collect();
    let at = origin.and_then(|origin| origin.get("xyz").cloned());
    made.attributes.push(match at {
        Some(at) => attribute("pos", &at.value, at.place),
        None => attribute("pos", "0 0 0", section.place),
    });
    made.attributes.push(attribute("fullinertia", &six.join(" "), inertia.place));
    Ok(Some(made))
}

/// A visual or collision shape of a link.
fn geom(section: &Element, touches: bool) -> Result<Option<Element>, Fault> {
    let geometry = section.sections("geometry").next().and_then(|one| one.children.first());
    let Some(geometry) = geometry else { return Ok(None) };
    let mut geom = empty("geom", section.place);
    let mut add = |name: &str, value: &str, place: Place| {
        geom.attributes.push(attribute(name, value, place));
    };
    let given = Attributes::own(geometry);
    let number = |name: &str| -> Result<f64, Fault> {
        given.number(name)?.ok_or_else(|| {
            let message = format!("<{}> has no `{name}`", geometry.name);
            Fault::at(geometry.place, message, "give its size in m")
        })
    };
    match geometry.name.as_str() {
        "box" => {
            let Some(size) = given.vector("size")? else {
                return Err(Fault::at(
                    geometry.place,
                    "<box> has no `size`",
                    "give three side lengths in m",
                ));
            };
            let half = size * 0.5;
            add("type", "box", geometry.place);
            add("size", &format!("{:?} {:?} {:?}", half.x, half.y, half.z), geometry.place);
        }
        "cylinder" | "capsule" => {
            let size = format!("{:?} {:?}", number("radius")?, 0.5 * number("length")?);
            add("type", &geometry.name, geometry.place);
            add("size", &size, geometry.place);
        }
        "sphere" => {
            add("type", "sphere", geometry.place);
            add("size", &format!("{:?}", number("radius")?), geometry.place);
        }
        // Pictures do not show meshes; for collisions the contact is reported.
        "mesh" if touches => {
            let file = given.text("filename").unwrap_or_default();
            add("type", "mesh", geometry.place);
            add("mesh", file, geometry.place);
        }
        "mesh" => return Ok(None),
        other => {
            let message = format!("unknown geometry <{other}>");
            let help = "expected <box>, <cylinder>, <sphere> or <mesh>";
            return Err(Fault::at(geometry.place, message, help));
        }
    }
    if touches {
        add("rgba", "0 0 0 0", section.place);
    } else {
        add("contype", "0", section.place);
        add("conaffinity", "0", section.place);
        let colour = section.sections("material").flat_map(|one| one.sections("color")).next();
        if let Some(colour) = colour.and_then(|colour| colour.attribute("rgba")) {
            add("rgba", &colour.value, colour.place);
        }
    }
    geom.attributes.extend(pose(section)?);
    Ok(Some(geom))
}

/// Joints that mimic others.
fn equalities(
    robot: &Element,
    joints: &[Joint<'_>],
    omissions: &mut Omissions,
) -> Result<Element, Fault> {
    let mut section = empty("equality", robot.place);
    for joint in joints {
        let Some(mimic) = joint.element.sections("mimic").next() else { continue };
        // A fixed joint mimics nothing.
        if !joint.moves() {
            continue;
        }
        let other = required(mimic, "joint", "<mimic joint=\"…\" multiplier=\"…\" offset=\"…\"/>")?;
        if joints.iter().any(|joint| joint.name.value == other.value && !joint.moves()) {
            let called = joint.element.called();
            let what = format!("{called}: mimics `{}`, which does not move", other.value);
            omissions.add(Kind::Equality, mimic.place, what);
            continue;
        }
        let number = |name: &str, default: f64| {
            joint.number("mimic", name).map(|number| number.unwrap_or(default))
        };
        let (multiplier, offset) = (number("multiplier", 1.0)?, number("offset", 0.0)?);
        let mut equality = empty("joint", mimic.place);
        equality.attributes = vec![
            attribute("name", &format!("{}-mimic", joint.name.value), joint.name.place),
            attribute("joint1", &joint.name.value, joint.name.place),
            attribute("joint2", &other.value, other.place),
            attribute("polycoef", &format!("{offset:?} {multiplier:?} 0 0 0"), mimic.place),
        ];
        section.children.push(equality);
    }
    Ok(section)
}

/// A motor at the joint of each transmission, limited by the joint's `effort`.
fn motors(
    robot: &Element,
    joints: &[Joint<'_>],
    omissions: &mut Omissions,
) -> Result<Element, Fault> {
    let mut section = empty("actuator", robot.place);
    for transmission in robot.sections("transmission") {
        for of in transmission.sections("joint") {
            let name = required(of, "name", "<joint name=\"…\">")?;
            let driven = joints.iter().find(|joint| joint.name.value == name.value);
            let Some(driven) = driven.filter(|joint| joint.moves()) else {
                let called = transmission.called();
                let what =
                    format!("{called}: drives `{}`, which is not a movable joint", name.value);
                omissions.add(Kind::Actuator, name.place, what);
                continue;
            };
            let mut motor = empty("motor", transmission.place);
            let actuator = transmission.sections("actuator").find_map(|one| one.attribute("name"));
            let called = actuator.unwrap_or(name);
            motor.attributes.push(attribute("name", &called.value, called.place));
            motor.attributes.push(attribute("joint", &name.value, name.place));
            if let Some(effort) = driven.number("limit", "effort")?.filter(|effort| *effort > 0.0) {
                let range = format!("{:?} {effort:?}", -effort);
                motor.attributes.push(attribute("ctrlrange", &range, driven.element.place));
            }
            section.children.push(motor);
        }
    }
    Ok(section)
}

fn empty(name: &str, place: Place) -> Element {
    Element { name: name.to_owned(), place, ..Element::default() }
}

fn attribute(name: &str, value: &str, place: Place) -> Attribute {
    Attribute { name: name.to_owned(), value: value.to_owned(), place }
}

fn required<'e>(element: &'e Element, name: &str, help: &str) -> Result<&'e Attribute, Fault> {
    element.attribute(name).ok_or_else(|| {
        Fault::at(element.place, format!("{} has no `{name}`", element.called()), help)
    })
}
