//! Meaning and type of the keys of joints, springs, loads, inputs, read-outs and geometry.
//!
//! `key => schema, meaning, default`.

use dbd_scene::Realisation;
use dbd_scene::vocabulary::{TableKeys, colours};
use serde_json::{Value, json};

use super::inner::{kinds, limits, orientation, winding, within};
use super::values::Range::{Any, NotNegative, Positive};
use super::values::{
    Key, any, array, choice, halves, heading, name, number, numbers, place, whole,
};

/// The elements of joints.
pub(super) fn realisation() -> Key {
    Key(
        choice(&Realisation::ALL.map(Realisation::name)),
        "Elements of the joints: TSDAs, or bushings without length and of the same stiffness at the assembly pose",
        "tsda",
    )
}

pub(super) fn of_spring(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "stiffness" => Key(
            any(&[number(NotNegative), within("stiffness", tables, &["load", "deflection"])]),
            "N/m (about an axis N·m/rad), ≥ 0; or { load = N, deflection = m }",
            "",
        ),
        "damping" => Key(number(NotNegative), "N·s/m (about an axis N·m·s/rad), ≥ 0", "0"),
        "damping_ratio" => Key(
            number(NotNegative),
            "≥ 0, instead of `damping`: the damping ratio at `frequency`",
            "",
        ),
        "frequency" => {
            Key(number(Positive), "Hz, > 0: the frequency at which `damping_ratio` applies", "")
        }
        "clearance" => Key(number(NotNegative), "m, ≥ 0: a dead band about the free length", "0"),
        _ => return None,
    })
}

pub(super) fn between() -> Key {
    Key(
        array(name(), 2),
        "[first, second]: the names of two different bodies; one may be \"world\"",
        "",
    )
}

pub(super) fn of_joint(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let halved = |value: &Value| {
        let keys = tables.iter().find(|known| known.table == "halves");
        halves(value, keys.map_or(&[], |known| &known.keys))
    };
    Some(match key {
        "name" => Key(name(), "A name, unique among joints and elements", ""),
        "type" => Key(kinds("joint", tables), "Type of the joint: the motions that it allows", ""),
        "between" => between(),
        "at" => Key(
            halved(&place()),
            "[x, y, z] m, world, or a point: centre of the joint; with [assemble] { first = …, second = … }",
            "",
        ),
        "axis" => Key(
            halved(&heading()),
            "[x, y, z] of nonzero length, world; or two points, from the first to the second",
            "",
        ),
        "axes" => Key(
            array(heading(), 2),
            "The first body's axis and the second's, orthogonal, world: [[x, y, z], [x, y, z]] or pairs of points",
            "",
        ),
        "spider" => Key(
            within("spider", tables, &["mass", "inertia"]),
            "The body between the two axes: { mass = kg, inertia = [Ix, Iy, Iz] }",
            "",
        ),
        "reference" => Key(
            halved(&heading()),
            "[x, y, z], not along the axis: azimuth 0, made normal to the axis",
            "the world axis least aligned with the axis",
        ),
        "span" => Key(number(Positive), "m, > 0: distance of its points along the axis", ""),
        "ring" => Key(number(Positive), "m, > 0: radius of the ring of points", "span/√2"),
        "arm" => Key(number(Positive), "m, > 0: length of its elements", ""),
        "offset" => Key(number(Positive), "m, > 0: distance of the points from their line", ""),
        "gauge" => Key(number(Positive), "m, > 0: distance of the two lines", ""),
        "offsets" => Key(
            choice(&["alike", "outward"]),
            "Whether the points are offset from their lines to the same side or away from the other line",
            "alike",
        ),
        "realisation" => realisation(),
        "limits" | "turn_limits" | "slide_limits" => Key(
            limits(tables),
            "Limits of its angle or travel: { from = …, to = …, stiffness = … }",
            "none",
        ),
        "friction" | "turn_friction" | "slide_friction" => Key(
            within("friction", tables, &["coulomb"]),
            "Dry friction with stiction: { coulomb = …, breakaway = … }",
            "none",
        ),
        "rotor" | "turn_rotor" | "slide_rotor" => Key(
            within("rotor", tables, &["inertia", "stiffness"]),
            "An undriven rotor behind an elastic gear: { inertia = …, stiffness = … }",
            "none",
        ),
        _ => return None,
    })
}

