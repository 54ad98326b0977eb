//! What inputs, read-outs, clearances and names of elements are refused for.

use dbd_kernel::{F32, F64, Geometry};
use dbd_scene::Scene;

use crate::rejects::{Case, case, check, lacks};

/// One of each.
const BASE: &str = r#"name = "driven"
duration = 1

[[body]]
name = "arm"
mass = 1.5
inertia = [0.3, 0.2, 0.4]
position = [0.5, 0, 0]

[[body]]
name = "hand"
mass = 0.7
inertia = [0.01, 0.02, 0.03]
position = [1.5, 0, 0]

[[joint]] # first
name = "shoulder"
type = "revolute"
between = ["world", "arm"]
at = [0, 0, 0]
axis = [0, 0, 1]
stiffness = 1e5
span = 0.1
clearance = 1e-4

[[joint]] # second
name = "wrist"
type = "spherical"
between = ["arm", "hand"]
at = [1, 0, 0]
stiffness = 2e5
arm = 0.04

[[joint]] # third
name = "knee"
type = "universal"
between = ["world", "hand"]
at = [2, 0, 0]
axes = [[1, 0, 0], [0, 1, 0]]
spider = { mass = 0.2, inertia = [2e-4, 3e-4, 4e-4] }
stiffness = 8e6
span = 0.06

[[joint]] # fourth
name = "weld"
type = "fixed"
between = ["arm", "hand"]
at = [1, 0.1, 0]
axis = [1, 0, 0]
span = 0.1
arm = 0.02
stiffness = 1e4

[[tsda]] # cord
name = "cord"
between = ["arm", "hand"]
points = [[0, 0, 0], [0, 0, 0.1]]
stiffness = 30
free_length = 0.9

[[tsda]]
name = "pad"
between = ["arm", "hand"]
points = [[0.5, 0.5, 0], [-0.5, 0.5, 0]]
stiffness = 40
free_length = 0

[[tsda]]
name = "tyre"
between = ["hand", "world"]
points = [[0, 0, 0], [1.5, -0.5, 0]]
stiffness = 50
free_length = 0.5

[[torsion_spring]]
name = "coil"
between = ["arm", "hand"]
axis = [0, 1, 0]
stiffness = 3

[[input]] # push
name = "push"
type = "force"
body = "hand"
point = [0.1, 0, 0]
axis = [0, 1, 0]
frame = "body"
value = 2.5

[[input]] # motor
name = "motor"
type = "joint_torque"
target = "shoulder"
table = [[0.0, 0.0], [0.1, 7.5]]
interpolate = "linear"

[[input]] # winch
name = "winch"
type = "actuator"
target = "cord" # pulled

[[input]] # road
name = "road"
type = "anchor"
target = "tyre"
axis = [0, 0, 1] # up

[[input]] # bend
name = "bend"
type = "joint_torque"
target = "wrist"
axis = [1, 1, 0]

[[input]] # twist
name = "twist"
type = "joint_torque"
target = "knee"
about = "second"

[[readout]] # angle
name = "angle"
type = "joint_angle"
target = "shoulder" # seen

[[readout]] # tip
name = "tip"
type = "point"
body = "arm"
point = [0, 0.25, 0]

[[readout]] # pull
name = "pull"
type = "tsda_force"
target = "cord" # read

[[readout]] # held
name = "held"
type = "joint_force"
target = "weld"

[[readout]] # set
name = "set"
type = "input"
target = "motor"
"#;

