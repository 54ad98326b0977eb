//! What joints of bushings make of a scene, and what demands them.

use dbd_kernel::model::Law;
use dbd_scene::{Realisation, Scene, Severity};

const BODIES: &str = r#"
[[body]]
name = "arm"
mass = 1.5
inertia = [0.3, 0.2, 0.4]
position = [0.5, 0, 0]
[[body]]
name = "hand"
mass = 0.7
inertia = [0.01, 0.02, 0.025]
position = [1.5, 0, 0]
"#;

fn scene(head: &str, joint: &str) -> Result<Scene, dbd_scene::SceneError> {
    let text = format!(
        "name = \"s\"\nduration = 1\n{head}\n{BODIES}\n[[joint]]\nname = \"j\"\nbetween = [\"arm\", \"hand\"]\n\
         at = [1, 0, 0]\nstiffness = 1e5\n{joint}\n"
    );
    Scene::parse(&text, "s.toml")
}

fn law(scene: &Scene) -> (Law, usize, usize) {
    let group = &scene.model.groups[0];
    (group.law, group.elements(), scene.model.groups.len())
}

const BUSHING: &str = "realisation = \"bushing\"\n";

#[test]
fn each_type_is_one_group_of_its_elements() {
    for (joint, known) in [
        ("type = \"spherical\"", (Law::PointBushing, 1, 1)),
        ("type = \"revolute\"\naxis = [0, 0, 1]\nspan = 0.1", (Law::Revolute, 1, 1)),
        ("type = \"universal\"\naxes = [[0, 0, 1], [0, 1, 0]]\nspan = 0.1", (Law::Universal, 1, 1)),
        ("type = \"fixed\"\naxis = [0, 0, 1]\nspan = 0.1", (Law::PointBushing, 3, 1)),
    ] {
        let made = scene("", &format!("{joint}\n{BUSHING}")).unwrap();
        assert_eq!(law(&made), known, "{joint}");
        let info = &made.joints[0];
        assert_eq!((info.realisation, info.tsdas), (Realisation::Bushing, known.1), "{joint}");
        assert!(info.assembly_error < 1e-15 && info.spider.is_none());
        assert_eq!(made.body_names, ["arm", "hand"]);
        // What is left free.
        let facts = dbd_scene::facts(&made);
        assert_eq!(facts.freedoms, Some(12 - info.holds as usize), "{joint}");
    }
}

/// The joint's own key, then `[defaults]`, then the scene's.
#[test]
fn the_nearest_word_counts() {
    let spherical = "type = \"spherical\"\narm = 0.05\n";
    for (head, key, bushing) in [
        ("", "", false),
        (BUSHING, "", true),
        (BUSHING, "realisation = \"tsda\"", false),
        ("defaults.joint = { realisation = \"bushing\" }", "", true),
        ("realisation = \"bushing\"\ndefaults.spherical = { realisation = \"tsda\" }", "", false),
    ] {
        let made = scene(head, &format!("{spherical}{key}")).unwrap();
        assert_eq!(law(&made).0 == Law::PointBushing, bushing, "{head} {key}");
    }
}

/// The scene's word is for those that can; a demand of one that cannot is refused.
#[test]
fn what_cannot_be_a_bushing_stays_or_is_refused() {
    let slider = "type = \"cylindrical\"\naxis = [1, 0, 0]\nspan = 0.1\noffset = 0.02\n";
    let approximate = "type = \"spherical\"\narm = 0.05\nclearance = 1e-4\n";
    for joint in [slider, approximate] {
        for head in [BUSHING, "defaults.joint = { damping = 1 }"] {
            assert_eq!(scene(head, joint).unwrap().joints[0].realisation, Realisation::Tsda);
        }
        let refused = scene("", &format!("{joint}{BUSHING}")).unwrap_err();
        let said = refused.message().to_owned();
        assert!(said.starts_with("`realisation` of joint `j` "), "{said}");
        assert!(refused.line().is_some());
    }
    assert!(scene("defaults.joint = { realisation = \"bushing\" }", slider).is_ok());
    assert!(scene("defaults.joint = { realisation = \"bushing\" }", approximate).is_err());
}

#[test]
fn a_spider_that_nobody_needs_is_spoken_of_and_cannot_be_named() {
    let joint = format!(
        "type = \"universal\"\naxes = [[0, 0, 1], [0, 1, 0]]\nspan = 0.1\n{BUSHING}\
         spider = {{ mass = 0.2, inertia = [1e-3, 1e-3, 1e-3] }}\n"
    );
    let made = scene("", &joint).unwrap();
    let warnings = dbd_scene::warnings(&made);
    let said = warnings.iter().find(|warning| warning.text.contains("spider"));
    assert!(said.is_some_and(|w| w.severity == Severity::Note && w.text.contains("0.2 kg")));
    let named = scene("", &format!("{joint}[[load]]\nbody = \"j.spider\"\nforce = [1, 0, 0]"));
    assert!(named.unwrap_err().message().contains("names no body"));
    let torque = "[[input]]\nname = \"t\"\ntype = \"joint_torque\"\ntarget = \"j\"\nabout = \"second\"\nvalue = 1";
    assert!(scene("", &format!("{joint}{torque}")).is_ok());
}

#[test]
fn the_long_form_has_the_same_bits_and_a_change_makes_the_same() {
    let joint = "type = \"revolute\"\naxis = [0, 0, 1]\nspan = 0.1\nring = 0.03\ndamping = 3\n";
    let plain = scene("", joint).unwrap();
    let made = plain.with("realisation=bushing").unwrap();
    assert_eq!(made.model, scene(BUSHING, joint).unwrap().model);
    assert!(made.with("realisation=rubber").is_err());
    let text = format!(
        "name = \"s\"\nduration = 1\n{BUSHING}{BODIES}\n[[joint]]\nname = \"j\"\nbetween = [\"arm\", \"hand\"]\n\
         at = [1, 0, 0]\nstiffness = 1e5\n{joint}\n"
    );
    let long = Scene::long_form(&text, "s.toml", &[] as &[&str]).unwrap();
    assert_eq!(Scene::parse(&long, "l.toml").unwrap().model, made.model, "{long}");
}
