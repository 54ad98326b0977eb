//! Actuators and tendons.

use dbd_import::{ImportError, Kind, Options, import_text};
use dbd_kernel::elements::input::InputKind;

use crate::import::{loaded, of};

/// A hinge `h` and a slide `s`, and what else stands in `<mujoco>`.
fn with(beside: &str) -> String {
    format!(
        "<mujoco>\n<worldbody><site name='w' pos='0 0 1'/>\
         <body name='a'><joint name='h' axis='0 1 0'/><inertial pos='0.1 0 0' mass='1' diaginertia='1 1 1'/>\
         <site name='t' pos='0.1 0 0'/>\
         <body name='b' pos='0.5 0 0'><joint name='s' type='slide' range='-1 1' limited='false'/>\
         <inertial pos='0 0 0' mass='2' diaginertia='1 1 1'/><site name='u'/></body></body></worldbody>\n{beside}</mujoco>"
    )
}

/// The refused things of a text.
fn omitted(beside: &str) -> Vec<(Kind, String)> {
    match import_text(&with(beside), "test.xml", "".as_ref(), &Options::default()) {
        Err(ImportError::Omitted { omissions, .. }) => {
            omissions.into_iter().map(|one| (one.kind, one.what)).collect()
        }
        other => panic!("{beside}: {other:?}"),
    }
}

/// The force at the start, its stiffness, its damping, and what a control of 1 adds, of a hinge's actuator:
/// gear·(gain·u + b0 + b1·gear·q + b2·gear·q').
#[test]
fn laws_of_actuators_are_springs_dampers_and_inputs() {
    let classes = "<default><position kp='7' kv='2'/>\
                   <default class='g'><general biastype='affine' biasprm='0.5 -3' gainprm='4'/></default></default>";
    for (actuator, preload, stiffness, damping, control) in [
        ("<position joint='h'/>", -7.0 * 0.2, 7.0, 2.0, 7.0),
        ("<position joint='h' kp='3' kv='0.5' gear='2'/>", -12.0 * 0.2, 12.0, 2.0, 6.0),
        ("<velocity joint='h' kv='4'/>", 0.0, 0.0, 4.0, 4.0),
        // A class has what the one around it has; a form begins anew after another, but for `general`.
        ("<general class='g' joint='h'/>", 0.5 - 3.0 * 0.2, 3.0, 2.0, 4.0),
        ("<velocity joint='h'/>", 0.0, 0.0, 1.0, 1.0),
        ("<velocity class='g' joint='h'/>", 0.0, 0.0, 4.0, 4.0),
        (
            "<general joint='h' gaintype='affine' gainprm='5 0 0' biastype='none'/>",
            0.0,
            0.0,
            0.0,
            5.0,
        ),
        ("<motor joint='h' gear='-2'/>", 0.0, 0.0, 0.0, -2.0),
    ] {
        let text = with(&format!(
            "{classes}<actuator>{actuator}</actuator><keyframe><key name='k' qpos='0.2 0' ctrl='0.3'/></keyframe>"
        ));
        let options = Options { keyframe: Some("k".into()), ..Options::default() };
        let scene = loaded(&of(&text, &options));
        let spring = scene.model.torsions.first();
        assert_eq!(spring.is_some(), stiffness > 0.0 || damping > 0.0, "{actuator}");
        if let Some(spring) = spring {
            assert_eq!(spring.stiffness, stiffness, "{actuator}");
            assert!((spring.preload - preload).abs() < 1e-12, "{actuator}: {}", spring.preload);
            let damper = spring.damper.row().map_or(0.0, |row| scene.model.dampers[row]);
            assert_eq!(damper, damping, "{actuator}");
        }
        let input = &scene.model.inputs[0];
        assert!(matches!(input.kind, InputKind::JointTorque { .. }));
        assert!((input.value - control * 0.3).abs() < 1e-12, "{actuator}: {}", input.value);
    }
}

/// Of a slide and of a tendon they are TSDAs, and an input acts on the slide's joint or on the tendon's TSDA; a constant
/// force without a spring is one of the input.
#[test]
fn laws_along_lines_are_tsdas() {
    let text = with(
        "<tendon><spatial name='c'><site site='w'/><site site='u'/></spatial></tendon>\
         <actuator><position name='p' joint='s' kp='30' kv='4'/><motor name='m' joint='s' gear='2'/>\
         <position name='q' tendon='c' kp='5'/>\
         <general name='f' tendon='c' gainprm='3' biastype='affine' biasprm='0.5'/></actuator>",
    );
    let made = of(&text, &Options::default());
    let scene = loaded(&made);
    let values: Vec<f64> = scene.model.inputs.iter().map(|input| input.value).collect();
    // At rest on the length of the start, 1.118 m, where its own law pulls with 5 N/m of it.
    let length = 1.25_f64.sqrt();
    let expected = [0.0, 0.0, 5.0 * length, -0.5];
    for (value, expected) in values.iter().zip(expected) {
        assert!((value - expected).abs() < 1e-12, "{values:?}");
    }
    let kinds: Vec<&str> = scene.inputs.iter().map(|input| input.kind).collect();
    assert_eq!(kinds, ["joint_force", "joint_force", "actuator", "actuator"]);
    assert!(made.scene.contains("name = \"p-servo\"") && !made.scene.contains("s-spring"));
    for target in ["s", "q-servo", "c-spring"] {
        assert!(made.scene.contains(&format!("target = \"{target}\"")), "{target}: {}", made.scene);
    }
    assert!(made.scene.contains("# line 3: <position>: N = -5.0 × its control + 5.59016994374947"));
}

