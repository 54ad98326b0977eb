//! Joints, springs, inputs and read-outs between parts, in world coordinates at the start of the scene.
//!
//! `parts, poses => data of the scene`.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry3, Vector3};

use crate::coordinate::Coordinate;
use crate::notation::fitting;
use crate::options::Options;
use crate::part::{Parts, Side};
use crate::place::Source;
use crate::pose::Pose;
use crate::tree::{Tree, moved};

/// Two points of a joint are considered coincident within this fraction of its span.
const CLOSED: f64 = 1e-9;

/// A type of joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Type {
    /// About an axis.
    Revolute(Vector3<f64>),
    /// About a point.
    Spherical,
    /// About and along an axis.
    Cylindrical(Vector3<f64>),
    /// About an axis of the first body and one of the second.
    Universal([Vector3<f64>; 2]),
    /// Along an axis.
    Translational(Vector3<f64>),
    /// No motion.
    Fixed,
}

/// A joint.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// Its name.
    pub(crate) name: String,
    /// Its type, with axes in world coordinates.
    pub(crate) kind: Type,
    /// The connected parts.
    pub(crate) between: [Side; 2],
    /// \[m\] its point on each part, world.
    pub(crate) at: [Vector3<f64>; 2],
    /// \[m\]
    pub(crate) span: f64,
    /// Limits and friction, each `key = value`.
    pub(crate) keys: Vec<String>,
    /// Its origin in the file.
    pub(crate) source: Source,
}

impl Link {
    /// \[m\] its gap.
    pub(crate) fn gap(&self) -> f64 {
        (self.at[1] - self.at[0]).norm()
    }

    /// Whether its two points coincide up to rounding.
    pub(crate) fn is_closed(&self) -> bool {
        let size = self.span + self.at[0].norm();
        self.gap() <= CLOSED * size
    }
}

/// The axis about or along which a joint moves.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    /// The name of the joint.
    pub(crate) joint: String,
    /// The freedom, for a cylindrical joint.
    pub(crate) freedom: Option<&'static str>,
    /// Whether the joint's bodies are swapped, which changes the sign.
    pub(crate) is_reversed: bool,
    /// \[m\] span of the joint.
    pub(crate) span: f64,
}

