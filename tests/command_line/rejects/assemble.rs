//! What joints given by their halves and `[assemble]` are refused for.

use dbd_scene::Scene;

use crate::rejects::{Case, case, check};

/// A slider-crank whose rod is open by 0.02 m and 0.0132 rad.
const BASE: &str = r#"name = "slider-crank"
duration = 1

[assemble]
fixed = ["crank"]
length = 0.4
tolerance = 1e-10
iterations = 50

[[body]] # first
name = "crank"
mass = 1
inertia = [0.1, 0.2, 0.3]
position = [0, 0.25, 0]

[[body]] # second
name = "rod"
mass = 1
inertia = [0.1, 0.2, 0.3]
position = [0.6, 0.25, 0]

[[body]] # third
name = "slider"
mass = 1
inertia = [0.1, 0.2, 0.3]
position = [1.2, 0, 0]

[[joint]] # base
name = "base"
type = "revolute"
between = ["world", "crank"]
at = [0, 0, 0]
axis = [0, 0, 1]
stiffness = 9e6
span = 0.2

[[joint]] # pin
name = "pin"
type = "revolute"
between = ["crank", "rod"]
at = [0, 0.5, 0]
axis = { first = [0, 0, 1], second = [-0.005, -0.0122, 1] }
stiffness = 9e6
span = 0.2

[[joint]] # wrist
name = "wrist"
type = "spherical"
between = ["rod", "slider"]
at = { first = [1.22, 0, 0], second = [1.2, 0, 0] }
stiffness = 9e6
arm = 0.1

[[joint]] # guide
name = "guide"
type = "translational"
between = ["world", "slider"]
at = [1.2, 0, 0]
axis = [1, 0, 0]
reference = { first = [0, 1, 0], second = [0, 2, 0] }
stiffness = 9e6
span = 0.2
gauge = 0.1
offset = 0.05
"#;

#[rustfmt::skip]
const CASES: &[Case] = &[
    // The halves of a joint.
    case("{ first = [1.22, 0, 0], second = [1.2, 0, 0] }", "«{ first = [1.22, 0, 0] }", "`at` of joint `wrist` has no `second`", "3 finite numbers in m, world"),
    case("{ first = [1.22, 0, 0], second = [1.2, 0, 0] }", "{ first = [1.22, 0, 0], second = [1.2, 0, 0], «third = 0 }", "`at` of joint `wrist` has no key `third`", "`first`, `second`"),
    case("second = [1.2, 0, 0] }", "second = «[1.2, 0] }", "`second` of `at` of joint `wrist` has 2 entries", "3 finite numbers in m, world"),
    case("{ first = [1.22, 0, 0], second = [1.2, 0, 0] }", "«3", "`at` of joint `wrist` is an integer", "or { first = …, second = … } with one for each body"),
    case("second = [-0.005, -0.0122, 1]", "second = «[0, 0, 0]", "`second` of `axis` of joint `pin` has no direction", "not all 0"),
    case("{ first = [0, 1, 0], second = [0, 2, 0] }", "«{ first = [1, 0, 0], second = [0, 2, 0] }", "`reference` of joint `guide` is parallel to the axis", "normal to it"),
    case("[assemble]\nfixed = [\"crank\"]\nlength = 0.4\ntolerance = 1e-10\niterations = 50\n", "", "joint `pin` is open by 0.0132 rad at the given poses", "add a table [assemble]").at("[[joint]] # pin"),

    // The table.
    case("[assemble]\nfixed = [\"crank\"]\nlength = 0.4\ntolerance = 1e-10\niterations = 50\n", "assemble = «true\n", "`assemble` of the scene is a boolean", "a table, opened by [assemble]"),
    case("tolerance = 1e-10", "«tolerence = 1e-10", "`assemble` of the scene has no key `tolerence`", "did you mean `tolerance`?"),
    case("tolerance = 1e-10", "tolerance = «0", "`tolerance` of `assemble` of the scene is 0", "> 0 in m"),
    case("length = 0.4", "length = «-1", "`length` of `assemble` of the scene is -1", "> 0 in m"),
    case("iterations = 50", "iterations = «0", "`iterations` of `assemble` of the scene is 0", "a whole number from 1 to 10000"),
    case("iterations = 50", "iterations = «1.5", "`iterations` of `assemble` of the scene is 1.5", "a whole number from 1 to 10000"),
    case("[\"crank\"]\nlength", "«\"crank\"\nlength", "`fixed` of `assemble` of the scene is a string", "an array of names of bodies"),
    case("[\"crank\"]\nlength", "[«\"cramk\"]\nlength", "`fixed`[0] of `assemble` of the scene names no body: \"cramk\"", "did you mean \"crank\"?"),
    case("[\"crank\"]\nlength", "[«\"world\"]\nlength", "`fixed`[0] of `assemble` of the scene is the world", "the name of a body"),

    // Loops that stay open.
    case("first = [1.22, 0, 0]", "first = [0.2, 0.5, 0]", "joint `wrist` stays open by ", "use other lengths, fewer `fixed` bodies").at("[[joint]] # wrist"),
    case("[\"crank\"]\nlength", "[\"crank\", \"rod\"]\nlength", "joint `pin` stays open by 0.0132 rad", "neither `crank` nor `rod` may be moved").at("[[joint]] # pin"),
    // Rates.
    case("iterations = 50", "rates = «3", "`rates` of `assemble` of the scene is an integer", "{ JOINT = rate }"),
    case("iterations = 50", "rates = { pni = «3 }", "`pni` of `rates` of `assemble` of the scene is not a joint: \"pni\"", "did you mean `pin`?"),
    case("iterations = 50", "rates = { pin = «\"3 m/s\" }", "`pin` of `rates` of `assemble` of the scene is \"3 m/s\"", "a finite number in rad/s"),
    case("iterations = 50", "rates = { guide = «\"3 rad/s\" }", "`guide` of `rates` of `assemble` of the scene is \"3 rad/s\"", "a finite number in m/s"),
    case("iterations = 50", "rates = { wrist = «3 }", "`wrist` of `rates` of `assemble` of the scene is the rate of a spherical joint", "a body's `velocity` and `angular_velocity`"),
    case("iterations = 50", "rates = { base = «3, guide = 1 }", "`base` of `rates` of `assemble` of the scene is inconsistent with the other velocities: ", "as there are degrees of freedom"),
    case("[1.2, 0, 0]\n\n[[joint]] # base", "[1.2, 0, 0]\nvelocity = «[0, 1, 0]\n\n[[joint]] # base", "`velocity` of body `slider` is a motion that the joints prevent", "loops of joints prevent this motion"),

    case("iterations = 50", "iterations = 1", "joint `wrist` stays open by ", "more `iterations`").at("[[joint]] # wrist"),
];

#[test]
fn the_base_scene_is_accepted() {
    let scene = Scene::parse(BASE, "base.toml").unwrap_or_else(|error| panic!("{error}"));
    let assembled = scene.assembled.unwrap();
    assert_eq!((assembled.moved.len(), assembled.freedoms), (2, 0));
}

#[test]
fn each_rejection_names_place_reason_and_remedy() {
    check(BASE, CASES);
}
