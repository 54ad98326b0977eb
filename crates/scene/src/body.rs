//! `[[body]]`: mass, principal inertia and state at t = 0.
//!
//! `tables => bodies in the assembly, positions of the points`. A body's pose is given in the world, in the frame of
//! another body, or by the two points of a link; its inertia as moments, as a tensor or by a shape.

use dbd_kernel::{Body, BodyState, F64, Quaternion, Vec3};

use crate::assembly::{Assembly, WORLD};
use crate::derived::DerivedBody;
use crate::error::SceneError;
use crate::inertia::{self, AnyInertia, Inertia, PrincipalInertia, Section};
use crate::links::{self, Link};
use crate::names::Names;
use crate::orientation::{Orientation, normalised};
use crate::points::{self, Frame, Node, Places, PrecisePlace};
use crate::precise::Precise;
use crate::text::{Choice, Kind as _, Number, Numbers, Switch, Table};

pub(crate) const KEYS: &[&str] = &[
    "name",
    "mass",
    "inertia",
    "driven",
    "position",
    "orientation",
    "velocity",
    "angular_velocity",
    "frame",
    "link",
    "shape",
];

/// The keys of a shape that does not belong to a link, besides those of its section.
pub(crate) const SHAPE: &[&str] = &["type", "along", "length"];

/// A body as read.
struct Read {
    body: Body<f64>,
    state: BodyState<F64>,
    /// Rotation from its principal axes to its given axes.
    turn: Option<Quaternion<f64>>,
    ends: Vec<links::End>,
    derived: Option<DerivedBody>,
}

/// Reads all points and bodies; adds the bodies in scene order. Returns the bodies whose mass or inertia is derived.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
) -> Result<Vec<DerivedBody>, SceneError> {
    let tables = named(root)?;
    let points = points::written(root)?;
    let point_names = points.iter().map(|(name, _)| name.clone()).collect();
    let body_names = tables.iter().map(|(name, _)| name.clone()).collect();
    let mut places = Places::new(point_names, body_names);
    let mut bodies: Vec<_> = tables.iter().map(|_| None).collect();
    for node in points::order(&points, &tables)? {
        match node {
            Node::Point(row) => {
                let (name, value) = &points[row];
                places.read(value, name)?;
            }
            Node::Body(row) => {
                let (name, table) = &tables[row];
                let body = read(root, table, name, &places)?;
                places.add_frame(name, body.frame());
                bodies[row] = Some(body);
            }
        }
    }
    let mut derived = Vec::new();
    for ((name, table), read) in tables.iter().zip(bodies) {
        let Some(read) = read else { continue };
        let row = assembly
            .add_body(name, read.body, read.state)
            .map_err(|defect| defect.refuse(table))?;
        assembly.set_turn(row, read.turn);
        let ends = read.ends.into_iter();
        let ends = ends.map(|end| (end.point, assembly.of_written(row, end.place)));
        let ends = ends.collect();
        assembly.set_ends(row, ends);
        derived.extend(read.derived);
    }
    assembly.set_points(places.rounded());
    Ok(derived)
}

/// The tables of all bodies with their names.
fn named<'t>(root: &Table<'t>) -> Result<Vec<(String, Table<'t>)>, SceneError> {
    let tables = root.list("body")?;
    if tables.is_empty() {
        let help = "add at least one [[body]] with a name, a mass and an inertia";
        return Err(match root.value("body") {
            Some(value) => value.refuse_with("is empty", help),
            None => root.refuse("has no bodies", help),
        });
    }
    let mut names = Names::default();
    let mut named = Vec::new();
    for table in tables {
        table.only(&[KEYS])?;
        let name = names.read(&table, "body", ())?;
        if name == WORLD {
            let help = "the world is predefined; give the body another name";
            return Err(table.refuse_value("name", "is \"world\"", help));
        }
        named.push((name, table));
    }
    Ok(named)
}

impl Read {
    /// The frame of its given axes at its centre of mass, with its motion.
    fn frame(&self) -> Frame {
        let state = &self.state;
        let spin_w = state.orientation.rotation().to_world(state.angular_velocity);
        let orientation = match self.turn {
            Some(turn) => normalised(state.orientation.product(turn.conjugate()).to_f64()),
            None => state.orientation.to_f64(),
        };
        Frame {
            origin: state.position.into(),
            axes: links::axes_of(orientation),
            orientation,
            velocity: state.velocity,
            spin_w,
        }
    }
}

