//! `[[readout]]`: the sensors of a plant.
//!
//! `table => read-out of the kernel`. Read-outs are not part of the model, except for angles and their rates: where no
//! torsion spring has the same axis, one without stiffness is added to count revolutions.

use dbd_kernel::readouts::{Readout, Slide};
use dbd_kernel::{F64, Geometry, GroupIndex, LawIndex, TorsionIndex, Vec3};

use crate::between::BodyName;
use crate::columns::Taken;
use crate::error::SceneError;
use crate::input::InputInfo;
use crate::interaction::sensor_name;
use crate::joints::JointPlace;
use crate::known::{Known, hinge, slide};
use crate::names::Names;
use crate::nearest::nearest;
use crate::points::PlaceOf;
use crate::target::{ElementName, Kinds, Target};
use crate::text::{Choice, Number, Table, Text};

/// A read-out of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadoutInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `joint_angle`.
    pub kind: &'static str,
    /// Its columns in order: the suffix of its name, `""` or `".x"`, and the unit.
    pub columns: Vec<(&'static str, &'static str)>,
    /// The kernel's sensor, in double precision.
    pub readout: Readout<F64>,
    /// The number of its table in the scene file; a read-out with a `sensor` and that sensor share one.
    pub table: usize,
}

type Read = fn(&Table<'_>, &mut Known<'_>, &[InputInfo]) -> Result<Readout<F64>, SceneError>;

struct ReadoutType {
    name: &'static str,
    columns: Columns,
    keys: &'static [&'static str],
    read: Read,
}

/// The quantities of a type.
enum Columns {
    /// A number in a unit.
    Scalar(&'static str),
    /// x, y, z in a unit.
    Vector(&'static str),
    /// Specific force and angular rate.
    Imu,
    /// A number in the unit of the input.
    Input,
    /// A number in the unit of the interaction's quantity.
    Law,
}

static TYPES: [ReadoutType; 11] = [
    ReadoutType {
        name: "joint_angle",
        columns: Columns::Scalar("rad"),
        keys: &["target", "axis", "about", "offset", "sensor"],
        read: |table, known, _| {
            let offset = table.optional("offset", Number::any("rad"))?.unwrap_or_default();
            Ok(Readout::JointAngle { spring: spring(table, known)?, offset })
        },
    },
    ReadoutType {
        name: "joint_rate",
        columns: Columns::Scalar("rad/s"),
        keys: &["target", "axis", "about", "sensor"],
        read: |table, known, _| Ok(Readout::JointRate { spring: spring(table, known)? }),
    },
    ReadoutType {
        name: "joint_travel",
        columns: Columns::Scalar("m"),
        keys: &["target", "offset", "sensor"],
        read: |table, known, _| {
            let offset = table.optional("offset", Number::any("m"))?.unwrap_or_default();
            Ok(Readout::JointTravel { slide: travel(table, known, "a joint_travel")?, offset })
        },
    },
    ReadoutType {
        name: "joint_travel_rate",
        columns: Columns::Scalar("m/s"),
        keys: &["target", "sensor"],
        read: |table, known, _| {
            Ok(Readout::JointTravelRate { slide: travel(table, known, "a joint_travel_rate")? })
        },
    },
    ReadoutType {
        name: "point",
        columns: Columns::Vector("m"),
        keys: &["body", "point"],
        read: |table, known, _| {
            let (body, point) = point(table, known)?;
            Ok(Readout::Point { body, point })
        },
    },
    ReadoutType {
        name: "point_velocity",
        columns: Columns::Vector("m/s"),
        keys: &["body", "point"],
        read: |table, known, _| {
            let (body, point) = point(table, known)?;
            Ok(Readout::PointVelocity { body, point })
        },
    },
    ReadoutType {
        name: "tsda_force",
        columns: Columns::Scalar("N"),
        keys: &["target"],
        read: |table, known, _| tsda_force(table, known),
    },
    ReadoutType {
        name: "joint_force",
        columns: Columns::Vector("N"),
        keys: &["target"],
        read: |table, known, _| joint_force(table, known),
    },
    ReadoutType {
        name: "imu",
        columns: Columns::Imu,
        keys: &["body", "point"],
        read: |table, known, _| {
            let (body, point) = point(table, known)?;
            if known.assembly.is_driven(body) {
                let help = "name a body that forces move: an accelerometer reads what they give it";
                return Err(table.refuse_value("body", "names a driven body", help));
            }
            Ok(Readout::Imu { body, point })
        },
    },
    ReadoutType {
        name: "input",
        columns: Columns::Input,
        keys: &["target"],
        read: |table, _, inputs| Ok(Readout::Input { input: input(table, inputs)?.index }),
    },
    ReadoutType {
        name: "interaction",
        columns: Columns::Law,
        keys: &["target", "quantity"],
        read: |table, known, _| {
            let (law, quantity, _) = quantity(table, known)?;
            Ok(Readout::Law { law: LawIndex(law as u16), quantity: quantity as u8 })
        },
    },
];

const KEYS: &[&str] = &["name", "type"];

/// Every key of every type.
pub(crate) fn keys() -> Vec<&'static [&'static str]> {
    let types = TYPES.iter().map(|kind| kind.keys);
    std::iter::once(KEYS).chain(types).collect()
}

/// The types, each with all its keys.
pub(crate) fn types() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    TYPES.iter().map(|kind| (kind.name, [KEYS, kind.keys].concat()))
}