pub(super) fn of_tsda(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name, unique among joints and elements", "none"),
        "between" => between(),
        "points" => Key(
            array(place(), 2),
            "[[x, y, z], [x, y, z]] m: a point of each body, in body axes from the centre of mass (for the world \
             in world coordinates), or names of points",
            "",
        ),
        "free_length" => {
            let about = "m, ≥ 0, or \"initial\": the length at t = 0; optional where an input of the \
                         type \"free_length\" with a drive of its own sets it";
            Key(number(NotNegative), about, "")
        }
        "acts" => Key(
            choice(&["tension", "compression"]),
            "Side on which it acts, where an input sets its free length: \"tension\" for a rope",
            "both",
        ),
        "limits" => Key(limits(tables), "Limits of its length, in m", "none"),
        _ => return None,
    })
}

pub(super) fn of_line(key: &str) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name, unique among joints and elements", "none"),
        "between" => Key(
            array(name(), 2),
            "[first, second]: the first body has the line, the second the point; one may be \"world\"",
            "",
        ),
        "line_point" => {
            Key(place(), "A point of the line: [x, y, z] m in the first body's axes, or a name", "")
        }
        "line_direction" => {
            Key(numbers(3, Any), "[x, y, z] of nonzero length, in the first body's axes", "")
        }
        "point" => Key(place(), "The point: [x, y, z] m in the second body's axes, or a name", ""),
        "free_length" => Key(number(NotNegative), "m, ≥ 0: free distance from the line", ""),
        _ => return None,
    })
}

pub(super) fn of_torsion(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name, unique among joints and elements", "none"),
        "between" => between(),
        "axis" => Key(heading(), "[x, y, z] or two points, world; fixed in the first body", ""),
        "preload" => Key(number(Any), "N·m: torque on the second body at torsion angle 0", "0"),
        "limits" => Key(limits(tables), "Limits of its torsion angle, in rad", "none"),
        _ => return None,
    })
}

pub(super) fn of_load(key: &str) -> Option<Key> {
    Some(match key {
        "body" => Key(name(), "The loaded body, not the world", ""),
        "force" => Key(numbers(3, Any), "[x, y, z] N at the centre of mass", "0"),
        "torque" => Key(numbers(3, Any), "[x, y, z] N·m", "0"),
        "frame" => Key(choice(&["world", "body"]), "The frame of force and torque", "world"),
        "from" => Key(number(Any), "s: start of the load", "0"),
        "until" => Key(number(Any), "s, > `from`: end of the load, exclusive", "without end"),
        _ => return None,
    })
}

pub(super) fn of_input(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name, unique among inputs", ""),
        "type" => Key(
            kinds("input", tables),
            "The driven quantity, in N, N·m, m/s², m/s, rad/s, m or the unit of a drive's mode",
            "",
        ),
        "value" => Key(number(Any), "The value at t = 0, held until the caller sets it", "0"),
        "range" => Key(
            numbers(2, Any),
            "[least, largest] value that the caller can set: values outside are clamped",
            "none",
        ),
        "table" => Key(
            json!({ "type": "array", "items": numbers(2, Any), "minItems": 1 }),
            "[[time in s, value], …], times ascending: the scene drives the input; with `over` [[reading, value], …]",
            "none",
        ),
        "periodic" => Key(
            json!({ "type": "boolean" }),
            "Whether the table repeats; its last time is the end of the period, its last value equals the first",
            "false",
        ),
        "jump" => Key(
            json!({ "type": "boolean" }),
            "Whether a periodic table may end at a different value than its first",
            "false",
        ),
        "over" => Key(
            name(),
            "The read-out column that is the table's argument instead of time: \"angle\", \"tip.x\"",
            "time",
        ),
        "sine" => Key(
            within("sine", tables, &["amplitude", "frequency"]),
            "offset + amplitude·sin(2π·frequency·t + phase): the scene drives the input",
            "none",
        ),
        "interpolate" => {
            Key(choice(&["held", "linear"]), "Interpolation of the table between its times", "held")
        }
        "body" => Key(name(), "The loaded body", ""),
        "point" => Key(
            place(),
            "Point of application: [x, y, z] m in the body's axes, or a point",
            "the centre of mass",
        ),
        "axis" => Key(numbers(3, Any), "[x, y, z] of nonzero length: the direction or axis", ""),
        "frame" => Key(choice(&["world", "body"]), "The frame of `axis`", "world"),
        "target" => Key(
            any(&[name(), json!({ "type": "array", "items": name(), "minItems": 1 })]),
            "The name of the driven joint, tsda or torsion spring; for an anchor also an array of several",
            "",
        ),
        "about" => Key(choice(&["first", "second"]), "Which axis of a universal joint", ""),
        "freedom" => Key(choice(&["turn", "slide"]), "Which motion of a cylindrical joint", ""),
        "mode" => Key(
            choice(&["position", "velocity", "torque", "force", "current", "voltage"]),
            "The quantity of a drive's input: rad or m, rad/s or m/s, N·m or N, A, V",
            "",
        ),
        "kp" => Key(number(NotNegative), "N·m/rad or N/m: stiffness of a position servo", ""),
        "kd" => Key(number(Positive), "N·m·s/rad or N·s/m, > 0: damping of a servo", ""),
        "most" => {
            Key(number(Positive), "N·m or N, > 0: largest torque or force at the joint", "none")
        }
        "lag" => Key(number(NotNegative), "s: time constant of the actuator", "0"),
        "delay" => Key(whole(16), "Samples by which a joint's torque or force is late", "0"),
        "limits" => Key(
            numbers(2, Any),
            "N·m or N, [least, largest] torque or force at a joint, whatever the value",
            "none",
        ),
        "rate_limit" => Key(
            number(Positive),
            "N·m/s or N/s, > 0: largest rate of change of a joint's torque or force",
            "none",
        ),
        "period" => Key(
            number(NotNegative),
            "s: time between samples of the value of a joint's torque or force",
            "every step",
        ),
        "winding" => Key(
            winding(tables),
            "Of a motor: { resistance = ohm, inductance = H, constant = N·m/A, most_current = A }; in rotor axes \
             { resistance = ohm, inductance_d = H, inductance_q = H, flux = V·s, pole_pairs = …, most_current = A }",
            "none",
        ),
        "d_input" => Key(
            name(),
            "The name of an input of the type \"signal\": voltage d or current d of a winding in rotor axes",
            "0 V, 0 A",
        ),
        "rotor" => Key(
            number(Positive),
            "kg·m², > 0: inertia of the motor's shaft; along a slide without a `ratio` kg",
            "none",
        ),
        "ratio" => {
            Key(number(Any), "Gear ratio, rotor over joint, not 0; along a slide rad/m", "1")
        }
        "gear" => Key(
            within("gear", tables, &["stiffness"]),
            "Between rotor and joint: { stiffness = …, damping = …, play = … }",
            "none",
        ),
        "friction" => Key(
            within("shaft_friction", tables, &[]),
            "Of the motor's shaft: { coulomb = …, viscous = … }",
            "none",
        ),
        _ => return None,
    })
}

