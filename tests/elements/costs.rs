//! The table of what an element costs on a microcontroller: `docs/elements.md`.

use dbd_tests::page::{block, grouped, table};
use dbd_tests::results::rows;

/// Elements as counted: name of the scene, what it is, the most instructions that it ought to cost.
const ELEMENTS: [(&str, &str, Option<f64>); 29] = [
    ("tsda", "a TSDA without damping", None),
    ("spring-table", "`distance-spring`, five knots", None),
    ("damper-table", "`distance-damper`, five knots", None),
    ("hinge-spring", "`hinge-spring`, five knots", None),
    ("hinge-damper", "`hinge-damper`, five knots", None),
    ("winch", "a TSDA with damping and an input of its free length", None),
    ("limits-free", "`limits` of a revolute joint with dissipation, within the range", Some(250.0)),
    ("limits-reached", "the same, beyond it", Some(250.0)),
    ("limits-soft", "the same with a soft start, within it", Some(250.0)),
    ("friction", "`friction` of a revolute joint, Coulomb's", Some(350.0)),
    ("friction-stribeck", "the same with breakaway, Stribeck's and viscous friction", Some(350.0)),
    ("friction-load", "Coulomb's with `load`", Some(350.0)),
    ("servo", "position servo with a limit", None),
    ("drive", "voltage drive with winding, rotor and gear", Some(700.0)),
    ("drive-play", "the same with clearance, the teeth apart", Some(700.0)),
    ("drive-dq", "voltage drive with windings in rotor axes", Some(700.0)),
    ("coupling", "coupling of two revolute joints with damping", None),
    (
        "contact-free",
        "`plane-contact` with friction, damping and rolling resistance, apart",
        Some(900.0),
    ),
    ("contact-pressed", "the same, in contact", Some(900.0)),
    ("wheel", "`wheel-contact` with damping and rolling resistance, standing", Some(900.0)),
    ("balls", "`sphere-contact` with friction and damping, in contact", Some(900.0)),
    ("bushing-undamped", "`bushing` without damping", None),
    ("bushing", "`bushing` with six dampings", None),
    ("bushing-curves", "`bushing-curves` of three knots, without damping", None),
    ("bushing-matrix", "`bushing-matrix` without damping", None),
    ("bushing-maxwell", "`bushing-maxwell`", None),
    ("sensor", "encoder with noise and delay at a revolute joint", None),
    ("actuator", "input `joint_torque` with lag, delay and limits", None),
    ("driven", "a driven body with a sine as its velocity", None),
];

#[test]
fn the_page_has_what_each_element_costs() {
    let counted = rows("docs/results/elements.csv");
    let find = |name: &str| counted.iter().find(|row| row.text("element") == name);
    let plain = find("plain").expect("the plain scene");
    assert_eq!(counted.len(), ELEMENTS.len() + 1, "an element is missing in a list");
    let mut lines = vec![vec![
        "two links on revolute joints, without an element".to_owned(),
        grouped(plain.text("instructions_mean")),
        grouped(plain.text("planar_instructions_mean")),
        String::new(),
        grouped(plain.text("rodata_bytes")),
        grouped(plain.text("plant_ram_bytes")),
    ]];
    for (name, what, goal) in ELEMENTS {
        let row = find(name).unwrap_or_else(|| panic!("{name} was not counted"));
        let goal = goal.map_or(String::new(), |goal| {
            let meets = |column| row.number(column) <= goal;
            let met = match (meets("instructions_mean"), meets("planar_instructions_mean")) {
                (true, true) => "met",
                (true, false) => "met in space",
                (false, true) => "met in the plane",
                (false, false) => "not met",
            };
            format!("{goal}, {met}")
        });
        let counts = ["rodata_bytes", "plant_ram_bytes"].map(|column| grouped(row.text(column)));
        let instructions = grouped(row.text("instructions_mean"));
        let planar = row.text("planar_instructions_mean");
        let planar = if planar.is_empty() { "–".to_owned() } else { grouped(planar) };
        lines.push([vec![what.to_owned(), instructions, planar, goal], counts.to_vec()].concat());
    }
    let head = [
        "element",
        "instructions per step",
        "in the plane",
        "goal",
        "model, bytes",
        "plant, bytes",
    ];
    block("docs/elements.md", "costs", &table(&head, &lines));
}
