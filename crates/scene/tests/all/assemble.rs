//! Joints that are open at the given poses, and what `[assemble]` makes of them.

use dbd_scene::{Scene, SceneError};

fn scene(text: &str) -> Scene {
    Scene::parse(text, "a.toml").unwrap_or_else(|error| panic!("{error}\n{}\n{text}", error.help()))
}

fn refused(text: &str) -> SceneError {
    match Scene::parse(text, "a.toml") {
        Ok(_) => panic!("it is taken:\n{text}"),
        Err(error) => error,
    }
}

/// A bar along its x axis, its middle at (x, y), turned by an angle about z.
fn bar(name: &str, [x, y]: [f64; 2], angle: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.01, 0.1, 0.1]\nposition = [{x:?}, {y:?}, 0]\n\
         orientation = {{ axis = [0, 0, 1], angle = {angle:?} }}\n"
    )
}

fn pin(name: &str, between: [&str; 2], at: &str) -> String {
    format!(
        "[[joint]]\nname = \"{name}\"\ntype = \"revolute\"\nbetween = {between:?}\nat = {at}\n\
         axis = [0, 0, 1]\nstiffness = 9e6\nspan = 0.2\n"
    )
}

const HEAD: &str = "name = \"four-bar\"\nduration = 0.5\ngravity = [0, -9.81, 0]\n";

/// A four-bar of a crank of 1 m, a coupler and a rocker of 2.5 m, drawn roughly: the coupler is that of the
/// given length, laid from the crank towards (4, 2.5), where the rocker's end is.
fn four_bar(coupler: f64, assemble: &str) -> String {
    let angle: f64 = 0.4;
    let (x, y) = (0.5 + 0.5 * coupler * angle.cos(), 0.9 + 0.5 * coupler * angle.sin());
    let ends = format!(
        "{{ first = [{:?}, {:?}, 0], second = [4.25, 2.4, 0] }}",
        0.5 + coupler * angle.cos(),
        0.9 + coupler * angle.sin()
    );
    HEAD.to_owned()
        + assemble
        + &bar("crank", [0.25, 0.45], 1.06)
        + &bar("coupler", [x, y], angle)
        + &bar("rocker", [3.875, 1.2], 1.27)
        + &pin("A0", ["world", "crank"], "[0, 0, 0]")
        + &pin("A", ["crank", "coupler"], "[0.5, 0.9, 0]")
        + &pin("B", ["coupler", "rocker"], &ends)
        + &pin("B0", ["world", "rocker"], "[3.5, 0, 0]")
}

#[test]
fn an_open_four_bar_closes_and_says_what_was_moved() {
    let scene = scene(&four_bar(4.0, "[assemble]\n"));
    let assembled = scene.assembled.as_ref().unwrap();
    let names: Vec<_> = assembled.moved.iter().map(|moved| moved.body.as_str()).collect();
    assert_eq!(names, ["crank", "coupler", "rocker"]);
    assert_eq!(assembled.open.len(), 1);
    let open = &assembled.open[0];
    assert!(open.joint == "B" && (0.07..0.09).contains(&open.distance), "{open:?}");
    assert_eq!((assembled.freedoms, assembled.held_twice), (1, 3));
    assert!(dbd_scene::facts(&scene).joints.iter().all(|joint| joint.assembly_error < 1e-14));
    // The distances between the joints are what they were.
    let place = |row: usize| scene.model.initial[row].position;
    for (row, half) in [(0, 0.25_f64.hypot(0.45)), (2, 0.375_f64.hypot(1.2))] {
        let pivot = [0.0, 0.0, 3.5][row];
        let arm = (place(row).x - pivot).hypot(place(row).y);
        assert!((arm - half).abs() < 1e-14, "{arm:e}");
    }
    assert!(place(1).z == 0.0);
    assert!(assembled.moved.iter().all(|moved| moved.distance < 0.08), "{assembled:?}");
}