#[rustfmt::skip]
const CASES: &[Case] = &[
    // Clearances.
    case("clearance = 1e-4", "clearance = «-1e-4", "is -1e-4", "a finite number ≥ 0 in m"),
    case("clearance = 1e-4", "clearance = «0.09", "`clearance` of joint `shoulder` is not below the free length of 0.0866", "below the free length"),
    case("stiffness = 8e6", "stiffness = 8e6\n«clearance = 1e-3", "joint `knee` has no key `clearance`", "`span`"),

    // Names of elements.
    case("name = \"pad\"", "name = «\"cord\"", "duplicates \"cord\" of the tsda on line 54", "each tsda needs a unique name"),
    case("name = \"coil\"", "name = «\"wrist\"", "duplicates \"wrist\" of the joint on line 26", "must be unique"),
    case("name = \"coil\"", "name = «\"\"", "is empty", "a name in quotes"),

    case("name = \"coil\"", "name = «\"co\\nil\"", "`name` of torsion_spring 1 contains a line break", "one line of visible text"),
    case("name = \"tip\"", "name = «\"tip\\u0007\"", "`name` of readout 2 contains a line break or another invisible character", "visible text"),
    case("name = \"push\"", "name = «\"pu\\u202Esh\"", "`name` of input 1 contains", "visible text"),
    case("name = \"driven\"", "name = «\"dri\\rven\"", "`name` of the scene contains", "visible text"),
    case("name = \"arm\"\nmass", "name = «\"\\u200B\"\nmass", "`name` of body 1 contains", "visible text"),
    case("name = \"push\"", "name = «\"pu\\u2060sh\"", "`name` of input 1 contains", "visible text"),
    case("name = \"tip\"", "name = «\"\\u3164\"", "`name` of readout 2 contains", "visible text"),
    case("name = \"tip\"", "name = «\"=1+1\"", "`name` of readout 2 begins with `=`", "begin with a letter"),
    case("name = \"arm\"\nmass", "name = «\"@arm\"\nmass", "`name` of body 1 begins with", "a formula"),
    case("name = \"arm\"\nmass", "name = «\"\\tarm\"\nmass", "`name` of body 1 contains", "visible text"),

    // What every input has.
    lacks("[[input]] # push", "name = \"push\"", "input 1 has no `name`", "add `name`"),
    lacks("[[input]] # push", "type = \"force\"", "input `push` has no `type`", "\"joint_torque\""),
    case("type = \"force\"", "type = «\"thrust\"", "is \"thrust\"", "\"force\", \"torque\""),
    case("type = \"force\"", "type = «\"forces\"", "is \"forces\"", "did you mean \"force\"?"),
    case("name = \"motor\"", "name = «\"push\"", "duplicates \"push\" of the input on line 81", "each input needs a unique name"),
    case("value = 2.5", "value = «inf", "is inf", "a finite number in N"),
    case("value = 2.5", "«vlaue = 2.5", "input `push` has no key `vlaue`", "did you mean `value`?"),
    case("value = 2.5", "«interpolate = \"held\"", "`interpolate` of input `push` requires `table`", "the interpolation of a `table`"),
    case("interpolate = \"linear\"", "interpolate = «\"cubic\"", "is \"cubic\"", "\"held\" or \"linear\""),
    case("interpolate = \"linear\"", "«value = 1", "`value` of input `motor` contradicts `table`", "that the caller sets"),

    // Tables.
    case("[0.1, 7.5]", "«[0.0, 7.5]", "is at 0.0 s, not after 0.0 s", "in ascending order of time"),
    case("[[0.0, 0.0], [0.1, 7.5]]", "[[0.0, 0.0], [0.2, 1], «[0.1, 7.5]]", "`table`[2] of input `motor` is at 0.1 s, not after 0.2 s", "in ascending order of time"),
    case("[[0.0, 0.0], [0.1, 7.5]]", "«[]", "is empty", "ascending in time"),
    case("[0.1, 7.5]", "[0.1, «nan]", "is nan", "a finite number"),
    case("[0.1, 7.5]", "«[0.1]", "has 1 entry", "an array of 2"),
    case("[0.1, 7.5]", "«[1e-308, 7.5]", "has a slope out of the range of double precision", "a larger time"),
    case("[[0.0, 0.0], [0.1, 7.5]]", "«7.5", "is a float", "[time in s, value in N·m]"),

    // Tables that repeat or stand over a read-out, and sines.
    case("table = [[0.0, 0.0], [0.1, 7.5]]", "periodic = true\ntable = «[[0.0, 0.0], [0.1, 7.5]]", "`table` of input `motor` ends at 7.5 but restarts at 0.0", "`jump = true`"),
    case("table = [[0.0, 0.0], [0.1, 7.5]]", "periodic = true\ntable = «[[0.0, 0.0]]", "has only one time and therefore no period", "the end of the period"),
    case("interpolate = \"linear\"", "«jump = true", "`jump` of input `motor` requires `periodic = true`", "another value than its first"),
    case("value = 2.5", "«periodic = true", "`periodic` of input `push` requires `table`", "repeat"),
    case("value = 2.5", "«over = \"angle\"", "`over` of input `push` requires `table`", "the read-out"),
    case("interpolate = \"linear\"", "over = «\"angel\"", "names no read-out column: \"angel\"", "did you mean \"angle\"?"),
    case("interpolate = \"linear\"", "over = «\"tip\"", "names no read-out column: \"tip\"", "one column of a vector read-out"),
    case("interpolate = \"linear\"", "over = \"angle\"\n«periodic = true", "`periodic` of input `motor` contradicts `over`", "holds its end values"),
    case("axis = [0, 0, 1] # up", "axis = [0, 0, 1]\ntable = [[0, 0]]\n«over = \"angle\"", "`over` of input `road` is not compatible with the type \"anchor\"", "over time or a `sine`"),
    case("interpolate = \"linear\"", "«sine = { amplitude = 1, frequency = 2 }", "`sine` of input `motor` contradicts `table`", "a `table` or a `sine`"),
    case("value = 2.5", "sine = «{ amplitude = 1 }", "`sine` of input `push` has no `frequency`", "in Hz"),
    case("value = 2.5", "sine = { amplitude = 1, frequency = «0 }", "is 0", "> 0 in Hz"),
    case("value = 2.5", "sine = { amplitude = «\"2 m\", frequency = 2 }", "is \"2 m\", a value in m", "in N"),
    case("value = 2.5", "sine = { amplitude = 1, frequency = 2, «phsae = 1 }", "has no key `phsae`", "did you mean `phase`?"),

    // Forces.
    case("body = \"hand\"\npoint = [0.1", "body = «\"hnad\"\npoint = [0.1", "names no body: \"hnad\"", "did you mean \"hand\"?"),
    case("body = \"hand\"\npoint = [0.1", "body = «\"world\"\npoint = [0.1", "is the world, which is fixed", "the name of a body"),
    case("axis = [0, 1, 0]\nframe", "axis = «[0, 0, 0]\nframe", "has no direction", "not all 0"),
    lacks("[[input]] # push", "axis = [0, 1, 0]\nframe = \"body\"", "input `push` has no `axis`", "add `axis`"),
    case("frame = \"body\"", "frame = «\"joint\"", "is \"joint\"", "\"world\" or \"body\""),
    case("frame = \"body\"", "«target = \"shoulder\"", "input `push` has no key `target`", "`body`"),

    // Torques of joints.
    case("target = \"shoulder\"\ntable", "target = «\"sholder\"\ntable", "names nothing: \"sholder\"", "did you mean \"shoulder\"?"),
    case("target = \"shoulder\"\ntable", "target = «\"weld\"\ntable", "names the fixed joint `weld`, which has no rotation axis", "a revolute, cylindrical"),
    case("target = \"shoulder\"\ntable", "target = «\"cord\"\ntable", "names the tsda \"cord\"", "a joint or of a torsion_spring"),
    case("interpolate = \"linear\"", "«axis = [0, 0, 1]", "`axis` of input `motor` is not allowed here", "a revolute joint defines its own axis"),
    case("type = \"joint_torque\"\ntarget = \"wrist\"\naxis = [1, 1, 0]", "type = \"joint_force\"\ntarget = «\"wrist\"", "names the spherical joint `wrist`, which does not slide", "a translational or cylindrical joint"),
    case("type = \"joint_torque\"\ntarget = \"wrist\"\naxis = [1, 1, 0]", "type = \"joint_force\"\ntarget = «\"coil\"", "names the torsion_spring \"coil\"", "must be the name of a joint"),
    case("type = \"joint_torque\"\ntarget = \"wrist\"\naxis", "type = \"joint_force\"\ntarget = \"wrist\"\n«axis", "input `bend` has no key `axis`", "`target`"),
    lacks("[[input]] # bend", "axis = [1, 1, 0]", "input `bend` has no `axis`", "in world axes"),
    lacks("[[input]] # twist", "about = \"second\"", "input `twist` has no `about`", "\"first\" or \"second\""),
    case("about = \"second\"", "about = «2", "is an integer", "\"first\" or \"second\""),

    // Actuators and anchors.
    case("target = \"cord\" # pulled", "target = «\"wrist\" # pulled", "names the joint \"wrist\"", "the name of a tsda"),
    case("target = \"cord\" # pulled", "target = «\"pad\" # pulled", "names the tsda `pad`, which has no free length and therefore no direction", "`free_length` > 0"),
    case("target = \"tyre\"", "target = «\"cord\"", "names `cord`, which is not joined to the world", "joins a body to \"world\""),
    case("target = \"tyre\"", "target = [\"tyre\", «\"coil\"]", "names the torsion_spring \"coil\"", "a joint, a tsda or a point_on_line"),
    case("target = \"tyre\"", "target = [\"tyre\", «\"tyre\"]", "`target`[1] of input `road` names `tyre` a second time", "name each element once"),
    case("target = \"tyre\"", "target = «[]", "is empty", "an array of such names"),
    case("target = \"knee\"\nabout = \"second\"", "target = «\"tyre\"\naxis = [1, 0, 0]", "names the tsda \"tyre\"", "a joint or of a torsion_spring"),

    // Read-outs.
    lacks("[[readout]] # angle", "name = \"angle\"", "readout 1 has no `name`", "add `name`"),
    case("type = \"joint_angle\"", "type = «\"joint_angel\"", "is \"joint_angel\"", "did you mean \"joint_angle\"?"),
    case("target = \"shoulder\" # seen", "target = «\"elbow\" # seen", "names nothing: \"elbow\"", "a torsion_spring"),
    case("type = \"joint_angle\"\ntarget = \"shoulder\"", "type = \"joint_travel\"\ntarget = «\"shoulder\"", "names the revolute joint `shoulder`, which does not slide", "a joint_travel needs a translational or cylindrical joint"),
    case("type = \"joint_angle\"\ntarget = \"shoulder\"", "type = \"joint_travel_rate\"\ntarget = «\"sholder\"", "names nothing: \"sholder\"", "did you mean \"shoulder\"?"),
    case("target = \"shoulder\" # seen", "target = «\"weld\" # seen", "which has no rotation axis", "a revolute, cylindrical"),
    case("name = \"tip\"", "name = «\"angle\"", "duplicates \"angle\" of the readout", "each readout needs a unique name"),
    case("name = \"tip\"", "name = «\"hand\"", "gives the trace a column `hand.x`, which the body `hand` already gives", "e.g. \"hand_point\""),
    case("name = \"tip\"", "name = «\"knee.spider\"", "column `knee.spider.x`, which the body `knee.spider` already gives", "\"knee_spider_point\""),
    case("name = \"held\"", "name = «\"tip\"", "duplicates \"tip\" of the readout", "unique name"),
    case("name = \"pull\"", "name = «\"tip.y\"", "column `tip.y`, which readout `tip` already gives", "\"tip_y_tsda_force\""),
    case("name = \"pull\"", "name = «\"arm.qw\"", "column `arm.qw`, which the body `arm` already gives", "another name"),
    case("name = \"pull\"", "name = «\"time\"", "column `time`, which the time already gives", "\"time_tsda_force\""),
    case("name = \"set\"", "name = «\"energy.total\"", "column `energy.total`, which the energy already gives", "another name"),
    case("body = \"arm\"\npoint", "body = «\"leg\"\npoint", "names no body: \"leg\"", "\"arm\""),
    case("point = [0, 0.25, 0]", "point = «[0, 0.25]", "has 2 entries", "an array of 3"),
    case("target = \"cord\" # read", "target = «\"pad\" # read", "which has no direction", "joint_force"),
    case("target = \"weld\"", "target = «\"coil\"", "names the torsion_spring \"coil\"", "a joint, a tsda or a point_on_line"),
    case("target = \"motor\"", "target = «\"motr\"", "names no input: \"motr\"", "did you mean \"motor\"?"),
];

