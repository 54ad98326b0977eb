//! Couplings: the terms that they stand for, their units, their source, what is refused.

use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::Scene;

/// Two wheels, a slider and a sleeve on the ground, with couplings.
fn text(more: &str) -> String {
    let body = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nposition = [{x}, 0, 0]\n"
        )
    };
    let joint = |name: &str, kind: &str, x: f64, more: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"{kind}\"\nbetween = [\"world\", \"of_{name}\"]\nat = [{x}, 0, 0]\n\
             axis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e6\n{more}\n"
        )
    };
    [
        "name = \"couplings\"\nduration = 1\n".to_owned(),
        body("of_wheel", 0.0),
        body("of_pinion", 1.0),
        body("of_rack", 2.0),
        body("of_nut", 3.0),
        body("of_ball", 4.0),
        joint("wheel", "revolute", 0.0, ""),
        joint("pinion", "revolute", 1.0, ""),
        joint("rack", "translational", 2.0, "gauge = 0.1\noffset = 0.02"),
        joint("nut", "cylindrical", 3.0, "offset = 0.02"),
        "[[joint]]\nname = \"ball\"\ntype = \"spherical\"\nbetween = [\"world\", \"of_ball\"]\nat = [4, 0, 0]\n\
         arm = 0.1\nstiffness = 1e6\n"
            .to_owned(),
        more.to_owned(),
    ]
    .concat()
}

fn scene(more: &str) -> Result<Scene, String> {
    Scene::parse(&text(more), "couplings.toml")
        .map_err(|error| format!("{:?}", miette::Report::new(error)))
}

fn coupling(keys: &str) -> String {
    format!("[[coupling]]\nname = \"mesh\"\n{keys}\n")
}

const PAIR: &str = "of = [{ joint = \"wheel\" }, { joint = \"pinion\", factor = \"20/60\" }]";

#[test]
fn a_coupling_is_an_interaction_of_its_name() {
    let shown = "[[readout]]\nname = \"load\"\ntype = \"interaction\"\ntarget = \"mesh\"\nquantity = \"load\"\n";
    let of = |keys: &str| {
        let scene = scene(&format!("{}{shown}", coupling(keys))).unwrap_or_else(|e| panic!("{e}"));
        let found = dbd_scene::interactions(&scene);
        assert_eq!((found.len(), found[0].law, found[0].name()), (1, "coupling", Some("mesh")));
        (found[0].label.clone(), scene.readouts[0].columns[0].1, scene)
    };
    let (label, unit, scene) = of(&format!("{PAIR}\nstiffness = \"1 kN*m/deg\""));
    assert_eq!((label.as_str(), unit), ("coupling `mesh` (wheel, pinion)", "N·m"));
    let before = text("").matches('\n').count();
    assert_eq!(scene.line_of_interaction(0), Some(before + 1));
    let slides = "of = [{ joint = \"rack\" }, { joint = \"pinion\", factor = \"5 mm/rad\" }]";
    let (label, unit, _) = of(&format!("{slides}\nstiffness = \"1 kN/mm\"\nplay = \"0.1 mm\""));
    assert_eq!((label.as_str(), unit), ("coupling `mesh` (rack, pinion)", "N"));
    let screw = "of = [{ joint = \"nut\", freedom = \"turn\" }, { joint = \"nut\", freedom = \"slide\", factor = \"1 turn/(5 mm)\" }]";
    let (_, unit, _) = of(&format!("{screw}\nstiffness = 100"));
    assert_eq!(unit, "N·m");
}