/// Of all closed poses the nearest: what any motion of the linkage adds to the way from the given poses is
/// of second order.
#[test]
fn the_poses_are_the_nearest_to_the_given_ones() {
    let scene = scene(&four_bar(4.0, "[assemble]\nlength = 0.7\n"));
    let given = [[0.25, 0.45, 1.06], [0.0; 3], [3.875, 1.2, 1.27]];
    let angle: f64 = 0.4;
    let given = [given[0], [0.5 + 2.0 * angle.cos(), 0.9 + 2.0 * angle.sin(), angle], given[2]];
    // The crank turned by φ: where coupler and rocker then are, by circles.
    let [crank, rocker] = [0.5_f64.hypot(0.9), 0.75_f64.hypot(2.4)];
    let start = 0.9_f64.atan2(0.5);
    let way = |phi: f64| {
        let a = [crank * (start + phi).cos(), crank * (start + phi).sin()];
        let [dx, dy] = [3.5 - a[0], -a[1]];
        let d = dx.hypot(dy);
        let along = (16.0 + d * d - rocker * rocker) / (2.0 * d);
        let across = (16.0 - along * along).sqrt();
        let b = [a[0] + (along * dx - across * dy) / d, a[1] + (along * dy + across * dx) / d];
        let coupler = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (b[1] - a[1]).atan2(b[0] - a[0])];
        let turn = (b[1]).atan2(b[0] - 3.5) - 2.4_f64.atan2(0.75);
        let half = [(b[0] - 3.5) / 2.0, b[1] / 2.0];
        let poses =
            [[a[0] / 2.0, a[1] / 2.0, 1.06 + phi], coupler, [3.5 + half[0], half[1], 1.27 + turn]];
        let mut sum = 0.0;
        for (pose, given) in poses.iter().zip(&given) {
            sum += (pose[0] - given[0]).powi(2) + (pose[1] - given[1]).powi(2);
            sum += (0.7 * (pose[2] - given[2])).powi(2);
        }
        (sum, poses)
    };
    // The least by golden section.
    let (mut low, mut high) = (-0.3, 0.3);
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let [a, b] = [high - share * (high - low), low + share * (high - low)];
        if way(a).0 < way(b).0 { high = b } else { low = a }
    }
    let (_, poses) = way(0.5 * (low + high));
    for (state, pose) in scene.model.initial.iter().zip(poses) {
        let gap = (state.position.x - pose[0]).hypot(state.position.y - pose[1]);
        assert!(gap < 1e-7, "{gap:e}");
    }
}

