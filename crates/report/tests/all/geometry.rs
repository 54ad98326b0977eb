//! The geometry of mechanisms: what lies between which points.

use dbd_kernel::Vec3;
use dbd_report::picture::Mechanism;
use dbd_report::picture::mechanism::{ForceKind, JointKind, Outline, Place};
use dbd_report::picture::view::Views;
use dbd_scene::Scene;

fn mechanism(name: &str) -> Mechanism {
    let file = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Mechanism::of(&Scene::load(file).unwrap())
}

fn near(a: Vec3<f64>, b: [f64; 3]) -> bool {
    let gap = a - Vec3::from_f64(b);
    gap.dot(gap) < 1e-20
}

/// The bodies' names with their outlines' corners.
fn bar(mechanism: &Mechanism, name: &str) -> [Vec3<f64>; 2] {
    let row = mechanism.bodies.iter().position(|body| body.name == name).unwrap();
    assert!(matches!(mechanism.bodies[row].outline, Outline::Bar { .. }), "{name}");
    mechanism.corners(row).try_into().unwrap()
}

fn count(mechanism: &Mechanism, kind: JointKind) -> usize {
    mechanism.joints.iter().filter(|joint| joint.kind == kind).count()
}

#[test]
fn a_four_bar_has_three_bars_between_its_pivots() {
    let four_bar = mechanism("four-bar");
    let (a0, b0) = ([0.0; 3], [3.5, 0.0, 0.0]);
    let a = [0.5, 0.866_025_403_784_438_6, 0.0];
    let b = [4.193_375_245_281_536, 2.401_922_307_076_307, 0.0];
    assert_eq!(four_bar.bodies.len(), 3);
    for (name, from, to) in [("crank", a0, a), ("coupler", a, b), ("rocker", b, b0)] {
        let [first, second] = bar(&four_bar, name);
        assert!(near(first, from) && near(second, to), "{name}: {first:?} {second:?}");
    }
    assert_eq!((four_bar.joints.len(), count(&four_bar, JointKind::Revolute)), (4, 4));
    for joint in &four_bar.joints {
        let [one, other] = joint.places.each_ref().map(|place| four_bar.place(place));
        assert!(near(one, other.to_f64()), "{}", joint.name);
        assert_eq!(four_bar.along(&joint.axes[0]), Vec3::new(0.0, 0.0, 1.0));
    }
    let grounded =
        |joint: &&dbd_report::picture::mechanism::JointMark| joint.places[0].body.is_none();
    assert_eq!(four_bar.joints.iter().filter(grounded).count(), 2);
    assert_eq!(four_bar.torsions.len(), 2);
    assert!(near(four_bar.place(&four_bar.torsions[1].at), b0));
    assert_eq!(four_bar.gravity, Some([0.0, -9.81, 0.0]));
}

