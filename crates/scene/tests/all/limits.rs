//! Limits and friction of joints: the interactions that they stand for.

use dbd_kernel::energy::energy;
use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::Scene;

/// A slider on a guide and a lever on it, and what their joints have besides.
fn scene(slide: &str, turn: &str) -> Result<Scene, String> {
    let text = format!(
        r#"
name = "limits"
duration = 1
[[body]]
name = "slider"
mass = 2
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[body]]
name = "lever"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0.3, 0]
[[joint]]
name = "guide"
type = "translational"
between = ["world", "slider"]
at = [0, 0, 0]
axis = [1, 0, 0]
span = 0.1
gauge = 0.05
offset = 0.02
stiffness = 1e6
{slide}
[[joint]]
name = "pivot"
type = "revolute"
between = ["slider", "lever"]
at = [0, 0, 0]
axis = [0, 0, 1]
span = 0.05
stiffness = 1e6
{turn}
"#
    );
    Scene::parse(&text, "limits.toml").map_err(|error| format!("{:?}", miette::Report::new(error)))
}

#[test]
fn a_key_of_a_joint_is_the_interaction_about_its_axis() {
    let keyed = scene(
        "limits = { from = \"-20 mm\", to = \"30 mm\", stiffness = \"1 MN/m\", dissipation = 0.5 }\n\
         friction = { coulomb = 2, breakaway = 3, viscous = 0.1, damping = 7 }",
        "limits = { from = \"-30 deg\", to = \"90 deg\", stiffness = 200 }\nfriction = { coulomb = 0.1 }",
    )
    .unwrap();
    let listed = scene(
        "",
        "[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"slider\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         normal = [1, 0, 0]\nfrom = -0.02\nto = 0.03\nstiffness = 1e6\ndissipation = 0.5\n\
         [[interaction]]\nlaw = \"slide-friction\"\nbetween = [\"world\", \"slider\"]\naxis = [1, 0, 0]\n\
         points = [[0, 0, 0], [0, 0, 0]]\ncoulomb = 2\nbreakaway = 3\nviscous = 0.1\ndamping = 7\n\
         [[interaction]]\nlaw = \"hinge-stop\"\nbetween = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\n\
         from = \"-30 deg\"\nto = \"90 deg\"\nstiffness = 200\n\
         [[interaction]]\nlaw = \"hinge-friction\"\nbetween = [\"slider\", \"lever\"]\naxis = [0, 0, 1]\n\
         coulomb = 0.1\nbreakaway = 0.1\ndamping = 0.7071067811865476\n",
    )
    .unwrap();
    let of = |scene: &Scene| Plant::new(&scene.model, Leapfrog, 1e-4).unwrap().fingerprint();
    assert_eq!(of(&keyed), of(&listed));
    let labels: Vec<_> =
        dbd_scene::interactions(&keyed).iter().map(|found| found.label.clone()).collect();
    assert_eq!(
        labels,
        [
            "limits `guide.limits` (world–slider)",
            "friction `guide.friction` (world–slider)",
            "limits `pivot.limits` (slider–lever)",
            "friction `pivot.friction` (slider–lever)",
        ]
    );
    assert_eq!(dbd_scene::interactions(&keyed)[2].name(), Some("pivot.limits"));
    assert_eq!(keyed.line_of_interaction(2), keyed.line_of_joint(1));
}

