//! What elements become.

use dbd_import::{Kind, Options, Weld};
use dbd_scene::Solid;

use crate::import::{imported, loaded, of};

/// A text with these bodies and what else stands in `<mujoco>`.
fn mujoco(bodies: &str, others: &str) -> String {
    format!("<mujoco>\n<worldbody>{bodies}</worldbody>\n{others}</mujoco>")
}

/// A body with a joint, of a mass at its origin.
fn body(name: &str, joint: &str, within: &str) -> String {
    format!(
        "<body name='{name}' pos='0.1 0 0'>{joint}\
         <inertial pos='0 0 0' mass='2' diaginertia='0.1 0.2 0.25'/>{within}</body>"
    )
}

#[test]
fn joints_become_joints() {
    let text = mujoco(
        &[
            body(
                "a",
                "<joint name='h' axis='1 0 0'/>",
                &body("b", "<joint name='s' type='slide'/>", ""),
            ),
            body("c", "<joint name='b' type='ball'/>", ""),
            body("d", "<freejoint/>", ""),
            body("e", "<joint type='free'/>", ""),
        ]
        .concat(),
        "<equality><weld name='w' body1='c' body2='d'/><connect name='p' body1='e' anchor='0 0 1'/>\
         <connect body1='a' body2='b' anchor='0 0 0' active='false'/></equality>",
    );
    let made = of(&text, &Options { stiffness: 2e6, ..Options::default() });
    let scene = loaded(&made);
    let joints: Vec<_> = scene.joints.iter().map(|j| (j.name.as_str(), j.kind)).collect();
    let expected = [
        ("h", "revolute"),
        ("s", "translational"),
        ("b", "spherical"),
        ("w", "fixed"),
        ("p", "spherical"),
    ];
    assert_eq!(joints, expected);
    assert_eq!(scene.joints[4].between, ["e", "world"]);
    assert_eq!(made.notes, ["connect without a name is inactive and left out"]);
    assert!(made.scene.contains("# line 2: <joint name=\"h\" type=\"hinge\">\n[[joint]]\n"));
    assert!(made.scene.contains("stiffness = 2000000.0\n"));
}

/// A hinge at q = 20° whose spring is at rest at 50° has k·30° of preload; a slide's spring has the
/// force k·(springref − q) at the start and k·θ less after.
#[test]
fn springs_are_at_rest_where_the_file_says() {
    let hinge = "<joint name='h' stiffness='6' springref='50' ref='20' damping='0.5'/>";
    let slide =
        "<joint name='s' type='slide' axis='0 3 0' stiffness='400' springref='0.03' ref='0.01'/>";
    let text = mujoco(&(body("a", hinge, "") + &body("b", slide, "")), "");
    let scene = loaded(&of(&text, &Options::default()));
    let spring = &scene.model.torsions[0];
    assert!((spring.preload - 6.0 * 30_f64.to_radians()).abs() < 1e-14);
    assert_eq!(spring.stiffness, 6.0);
    let text = of(&text, &Options::default()).scene;
    let value = |key: &str| -> Vec<f64> {
        let tsda = text.split("[[tsda]]").nth(1).unwrap();
        let line = tsda.lines().find(|line| line.starts_with(key)).unwrap();
        let numbers = line.split(['[', ']', ',', '=']).filter_map(|word| word.trim().parse().ok());
        numbers.collect()
    };
    let points = value("points");
    let length = points[1] - points[4];
    let tension = 400.0 * (length - value("free_length")[0]);
    assert!((tension - 400.0 * 0.02).abs() < 1e-9, "{tension}");
}

/// A body without a joint is one with its parent, or held by a fixed joint.
#[test]
fn bodies_without_joints_are_merged_or_fixed() {
    let arm =
        "<body name='arm' pos='0 0 1'><geom type='box' size='0.1 0.2 0.3' density='1000'/></body>";
    let text = mujoco(&body("a", "<joint name='h'/>", arm), "");
    let merged = loaded(&of(&text, &Options::default()));
    assert_eq!((merged.body_names.len(), merged.joints.len()), (1, 1));
    let body = &merged.model.bodies[0];
    assert!((body.mass - 50.0).abs() < 1e-12);
    assert!((merged.model.initial[0].position.z - 48.0 / 50.0).abs() < 1e-12);
    let fixed = loaded(&of(&text, &Options { weld: Weld::Fixed, ..Options::default() }));
    assert_eq!(fixed.body_names, ["a", "arm"]);
    assert_eq!(fixed.joints[1].kind, "fixed");
}