pub(super) fn of_readout(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name, unique among read-outs: the heading of its columns", ""),
        "type" => Key(kinds("readout", tables), "Type of the read-out", ""),
        "body" => Key(name(), "The observed body", ""),
        "point" => Key(
            place(),
            "Observed point: [x, y, z] m in the body's axes, or a point",
            "the centre of mass",
        ),
        "target" => {
            Key(name(), "The observed joint, tsda, torsion spring, interaction or input", "")
        }
        "axis" => Key(numbers(3, Any), "[x, y, z]: axis of a spherical joint, world at t = 0", ""),
        "about" => Key(choice(&["first", "second"]), "Which axis of a universal joint", ""),
        "quantity" => Key(name(), "For an interaction: a quantity of its law", ""),
        "offset" => Key(number(Any), "rad or m: reading at a rotation or travel of 0", "0"),
        "sensor" => Key(
            within("sensor", tables, &[]),
            "A second column, NAME.sensor: the reading with resolution, noise, sample period and delay",
            "none",
        ),
        _ => return None,
    })
}

pub(super) fn of_geometry(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let colour = any(&[
        choice(&colours()),
        json!({ "type": "string", "pattern": "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$" }),
    ]);
    Some(match key {
        "body" => Key(name(), "The drawn body, or \"world\" for the ground", ""),
        "shape" => Key(kinds("geometry", tables), "The shape; a link has round ends", ""),
        "colour" => Key(colour, "\"#rrggbb\", \"#rgb\" or a colour name", "that of the body"),
        "at" => Key(
            place(),
            "[x, y, z] m in the body's axes from its centre of mass (of the ground in the world), or a point: its middle",
            "the centre of mass",
        ),
        "size" => Key(numbers(3, Positive), "[x, y, z] m, > 0: the sides of a box", ""),
        "orientation" => Key(
            orientation(tables),
            "Orientation of a box in the body: { axis, angle }, { quaternion } or { euler_321 }",
            "no rotation",
        ),
        "from" => Key(place(), "Its first end: [x, y, z] m in the body's axes, or a point", ""),
        "to" => Key(place(), "Its second end, likewise", ""),
        "axis" => Key(
            numbers(3, Any),
            "[x, y, z] in the body's axes: axis of a cylinder about `at`, with `length`",
            "",
        ),
        "length" => Key(number(Positive), "m, > 0: length of a cylinder along `axis`", ""),
        "radius" => Key(number(Positive), "m, > 0; or `diameter`", ""),
        "diameter" => Key(number(Positive), "m, > 0; or `radius`", ""),
        _ => return None,
    })
}
