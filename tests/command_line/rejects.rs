//! What a scene is refused for: every rejection with its place, its reason and its remedy.
//!
//! `(base scene, one edit) => line, column, message, help`. A case replaces a text that occurs once
//! in the base scene; `«` in the replacement marks where the refusal must point.

mod assemble;
mod driven;
mod joints;

use dbd_scene::{Scene, SceneError};

/// One of everything that a scene may hold.
const BASE: &str = r#"name = "base"
description = "one of everything"
gravity = [0, -9.81, 0]
duration = 0.5
step = 2e-5
every = 1e-3

[[body]] # first
name = "arm"
mass = 1.5
inertia = [0.3, 0.2, 0.4]
position = [0.5, 0, 0]
orientation = { axis = [0, 0, 1], angle = 0.3 }
velocity = [0, 0.1, 0]
angular_velocity = [0, 0, 2]

[[body]] # second
name = "hand"
mass = 0.7
inertia = [0.01, 0.02, 0.03]
position = [1.5, 0, 0]

[[joint]] # first
name = "shoulder"
type = "revolute"
between = ["world", "arm"]
at = [0, 0, 0]
axis = [0, 0, 2]
reference = [1, 1, 0]
stiffness = 9e6
damping = 12
span = 0.2
ring = 0.1

[[joint]] # second
name = "wrist"
type = "spherical"
between = ["arm", "hand"]
at = [1, 0, 0]
stiffness = { load = 500, deflection = 1e-4 }
damping_ratio = 0.1
frequency = 550
arm = 0.03

[[tsda]]
between = ["world", "hand"]
points = [[2, 0, 0], [0.1, 0, 0]]
stiffness = 4e5
free_length = 0.4

[[torsion_spring]]
between = ["arm", "world"]
axis = [0, 1, 0]
stiffness = 5e4
damping = 3
preload = 1e4

[[load]]
body = "hand"
torque = [0, 0, 0.05]
frame = "body"
from = 0.25
until = 2
"#;

struct Case {
    /// What must be named where that is not what the edit puts in.
    at: Option<&'static str>,
    /// A text that occurs once in the base scene.
    from: &'static str,
    /// What stands there instead, `«` before what must be named.
    to: &'static str,
    /// Part of what is wrong.
    message: &'static str,
    /// Part of what would be right.
    help: &'static str,
}

const fn case(
    from: &'static str,
    to: &'static str,
    message: &'static str,
    help: &'static str,
) -> Case {
    Case { at: None, from, to, message, help }
}

impl Case {
    /// What must be named is elsewhere.
    const fn at(self, at: &'static str) -> Case {
        Case { at: Some(at), ..self }
    }
}

/// A missing key: the line `gone` is not there, the place is that of `at`.
const fn lacks(
    at: &'static str,
    gone: &'static str,
    message: &'static str,
    help: &'static str,
) -> Case {
    Case { at: Some(at), from: gone, to: "", message, help }
}

