//! Values with units and names: what scenes come to, and what is refused where.

use dbd_scene::quantity::evaluate;
use dbd_scene::{Scene, SceneError, Severity};

const HEAD: &str = "name = \"q\"\n";

/// A body on a spring, every value of it replaceable: `{KEY}` of each is what stands behind `KEY =`.
fn text(parameters: &str, changes: &[(&str, &str)]) -> String {
    let mut text = format!("{HEAD}{parameters}");
    for (table, keys) in [
        ("", &[("duration", "1"), ("step", "1e-3"), ("gravity", "[0, -9.81, 0]")][..]),
        (
            "[[body]]\nname = \"b\"\n",
            &[
                ("mass", "2"),
                ("inertia", "[1, 1, 1]"),
                ("position", "[0.5, 0, 0]"),
                ("orientation", "{ axis = [0, 0, 1], angle = 0.5 }"),
                ("velocity", "[0, 0, 0]"),
                ("angular_velocity", "[0, 0, 1]"),
            ],
        ),
        (
            "[[joint]]\nname = \"j\"\ntype = \"spherical\"\nbetween = [\"world\", \"b\"]\n",
            &[("at", "[0, 0, 0]"), ("stiffness", "9e6"), ("arm", "0.03"), ("damping", "10")],
        ),
        (
            "[[torsion_spring]]\nbetween = [\"world\", \"b\"]\naxis = [0, 0, 1]\n",
            &[("stiffness ", "50"), ("preload", "0")],
        ),
        (
            "[[input]]\nname = \"i\"\ntype = \"force\"\nbody = \"b\"\naxis = [1, 0, 0]\n",
            &[("table", "[[0, 0], [0.1, 5]]")],
        ),
    ] {
        text += table;
        for (key, value) in keys {
            let changed = changes.iter().find(|(changed, _)| changed == key);
            text += &format!("{key} = {}\n", changed.map_or(*value, |(_, value)| *value));
        }
    }
    text
}

fn scene(parameters: &str, changes: &[(&str, &str)]) -> Scene {
    let text = text(parameters, changes);
    Scene::parse(&text, "q.toml").unwrap_or_else(|e| panic!("{e} ({}): {text}", e.help()))
}

fn refused(parameters: &str, changes: &[(&str, &str)]) -> SceneError {
    let text = text(parameters, changes);
    match Scene::parse(&text, "q.toml") {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => error,
    }
}

#[test]
fn texts_give_the_bits_of_plain_numbers() {
    let plain = scene("", &[("angular_velocity", "[0, 0, 12.566370614359172]")]);
    let parameters = "parameters.width = \"25 cm\"\nparameters.k = 9e6\n\
                      parameters.stiff = \"2 * soft\"\nparameters.soft = \"25 Nm/rad\"\n";
    let written = scene(
        parameters,
        &[
            ("duration", "\"1 s\""),
            ("step", "\"1ms\""),
            ("gravity", "[0, \"-9.81 m/s^2\", 0]"),
            ("mass", "\"2000 g\""),
            ("inertia", "[\"1 kg·m²\", '10000 kg*cm^2', \"\"\"1\"\"\"]"),
            ("position", "[\"2 * width\", 0, \"width - 250 mm\"]"),
            ("orientation", "{ axis = [0, 0, \"1\"], angle = \"0.5 rad\" }"),
            ("angular_velocity", "[0, 0, \"2 turn/s\"]"),
            ("stiffness", "\"k\""),
            ("arm", "\"3 cm\""),
            ("damping", "\"0.01 N/(mm/s)\""),
            ("stiffness ", "\"stiff\""),
            ("table", "[[0, 0], [\"100 ms\", \"5e-3 kN\"]]"),
        ],
    );
    assert_eq!(written.model, plain.model);
    assert_eq!((written.duration, written.step), (plain.duration, plain.step));
    let reported: Vec<_> =
        written.parameters.iter().map(|p| (p.name.as_str(), p.value, p.unit.as_str())).collect();
    let expected = [
        ("width", 0.25, "m"),
        ("k", 9e6, ""),
        ("stiff", 50.0, "N·m/rad"),
        ("soft", 25.0, "N·m/rad"),
    ];
    assert_eq!(reported, expected);
    assert!(plain.parameters.is_empty());
}

