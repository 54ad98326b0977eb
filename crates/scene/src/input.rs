//! `[[input]]`: quantities driven at run time by a controller, a road or a table.
//!
//! `table => input of the model`. A type is one row of [`TYPES`]: its keys and its reader.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::{BodyIndex, F64, Geometry, GroupIndex, InputIndex, LoadFrame, Vec3};

use crate::assembly::NoAnchor;
use crate::between::BodyName;
use crate::drive::{self, Drive, INPUT as KEYS};
use crate::error::SceneError;
use crate::free_length;
use crate::hinge::Hinge;
use crate::interaction::{self, Driven};
use crate::joints::JointPlace;
use crate::known::{Known, hinge, slide};
use crate::names::Names;
use crate::points::PlaceOf;
use crate::target::{ElementName, Kinds, Target};
use crate::text::{Choice, Direction, Kind, Table, Value};

/// Description of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct InputInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `joint_torque`.
    pub kind: &'static str,
    /// The unit of its value.
    pub unit: &'static str,
    /// Whether a table or a sine of the scene drives it; otherwise the caller does.
    pub table: bool,
    /// \[its unit\] the least and the largest value that the caller can set; infinite without bounds.
    pub range: [f64; 2],
    /// Its index in the model.
    pub index: InputIndex,
}

struct InputType {
    name: &'static str,
    unit: &'static str,
    keys: &'static [&'static str],
    read: fn(&Table<'_>, &mut Known<'_>) -> Result<InputKind<F64>, SceneError>,
}

/// The keys of a torque and of a force at a joint, with those of a signal chain.
const TORQUE: &[&str] =
    &["target", "axis", "about", "lag", "delay", "limits", "rate_limit", "period"];
const FORCE: &[&str] = &["target", "lag", "delay", "limits", "rate_limit", "period"];

static TYPES: [InputType; 12] = [
    InputType { name: "force", unit: "N", keys: &["body", "point", "axis", "frame"], read: force },
    InputType { name: "torque", unit: "N·m", keys: &["body", "axis", "frame"], read: torque },
    InputType { name: "joint_torque", unit: "N·m", keys: TORQUE, read: joint_torque },
    InputType { name: "joint_force", unit: "N", keys: FORCE, read: joint_force },
    InputType { name: "actuator", unit: "N", keys: &["target"], read: actuator },
    InputType { name: "gravity", unit: "m/s²", keys: &["axis"], read: gravity },
    InputType { name: "velocity", unit: "m/s", keys: &["body", "axis"], read: velocity },
    InputType {
        name: "angular_velocity",
        unit: "rad/s",
        keys: &["body", "axis"],
        read: angular_velocity,
    },
    InputType { name: "anchor", unit: "m", keys: &["target", "axis"], read: anchor },
    InputType { name: free_length::TYPE, unit: "m", keys: interaction::WINCH, read: signal },
    // Its unit is that of its mode.
    InputType { name: interaction::DRIVE_TYPE, unit: "", keys: interaction::DRIVE, read: signal },
    InputType { name: "signal", unit: "", keys: &[], read: signal },
];

/// Every key of every type.
pub(crate) fn keys() -> Vec<&'static [&'static str]> {
    let types = TYPES.iter().map(|kind| kind.keys);
    [KEYS, &drive::KEYS].into_iter().chain(types).collect()
}

/// The types, each with all its keys.
pub(crate) fn types() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    TYPES.iter().map(|kind| (kind.name, [KEYS, &drive::KEYS, kind.keys].concat()))
}

