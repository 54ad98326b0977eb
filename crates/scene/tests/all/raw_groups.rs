//! Raw TSDAs that write joints out: one group with the joint's bits; what stays apart.

use dbd_kernel::model::Law;
use dbd_scene::Scene;

/// Three bodies and joints or TSDAs between them.
fn scene(more: &str) -> Scene {
    let body = |name: &str, x: f64, turn: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.01, 0.02, 0.03]\nposition = [{x:?}, 0.1, 0]\n{turn}\n"
        )
    };
    let text = format!(
        "name = \"lists\"\nduration = 1\nstep = \"100 us\"\ngravity = [0, -9.81, 0]\n{}{}{}{more}",
        body(
            "one",
            0.1,
            "orientation = { quaternion = [0.8, 0, 0, 0.6] }\nangular_velocity = [0.1, 0.2, 0.3]"
        ),
        body("two", 0.4, ""),
        body("rod", 2.0, ""),
    );
    Scene::parse(&text, "lists.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn joints(damping: &str) -> Scene {
    let joint = |name: &str, kind: &str, between: &str, keys: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"{kind}\"\nbetween = {between}\nstiffness = 1e5\n{damping}{keys}\n"
        )
    };
    let hinge = "at = [0.2, 0.1, 0]\naxis = [0, 0, 1]\nspan = 0.1";
    scene(
        &(joint("hinge", "revolute", "[\"world\", \"one\"]", hinge)
            + &joint("elbow", "revolute", "[\"one\", \"two\"]", &hinge.replace("0.2", "0.3"))
            + &joint("ball", "spherical", "[\"two\", \"rod\"]", "at = [1, 0, 0]\narm = 0.05")),
    )
}

/// Its TSDAs as tables, in the model's order.
fn tables(scene: &Scene, keys: &str) -> Vec<String> {
    let model = &scene.model;
    let name = |row: usize| scene.body_names.get(row).map_or("world", String::as_str);
    let mut tables = Vec::new();
    for group in &model.groups {
        let [triples, arms] = [group.triples, group.arms].map(usize::from);
        for i in 0..triples * arms {
            let tip = triples + if group.shared { i % arms } else { i };
            let [centre, tip] = [i / arms, tip].map(|point| {
                let point = model.points[usize::from(group.point) + point].to_f64();
                format!("{point:?}")
            });
            let tsda = &model.tsdas[usize::from(group.element) + i];
            let [a, b] = [group.a, group.b].map(|body| name(body.row()));
            tables.push(format!(
                "[[tsda]]\nbetween = [\"{a}\", \"{b}\"]\npoints = [{centre}, {tip}]\nstiffness = {:?}\n\
                 free_length = {:?}\n{keys}\n",
                tsda.stiffness, tsda.free_length
            ));
        }
    }
    tables
}

fn shapes(scene: &Scene) -> Vec<(usize, usize)> {
    let groups = scene.model.groups.iter().filter(|group| group.law == Law::Tsda);
    groups.map(|group| (group.triples.into(), group.arms.into())).collect()
}

#[test]
fn joints_written_out_are_the_joints() {
    for damping in ["", "damping = 3\n"] {
        let joints = joints(damping);
        let raw = scene(&tables(&joints, damping).concat());
        assert_eq!(raw.model, joints.model);
        let names =
            ["tsda 1 to 6 (world–one)", "tsda 7 to 12 (one–two)", "tsda 13 to 15 (two–rod)"];
        assert_eq!(raw.raw_names(), names);
        assert_eq!(
            raw.line_of_element(1),
            raw.line_of_element(0).map(|line| line + 36 + 6 * usize::from(!damping.is_empty()))
        );
    }
}

/// In another order, with the bodies the other way round, with free lengths that were computed from the points.
#[test]
fn the_order_of_a_list_does_not_matter() {
    let joints = joints("");
    let tables = tables(&joints, "");
    let mut mixed = [5, 0, 3, 1, 4, 2].map(|row| tables[row].clone());
    mixed[1] = turned(&mixed[1]);
    mixed[4] = turned(&mixed[4]);
    mixed[2] = mixed[2]
        .lines()
        .map(|line| {
            let line =
                if line.starts_with("free_length") { "free_length = \"initial\"" } else { line };
            format!("{line}\n")
        })
        .collect();
    let raw = scene(&(mixed.concat() + &tables[6..].concat()));
    assert_eq!(shapes(&raw), [(2, 3), (2, 3), (1, 3)]);
    // The first table has the bodies the other way round: the centres stay on the ground.
    let all: String = tables.iter().map(|table| turned(table)).collect();
    assert_eq!(scene(&all).model, joints.model);
}