/// Sites that lie apart: the scene says so, closes them, and its springs are at rest where the file says.
#[test]
fn a_loop_that_is_open_is_closed() {
    let made = imported("open-loop.xml", &Options::default());
    assert!(made.scene.contains("[assemble]"));
    assert!(made.scene.contains("at = { first = [0.5, 0.0, 0.0], second = [0.5, 0.0, 0.0"));
    let scene = loaded(&made);
    assert!(scene.joints.iter().all(|joint| joint.assembly_error < 1e-9));
    // How far the first link was turned about y, from where its centre of mass was.
    let place = scene.model.initial[0].position;
    let turned = (0.1_f64).atan2(0.15) - (-place.z).atan2(place.x);
    assert!(turned.abs() > 0.01, "{turned}");
    // At y, a positive turn lowers what lies along x.
    let preload = 3.0 * (0.2 + turned);
    let spring = scene.model.torsions[0].preload;
    assert!((spring - preload).abs() < 1e-6, "{spring} {preload}");
}

/// A keyframe is another pose to begin at; loops are those of the file's pose.
#[test]
fn a_keyframe_is_where_the_scene_begins() {
    let text = mujoco(
        &(body("a", "<joint name='h' axis='0 1 0' ref='10'/>", "")
            + &body("f", "<freejoint/>", "")),
        "<keyframe><key name='up' qpos='1.745329251994329577e-1 1 2 3 0 0 2 0'/>\
         <key name='turned' qpos='0.3 0 0 0 1 0 0 0'/></keyframe>",
    );
    let at = |name: &str| {
        let options = Options { keyframe: Some(name.into()), ..Options::default() };
        loaded(&of(&text, &options))
    };
    let up = at("up");
    let place = up.model.initial[1].position;
    assert_eq!([place.x, place.y, place.z], [1.0, 2.0, 3.0]);
    assert!((up.model.initial[0].orientation.w.abs() - 1.0).abs() < 1e-15);
    let turned = at("turned").model.initial[0].orientation;
    let angle = 0.3 - 10_f64.to_radians();
    assert!((turned.v.y - (0.5 * angle).sin()).abs() < 1e-15, "{turned:?}");
}

/// Weight taken off is a force up at the centre of mass; kinds that are ignored are said.
#[test]
fn weight_that_is_taken_off_is_a_load() {
    let light = body("a", "<freejoint/>", "").replace("<body name", "<body gravcomp='0.5' name");
    let made = of(&mujoco(&light, ""), &Options::default());
    assert!(made.scene.contains("force = [0.0, 0.0, 9.81]"), "{}", made.scene);
    let limited = body("a", "<joint actuatorfrcrange='-1 1' armature='0.01'/>", "");
    let ignored = vec![Kind::Limit];
    let made = of(&mujoco(&limited, ""), &Options { ignored, ..Options::default() });
    assert_eq!(made.omitted.len(), 1);
    assert!(made.scene.contains("# Left out, limit (line 2): hinge `a`: actuators -1 to 1 N·m"));
    assert!(made.scene.contains("rotor = { inertia = 0.01, stiffness = "), "{}", made.scene);
}

/// What MuJoCo takes for nothing is nothing here: blank values, ranges without extent; a colour never counts.
#[test]
fn blank_values_colours_and_empty_ranges_refuse_nothing() {
    for geom in ["rgba=''", "rgba=' '", "rgba='1 0'", "pos=''", "density=''", "euler=''"] {
        let text = mujoco(&body("a", "<freejoint/>", &format!("<geom size='1' {geom}/>")), "");
        let options = Options { ignored: vec![Kind::Contact], ..Options::default() };
        assert_eq!(loaded(&of(&text, &options)).model.initial.len(), 1, "{geom}");
    }
    for (range, limits) in [("0 0", 0), ("1 0", 0), ("", 0), ("-1 1", 1)] {
        let text = mujoco(&body("a", &format!("<joint range='{range}'/>"), ""), "");
        let scene = loaded(&of(&text, &Options::default()));
        assert_eq!(dbd_scene::interactions(&scene).len(), limits, "{range}");
    }
}