/// A body's pose and motion in its given axes.
struct Pose {
    position: Vec3<f64>,
    orientation: [f64; 4],
    velocity: Vec3<f64>,
    /// In the given axes.
    angular_velocity: Vec3<f64>,
}

fn read(
    root: &Table<'_>,
    table: &Table<'_>,
    name: &str,
    places: &Places,
) -> Result<Read, SceneError> {
    let (link, section) = match table.value("link") {
        Some(value) => {
            let link =
                value.table("{ from = \"A\", to = \"B\" }, the points that the link connects")?;
            let (link, section) = read_link(root, table, link, places)?;
            (Some(link), Some(section))
        }
        None => (None, shape(root, table)?),
    };
    let (mass, inertia) = mass_and_inertia_of(table, section.as_ref())?;
    let pose = pose(table, link.as_ref(), places)?;
    let turn = inertia.turn.map(Quaternion::from_f64);
    let (orientation, angular_velocity) = match turn {
        Some(turn) => {
            let written = Quaternion::from_f64(pose.orientation);
            let orientation = normalised(written.product(turn).to_f64());
            (orientation, turn.rotation().to_body(pose.angular_velocity))
        }
        None => (pose.orientation, pose.angular_velocity),
    };
    let [position, velocity, angular_velocity] =
        [pose.position, pose.velocity, angular_velocity].map(Vec3::to_f64);
    let is_derived = turn.is_some() || section.is_some();
    let uniform = section.as_ref().filter(|_| !table.has("inertia"));
    let derived = is_derived.then(|| DerivedBody {
        name: name.to_owned(),
        shape: uniform.map(|section| section.name),
        solid: uniform.and_then(|section| section.solid.clone()),
        length: link.as_ref().map(|link| link.length.nearest()),
        mass,
        inertia: inertia.moments,
        turned: turn.map_or(0.0, |turn| {
            let v = turn.v;
            2.0 * libm::atan2(libm::sqrt(v.dot(v)), turn.w.abs())
        }),
    });
    let body = Body::from_f64(mass, inertia.moments);
    let driven = table.optional("driven", Switch)?.unwrap_or_default();
    Ok(Read {
        body: if driven { body.driven() } else { body },
        state: BodyState::from_f64(position, orientation, velocity, angular_velocity),
        turn,
        ends: link.map_or_else(Vec::new, |link| link.ends),
        derived,
    })
}

fn read_link(
    root: &Table<'_>,
    table: &Table<'_>,
    link: Table<'_>,
    places: &Places,
) -> Result<(Link, Section), SceneError> {
    for key in ["position", "orientation", "frame", "shape"] {
        if table.has(key) {
            let help = "a link defines position, orientation and shape; use its `centre`, `along`, \
                        `reference` and `shape` to change them";
            return Err(table.refuse_key(key, "contradicts `link`", help));
        }
    }
    let link = link.with_defaults(root, "link")?;
    link.only(&[links::KEYS, inertia::KEYS])?;
    let read = links::read(&link, places, root.has("assemble"))?;
    let place = (read.length, read.along);
    let section = inertia::section(&link, "shape", links::KEYS, place, table.has("mass"))?;
    Ok((read, section))
}

/// Reads `shape`.
fn shape(root: &Table<'_>, table: &Table<'_>) -> Result<Option<Section>, SceneError> {
    let expected =
        "a uniform body: { type = \"box\", length = m, section = [m, m], density = kg/m³ }";
    let Some(value) = table.value("shape") else { return Ok(None) };
    let shape = value.table(expected)?.with_defaults(root, "shape")?;
    shape.only(&[SHAPE, &inertia::KEYS[1..]])?;
    if !shape.has("type") {
        return Err(shape.missing("type", &Choice(&inertia::NAMES).expected()));
    }
    let along = shape.optional("along", Choice(&["x", "y", "z"]))?.unwrap_or(0);
    let is_sphere = shape.value("type").is_some_and(|kind| kind.get().as_str() == Some("sphere"));
    let length = match is_sphere {
        true => 0.0,
        false => shape.required("length", Number::positive("m"))?,
    };
    let others: &[&str] = if is_sphere { &[] } else { &["along", "length"] };
    inertia::section(&shape, "type", others, (length.into(), along), table.has("mass")).map(Some)
}