#[test]
fn a_linkage_that_does_not_reach_is_refused_with_the_gap_in_the_open_joint() {
    // The crank's end can be 1.03 m from its pivot, the rocker's 2.51 m from its own, 3.5 m apart.
    let error = refused(&four_bar(8.0, "[assemble]\n"));
    assert_eq!(error.line(), Some(39), "{error}");
    let reach = 0.5_f64.hypot(0.9) + 3.5 + 0.75_f64.hypot(2.4);
    let gap = 8.0 - reach;
    let message = error.message();
    assert!(message.contains("joint `B` stays open by"), "{message}");
    let said = message.split("open by ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    let said: f64 = said.parse().unwrap();
    assert!((said / gap - 1.0).abs() < 0.01, "{said} {gap}");
    assert!(error.help().contains("use other lengths"), "{}", error.help());

    // As long as it may be, and a little less.
    for less in [1e-9, 1e-3] {
        let scene = scene(&four_bar(reach - less, "[assemble]\n"));
        assert!(dbd_scene::facts(&scene).joints.iter().all(|joint| joint.assembly_error < 1e-12));
    }
}

#[test]
fn what_is_fixed_does_not_move() {
    let free = scene(&four_bar(4.0, "[assemble]\n"));
    let held = scene(&four_bar(4.0, "[assemble]\nfixed = [\"crank\"]\n"));
    let crank = held.model.initial[0];
    assert_eq!(crank.position.to_f64(), [0.25, 0.45, 0.0]);
    assert_ne!(crank, free.model.initial[0]);
    let assembled = held.assembled.unwrap();
    assert_eq!((assembled.moved.len(), assembled.freedoms), (2, 0));
    let error = refused(&four_bar(4.0, "[assemble]\nfixed = [\"coupler\", \"rocker\"]\n"));
    assert!(
        error.help().contains("neither `coupler` nor `rocker` may be moved"),
        "{}",
        error.help()
    );
}

#[test]
fn a_scene_that_is_closed_keeps_its_bits() {
    for name in ["four-bar", "3ruu", "crank-slider", "gripper", "double-wishbone", "chain-closed"] {
        let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let plain = scene(&text);
        let at = text.find("[[body]]").unwrap();
        let with = scene(&format!("{}[assemble]\n{}", &text[..at], &text[at..]));
        let assembled = with.assembled.as_ref().unwrap();
        assert!(assembled.moved.is_empty() && assembled.open.is_empty(), "{name}: {assembled:?}");
        assert!(plain.assembled.is_none());
        assert_eq!(plain.model, with.model, "{name}");
    }
}

/// A start at which the linkage lies stretched out, where a motion across closes the gap only to second
/// order.
#[test]
fn a_dead_centre_closes() {
    let text = HEAD.to_owned()
        + "[assemble]\n"
        + &bar("first", [0.5, 0.0], 0.0)
        + &bar("second", [1.5, 0.0], 0.0)
        + &pin("base", ["world", "first"], "[0, 0, 0]")
        + &pin("elbow", ["first", "second"], "[1, 0, 0]")
        + &pin("wrist", ["second", "world"], "{ first = [2, 0, 0], second = [2, 1e-3, 0] }");
    let found = refused(&text);
    // It is told, and how far it is off.
    assert!(found.message().contains("joint `wrist` stays open by"), "{found}");
    // Inwards it closes, though no motion of first order does it.
    let closed = scene(&text.replace("second = [2, 1e-3, 0]", "second = [1.99, 0, 0]"));
    assert!(dbd_scene::facts(&closed).joints.iter().all(|joint| joint.assembly_error < 1e-12));
}

/// A joint of each type between two bodies that lie far off: closed, and what is given with the first
/// half goes with its body.
#[test]
fn every_type_of_joint_closes() {
    let bodies = "[[body]]\nname = \"arm\"\nmass = 2\ninertia = [0.3, 0.2, 0.4]\n\
                  position = [0.5, -1, 0.25]\norientation = { axis = [1, 2, -2], angle = 0.7 }\n\
                  [[body]]\nname = \"hand\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\n\
                  position = [1, 0, 0]\norientation = { euler_321 = [0.3, -0.2, 1.1] }\n";
    let halves = "at = { first = [1, 0.2, 0], second = [1.2, -0.3, 0.4] }\nstiffness = 1e6\n";
    let axis = "axis = { first = [0, 1, 0.1], second = [0.3, 1, -0.5] }\n";
    let reference = "reference = { first = [1, 0, 0.2], second = [1, 0.6, 0] }\n";
    for (kind, keys, holds) in [
        ("spherical", "arm = 0.1".to_owned(), 3),
        ("revolute", format!("{axis}span = 0.1"), 5),
        (
            "universal",
            "axes = [[0, 1, 0], [0.2, 0.5, 1]]\nspan = 0.1\n\
             spider = { mass = 1, inertia = [1, 1, 1] }"
                .to_owned(),
            4,
        ),
        ("cylindrical", format!("{axis}span = 0.3\noffset = 0.05"), 4),
        ("translational", format!("{axis}{reference}span = 0.3\noffset = 0.05\ngauge = 0.2"), 5),
        ("fixed", format!("{axis}{reference}span = 0.3\narm = 0.1"), 6),
    ] {
        let joint = format!(
            "[[joint]]\nname = \"j\"\ntype = \"{kind}\"\nbetween = [\"arm\", \"hand\"]\n{halves}{keys}\n"
        );
        let head = "name = \"two\"\nduration = 1\n[assemble]\n";
        let with = scene(&format!("{head}{bodies}{joint}"));
        let assembled = with.assembled.as_ref().unwrap();
        assert_eq!((assembled.freedoms, assembled.held_twice), (12 - holds, 0), "{kind}");
        assert_eq!((assembled.moved.len(), assembled.open.len()), (2, 1), "{kind}");
        assert!(assembled.iterations < 40, "{kind}: {}", assembled.iterations);
        let error = with.joints[0].assembly_error;
        assert!(error < 1e-15, "{kind}: {error:e}");
        let open = refused(&format!("{}{bodies}{joint}", head.replace("[assemble]\n", "")));
        let said = if kind == "universal" { "degrees apart" } else { "is open by" };
        if kind != "universal" {
            assert!(open.message().contains(said), "{kind}: {open}");
            assert!(open.help().contains("[assemble]"), "{kind}: {}", open.help());
        }
    }
}

/// Bits of an assembled pose: the same on every host.
#[test]
fn an_assembled_pose_has_the_same_bits_everywhere() {
    let scene = scene(&four_bar(4.0, "[assemble]\n"));
    let words = scene.model.initial.iter().flat_map(|state| {
        let words = [state.position.to_f64().to_vec(), state.orientation.to_f64().to_vec()];
        words.concat().into_iter().map(f64::to_bits)
    });
    let hash = words.fold(0xcbf2_9ce4_8422_2325_u64, |hash, word| {
        word.to_le_bytes()
            .iter()
            .fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
    });
    assert_eq!(hash, 0x5a83_c8cb_9dea_bde7, "{hash:#x}");
}

#[test]
fn velocities_are_those_that_the_joints_allow() {
    let with = |rate: f64| {
        scene(&four_bar(
            4.0,
            &format!("[assemble]\nfixed = [\"crank\"]\nrates = {{ A0 = {rate:?} }}\n"),
        ))
    };
    let scene_at = with(3.0);
    let states = &scene_at.model.initial;
    assert_eq!(scene_at.assembled.as_ref().unwrap().set_moving, ["crank", "coupler", "rocker"]);
    assert!((states[0].angular_velocity.z - 3.0).abs() < 1e-14);
    let rates = dbd_scene::facts(&scene_at).joints.into_iter().map(|joint| joint.stretching_rate);
    let largest = rates.fold(0.0, f64::max);
    assert!(largest < 1e-13, "{largest:e}");
    // The second body beside the first: the world beside the rocker turns the other way.
    let text = four_bar(4.0, "[assemble]\nfixed = [\"crank\"]\nrates = { A0 = \"-3 rad/s\" }\n");
    let other = scene(&text.replace("[\"world\", \"crank\"]", "[\"crank\", \"world\"]"));
    assert!((other.model.initial[0].angular_velocity.z - 3.0).abs() < 1e-14);

    // Where the linkage is a little before and after, by the assembly itself.
    const H: f64 = 1e-5;
    let (start, half) = (0.45_f64.atan2(0.25), 0.25_f64.hypot(0.45));
    let at = |t: f64| {
        let (sine, cosine) = (start + 3.0 * t).sin_cos();
        let crank = [states[0].position.x, states[0].position.y];
        assert!((crank[0] - 0.25).abs() < 1e-15 && (crank[1] - 0.45).abs() < 1e-15);
        // The joint A goes with the crank: both are given anew.
        let text = four_bar(4.0, "[assemble]\nfixed = [\"crank\"]\n")
            .replace(
                "position = [0.25, 0.45, 0]",
                &format!("position = [{:?}, {:?}, 0]", half * cosine, half * sine),
            )
            .replace("angle = 1.06", &format!("angle = {:?}", 1.06 + 3.0 * t))
            .replace(
                "at = [0.5, 0.9, 0]",
                &format!(
                    "at = {{ first = [{:?}, {:?}, 0], second = [0.5, 0.9, 0] }}",
                    2.0 * half * cosine,
                    2.0 * half * sine
                ),
            );
        scene(&text).model.initial
    };
    let (before, after) = (at(-H), at(H));
    for row in 0..3 {
        let slope = |of: fn(&dbd_kernel::BodyState<dbd_kernel::F64>) -> f64| {
            (of(&after[row]) - of(&before[row])) / (2.0 * H)
        };
        let [vx, vy] = [slope(|state| state.position.x), slope(|state| state.position.y)];
        let angle = slope(|state| 2.0 * state.orientation.v.z.atan2(state.orientation.w));
        let gap = (vx - states[row].velocity.x).hypot(vy - states[row].velocity.y);
        assert!(
            gap < 1e-8 && (angle - states[row].angular_velocity.z).abs() < 1e-8,
            "{row}: {gap:e}"
        );
    }
}

#[test]
fn a_bodys_own_velocity_is_kept_and_the_others_follow() {
    let text = four_bar(4.0, "[assemble]\n")
        .replace("angle = 1.27 }", "angle = 1.27 }\nangular_velocity = [0, 0, -0.7]");
    let moving = scene(&text);
    assert_eq!(moving.model.initial[2].angular_velocity.to_f64(), [0.0, 0.0, -0.7]);
    assert_eq!(moving.assembled.as_ref().unwrap().set_moving.len(), 3);
    let largest = dbd_scene::facts(&moving)
        .joints
        .iter()
        .map(|joint| joint.stretching_rate)
        .fold(0.0, f64::max);
    assert!(
        largest < 1e-13 && moving.model.initial[0].angular_velocity.z.abs() > 0.1,
        "{largest:e}"
    );

    // One freedom bears one rate, and none across its plane.
    let error = refused(&text.replace("[assemble]\n", "[assemble]\nrates = { A0 = 5 }\n"));
    assert!(error.message().contains("is inconsistent with"), "{error}");
    let error = refused(&text.replace("[0, 0, -0.7]", "[0, 0.1, -0.7]"));
    assert!(error.message().contains("is a motion that the joints prevent"), "{error}");
}

/// A spider turns with both of its bodies, and slides and turns are what they are called.
#[test]
fn joints_of_every_type_move_together() {
    let body = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [{x:?}, 0, 0]\n"
        )
    };
    let text = "name = \"shafts\"\nduration = 1\n[assemble]\n\
                rates = { drive = \"10 rad/s\", ram = { slide = 0.5, turn = 2 }, gate = -3 }\n"
        .to_owned()
        + &body("in", 0.0)
        + &body("out", 1.0)
        + &body("rod", 3.0)
        + &body("door", 4.0)
        + "[[joint]]\nname = \"drive\"\ntype = \"revolute\"\nbetween = [\"world\", \"in\"]\n\
           at = [0, 0, 0]\naxis = [1, 0, 0]\nstiffness = 1e6\nspan = 0.1\n\
           [[joint]]\nname = \"cross\"\ntype = \"universal\"\nbetween = [\"in\", \"out\"]\n\
           at = [0.5, 0, 0]\naxes = [[0, 0.8, 0.6], [0.5, -0.6, 0.8]]\nstiffness = 1e6\nspan = 0.1\n\
           spider = { mass = 1, inertia = [1, 1, 1] }\n\
           [[joint]]\nname = \"bearing\"\ntype = \"revolute\"\nbetween = [\"world\", \"out\"]\n\
           at = [0.5, 0, 0]\naxis = [1, 0.5, 0]\nstiffness = 1e6\nspan = 0.1\n\
           [[joint]]\nname = \"ram\"\ntype = \"cylindrical\"\nbetween = [\"world\", \"rod\"]\n\
           at = [3, 0.2, 0]\naxis = [0, 0, 1]\nstiffness = 1e6\nspan = 0.1\noffset = 0.05\n\
           [[joint]]\nname = \"gate\"\ntype = \"translational\"\nbetween = [\"door\", \"rod\"]\n\
           at = [3.5, 0, 0]\naxis = [0, 1, 0]\nstiffness = 1e6\nspan = 0.1\noffset = 0.05\ngauge = 0.1\n";
    // The second axis of the cross is not normal to the first: the bodies come to where it is.
    let moving = scene(&text);
    let facts = dbd_scene::facts(&moving);
    let largest = facts.joints.iter().map(|joint| joint.stretching_rate).fold(0.0, f64::max);
    assert!(largest < 1e-13, "{largest:e}");
    assert!(facts.joints.iter().all(|joint| joint.assembly_error < 1e-14));
    let states = &moving.model.initial;
    assert_eq!(moving.body_names[4], "cross.spider");
    let spins = [0, 1, 4]
        .map(|row| states[row].orientation.rotation().to_world(states[row].angular_velocity));
    assert!((spins[0].x - 10.0).abs() < 1e-12 && spins[1].x.abs() > 1.0 && spins[2] != spins[0]);
    assert!((states[2].velocity.z - 0.5).abs() < 1e-12);
    let beside = states[2].velocity.y - states[3].velocity.y;
    let turned = states[3].orientation.rotation().to_world(dbd_kernel::Vec3::new(0.0, 1.0, 0.0));
    assert!((turned.y - 1.0).abs() < 1e-12 && (states[3].angular_velocity.z - 2.0).abs() < 1e-12);
    // Both turn alike, by 2 rad/s about z.
    let arm = states[2].position.x - states[3].position.x;
    assert!((beside - 2.0 * arm + 3.0).abs() < 1e-12, "{beside} {arm}");
}

