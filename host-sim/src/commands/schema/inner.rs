//! Meaning and type of the keys of nested tables: points, links, shapes, orientations, stiffnesses, spiders, rates,
//! sines, limits, friction, gears, windings, sensors, terms of couplings.
//!
//! `(table, key) => schema`, and whole tables of them.

use dbd_scene::vocabulary::TableKeys;
use serde_json::{Value, json};

use super::values::Range::{Any, NotNegative, Positive};
use super::values::{Key, any, array, choice, name, number, numbers, object, place, whole};

/// The schema of a key; `None` of one that it does not know.
pub(super) fn schema(table: &str, key: &str, tables: &[TableKeys]) -> Option<Value> {
    let found = match table {
        "point" => of_point(key),
        "link" | "shape" => of_shape(table, key, tables),
        "orientation" => of_orientation(key),
        "stiffness" => of_stiffness(key),
        "spider" => of_spider(key),
        "rate" => of_rate(key),
        "sine" => of_sine(key),
        "limits" => of_limits(key),
        "friction" if key == "load" => Some(Key(
            within("friction_load", tables, &["mu"]),
            "Friction of the joint's force across its axis: { mu = …, radius = … }, along an axis { mu = … }",
            "none",
        )),
        "friction" => of_friction(key),
        "friction_load" => of_friction_load(key),
        "gear" => of_gear(key),
        "shaft_friction" => of_shaft_friction(key),
        "rotor" if key == "inertia" => Some(Key(
            number(Positive),
            "kg·m² or kg, > 0: rotor inertia times the square of the ratio",
            "",
        )),
        "rotor" => of_gear(key),
        "winding" => of_winding(key),
        "sensor" => of_sensor(key),
        "term" => of_term(key),
        _ => None,
    };
    found.map(Key::schema)
}

/// A table within another, with all its keys.
pub(super) fn within(table: &'static str, tables: &[TableKeys], required: &[&str]) -> Value {
    let mut keys: Vec<&str> = Vec::new();
    for known in tables.iter().filter(|known| known.table == table) {
        keys.extend(&known.keys);
    }
    let properties = keys.into_iter().filter_map(|key| Some((key, schema(table, key, tables)?)));
    object(properties, required)
}

/// Limits of a joint.
pub(super) fn limits(tables: &[TableKeys]) -> Value {
    let mut schema = within("limits", tables, &["stiffness"]);
    schema["anyOf"] = json!(["from", "to"].map(|end| json!({ "required": [end] })));
    schema["dependencies"] = json!({ "restitution": ["speed"], "speed": ["restitution"] });
    schema
}

/// A winding of one current, or one in rotor axes.
pub(super) fn winding(tables: &[TableKeys]) -> Value {
    let mut schema = within("winding", tables, &[]);
    let forms: [&[&str]; 2] = [&["constant"], &["flux", "pole_pairs"]];
    schema["oneOf"] = json!(forms.map(|keys| json!({ "required": keys })));
    schema
}

/// One of the forms of an orientation.
pub(super) fn orientation(tables: &[TableKeys]) -> Value {
    let mut schema = within("orientation", tables, &[]);
    let forms: [&[&str]; 3] = [&["axis", "angle"], &["quaternion"], &["euler_321"]];
    schema["oneOf"] = json!(forms.map(|keys| json!({ "required": keys })));
    schema
}

/// The types or shapes of a table.
pub(super) fn kinds(table: &str, tables: &[TableKeys]) -> Value {
    let kinds = tables.iter().filter(|known| known.table == table);
    let kinds: Vec<&str> = kinds.filter_map(|known| known.kind).collect();
    choice(&kinds)
}

