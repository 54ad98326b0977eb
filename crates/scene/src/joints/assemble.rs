//! `[assemble]`: bodies are moved until all joints are closed.
//!
//! `table, joints at the given poses => states in the assembly, what was moved and by how much`.

use dbd_kernel::{BodyState, F64, Vec3};

use crate::assembly::{Assembly, WORLD};
use crate::between::BodyName;
use crate::closure::{self, Closure, MAX_BODIES, Opening, Outcome, Settings, Turn};
use crate::error::SceneError;
use crate::joints::rates::{self, Joints};
use crate::joints::site::{Site, poses, shown};
use crate::joints::types::{KEYS as JOINT_KEYS, kind};
use crate::shortened::shortened;
use crate::spring;
use crate::text::{Kind, Number, Table, Text, Value};

pub(super) const KEYS: &[&str] = &["fixed", "angles", "rates", "length", "tolerance", "iterations"];

/// \[m\] default tolerance of a closed joint.
const TOLERANCE: f64 = 1e-9;

/// Default maximum number of steps.
const ITERATIONS: usize = 200;

/// \[m, rad\] smaller values are rounding errors.
pub(crate) const ROUNDING: f64 = 1e-12;

/// Result of closing the joints of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembled {
    /// The bodies that were moved, in the order of the scene.
    pub moved: Vec<Moved>,
    /// The joints that were open, in the order of the scene.
    pub open: Vec<OpenJoint>,
    /// The joint with the largest remaining gap; `None` without joints.
    pub left: Option<OpenJoint>,
    /// The bodies that were given velocities that the joints allow, in the order of the scene.
    pub set_moving: Vec<String>,
    /// Number of steps computed.
    pub iterations: usize,
    /// Freedoms of the movable bodies.
    pub freedoms: usize,
    /// Number of redundant constraints.
    pub held_twice: usize,
    /// \[m\] the length at which a radian counted as a metre.
    pub length: f64,
}

/// A body that was moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Its name.
    pub body: String,
    /// \[m\] displacement of its centre of mass.
    pub distance: f64,
    /// \[rad\] angle of its rotation.
    pub angle: f64,
}

/// A joint that was open at the given poses.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenJoint {
    /// Its name.
    pub joint: String,
    /// \[m\].
    pub distance: f64,
    /// \[rad\].
    pub angle: f64,
}

/// Moves the bodies of a scene that has a table `assemble`.
pub(crate) fn read(
    root: &Table<'_>,
    assembly: &mut Assembly,
) -> Result<Option<Assembled>, SceneError> {
    let Some(value) = root.value("assemble") else { return Ok(None) };
    if !value.get().is_table() {
        return Err(value.wrong_type("a table, opened by [assemble]"));
    }
    let table = value.table("a table, opened by [assemble]")?;
    table.only(&[KEYS])?;
    let tolerance = table.optional("tolerance", Number::positive("m"))?.unwrap_or(TOLERANCE);
    let iterations = table.optional("iterations", Steps)?.unwrap_or(ITERATIONS);
    let fixed = match table.value("fixed") {
        Some(value) => fixed(&value, assembly)?,
        None => Vec::new(),
    };
    let mut movable = vec![true; assembly.states().len()];
    fixed.iter().for_each(|row| movable[*row] = false);

    let tables = root.list("joint")?;
    let sites = tables.iter().map(|table| {
        let kind = kind(table)?;
        table.only(&[JOINT_KEYS, kind.keys, spring::KEYS])?;
        Site::read(table, kind, assembly)
    });
    let sites = sites.collect::<Result<Vec<_>, _>>()?;
    let closures: Vec<_> = sites.iter().map(|site| site.closure(assembly)).collect();
    let length = match table.optional("length", Number::positive("m"))? {
        Some(length) => length,
        None => closure::arm(&closures, &movable),
    };
    let largest = closure::largest_island(&closures, &movable);
    if largest > MAX_BODIES {
        let problem = format!("has to move {largest} connected bodies");
        let help = format!(
            "at most {MAX_BODIES} can be assembled at once: separate them with `fixed`, or give all poses \
             and remove [assemble]"
        );
        return Err(value.refuse_with(&problem, help));
    }
    let settings = Settings { length, iterations };
    let given = poses(assembly);
    let turned = match table.value("angles") {
        Some(value) => Some(angles(&value, &tables, &closures)?),
        None => None,
    };
    let mut outcome =
        closure::close(turned.as_ref().unwrap_or(&closures), &given, &movable, settings);
    // NaN counts as open.
    let is_closed = |opening: &Opening| opening.distance + length * opening.angle <= tolerance;
    if !outcome.openings.iter().all(is_closed) {
        let gaps = closure::gaps(&closures, &given, &movable, length, &outcome);
        let spent = outcome.iterations >= iterations;
        return Err(open(&tables, &gaps, (&sites, &movable), (length, spent), assembly));
    }
    if turned.is_some() {
        // The closed joints without prescribed angles: nothing moves, and their freedoms are counted.
        let joints = closure::close(&closures, &outcome.poses, &movable, settings);
        (outcome.freedoms, outcome.held_twice) = (joints.freedoms, joints.held_twice);
    }
    let open = tables.iter().zip(&closures).filter_map(|(table, closure)| {
        let Opening { distance, angle } = closure.opening(&given);
        let name = table.optional("name", Text::Any).ok().flatten().unwrap_or_default();
        (distance + length * angle > ROUNDING).then_some(OpenJoint { joint: name, distance, angle })
    });
    let left = tables.iter().zip(&outcome.openings).map(|(table, opening)| OpenJoint {
        joint: table.label().to_owned(),
        distance: opening.distance,
        angle: opening.angle,
    });
    let size = |open: &OpenJoint| open.distance + length * open.angle;
    let left = left.max_by(|a, b| size(a).total_cmp(&size(b)));
    let Outcome { iterations, freedoms, held_twice, .. } = outcome;
    let open = open.collect();
    let moved = place(assembly, &given, &outcome);
    let joints = Joints { tables: &tables, closures: &closures, length };
    let set_moving = rates::set(root, &table, &joints, &outcome.poses, assembly)?;
    Ok(Some(Assembled { moved, open, left, set_moving, iterations, freedoms, held_twice, length }))
}

