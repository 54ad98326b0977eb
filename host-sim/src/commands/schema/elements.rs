//! What the keys of joints, springs, loads, inputs, read-outs and geometry mean and take.
//!
//! `key => schema, meaning, default`.

use dbd_scene::Realisation;
use dbd_scene::vocabulary::{TableKeys, colours};
use serde_json::{Value, json};

use super::inner::{kinds, limits, orientation, within};
use super::values::Range::{Any, NotNegative, Positive};
use super::values::{Key, any, array, choice, halves, heading, name, number, numbers, place};

/// What joints are made of.
pub(super) fn realisation() -> Key {
    Key(
        choice(&Realisation::ALL.map(Realisation::name)),
        "What joints are made of: TSDAs, or bushings without a length, as stiff at the pose of assembly",
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
        "damping_ratio" => {
            Key(number(NotNegative), "≥ 0, in place of `damping`: the ratio at `frequency`", "")
        }
        "frequency" => Key(number(Positive), "Hz, > 0: where `damping_ratio` holds", ""),
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
        "name" => Key(name(), "A name of its own among joints and elements", ""),
        "type" => Key(kinds("joint", tables), "What it lets move", ""),
        "between" => between(),
        "at" => Key(
            halved(&place()),
            "[x, y, z] m, world, or a point: centre of the joint; with [assemble] { first = …, second = … }",
            "",
        ),
        "axis" => Key(
            halved(&heading()),
            "[x, y, z] of any length but 0, world; or two points, from the first to the second",
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
        "span" => Key(number(Positive), "m, > 0: how far its points lie apart along the axis", ""),
        "ring" => Key(number(Positive), "m, > 0: radius of the ring of points", "span/√2"),
        "arm" => Key(number(Positive), "m, > 0: length of its elements", ""),
        "offset" => Key(number(Positive), "m, > 0: distance of the points from their line", ""),
        "gauge" => Key(number(Positive), "m, > 0: distance of the two lines", ""),
        "offsets" => Key(
            choice(&["alike", "outward"]),
            "Whether points stand off their lines to the same sides or away from the other line",
            "alike",
        ),
        "realisation" => realisation(),
        "limits" | "turn_limits" | "slide_limits" => Key(
            limits(tables),
            "Ends of its angle or travel: { from = …, to = …, stiffness = … }",
            "none",
        ),
        "friction" | "turn_friction" | "slide_friction" => Key(
            within("friction", tables, &["coulomb"]),
            "Dry friction that sticks: { coulomb = …, breakaway = … }",
            "none",
        ),
        "rotor" | "turn_rotor" | "slide_rotor" => Key(
            within("rotor", tables, &["inertia", "stiffness"]),
            "A rotor that nothing drives, behind a gear that gives: { inertia = …, stiffness = … }",
            "none",
        ),
        _ => return None,
    })
}

pub(super) fn of_tsda(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name of its own among joints and elements", "none"),
        "between" => between(),
        "points" => Key(
            array(place(), 2),
            "[[x, y, z], [x, y, z]] m: a point of each body in its axes from its centre of mass (of the world in the \
             world), or names of points",
            "",
        ),
        "free_length" => {
            Key(number(NotNegative), "m, ≥ 0, or \"initial\": as long as it is at t = 0", "")
        }
        "limits" => Key(limits(tables), "Stops of its length, in m", "none"),
        _ => return None,
    })
}

pub(super) fn of_line(key: &str) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name of its own among joints and elements", "none"),
        "between" => Key(
            array(name(), 2),
            "[first, second]: the first body owns the line, the second the point; one may be \"world\"",
            "",
        ),
        "line_point" => {
            Key(place(), "A point of the line: [x, y, z] m in the first body's axes, or a name", "")
        }
        "line_direction" => {
            Key(numbers(3, Any), "[x, y, z] of any length but 0, in the first body's axes", "")
        }
        "point" => Key(place(), "The point: [x, y, z] m in the second body's axes, or a name", ""),
        "free_length" => Key(number(NotNegative), "m, ≥ 0: distance from the line at rest", ""),
        _ => return None,
    })
}

pub(super) fn of_torsion(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name of its own among joints and elements", "none"),
        "between" => between(),
        "axis" => Key(heading(), "[x, y, z] or two points, world; fixed in the first body", ""),
        "preload" => Key(number(Any), "N·m: torque on the second body at twist 0", "0"),
        "limits" => Key(limits(tables), "Stops of its twist, in rad", "none"),
        _ => return None,
    })
}

pub(super) fn of_load(key: &str) -> Option<Key> {
    Some(match key {
        "body" => Key(name(), "The body that it acts on, not the world", ""),
        "force" => Key(numbers(3, Any), "[x, y, z] N at the centre of mass", "0"),
        "torque" => Key(numbers(3, Any), "[x, y, z] N·m", "0"),
        "frame" => Key(choice(&["world", "body"]), "The axes of force and torque", "world"),
        "from" => Key(number(Any), "s: it acts from then on", "0"),
        "until" => Key(number(Any), "s, > `from`: it acts until just before", "without end"),
        _ => return None,
    })
}