#[test]
fn refusals_name_place_reason_and_remedy() {
    Scene::parse(BASE, "base.toml").unwrap_or_else(|e| panic!("{} ({})", e.message(), e.help()));
    check(BASE, CASES);
}

/// The base scene with other values and tables of the inputs `push` and `motor`.
fn driven(value: &str, table: &str) -> Scene {
    let text = BASE.replace("2.5", value).replace("[[0.0, 0.0], [0.1, 7.5]]", table);
    Scene::parse(&text, "driven.toml").unwrap()
}

#[test]
fn inputs_that_a_precision_cannot_hold_are_named() {
    let table = "[[0.0, 0.0], [0.1, 7.5]]";
    for (value, given, named) in [
        ("1e300", table, "push"),
        ("2.5", "[[0.0, 0.0], [1e-30, 1e10]]", "motor"),
        ("2.5", "[[-1e300, 0.0], [1.0, 1.0]]", "motor"),
        ("2.5", "[[0.0, -3e38], [10.0, 3e38]]", "motor"),
    ] {
        let scene = driven(value, given);
        assert_eq!(dbd_scene::check_inputs::<F64>(&scene), Ok(()));
        let unfit = dbd_scene::check_inputs::<F32>(&scene).unwrap_err();
        assert_eq!((unfit.input.as_str(), unfit.precision), (named, F32::NAME));
        let line = BASE.lines().position(|line| line == format!("[[input]] # {named}")).unwrap();
        assert_eq!(unfit.line, line + 1);
        let message = unfit.to_string();
        assert!(message.contains(&format!("input `{named}`")) && message.contains("f32"));
    }
    assert_eq!(dbd_scene::check_inputs::<F32>(&driven("2.5", table)), Ok(()));
}