#[rustfmt::skip]
const CASES: &[Case] = &[
    // TOML itself.
    case("mass = 1.5", "mass = «]", "missing array opening", "expected `[`"),
    case("mass = 1.5", "mass = 1.5\n«mass = 1.6", "duplicate key", "give each key once per table"),
    case("\"arm\"\nmass = 1.5", "\"arm«\nmass = 1.5", "invalid basic string", "expected `\"`"),
    case("duration = 0.5", "duration = 0.5«s", "invalid float", "a unit or an expression in quotes"),

    case("duration = 0.5", "duration = 0«,5", "unexpected key or value", "a decimal point"),
    case("mass = 1.5", "mass = «heavy", "text without quotes", "in quotes: \"heavy\""),
    case("velocity = [0, 0.1, 0]", "velocity = [«0 0.1, 0]", "missing comma between array elements", "within braces with commas"),
    case("at = [1, 0, 0]", "at = [1\n«0, 0]", "missing comma between array elements", "within braces with commas"),
    case("points = [[2, 0, 0], [0.1", "points = [[2, 0, 0] «[0.1", "missing comma between array elements", "within braces with commas"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "{ axis = [0, 0, 1] «angle = 0.3 }", "missing comma between key-value pairs", "within braces with commas"),
    case("[[torsion_spring]]", "«[torsion_spring]", "written as [torsion_spring], in single brackets", "as [[torsion_spring]], in double brackets"),
    case("[[joint]] # second", "[«joint]", "`joint` is defined again", "with [[joint]], in double brackets"),
    case("[[torsion_spring]]", "[[torsion_spring]«\n", "unclosed array table", "the same number of brackets"),

    // Times.
    case("duration = 0.5", "duration = «\"0.5 km\"", "`duration` of the scene is \"0.5 km\", a value in m", "\"20us\""),
    case("duration = 0.5", "duration = «\"0us\"", "is \"0us\"", "a finite number > 0 in s"),
    case("from = 0.25", "from = \"«soon\"", "`from` of load 1: `soon` is neither a unit nor", "\"20us\""),
    case("from = 0.25", "from = \"«1e999s\"", "`from` of load 1: value is too large", "\"20us\""),

    // Types of joints by other names.
    case("\"spherical\"", "«\"ball\"", "`type` of joint `wrist` is \"ball\"", "did you mean \"spherical\"?"),
    case("\"revolute\"", "«\"hinge\"", "`type` of joint `shoulder` is \"hinge\"", "did you mean \"revolute\"?"),

    // Keys.
    case("gravity =", "«gravitiy =", "the scene has no key `gravitiy`", "did you mean `gravity`?"),
    case("velocity = [0, 0.1, 0]", "«colour = 3", "body `arm` has no key `colour`", "`inertia`"),
    case("ring = 0.1", "«arm = 0.1", "joint `shoulder` has no key `arm`", "`ring`"),
    case("type = \"spherical\"", "«tpye = \"spherical\"", "joint `wrist` has no key `tpye`", "did you mean `type`?"),
    case("free_length", "«freelength", "tsda 1 has no key `freelength`", "did you mean `free_length`?"),
    case("preload = 1e4", "«spin = 1e4", "torsion_spring 1 has no key `spin`", "`preload`"),
    case("until = 2", "«untill = 2", "load 1 has no key `untill`", "did you mean `until`?"),
    case("angle = 0.3", "«angel = 0.3", "`orientation` of body `arm` has no key `angel`", "`angle`"),
    case("deflection = 1e-4", "«travel = 1e-4", "`stiffness` of joint `wrist` has no key `travel`", "`deflection`"),

    // Missing keys.
    lacks("name = \"base\"", "duration = 0.5\n", "the scene has no `duration`", "a finite number > 0 in s"),
    case("name = \"base\"\n", "«", "the scene has no `name`", "a name in quotes"),
    lacks("[[body]] # second", "name = \"hand\"\n", "body 2 has no `name`", "a name in quotes"),
    lacks("[[body]] # second", "mass = 0.7\n", "body `hand` has no `mass`", "> 0 in kg"),
    lacks("[[body]] # second", "inertia = [0.01, 0.02, 0.03]\n", "body `hand` has no `inertia`", "3 finite numbers > 0 in kg·m²"),
    lacks("[[body]] # second", "position = [1.5, 0, 0]\n", "body `hand` has no `position`", "3 finite numbers in m"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "«{ axis = [0, 0, 1] }", "has no `angle`", "in rad"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "«{ angle = 0.3 }", "has no `axis`", "3 finite numbers, not all 0"),
    lacks("[[joint]] # second", "name = \"wrist\"\n", "joint 2 has no `name`", "a name in quotes"),
    lacks("[[joint]] # second", "type = \"spherical\"\n", "joint `wrist` has no `type`", "\"spherical\", \"revolute\", \"universal\", \"cylindrical\", \"translational\" or \"fixed\""),
    lacks("[[joint]] # second", "between = [\"arm\", \"hand\"]\n", "joint `wrist` has no `between`", "two different bodies"),
    lacks("[[joint]] # second", "at = [1, 0, 0]\n", "joint `wrist` has no `at`", "3 finite numbers in m"),
    lacks("[[joint]] # second", "stiffness = { load = 500, deflection = 1e-4 }\n", "joint `wrist` has no `stiffness`", "or { load = N, deflection = m }"),
    case("{ load = 500, deflection = 1e-4 }", "«{ load = 500 }", "`stiffness` of joint `wrist` has no `deflection`", "> 0 in m"),
    case("{ load = 500, deflection = 1e-4 }", "«{ deflection = 1e-4 }", "`stiffness` of joint `wrist` has no `load`", "> 0 in N"),
    lacks("[[joint]] # second", "arm = 0.03\n", "joint `wrist` has no `arm`", "> 0 in m"),
    lacks("[[joint]] # first", "axis = [0, 0, 2]\n", "joint `shoulder` has no `axis`", "not all 0"),
    lacks("[[joint]] # first", "span = 0.2\n", "joint `shoulder` has no `span`", "> 0 in m"),
    lacks("[[tsda]]", "between = [\"world\", \"hand\"]\n", "tsda 1 has no `between`", "two different bodies"),
    lacks("[[tsda]]", "points = [[2, 0, 0], [0.1, 0, 0]]\n", "tsda 1 has no `points`", "two points in m"),
    lacks("[[tsda]]", "stiffness = 4e5\n", "tsda 1 has no `stiffness`", "≥ 0 in N/m"),
    lacks("[[tsda]]", "free_length = 0.4\n", "tsda 1 has no `free_length`", "≥ 0 in m"),
    lacks("[[torsion_spring]]", "between = [\"arm\", \"world\"]\n", "torsion_spring 1 has no `between`", "two different bodies"),
    lacks("[[torsion_spring]]", "axis = [0, 1, 0]\n", "torsion_spring 1 has no `axis`", "not all 0"),
    lacks("[[torsion_spring]]", "stiffness = 5e4\n", "torsion_spring 1 has no `stiffness`", "{ load = N·m, deflection = rad }"),
    lacks("[[load]]", "body = \"hand\"\n", "load 1 has no `body`", "the name of a body"),
    lacks("[[load]]", "torque = [0, 0, 0.05]\n", "load 1 has neither `force` nor `torque`", "`force` in N, `torque` in N·m, or both"),

    // Types and lengths.
    case("\"one of everything\"", "«17", "`description` of the scene is an integer", "a string in quotes"),
    case("duration = 0.5", "duration = «[0.5]", "`duration` of the scene is an array", "a finite number > 0 in s"),
    case("[0, -9.81, 0]", "«-9.81", "`gravity` of the scene is a float", "an array of 3 finite numbers in m/s²"),
    case("[0, -9.81, 0]", "«[0, -9.81]", "`gravity` of the scene has 2 entries", "an array of 3 finite numbers"),
    case("[0, -9.81, 0]", "[0, «true, 0]", "`gravity`[1] of the scene is a boolean", "a finite number in m/s²"),
    case("name = \"hand\"", "name = «7", "`name` of body 2 is an integer", "a name in quotes"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "«0.3", "`orientation` of body `arm` is a float", "{ axis = [x, y, z], angle = rad }"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "{ quaternion = «[0, 0, 1] }", "has 3 entries", "an array of 4 finite numbers"),
    case("type = \"spherical\"", "type = «1979-05-27", "`type` of joint `wrist` is a datetime", "\"spherical\", \"revolute\", \"universal\", \"cylindrical\", \"translational\" or \"fixed\""),
    case("[\"arm\", \"hand\"]", "«\"arm\"", "`between` of joint `wrist` is a string", "the names of two different bodies"),
    case("[\"arm\", \"hand\"]", "«[\"arm\"]", "`between` of joint `wrist` has 1 entry", "the names of two different bodies"),
    case("[\"arm\", \"hand\"]", "[«1, \"hand\"]", "`between`[0] of joint `wrist` is an integer", "the name of a body or \"world\""),
    case("stiffness = 9e6", "stiffness = \"«stiff\"", "`stiffness` of joint `shoulder`: `stiff` is neither", "≥ 0 in N/m"),
    case("[[2, 0, 0], [0.1, 0, 0]]", "[[2, 0, 0], «[0.1, 0]]", "`points`[1] of tsda 1 has 2 entries", "3 finite numbers in m"),
    case("[[2, 0, 0], [0.1, 0, 0]]", "[[2, 0, 0], [0.1, «\"0 s\", 0]]", "`points`[1][1] of tsda 1 is \"0 s\", a value in s", "a finite number in m"),
    case("[[load]]", "«[load]", "written as [load], in single brackets", "as [[load]]"),

    // Numbers that are not finite.
    case("mass = 1.5", "mass = «nan", "`mass` of body `arm` is nan", "a finite number > 0 in kg"),
    case("velocity = [0, 0.1, 0]", "velocity = [0, «inf, 0]", "`velocity`[1] of body `arm` is inf", "a finite number in m/s"),
    case("preload = 1e4", "preload = «1e999", "`preload` of torsion_spring 1 is 1e999", "a finite number in N·m"),
    case("until = 2", "until = «inf", "`until` of load 1 is inf", "a finite number in s"),

    // Names.
    case("name = \"base\"", "name = «\" \"", "`name` of the scene is empty", "a name in quotes"),
    case("name = \"arm\"", "name = «\"\"", "`name` of body 1 is empty", "a name in quotes"),
    case("name = \"arm\"", "name = «\"world\"", "`name` of body `world` is \"world\"", "give the body another name"),
    case("name = \"hand\"", "name = «\"arm\"", "`name` of body `arm` duplicates \"arm\" of the body on line 8", "each body needs a unique name"),
    case("name = \"wrist\"", "name = «\"shoulder\"", "`name` of joint `shoulder` duplicates \"shoulder\" of the joint on line 23", "each joint needs a unique name"),

    // References.
    case("[\"arm\", \"hand\"]", "[\"arm\", «\"hnad\"]", "`between`[1] of joint `wrist` names no body: \"hnad\"", "did you mean \"hand\"? known bodies: \"arm\", \"hand\", \"world\""),
    case("body = \"hand\"", "body = «\"foot\"", "`body` of load 1 names no body: \"foot\"", "known bodies: \"arm\", \"hand\""),
    case("body = \"hand\"", "body = «\"world\"", "`body` of load 1 is the world", "the name of a body"),
    case("[\"arm\", \"hand\"]", "«[\"arm\", \"arm\"]", "`between` of joint `wrist` joins `arm` to itself", "two different bodies"),
    case("[\"arm\", \"hand\"]", "«[\"world\", \"world\"]", "`between` of joint `wrist` joins `world` to itself", "two different bodies"),
    case("[\"world\", \"hand\"]", "«[\"hand\", \"hand\"]", "`between` of tsda 1 joins `hand` to itself", "two different bodies"),
    case("[\"arm\", \"world\"]", "«[\"arm\", \"arm\"]", "`between` of torsion_spring 1 joins `arm` to itself", "two different bodies"),
    case("type = \"spherical\"", "type = «\"ball\"", "`type` of joint `wrist` is \"ball\"", "\"spherical\", \"revolute\", \"universal\", \"cylindrical\", \"translational\" or \"fixed\""),
    case("type = \"spherical\"", "type = «\"sperical\"", "`type` of joint `wrist` is \"sperical\"", "did you mean \"spherical\"?"),
    case("frame = \"body\"", "frame = «\"hand\"", "`frame` of load 1 is \"hand\"", "\"world\" or \"body\""),

    // Ranges.
    case("duration = 0.5", "duration = «0", "`duration` of the scene is 0", "> 0 in s"),
    case("step = 2e-5", "step = «-2e-5", "`step` of the scene is -2e-5", "> 0 in s"),
    case("every = 1e-3", "every = «0.0", "`every` of the scene is 0.0", "> 0 in s"),
    case("mass = 1.5", "mass = «0", "`mass` of body `arm` is 0", "> 0 in kg"),
    case("mass = 0.7", "mass = «1e-320", "`mass` of body `hand` is 1e-320", "> 0 in kg"),
    case("[0.3, 0.2, 0.4]", "[0.3, «-0.2, 0.4]", "`inertia`[1] of body `arm` is -0.2", "> 0 in kg·m²"),
    case("[0.3, 0.2, 0.4]", "«[0.3, 0.2, 0.50001]", "Iz = 0.50001 > 0.5", "Iz ≤ Ix + Iy"),
    case("[0.3, 0.2, 0.4]", "«[0.3, 0.8, 0.4]", "Iy = 0.8 > 0.7", "Iy ≤ Ix + Iz"),
    case("[0.3, 0.2, 0.4]", "«[0.7, 0.2, 0.4]", "violates the triangle inequality: Ix = 0.7", "Ix ≤ Iy + Iz"),
    case("stiffness = 9e6", "stiffness = «-9e6", "`stiffness` of joint `shoulder` is -9e6", "≥ 0 in N/m"),
    case("stiffness = 5e4", "stiffness = «-5e4", "`stiffness` of torsion_spring 1 is -5e4", "≥ 0 in N·m/rad"),
    case("load = 500", "load = «0", "is 0", "> 0 in N"),
    case("deflection = 1e-4", "deflection = «-1e-4", "is -1e-4", "> 0 in m"),
    case("{ load = 500, deflection = 1e-4 }", "«{ load = 1e300, deflection = 1e-300 }", "`stiffness` of joint `wrist` is infinite", "≥ 0 in N/m"),
    case("damping = 12", "damping = «-12", "`damping` of joint `shoulder` is -12", "≥ 0 in N·s/m"),
    case("damping_ratio = 0.1", "damping_ratio = «-0.1", "`damping_ratio` of joint `wrist` is -0.1", "≥ 0"),
    case("frequency = 550", "frequency = «0", "`frequency` of joint `wrist` is 0", "> 0 in Hz"),
    case("damping_ratio = 0.1", "«damping_ratio = 1e308", "gives an infinite damping", "a larger `frequency`"),
    case("span = 0.2", "span = «0", "`span` of joint `shoulder` is 0", "> 0 in m"),
    case("ring = 0.1", "ring = «-0.1", "`ring` of joint `shoulder` is -0.1", "> 0 in m"),
    case("arm = 0.03", "arm = «0", "`arm` of joint `wrist` is 0", "> 0 in m"),
    case("free_length = 0.4", "free_length = «-0.4", "`free_length` of tsda 1 is -0.4", "≥ 0 in m"),
    case("until = 2", "until = «0.2", "`until` of load 1 is 0.2, not after `from` = 0.25", "omit it for a load that never ends"),

    // Directions and places.
    case("axis = [0, 0, 2]", "axis = «[0, 0, 0]", "`axis` of joint `shoulder` has no direction", "not all 0"),
    case("axis = [0, 1, 0]", "axis = «[0, 0.0, 0]", "`axis` of torsion_spring 1 has no direction", "not all 0"),
    case("axis = [0, 0, 1], angle = 0.3", "axis = «[0, 0, 0], angle = 0.3", "`axis` of `orientation` of body `arm` has no direction", "not all 0"),
    case("axis = [0, 0, 1], angle = 0.3", "quaternion = «[0, 0, 0, 0]", "`quaternion` of `orientation` of body `arm` cannot be normalised", "scalar first, not all 0"),
    case("reference = [1, 1, 0]", "reference = «[0, 0, -3]", "`reference` of joint `shoulder` is parallel to the axis", "normal to it"),
    case("[[2, 0, 0], [0.1, 0, 0]]", "«[[1.6, 0, 0], [0.1, 0, 0]]", "`points` of tsda 1 coincide", "`free_length = 0`"),
    case("[[tsda]]\nbetween = [\"world\", \"hand\"]\npoints = [[2, ", "«[[tsda]]\nbetween = [\"world\", \"hand\"]\npoints = [[1e200, ", "tsda 1 has points or lengths out of the range of double precision", "at most 1e150 m"),

    // Contradictions.
    case("{ axis = [0, 0, 1], angle", "«{ euler_321 = [0, 0, 0], angle", "`orientation` of body `arm` has more than one form", "one of"),
    case("{ axis = [0, 0, 1], angle = 0.3 }", "«{}", "`orientation` of body `arm` is empty", "{ euler_321 = [yaw, pitch, roll] }"),
    case("damping = 12", "damping = 12\n«damping_ratio = 0.1\nfrequency = 550", "`damping_ratio` of joint `shoulder` contradicts `damping`", "either"),
    lacks("damping_ratio = 0.1", "frequency = 550\n", "`damping_ratio` of joint `wrist` needs `frequency`", "add `frequency`"),
    case("damping_ratio = 0.1\n", "«", "`frequency` of joint `wrist` needs `damping_ratio`", "`damping` needs none"),
];

