//! `rates` of `[assemble]` and velocities of bodies: prescribed velocities, and consistent velocities of all bodies.
//!
//! `tables, joints at their assembled poses => velocities in the assembly`. A body whose table has `velocity` or
//! `angular_velocity` keeps them; a joint's rate is that of its second body relative to its first, about or along the
//! axis.

use dbd_kernel::{BodyState, F64, Geometry};

use crate::assembly::Assembly;
use crate::closure::{Closure, Contradiction, Motion, Pose, Prescribed, motions};
use crate::error::SceneError;
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::{Kind, Number, Table, Text, Value};

/// The keys of the rate of a cylindrical joint.
pub(super) const RATES: &[&str] = &["turn", "slide"];

const TURN: Number = Number::any("rad/s");
const SLIDE: Number = Number::any("m/s");

/// A prescribed velocity and its value in the scene.
struct Source<'t> {
    prescribed: Prescribed,
    value: Value<'t>,
}

/// Joints of an assembled scene.
pub(super) struct Joints<'j, 't> {
    pub(super) tables: &'j [Table<'t>],
    pub(super) closures: &'j [Closure],
    /// \[m\] the length at which a radian counts as a metre.
    pub(super) length: f64,
}

/// Gives all bodies velocities that their joints allow. Returns the names of those with a nonzero velocity that was
/// not prescribed.
pub(super) fn set(
    root: &Table<'_>,
    table: &Table<'_>,
    joints: &Joints<'_, '_>,
    poses: &[Pose],
    assembly: &mut Assembly,
) -> Result<Vec<String>, SceneError> {
    let mut sources = of_bodies(root, assembly)?;
    if let Some(value) = table.value("rates") {
        of_joints(&value, joints, &mut sources)?;
    }
    let prescribed: Vec<_> = sources.iter().map(|source| source.prescribed).collect();
    let motions = motions(joints.closures, poses, &prescribed, joints.length)
        .map_err(|found| refuse(&found, &sources))?;
    let mut names = Vec::new();
    for (row, Motion { velocity, spin }) in motions.into_iter().enumerate() {
        let has = |test: fn(&Prescribed) -> Option<usize>| {
            prescribed.iter().any(|given| test(given) == Some(row))
        };
        let has_velocity = has(|given| match given {
            Prescribed::Velocity(body, _) => Some(*body),
            _ => None,
        });
        let has_spin = has(|given| match given {
            Prescribed::Spin(body, _) => Some(*body),
            _ => None,
        });
        let mut state = assembly.states()[row];
        let frame = F64::frame(&state.position, &state.orientation);
        if !has_velocity {
            state.velocity = velocity;
        }
        if !has_spin {
            state.angular_velocity = F64::to_body(&frame, spin);
        }
        if state != assembly.states()[row] {
            names.push(assembly.body_names()[row].clone());
            assembly.set_velocities(row, state);
        }
    }
    Ok(names)
}

/// Velocities prescribed by bodies.
fn of_bodies<'t>(root: &Table<'t>, assembly: &Assembly) -> Result<Vec<Source<'t>>, SceneError> {
    let mut sources = Vec::new();
    for (row, (table, state)) in root.list("body")?.iter().zip(assembly.states()).enumerate() {
        let BodyState::<F64> { velocity, angular_velocity, .. } = *state;
        if let Some(value) = table.value("velocity") {
            sources.push(Source { prescribed: Prescribed::Velocity(row, velocity), value });
        }
        if let Some(value) = table.value("angular_velocity") {
            let frame = F64::frame(&state.position, &state.orientation);
            let spin = F64::to_world(&frame, angular_velocity);
            sources.push(Source { prescribed: Prescribed::Spin(row, spin), value });
        }
    }
    Ok(sources)
}

