//! What points and links are refused for: place, reason, remedy.

use dbd_scene::Scene;

const BASE: &str = r#"name = "base"
duration = 1
[defaults.joint]
damping = 1
[defaults.link]
density = 10
[points]
A = [0, 0, 0]
B = [1, 0, 0]
C = { from = "B", distance = 2, angle = 0.5 }
D = { from = ["A", "B"], distances = [1, 1], side = "left" }
E = { frame = "box", at = [0, 0, 1] }
F = { from = "C", axis = [0, 0, 1], angle = 0.5 }
[[body]]
name = "bar"
mass = 1
inertia = [1, 1, 1] # moments
link = { from = "A", to = "B" } # link
[[body]]
name = "box"
mass = 1 # of the box
inertia = [[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]
position = "C" # place
[[joint]]
name = "pin"
type = "revolute"
between = ["bar", "world"]
at = "B" # joint
axis = [0, 0, 1]
stiffness = 1e6
span = 0.1
"#;

/// An edit of the base scene, `«` before what must be named; what is wrong, what would be right.
type Case = (&'static str, &'static str, &'static str, &'static str);

fn check(cases: &[Case]) {
    let mut failures = String::new();
    for (from, to, message, help) in cases {
        assert_eq!(BASE.matches(from).count(), 1, "{from:?} occurs once");
        let marked = BASE.replacen(from, to, 1);
        let byte = marked.find('«').unwrap();
        let line = marked[..byte].matches('\n').count() + 1;
        let column = marked[..byte].rsplit('\n').next().unwrap().chars().count() + 1;
        let text = marked.replacen('«', "", 1);
        let error = match Scene::parse(&text, "base.toml") {
            Ok(_) => {
                failures += &format!("{from:?} => {to:?} is taken\n");
                continue;
            }
            Err(error) => error,
        };
        let place = error.line().zip(error.column());
        let is_right = error.message().contains(message) && error.help().contains(help);
        if !is_right || place != Some((line, column)) {
            failures += &format!(
                "{from:?} => {to:?}\n  at {place:?}, should be {:?}\n  {}\n  {}\n",
                (line, column),
                error.message(),
                error.help()
            );
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn the_base_scene_is_taken() {
    Scene::parse(BASE, "base.toml").unwrap();
}

#[rustfmt::skip]
#[test]
fn points_are_refused_at_their_place() {
    check(&[
        ("A = [0, 0, 0]", "A = «0", "`A` of [points] is an integer", "[x, y, z] in m"),
        ("A = [0, 0, 0]", "A = «[0, 0]", "`A` of [points] has 2 entries", "3 finite numbers in m"),
        ("A = [0, 0, 0]", "A = [0, «true, 0]", "`A`[1] of [points] is a boolean", "a finite number in m"),
        ("A = [0, 0, 0]", "A = «[0, 1e151, 0]", "`A` of [points] is out of range", "not exceed 1e150 m"),
        ("A = [0, 0, 0]", "A = [0, 0, 0]\n«\" \" = [0, 0, 0]", "[points] has a name that is empty", "a name in quotes"),
        ("A = [0, 0, 0]", "A = «\"B2\"", "`A` of [points] names no point: \"B2\"", "did you mean"),
        ("B = [1, 0, 0]", "B = «{ from = \"C\", offset = [1, 0, 0] }", "`B` of [points] depends on itself: point `B` -> point `C` -> point `B`", "does not depend on the others"),
        ("B = [1, 0, 0]", "B = «{ frame = \"bar\", at = [1, 0, 0] }", "`B` of [points] depends on itself: point `B` -> body `bar` -> point `B`", "does not depend on the others"),
        ("C = { from = \"B\"", "C = { «form = \"B\"", "`C` of [points] has no key `form`", "did you mean `from`?"),
        ("C = { from = \"B\"", "C = { from = «\"Q\"", "`from` of `C` of [points] names no point: \"Q\"", "known points: \"A\", \"B\""),
        ("C = { from = \"B\", ", "C = «{ ", "`C` of [points] has no `from`", "distance = m, angle = rad"),
        ("distance = 2, ", "«share = 2, ", "`C` of [points] has no key `share`", "`distance`"),
        ("C = { from = \"B\", distance = 2, angle = 0.5 }", "C = «{ from = \"B\", distance = 2 }", "has no position relative to `from`", "`offset`, or `distance` with"),
        ("angle = 0.5 }\nD", "angle = 0.5, reference = «[0, 0, 2] }\nD", "is parallel to the normal", "not parallel to the normal"),
        ("distances = [1, 1]", "distances = «[0.2, 0.3]", "have no point in common: the points are 1.0 m apart", "whose sum is at least 0.5 m"),
        ("distances = [1, 1]", "distances = «[5, 1]", "have no point in common: the points are 1.0 m apart", "whose difference is at most that"),
        ("distances = [1, 1]", "distances = [1, «0]", "`distances`[1] of `D` of [points] is 0", "> 0 in m"),
        ("from = [\"A\", \"B\"]", "from = «[\"A\", \"A\"]", "names two coincident points", "two different points"),
        ("side = \"left\"", "side = «\"above\"", "`side` of `D` of [points] is \"above\"", "\"left\" or \"right\""),
        ("side = \"left\"", "side = \"left\", normal = «[1, 0, 0]", "is parallel to that line", "not parallel to the line"),
        ("frame = \"box\"", "frame = «\"bax\"", "names no body: \"bax\"", "known bodies: \"bar\", \"box\""),
        ("frame = \"box\"", "frame = «[\"A\", \"B\", [2, 0, 0]]", "does not span a plane", "not collinear"),
        ("at = [0, 0, 1] }", "at = «\"A\" }", "is a string", "3 finite numbers in m"),
        ("axis = [0, 0, 1], angle", "axis = «[0, 0, 0], angle", "has no direction", "not all 0"),
    ]);
}

#[rustfmt::skip]
#[test]
fn links_and_names_are_refused_at_their_place() {
    check(&[
        ("axis = [0, 0, 1]\nstiffness", "axis = «[\"A\"]\nstiffness", "`axis` of joint `pin` has 1 entry", "the names of two points"),
        ("axis = [0, 0, 1]\nstiffness", "axis = [\"A\", «\"Q\"]\nstiffness", "`axis`[1] of joint `pin` names no point: \"Q\"", "known points: \"A\", \"B\""),
        ("axis = [0, 0, 1]\nstiffness", "axis = «[\"A\", \"A\"]\nstiffness", "`axis` of joint `pin` has points that coincide", "from the first to the second"),
        ("link = { from = \"A\", to = \"B\" }", "link = «3", "`link` of body `bar` is an integer", "{ from = \"A\", to = \"B\" }"),
        ("from = \"A\", to = \"B\" } #", "from = \"A\", «too = \"B\" } #", "`link` of body `bar` has no key `too`", "did you mean `to`?"),
        ("from = \"A\", to = \"B\" } #", "from = \"A\", to = «\"A\" } #", "`to` of `link` of body `bar` coincides with `from`", "two different points"),
        ("to = \"B\" } #", "to = \"B\", length = «2 } #", "`length` of `link` of body `bar` is 2.0 m, but its points are 1.0 m apart", "[assemble]"),
        ("to = \"B\" } #", "to = \"B\", along = «\"w\" } #", "is \"w\"", "\"x\", \"y\" or \"z\""),
        ("to = \"B\" } #", "to = \"B\", reference = «[1, 0, 0] } #", "is parallel to the link", "not parallel to the link"),
        ("link = {", "«position = [0, 0, 0]\nlink = {", "`position` of body `bar` contradicts `link`", "`centre`"),
        ("link = {", "«orientation = { quaternion = [1, 0, 0, 0] }\nlink = {", "`orientation` of body `bar` contradicts `link`", "`along`"),
        ("position = \"C\"", "position = «\"Ca\"", "`position` of body `box` names no point: \"Ca\"", "known points: \"A\", \"B\", \"C\", \"D\""),
        ("at = \"B\"", "at = «\"G\"", "`at` of joint `pin` names no point: \"G\"", "known points: \"A\""),
    ]);
}

#[rustfmt::skip]
#[test]
fn inertia_and_shapes_are_refused_at_their_place() {
    check(&[
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "«[[2, 0.5, 0], [0.4, 3, 0], [0, 0, 4]]", "`inertia` of body `box` is not symmetric: Ixy = 0.5, Iyx = 0.4", "Ixy = −∫x·y dm"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "«[[2, 2.5, 0], [2.5, 3, 0], [0, 0, 4]]", "has the principal moments -0.0495", "Ixy² < Ixx·Iyy"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "«[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 6]]", "violates the triangle inequality about its principal axes: Iz = 6.0 > 5", "Iz ≤ Ix + Iy"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "«[[2, 0, 0], [0, 3, 0], [0, 0, 6]]", "violates the triangle inequality: Iz = 6.0 > 5.0", "Iz ≤ Ix + Iy"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "[[2, 0.5, 0], [0.5, «-3, 0], [0, 0, 4]]", "`inertia`[1][1] of body `box` is -3", "> 0 in kg·m²"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "«[[2, 0.5, 0], [0.5, 3, 0]]", "`inertia` of body `box` has 2 entries", "or a symmetric tensor"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "[[2, 0.5, 0], «[0.5, 3], [0, 0, 4]]", "`inertia`[1] of body `box` has 2 entries", "3 finite numbers"),
        ("[[2, 0.5, 0], [0.5, 3, 0], [0, 0, 4]]", "[[2, 0.5, 0], [0.5, 3, 0], «7]", "`inertia`[2] of body `box` is an integer", "3 finite numbers"),
        ("[1, 1, 1] # moments", "«\"heavy\"", "`inertia` of body `bar` is a string", "or a symmetric tensor"),
        ("to = \"B\" } #", "to = \"B\", shape = «\"pipe\" } #", "is \"pipe\"", "\"tube\""),
        ("to = \"B\" } #", "to = \"B\", shape = \"box\", «diameter = 1 } #", "`link` of body `bar` has no key `diameter`", "`section`"),
        ("to = \"B\" } #", "to = \"B\", mass = 2, «density = 3 } #", "`density` of `link` of body `bar` contradicts `mass`", "either"),
        ("mass = 1 # of the box", "shape = { type = \"plate\", length = 1, width = 1, «density = 3 }", "is given for a body without volume", "add `thickness`"),
        ("to = \"B\" } #", "to = \"B\", shape = \"tube\", diameter = 1, wall = «0.6 } #", "leaves no wall or no bore", "a wall of at most half the outer one"),
        ("to = \"B\" } #", "to = \"B\", shape = \"tube\", diameter = 1, «wall = 0.1, inner_diameter = 0.5 } #", "`wall` of `link` of body `bar` contradicts", "either `wall` or"),
        ("link = {", "«shape = { type = \"rod\", length = 1 }\nlink = {", "`shape` of body `bar` contradicts `link`", "its `centre`"),
        ("link = {", "«frame = \"box\"\nlink = {", "`frame` of body `bar` contradicts `link`", "its `centre`"),
        ("position = \"C\"", "position = \"C\"\nshape = «{ length = 1 }", "`shape` of body `box` has no `type`", "\"rod\", \"box\""),
        ("position = \"C\"", "position = \"C\"\nshape = «{ type = \"rod\" }", "`shape` of body `box` has no `length`", "> 0 in m"),
        ("position = \"C\"", "position = \"C\"\nshape = { type = \"sphere\", «length = 1, diameter = 2 }", "`shape` of body `box` has no key `length`", "`diameter`"),
        ("position = \"C\"", "position = \"C\"\nframe = «\"bix\"", "`frame` of body `box` names no body: \"bix\"", "known bodies: \"bar\", \"box\""),
    ]);
}

#[rustfmt::skip]
#[test]
fn defaults_are_refused_at_their_place() {
    check(&[
        ("[defaults.joint]", "[defaults.«jiont]", "[defaults] has no key `jiont`", "did you mean `joint`?"),
        ("damping = 1", "«dampign = 1", "[defaults.joint] has no key `dampign`", "did you mean `damping`?"),
        ("damping = 1", "«name = \"all\"", "[defaults.joint] has no key `name`", "`type`"),
        ("damping = 1", "damping = «-1", "`damping` of joint `pin` is -1", "≥ 0 in N·s/m"),
        ("[defaults.joint]\ndamping = 1", "[defaults]\njoint = «3", "`joint` of [defaults] is an integer", "a table of keys"),
        ("[defaults.link]\ndensity = 10", "[defaults.revolute]\n«arm = 3", "[defaults.revolute] has no key `arm`", "`ring`"),
    ]);
}
