//! Equalities between joints and fixed tendons: couplings.

use dbd_import::{ImportError, Kind, Options, import_text};
use dbd_tests::page::{block, figure, table};
use std::path::Path;

use crate::import::{distances, imported, loaded, of, worst};

fn start(stiffness: f64) -> Options {
    Options { stiffness, duration: 0.5, keyframe: Some("start".into()), ..Options::default() }
}

/// Gears, a rack, fingers and tendons move as in MuJoCo: off by what couplings and joints give way.
#[test]
fn joints_go_together_as_in_mujoco() {
    let trajectory = "tests/command_line/import/couplings.csv";
    let of = |stiffness: f64| {
        let made = imported("couplings.xml", &start(stiffness));
        assert!(made.omitted.is_empty(), "{:?}", made.omitted);
        let scene = loaded(&made);
        assert_eq!(dbd_scene::interactions(&scene).len(), 6);
        distances(&scene, trajectory)
    };
    let (soft, stiff) = (of(1e6), of(1e7));
    // What meets its range is off by what comes back of it.
    assert!(worst(&stiff) < 1e-3, "{stiff:?}");
    for ((name, soft), (_, stiff)) in soft.iter().zip(&stiff).take(7) {
        assert!(*stiff < soft / 5.0, "{name}: {soft} {stiff}");
    }
    let names: Vec<String> = stiff.iter().map(|(name, _)| name.clone()).collect();
    let head: Vec<&str> =
        std::iter::once("k [N/m]").chain(names.iter().map(String::as_str)).collect();
    let row = |(k, distances): (&str, &Vec<(String, f64)>)| {
        let figures = distances.iter().map(|(_, distance)| figure(distance * 1e3, 2));
        std::iter::once(k.to_owned()).chain(figures).collect()
    };
    let rows: Vec<Vec<String>> = [("1e6", &soft), ("1e7", &stiff)].into_iter().map(row).collect();
    block("docs/import.md", "couplings", &table(&head, &rows));
}

fn two(more: &str) -> String {
    let body = |name: &str, joint: &str| {
        format!(
            "<body name='{name}' pos='0 {} 0'>{joint}<geom size='0.1' contype='0' conaffinity='0'/></body>",
            name.len()
        )
    };
    [
        "<mujoco><compiler angle='radian'/><worldbody>".to_owned(),
        body("a", "<joint name='h' axis='0 0 1' ref='0.2'/>"),
        body("bb", "<joint name='k' axis='0 0 1' springref='0.3'/>"),
        body("ccc", "<joint name='s' type='slide' axis='0 0 1'/>"),
        body("dddd", "<joint name='b' type='ball'/>"),
        format!("</worldbody>{more}</mujoco>"),
    ]
    .concat()
}

fn offset_in(scene: &str) -> f64 {
    let coupling = scene.split("[[coupling]]").nth(1).unwrap();
    let line = coupling.lines().find_map(|line| line.strip_prefix("offset = "));
    line.unwrap().parse().unwrap()
}

/// A range of a tendon between two sites stops its length, the ground first; of one joint it stops that joint.
#[test]
fn ranges_of_tendons_are_stops() {
    let more =
        "<tendon><fixed name='one' range='-0.1 0.2'><joint joint='h' coef='0.5'/></fixed></tendon>";
    let scene = loaded(&of(&two(more), &Options::default()));
    let found = dbd_scene::interactions(&scene);
    assert_eq!((found.len(), found[0].name()), (1, Some("one-range")));
    let text = "<mujoco><worldbody><site name='w' pos='0 0 1'/>\
                <body name='a'><freejoint/><geom size='0.1' contype='0' conaffinity='0'/><site name='s' pos='0 0.1 0'/></body>\
                </worldbody><tendon><spatial name='rope' range='0.5 1.2'><site site='s'/><site site='w'/></spatial>\
                </tendon></mujoco>";
    let made = of(text, &Options::default());
    let scene = loaded(&made);
    let found = &dbd_scene::interactions(&scene)[0];
    assert_eq!((found.law, found.name()), ("distance-stop", Some("rope-range")));
    assert!(
        found.bodies[0].is_world() && made.scene.contains("from = 0.5\nto = 1.2"),
        "{}",
        made.scene
    );
    assert_eq!(found.points, Some([[0.0, 0.0, 1.0], [0.0, 0.1, 0.0]]));
}