/// A range stops a joint where the file says, also of one that begins elsewhere; friction holds it.
#[test]
fn ranges_and_friction_of_joints_are_theirs() {
    let turn = |joint: &str| {
        let text = mujoco(&body("a", joint, ""), "");
        let made = of(&text, &Options::default());
        (loaded(&made), made)
    };
    let (scene, made) = turn("<joint name='h' axis='0 0 1' range='-10 30'/>");
    assert!(made.omitted.is_empty() && made.scene.contains("# Limits, from"), "{}", made.scene);
    let found = dbd_scene::interactions(&scene);
    assert_eq!((found.len(), found[0].law, found[0].name()), (1, "hinge-stop", Some("h.limits")));
    assert!(made.scene.contains("from = -0.17453292519943295"), "{}", made.scene);
    let text = mujoco(
        &body("a", "<joint name='h' axis='0 0 1' range='-10 30'/>", ""),
        "<keyframe><key name='up' qpos='0.2'/></keyframe>",
    );
    let options = Options { keyframe: Some("up".into()), ..Options::default() };
    assert!(of(&text, &options).scene.contains("offset = 0.2,"));
    for (joint, laws) in [
        ("<joint type='slide' range='-1 2' frictionloss='3'/>", vec!["end-stop", "slide-friction"]),
        ("<joint range='-1 2' frictionloss='3'/>", vec!["hinge-stop", "hinge-friction"]),
        ("<joint range='-1 2' limited='false' frictionloss='3'/>", vec!["hinge-friction"]),
        (
            "<joint name='s' type='slide' axis='0 0 1' range='-1 1'/><joint name='t' axis='0 0 1' range='-9 9' \
             frictionloss='1'/>",
            vec!["end-stop", "hinge-stop", "hinge-friction"],
        ),
    ] {
        let (scene, made) = turn(joint);
        let mut found: Vec<_> =
            dbd_scene::interactions(&scene).iter().map(|found| found.law).collect();
        found.sort_unstable();
        let mut laws = laws;
        laws.sort_unstable();
        assert_eq!((found, made.omitted.len()), (laws, 0), "{joint}");
    }
    // What is limited to no range at all is listed, not written into a scene that nobody could read.
    for range in ["0 0", "1 0"] {
        let joint = format!("<joint range='{range}' limited='true'/>");
        let text = mujoco(&body("a", &joint, ""), "");
        let options = Options { ignored: vec![Kind::Limit], ..Options::default() };
        let made = of(&text, &options);
        assert_eq!(
            (made.omitted.len(), dbd_scene::interactions(&loaded(&made)).len()),
            (1, 0),
            "{range}"
        );
    }
    // A ball has no angle that a joint of a scene could stop.
    let text = mujoco(&body("a", "<joint type='ball' range='0 40' frictionloss='2'/>", ""), "");
    let options = Options { ignored: Kind::ALL.to_vec(), ..Options::default() };
    let kinds: Vec<_> = of(&text, &options).omitted.iter().map(|omitted| omitted.kind).collect();
    assert_eq!(kinds, [Kind::Limit, Kind::FrictionLoss]);
}

/// Weight taken off bodies that are rigid with each other acts at their common centre of mass where its
/// fraction is the same; elsewhere no constant force stands for it.
#[test]
fn weight_taken_off_rigid_bodies_alike_is_one_load() {
    let text = |fraction: &str| {
        mujoco(
            &format!(
                "<body gravcomp='0.5'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>\
                 <body gravcomp='{fraction}' pos='1 0 0'>\
                 <inertial pos='0 0 0' mass='3' diaginertia='1 1 1'/></body></body>"
            ),
            "",
        )
    };
    let scene = loaded(&of(&text("0.5"), &Options::default()));
    let [load] = &scene.model.loads[..] else { panic!("{:?}", scene.model.loads) };
    assert!((load.force.to_f64()[2] - 0.5 * 4.0 * 9.81).abs() < 1e-12, "{load:?}");
    let options = Options { ignored: vec![Kind::GravityCompensation], ..Options::default() };
    let made = of(&text("0.25"), &options);
    assert_eq!((made.omitted.len(), loaded(&made).model.loads.len()), (1, 0));
}

