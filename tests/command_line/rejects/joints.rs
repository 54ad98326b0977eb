//! What the joints with spiders, lines or tripods and raw points on lines are refused for.

use dbd_scene::Scene;

use crate::rejects::{Case, case, check, lacks};

/// One of each.
const BASE: &str = r#"name = "joints"
duration = 1

[[body]] # first
name = "arm"
mass = 1.5
inertia = [0.3, 0.2, 0.4]
position = [0.5, 0, 0]

[[body]] # second
name = "hand"
mass = 0.7
inertia = [0.01, 0.02, 0.03]
position = [1.5, 0, 0]

[[joint]] # third
name = "knee"
type = "universal"
between = ["world", "arm"]
at = [0, 0.5, 0]
axes = [[1, 0, 0], [0, 0, 3]]
spider = { mass = 0.2, inertia = [2e-4, 3e-4, 4e-4] }
stiffness = 8e6
span = 0.06
ring = 0.05

[[joint]] # fourth
name = "piston"
type = "cylindrical"
between = ["arm", "hand"]
at = [1.2, 0, 0]
axis = [4, 0, 0]
stiffness = 7e6
span = 0.07
offset = 0.011

[[joint]] # fifth
name = "guide"
type = "translational"
between = ["world", "hand"]
at = [1.3, 0, 0]
axis = [5, 0, 0]
stiffness = 6e6
span = 0.08
gauge = 0.04
offset = 0.012

[[joint]] # sixth
name = "weld"
type = "fixed"
between = ["hand", "arm"]
at = [1.4, 0, 0]
axis = [6, 0, 0]
stiffness = 5e6
span = 0.09
arm = 0.035

[[point_on_line]]
between = ["hand", "world"]
line_point = [0, 0.02, 0]
line_direction = [0, 0, 7]
point = [1.6, 0.1, 0]
stiffness = 3e5
free_length = 0.013
"#;