/// Reads all inputs in scene order.
pub(crate) fn read_all(
    root: &Table<'_>,
    known: &mut Known<'_>,
) -> Result<Vec<InputInfo>, SceneError> {
    let mut names = Names::default();
    let mut infos: Vec<InputInfo> = Vec::new();
    for (number, table) in root.list("input")?.into_iter().enumerate() {
        let kind = kind(&table)?;
        table.only(&[KEYS, &drive::KEYS, kind.keys])?;
        let name = names.read(&table, "input", ())?;
        let made = (kind.read)(&table, known)?;
        let unit = match kind.name == interaction::DRIVE_TYPE {
            true => Driven::read(&table, known.places, known.elements)?.unit(),
            false => kind.unit,
        };
        let mut drive = drive::read(&table, unit)?;
        let is_length = kind.name == free_length::TYPE;
        if is_length {
            let one = (number, &table);
            drive = interaction::drive_of_length(root, one, drive, known.assembly)?;
        }
        if drive == Drive::Over && matches!(made, InputKind::Anchor { .. }) {
            let help = "use a `table` over time or a `sine`: an anchor needs its rate, which a read-out \
                        does not give";
            return Err(table.refuse_key(
                "over",
                "is not compatible with the type \"anchor\"",
                help,
            ));
        }
        let mut range = drive::range(&table, &drive, unit)?;
        if is_length {
            range = interaction::range_of_length(&table, range)?;
        }
        let index = known
            .assembly
            .add_input(made, &drive, range)
            .map_err(|defect| defect.refuse(&table))?;
        if is_length {
            known.assembly.start_input(index, drive.start());
        }
        let table = !matches!(drive, Drive::Caller(_));
        infos.push(InputInfo { name, kind: kind.name, unit, table, range, index });
    }
    Ok(infos)
}

/// Accepts only the keys of its type: defaults of other types do not apply.
pub(crate) fn allow(table: &Table<'_>) -> Result<(), SceneError> {
    table.only(&[KEYS, &drive::KEYS, kind(table)?.keys])
}