/// Geoms become geometry where they are, whatever the axes of the body: boxes, capsules, cylinders and balls with their
/// colours; what cannot be seen, and what a scene has no solid for, does not.
#[test]
fn geoms_become_geometry() {
    let text = mujoco(
        "<geom type='plane' size='1 1 1'/><geom type='box' size='1 2 3' pos='0 0 -3' contype='0' conaffinity='0'/>\
         <body name='a' pos='1 0 0' euler='0 0 90'><joint name='h'/>\
         <geom type='capsule' fromto='0 0 0 1 0 0' size='0.1' rgba='1 0.5 0 1'/>\
         <geom type='cylinder' size='0.2 0.3' pos='0 1 0' contype='0' conaffinity='0'/>\
         <geom type='ellipsoid' size='0.1 0.2 0.3'/><geom size='0.4' rgba='0 0 0 0'/>\
         <body pos='0 0 2'><geom size='0.5' contype='0' conaffinity='0'/></body></body>",
        "",
    );
    let made = of(&text, &Options { ignored: vec![Kind::Contact], ..Options::default() });
    let scene = loaded(&made);
    assert_eq!(scene.geometry.len(), 4, "{}", made.scene);
    let place = |row: Option<usize>, point: [f64; 3]| {
        let point = dbd_kernel::Vec3::<f64>::from_f64(point);
        let Some(state) = row.and_then(|row| scene.model.initial.get(row)) else {
            return point.to_f64();
        };
        (state.position + state.orientation.rotation().to_world(point)).to_f64()
    };
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    let [ground, link, cylinder, ball] = &scene.geometry[..] else { panic!("four") };
    let Solid::Box { at, half, .. } = ground.solid else { panic!("{ground:?}") };
    assert!(ground.body.is_none() && near(at, [0.0, 0.0, -3.0]) && half == [1.0, 2.0, 3.0]);
    // Turned by 90° about z: x of the body is y of the world.
    let Solid::Link { ends, radius } = link.solid else { panic!("{link:?}") };
    assert!(near(place(link.body, ends[0]), [1.0, 0.0, 0.0]) && radius == 0.1);
    assert!(near(place(link.body, ends[1]), [1.0, 1.0, 0.0]));
    assert_eq!(link.colour.as_deref(), Some("#ff8000"));
    let Solid::Cylinder { ends, radius } = cylinder.solid else { panic!("{cylinder:?}") };
    assert!(near(place(cylinder.body, ends[1]), [0.0, 0.0, 0.3]) && radius == 0.2);
    // Of a body without a joint, which is one with its parent.
    let Solid::Sphere { at, radius } = ball.solid else { panic!("{ball:?}") };
    assert!(near(place(ball.body, at), [1.0, 0.0, 2.0]) && radius == 0.5);
}

