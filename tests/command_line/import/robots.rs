//! URDF becomes a scene: beside MuJoCo's own trajectory, and what is refused.

use std::path::Path;

use dbd_import::{ImportError, Kind, Options, import_text};

use crate::import::{distances, imported, loaded, of, worst};

/// Turned frames and inertia, damping, a slide, a finger that mimics another, what is fixed: as MuJoCo reads them.
#[test]
fn an_arm_moves_as_in_mujoco() {
    let of = |stiffness: f64| {
        let options = Options { stiffness, duration: 0.5, ..Options::default() };
        let made = imported("arm.urdf", &options);
        assert!(made.omitted.is_empty(), "{:?}", made.omitted);
        (distances(&loaded(&made), "tests/command_line/import/arm.csv"), made)
    };
    let ((soft, _), (stiff, made)) = (of(1e6), of(1e7));
    assert!(worst(&stiff) < 2e-4, "{stiff:?}");
    assert!(worst(&stiff) < worst(&soft) / 5.0, "{soft:?} {stiff:?}");
    let scene = loaded(&made);
    assert_eq!((scene.name.as_str(), scene.body_names.len()), ("arm", 5));
    // Limits of four joints, a coupling, and a motor as strong as the joint bears.
    assert_eq!(dbd_scene::interactions(&scene).len(), 5);
    let motor = &scene.inputs[0];
    assert_eq!((motor.name.as_str(), motor.range), ("shoulder_motor", [-30.0, 30.0]));
    assert!(made.scene.contains("colour = "), "{}", made.scene);
    assert!(made.scene.contains("# line 54: <joint name=\"shoulder\""), "{}", made.scene);
    assert!(!made.scene.contains("timestep"), "{}", made.scene);
}

const INERTIAL: &str = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";

fn robot(more: &str) -> String {
    format!(
        "<robot name='r'>\n<link name='a'>{INERTIAL}</link>\n<link name='b'>{INERTIAL}</link>\n{more}\n</robot>"
    )
}

fn joint(kind: &str, more: &str) -> String {
    format!("<joint name='j' type='{kind}'><parent link='a'/><child link='b'/>{more}</joint>")
}

/// A link without a joint is fixed; `world` is the ground; equal limits set no range; a floating link is free, one on a plane has
/// three freedoms.
#[test]
fn links_and_joints_are_taken_as_mujoco_takes_them() {
    let scene = loaded(&of(
        &robot(&joint("revolute", "<limit lower='0' upper='0'/>")),
        &Options::default(),
    ));
    assert_eq!((scene.body_names.len(), dbd_scene::interactions(&scene).len()), (1, 0));
    let text = robot(&joint("floating", "")).replace("'a'", "'world'");
    let free = loaded(&of(&text, &Options::default()));
    assert_eq!((free.body_names.len(), free.joints.len()), (1, 0));
    assert_eq!(free.model.gravity[0].to_f64(), [0.0, 0.0, -9.81]);
    let flat = loaded(&of(&robot(&joint("planar", "<axis xyz='0 0 2'/>")), &Options::default()));
    let laws: Vec<&str> = dbd_scene::interactions(&flat).iter().map(|one| one.law).collect();
    assert_eq!((flat.body_names.len(), flat.joints.len(), &laws[..]), (1, 0, &["bushing"][..]));
    // What a URDF says to MuJoCo.
    let heavy = "<mujoco><compiler settotalmass='3'/><option gravity='0 0 0'/></mujoco>";
    let scene =
        loaded(&of(&robot(&format!("{}{heavy}", joint("revolute", ""))), &Options::default()));
    assert!(scene.model.gravity.iter().all(|g| g.to_f64() == [0.0; 3]));
    let fixed = robot(&joint("fixed", ""));
    assert!(import_text(&fixed, "r.urdf", Path::new(""), &Options::default()).is_err());
}

#[test]
fn what_is_no_tree_of_links_is_refused_where_it_stands() {
    for (text, line, says, help) in [
        (robot(&joint("hinge", "")), 4, "unknown joint type", "revolute"),
        (robot("<joint name='j' type='fixed'><child link='b'/></joint>"), 4, "no <parent>", "link"),
        (robot(&joint("fixed", "").replace("'b'", "'bb'")), 4, "unknown link", "did you mean `b`"),
        (robot("<link name='a'/>"), 4, "defined twice", "unique name"),
        (robot("<link/>"), 4, "no `name`", "link name"),
        (
            robot(&format!("{}\n{}", joint("fixed", ""), joint("revolute", ""))),
            5,
            "child of two joints",
            "a tree",
        ),
        (
            robot(&format!(
                "{}\n<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>",
                joint("fixed", "")
            )),
            2,
            "form a cycle",
            "a tree",
        ),
        (robot(&joint("revolute", "<limit lower='1' upper='0'/>")), 4, "is above", "below"),
        (robot(&joint("revolute", "<axis xyz='0 0'/>")), 4, "axis", "3"),
        (robot(&joint("revolute", "<dynamics damping='x'/>")), 4, "damping", "number"),
        (
            robot("<link name='c'><visual><geometry><cone/></geometry></visual></link>"),
            4,
            "unknown geometry",
            "box",
        ),
        (
            robot("<link name='c'><inertial><mass value='1'/></inertial></link>"),
            4,
            "no <inertia>",
            "ixx",
        ),
        ("<robot/>".into(), 1, "no links", "xacro"),
        (robot("<xacro:property xmlns:xacro='x' name='p'/>"), 4, "belongs to a macro", "xacro"),
    ] {
        let made = import_text(&text, "r.urdf", Path::new(""), &Options::default());
        let Err(ImportError::Refused(refusal)) = made else { panic!("{text}: {made:?}") };
        assert_eq!(refusal.line, line, "{text}: {}", refusal.message);
        assert!(refusal.message.contains(says), "{text}: {}", refusal.message);
        assert!(refusal.help.contains(help), "{text}: {}", refusal.help);
    }
    for (more, kind, says) in [
        ("<joit name='j'/>", Kind::Unknown, "<joint>"),
        (&joint("planar", "<dynamics damping='1'/>"), Kind::Spring, "planar joint"),
        (
            "<transmission name='t'><joint name='none'/></transmission>",
            Kind::Actuator,
            "not a movable joint",
        ),
        (
            "<link name='c'><collision><geometry><box size='1 1 1'/></geometry></collision></link>",
            Kind::Contact,
            "may touch",
        ),
    ] {
        let text = robot(&format!("{}\n{more}", joint("revolute", "").replace("'j'", "'k'")))
            .replace(
                "<link name='b'>",
                "<link name='b'><collision><geometry><sphere radius='1'/></geometry></collision>",
            );
        let planar = format!(
            "{more}<link name='c'>{INERTIAL}</link>{}",
            joint("revolute", "").replace("'j'", "'k'").replace("'b'", "'c'")
        );
        let text = if kind == Kind::Spring { robot(&planar) } else { text };
        let made = import_text(&text, "r.urdf", Path::new(""), &Options::default());
        let Err(ImportError::Omitted { omissions, .. }) = made else { panic!("{more}: {made:?}") };
        let found = omissions.iter().any(|one| one.kind == kind && one.what.contains(says));
        assert!(found, "{more}: {omissions:?}");
    }
}
