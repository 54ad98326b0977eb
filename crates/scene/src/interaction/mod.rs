//! `[[interaction]]`, and the laws of joints, springs, drives and couplings.
//!
//! `tables => rows of laws`.

mod common;
mod field;
mod of_chains;
mod of_couplings;
mod of_drives;
mod of_joints;
mod of_springs;
mod of_winches;
mod of_windings;

pub(crate) use of_chains::{SENSOR, has_chain, sensor_name};
pub(crate) use of_couplings::{KEYS as COUPLING, TERM};
pub(crate) use of_drives::{Driven, GEAR, KEYS as DRIVE, SHAFT_FRICTION, TYPE as DRIVE_TYPE};
pub(crate) use of_joints::{FRICTION, LIMITS, LOAD, ROTOR};
pub(crate) use of_winches::{
    KEYS as WINCH, check as check_lengths, drive_of as drive_of_length, range_of as range_of_length,
};

pub(crate) use of_windings::{AXES, WINDING};

use std::sync::Arc;

use dbd_kernel::laws;

use crate::assembly::Assembly;
use crate::between::Between;
use crate::drive;
use crate::error::SceneError;
use crate::file_lines::LawPlace;
use crate::free_length::winches;
use crate::interaction::field::{Named, Of, Reading};
use crate::interaction::of_couplings::Coupled;
use crate::interaction::of_drives::OtherInputs;
use crate::interaction::of_joints::{OF_JOINTS, OfJoint, keys_of, law_of, softened};
use crate::joints::{self, JointPlace};
use crate::laws::{KnownLaw, SourceRows, known_laws};
use crate::nearest::nearest;
use crate::pair::Pair;
use crate::shortened::shortened;
use crate::target::{Elements, Target};
use crate::text::{Kind, Table, Text, Value};

pub(crate) const KEYS: &[&str] = &["name", "law", "between"];

/// The name of a law.
struct LawName<'k>(&'k [KnownLaw]);

impl Kind for LawName<'_> {
    type Output = usize;

    fn expected(&self) -> String {
        let names: Vec<_> = self.0.iter().map(|law| format!("\"{}\"", law.name)).collect();
        format!("the name of a law: {}", names.join(", "))
    }

    fn read(&self, value: &Value<'_>) -> Result<usize, SceneError> {
        let name = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        self.0.iter().position(|law| law.name == name).ok_or_else(|| {
            let meant = match nearest(name, self.0.iter().map(|law| law.name)) {
                Some(meant) => format!("did you mean \"{meant}\"? "),
                None => String::new(),
            };
            let help = format!(
                "{meant}known laws: {}; `host-sim new laws` creates a crate for user-defined laws",
                self.expected().trim_start_matches("the name of a law: "),
            );
            value.refuse_with(&format!("names no law: \"{}\"", shortened(name)), help)
        })
    }
}

/// Labels and quantities of the interactions of a scene.
#[derive(Default)]
pub(crate) struct Read {
    /// Labels in messages, in the order of the model's rows.
    pub(crate) labels: Vec<String>,
    /// Position of each in the scene.
    pub(crate) places: Vec<LawPlace>,
    /// Quantities of each.
    pub(crate) quantities: Vec<&'static [laws::Quantity]>,
}

/// An interaction as read: its optional name, its table for errors, its label, its position in the scene.
struct One<'t> {
    name: Option<String>,
    table: Table<'t>,
    label: String,
    place: LawPlace,
    /// Its quantities if they differ from those of its law.
    quantities: Option<&'static [laws::Quantity]>,
}

/// The rows of each law added so far.
struct Rows<'t> {
    known: Vec<KnownLaw>,
    named: Named,
    /// Per law: index among the known laws, rows, and their interactions.
    laws: Vec<(usize, Box<dyn SourceRows>, Vec<One<'t>>)>,
}

