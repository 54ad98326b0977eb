//! `[[body]]`: mass, principal inertia and state at t = 0.
//!
//! `tables => bodies in the assembly, places of the points`. A body's pose is given in the world, in the frame of
//! another body, or by the points between which it lies.

use dbd_kernel::{Body, BodyState, F64, Vec3};

use crate::assembly::{Assembly, WORLD};
use crate::error::SceneError;
use crate::links::{self, Link};
use crate::names::Names;
use crate::orientation::Orientation;
use crate::points::{self, Frame, Node, Places, PrecisePlace};
use crate::text::{Number, Numbers, Table, Value};

const KEYS: &[&str] =
    &["name", "mass", "inertia", "position", "orientation", "velocity", "angular_velocity", "link"];

/// Relative slack of the triangle inequality: an inertia computed for a thin plate meets it with
/// equality but for rounding.
const TRIANGLE_SLACK: f64 = 1e-9;

/// A body that was read.
struct Read {
    body: Body<f64>,
    state: BodyState<F64>,
    link: Option<Link>,
}

/// Reads all points and bodies; adds the bodies in scene order.
pub(crate) fn read_all(root: &Table<'_>, assembly: &mut Assembly) -> Result<(), SceneError> {
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
                let body = read(table, &places, root.has("assemble"))?;
                places.add_frame(name, frame(&body.state));
                bodies[row] = Some(body);
            }
        }
    }
    for ((name, table), read) in tables.iter().zip(bodies) {
        let Some(Read { body, state, link }) = read else { continue };
        let row = assembly.add_body(name, body, state).map_err(|defect| defect.refuse(table))?;
        let ends = link.into_iter().flat_map(|link| link.ends);
        let ends = ends.map(|end| (end.point, Vec3::from_f64(end.place)));
        assembly.set_ends(row, ends.collect());
    }
    assembly.set_points(places.rounded());
    Ok(())
}

/// The tables of all bodies with their names.
fn named<'t>(root: &Table<'t>) -> Result<Vec<(String, Table<'t>)>, SceneError> {
    let tables = root.list("body")?;
    if tables.is_empty() {
        let help = "a scene has at least one [[body]] with a name, a mass and an inertia";
        return Err(match root.value("body") {
            Some(value) => value.refuse_with("holds no body", help),
            None => root.refuse("has no bodies", help),
        });
    }
    let mut names = Names::default();
    let mut named = Vec::new();
    for table in tables {
        table.only(&[KEYS])?;
        let name = names.read(&table, "body", ())?;
        if name == WORLD {
            let help = "the world is there without being declared; a body has another name";
            return Err(table.refuse_value("name", "is \"world\"", help));
        }
        named.push((name, table));
    }
    Ok(named)
}

/// The frame of a body at its initial pose.
fn frame(state: &BodyState<F64>) -> Frame {
    Frame { origin: state.position.into(), axes: links::axes_of(state.orientation.to_f64()) }
}

fn read(table: &Table<'_>, places: &Places, is_assembled: bool) -> Result<Read, SceneError> {
    let link = match table.value("link") {
        Some(value) => {
            let link =
                value.table("{ from = \"A\", to = \"B\" }, the points between which it lies")?;
            link.only(&[links::KEYS])?;
            Some(links::read(&link, places, is_assembled)?)
        }
        None => None,
    };
    let body = mass_and_inertia(table)?;
    let (position, orientation) = match &link {
        Some(link) => {
            for key in ["position", "orientation"] {
                if table.has(key) {
                    let help = "a link gives position and orientation; `centre`, `along` and \
                                `reference` of the link change them";
                    return Err(table.refuse_key(key, "contradicts `link`", help));
                }
            }
            (link.position, link.orientation)
        }
        None => {
            let position = table.required("position", PrecisePlace(places))?;
            let orientation = table.optional("orientation", Orientation)?;
            (position, orientation.unwrap_or([1.0, 0.0, 0.0, 0.0]))
        }
    };
    let velocity = table.optional("velocity", Numbers(Number::any("m/s")))?.unwrap_or_default();
    let angular_velocity =
        table.optional("angular_velocity", Numbers(Number::any("rad/s")))?.unwrap_or_default();
    let position = position.nearest().to_f64();
    let state = BodyState::from_f64(position, orientation, velocity, angular_velocity);
    Ok(Read { body, state, link })
}

/// Reads `mass` and `inertia`.
pub(crate) fn mass_and_inertia(table: &Table<'_>) -> Result<Body<f64>, SceneError> {
    let mass = table.required("mass", Number::positive("kg"))?;
    let inertia = table.required("inertia", Numbers(Number::positive("kg·m²")))?;
    if let Some(value) = table.value("inertia") {
        refuse_impossible(&value, inertia)?;
    }
    Ok(Body::from_f64(mass, inertia))
}

/// Refuses an inertia that no distribution of mass has: one moment above the sum of the others.
fn refuse_impossible(value: &Value<'_>, inertia: [f64; 3]) -> Result<(), SceneError> {
    let [x, y, z] = inertia;
    for (name, one, others, sum) in
        [("Ix", x, "Iy + Iz", y + z), ("Iy", y, "Ix + Iz", x + z), ("Iz", z, "Ix + Iy", x + y)]
    {
        if one > sum * (1.0 + TRIANGLE_SLACK) {
            let problem = format!("breaks the triangle inequality: {name} = {one:?} > {sum:?}");
            let help = format!(
                "{name} ≤ {others}, and likewise for the others: principal moments of a rigid \
                 body about its centre of mass"
            );
            return Err(value.refuse_with(&problem, help));
        }
    }
    Ok(())
}