fn of_point(key: &str) -> Option<Key> {
    Some(match key {
        "from" => Key(
            any(&[name(), numbers(3, Any), array(place(), 2)]),
            "The reference point or two reference points: names or [x, y, z]",
            "",
        ),
        "offset" => Key(numbers(3, Any), "[x, y, z] m, world: offset from `from`", ""),
        "distance" => Key(number(Any), "m: from `from`", ""),
        "direction" => Key(numbers(3, Any), "[x, y, z] of nonzero length, world", ""),
        "toward" => Key(place(), "A point: the direction in which the distance is measured", ""),
        "angle" => Key(
            number(Any),
            "rad, or a text such as \"60 deg\": in the plane across `normal`, from `reference`; or about `axis`",
            "",
        ),
        "normal" => Key(numbers(3, Any), "[x, y, z]: normal of the plane", "[0, 0, 1]"),
        "reference" => Key(
            numbers(3, Any),
            "[x, y, z]: direction of angle 0",
            "the world axis least aligned with the normal",
        ),
        "share" => {
            Key(number(Any), "Fraction of the distance from the first point to the second", "")
        }
        "distances" => {
            Key(numbers(2, Positive), "[a, b] m, > 0: distances from the two points", "")
        }
        "side" => Key(
            choice(&["left", "right"]),
            "The side of the line from the first to the second, seen against `normal`",
            "",
        ),
        "about" => Key(place(), "A point of the rotation axis", "the origin"),
        "axis" => Key(numbers(3, Any), "[x, y, z]: the rotation axis", ""),
        "frame" => Key(
            any(&[name(), array(place(), 3)]),
            "A body, or three points: origin, one on the x axis, one in the plane of x and y",
            "",
        ),
        "at" => Key(numbers(3, Any), "[x, y, z] m in `frame`", ""),
        _ => return None,
    })
}

fn of_shape(table: &str, key: &str, tables: &[TableKeys]) -> Option<Key> {
    Some(match key {
        "type" => Key(kinds("shape", tables), "A uniform shape", ""),
        "shape" => Key(kinds("link", tables), "A uniform shape of the link's length", "rod"),
        "from" => Key(place(), "The start point, one end of the body", ""),
        "to" => Key(place(), "The end point, the other end of the body", ""),
        "along" => Key(
            choice(&["x", "y", "z"]),
            "The body axis along the link, from the first point to the second",
            "x",
        ),
        "reference" => Key(
            numbers(3, Any),
            "[x, y, z], not along the link: the side on which the body's next axis lies",
            "the shortest turn",
        ),
        "centre" => {
            Key(number(Any), "Position of the centre of mass as a fraction of the length", "0.5")
        }
        "length" if table == "link" => Key(
            number(Positive),
            "m, > 0: length if it differs from the distance of its points; only with [assemble]",
            "the distance of its points",
        ),
        "length" => Key(number(Positive), "m, > 0: length along its axis; not for a sphere", ""),
        "mass" => Key(number(Positive), "kg, > 0", "of `density`"),
        "density" => Key(number(Positive), "kg/m³, > 0", "of `mass`"),
        "diameter" => Key(
            number(Positive),
            "m, > 0: diameter of a rod, cylinder, tube (outer) or sphere",
            "a rod without it is slender",
        ),
        "inner_diameter" => {
            Key(number(Positive), "m, > 0: inner diameter of a tube or a hollow sphere", "")
        }
        "wall" => Key(number(Positive), "m, > 0: thickness of a tube's wall", ""),
        "section" => Key(numbers(2, Positive), "[a, b] m: sides of a box, along the next axes", ""),
        "width" => Key(number(Positive), "m, > 0: width of a plate, along the next axis", ""),
        "thickness" => {
            Key(number(Positive), "m, > 0: thickness of a plate, along the last axis", "0")
        }
        _ => return None,
    })
}

fn of_orientation(key: &str) -> Option<Key> {
    Some(match key {
        "axis" => Key(numbers(3, Any), "[x, y, z] of nonzero length, with `angle`", ""),
        "angle" => Key(number(Any), "rad, or a text such as \"30 deg\": about `axis`", ""),
        "quaternion" => Key(numbers(4, Any), "[w, x, y, z], scalar first, normalised", ""),
        "euler_321" => Key(
            numbers(3, Any),
            "[yaw, pitch, roll] rad: about z, then the new y, then the new x",
            "",
        ),
        _ => return None,
    })
}

fn of_stiffness(key: &str) -> Option<Key> {
    Some(match key {
        "load" => Key(number(Positive), "N (about an axis N·m), > 0", ""),
        "deflection" => {
            Key(number(Positive), "m (about an axis rad), > 0: deflection under the load", "")
        }
        _ => return None,
    })
}