/// Sensors of a slide read its travel, from the coordinate of the start on.
#[test]
fn sensors_of_a_slide_read_its_travel() {
    let text = with(
        "<sensor><jointpos name='x' joint='s'/><jointvel name='v' joint='s'/></sensor>\
         <keyframe><key name='k' qpos='0 0.25'/></keyframe>",
    );
    let options = Options { keyframe: Some("k".into()), ..Options::default() };
    let scene = loaded(&of(&text, &options));
    let kinds: Vec<_> = scene.readouts.iter().map(|one| (one.kind, one.columns[0].1)).collect();
    assert_eq!(kinds, [("joint_travel", "m"), ("joint_travel_rate", "m/s")]);
    let plant = dbd_kernel::Plant::new(&scene.model, dbd_kernel::Leapfrog, 1e-4).unwrap();
    let read = |row: usize| plant.read(&scene.readouts[row].readout).unwrap().scalar().unwrap();
    assert!((read(0) - 0.25).abs() < 1e-12 && read(1).abs() < 1e-12, "{} {}", read(0), read(1));
}

/// What is no linear law is refused with the reason.
#[test]
fn actuators_that_are_no_linear_law_are_refused() {
    let tendon = "<tendon><spatial name='c'><site site='w'/><site site='u'/></spatial></tendon>";
    for (actuator, why) in [
        ("<intvelocity joint='h' kp='3'/>", "integrates"),
        ("<damper joint='h' kv='3' ctrlrange='0 1' ctrllimited='false'/>", "rate"),
        ("<muscle joint='h'/>", "is not linear"),
        ("<position joint='h' timeconst='0.1'/>", "filterexact"),
        ("<general joint='h' dyntype='integrator'/>", "integrator"),
        ("<general joint='h' gaintype='affine' gainprm='1 2'/>", "gain that is not constant"),
        ("<general joint='h' biastype='affine' biasprm='0 2'/>", "negative stiffness"),
        ("<general joint='h' biastype='affine' biasprm='0 0 2'/>", "negative damping"),
        ("<motor site='t'/>", "neither a joint nor a tendon"),
        ("<position tendon='c' dampratio='1'/>", "give `kv`"),
    ] {
        let found = omitted(&format!("{tendon}<actuator>{actuator}</actuator>"));
        let [(kind, what)] = &found[..] else { panic!("{actuator}: {found:?}") };
        assert!(*kind == Kind::Actuator && what.contains(why), "{actuator}: {what}");
    }
    let several =
        "<actuator><pid joint='h'/></actuator><keyframe><key name='k' ctrl='1 2'/></keyframe>";
    let options =
        Options { keyframe: Some("k".into()), ignored: vec![Kind::Actuator], ..Options::default() };
    assert_eq!(of(&with(several), &options).omitted.len(), 2);
}

/// A damping ratio is that of what the joint moves, the rest free: 1/(M⁻¹) of the two joints.
#[test]
fn a_damping_ratio_is_that_of_what_moves() {
    let text = with("<actuator><position joint='h' kp='20' dampratio='0.5'/></actuator>");
    let scene = loaded(&of(&text, &Options::default()));
    // The slide goes across the arm of 0.5 m: what is beyond it gives way.
    let (arm, own) = (1.0 + 0.1 * 0.1, 1.0);
    let inertia = arm + own + 2.0 * 0.25 - (2.0_f64 * 0.5).powi(2) / 2.0;
    let row = scene.model.torsions[0].damper.row().unwrap();
    let expected = 2.0 * 0.5 * (20.0 * inertia).sqrt();
    assert!((scene.model.dampers[row] - expected).abs() < 1e-12, "{}", scene.model.dampers[row]);
}