/// Every constant that changes a motion changes the fingerprint.
#[test]
fn all_constants_are_in_the_fingerprint() {
    let of = |keys: &str| {
        let scene = scene(&coupling(keys)).unwrap_or_else(|error| panic!("{error}"));
        Plant::new(&scene.model, Leapfrog, 1e-5).unwrap().fingerprint()
    };
    let base = format!("{PAIR}\nstiffness = 1000");
    let mut all = vec![of(&base), of(&format!("{}\nstiffness = 1000", PAIR.replace("20", "21")))];
    for more in [
        "damping = 1",
        "offset = 0.1",
        "play = 0.1",
        "acts = \"tension\"",
        "acts = \"compression\"",
    ] {
        all.push(of(&format!("{base}\n{more}")));
    }
    let three = "of = [{ joint = \"wheel\" }, { joint = \"pinion\", factor = \"20/60\" }, { joint = \"rack\", factor = 1 }]\nstiffness = 1000";
    all.push(of(three));
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), 8);
}

#[test]
fn what_is_no_coupling_is_refused_with_a_remedy() {
    let stiff = "stiffness = 1000";
    let pair = |second: &str| format!("of = [{{ joint = \"wheel\" }}, {second}]\n{stiff}");
    for (keys, parts) in [
        (stiff.to_owned(), ["of", "joint"]),
        (PAIR.to_owned(), ["stiffness", "N·m/rad"]),
        (format!("{PAIR}\nstiffness = 0"), ["stiffness", "> 0"]),
        (format!("{PAIR}\nstiffness = -1"), ["stiffness", "> 0"]),
        (format!("{PAIR}\nstiffness = \"1 N/m\""), ["stiffness", "N·m/rad"]),
        (format!("{PAIR}\n{stiff}\ndamping = -1"), ["damping", "≥ 0"]),
        (format!("{PAIR}\n{stiff}\nplay = \"-1 deg\""), ["play", "≥ 0"]),
        (format!("{PAIR}\n{stiff}\nplay = \"1 mm\""), ["play", "rad"]),
        (format!("{PAIR}\n{stiff}\nacts = \"both\""), ["acts", "compression"]),
        (format!("{PAIR}\n{stiff}\nratio = 3"), ["ratio", "of"]),
        (format!("of = []\n{stiff}"), ["0 coordinates", "one to three"]),
        (
            format!(
                "of = [{{ joint = \"wheel\" }}, {{ joint = \"pinion\", factor = 1 }}, {{ joint = \"rack\", factor = 1 }}, {{ joint = \"nut\", freedom = \"turn\", factor = 1 }}]\n{stiff}"
            ),
            ["4 coordinates", "one to three"],
        ),
        (pair("{ joint = \"pinion\" }"), ["factor", "a finite number"]),
        (pair("{ joint = \"pinion\", factor = 0 }"), ["is 0", "3 : 1"]),
        (pair("{ joint = \"pinion\", factor = \"1 mm\" }"), ["factor", "number"]),
        (pair("{ joint = \"rack\", factor = \"1 mm/rad\" }"), ["factor", "rad/m"]),
        (pair("{ joint = \"wheel\", factor = 2 }"), ["a second time", "sum"]),
        (pair("{ joint = \"ball\", factor = 2 }"), ["spherical joint `ball`", "needs a revolute"]),
        (pair("{ joint = \"nut\", factor = 2 }"), ["freedom", "slide"]),
        (
            pair("{ joint = \"pinion\", freedom = \"turn\", factor = 2 }"),
            ["freedom", "cylindrical"],
        ),
        (pair("{ joint = \"pinoin\", factor = 2 }"), ["pinoin", "pinion"]),
        (pair("{ jont = \"pinion\", factor = 2 }"), ["jont", "joint"]),
    ] {
        let said = scene(&coupling(&keys)).err().unwrap_or_else(|| panic!("{keys} is read"));
        let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in parts {
            assert!(flat.contains(part), "{keys}: no {part} in {said}");
        }
    }
    let law = "[[interaction]]\nlaw = \"coupling\"\nbetween = [\"world\", \"of_wheel\"]\n";
    let said = scene(law).err().unwrap_or_default();
    assert!(said.contains("[[coupling]]"), "{said}");
}