pub(super) fn of_input(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name of its own among inputs", ""),
        "type" => Key(
            kinds("input", tables),
            "What it drives, in N, N·m, m or the unit of a drive's mode",
            "",
        ),
        "value" => Key(number(Any), "The value at t = 0, held until the caller sets it", "0"),
        "range" => Key(
            numbers(2, Any),
            "[least, largest] value that the caller can set: what is beyond is set to the nearer one",
            "none",
        ),
        "table" => Key(
            json!({ "type": "array", "items": numbers(2, Any), "minItems": 1 }),
            "[[time in s, value], …], times ascending: the scene drives the input; with `over` [[reading, value], …]",
            "none",
        ),
        "periodic" => Key(
            json!({ "type": "boolean" }),
            "Whether the table repeats; its last time is the end of the period, its last value the first",
            "false",
        ),
        "jump" => Key(
            json!({ "type": "boolean" }),
            "Whether a periodic table may end at another value than it begins with",
            "false",
        ),
        "over" => Key(
            name(),
            "The column of a read-out that the table stands over instead of time: \"angle\", \"tip.x\"",
            "time",
        ),
        "sine" => Key(
            within("sine", tables, &["amplitude", "frequency"]),
            "offset + amplitude·sin(2π·frequency·t + phase): the scene drives the input",
            "none",
        ),
        "interpolate" => {
            Key(choice(&["held", "linear"]), "How a table goes on between its times", "held")
        }
        "body" => Key(name(), "The body that it acts on", ""),
        "point" => Key(
            place(),
            "Where it acts: [x, y, z] m in the body's axes, or a point",
            "the centre of mass",
        ),
        "axis" => Key(numbers(3, Any), "[x, y, z] of any length but 0: along or about it", ""),
        "frame" => Key(choice(&["world", "body"]), "The axes of `axis`", "world"),
        "target" => Key(
            any(&[name(), json!({ "type": "array", "items": name(), "minItems": 1 })]),
            "The name of what it drives: a joint, a tsda, a torsion spring; of an anchor also several in an array",
            "",
        ),
        "about" => Key(choice(&["first", "second"]), "Which axis of a universal joint", ""),
        "freedom" => Key(choice(&["turn", "slide"]), "Which motion of a cylindrical joint", ""),
        "mode" => Key(
            choice(&["position", "velocity", "torque", "force", "current", "voltage"]),
            "What the input of a drive is: rad or m, rad/s or m/s, N·m or N, A, V",
            "",
        ),
        "kp" => Key(number(NotNegative), "N·m/rad or N/m: stiffness of a servo of position", ""),
        "kd" => Key(number(Positive), "N·m·s/rad or N·s/m, > 0: damping of a servo", ""),
        "most" => Key(number(Positive), "N·m or N, > 0: the most that drives the joint", "none"),
        "lag" => Key(number(NotNegative), "s: time constant with which what drives follows", "0"),
        "winding" => Key(
            within("winding", tables, &["constant"]),
            "Of a motor: { resistance = ohm, inductance = H, constant = N·m/A, most_current = A }",
            "none",
        ),
        "rotor" => Key(
            number(Positive),
            "kg·m², > 0: inertia of the motor's shaft; along a slide without a `ratio` kg",
            "none",
        ),
        "ratio" => Key(
            number(Any),
            "Turns of the rotor per turn of the joint, not 0; along a slide rad/m",
            "1",
        ),
        "gear" => Key(
            within("gear", tables, &["stiffness"]),
            "Between rotor and joint: { stiffness = …, damping = …, play = … }",
            "none",
        ),
        _ => return None,
    })
}

pub(super) fn of_readout(key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "name" => Key(name(), "A name of its own among read-outs: it heads a column", ""),
        "type" => Key(kinds("readout", tables), "What it shows", ""),
        "body" => Key(name(), "The body that it looks at", ""),
        "point" => {
            Key(place(), "Where: [x, y, z] m in the body's axes, or a point", "the centre of mass")
        }
        "target" => Key(
            name(),
            "The joint, tsda, torsion spring, interaction or input that it looks at",
            "",
        ),
        "axis" => Key(numbers(3, Any), "[x, y, z]: of a spherical joint, world at t = 0", ""),
        "about" => Key(choice(&["first", "second"]), "Which axis of a universal joint", ""),
        "quantity" => Key(name(), "What it shows of an interaction: a quantity of its law", ""),
        "offset" => Key(number(Any), "rad: what it shows at a turn of 0", "0"),
        _ => return None,
    })
}

pub(super) fn of_geometry(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let colour = any(&[
        choice(&colours()),
        json!({ "type": "string", "pattern": "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$" }),
    ]);
    Some(match key {
        "body" => Key(name(), "The body that looks so, or \"world\" for the ground", ""),
        "shape" => Key(kinds("geometry", tables), "What it is; a link has round ends", ""),
        "colour" => Key(colour, "\"#rrggbb\", \"#rgb\" or a word", "that of the body"),
        "at" => Key(
            place(),
            "[x, y, z] m in the body's axes from its centre of mass (of the ground in the world), or a point: its middle",
            "the centre of mass",
        ),
        "size" => Key(numbers(3, Positive), "[x, y, z] m, > 0: the sides of a box", ""),
        "orientation" => Key(
            orientation(tables),
            "How a box is turned in the body: { axis, angle }, { quaternion } or { euler_321 }",
            "not at all",
        ),
        "from" => Key(place(), "Its first end: [x, y, z] m in the body's axes, or a point", ""),
        "to" => Key(place(), "Its second end, likewise", ""),
        "axis" => Key(
            numbers(3, Any),
            "[x, y, z] in the body's axes: of a cylinder about `at`, with `length`",
            "",
        ),
        "length" => Key(number(Positive), "m, > 0: of a cylinder along `axis`", ""),
        "radius" => Key(number(Positive), "m, > 0; or `diameter`", ""),
        "diameter" => Key(number(Positive), "m, > 0; or `radius`", ""),
        _ => return None,
    })
}