/// Mass and inertia: keys of the body's own table take precedence over its link or shape.
fn mass_and_inertia_of(
    table: &Table<'_>,
    section: Option<&Section>,
) -> Result<(f64, Inertia), SceneError> {
    let number = Number::positive("kg");
    let own = table.optional("mass", number)?;
    let Some(mass) = own.map(Precise::from).or(section.and_then(|section| section.mass)) else {
        let or = if section.is_some() { ", or `density` or `mass` of its shape" } else { "" };
        return Err(table.missing("mass", &format!("{}{or}", number.expected())));
    };
    match section {
        Some(section) if !table.has("inertia") => {
            let moments = section.moments.map(|moment| (moment * mass).nearest());
            if !moments.iter().all(|moment| moment.is_normal()) {
                let [x, y, z] = moments;
                let problem = format!("has moments of inertia of {x:e}, {y:e} and {z:e} kg·m²");
                return Err(table.refuse(
                    &problem,
                    "use sizes and a mass within the range of double precision",
                ));
            }
            Ok((mass.nearest(), Inertia { moments, turn: None }))
        }
        _ => Ok((mass.nearest(), table.required("inertia", AnyInertia)?)),
    }
}

/// Pose and motion of a body, from its points or its own numbers, in the world or in a frame.
fn pose(table: &Table<'_>, link: Option<&Link>, places: &Places) -> Result<Pose, SceneError> {
    let frame = table.value("frame").map(|value| points::body_frame(&value, places)).transpose()?;
    let (position, orientation) = match link {
        Some(link) => (link.position, link.orientation),
        None => {
            let given = table.value("position").map(|value| value.get().is_array());
            let place = table.required("position", PrecisePlace(places))?;
            let own = table.optional("orientation", Orientation)?;
            let own = own.unwrap_or([1.0, 0.0, 0.0, 0.0]);
            match &frame {
                Some(frame) => {
                    // A named point is a position in the world in any frame.
                    let is_in_frame = given == Some(true);
                    let place = if is_in_frame { frame.place(place).unsigned() } else { place };
                    (place, turned(frame.orientation, own))
                }
                None => (place, own),
            }
        }
    };
    let velocity = table.optional("velocity", Numbers(Number::any("m/s")))?.unwrap_or_default();
    let angular_velocity =
        table.optional("angular_velocity", Numbers(Number::any("rad/s")))?.unwrap_or_default();
    let mut pose = Pose {
        position: position.nearest(),
        orientation,
        velocity: Vec3::from_f64(velocity),
        angular_velocity: Vec3::from_f64(angular_velocity),
    };
    if let Some(frame) = frame {
        let rotation = Quaternion::<f64>::from_f64(frame.orientation).rotation();
        let arm = pose.position - frame.origin.nearest();
        pose.velocity =
            (frame.velocity + frame.spin_w.cross(arm)) + rotation.to_world(pose.velocity);
        let own = Quaternion::<f64>::from_f64(pose.orientation).rotation();
        pose.angular_velocity = pose.angular_velocity + own.to_body(frame.spin_w);
    }
    Ok(pose)
}

/// Transforms an orientation from a frame to the world; the identity of either keeps the bits of the other.
fn turned(frame: [f64; 4], own: [f64; 4]) -> [f64; 4] {
    const UNTURNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
    if own == UNTURNED {
        frame
    } else if frame == UNTURNED {
        own
    } else {
        let [frame, own] = [frame, own].map(Quaternion::<f64>::from_f64);
        normalised(frame.product(own).to_f64())
    }
}

/// Reads `mass` and `inertia` about the principal axes.
pub(crate) fn mass_and_inertia(table: &Table<'_>) -> Result<Body<f64>, SceneError> {
    let mass = table.required("mass", Number::positive("kg"))?;
    Ok(Body::from_f64(mass, table.required("inertia", PrincipalInertia)?))
}
