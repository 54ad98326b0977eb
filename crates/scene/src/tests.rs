//! Scenes as a whole.

use dbd_kernel::energy::largest_extension;
use dbd_kernel::{F32, State, Vec3};

use super::*;

#[test]
fn what_a_scene_leaves_out_is_absent() {
    let scene = example::with("");
    assert_eq!((scene.step, scene.every, scene.description.as_str()), (None, None, ""));
    assert_eq!(scene.body_names, ["arm", "hand"]);
    let model = &scene.model;
    assert!(model.gravity.is_empty() && model.groups.is_empty() && model.points.is_empty());
    assert!(model.torsions.is_empty() && model.loads.is_empty() && model.dampers.is_empty());
    assert_eq!(model.initial[0].velocity, Vec3::ZERO);
    assert_eq!(model.initial[1].angular_velocity, Vec3::new(0.0, 0.0, 3.0));
}

#[test]
fn a_field_of_zero_is_no_gravity() {
    let text = |gravity: &str| {
        format!(
            "name = \"g\"\nduration = 1\ngravity = {gravity}\n[[body]]\nname = \"b\"\n\
             mass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]"
        )
    };
    let gravity = |g: &str| Scene::parse(&text(g), "g").map(|scene| scene.model.gravity);
    assert_eq!(gravity("[0, -0.0, 0.0]").unwrap(), []);
    assert_eq!(gravity("[0, 0, -1.62]").unwrap(), [Vec3::new(0.0, 0.0, -1.62)]);
}

/// Groups lie in the order joints, raw TSDAs, whatever their order in the file; element,
/// point and damper indices follow each other.
#[test]
fn groups_follow_each_other_in_the_order_of_their_kinds() {
    let scene = example::with(
        r#"
        [[tsda]]
        between = ["arm", "hand"]
        points = [[0, 0, 0], [0, 0, 0]]
        stiffness = 10
        free_length = 0.2
        damping = 1
        [[tsda]]
        between = ["world", "hand"]
        points = [[0, 0, 0], [0, 0, 0]]
        stiffness = 20
        free_length = 0
        [[joint]]
        name = "s"
        type = "spherical"
        between = ["arm", "hand"]
        at = [0.7, 0, 0]
        stiffness = 30
        arm = 0.1
        damping = 2
        [[joint]]
        name = "r"
        type = "revolute"
        between = ["world", "arm"]
        at = [0, 0, 0]
        axis = [1, 1, 1]
        stiffness = 40
        span = 0.1
        [[torsion_spring]]
        between = ["hand", "arm"]
        axis = [0, 0, 1]
        stiffness = 1
        damping = 3
        "#,
    );
    let model = &scene.model;
    let lay: Vec<_> = model
        .groups
        .iter()
        .map(|g| (g.triples, g.arms, g.shared, g.point, g.element, g.damper.row()))
        .collect();
    assert_eq!(
        lay,
        [
            (1, 3, false, 0, 0, Some(0)),
            (2, 3, true, 4, 3, None),
            (1, 1, false, 9, 9, Some(3)),
            (1, 1, false, 11, 0, None)
        ]
    );
    assert_eq!(model.dampers, [2.0, 2.0, 2.0, 1.0, 3.0]);
    assert_eq!(model.torsions[0].damper.row(), Some(4));
    assert_eq!((model.tsdas.len(), model.bushings.len(), model.points.len()), (10, 1, 13));
    assert_eq!(scene.joints.iter().map(|joint| joint.tsdas).sum::<usize>(), 9);
    // The scene's other precisions are roundings of this model and step alike.
    let single = model.convert::<F32>();
    let extension = largest_extension(&single, &State::initial(&single));
    let double = largest_extension(model, &State::initial(model));
    assert!((f64::from(extension) - double).abs() < 1e-6);
}

/// Exported source has the matrix of a law by its factors, and the tables that a scene leaves out as 0.
#[test]
fn laws_by_matrices_and_tables_are_exported() {
    let text = include_str!("../../../tests/fuzz/corpus/scene/mounts.toml");
    let text = text.replace("torque_z = [[\"-1 deg\", -5], [\"1 deg\", 5]]\n", "");
    let scene = Scene::parse(&text, "mounts.toml").unwrap();
    let source = export::model::<f32>(&scene);
    let list = |start: &str| {
        let (_, rest) = source.split_once(start).unwrap();
        let (list, _) = rest.split_once(']').unwrap();
        list.split(", ").map(str::to_owned).collect::<Vec<_>>()
    };
    let bits = |value: f32| format!("f32::from_bits({:#010x})", value.to_bits());
    let (diagonal, below) = (list("Ldl { diagonal: ["), list("below: ["));
    assert_eq!((diagonal.len(), below.len()), (6, 15));
    assert_eq!(diagonal[0], bits(12e3));
    assert_eq!(diagonal[1], bits((8000.0 - 500.0_f64 * (500.0 / 12e3)) as f32));
    assert_eq!([&below[0], &below[3]], [&bits((500.0_f64 / 12e3) as f32), &bits(-60.0 / 12e3)]);
    let none = format!("[{}, {}]", bits(0.0), bits(0.0));
    let none = format!(
        "torque_z: dbd_kernel::generated::Curve {{ knots: [{none}, [{}, {}]",
        bits(1.0),
        bits(0.0)
    );
    assert!(source.contains(&none), "{none}: {source}");
}