#[test]
fn joints_and_elements_are_those_of_the_scene() {
    let crank_slider = mechanism("crank-slider");
    for kind in
        [JointKind::Revolute, JointKind::Spherical, JointKind::Universal, JointKind::Translational]
    {
        assert_eq!(count(&crank_slider, kind), 1, "{kind:?}");
    }
    let guide = crank_slider.joints.iter().find(|joint| joint.name == "guide").unwrap();
    assert_eq!(crank_slider.along(&guide.axes[0]), Vec3::new(1.0, 0.0, 0.0));
    assert!(near(crank_slider.place(&guide.places[0]), [0.135_040_734_595_158_33, 0.0, 0.0]));
    // The slider has no length of its own: the box of its inertia.
    let slider = crank_slider.bodies.iter().find(|body| body.name == "slider").unwrap();
    let Outline::Block { half } = slider.outline else { panic!("{:?}", slider.outline) };
    let side = (6.0 * 4.0885e-4_f64 / 0.9813).sqrt();
    assert!(half.iter().all(|half| (2.0 * half - side).abs() < 1e-12), "{half:?}");
    let torque = &crank_slider.forces[0];
    assert_eq!((torque.kind, crank_slider.forces.len()), (ForceKind::Torque, 1));

    let three = mechanism("3ruu");
    assert_eq!((count(&three, JointKind::Universal), count(&three, JointKind::Revolute)), (6, 3));
    assert_eq!((0..three.bodies.len()).filter(|row| three.is_spider(*row)).count(), 6);
    let tool = three.bodies.iter().find(|body| body.name == "tool").unwrap();
    assert!(matches!(&tool.outline, Outline::Plate { points } if points.len() == 3));
    let elbow = three.joints.iter().find(|joint| joint.name == "elbow 1").unwrap();
    let [first, second] = [0, 1].map(|row| three.along(&elbow.axes[row]));
    assert!(near(first, [0.0, 1.0, 0.0]) && first.dot(second).abs() < 1e-12);

    let gripper = mechanism("gripper");
    assert_eq!((gripper.springs.len(), gripper.guides.len()), (3, 2));
    let cylinder = &gripper.springs[0];
    assert_eq!((cylinder.name.as_deref(), cylinder.driven), (Some("cylinder"), true));
    assert!(near(gripper.place(&cylinder.ends[0]), [0.0, 0.1, 0.0]));
    let pad = &gripper.guides[0];
    let across = gripper.place(&pad.point) - gripper.place(&pad.line);
    assert!(across.dot(gripper.along(&pad.direction)).abs() < 1e-12);

    let wishbone = mechanism("double-wishbone");
    let road = wishbone.forces.iter().find(|force| force.input.as_deref() == Some("road"));
    assert_eq!(road.map(|road| (road.kind, road.at.body)), Some((ForceKind::Shift, None)));
}

/// What is fixed in bodies goes with them: the same mechanism at another pose.
#[test]
fn outlines_move_with_their_bodies() {
    let mut four_bar = mechanism("four-bar");
    let half = std::f64::consts::FRAC_1_SQRT_2;
    four_bar.bodies[0].position = [10.0, 0.0, 0.0];
    four_bar.bodies[0].orientation = [half, 0.0, 0.0, half];
    let [from, to] = bar(&four_bar, "crank");
    // A quarter turn about z brings the crank's y axis to −x.
    assert!(near(from, [10.5, 0.0, 0.0]) && near(to, [9.5, 0.0, 0.0]), "{from:?} {to:?}");
    let joint = four_bar.joints.iter().find(|joint| joint.name == "A").unwrap();
    assert!(near(four_bar.place(&joint.places[0]), [9.5, 0.0, 0.0]));
}

#[test]
fn planar_mechanisms_are_seen_in_their_plane() {
    for name in ["four-bar", "hexagon", "gripper", "crank-slider", "cart-pendulum", "six-bar"] {
        let views = Views::of(&mechanism(name));
        assert!(views.planar && views.small.len() == 2, "{name}");
        assert_eq!(views.main.seen_along(), Some("−z"), "{name}");
        assert_eq!((views.main.right, views.main.up), (Vec3::axes()[0], Vec3::axes()[1]), "{name}");
    }
    for name in ["3ruu", "double-wishbone", "macpherson", "delta-pick-and-place"] {
        let views = Views::of(&mechanism(name));
        assert!(!views.planar, "{name}");
        let sides: Vec<_> = views.small.iter().map(|view| (view.name, view.seen_along())).collect();
        let expected = [("front", Some("y")), ("top", Some("−z")), ("side", Some("−x"))];
        assert_eq!(sides, expected, "{name}");
    }
    for name in ["four-bar", "3ruu", "gyroscope"] {
        let Views { main, small, .. } = Views::of(&mechanism(name));
        for view in small.iter().chain([&main]) {
            assert!(near(view.right.cross(view.up), view.toward.to_f64()), "{name}: {view:?}");
        }
    }
}

#[test]
fn a_place_and_its_local_are_one() {
    let three = mechanism("3ruu");
    let point = Vec3::new(0.3, -0.2, 0.7);
    for body in [None, Some(0), Some(12)] {
        let place: Place = three.local(body, point);
        assert!(near(three.place(&place), point.to_f64()));
    }
}