#[test]
fn an_angle_in_degrees_is_that_in_radians() {
    let of = |angle: &str| {
        let form = format!("{{ axis = [0, 0, 1], angle = {angle} }}");
        scene("", &[("orientation", &form)]).model.initial[0].orientation
    };
    assert_eq!(of("\"30 deg\""), of(&format!("{:?}", 30.0_f64.to_radians())));
    let along = |axis: &str| {
        scene("", &[("orientation", &format!("{{ axis = {axis}, angle = 1 }}"))]).model.initial[0]
    };
    assert_eq!(along("[0, \"3 mm\", \"4 mm\"]"), along("[0, 3e-3, 4e-3]"));
    assert_eq!(of("\"1/4 * turn\""), of("\"90°\""));
}

#[test]
fn what_is_wrong_is_marked_within_the_text() {
    // The value of a key, where the fault begins in it from 0, what is wrong, what would be right.
    for (key, value, at, message, help) in [
        ("mass", "\"5 mm\"", 0, "`mass` of body `b` is \"5 mm\", a value in m", "> 0 in kg"),
        ("mass", "\"L\"", 0, "`mass` of body `b` is \"L\", a value in m", "> 0 in kg"),
        ("mass", "\"-2 kg\"", 0, "is \"-2 kg\", which is -2.0", "> 0 in kg"),
        ("mass", "\"2 * (3 kgg)\"", 8, "`mass` of body `b`: `kgg` is neither", "`kg`?"),
        (
            "mass",
            "\"2 + 3 kg\"",
            1,
            "mismatched units: a plain number and a value in kg",
            "\"5 kg\"",
        ),
        ("mass", "'2 * k'", 5, "`k` is neither a unit nor", "known parameters: L"),
        ("mass", "\"\"\"\n 2 xg\"\"\"", 0, "`xg` is neither", "`kg`"),
        // Written otherwise than it reads: the whole is marked.
        ("mass", "\"2 \\u006bk\"", 0, "`kk` is neither", "kg"),
        ("mass", "\"\"", 0, "empty value", "kg"),
        ("arm", "\"1/2 cm\"", 1, "`1/2 cm` is ambiguous", "1/2 * cm"),
        ("arm", "\"3 / 0\"", 5, "division by 0", "another divisor"),
        ("arm", "\"1e300 * 1e300\"", 1, "too large", "1.8e308"),
        ("position", "[0, \"2 * Lx\", 0]", 9, "`position`[1] of body `b`: `Lx`", "`L`?"),
        ("stiffness ", "\"50 N*m\"", 0, "a value in N·m", "divide by `rad`"),
        (
            "angular_velocity",
            "[0, 0, \"3 Hz\"]",
            7,
            "a value in 1/s",
            "multiply by `rad`, or by `turn`",
        ),
        ("velocity", "[0, \"3 rad/s * L\", 0]", 4, "a value in m·rad/s", "divide by `rad`"),
        (
            "orientation",
            "{ axis = [0, 1, \"1 m\"], angle = 0 }",
            16,
            "is a value in m, but others are a plain number",
            "have one dimension",
        ),
        (
            "orientation",
            "{ quaternion = [1, 0, 0, \"1 m\"] }",
            25,
            "a value in m",
            "without a unit",
        ),
        ("table", "[[\"1 kg\", 0]]", 2, "a value in kg", "in s"),
        ("table", "[[0, \"1 kg\"]]", 5, "a value in kg", "in N"),
        ("gravity", "[0, \"9.81 g\", 0]", 4, "a value in kg", "in m/s²"),
    ] {
        let error = refused("parameters = { L = \"1 m\" }\n", &[(key, value)]);
        assert!(error.message().contains(message), "{value}: {error}");
        assert!(error.help().contains(help), "{value}: {}", error.help());
        let (line, column) = error.line().zip(error.column()).unwrap();
        let text = text("parameters = { L = \"1 m\" }\n", &[(key, value)]);
        if value.contains('\n') {
            assert_eq!((text.lines().nth(line - 1), column), (Some(" 2 xg\"\"\""), 4));
            continue;
        }
        let own = text.lines().nth(line - 1).unwrap();
        assert!(own.starts_with(key), "{value}: {own}");
        assert_eq!(column, key.chars().count() + 4 + at, "{value}: {error}");
    }
}