/// Reads all read-outs in scene order, and adds names for the torsion springs that they require.
pub(crate) fn read_all(
    root: &Table<'_>,
    known: &mut Known<'_>,
    inputs: &[InputInfo],
    torsion_names: &mut Vec<String>,
) -> Result<Vec<ReadoutInfo>, SceneError> {
    let mut names = Names::default();
    let mut infos = Vec::new();
    let mut taken = Taken::new(known.assembly.body_names());
    for (number, table) in root.list("readout")?.into_iter().enumerate() {
        let kind = kind(&table)?;
        table.only(&[KEYS, kind.keys])?;
        let name = names.read(&table, "readout", ())?;
        let readout = (kind.read)(&table, known, inputs)?;
        while torsion_names.len() < known.assembly.torsions() {
            torsion_names.push(table.label().to_owned());
        }
        let columns = match kind.columns {
            Columns::Scalar(unit) => vec![("", unit)],
            Columns::Vector(unit) => [".x", ".y", ".z"].map(|column| (column, unit)).to_vec(),
            Columns::Imu => {
                let forces = [".ax", ".ay", ".az"].map(|column| (column, "m/s²"));
                let rates = [".wx", ".wy", ".wz"].map(|column| (column, "rad/s"));
                [forces, rates].concat()
            }
            Columns::Input => vec![("", input(&table, inputs)?.unit)],
            Columns::Law => vec![("", quantity(&table, known)?.2)],
        };
        let sensor = sensor_name(&name);
        let measured = match known.elements.get(&sensor) {
            Some(Target::Interaction(row)) if table.has("sensor") => Some(*row),
            _ => None,
        };
        let shown = columns.iter().map(|(end, _)| format!("{name}{end}"));
        for column in shown.chain(measured.map(|_| sensor.clone())) {
            if let Err(owner) = taken.take(column.clone(), table.label()) {
                let problem = format!(
                    "gives the trace a column `{column}`, which {owner} already \
                    gives"
                );
                let help = format!("use another name, e.g. \"{}\"", another(&name, kind.name));
                return Err(table.refuse_value("name", &problem, help));
            }
        }
        let measured = measured.map(|row| ReadoutInfo {
            name: sensor,
            kind: kind.name,
            columns: columns.clone(),
            readout: Readout::Law { law: LawIndex(row as u16), quantity: 0 },
            table: number,
        });
        infos.push(ReadoutInfo { name, kind: kind.name, columns, readout, table: number });
        infos.extend(measured);
    }
    Ok(infos)
}

/// A free name similar to a taken one: `tool` of a `point` becomes `tool_point`.
fn another(name: &str, kind: &str) -> String {
    format!("{}_{kind}", name.replace('.', "_"))
}

/// Restricts a table to the keys of its type; defaults of other types do not apply.
pub(crate) fn allow(table: &Table<'_>) -> Result<(), SceneError> {
    table.only(&[KEYS, kind(table)?.keys])
}