/// By lengths and rough points alone: each link keeps its length and comes to where its ends meet.
#[test]
fn a_four_bar_of_lengths_and_rough_points_assembles() {
    let text = r#"
        name = "four-bar"
        duration = 0.5
        points = { A0 = [0, 0, 0], A = [0.6, 0.7, 0], B0 = [3.5, 0, 0], B = [4, 2, 0] }
        assemble = { rates = { A0 = "2 rad/s" } }
        body = [
            { name = "crank", link = { from = "A0", to = "A", length = 1 }, mass = 1, inertia = [1, 1, 1] },
            { name = "coupler", link = { from = "A", to = "B", length = 4 }, mass = 1, inertia = [1, 1, 1] },
            { name = "rocker", link = { from = "B0", to = "B", length = 2.5 }, mass = 1, inertia = [1, 1, 1] },
        ]
        joint = [
            { name = "A0", between = ["world", "crank"], at = "A0", type = "revolute", axis = [0, 0, 1], stiffness = 9e6, span = 0.2 },
            { name = "A", between = ["crank", "coupler"], at = "A", type = "revolute", axis = [0, 0, 1], stiffness = 9e6, span = 0.2 },
            { name = "B", between = ["coupler", "rocker"], at = "B", type = "revolute", axis = [0, 0, 1], stiffness = 9e6, span = 0.2 },
            { name = "B0", between = ["world", "rocker"], at = "B0", type = "revolute", axis = [0, 0, 1], stiffness = 9e6, span = 0.2 },
        ]
        tsda = [
            { between = ["crank", "rocker"], points = ["A", "B"], stiffness = 1, free_length = 0.1 },
        ]
    "#;
    let scene = scene(text);
    assert!(scene.joints.iter().all(|joint| joint.assembly_error < 1e-14));
    let states = &scene.model.initial;
    let end = |row: usize, half: f64| {
        let state = &states[row];
        let arm = state.orientation.rotation().to_world(dbd_kernel::Vec3::new(half, 0.0, 0.0));
        (state.position + arm).to_f64()
    };
    let near = |p: [f64; 3], q: [f64; 3]| p.iter().zip(q).all(|(p, q)| (p - q).abs() < 1e-13);
    assert!(near(end(0, -0.5), [0.0; 3]) && near(end(2, -1.25), [3.5, 0.0, 0.0]));
    assert!(near(end(0, 0.5), end(1, -2.0)) && near(end(1, 2.0), end(2, 1.25)));
    // And near to where they were drawn.
    assert!(scene.assembled.unwrap().moved.iter().all(|moved| moved.distance < 0.4));
    // A raw element at a link's end goes with it.
    let group = scene.model.groups.last().unwrap();
    let points = &scene.model.points[usize::from(group.point)..];
    assert_eq!(points[..2], [[0.5, 0.0, 0.0], [1.25, 0.0, 0.0]].map(dbd_kernel::Vec3::from_f64));
}