/// A sum of coordinates of joints, held by a spring.
#[derive(Clone, Debug)]
pub(crate) struct Coupling {
    /// Its name.
    pub(crate) name: String,
    /// The coordinates and their factors.
    pub(crate) of: Vec<(Axis, f64)>,
    /// The sum at the middle of its play, relative to the start of the scene.
    pub(crate) offset: f64,
    /// Width of the range without force.
    pub(crate) play: f64,
    /// \[N·m/rad, N/m\]
    pub(crate) stiffness: f64,
    /// \[N·m·s/rad, N·s/m\]
    pub(crate) damping: f64,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// A torsion spring.
#[derive(Clone, Debug)]
pub(crate) struct Torsion {
    /// Its name.
    pub(crate) name: String,
    /// The connected parts.
    pub(crate) between: [Side; 2],
    /// Its axis, world.
    pub(crate) axis: Vector3<f64>,
    /// \[N·m/rad\]
    pub(crate) stiffness: f64,
    /// \[N·m·s/rad\]
    pub(crate) damping: f64,
    /// \[N·m\]
    pub(crate) preload: f64,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// A spring between two points.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    /// Its name.
    pub(crate) name: String,
    /// The connected parts.
    pub(crate) between: [Side; 2],
    /// \[m\] its endpoints, world.
    pub(crate) points: [Vector3<f64>; 2],
    /// \[m\]
    pub(crate) free_length: f64,
    /// \[N/m\]
    pub(crate) stiffness: f64,
    /// \[N·s/m\]
    pub(crate) damping: f64,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// An interaction with its keys as written.
#[derive(Clone, Debug)]
pub(crate) struct Interaction {
    /// Its name.
    pub(crate) name: String,
    /// Its law.
    pub(crate) law: &'static str,
    /// The connected parts; the ground comes first.
    pub(crate) between: [Side; 2],
    /// Further keys, each `key = value`.
    pub(crate) keys: Vec<String>,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// A spring that holds a point of a part to a line of the world.
#[derive(Clone, Debug)]
pub(crate) struct Rail {
    /// Its name.
    pub(crate) name: String,
    /// The part.
    pub(crate) part: usize,
    /// \[m\] a point of the line.
    pub(crate) line: Vector3<f64>,
    /// Its direction.
    pub(crate) across: Vector3<f64>,
    /// \[m\] the point of the part, world.
    pub(crate) at: Vector3<f64>,
    /// \[N/m\]
    pub(crate) stiffness: f64,
    /// \[N·s/m\]
    pub(crate) damping: f64,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// A constant force at a centre of mass.
#[derive(Clone, Debug)]
pub(crate) struct Load {
    /// The part.
    pub(crate) part: usize,
    /// \[N\] world.
    pub(crate) force: Vector3<f64>,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// An input or a read-out with its keys as written.
#[derive(Clone, Debug)]
pub(crate) struct Signal {
    /// Its name.
    pub(crate) name: String,
    /// Its type.
    pub(crate) kind: &'static str,
    /// Further keys, each `key = value`.
    pub(crate) keys: Vec<String>,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// A sphere or a point on a plane.
pub(crate) struct Contact {
    /// Its name.
    pub(crate) name: String,
    /// The part with the plane and the part with the sphere.
    pub(crate) between: [Side; 2],
    /// \[m\] a point of the plane and the centre of the sphere, world, at the start of the scene.
    pub(crate) points: [Vector3<f64>; 2],
    /// Normal of the plane, world.
    pub(crate) normal: Vector3<f64>,
    /// \[m\]
    pub(crate) radius: f64,
    /// Keys of friction and rolling resistance, each `key = value`.
    pub(crate) grip: Vec<String>,
    /// Its origin in the file.
    pub(crate) source: Source,
}

/// The data of a scene.
pub(crate) struct Mechanism<'m> {
    /// The bodies.
    pub(crate) tree: &'m Tree,
    /// The rigid parts.
    pub(crate) parts: &'m Parts,
    /// The poses.
    pub(crate) pose: &'m Pose,
    /// The options.
    pub(crate) options: &'m Options,
    /// Joints.
    pub(crate) links: Vec<Link>,
    /// Torsion springs.
    pub(crate) torsions: Vec<Torsion>,
    /// Springs along slides and tendons.
    pub(crate) lines: Vec<Line>,
    /// Ranges of tendons, and what slides need that no joint has.
    pub(crate) interactions: Vec<Interaction>,
    /// Springs of slides in the plane.
    pub(crate) rails: Vec<Rail>,
    /// Coordinates of joints, by their bodies.
    pub(crate) coordinates: BTreeMap<usize, Coordinate>,
    /// Joint axes of the coordinates that have one.
    pub(crate) axes: BTreeMap<usize, Axis>,
    /// Couplings of joints.
    pub(crate) couplings: Vec<Coupling>,
    /// The elements of their springs.
    pub(crate) elements: BTreeMap<usize, String>,
    /// Tendons by their names, and the elements of their springs.
    pub(crate) tendons: BTreeMap<String, (Coordinate, Option<String>)>,
    /// Fixed tendons of one joint by their names: the body of the joint, and its factor.
    pub(crate) scaled: BTreeMap<String, (usize, f64)>,
    /// \[kg·m², kg\] inertia driven by hinges and slides, by body.
    pub(crate) driven: BTreeMap<usize, f64>,
    /// Bodies whose joints have rotors.
    pub(crate) rotors: BTreeSet<usize>,
    /// Whether the scene is planar.
    pub(crate) planar: bool,
    /// Contacts.
    pub(crate) contacts: Vec<Contact>,
    /// Loads.
    pub(crate) loads: Vec<Load>,
    /// Inputs.
    pub(crate) inputs: Vec<Signal>,
    /// Read-outs.
    pub(crate) readouts: Vec<Signal>,
    /// Notes for the user.
    pub(crate) notes: Vec<String>,
    names: BTreeSet<String>,
}

impl<'m> Mechanism<'m> {
    /// Parts at their poses, without connections.
    pub(crate) fn new(
        tree: &'m Tree,
        parts: &'m Parts,
        pose: &'m Pose,
        options: &'m Options,
    ) -> Self {
        Self {
            tree,
            parts,
            pose,
            options,
            links: Vec::new(),
            torsions: Vec::new(),
            lines: Vec::new(),
            interactions: Vec::new(),
            rails: Vec::new(),
            coordinates: BTreeMap::new(),
            axes: BTreeMap::new(),
            couplings: Vec::new(),
            elements: BTreeMap::new(),
            tendons: BTreeMap::new(),
            scaled: BTreeMap::new(),
            rotors: BTreeSet::new(),
            driven: BTreeMap::new(),
            planar: false,
            contacts: Vec::new(),
            loads: Vec::new(),
            inputs: Vec::new(),
            readouts: Vec::new(),
            notes: Vec::new(),
            names: BTreeSet::new(),
        }
    }