/// A table with its bodies the other way round.
fn turned(table: &str) -> String {
    let turn = |line: &str| {
        let (key, value) = line.split_once(" = ").unwrap_or((line, ""));
        let inner = value.trim_start_matches('[').trim_end_matches(']');
        match key {
            "between" => {
                let (a, b) = inner.split_once(", ").unwrap();
                format!("between = [{b}, {a}]\n")
            }
            "points" => {
                let (a, b) = inner.split_once("], [").unwrap();
                format!("points = [[{b}], [{a}]]\n")
            }
            _ => format!("{line}\n"),
        }
    };
    table.lines().map(turn).collect()
}

#[test]
fn what_is_not_alike_stays_apart() {
    let joints = joints("");
    let all = tables(&joints, "");
    let six = &all[..6];
    let count = |tables: &[String]| scene(&tables.concat()).model.groups.len();
    assert_eq!(count(six), 1);
    // Without one of the six, or with a point of its own, the first three are still the triple of a ball joint.
    assert_eq!(count(&six[..5]), 3);
    for (row, from, to, groups) in [
        (0, "[[tsda]]", "[[tsda]]\nname = \"leg\"", 4),
        (0, "stiffness = 100000.0", "stiffness = 100001.0", 4),
        (5, "stiffness = 100000.0", "stiffness = 100000.0\ndamping = 1", 4),
        (5, "free_length = ", "free_length = 1", 4),
        (5, "points = [[", "points = [[1", 4),
        (5, "[[tsda]]", "[[tsda]]\nlimits = { from = 0, to = 1, stiffness = 1 }", 4),
        (5, "\"one\"", "\"two\"", 4),
    ] {
        let mut tables = six.to_vec();
        tables[row] = tables[row].replacen(from, to, 1);
        assert_ne!(tables[row], six[row]);
        assert_eq!(count(&tables), groups, "{}", tables[row]);
    }
    // A TSDA between other bodies comes between.
    let between = [&six[..3], &all[12..13], &six[3..]].concat();
    assert_eq!(shapes(&scene(&between.concat())), [(1, 3), (1, 1), (1, 3)]);
}

#[test]
fn two_triples_with_endpoints_of_their_own_are_two_groups() {
    let joints = joints("");
    let all = tables(&joints, "");
    let moved = all[3..6].iter().map(|table| table.replacen(", 0.0]]", ", 0.01]]", 1));
    let raw = scene(&(all[..3].concat() + &moved.collect::<String>()));
    assert_eq!(shapes(&raw), [(1, 3), (1, 3)]);
}

#[test]
fn two_from_a_point_are_a_joint_of_the_plane() {
    let leg = |tip: &str, more: &str| {
        format!(
            "[[tsda]]\nbetween = [\"world\", \"one\"]\npoints = [[0.2, 0.1, 0], {tip}]\nstiffness = 1e5\n\
             free_length = 0.1\n{more}"
        )
    };
    let flat = "planar = true\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
    let text = |legs: String| {
        let text = format!("name = \"flat\"\nduration = 1\n{flat}{legs}");
        Scene::parse(&text.replace("\"one\"", "\"b\""), "flat.toml").unwrap()
    };
    let (first, second) = (leg("[0.3, 0.1, 0]", ""), leg("[0.2, 0.2, 0]", ""));
    let pair = text(first.clone() + &second);
    assert_eq!(shapes(&pair), [(1, 2)]);
    let reduced = pair.planar.as_ref().unwrap();
    let group = reduced.model.groups[0];
    assert_eq!((reduced.model.groups.len(), group.triples, group.arms), (1, 1, 2));
    let apart = text(first + &leg("[0.2, 0.2, 0]", "name = \"second\"\n"));
    assert_eq!(shapes(&apart), [(1, 1), (1, 1)]);
    // A list that is planar but not said to be has its groups one by one in the plane, too.
    let three = leg("[0.3, 0.1, 0]", "") + &leg("[0.2, 0.2, 0]", "") + &leg("[0.1, 0.1, 0]", "");
    let spatial = text(three).with("planar=false").unwrap();
    assert_eq!(shapes(&spatial), [(1, 3)]);
    let reduced = dbd_scene::reduction::reduced(&spatial).unwrap();
    let group = reduced.model.groups[0];
    assert_eq!((reduced.model.groups.len(), group.triples, group.arms), (1, 1, 3));
}