/// Limits of a raw TSDA are a stop of its length, of a torsion spring one of its twist; the ground may come second.
#[test]
fn limits_of_springs_are_the_interactions_of_their_geometry() {
    let springs = |more: [&str; 2]| {
        format!(
            "[[tsda]]\nname = \"strut\"\nbetween = [\"lever\", \"world\"]\npoints = [[0, 0.1, 0], [0.5, 0, 0]]\n\
             stiffness = 100\nfree_length = \"initial\"\n{}\n[[torsion_spring]]\nbetween = [\"world\", \"lever\"]\n\
             axis = [0, 0, 2]\nstiffness = 3\n{}\n",
            more[0], more[1]
        )
    };
    let keyed = scene(
        "",
        &springs([
            "limits = { from = \"0.4 m\", to = \"0.8 m\", stiffness = 1e5, dissipation = 0.5 }",
            "limits = { from = \"-10 deg\", to = \"20 deg\", offset = \"5 deg\", stiffness = 50, restitution = 1, speed = 1 }",
        ]),
    )
    .unwrap();
    let law = |law: &str, keys: &str| {
        format!("[[interaction]]\nlaw = \"{law}\"\nbetween = [\"world\", \"lever\"]\n{keys}\n")
    };
    let listed = scene(
        "",
        &[
            springs(["", ""]),
            law(
                "distance-stop",
                "points = [[0.5, 0, 0], [0, 0.1, 0]]\nfrom = 0.4\nto = 0.8\nstiffness = 1e5\ndissipation = 0.5",
            ),
            law(
                "hinge-stop",
                "axis = [0, 0, 1]\nfrom = \"-10 deg - 5 deg\"\nto = \"20 deg - 5 deg\"\nstiffness = 50",
            ),
        ]
        .concat(),
    )
    .unwrap();
    let of = |scene: &Scene| Plant::new(&scene.model, Leapfrog, 1e-4).unwrap().fingerprint();
    assert_eq!(of(&keyed), of(&listed));
    let found = dbd_scene::interactions(&keyed);
    assert_eq!(found[0].name(), Some("strut.limits"));
    assert_eq!(found[1].label, "limits of torsion_spring 1 (world–lever)");
    assert!(keyed.line_of_interaction(0) < keyed.line_of_interaction(1));
    let ground = "[[torsion_spring]]\nbetween = [\"lever\", \"world\"]\naxis = [0, 0, 2]\nstiffness = 3\n\
                  limits = { to = 1, stiffness = 50 }\n";
    let exchanged = &dbd_scene::interactions(&scene("", ground).unwrap())[0];
    assert!(exchanged.bodies[0].is_world() && exchanged.axis == Some([0.0, 0.0, -1.0]));
    // A rope: without a lower end.
    scene("", &springs(["limits = { to = 1, stiffness = 50 }", ""])).unwrap();
    for (springs, parts) in [
        (springs(["limits = { to = 1, offset = 0.1, stiffness = 1 }", ""]), ["offset", "`from`"]),
        (springs(["limits = { stiffness = 1 }", ""]), ["limits nothing", "both"]),
        (springs(["", "limits = { to = \"1 mm\", stiffness = 1 }"]), ["`to`", "rad"]),
        (springs(["", "limits = { to = 1 }"]), ["stiffness", "N·m/rad"]),
    ] {
        let said = scene("", &springs).err().unwrap_or_default();
        assert!(parts.iter().all(|part| said.contains(part)), "{springs}: {said}");
    }
}

/// The ground may come second: signs are those of the joint.
#[test]
fn the_ground_may_be_the_second_body() {
    let text = |between: &str, speed: f64| {
        format!(
            "name = \"g\"\nduration = 1\n[[body]]\nname = \"disc\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n\
             position = [0, 0, 0]\nangular_velocity = [0, 0, {speed}]\n[[joint]]\nname = \"pivot\"\n\
             type = \"revolute\"\nbetween = {between}\nat = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\n\
             stiffness = 1e6\nlimits = {{ to = 0.1, stiffness = 100 }}\n"
        )
    };
    let rate = |between: &str, speed: f64| {
        let model = Scene::parse(&text(between, speed), "g.toml").unwrap().model;
        let mut plant = Plant::new(&model, Leapfrog, 1e-5).unwrap();
        plant.advance(20_000).unwrap();
        plant.state().bodies[0].angular_velocity.z
    };
    // The second body beside the first: the ground turns by +0.1 where the disc turns by -0.1.
    for (between, speed, comes_back) in [
        ("[\"world\", \"disc\"]", 2.0, true),
        ("[\"world\", \"disc\"]", -2.0, false),
        ("[\"disc\", \"world\"]", 2.0, false),
        ("[\"disc\", \"world\"]", -2.0, true),
    ] {
        let found = rate(between, speed);
        let expected = if comes_back { -speed } else { speed };
        assert!((found - expected).abs() < 2e-2, "{between} {speed}: {found}");
    }
}

/// An offset moves both ends; a cylindrical joint has limits of both motions.
#[test]
fn offsets_and_cylindrical_joints() {
    let text = |keys: &str| {
        format!(
            "name = \"c\"\nduration = 1\n[[body]]\nname = \"rod\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n\
             position = [0, 0, 0]\nvelocity = [0, 0, 1]\nangular_velocity = [0, 0, 5]\n[[joint]]\nname = \"bush\"\n\
             type = \"cylindrical\"\nbetween = [\"world\", \"rod\"]\nat = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\n\
             offset = 0.02\nstiffness = 1e6\n{keys}"
        )
    };
    let end = |keys: &str, steps: u64| {
        let model = Scene::parse(&text(keys), "c.toml").unwrap().model;
        let mut plant = Plant::new(&model, Leapfrog, 1e-5).unwrap();
        plant.advance(steps).unwrap();
        let body = &plant.state().bodies[0];
        (body.velocity.z, body.angular_velocity.z, energy(&model, plant.state(), 1e-5).total())
    };
    let none = "";
    let slide = "slide_limits = { from = 0, to = 0.25, offset = 0.05, stiffness = 1e5 }";
    let turn = "turn_limits = { to = \"90 deg\", offset = \"20 deg\", stiffness = 500 }";
    let both = format!("{slide}\n{turn}");
    for (keys, [v, w]) in [
        (none, [1.0, 5.0]),
        (slide, [-1.0, 5.0]),
        (turn, [1.0, -5.0]),
        (both.as_str(), [-1.0, -5.0]),
    ] {
        let found = end(keys, 30_000);
        assert!((found.0 - v).abs() < 1e-2 && (found.1 - w).abs() < 5e-2, "{keys}: {found:?}");
        assert!((found.2 - 0.625).abs() < 1e-4, "{keys}: {found:?}");
    }
    // They stop after 0.25 s and 0.05 s, and by then what rings on their give has died.
    let rubbing = end("slide_friction = { coulomb = 4 }\nturn_friction = { coulomb = 1 }", 60_000);
    assert!(rubbing.0.abs() < 1e-9 && rubbing.1.abs() < 1e-9, "{rubbing:?}");
}