#[rustfmt::skip]
const CASES: &[Case] = &[
    // Joints that bring a body.
    lacks("[[joint]] # third", "axes = [[1, 0, 0], [0, 0, 3]]\n", "joint `knee` has no `axes`", "two orthogonal directions"),
    lacks("[[joint]] # third", "spider = { mass = 0.2, inertia = [2e-4, 3e-4, 4e-4] }\n", "joint `knee` has no `spider`", "{ mass = kg, inertia = [Ix, Iy, Iz] }"),
    lacks("[[joint]] # third", "span = 0.06\n", "joint `knee` has no `span`", "> 0 in m"),
    case("{ mass = 0.2, inertia = [2e-4, 3e-4, 4e-4] }", "«{ inertia = [2e-4, 3e-4, 4e-4] }", "`spider` of joint `knee` has no `mass`", "> 0 in kg"),
    case("{ mass = 0.2, inertia = [2e-4, 3e-4, 4e-4] }", "«{ mass = 0.2 }", "`spider` of joint `knee` has no `inertia`", "> 0 in kg·m²"),
    case("mass = 0.2,", "mass = «0,", "`mass` of `spider` of joint `knee` is 0", "> 0 in kg"),
    case("[2e-4, 3e-4, 4e-4]", "[2e-4, «-3e-4, 4e-4]", "`inertia`[1] of `spider` of joint `knee` is -3e-4", "> 0 in kg·m²"),
    case("[2e-4, 3e-4, 4e-4]", "«[2e-4, 3e-4, 6e-4]", "`inertia` of `spider` of joint `knee` violates the triangle inequality", "Iz ≤ Ix + Iy"),
    case("mass = 0.2,", "mass = 0.2, «weight = 2,", "`spider` of joint `knee` has no key `weight`", "`mass`, `inertia`"),
    case("spider = {", "spider = «3 # {", "`spider` of joint `knee` is an integer", "{ mass = kg, inertia = [Ix, Iy, Iz] }"),
    case("[[1, 0, 0], [0, 0, 3]]", "«[[1, 0, 0], [2e-6, 0, 1]]", "`axes` of joint `knee` are 89.999885 degrees apart", "orthogonal within 1e-6"),
    case("[[1, 0, 0], [0, 0, 3]]", "«[[1, 0, 0], [-2, 0, 0]]", "`axes` of joint `knee` are 180.000000 degrees apart", "orthogonal within 1e-6"),
    case("[[1, 0, 0], [0, 0, 3]]", "[[1, 0, 0], «[0, 0, 0]]", "`axes`[1] of joint `knee` has no direction", "not all 0"),
    case("[[1, 0, 0], [0, 0, 3]]", "«[[1, 0, 0]]", "`axes` of joint `knee` has 1 entry", "two orthogonal directions"),
    case("ring = 0.05", "reference = «[0, 0, 1]", "`reference` of joint `knee` is parallel to the axis", "normal to it"),
    case("ring = 0.05", "«axis = [0, 0, 1]", "joint `knee` has no key `axis`", "did you mean `axes`?"),
    case("[[body]] # second\nname = \"hand\"\n", "[[body]]\nname = \"knee.spider\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n[[body]] # second\nname = \"hand\"\n", "`spider` of joint `knee` creates a body `knee.spider`, which already exists", "rename the joint or the body").at("spider = {"),
    case("[\"world\", \"hand\"]\nat", "[«\"link.spider\", \"hand\"]\nat", "names no body: \"link.spider\"", "\"knee.spider\""),

    // Joints on lines and the fixed joint.
    lacks("[[joint]] # fourth", "axis = [4, 0, 0]\n", "joint `piston` has no `axis`", "not all 0"),
    lacks("[[joint]] # fourth", "span = 0.07\n", "joint `piston` has no `span`", "> 0 in m"),
    lacks("[[joint]] # fourth", "offset = 0.011\n", "joint `piston` has no `offset`", "> 0 in m"),
    lacks("[[joint]] # fifth", "gauge = 0.04\n", "joint `guide` has no `gauge`", "> 0 in m"),
    lacks("[[joint]] # fifth", "offset = 0.012\n", "joint `guide` has no `offset`", "> 0 in m"),
    lacks("[[joint]] # sixth", "span = 0.09\n", "joint `weld` has no `span`", "> 0 in m"),
    lacks("[[joint]] # sixth", "arm = 0.035\n", "joint `weld` has no `arm`", "> 0 in m"),
    case("span = 0.06", "span = «0", "`span` of joint `knee` is 0", "> 0 in m"),
    case("span = 0.07", "span = «-0.07", "`span` of joint `piston` is -0.07", "> 0 in m"),
    case("span = 0.08", "span = «0", "`span` of joint `guide` is 0", "> 0 in m"),
    case("span = 0.09", "span = «0.0", "`span` of joint `weld` is 0.0", "> 0 in m"),
    case("offset = 0.011", "offset = «0", "`offset` of joint `piston` is 0", "> 0 in m"),
    case("offset = 0.012", "offset = «-1", "`offset` of joint `guide` is -1", "> 0 in m"),
    case("gauge = 0.04", "gauge = «0", "`gauge` of joint `guide` is 0", "> 0 in m"),
    case("offset = 0.011", "offset = 0.011\n«gauge = 0.1", "joint `piston` has no key `gauge`", "`offset`"),
    case("gauge = 0.04", "gauge = 0.04\n«ring = 0.1", "joint `guide` has no key `ring`", "`gauge`"),
    case("arm = 0.035", "arm = 0.035\n«spider = 1", "joint `weld` has no key `spider`", "`arm`"),
    case("axis = [4, 0, 0]", "axis = [4, 0, 0]\nreference = «[1, 0, 0]", "`reference` of joint `piston` is parallel to the axis", "normal to it"),
    case("[[joint]] # fourth\nname = \"piston\"\ntype = \"cylindrical\"\nbetween = [\"arm\", \"hand\"]\nat = [1.2, 0, 0]", "«[[joint]]\nname = \"piston\"\ntype = \"cylindrical\"\nbetween = [\"arm\", \"hand\"]\nat = [0, 0, 1e15]", "joint `piston` cannot be assembled: its points are", "nearer to the origin"),

    // Realisations.
    case("offset = 0.011", "offset = 0.011\nrealisation = «\"bushing\"", "`realisation` of joint `piston` cannot be set: a cylindrical joint has a single realisation", "remove it"),
    case("gauge = 0.04", "gauge = 0.04\nrealisation = «\"tsda\"", "`realisation` of joint `guide` cannot be set: a translational joint has a single realisation", "remove it"),
    case("arm = 0.035", "arm = 0.035\nrealisation = «\"rubber\"", "`realisation` of joint `weld` is \"rubber\"", "\"bushing\""),
    case("duration = 1\n", "duration = 1\nrealisation = «\"rigid\"\n", "`realisation` of the scene is \"rigid\"", "\"tsda\""),
    case("span = 0.06\nring = 0.05", "span = 0.06\nrealisation = \"bushing\"\nring = «0.05", "`ring` of joint `knee` leads to a stiffness that a bushing cannot represent", "remove `ring`"),

    // Points on lines.
    case("line_direction", "«line_axis", "point_on_line 1 has no key `line_axis`", "`line_direction`"),
    lacks("[[point_on_line]]", "between = [\"hand\", \"world\"]\n", "point_on_line 1 has no `between`", "two different bodies"),
    lacks("[[point_on_line]]", "line_point = [0, 0.02, 0]\n", "point_on_line 1 has no `line_point`", "3 finite numbers in m"),
    lacks("[[point_on_line]]", "line_direction = [0, 0, 7]\n", "point_on_line 1 has no `line_direction`", "not all 0"),
    lacks("[[point_on_line]]", "point = [1.6, 0.1, 0]\n", "point_on_line 1 has no `point`", "3 finite numbers in m"),
    lacks("[[point_on_line]]", "stiffness = 3e5\n", "point_on_line 1 has no `stiffness`", "≥ 0 in N/m"),
    lacks("[[point_on_line]]", "free_length = 0.013\n", "point_on_line 1 has no `free_length`", "≥ 0 in m"),
    case("[0, 0, 7]", "«[0, 0, 0]", "`line_direction` of point_on_line 1 has no direction", "not all 0"),
    case("free_length = 0.013", "free_length = «-0.013", "`free_length` of point_on_line 1 is -0.013", "≥ 0 in m"),
    case("[1.6, 0.1, 0]", "«[1.5, 0.02, 0.3]", "`point` of point_on_line 1 lies on the line", "`free_length = 0`"),
    case("[\"hand\", \"world\"]", "«[\"hand\", \"hand\"]", "`between` of point_on_line 1 joins `hand` to itself", "two different bodies"),
];

#[test]
fn the_base_scene_is_accepted() {
    let scene = Scene::parse(BASE, "base.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((scene.model.groups.len(), scene.model.tsda_count()), (6, 34));
}

#[test]
fn each_rejection_names_place_reason_and_remedy() {
    check(BASE, CASES);
}