/// What the scene says of looks is drawn in place of an outline, in the axes of its body, and travels as data.
#[test]
fn solids_of_a_scene_stand_in_place_of_outlines() {
    let wishbone = mechanism("double-wishbone");
    let knuckle = wishbone.bodies.iter().position(|body| body.name == "knuckle").unwrap();
    let low = wishbone.corners(knuckle).iter().map(|corner| corner.z).fold(f64::MAX, f64::min);
    // The wheel of 0.31 m about a centre 0.31 m high stands on the road.
    assert!(low.abs() < 1e-12, "{low}");
    let cart = mechanism("cart-pendulum");
    let shown = serde_json::to_value(&cart).unwrap();
    assert_eq!(
        shown["bodies"][0]["shapes"][0],
        serde_json::json!({
            "kind": "box", "at": [0.0, 0.0, 0.0], "turn": [1.0, 0.0, 0.0, 0.0],
            "half": [0.06, 0.04, 0.04], "colour": null,
        })
    );
    assert_eq!(shown["ground"][0]["kind"], "box");
    let drawn = dbd_report::picture::svg(&wishbone, dbd_report::picture::Paper::File);
    assert!(drawn.contains("style=\"stroke:#8a939e;fill:#8a939e\""));
    let ground = dbd_report::picture::svg(&cart, dbd_report::picture::Paper::File);
    assert!(ground.contains("class=\"plate still stands\"") && !drawn.contains("still stands"));
}

/// A body without geometry looks like the shape that gives its inertia; a link, and what has its own, do not.
#[test]
fn a_shape_is_seen() {
    let text = r#"
        name = "shapes"
        duration = 1
        points = { A = [0, 0, 0], B = [2, 0, 0] }
        [[body]]
        name = "arm"
        link = { from = "A", to = "B", shape = "tube", diameter = 0.1, wall = 0.01, density = 7850 }
        [[body]]
        name = "block"
        shape = { type = "box", along = "y", length = 0.3, section = [0.2, 0.1], mass = 1 }
        position = [1, 1, 1]
        [[body]]
        name = "drum"
        shape = { type = "cylinder", along = "z", length = 0.5, diameter = 0.4, mass = 1 }
        position = [2, 1, 1]
        [[body]]
        name = "ball"
        shape = { type = "sphere", diameter = 0.4, mass = 1 }
        position = [3, 1, 1]
        [[body]]
        name = "weighed"
        shape = { type = "sphere", diameter = 0.4, mass = 1 }
        inertia = [1, 1, 1]
        position = [4, 1, 1]
        [[geometry]]
        body = "ball"
        shape = "cylinder"
        axis = [0, 0, 1]
        length = 1
        radius = 0.1
    "#;
    let mechanism = Mechanism::of(&Scene::parse(text, "a.toml").unwrap());
    let shown = serde_json::to_value(&mechanism).unwrap();
    let kinds: Vec<_> = (0..5).map(|row| shown["bodies"][row]["shapes"].clone()).collect();
    // A link is as long as it lies between its ends, and as thick as its section.
    assert_eq!(kinds[0][0]["ends"], serde_json::json!([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]));
    assert_eq!((&kinds[0][0]["radius"], &kinds[4]), (&0.05.into(), &serde_json::json!([])));
    assert_eq!(kinds[1][0]["half"], serde_json::json!([0.05, 0.15, 0.1]));
    assert_eq!(kinds[2][0]["ends"], serde_json::json!([[0.0, 0.0, -0.25], [0.0, 0.0, 0.25]]));
    assert_eq!((&kinds[2][0]["radius"], &kinds[2][0]["kind"]), (&0.2.into(), &"cylinder".into()));
    assert_eq!((kinds[3].as_array().unwrap().len(), &kinds[3][0]["kind"]), (1, &"cylinder".into()));
    // A pin at its end is as good as within; of what is held far outside the outline shows where.
    for (x, shapes) in [("0.16", 1), ("0.4", 0)] {
        let held = format!(
            "{text}\n[[tsda]]\nbetween = [\"world\", \"block\"]\npoints = [[0, 0, 0], [0, {x}, 0]]\nstiffness = 1\nfree_length = 0"
        );
        let mechanism = Mechanism::of(&Scene::parse(&held, "a.toml").unwrap());
        assert_eq!(mechanism.bodies[1].shapes.len(), shapes, "{x}");
    }
}