impl<'t> Rows<'t> {
    /// Adds a row of the law with this index among the known laws.
    fn add(
        &mut self,
        law: usize,
        assembly: &Assembly,
        (pair, of): (&Pair, Of<'_>),
        one: One<'t>,
    ) -> Result<(), SceneError> {
        let place = self.laws.iter().position(|(of, ..)| *of == law).unwrap_or_else(|| {
            let path = self.known[law].path.clone();
            self.laws.push((law, (self.known[law].table)(path), Vec::new()));
            self.laws.len() - 1
        });
        let (_, rows, of_law) = &mut self.laws[place];
        let table = &one.table;
        let mut reading = Reading::new(table, assembly, pair, of, &self.named);
        let done = rows.add([pair.a, pair.b], &mut reading);
        if let Some(refused) = reading.into_refused() {
            return Err(refused);
        }
        if done.is_none() {
            return Err(
                table.refuse("lacks a constant of its law", "give all constants of the law")
            );
        }
        if let Some(wrong) = rows.wrong() {
            let help = format!("`{}` of {} must be {}", wrong.field, table.label(), wrong.expected);
            return Err(table.refuse_value(wrong.field, wrong.problem, help));
        }
        of_law.push(one);
        Ok(())
    }
}

/// Reads all interactions, those of joints before those of `[[interaction]]`: those of one law are contiguous in the
/// model, and laws are in the order of their first use in the scene.
pub(crate) fn read_all(
    root: &Table<'_>,
    joints: &[JointPlace],
    assembly: &mut Assembly,
    elements: &mut Elements,
) -> Result<Read, SceneError> {
    let mut rows = Rows { known: known_laws(), named: Named::default(), laws: Vec::new() };
    rows.named.joints = joints.iter().map(|joint| (joint.name.clone(), joint.group)).collect();
    for table in root.list("input")? {
        rows.named.inputs.push(table.optional("name", Text::Name)?.unwrap_or_default());
    }
    of_joints(root, joints, assembly, &mut rows)?;
    of_springs(root, assembly, &mut rows)?;
    of_winches(root, elements, assembly, &mut rows)?;
    of_drives(root, (joints, elements), assembly, &mut rows)?;
    of_couplings(root, (joints, elements), assembly, &mut rows)?;
    of_chains(root, (joints, elements), assembly, &mut rows)?;
    for (number, table) in root.list("interaction")?.into_iter().enumerate() {
        let known = &rows.known;
        if !table.has("law") {
            table.only(&[KEYS, &all_fields(known)])?;
        }
        let law = table.required("law", LawName(known))?;
        if !known[law].is_between() {
            let help = "use a [[coupling]] for a sum of joint coordinates";
            return Err(table.refuse_value("law", "is not a law between two bodies", help));
        }
        if let Some(soft) = softened(known[law].name).filter(|_| table.has("soft")) {
            let help = format!("set `law = \"{soft}\"`, the same stop with a soft start");
            return Err(table.refuse_key("soft", "needs another law", help));
        }
        let fields = known[law].fields.iter();
        table.only(&[KEYS, &fields.map(|field| field.name).collect::<Vec<_>>()])?;
        let pair = table.required("between", Between(assembly))?;
        if pair.b.is_world() {
            let help = "put the ground first: between = [\"world\", BODY]";
            return Err(table.refuse_value("between", "has the ground as its second body", help));
        }
        let (label, place) = (pair.label(&table), ("interaction", number));
        let one = One { name: None, table, label, place, quantities: None };
        rows.add(law, assembly, (&pair, Of::Itself), one)?;
    }
    let mut read = Read::default();
    let mut sources = Vec::new();
    for (law, source, of_law) in rows.laws {
        for One { name, table, label, place, quantities } in of_law {
            let is_winch = place.0 == "tsda" && rows.known[law].name == of_winches::LAW;
            let target = match is_winch {
                true => Target::Winch(read.labels.len()),
                false => Target::Interaction(read.labels.len()),
            };
            match name {
                Some(name) => {
                    let kind = if is_winch { "tsda" } else { "interaction" };
                    elements.add(&table, name, kind, target)?;
                }
                None if place.0 == "tsda" || place.0 == "torsion_spring" => {}
                None => elements.read_optional(&table, "interaction", target)?,
            }
            read.labels.push(label);
            read.places.push(place);
            read.quantities.push(quantities.unwrap_or(rows.known[law].quantities));
        }
        sources.push(Arc::from(source));
    }
    assembly.set_laws(&sources);
    Ok(read)
}

/// Reads `limits`, `friction` and `rotor` of joints.
fn of_joints<'t>(
    root: &Table<'t>,
    joints: &[JointPlace],
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    for (number, (joint, place)) in root.list("joint")?.into_iter().zip(joints).enumerate() {
        joints::allow(&joint)?;
        for (_, key, law) in OF_JOINTS.iter().filter(|(kind, ..)| *kind == place.kind) {
            let Some(value) = joint.value(key) else { continue };
            let table = value.table(keys_of(key).1)?;
            table.only(&[keys_of(key).0])?;
            let law = law_of(&table, law)?;
            let Some(law) = rows.known.iter().position(|known| known.name == law) else {
                continue;
            };
            let of_joint = OfJoint::new(&table, key, (place, rows.known[law].fields), assembly)?;
            let name = format!("{}.{key}", place.name);
            let [a, b] = &place.pair.names;
            let label = format!("{key} `{name}` ({a}–{b})");
            let place_of = ("joint", number);
            let one = One { name: Some(name), table, label, place: place_of, quantities: None };
            rows.add(law, assembly, (&place.pair, Of::Joint(of_joint)), one)?;
        }
    }
    Ok(())
}

