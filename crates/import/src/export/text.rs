//! The text of a URDF.
//!
//! `tree, coordinates => XML`.

use std::io;

use dbd_scene::{GeometryInfo, Scene, Solid};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use quick_xml::Writer;

use super::coordinates::{Coordinate, Coordinates, bounds};
use super::tree::{Joint, Link, Motion, Tree, WORLD};
use crate::notation::{line, number, snapped};

/// The beginning of every file.
pub const HEAD: &str = "<?xml version=\"1.0\"?><!-- Exported by host-sim export from ";

/// \[rad, m\] an end of a range that bounds nothing: URDF has no unbounded translations.
const FAR: f64 = 1e3;
/// \[N·m, N, rad/s, m/s\] a bound that bounds nothing.
const LARGE: f64 = 1e6;
/// \[m/s²\] URDF states no gravity; this is usual.
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

type Xml<'w> = Writer<&'w mut Vec<u8>>;

/// An element with its attributes and its contents.
fn element(
    xml: &mut Xml<'_>,
    name: &str,
    attributes: &[(&str, &str)],
    contents: impl FnOnce(&mut Xml<'_>) -> io::Result<()>,
) -> io::Result<()> {
    let element = xml.create_element(name).with_attributes(attributes.iter().copied());
    element.write_inner_content(contents).map(drop)
}

/// An element without contents.
fn empty(xml: &mut Xml<'_>, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
    xml.create_element(name).with_attributes(attributes.iter().copied()).write_empty().map(drop)
}

/// The file.
pub(super) fn write(scene: &Scene, tree: &Tree, coordinates: &Coordinates) -> String {
    let mut bytes = Vec::new();
    let mut xml = Writer::new_with_indent(&mut bytes, b' ', 2);
    let pen = Pen { scene, tree, coordinates, size: size(tree) };
    // A vector takes all bytes, and they are UTF-8.
    let done = element(&mut xml, "robot", &[("name", &scene.name)], |xml| pen.robot(xml));
    let body = done.map(|()| String::from_utf8(bytes).unwrap_or_default()).unwrap_or_default();
    // A comment contains no two hyphens.
    let name = line(&scene.name).replace("--", "- -");
    format!("{HEAD}{name}: joints are ideal; m, kg, s, rad -->\n{body}\n")
}

/// \[m\] the largest coordinate, for rounding errors.
fn size(tree: &Tree) -> f64 {
    tree.links.iter().map(|link| link.at.amax()).fold(0.0, f64::max)
}

struct Pen<'p> {
    scene: &'p Scene,
    tree: &'p Tree,
    coordinates: &'p Coordinates,
    size: f64,
}

/// Numbers of an attribute, without rounding errors of this size.
fn numbers(values: &[f64], size: f64) -> String {
    values.iter().map(|value| number(snapped(*value, size))).collect::<Vec<_>>().join(" ")
}