/// A speed after an impact that is the given share of the speed before it.
#[test]
fn restitution_is_that_of_the_impact() {
    for restitution in [0.95, 0.7, 0.3, 0.1] {
        let text = format!(
            "name = \"r\"\nduration = 1\n[[body]]\nname = \"sled\"\nmass = 3\ninertia = [0.01, 0.01, 0.01]\n\
             position = [0, 0, 0]\nvelocity = [2, 0, 0]\n[[joint]]\nname = \"rail\"\ntype = \"translational\"\n\
             between = [\"world\", \"sled\"]\nat = [0, 0, 0]\naxis = [1, 0, 0]\nspan = 0.1\ngauge = 0.05\n\
             offset = 0.02\nstiffness = 1e6\nlimits = {{ to = 0.01, stiffness = 1e5, restitution = {restitution}, \
             speed = 2 }}\n"
        );
        let model = Scene::parse(&text, "r.toml").unwrap().model;
        let mut plant = Plant::new(&model, Leapfrog, 1e-5).unwrap();
        plant.advance(20_000).unwrap();
        let found = plant.state().bodies[0].velocity.x / -2.0;
        assert!((found - restitution).abs() < 2e-3, "{restitution}: {found}");
    }
}

#[test]
fn bad_limits_are_refused_with_place_reason_and_remedy() {
    for (slide, turn, says) in [
        ("limits = { stiffness = 1 }", "", ["limits nothing", "`from`, `to` or both"]),
        ("limits = { from = 1, to = 0, stiffness = 1 }", "", ["`to`", "is not above `from`"]),
        ("limits = { to = 1 }", "", ["has no `stiffness`", "N/m"]),
        ("limits = { to = 1, stiffness = -1 }", "", ["stiffness", "a stiffness > 0"]),
        (
            "limits = { to = 1, stiffness = 1, speed = 1 }",
            "",
            ["requires `restitution`", "dissipation"],
        ),
        ("limits = { to = 1, stiffness = 1, restitution = 0.5 }", "", ["has no `speed`", "m/s"]),
        (
            "limits = { to = 1, stiffness = 1, restitution = 1.5, speed = 1 }",
            "",
            ["is not a valid coefficient of restitution", "(0, 1]"],
        ),
        (
            "limits = { to = 1, stiffness = 1, restitution = 0.5, speed = 1, dissipation = 1 }",
            "",
            ["contradicts `restitution`", "give only one"],
        ),
        ("limits = { to = 1, stiffness = 1, ratio = 1 }", "", ["has no key `ratio`", "`from`"]),
        ("limits = 3", "", ["is an integer", "{ from = …"]),
        ("turn_limits = { to = 1, stiffness = 1 }", "", ["has no key `turn_limits`", "`limits`"]),
        ("", "limits = { to = \"1 mm\", stiffness = 1 }", ["`to`", "rad"]),
        ("", "friction = { breakaway = 1 }", ["has no `coulomb`", "N·m"]),
        ("", "friction = { coulomb = 2, breakaway = 1 }", ["`breakaway`", "at least as large"]),
        (
            "",
            "friction = { coulomb = 0 }",
            ["`friction` of joint `pivot` is too small", "a number > 0"],
        ),
        ("", "friction = { coulomb = 1, load = 0.1 }", ["`load`", "{ mu = …, radius = … }"]),
        ("", "friction = { coulomb = 1, load = { mu = 0.1 } }", ["has no `radius`", "m"]),
        ("", "friction = { coulomb = 1, load = { radius = 0.1 } }", ["has no `mu`", "≥ 0"]),
        ("", "friction = { coulomb = 1, load = { mu = -0.1, radius = 1 } }", ["`mu`", "≥ 0"]),
        ("", "friction = { coulomb = 1, load = { mu = 1, radius = -1 } }", ["`radius`", "≥ 0"]),
        ("", "friction = { load = { mu = 1, radius = 1 } }", ["has no `coulomb`", "N·m"]),
        (
            "friction = { coulomb = 1, load = { mu = 1, radius = 1 } }",
            "",
            ["no key `radius`", "mu"],
        ),
        ("friction = { coulomb = 0, load = { mu = 1 } }", "", ["too small", "a number > 0"]),
        (
            "",
            "friction = { coulomb = 1 }\n[[tsda]]\nname = \"pivot.friction\"\nbetween = [\"world\", \"lever\"]\n\
             points = [[1, 0, 0], [0, 0, 0]]\nfree_length = 1\nstiffness = 1",
            ["pivot.friction", "must be unique"],
        ),
    ] {
        let text = scene(slide, turn).unwrap_err();
        let flat: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in says {
            assert!(flat.contains(words), "{slide}{turn}: {words} not in {text}");
        }
    }
}