/// The closures of the joints, some rotated by an angle \[rad\] from the given poses.
fn angles(
    value: &Value<'_>,
    tables: &[Table<'_>],
    closures: &[Closure],
) -> Result<Vec<Closure>, SceneError> {
    let table = value.table("{ JOINT = angle }, in rad from the given poses")?;
    let mut turned = closures.to_vec();
    for (row, value) in rates::by_joint(&table, tables, "angles")? {
        let kind = kind(&tables[row])?.name;
        let closure = &mut turned[row];
        if closure.turn != Turn::Axis {
            let problem = format!("is the angle of a {kind} joint");
            let help = "give angles of revolute and cylindrical joints only";
            return Err(value.refuse_with(&problem, help));
        }
        let angle = Number::any("rad").read(&value)?;
        let back = closure::exponential(Vec3::new(0.0, 0.0, -angle));
        closure.turn = Turn::All;
        closure.triads[1] = closure.triads[1].product(back);
    }
    Ok(turned)
}

/// Moves the bodies of the assembly to the poses found.
fn place(assembly: &mut Assembly, given: &[closure::Pose], outcome: &Outcome) -> Vec<Moved> {
    let mut moved = Vec::new();
    for (row, (pose, given)) in outcome.poses.iter().zip(given).enumerate() {
        if pose == given {
            continue;
        }
        let old = assembly.states()[row];
        let state =
            BodyState::<F64> { position: pose.position, orientation: pose.orientation, ..old };
        assembly.set_state(row, state);
        let [shift, turn] = pose.since(given).map(closure::length);
        if shift > ROUNDING || turn > ROUNDING {
            let body = assembly.body_names()[row].clone();
            moved.push(Moved { body, distance: shift, angle: turn });
        }
    }
    assembly.set_assembled();
    moved
}

/// The error of joints that do not close, at the one with the largest gap.
fn open(
    tables: &[Table<'_>],
    gaps: &[Opening],
    (sites, movable): (&[Site], &[bool]),
    (length, spent): (f64, bool),
    assembly: &Assembly,
) -> SceneError {
    let size = |row: &usize| gaps[*row].distance + length * gaps[*row].angle;
    let mut rows: Vec<usize> = (0..tables.len()).collect();
    // The first of equal ones.
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let worst = rows[0];
    let others = rows[1..].iter().filter(|row| size(row) > 1e-2 * size(&worst));
    let others = others.map(|row| format!("{} by {}", tables[*row].label(), shown(gaps[*row])));
    let others: Vec<String> = others.collect();
    let pair = &sites[worst].pair;
    let stands =
        [pair.a, pair.b].iter().all(|end| !movable.get(end.row()).copied().unwrap_or(false));
    let problem = format!("stays open by {} at the closest poses found", shown(gaps[worst]));
    let mut help = if stands {
        let [a, b] = &pair.names;
        format!("neither `{a}` nor `{b}` may be moved: remove one of them from `fixed`")
    } else {
        let all = assembly.states().len() == movable.iter().filter(|free| **free).count();
        format!(
            "use other lengths, {}{}or poses nearer to the closed ones; `tolerance` in [assemble] allows a gap",
            if all { "" } else { "fewer `fixed` bodies, " },
            if spent { "more `iterations`, " } else { "" },
        )
    };
    if !others.is_empty() {
        let more = others.len().saturating_sub(4);
        help += &format!("; also open: {}", others[..others.len() - more].join(", "));
        if more > 0 {
            help += &format!(" and {more} more");
        }
    }
    tables[worst].refuse(&problem, help)
}

/// A number of steps.
struct Steps;

impl Kind for Steps {
    type Output = usize;

    fn expected(&self) -> String {
        "a whole number from 1 to 10000".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<usize, SceneError> {
        let number = Number::any("").read(value)?;
        if !(1.0..=10_000.0).contains(&number) || number.fract() != 0.0 {
            let written = shortened(value.written());
            return Err(value.refuse(&format!("is {written}"), &self.expected()));
        }
        Ok(number as usize)
    }
}

/// The indices of the fixed bodies.
fn fixed(value: &Value<'_>, assembly: &Assembly) -> Result<Vec<usize>, SceneError> {
    let name = BodyName { assembly, world: false };
    let entries =
        value.array(|| format!("an array of names of bodies; `{WORLD}` is always fixed"))?;
    entries.iter().map(|entry| Ok(name.read(entry)?.1.row())).collect()
}