impl Pen<'_> {
    fn robot(&self, xml: &mut Xml<'_>) -> io::Result<()> {
        let gravity = self.scene.model.gravity.first().map_or([0.0; 3], |g| g.to_f64());
        if gravity != GRAVITY {
            element(xml, "mujoco", &[], |xml| {
                empty(xml, "option", &[("gravity", &numbers(&gravity, 0.0))])
            })?;
        }
        for link in &self.tree.links {
            self.link(xml, link)?;
        }
        let coordinates = &self.coordinates.0;
        for (joint, coordinate) in self.tree.joints.iter().zip(coordinates) {
            self.joint(xml, joint, coordinate)?;
        }
        for (joint, coordinate) in self.tree.joints.iter().zip(coordinates) {
            let suffix = if joint.motion == Motion::Turn { "rotation" } else { "translation" };
            for motor in &coordinate.motors {
                element(
                    xml,
                    "transmission",
                    &[("name", &format!("{}-{suffix}", motor.name))],
                    |xml| {
                        let text = |xml: &mut Xml<'_>, name: &str, text: &str| {
                            let text = quick_xml::events::BytesText::new(text);
                            xml.create_element(name).write_text_content(text).map(drop)
                        };
                        text(xml, "type", "transmission_interface/SimpleTransmission")?;
                        element(xml, "joint", &[("name", &joint.name)], |xml| {
                            text(
                                xml,
                                "hardwareInterface",
                                "hardware_interface/EffortJointInterface",
                            )
                        })?;
                        element(xml, "actuator", &[("name", &motor.name)], |xml| {
                            text(xml, "mechanicalReduction", &number(motor.sign))
                        })
                    },
                )?;
            }
        }
        Ok(())
    }

    fn link(&self, xml: &mut Xml<'_>, link: &Link) -> io::Result<()> {
        let ground = self.tree.links.get(WORLD).is_some_and(|ground| ground.name == link.name);
        let shapes: Vec<&GeometryInfo> = self
            .scene
            .geometry
            .iter()
            .filter(|shape| shape.body == link.body && (shape.body.is_some() || ground))
            .collect();
        if link.body.is_none() && shapes.is_empty() {
            return empty(xml, "link", &[("name", &link.name)]);
        }
        element(xml, "link", &[("name", &link.name)], |xml| {
            if let Some(body) = link.body {
                self.inertial(xml, link, body)?;
            }
            shapes.iter().try_for_each(|shape| self.visual(xml, link, shape))
        })
    }

    /// A body's position and rotation where the joints are assembled; the world's for the ground.
    fn pose(&self, body: Option<usize>) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let state = body.and_then(|body| self.scene.assembled_states().get(body));
        state.map_or_else(Default::default, |state| {
            let [w, x, y, z] = state.orientation.to_f64();
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            (state.position.to_f64().into(), turn)
        })
    }

    fn inertial(&self, xml: &mut Xml<'_>, link: &Link, body: usize) -> io::Result<()> {
        let Some(of) = self.scene.model.bodies.get(body) else { return Ok(()) };
        let (at, turn) = self.pose(Some(body));
        let turn = turn.to_rotation_matrix();
        let principal = Matrix3::from_diagonal(&of.inertia.to_f64().into());
        let tensor = turn.matrix() * principal * turn.matrix().transpose();
        element(xml, "inertial", &[], |xml| {
            self.origin(xml, at - link.at, None)?;
            empty(xml, "mass", &[("value", &number(of.mass))])?;
            let largest = tensor.amax();
            let names = [
                ("ixx", (0, 0)),
                ("ixy", (0, 1)),
                ("ixz", (0, 2)),
                ("iyy", (1, 1)),
                ("iyz", (1, 2)),
                ("izz", (2, 2)),
            ];
            let values = names.map(|(name, at)| (name, numbers(&[tensor[at]], largest)));
            empty(xml, "inertia", &values.each_ref().map(|(name, value)| (*name, value.as_str())))
        })
    }

    fn origin(
        &self,
        xml: &mut Xml<'_>,
        at: Vector3<f64>,
        turn: Option<UnitQuaternion<f64>>,
    ) -> io::Result<()> {
        let xyz = numbers(at.as_slice(), self.size);
        match turn {
            None => empty(xml, "origin", &[("xyz", &xyz)]),
            Some(turn) => {
                let (roll, pitch, yaw) = turn.euler_angles();
                let rpy = numbers(&[roll, pitch, yaw], 1.0);
                empty(xml, "origin", &[("xyz", &xyz), ("rpy", &rpy)])
            }
        }
    }

    fn visual(&self, xml: &mut Xml<'_>, link: &Link, shape: &GeometryInfo) -> io::Result<()> {
        let (at, turn) = self.pose(shape.body);
        let place = |point: [f64; 3]| at + turn * Vector3::from(point) - link.at;
        // The middle of a rod, the rotation of z to its axis, its length.
        let rod = |[from, to]: [[f64; 3]; 2]| {
            let [from, to] = [from, to].map(place);
            let along = UnitQuaternion::rotation_between(&Vector3::z(), &(to - from));
            let along = along.unwrap_or_else(|| {
                UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, 0.0)
            });
            (0.5 * (from + to), along, (to - from).norm())
        };
        element(xml, "visual", &[], |xml| {
            let (middle, own, name, sizes) = match &shape.solid {
                Solid::Box { at, turn: of, half } => {
                    let [w, x, y, z] = *of;
                    let of = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
                    (
                        place(*at),
                        turn * of,
                        "box",
                        vec![("size", numbers(&half.map(|side| 2.0 * side), 0.0))],
                    )
                }
                Solid::Cylinder { ends, radius } | Solid::Link { ends, radius } => {
                    let (middle, along, length) = rod(*ends);
                    let sizes = vec![("radius", number(*radius)), ("length", number(length))];
                    (middle, along, "cylinder", sizes)
                }
                Solid::Sphere { at, radius } => (
                    place(*at),
                    UnitQuaternion::identity(),
                    "sphere",
                    vec![("radius", number(*radius))],
                ),
            };
            self.origin(xml, middle, Some(own))?;
            element(xml, "geometry", &[], |xml| {
                let sizes: Vec<_> =
                    sizes.iter().map(|(name, value)| (*name, value.as_str())).collect();
                empty(xml, name, &sizes)
            })?;
            let Some(colour) = &shape.colour else { return Ok(()) };
            element(xml, "material", &[("name", colour)], |xml| {
                empty(xml, "color", &[("rgba", &rgba(colour))])
            })
        })
    }

    fn joint(&self, xml: &mut Xml<'_>, joint: &Joint, coordinate: &Coordinate) -> io::Result<()> {
        let range = coordinate.range.filter(|range| range.iter().any(|end| bounds(*end)));
        let kind = match joint.motion {
            Motion::Fixed => "fixed",
            Motion::Free => "floating",
            Motion::Turn if range.is_some() => "revolute",
            Motion::Turn => "continuous",
            Motion::Slide => "prismatic",
        };
        let [parent, child] = [joint.parent, joint.child].map(|link| &self.tree.links[link]);
        element(xml, "joint", &[("name", &joint.name), ("type", kind)], |xml| {
            self.origin(xml, child.at - parent.at, None)?;
            empty(xml, "parent", &[("link", &parent.name)])?;
            empty(xml, "child", &[("link", &child.name)])?;
            if !matches!(joint.motion, Motion::Turn | Motion::Slide) {
                return Ok(());
            }
            empty(xml, "axis", &[("xyz", &numbers(joint.axis.as_slice(), 1.0))])?;
            let effort = coordinate.motors.iter().map(|motor| motor.effort).reduce(f64::max);
            if kind != "continuous" || effort.is_some() {
                let end = |end: f64| if bounds(end) { end } else { FAR.copysign(end) };
                let [lower, upper] = range.unwrap_or([-FAR, FAR]).map(|one| number(end(one)));
                let [effort, velocity] = [effort.unwrap_or(LARGE).min(LARGE), LARGE].map(number);
                let mut limit = vec![("effort", effort.as_str()), ("velocity", velocity.as_str())];
                if kind != "continuous" {
                    limit.extend([("lower", lower.as_str()), ("upper", upper.as_str())]);
                }
                empty(xml, "limit", &limit)?;
            }
            if coordinate.damping != 0.0 || coordinate.friction != 0.0 {
                let values = [coordinate.damping, coordinate.friction].map(number);
                empty(xml, "dynamics", &[("damping", &values[0]), ("friction", &values[1])])?;
            }
            let Some(mimic) = &coordinate.mimic else { return Ok(()) };
            let other = &self.tree.joints[mimic.joint].name;
            let values = [mimic.multiplier, mimic.offset].map(number);
            let all =
                [("joint", other.as_str()), ("multiplier", &values[0]), ("offset", &values[1])];
            empty(xml, "mimic", &all)
        })
    }
}

/// `#rrggbb` as four numbers from 0 to 1.
fn rgba(colour: &str) -> String {
    let part = |at: usize| {
        let two = colour.get(at..at + 2).and_then(|two| u8::from_str_radix(two, 16).ok());
        format!("{:.3}", f64::from(two.unwrap_or(0)) / 255.0)
    };
    format!("{} {} {} 1", part(1), part(3), part(5))
}