/// Reads `limits` of raw TSDAs and of torsion springs.
fn of_springs<'t>(
    root: &Table<'t>,
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    for (kind, law) in [("tsda", "distance-stop"), ("torsion_spring", "hinge-stop")] {
        for (number, owner) in root.list(kind)?.into_iter().enumerate() {
            let Some(value) = owner.value("limits") else { continue };
            let table = value.table("{ from = …, to = …, stiffness = … }")?;
            let (pair, of) = of_springs::limits(&owner, &table, kind, assembly)?;
            let law = law_of(&table, law)?;
            let Some(law) = rows.known.iter().position(|known| known.name == law) else { continue };
            let called = owner.optional("name", Text::Name)?;
            let name = called.as_ref().map(|called| format!("{called}.limits"));
            let label = match &name {
                Some(name) => format!("limits `{name}` ({}–{})", pair.names[0], pair.names[1]),
                None => format!("limits of {}", pair.label(&owner)),
            };
            let one = One { name, table, label, place: (kind, number), quantities: None };
            rows.add(law, assembly, (&pair, of), one)?;
        }
    }
    Ok(())
}

/// Reads TSDAs with a free length that an input sets.
fn of_winches<'t>(
    root: &Table<'t>,
    elements: &Elements,
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    let winches = winches(root)?;
    of_winches::check_targets(root, &winches, elements)?;
    let Some(law) = rows.known.iter().position(|known| known.name == of_winches::LAW) else {
        return Ok(());
    };
    for (number, table) in root.list("tsda")?.into_iter().enumerate() {
        let Some(input) = winches.get(&number) else { continue };
        let (pair, of) = of_winches::read(&table, *input, assembly)?;
        let name = table.required("name", Text::Name)?;
        let label = pair.label(&table);
        let place = ("tsda", number);
        let one = One { name: Some(name), table, label, place, quantities: None };
        rows.add(law, assembly, (&pair, of), one)?;
    }
    Ok(())
}

/// Reads inputs of the type `drive`.
fn of_drives<'t>(
    root: &Table<'t>,
    (joints, elements): (&[JointPlace], &Elements),
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    let mut inputs = OtherInputs { names: rows.named.inputs.clone(), types: Vec::new() };
    for table in root.list("input")? {
        inputs.types.push(table.optional("type", Text::Any)?.unwrap_or_default());
    }
    for (number, table) in root.list("input")?.into_iter().enumerate() {
        if inputs.types[number] != DRIVE_TYPE {
            continue;
        }
        table.only(&[drive::INPUT, &drive::KEYS, DRIVE])?;
        let driven = Driven::read(&table, joints, elements)?;
        let (law, constants) = driven.law(&table, &inputs)?;
        let Some(law) = rows.known.iter().position(|known| known.name == law) else { continue };
        let place = driven.place;
        let name = table.required("name", Text::Name)?;
        let [a, b] = &place.pair.names;
        let label = format!("drive `{name}` ({a}–{b})");
        let one =
            One { name: Some(name), table, label, place: ("input", number), quantities: None };
        rows.add(law, assembly, (&place.pair, Of::Drive(place, number, constants)), one)?;
    }
    Ok(())
}

/// Reads signal chains of inputs, and sensors of read-outs.
fn of_chains<'t>(
    root: &Table<'t>,
    joints: (&[JointPlace], &Elements),
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    for kind in ["input", "readout"] {
        for (number, table) in root.list(kind)?.into_iter().enumerate() {
            let chain = match kind {
                "input" => of_chains::chain(&table, joints)?,
                _ => of_chains::sensor(&table, joints)?,
            };
            let Some((place, law, constants)) = chain else { continue };
            let Some(law) = rows.known.iter().position(|known| known.name == law) else { continue };
            let mut name = table.required("name", Text::Name)?;
            if kind == "readout" {
                name = sensor_name(&name);
            }
            let [a, b] = &place.pair.names;
            let label = format!("{kind} `{name}` ({a}–{b})");
            let one =
                One { name: Some(name), table, label, place: (kind, number), quantities: None };
            rows.add(law, assembly, (&place.pair, Of::Drive(place, number, constants)), one)?;
        }
    }
    Ok(())
}

/// Reads couplings of joints.
fn of_couplings<'t>(
    root: &Table<'t>,
    joints: (&[JointPlace], &Elements),
    assembly: &Assembly,
    rows: &mut Rows<'t>,
) -> Result<(), SceneError> {
    let Some(law) = rows.known.iter().position(|known| known.name == "coupling") else {
        return Ok(());
    };
    for (number, table) in root.list("coupling")?.into_iter().enumerate() {
        let Coupled { pair, joints, terms, constants, quantities } =
            Coupled::read(&table, joints, assembly)?;
        let label = format!("{} ({})", table.label(), joints.join(", "));
        let one = One { name: None, table, label, place: ("coupling", number), quantities };
        rows.add(law, assembly, (pair, Of::Coupling(Box::new(terms), constants)), one)?;
    }
    Ok(())
}

/// The keys of all laws.
fn all_fields(known: &[KnownLaw]) -> Vec<&'static str> {
    known.iter().flat_map(|law| law.fields.iter().map(|field| field.name)).collect()
}

/// The laws, each with all its keys.
pub(crate) fn types() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    known_laws().into_iter().filter(KnownLaw::is_between).map(|law| {
        (law.name, KEYS.iter().copied().chain(law.fields.iter().map(|field| field.name)).collect())
    })
}