/// What is written counts coordinates from where the scene begins.
#[test]
fn offsets_count_from_where_the_scene_begins() {
    let more = "<equality><joint name='gear' joint1='h' joint2='k' polycoef='0.1 2 0 0 0'/></equality>\
                <keyframe><key name='up' qpos='0.5 0.7 0 1 0 0 0'/></keyframe>";
    let options = Options { keyframe: Some("up".into()), ..Options::default() };
    let made = of(&two(more), &options);
    // q₁ − 0.2 = 0.1 + 2·q₂, from 0.5 and 0.7 on.
    let expected = "of = [{ joint = \"h\", factor = 1.0 }, { joint = \"k\", factor = -2.0 }]";
    assert!(made.scene.contains(expected), "{}", made.scene);
    let offset = offset_in(&made.scene);
    assert!((offset - (0.1 + 2.0 * 0.7 - 0.3)).abs() < 1e-12, "{offset}");
    assert_eq!(dbd_scene::interactions(&loaded(&made))[0].name(), Some("gear"));
    let more = "<tendon><fixed name='t' stiffness='5' damping='0.5'><joint joint='h' coef='2'/>\
                <joint joint='k' coef='-1'/></fixed></tendon>";
    let made = of(&two(more), &Options::default());
    assert!(made.scene.contains("stiffness = 5.0\ndamping = 0.5"), "{}", made.scene);
    // At rest 2·0.2 − 0.3, at the start 2·0.2: springref of a joint without one is 0, not its ref.
    let offset = offset_in(&made.scene);
    assert!((offset - (-0.3 - 0.4)).abs() < 1e-12, "{offset}");
    let idle = of(
        &two(
            "<tendon><fixed name='t'><joint joint='h' coef='2'/><joint joint='k' coef='1'/></fixed></tendon>",
        ),
        &Options::default(),
    );
    assert!(dbd_scene::interactions(&loaded(&idle)).is_empty() && !idle.notes.is_empty());
}

#[test]
fn what_is_no_linear_sum_is_listed() {
    let joints = "<joint joint='h' coef='1'/><joint joint='k' coef='1'/>";
    let equality = |given: &str| format!("<equality><joint {given}/></equality>");
    for (more, kind, why) in [
        (equality("joint1='h'"), Kind::Equality, "one joint"),
        (equality("joint1='h' joint2='k' polycoef='0 0 0 0 0'"), Kind::Equality, "one joint"),
        (equality("joint1='h' joint2='k' polycoef='0 1 0.5 0 0'"), Kind::Equality, "linear"),
        (equality("joint1='h' joint2='b'"), Kind::Equality, "not hinges or slides"),
        (equality("joint1='h' joint2='h'"), Kind::Equality, "with itself"),
        (
            format!("<tendon><fixed damping='1'>{joints}</fixed></tendon>"),
            Kind::Tendon,
            "requires a spring",
        ),
        (
            format!("<tendon><fixed stiffness='1'>{joints}{joints}</fixed></tendon>"),
            Kind::Tendon,
            "one to three",
        ),
        (
            format!("<tendon><fixed stiffness='1' frictionloss='2'>{joints}</fixed></tendon>"),
            Kind::FrictionLoss,
            "dry friction",
        ),
        (
            format!("<tendon><fixed stiffness='1 2'>{joints}</fixed></tendon>"),
            Kind::Spring,
            "not linear",
        ),
        (
            format!("<tendon><fixed stifness='1'>{joints}</fixed></tendon>"),
            Kind::Unknown,
            "`stiffness`",
        ),
    ] {
        let text = two(&more);
        let made = import_text(&text, "test.xml", Path::new(""), &Options::default());
        let Err(ImportError::Omitted { omissions, .. }) = made else { panic!("{more}") };
        let found = omissions.iter().any(|one| one.kind == kind && one.what.contains(why));
        assert!(found, "{more}: {omissions:?}");
    }
}