/// Spheres, ends of capsules and corners of boxes meet planes: as MuJoCo pairs them, rubbed as it says; other pairs are
/// listed.
#[test]
fn solids_touch_planes() {
    let text = |geoms: &str, floor: &str, others: &str| {
        let body = format!(
            "<body name='a' pos='0 0 1' euler='0 90 0'><freejoint/>\
             <inertial pos='0.1 0 0' mass='2' diaginertia='0.1 0.1 0.1'/>{geoms}</body>"
        );
        mujoco(
            &format!("<geom name='floor' type='plane' pos='0 0 0.2' size='1 1 1' {floor}/>{body}"),
            others,
        )
    };
    let contacts = |text: &str| {
        let made = of(text, &Options { stiffness: 1e6, ..Options::default() });
        let scene = loaded(&made);
        let found = dbd_scene::interactions(&scene);
        assert!(found.iter().all(|one| one.law == "plane-contact"), "{found:?}");
        let points: Vec<_> = found.iter().map(|one| one.points.unwrap()).collect();
        (points, made.scene)
    };
    // Turned about y: z of the body is x of the world; the body is at its centre of mass.
    let (points, scene) = contacts(&text("<geom name='foot' size='0.1' pos='0 0 0.3'/>", "", ""));
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(
        near(points[0][0], [0.0, 0.0, 0.2]) && near(points[0][1], [-0.1, 0.0, 0.3]),
        "{points:?}"
    );
    for line in
        ["name = \"foot-contact\"", "radius = 0.1", "stiffness = 1000000.0", "friction = 1.0"]
    {
        assert!(scene.contains(&format!("\n{line}\n")), "{line}: {scene}");
    }
    assert!(!scene.contains("rolling"), "{scene}");
    let counts = [
        ("<geom type='capsule' size='0.1 0.2'/>", 2),
        ("<geom type='box' size='0.1 0.2 0.3'/>", 8),
        ("<geom size='0.1'/><geom size='0.2' contype='0' conaffinity='0'/>", 1),
    ];
    for (geoms, count) in counts {
        assert_eq!(contacts(&text(geoms, "", "")).0.len(), count, "{geoms}");
    }
    // The larger friction, or that of the higher priority; margin and rolling.
    for (foot, floor, says) in [
        ("friction='0.3'", "friction='0.7'", "friction = 0.7"),
        ("friction='0.3' priority='1'", "friction='0.7'", "friction = 0.3"),
        ("condim='6' friction='1 0 0.02'", "", "rolling = 0.02"),
        ("margin='0.02' gap='0.005'", "", "radius = 0.115"),
        ("priority='1'", "margin='0.025'", "radius = 0.125"),
    ] {
        let (_, scene) = contacts(&text(&format!("<geom size='0.1' {foot}/>"), floor, ""));
        assert!(scene.contains(&format!("\n{says}\n")), "{says}: {scene}");
    }
    let (_, smooth) = contacts(&text("<geom size='0.1' condim='1'/>", "condim='1'", ""));
    assert!(!smooth.contains("friction = "), "{smooth}");
    // A pair has its own, whatever the bits; excluded bodies have none.
    let pair = "<contact><pair geom1='floor' geom2='foot' friction='0.4 0.4 0 0 0'/></contact>";
    for bits in ["", "contype='0' conaffinity='0'"] {
        let foot = format!("<geom name='foot' size='0.1' {bits}/>");
        let (points, scene) = contacts(&text(&foot, "", pair));
        assert!(points.len() == 1 && scene.contains("\nfriction = 0.4\n"), "{scene}");
    }
    // Not of one body with itself.
    let own = "<geom name='foot' size='0.1' contype='0' conaffinity='0'/>\
               <geom name='sole' type='plane' size='1 1 1' contype='0' conaffinity='0'/>";
    let pair = "<contact><pair geom1='sole' geom2='foot'/></contact>";
    let options = Options { ignored: vec![Kind::Contact], ..Options::default() };
    let made = of(&text(own, "contype='0' conaffinity='0'", pair), &options);
    assert_eq!((made.omitted.len(), dbd_scene::interactions(&loaded(&made)).len()), (1, 0));
    let exclude = "<contact><exclude body1='world' body2='a'/></contact>";
    assert!(contacts(&text("<geom size='0.1'/>", "", exclude)).0.is_empty());
    let off = "<option><flag contact='disable'/></option>";
    assert!(contacts(&text("<geom size='0.1'/>", "", off)).0.is_empty());
    // What has no counterpart is listed beside what has.
    let both = text("<geom size='0.1'/><geom type='cylinder' size='0.1 0.2'/>", "", "");
    let made = of(&both, &Options { ignored: vec![Kind::Contact], ..Options::default() });
    let omitted: Vec<_> = made.omitted.iter().map(|one| one.what.as_str()).collect();
    assert_eq!(
        omitted,
        [
            "geom `floor`, plane: may touch 1 other",
            "geom, cylinder, radius 0.1 m, length 0.4 m: may touch 1 other"
        ]
    );
    assert_eq!(dbd_scene::interactions(&loaded(&made)).len(), 1);
}

/// What nobody sees of a name, and what a spreadsheet would compute, is left out; names stay apart.
#[test]
fn names_fit_a_scene() {
    let long = "l".repeat(250);
    let body = |name: &str| {
        format!(
            "<body name='{name}'><joint name='{name}'/>\
             <inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>"
        )
    };
    let names = ["-arm", "arm", "=1+1", "a\u{200b}b", "\u{2060}", &long];
    let bodies: String = names.into_iter().map(body).collect();
    let text = format!("<mujoco model='@m'><worldbody>{bodies}</worldbody></mujoco>");
    let scene = loaded(&of(&text, &Options::default()));
    let short = "l".repeat(180);
    let expected = ["arm", "arm-2", "1+1", "ab", "unnamed", &short];
    assert_eq!(scene.body_names, expected);
    assert_eq!(scene.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>(), expected);
    assert_eq!(scene.name, "m");
}