#[test]
fn parameters_are_refused_where_they_stand() {
    for (parameters, place, message, help) in [
        ("a = 1\nm = 2", (3, 1), "`m` of [parameters] has the name of a unit", "`m_1`"),
        ("pi = 3", (2, 1), "is reserved for the number π", "another name"),
        ("\"a b\" = 3", (2, 1), "is not a valid parameter name", "letters, digits"),
        ("a-b = 3", (2, 1), "is not a valid parameter name", "letters, digits"),
        ("2a = 3", (2, 1), "is not a valid parameter name", "letters, digits"),
        ("a = true", (2, 5), "`a` of [parameters] is a boolean", "2 * L + 5 mm"),
        ("a = [1, 2]", (2, 5), "is an array", "a finite number"),
        ("a.b = 1", (2, 1), "is a table", "a finite number"),
        ("a = nan", (2, 5), "is nan", "a finite number"),
        ("a = 1e999", (2, 5), "is 1e999", "a finite number"),
        ("a = \"b / c\"\nb = 1\nc = 0", (2, 10), "division by 0", "another divisor"),
        ("a = \"2 * bb\"\nb = 1", (2, 10), "`bb` is neither", "did you mean `b`?"),
        ("a = \"a\"", (2, 5), "is part of a cycle: `a` needs `a`", "does not depend on the others"),
        (
            "a = 1\nb = \"a + c\"\nc = \"2 * d\"\nd = \"c - a\"\ne = \"b\"",
            (4, 5),
            "`c` of [parameters] is part of a cycle: `c` needs `d` needs `c`",
            "depend on the others",
        ),
        ("a = 1\na = 2", (3, 1), "duplicate key", "once"),
    ] {
        // At the end, where the table's own lines are counted from its head.
        let text = format!("{}[parameters]\n{parameters}\n", text("", &[]));
        let head = text.matches('\n').count() - parameters.matches('\n').count() - 2;
        let error = Scene::parse(&text, "q.toml").unwrap_err();
        assert!(error.message().contains(message), "{parameters}: {error}");
        assert!(error.help().contains(help), "{parameters}: {}", error.help());
        let found = error.line().zip(error.column()).unwrap();
        assert_eq!((found.0 - head, found.1), place, "{parameters}: {error}");
    }
    for (parameters, message) in [
        ("parameters = 3\n", "`parameters` of the scene is an integer"),
        ("parameters = [{ a = 1 }]\n", "`parameters` of the scene is an array"),
    ] {
        let error = refused(parameters, &[]);
        assert!(error.message().contains(message), "{error}");
        assert!(error.help().contains("a table of names and their values"), "{}", error.help());
    }
}

/// A chain of names as long as a scene may hold it, in the worst order; and a circle of it.
#[test]
fn long_chains_of_names_are_followed_to_their_end() {
    let names = 3_000;
    let row = |i: usize| format!("p{i} = \"p{} + 1\"\n", i + 1);
    let rows: String = (0..names).map(row).collect();
    let chain = format!("{}[parameters]\n{rows}", text("", &[("mass", "\"p0\"")]));
    let scene = Scene::parse(&format!("{chain}p{names} = 1\n"), "q.toml").unwrap();
    assert_eq!(scene.model.bodies[0].mass, names as f64 + 1.0);
    let error = Scene::parse(&format!("{chain}p{names} = \"p7\"\n"), "q.toml").unwrap_err();
    assert!(error.message().contains("`p7` needs `p8`"), "{error}");
    assert!(error.message().ends_with("needs … needs `p7`"), "{error}");
}

#[test]
fn what_no_value_names_is_warned_of() {
    let named = |parameters: &str, changes: &[(&str, &str)]| -> Vec<String> {
        let scene = scene(parameters, changes);
        let unused = dbd_scene::warnings(&scene)
            .into_iter()
            .filter(|warning| warning.name.contains("param"));
        unused
            .inspect(|warning| assert_eq!(warning.severity, Severity::Warning))
            .map(|warning| warning.to_string())
            .collect()
    };
    let parameters = "parameters.a = 1\nparameters.b = \"a\"\nparameters.c = \"2 kg\"\n";
    let said = named(parameters, &[("mass", "\"c\"")]);
    assert_eq!(said.len(), 1);
    assert!(said[0].starts_with("parameter `b` (line 3): is unused: no value"), "{said:?}");
    assert_eq!(named(parameters, &[("mass", "\"c * b\"")]), [""; 0]);
}