/// Scenes that no edit of the base scene gives: text, place, reason, remedy.
#[rustfmt::skip]
const OTHERS: &[(&str, (usize, usize), &str, &str)] = &[
    ("", (1, 1), "the scene has no `name`", "a name in quotes"),
    ("name = \"a\"\nduration = 1", (1, 1), "the scene has no bodies", "at least one [[body]]"),
    ("name = \"a\"\nduration = 1\nbody = []", (3, 8), "`body` of the scene is empty", "at least one [[body]]"),
    ("name = \"a\"\nduration = 1\nbody = [3]", (3, 9), "`body`[0] of the scene is an integer", "a table, written as [[body]]"),
];

/// Line and column of a byte, from 1.
fn position(text: &str, byte: usize) -> (usize, usize) {
    let lines: Vec<&str> = text[..byte].split('\n').collect();
    (lines.len(), lines[lines.len() - 1].chars().count() + 1)
}

fn refusal(text: &str) -> SceneError {
    match Scene::parse(text, "base.toml") {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error,
    }
}

#[test]
fn the_base_scene_is_accepted() {
    let scene = Scene::parse(BASE, "base.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.model.groups.len(), 3);
}

#[test]
fn each_rejection_names_place_reason_and_remedy() {
    check(BASE, CASES);
}

/// Makes each edit of the base scene and looks at the refusal.
fn check(base: &str, cases: &[Case]) {
    let mut failures = String::new();
    for Case { at, from, to, message, help } in cases {
        assert_eq!(base.matches(from).count(), 1, "{from:?} occurs once in the base scene");
        let mut marked = base.replacen(from, to, 1);
        if let Some(at) = at {
            assert_eq!(base.matches(at).count(), 1, "{at:?} occurs once in the base scene");
            marked = marked.replacen(at, &format!("«{at}"), 1);
        }
        let text = marked.replacen('«', "", 1);
        let expected = marked.find('«').map(|byte| position(&marked, byte));
        let error = refusal(&text);
        let place = error.line().zip(error.column());
        let complete = error.file() == "base.toml"
            && error.message().contains(message)
            && error.help().contains(help)
            && place == expected;
        if !complete {
            failures += &format!(
                "{from:?} => {to:?}\n  at {place:?}, should be {expected:?}\n  {}\n  {}\n",
                error.message(),
                error.help()
            );
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn scenes_without_what_every_scene_has_are_refused() {
    for (text, place, message, help) in OTHERS {
        let error = refusal(text);
        assert_eq!(error.line().zip(error.column()), Some(*place), "{}", error.message());
        assert!(error.message().contains(message), "{}", error.message());
        assert!(error.help().contains(help), "{}", error.help());
    }
}

/// Indices are 16 bits wide: the joint that overflows them is named.
#[test]
fn one_element_too_many_is_refused() {
    let mut text = BASE.to_owned();
    let first = text.matches('\n').count() + 1;
    // The joints of the base scene have nine TSDAs; its raw one comes after all joints.
    let fit = (65535 - 9) / 6;
    for i in 0..=fit {
        text += &format!(
            "[[joint]]\nname = \"j{i}\"\ntype = \"revolute\"\nbetween = [\"arm\", \"hand\"]\n\
             at = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 1\nstiffness = 1\n"
        );
    }
    let error = refusal(&text);
    assert_eq!(error.message(), "joint `j10921` exceeds the 16-bit index range for TSDAs");
    assert_eq!(error.help(), "a scene has at most 65535 TSDAs");
    assert_eq!((error.line(), error.column()), (Some(first + 8 * fit), Some(1)));
}

#[test]
fn an_unreadable_file_is_named() {
    let directory = std::env::temp_dir();
    let path = directory.join("no-such-scene.toml");
    for path in [path, directory] {
        let error = match Scene::load(&path) {
            Ok(_) => panic!("{} was read", path.display()),
            Err(error) => error,
        };
        assert_eq!(error.file(), path.display().to_string());
        assert!(error.message().contains("cannot read"), "{}", error.message());
        assert!(error.help().contains("a readable TOML file"), "{}", error.help());
        assert_eq!((error.line(), error.column()), (None, None));
    }
}