fn of_spider(key: &str) -> Option<Key> {
    Some(match key {
        "mass" => Key(number(Positive), "kg, > 0", ""),
        "inertia" => Key(numbers(3, Positive), "[Ix, Iy, Iz] kg·m² about the spider's axes", ""),
        "angular_velocity" => {
            Key(numbers(3, Any), "[x, y, z] rad/s about its own axes", "as the first body turns")
        }
        _ => return None,
    })
}

fn of_limits(key: &str) -> Option<Key> {
    Some(match key {
        "from" => Key(number(Any), "rad (\"-30 deg\") or m: lower end", "none"),
        "to" => Key(number(Any), "rad or m: upper end", "none"),
        "offset" => Key(number(Any), "rad or m: angle or travel at t = 0", "0"),
        "stiffness" => Key(number(Positive), "N·m/rad or N/m, > 0: stiffness beyond a limit", ""),
        "soft" => Key(
            number(NotNegative),
            "rad or m: depth over which the stiffness rises from 0 to its value",
            "0",
        ),
        "dissipation" => Key(
            number(NotNegative),
            "s/rad or s/m: coefficient a of stiffness · depth · (1 + a · rate of the depth)",
            "0",
        ),
        "restitution" => Key(
            number(Positive),
            "Instead of `dissipation`: ratio of the speeds after and before an impact, in (0, 1]",
            "",
        ),
        "speed" => {
            Key(number(Positive), "rad/s or m/s: impact speed at which `restitution` applies", "")
        }
        _ => return None,
    })
}

fn of_friction(key: &str) -> Option<Key> {
    Some(match key {
        "coulomb" => Key(number(NotNegative), "N·m or N: friction during fast sliding", ""),
        "breakaway" => {
            Key(number(Positive), "N·m or N: friction at the onset of sliding", "`coulomb`")
        }
        "stribeck" => Key(
            number(Positive),
            "rad/s or m/s: sliding rate at which friction is midway between the two",
            "0.05 rad/s, 0.01 m/s",
        ),
        "give" => Key(
            number(Positive),
            "rad or m: elastic part of the motion at `breakaway`",
            "0.001 rad, 0.1 mm",
        ),
        "damping" => Key(
            number(NotNegative),
            "N·m·s/rad or N·s/m: damping of the elastic part",
            "half of critical for its two bodies, each free",
        ),
        "viscous" => {
            Key(number(NotNegative), "N·m·s/rad or N·s/m: viscous coefficient during sliding", "0")
        }
        _ => return None,
    })
}

fn of_friction_load(key: &str) -> Option<Key> {
    Some(match key {
        "mu" => Key(number(NotNegative), "Coefficient of friction", ""),
        "radius" => Key(
            number(NotNegative),
            "m: radius at which it acts; about an axis only, and there required",
            "",
        ),
        "force" => Key(
            number(NotNegative),
            "N: load included in the friction at which the elastic part of the motion is `give`",
            "0",
        ),
        _ => return None,
    })
}

fn of_shaft_friction(key: &str) -> Option<Key> {
    Some(match key {
        "coulomb" => Key(
            number(NotNegative),
            "N·m at the motor's shaft; along a slide without a `ratio` N: dry friction, which sticks",
            "0",
        ),
        "viscous" => Key(
            number(NotNegative),
            "N·m·s/rad at the motor's shaft; along a slide without a `ratio` N·s/m",
            "0",
        ),
        _ => return None,
    })
}

fn of_gear(key: &str) -> Option<Key> {
    Some(match key {
        "stiffness" => Key(number(Positive), "N·m/rad or N/m, > 0: stiffness at the joint", ""),
        "damping" => Key(number(NotNegative), "N·m·s/rad or N·s/m: damping at the joint", "0"),
        "play" => Key(number(NotNegative), "rad or m at the joint: play, from flank to flank", "0"),
        _ => return None,
    })
}