fn kind(table: &Table<'_>) -> Result<&'static InputType, SceneError> {
    if !table.has("type") {
        let mut keys = vec![KEYS, &drive::KEYS];
        keys.extend(TYPES.iter().map(|kind| kind.keys));
        table.only(&keys)?;
    }
    let index = table.required("type", Choice(&TYPES.each_ref().map(|kind| kind.name)))?;
    Ok(&TYPES[index])
}

fn force(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    let body = BodyName { assembly: known.assembly, world: false };
    let (_, body) = table.required("body", body)?;
    let place = PlaceOf { assembly: known.assembly, body };
    let point = table.optional("point", place)?.unwrap_or_default();
    let (direction, frame) = axis(table, known, body)?;
    Ok(InputKind::Force { body, point: F64::local_from_f64(point.to_f64()), direction, frame })
}

fn torque(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    let body = BodyName { assembly: known.assembly, world: false };
    let (_, body) = table.required("body", body)?;
    let (axis, frame) = axis(table, known, body)?;
    Ok(InputKind::Torque { body, axis, frame })
}

/// `axis` and its frame.
fn axis(
    table: &Table<'_>,
    known: &Known<'_>,
    body: BodyIndex,
) -> Result<(Vec3<f64>, LoadFrame), SceneError> {
    let axis = table.required("axis", Direction)?;
    let frame = frame(table)?;
    let axis = match frame {
        LoadFrame::Body => known.assembly.of_written(body, axis),
        LoadFrame::World => axis,
    };
    Ok((axis, frame))
}

fn frame(table: &Table<'_>) -> Result<LoadFrame, SceneError> {
    Ok(match table.optional("frame", Choice(&["world", "body"]))? {
        Some(1) => LoadFrame::Body,
        _ => LoadFrame::World,
    })
}

fn joint_torque(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    if interaction::has_chain(table) {
        return signal(table, known);
    }
    let Hinge { a, b, axis } = hinge(table, known)?;
    let in_b = known.assembly.vector_in(b, known.assembly.direction_w(a, axis));
    Ok(InputKind::JointTorque { a, b, axes: [axis, in_b] })
}

fn joint_force(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    if interaction::has_chain(table) {
        return signal(table, known);
    }
    let JointPlace { pair, at_w, axis_w, .. } = slide(table, known, "a joint_force")?;
    let point = known.assembly.point_in(pair.b, *at_w);
    let axis = known.assembly.vector_in(pair.a, *axis_w);
    Ok(InputKind::JointForce { a: pair.a, b: pair.b, point, axis })
}

fn actuator(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    let name = ElementName { elements: known.elements, kinds: Kinds::TSDA };
    let (name, target) = table.required("target", name)?;
    let group = match target {
        Target::Tsda(group) => group,
        _ => usize::MAX,
    };
    let directed = known.assembly.size(group) > 0.0;
    if !directed {
        let problem =
            format!("names the tsda `{name}`, which has no free length and therefore no direction");
        let help = "name a tsda with `free_length` > 0, along which the actuator pulls";
        return Err(table.refuse_value("target", &problem, help));
    }
    Ok(InputKind::Actuator { group: GroupIndex(group as u16), element: 0 })
}

fn gravity(table: &Table<'_>, _: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    Ok(InputKind::Gravity { direction: table.required("axis", Direction)? })
}

fn velocity(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    let (body, direction) = driven(table, known)?;
    Ok(InputKind::Velocity { body, direction })
}

fn angular_velocity(
    table: &Table<'_>,
    known: &mut Known<'_>,
) -> Result<InputKind<F64>, SceneError> {
    let (body, axis) = driven(table, known)?;
    Ok(InputKind::AngularVelocity { body, axis })
}

/// The driven body and the `axis` of an input that moves it.
fn driven(table: &Table<'_>, known: &Known<'_>) -> Result<(BodyIndex, Vec3<f64>), SceneError> {
    let body = BodyName { assembly: known.assembly, world: false };
    let (name, body) = table.required("body", body)?;
    if !known.assembly.is_driven(body) {
        let problem = format!("names `{name}`, which forces move");
        let help = "set `driven = true` in its [[body]]: only inputs then move it";
        return Err(table.refuse_value("body", &problem, help));
    }
    Ok((body, table.required("axis", Direction)?))
}

/// The law that reads it is another part of the scene.
fn signal(_: &Table<'_>, _: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    Ok(InputKind::Signal)
}

fn anchor(table: &Table<'_>, known: &mut Known<'_>) -> Result<InputKind<F64>, SceneError> {
    let direction: Vec3<f64> = table.required("axis", Direction)?;
    let Some(value) = table.value("target") else {
        return Err(table.missing("target", &Targets(known).expected()));
    };
    for (name, target) in Targets(known).read(&value)? {
        let groups = match target {
            Target::Joint(joint) => {
                known.joints.get(joint).map_or(0..0, |info| info.groups.clone())
            }
            Target::Tsda(group) | Target::PointOnLine(group) => group..group + 1,
            Target::TorsionSpring(_) | Target::Interaction(_) | Target::Winch(_) => 0..0,
        };
        let mut moved = Err(NoAnchor::NoGround);
        for group in groups {
            // Only one of the two groups of a universal joint is attached to the ground.
            match known.assembly.anchor(group) {
                Err(NoAnchor::NoGround) => {}
                other => moved = other,
            }
        }
        moved.map_err(|why| no_anchor(&value, &name, why))?;
    }
    Ok(InputKind::Anchor { direction })
}

fn no_anchor(value: &Value<'_>, name: &str, why: NoAnchor) -> SceneError {
    let (problem, help) = match why {
        NoAnchor::NoGround => (
            format!("names `{name}`, which is not joined to the world"),
            "name an element that joins a body to \"world\": an anchor moves its points on the ground"
                .into(),
        ),
        NoAnchor::Taken(input) => (
            format!("names `{name}`, which input {} already moves", input + 1),
            "move each element by one input; change the `axis` of that input instead".into(),
        ),
        NoAnchor::TooLate => (
            "belongs to an anchor after the first 255 inputs".into(),
            String::from("put anchors among the first 255 inputs of the scene"),
        ),
    };
    value.refuse_with(&problem, help)
}

/// The name of an element that acts on points, or an array of such names.
struct Targets<'k, 'a>(&'k Known<'a>);

impl Kind for Targets<'_, '_> {
    type Output = Vec<(String, Target)>;

    fn expected(&self) -> String {
        "the name of a joint, a tsda or a point_on_line, or an array of such names".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let name = ElementName { elements: self.0.elements, kinds: Kinds::PULLING };
        if value.get().as_str().is_some() {
            return Ok(vec![name.read(value)?]);
        }
        let entries = value.array(|| self.expected())?;
        if entries.is_empty() {
            return Err(value.refuse("is empty", &self.expected()));
        }
        let mut targets: Self::Output = Vec::new();
        for entry in &entries {
            let target = name.read(entry)?;
            if targets.iter().any(|(known, _)| *known == target.0) {
                let problem = format!("names `{}` a second time", target.0);
                return Err(entry.refuse_with(&problem, "name each element once"));
            }
            targets.push(target);
        }
        Ok(targets)
    }
}