/// The values of a table by names of joints, with the index of each joint.
pub(super) fn by_joint<'t>(
    table: &Table<'t>,
    joints: &[Table<'_>],
    key: &str,
) -> Result<Vec<(usize, Value<'t>)>, SceneError> {
    let name = |table: &Table<'_>| table.optional("name", Text::Any).ok().flatten();
    let names: Vec<_> = joints.iter().map(|table| name(table).unwrap_or_default()).collect();
    let row = |(joint, value): (String, Value<'t>)| {
        let Some(row) = names.iter().position(|name| *name == joint) else {
            let help = match nearest(&joint, names.iter().map(String::as_str)) {
                Some(meant) => format!("did you mean `{meant}`? `{key}` accepts names of joints"),
                None => format!("`{key}` accepts names of joints"),
            };
            return Err(
                value.refuse_with(&format!("is not a joint: \"{}\"", shortened(&joint)), help)
            );
        };
        Ok((row, value))
    };
    table.named()?.into_iter().map(row).collect()
}

/// The rates of joints.
fn of_joints<'t>(
    value: &Value<'t>,
    joints: &Joints<'_, '_>,
    sources: &mut Vec<Source<'t>>,
) -> Result<(), SceneError> {
    let table = value.table("{ JOINT = rate }, in rad/s about a joint's axis or m/s along it")?;
    for (row, value) in by_joint(&table, joints.tables, "rates")? {
        let kind = super::kind(&joints.tables[row])?.name;
        let mut push = |prescribed, value| sources.push(Source { prescribed, value });
        match kind {
            "revolute" => {
                let rate = TURN.read(&value)?;
                push(Prescribed::Turn(row, rate), value);
            }
            "translational" => {
                let rate = SLIDE.read(&value)?;
                push(Prescribed::Slide(row, rate), value);
            }
            "cylindrical" if value.get().is_table() => {
                let table = value.table("{ turn = rad/s, slide = m/s }")?;
                table.only(&[RATES])?;
                if let (Some(rate), Some(value)) =
                    (table.optional("turn", TURN)?, table.value("turn"))
                {
                    push(Prescribed::Turn(row, rate), value);
                }
                if let (Some(rate), Some(value)) =
                    (table.optional("slide", SLIDE)?, table.value("slide"))
                {
                    push(Prescribed::Slide(row, rate), value);
                }
            }
            "cylindrical" => {
                let help = "give { turn = rad/s, slide = m/s } or one of the two";
                return Err(value.refuse_with("is ambiguous for a cylindrical joint", help));
            }
            kind => {
                let problem = format!("is the rate of a {kind} joint");
                let help = "give rates of revolute, cylindrical and translational joints only; for other \
                            motions give a body's `velocity` and `angular_velocity`";
                return Err(value.refuse_with(&problem, help));
            }
        }
    }
    Ok(())
}

/// The error of a prescribed value that cannot be satisfied.
fn refuse(found: &Contradiction, sources: &[Source<'_>]) -> SceneError {
    let Source { prescribed, value } = &sources[found.row];
    let near = short(found.nearest);
    let problem = match (found.is_held, prescribed) {
        (true, _) => "is a motion that the joints prevent".to_owned(),
        (_, Prescribed::Turn(..)) => {
            format!("is inconsistent with the other velocities: {near} rad/s is consistent")
        }
        (_, Prescribed::Slide(..)) => {
            format!("is inconsistent with the other velocities: {near} m/s is consistent")
        }
        (_, Prescribed::Velocity(..)) => {
            format!(
                "is inconsistent with the joints and the other velocities: it is off by {near} m/s"
            )
        }
        (_, Prescribed::Spin(..)) => {
            format!(
                "is inconsistent with the joints and the other velocities: it is off by {near} rad/s"
            )
        }
    };
    let help = match found.is_held {
        true => {
            "give the rate of another joint or none: loops of joints prevent this motion; \
                 `host-sim check` lists the free motions"
        }
        false => {
            "with [assemble], give at most as many velocities as there are degrees of freedom, by \
             `rates` or for bodies; the others follow from the joints"
        }
    };
    value.refuse_with(&problem, help)
}

/// Formats with four digits.
fn short(value: f64) -> String {
    let text = format!("{value:.3e}");
    text.parse::<f64>().map_or(text, |rounded| match rounded.abs() {
        size if size == 0.0 || (1e-3..1e5).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    })
}