#[test]
fn parameters_and_values_are_changed_by_path() {
    let file = text(
        "parameters = { L = \"300 mm\", k = 9e6, m_b = \"2 kg\" }\n",
        &[("position", "[\"L + 5 mm\", 0, 0]"), ("stiffness", "\"k\""), ("mass", "\"m_b\"")],
    );
    let with = |changes: &[&str]| Scene::parse_with(&file, "q.toml", changes);
    let scene = with(&[
        "parameters.L=0.4",
        "parameters.k=9 kN/mm / 2",
        "body.b.angular_velocity=[0, 0, \"60 rpm\"]",
        "parameters.m_*=3000 g",
        "joint.*.arm=2 * L / 20",
        "joint.j.damping=(1 + 2) * 5 N*s/m",
        "step=2 * 20us",
    ])
    .unwrap_or_else(|error| panic!("{error} ({})", error.help()));
    let body = &scene.model.initial[0];
    assert_eq!(body.position.x, 0.405);
    assert!((body.angular_velocity.z - core::f64::consts::TAU).abs() < 1e-15);
    assert_eq!((scene.model.bodies[0].mass, scene.step), (3.0, Some(4e-5)));
    assert_eq!((scene.model.tsdas[0].stiffness, scene.model.dampers[0]), (4.5e6, 15.0));
    let reported: Vec<_> = scene.parameters.iter().map(|p| (p.value, p.unit.as_str())).collect();
    assert_eq!(reported, [(0.4, "m"), (4.5e6, "N/m"), (3.0, "kg")]);
    let changed = &scene.changed[0];
    assert_eq!(
        (changed.path.as_str(), changed.before.as_deref(), changed.now.as_str()),
        ("parameters.L", Some("\"300 mm\""), "0.4")
    );
    for (change, column, message, help) in [
        ("parameters.L=3 kg", 14, "`L` of [parameters] is a value in kg", "in m, as in the file"),
        ("parameters.L=3 kgs", 17, "`kgs` is neither", "`kg`"),
        ("parameters.l_b=3", 1, "no parameter `l_b`", "did you mean `m_b`? known parameters:"),
        ("body.b.mass=2 * L", 13, "is \"2 * L\", a value in m", "> 0 in kg"),
        ("body.b.mass=m_b + 2", 20, "mismatched units: a plain number", "\"5 kg\""),
    ] {
        let error = with(&[change]).unwrap_err();
        assert_eq!((error.file(), error.line()), ("--set", Some(1)), "{change}: {error}");
        assert_eq!(error.column(), Some(column), "{change}: {error}");
        assert!(error.message().contains(message), "{change}: {error}");
        assert!(error.help().contains(help), "{change}: {}", error.help());
    }
    // A fault that a change makes elsewhere is told where it is.
    let error = with(&["parameters.k=3 s"]).unwrap_err();
    assert_eq!(error.file(), "q.toml");
    assert!(error.message().contains("`stiffness` of joint `j` is \"k\", a value in s"), "{error}");
}

/// The section of units in the reference: its table has every unit, each with its dimension, and its
/// equations hold.
#[test]
fn the_page_has_every_unit_and_its_equations_hold() {
    const PAGE: &str = include_str!("../../../../docs/scene-reference.md");
    let section = PAGE.split("\n## ").find(|text| text.starts_with("Values with units")).unwrap();
    let mut units = Vec::new();
    for row in section.lines().filter(|line| line.starts_with("| ") && line.contains('`')) {
        let own: Vec<_> = row.split('`').skip(1).step_by(2).collect();
        let dimension = |unit: &str| evaluate(&format!("1 {unit}")).map(|one| one.dimension);
        assert!(own.iter().all(|unit| dimension(unit) == dimension(own[0])), "{row}");
        units.extend(own);
    }
    // Both letters that look like a small mu.
    let known = dbd_scene::quantity::units().map(|unit| unit.replace('\u{3bc}', "\u{b5}"));
    let mut known: Vec<_> = known.collect();
    known.dedup();
    assert_eq!(units.len(), known.len());
    assert!(known.iter().all(|unit| units.contains(&unit.as_str())), "{known:?}");
    let mut equations = 0;
    let marked: Vec<_> = section.split('`').collect();
    for three in marked.windows(3).filter(|three| three[1].trim() == "=") {
        assert_eq!(evaluate(three[0]), evaluate(three[2]), "{three:?}");
        assert!(evaluate(three[0]).is_ok(), "{three:?}");
        equations += 1;
    }
    assert_eq!(equations, 9);
}

#[test]
fn a_text_without_its_quotes_is_shown_with_them() {
    for value in ["2 kg", "2kg", "2 * L", "L", "-L", "(1 + 2)", "9 kN/mm"] {
        let error = refused("", &[("mass", value)]);
        assert_eq!(error.column(), Some(8), "{value}: {error}");
        assert!(error.help().contains(&format!("in quotes: \"{value}\"")), "{}", error.help());
    }
}