/// `load` names the law with a load; an interaction names it, and its joint.
#[test]
fn friction_with_a_load_is_a_law() {
    let with = |slide: &str, turn: &str| {
        let of = |load: &str| format!("friction = {{ coulomb = 2{load} }}");
        scene(&of(slide), &of(turn)).unwrap_or_else(|said| panic!("{said}"))
    };
    let laws = |scene: &Scene| dbd_scene::interactions(scene).iter().map(|law| law.law).collect();
    let loaded: Vec<_> =
        laws(&with(", load = { mu = 0.1 }", ", load = { mu = 0.1, radius = 0.01 }"));
    assert_eq!(loaded, ["slide-friction-load", "hinge-friction-load"]);
    let free: Vec<_> = laws(&with("", ""));
    assert_eq!(free, ["slide-friction", "hinge-friction"]);
    let own = |joint: &str| {
        scene(
            "",
            &format!(
                "[[interaction]]\nlaw = \"hinge-friction-load\"\nbetween = [\"slider\", \"lever\"]\n\
                 axis = [0, 0, 1]\njoint = {joint}\nmu = 0.1\nradius = 0.01\ncoulomb = 1\nbreakaway = 1"
            ),
        )
    };
    own("\"pivot\"").unwrap();
    for (joint, parts) in [
        ("\"pivto\"", ["names no joint", "did you mean"]),
        ("3", ["`joint`", "the name of a joint"]),
    ] {
        let said = own(joint).err().unwrap_or_default();
        assert!(parts.iter().all(|part| said.contains(part)), "{joint}: {said}");
    }
}

/// `soft` above 0 names the soft law, 0 the hard one; an interaction names it itself.
#[test]
fn soft_limits_are_laws_of_their_own() {
    let laws = |soft: &str| {
        let limits = format!("limits = {{ to = 1, stiffness = 50{soft} }}");
        let strut = format!(
            "[[tsda]]\nname = \"strut\"\nbetween = [\"lever\", \"world\"]\npoints = [[0, 0.1, 0], [0.5, 0, 0]]\n\
             stiffness = 100\nfree_length = \"initial\"\n{limits}\n[[torsion_spring]]\nbetween = [\"world\", \"lever\"]\n\
             axis = [0, 0, 2]\nstiffness = 3\n{limits}\n"
        );
        let scene = scene(&limits, &strut).unwrap_or_else(|said| panic!("{said}"));
        dbd_scene::interactions(&scene).iter().map(|law| law.law).collect::<Vec<_>>()
    };
    let soft = laws(", soft = 0.01");
    assert!(soft.iter().all(|law| law.starts_with("soft-")), "{soft:?}");
    let hard: Vec<_> = soft.iter().filter_map(|law| law.strip_prefix("soft-")).collect();
    assert_eq!([laws(""), laws(", soft = 0")], [hard.clone(), hard]);
    let stop = |law: &str, soft: &str| {
        format!(
            "[[interaction]]\nlaw = \"{law}\"\nbetween = [\"world\", \"slider\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
             normal = [1, 0, 0]\nstiffness = 1e5\n{soft}\n"
        )
    };
    scene("", &stop("soft-end-stop", "soft = \"1 mm\"")).unwrap();
    for (text, parts) in [
        (stop("end-stop", "soft = 1"), ["`soft`", "soft-end-stop"]),
        (stop("soft-end-stop", "soft = 0"), ["is not positive", "> 0"]),
        (stop("soft-end-stop", ""), ["has no `soft`", "m"]),
        (stop("soft-end-stop", "soft = \"1 deg\""), ["`soft`", "m"]),
    ] {
        let said = scene("", &text).err().unwrap_or_default();
        assert!(parts.iter().all(|part| said.contains(part)), "{text}: {said}");
    }
}