/// A coupling of joints.
pub(super) fn of_coupling(key: &str, tables: &[TableKeys]) -> Option<Key> {
    let terms = json!({
        "type": "array", "items": within("term", tables, &["joint"]), "minItems": 1, "maxItems": 3,
    });
    Some(match key {
        "name" => Key(name(), "A name, unique among joints and elements", "none"),
        "of" => Key(terms, "Joints with the factors of their coordinates in the sum", ""),
        "offset" => {
            Key(number(Any), "rad or m, as the first joint: the free value of the sum", "0")
        }
        "stiffness" => Key(number(Positive), "N·m/rad or N/m, > 0: tension per sum", ""),
        "damping" => {
            Key(number(NotNegative), "N·m·s/rad or N·s/m: tension per rate of the sum", "0")
        }
        "play" => Key(number(NotNegative), "rad or m of the sum: play, from flank to flank", "0"),
        "acts" => Key(
            choice(&["tension", "compression"]),
            "Side on which it acts: only on sums above the offset, as a tendon, or only below it",
            "both",
        ),
        _ => return None,
    })
}

fn of_sensor(key: &str) -> Option<Key> {
    Some(match key {
        "counts" => Key(number(Positive), "> 0: counts of a revolution, of a joint_angle", "none"),
        "resolution" => {
            Key(number(NotNegative), "In the unit of the read-out: readings are multiples", "0")
        }
        "noise" => Key(number(NotNegative), "In its unit: deviation of a sample", "0"),
        "bias" => Key(number(Any), "In its unit", "0"),
        "walk" => Key(number(NotNegative), "In its unit: deviation of the bias after 1 s", "0"),
        "range" => Key(numbers(2, Any), "In its unit: [least, largest] reading", "none"),
        "period" => Key(number(NotNegative), "s: time between samples", "every step"),
        "delay" => Key(whole(16), "Samples by which the reading is late", "0"),
        "seed" => Key(whole(u32::MAX), "Seed of the random numbers", "0"),
        _ => return None,
    })
}

fn of_term(key: &str) -> Option<Key> {
    Some(match key {
        "joint" => Key(name(), "A revolute, translational or cylindrical joint", ""),
        "freedom" => Key(choice(&["turn", "slide"]), "Which coordinate of a cylindrical joint", ""),
        "factor" => Key(
            number(Any),
            "Not 0: sum per coordinate, in rad/m for a travel in a sum of rotations, in m/rad for a rotation in a sum of travels",
            "1 of the first joint",
        ),
        _ => return None,
    })
}

fn of_winding(key: &str) -> Option<Key> {
    Some(match key {
        "resistance" => Key(number(Positive), "ohm, > 0; not for the mode \"current\"", ""),
        "inductance" => Key(number(NotNegative), "H; not for the mode \"current\"", "0"),
        "constant" => Key(number(Any), "N·m/A, not 0: torque of the motor's shaft per current", ""),
        "most_current" => Key(
            number(Positive),
            "A, > 0: largest current; in rotor axes largest amplitude of both currents",
            "none",
        ),
        "inductance_d" => Key(number(Positive), "H, > 0: inductance along the magnets", ""),
        "inductance_q" => Key(
            number(Positive),
            "H, > 0: inductance a quarter of a period ahead of the magnets",
            "",
        ),
        "flux" => Key(number(NotNegative), "V·s: flux linkage of the magnets", ""),
        "pole_pairs" => {
            Key(json!({ "type": "integer", "minimum": 1 }), "Half the rotor's number of poles", "")
        }
        _ => return None,
    })
}

fn of_sine(key: &str) -> Option<Key> {
    Some(match key {
        "amplitude" => Key(number(Any), "In the unit of the input", ""),
        "frequency" => Key(number(Positive), "Hz, > 0", ""),
        "phase" => Key(number(Any), "rad, or a text such as \"90 deg\": at t = 0", "0"),
        "offset" => Key(number(Any), "In the unit of the input", "0"),
        _ => return None,
    })
}

fn of_rate(key: &str) -> Option<Key> {
    Some(match key {
        "turn" => Key(number(Any), "rad/s about the joint's axis", ""),
        "slide" => Key(number(Any), "m/s along the joint's axis", ""),
        _ => return None,
    })
}