/// Tendons between two sites are TSDAs with one free length; others are refused with the reason.
#[test]
fn tendons_between_two_sites_are_tsdas() {
    let sites = "<site site='w'/><site site='t'/>";
    let made = |given: &str| {
        let text = with(&format!("<tendon><spatial name='c' {given}>{sites}</spatial></tendon>"));
        loaded(&of(&text, &Options::default()))
    };
    let raw = |scene: &dbd_scene::Scene| *scene.model.tsdas.last().unwrap();
    let stated = raw(&made("stiffness='9' damping='2' springlength='0.06'"));
    assert_eq!((stated.stiffness, stated.free_length), (9.0, 0.06));
    let measured = raw(&made("stiffness='9'"));
    assert!((measured.free_length - 1.01_f64.sqrt()).abs() < 1e-15);
    let idle = made("");
    assert_eq!(idle.model.tsdas.len(), made("stiffness='1'").model.tsdas.len() - 1);
    for (tendon, kind, why) in [
        (
            format!("<spatial stiffness='1' springlength='0.1 0.2'>{sites}</spatial>"),
            Kind::Tendon,
            "one length",
        ),
        (
            format!("<spatial stiffness='1' damping='1' springlength='0'>{sites}</spatial>"),
            Kind::Tendon,
            "zero length",
        ),
        (format!("<spatial>{sites}<site site='u'/></spatial>"), Kind::Tendon, "two sites"),
        (
            "<spatial><site site='w'/><geom geom='g'/></spatial>".into(),
            Kind::Tendon,
            "around geoms",
        ),
        (
            "<fixed stiffness='1'><joint joint='h' coef='0'/></fixed>".into(),
            Kind::Tendon,
            "one to three joints",
        ),
        (
            format!("<spatial stiffness='1' range='2 0' limited='true'>{sites}</spatial>"),
            Kind::Tendon,
            "range is empty",
        ),
        (
            format!("<spatial stiffness='1' actuatorfrcrange='0 2'>{sites}</spatial>"),
            Kind::Limit,
            "actuatorfrcrange 0 to 2 N",
        ),
        (format!("<spatial stifness='1'>{sites}</spatial>"), Kind::Unknown, "`stiffness`"),
    ] {
        let found = omitted(&format!("<tendon>{tendon}</tendon>"));
        let [(found, what)] = &found[..] else { panic!("{tendon}: {found:?}") };
        assert!(*found == kind && what.contains(why), "{tendon}: {what}");
    }
}

/// Ranges of a control and of a motor's force bound the input; an actuator without them has none.
#[test]
fn ranges_of_controls_bound_inputs() {
    let infinite = [f64::NEG_INFINITY, f64::INFINITY];
    for (actuator, range) in [
        ("<motor joint='h' gear='2' ctrlrange='-1 3'/>", [-2.0, 6.0]),
        ("<motor joint='h' gear='-2' ctrlrange='-1 3'/>", [-6.0, 2.0]),
        ("<motor joint='h' gear='2' ctrlrange='-1 3' forcerange='-1 2'/>", [-2.0, 4.0]),
        ("<motor joint='h' forcerange='-1 2'/>", [-1.0, 2.0]),
        ("<motor joint='h' ctrlrange='2 3' forcerange='-1 1'/>", [1.0, 1.0]),
        ("<position joint='h' kp='5' ctrlrange='-0.5 1'/>", [-2.5, 5.0]),
        ("<velocity joint='h' kv='5' ctrlrange='-0.5 1' ctrllimited='false'/>", infinite),
        ("<motor joint='h'/>", infinite),
    ] {
        let text = with(&format!("<actuator>{actuator}</actuator>"));
        let scene = loaded(&of(&text, &Options::default()));
        assert_eq!(scene.inputs[0].range, range, "{actuator}");
        // A control beyond the range is one at its end, as in MuJoCo.
        let key = "<keyframe><key name='k' ctrl='9'/></keyframe>";
        let text = with(&format!("<actuator>{actuator}</actuator>{key}"));
        let options = Options { keyframe: Some("k".into()), ..Options::default() };
        let value = loaded(&of(&text, &options)).model.inputs[0].value;
        assert!(range[0] <= value && value <= range[1], "{actuator}: {value}");
        assert!(range == infinite || value == range[1] || value == range[0], "{actuator}: {value}");
    }
    let forced = "<actuator><position name='p' joint='h' forcerange='-1 1'/></actuator>";
    assert_eq!(omitted(forced), [(Kind::Limit, "position `p`: forcerange -1 to 1 N·m".to_owned())]);
}

/// An armature is a rotor of its joint: it swings as slowly as MuJoCo's, whose inertia is that of both.
#[test]
fn an_armature_is_a_rotor() {
    let text = with("").replace("name='h' axis", "name='h' armature='2' axis");
    let text = text.replace("<mujoco>", "<mujoco><option gravity='0 0 0'/>");
    let text = text.replace("</worldbody>", "</worldbody><actuator><motor joint='h'/></actuator>");
    let scene = loaded(&of(&text, &Options::default()));
    let names: Vec<_> = dbd_scene::interactions(&scene).into_iter().map(|law| law.law).collect();
    assert_eq!(names, ["hinge-drive"]);
    let mut plant = dbd_plant::plant(&scene, &dbd_plant::Method::default(), 1e-4).unwrap();
    plant.set(dbd_kernel::InputIndex(0), 3.0, 0.0).unwrap();
    plant.advance(2000).unwrap();
    // Bodies of 1 kg·m² each, 1 kg at 0.1 m, and the rotor's 2 kg·m²; the slide lets its body stay where it is.
    let rate = plant.state().bodies[0].angular_velocity.y;
    let inertia = 1.0 + 1.0 + 0.01 + 2.0;
    assert!((rate / (3.0 * 0.2 / inertia) - 1.0).abs() < 2e-2, "{rate}");
}