fn kind(table: &Table<'_>) -> Result<&'static ReadoutType, SceneError> {
    if !table.has("type") {
        let mut keys = vec![KEYS];
        keys.extend(TYPES.iter().map(|kind| kind.keys));
        table.only(&keys)?;
    }
    let index = table.required("type", Choice(&TYPES.each_ref().map(|kind| kind.name)))?;
    Ok(&TYPES[index])
}

/// The torsion spring about the axis of `target`.
fn spring(table: &Table<'_>, known: &mut Known<'_>) -> Result<TorsionIndex, SceneError> {
    let hinge = hinge(table, known)?;
    known.assembly.carrier(&hinge).map_err(|defect| defect.refuse(table))
}

/// The translation of the joint `target`: that of its laws.
fn travel(table: &Table<'_>, known: &Known<'_>, who: &str) -> Result<Slide<F64>, SceneError> {
    let JointPlace { pair, at_w, axis_w, .. } = slide(table, known, who)?;
    let bodies = [pair.a, pair.b];
    let points = bodies.map(|body| known.assembly.point_in(body, *at_w));
    Ok(Slide { bodies, points, axis: known.assembly.vector_in(pair.a, *axis_w) })
}

fn point(
    table: &Table<'_>,
    known: &Known<'_>,
) -> Result<(dbd_kernel::BodyIndex, Vec3<f64>), SceneError> {
    let body = BodyName { assembly: known.assembly, world: false };
    let (_, body) = table.required("body", body)?;
    let place = PlaceOf { assembly: known.assembly, body };
    let point = table.optional("point", place)?.unwrap_or_default();
    Ok((body, F64::local_from_f64(point.to_f64())))
}

/// The row of an interaction, the index of the quantity and its unit.
fn quantity(
    table: &Table<'_>,
    known: &Known<'_>,
) -> Result<(usize, usize, &'static str), SceneError> {
    let name = ElementName { elements: known.elements, kinds: Kinds::INTERACTION };
    let (name, target) = table.required("target", name)?;
    let row = match target {
        Target::Interaction(row) | Target::Winch(row) => row,
        _ => usize::MAX,
    };
    let quantities = known.quantities.get(row).copied().unwrap_or_default();
    if quantities.is_empty() {
        let help = "expected an interaction whose law has quantities";
        return Err(table.refuse_value(
            "target",
            &format!("names `{name}`, whose law has no quantities"),
            help,
        ));
    }
    let names: Vec<&'static str> = quantities.iter().map(|quantity| quantity.name).collect();
    let place = table.required("quantity", Choice(&names))?;
    let unit = quantities[place].unit;
    // A plain number has none.
    Ok((row, place, if unit == "1" { "" } else { unit }))
}

fn tsda_force(table: &Table<'_>, known: &Known<'_>) -> Result<Readout<F64>, SceneError> {
    let name = ElementName { elements: known.elements, kinds: Kinds::ANY_TSDA };
    let (name, target) = table.required("target", name)?;
    if let Target::Winch(law) = target {
        // Its first quantity is its tension.
        return Ok(Readout::Law { law: LawIndex(law as u16), quantity: 0 });
    }
    let group = group_of(target, known);
    let directed = known.assembly.size(group) > 0.0;
    if !directed {
        let problem = format!(
            "names the tsda `{name}`, which has no direction because its free \
            length is 0"
        );
        let help = "use a tsda with `free_length` > 0, or `type = \"joint_force\"`, which gives \
            the force as a vector";
        return Err(table.refuse_value("target", &problem, help));
    }
    Ok(Readout::TsdaForce { group: GroupIndex(group as u16), element: 0 })
}

fn joint_force(table: &Table<'_>, known: &Known<'_>) -> Result<Readout<F64>, SceneError> {
    let name = ElementName { elements: known.elements, kinds: Kinds::PULLING };
    let (_, target) = table.required("target", name)?;
    Ok(Readout::JointForce { group: GroupIndex(group_of(target, known) as u16) })
}

/// The group of an element; for a joint the last one, which acts on its second body.
fn group_of(target: Target, known: &Known<'_>) -> usize {
    match target {
        Target::Joint(joint) => {
            known.joints.get(joint).map_or(0, |info| info.groups.end.saturating_sub(1))
        }
        Target::Tsda(group) | Target::PointOnLine(group) => group,
        Target::TorsionSpring(_) | Target::Interaction(_) | Target::Winch(_) => usize::MAX,
    }
}

fn input<'i>(table: &Table<'_>, inputs: &'i [InputInfo]) -> Result<&'i InputInfo, SceneError> {
    let name = table.required("target", Text::Name)?;
    inputs.iter().find(|input| input.name == name).ok_or_else(|| {
        let help = match nearest(&name, inputs.iter().map(|input| input.name.as_str())) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => "expected the name of an input".into(),
        };
        table.refuse_value("target", &format!("names no input: \"{name}\""), help)
    })
}