    /// An unused name of a joint or element: the desired one, or that with a number.
    pub(crate) fn own_name(&mut self, wanted: &str) -> String {
        let wanted = fitting(wanted);
        let numbered = (2..).map(|number| format!("{wanted}-{number}"));
        let mut names = std::iter::once(wanted.clone()).chain(numbered);
        let name = names.find(|name| !self.names.contains(name)).unwrap_or_default();
        self.names.insert(name.clone());
        name
    }

    /// A name unused by bodies and by `others`: the desired one, or that with its kind.
    pub(crate) fn signal_name(&self, wanted: &str, kind: &str, others: &[Signal]) -> String {
        let taken = |name: &String| {
            let body = self.tree.bodies.iter().any(|body| body.name == *name);
            body || others.iter().any(|signal| signal.name == *name)
        };
        let wanted = fitting(wanted);
        let numbered = (2..).map(|number| format!("{wanted}-{kind}-{number}"));
        let mut names = [wanted.clone(), format!("{wanted}-{kind}")].into_iter().chain(numbered);
        names.find(|name| !taken(name)).unwrap_or_default()
    }

    /// The name of a part.
    pub(crate) fn name(&self, side: Side) -> &str {
        side.map_or("world", |part| &self.tree.bodies[self.parts.parts[part].named].name)
    }

    /// The initial pose of a part's principal axes.
    pub(crate) fn placed(&self, part: usize) -> Isometry3<f64> {
        let part = &self.parts.parts[part];
        self.pose.start[part.lead] * part.frame
    }

    /// The part that a body belongs to.
    pub(crate) fn side(&self, body: usize) -> Side {
        self.parts.of[body].0
    }

    /// A point of a body's frame in world coordinates at the start of the scene.
    pub(crate) fn point(&self, body: usize, point: Vector3<f64>) -> Vector3<f64> {
        moved(&self.pose.start[body], point)
    }

    /// A world point in the axes of a part, relative to its centre of mass.
    pub(crate) fn within(&self, side: Side, point: Vector3<f64>) -> Vector3<f64> {
        side.map_or(point, |part| moved(&self.placed(part).inverse(), point))
    }

    /// \[m\] the span of a joint: as given, else twice the radius of gyration of the smaller side, so that rotational
    /// and translational frequencies are similar.
    pub(crate) fn span(&self, between: [Side; 2]) -> f64 {
        let of = |part: usize| self.parts.parts[part].mass.gyration();
        let least = between.into_iter().flatten().map(of).fold(f64::INFINITY, f64::min);
        let chosen = rounded(2.0 * least);
        self.options.span.unwrap_or(if chosen.is_finite() && chosen > 0.0 { chosen } else { 1.0 })
    }

    /// \[m\] the largest distance between parts, at least the span of the largest part.
    pub(crate) fn size(&self) -> f64 {
        let places: Vec<Vector3<f64>> =
            (0..self.parts.parts.len()).map(|part| self.placed(part).translation.vector).collect();
        let low = places.iter().fold(Vector3::repeat(f64::INFINITY), |low, p| low.inf(p));
        let high = places.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
        let spread = (high - low).norm();
        let gyration = self.parts.parts.iter().map(|part| part.mass.gyration()).fold(0.0, f64::max);
        rounded(spread.max(2.0 * gyration))
    }
}

/// Rounds a chosen value to two digits.
pub(crate) fn rounded(size: f64) -> f64 {
    format!("{size:.1e}").parse().unwrap_or(size)
}
