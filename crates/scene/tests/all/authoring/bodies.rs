//! Inertia by tensors and shapes, bodies in frames of others, defaults: the same model as of plain numbers.

use dbd_kernel::{LoadFrame, Quaternion, Vec3};
use dbd_scene::Scene;

fn read(text: &str) -> Scene {
    let text = format!("name = \"s\"\nduration = 1\n{text}");
    Scene::parse(&text, "s").unwrap_or_else(|error| panic!("{error}: {}\n{text}", error.help()))
}

fn body(keys: &str) -> Scene {
    read(&format!("[[body]]\nname = \"b\"\n{keys}\n"))
}

fn close(a: Vec3<f64>, b: Vec3<f64>) -> bool {
    let d = a - b;
    d.dot(d) < 1e-28 * (1.0 + b.dot(b))
}

#[test]
fn a_diagonal_tensor_is_its_moments() {
    let place = "mass = 2\nposition = [1, 2, 3]\norientation = { axis = [1, 2, -2], angle = 0.7 }";
    let moments = body(&format!("{place}\ninertia = [0.1, 0.2, 0.25]"));
    let tensor = body(&format!("{place}\ninertia = [[0.1, 0, 0], [0, 0.2, 0], [0, 0, 0.25]]"));
    assert_eq!(moments.model, tensor.model);
    assert!(tensor.derived.is_empty() && moments.derived.is_empty());
}

/// A body whose tensor has products moves as one given about its principal axes: all that is written in
/// its axes is turned with them.
#[test]
fn what_is_written_in_a_bodys_axes_goes_with_its_principal_ones() {
    // About z by 30 degrees: Ixx = 0.1·cos² + 0.3·sin², Iyy the other way, Ixy = (0.1 − 0.3)·sin·cos.
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let (x, y, p) = (0.1 * c * c + 0.3 * s * s, 0.1 * s * s + 0.3 * c * c, (0.1 - 0.3) * s * c);
    let v = |v: [f64; 3]| format!("[{}, {}, {}]", v[0], v[1], v[2]);
    let turned = |[a, b, z]: [f64; 3]| [c * a + s * b, c * b - s * a, z];
    let rest = |of: &dyn Fn([f64; 3]) -> String| {
        format!(
            "angular_velocity = {}\n[[tsda]]\nbetween = [\"world\", \"b\"]\npoints = [[0, 0, 0], {}]\n\
             stiffness = 3\nfree_length = 0.1\n[[point_on_line]]\nbetween = [\"b\", \"world\"]\n\
             line_point = {}\nline_direction = {}\npoint = [1, 0, 0]\nstiffness = 2\nfree_length = 0\n\
             [[load]]\nbody = \"b\"\nforce = {}\ntorque = {}\nframe = \"body\"\n\
             [[load]]\nbody = \"b\"\nforce = [1, 2, 3]\n\
             [[input]]\nname = \"i\"\ntype = \"force\"\nbody = \"b\"\npoint = {}\naxis = {}\nframe = \"body\"\n\
             [[input]]\nname = \"j\"\ntype = \"torque\"\nbody = \"b\"\naxis = {}\nframe = \"body\"\n\
             [[readout]]\nname = \"r\"\ntype = \"point\"\nbody = \"b\"\npoint = {}\n",
            of([1.0, 2.0, 3.0]),
            of([0.1, 0.2, 0.3]),
            of([0.3, 0.0, 0.1]),
            of([0.0, 1.0, 0.0]),
            of([5.0, 0.0, 1.0]),
            of([0.0, 2.0, 1.0]),
            of([0.2, 0.1, 0.0]),
            of([1.0, 0.0, 0.0]),
            of([0.6, 0.8, 0.0]),
            of([0.0, 0.5, 0.0]),
        )
    };
    let start = "[[body]]\nname = \"b\"\nmass = 2\nposition = [0, 1, 0]\n";
    let written = read(&format!(
        "{start}orientation = {{ axis = [0, 0, 1], angle = 0.2 }}\n\
         inertia = [[{x}, {p}, 0], [{p}, {y}, 0], [0, 0, 0.35]]\n{}",
        rest(&|a| v(a))
    ));
    let principal = read(&format!(
        "{start}orientation = {{ axis = [0, 0, 1], angle = {} }}\ninertia = [0.1, 0.3, 0.35]\n{}",
        0.2 + 30.0_f64.to_radians(),
        rest(&|a| v(turned(a)))
    ));
    let (a, b) = (&written.model, &principal.model);
    assert!(close(a.bodies[0].inertia, b.bodies[0].inertia), "{:?}", a.bodies[0].inertia);
    let gap = a.initial[0].orientation.conjugate().product(b.initial[0].orientation);
    assert!(gap.v.dot(gap.v) < 1e-30, "{gap:?}");
    assert!(close(a.initial[0].angular_velocity, b.initial[0].angular_velocity));
    assert!(a.points.iter().zip(&b.points).all(|(a, b)| close(*a, *b)), "{:?}", a.points);
    assert!(close(a.lines[0].direction, b.lines[0].direction));
    for (a, b) in a.loads.iter().zip(&b.loads) {
        assert!(close(a.force, b.force) && close(a.torque, b.torque));
    }
    assert_eq!((a.loads[0].frame, a.loads[1].force), (LoadFrame::Body, Vec3::new(1.0, 2.0, 3.0)));
    let shown = |scene: &Scene| format!("{:.12?} {:.12?}", scene.model.inputs, scene.readouts);
    assert_eq!(shown(&written), shown(&principal));
    let [derived] = &written.derived[..] else { panic!("{:?}", written.derived) };
    assert_eq!((derived.name.as_str(), derived.shape), ("b", None));
    assert!((derived.turned - 30.0_f64.to_radians()).abs() < 1e-15, "{}", derived.turned);
}

#[test]
fn a_shape_gives_mass_and_inertia() {
    let of = |keys: &str| {
        let scene = body(&format!("position = [0, 0, 0]\n{keys}"));
        let body = &scene.model.bodies[0];
        (body.mass, body.inertia.to_f64(), scene.derived.first().and_then(|derived| derived.shape))
    };
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15 * b);
    let (mass, inertia, shape) =
        of("shape = { type = \"box\", along = \"y\", length = 2, section = [3, 1], density = 2 }");
    // y is 2 m long, z 3 m, x 1 m.
    assert_eq!((mass, shape), (12.0, Some("box")));
    assert!(near(inertia, [13.0, 10.0, 5.0]), "{inertia:?}");
    let (mass, inertia, _) = of("mass = 12\nshape = { type = \"rod\", along = \"z\", length = 1 }");
    assert!(mass == 12.0 && near(inertia, [1.0, 1.0, 0.01]), "{inertia:?}");
    let (mass, inertia, _) =
        of("shape = { type = \"tube\", length = 2, diameter = 1, wall = 0.25, mass = 3 }");
    assert!(mass == 3.0 && near(inertia, [0.46875, 1.234375, 1.234375]), "{inertia:?}");
    let other =
        of("shape = { type = \"tube\", length = 2, diameter = 1, inner_diameter = 0.5, mass = 3 }");
    assert_eq!(other.1, inertia);
    let (_, inertia, _) = of("shape = { type = \"sphere\", diameter = 2, mass = 5 }");
    assert!(near(inertia, [2.0; 3]), "{inertia:?}");
    let (_, inertia, _) = of("shape = { type = \"plate\", length = 3, width = 1, mass = 12 }");
    assert!(near(inertia, [1.0, 9.0, 10.0]), "{inertia:?}");
    // What stands in the body's table goes before what its shape says.
    let (mass, inertia, shape) = of(
        "mass = 7\ninertia = [1, 2, 3]\nshape = { type = \"sphere\", diameter = 2, density = 5 }",
    );
    assert_eq!((mass, inertia, shape), (7.0, [1.0, 2.0, 3.0], None));
}

#[test]
fn a_link_has_the_inertia_of_its_shape() {
    let scene = body(
        "link = { from = [0, 0, 0], to = [0, 3, 4], along = \"z\", shape = \"cylinder\", diameter = 0.2, density = 1000 }",
    );
    let body = &scene.model.bodies[0];
    let mass = 1000.0 * std::f64::consts::PI * 0.01 * 5.0;
    assert!((body.mass - mass).abs() < 1e-13 * mass);
    let [x, y, z] = body.inertia.to_f64();
    assert!(
        (z - mass * 0.005).abs() < 1e-13
            && x == y
            && (x - mass * (0.03 + 25.0) / 12.0).abs() < 1e-11
    );
    let [derived] = &scene.derived[..] else { panic!() };
    assert_eq!((derived.shape, derived.length, derived.turned), (Some("cylinder"), Some(5.0), 0.0));
}

/// A body in the frame of another is where the other's axes say, and rides along.
#[test]
fn a_body_in_a_frame_lies_and_moves_with_it() {
    let scene = read(
        "[[body]]\nname = \"hand\"\nframe = \"arm\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [2, 0, 0]\n\
         orientation = { axis = [1, 0, 0], angle = 1.5707963267948966 }\nvelocity = [0, 0, 1]\nangular_velocity = [0, 0, 4]\n\
         [[body]]\nname = \"arm\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 1, 0]\n\
         orientation = { axis = [0, 0, 1], angle = 1.5707963267948966 }\nvelocity = [5, 0, 0]\nangular_velocity = [0, 0, 3]\n",
    );
    let [hand, arm] = &scene.model.initial[..] else { panic!() };
    assert_eq!(arm.position, Vec3::new(1.0, 1.0, 0.0));
    assert!(close(hand.position, Vec3::new(1.0, 3.0, 0.0)), "{:?}", hand.position);
    // 3 rad/s about z at 2 m along y: −6 m/s along x.
    assert!(close(hand.velocity, Vec3::new(-1.0, 0.0, 1.0)), "{:?}", hand.velocity);
    let rotation = hand.orientation.rotation();
    assert!(close(rotation.to_world(Vec3::new(1.0, 0.0, 0.0)), Vec3::new(0.0, 1.0, 0.0)));
    assert!(close(rotation.to_world(Vec3::new(0.0, 1.0, 0.0)), Vec3::new(0.0, 0.0, 1.0)));
    // The hand's z is the world's x: 4 rad/s about it and 3 about the world's z.
    let spin = rotation.to_world(hand.angular_velocity);
    assert!(close(spin, Vec3::new(4.0, 0.0, 3.0)), "{spin:?}");
}

/// The frame of a body whose tensor has products is the one it is written in.
#[test]
fn a_frame_is_the_one_that_its_body_is_written_in() {
    let scene = read(
        "points = { P = { frame = \"a\", at = [1, 0, 0] } }\n\
         [[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0, 5]\ninertia = [[2, 0.5, 0.1], [0.5, 2.5, 0.2], [0.1, 0.2, 3]]\n\
         [[body]]\nname = \"b\"\nframe = \"a\"\nmass = 1\nposition = [0, 1, 0]\ninertia = [1, 1, 1]\n\
         [[body]]\nname = \"c\"\nmass = 1\nposition = \"P\"\ninertia = [1, 1, 1]\n",
    );
    let initial = &scene.model.initial;
    let turn: Quaternion<f64> = initial[0].orientation;
    assert!(turn.v.dot(turn.v) > 0.01, "{turn:?}");
    assert!(close(initial[1].position, Vec3::new(0.0, 1.0, 5.0)));
    assert!(initial[1].orientation.v.dot(initial[1].orientation.v) < 1e-30);
    assert!(close(initial[2].position, Vec3::new(1.0, 0.0, 5.0)));
}

const DEFAULTS: &str = "[defaults.joint]\ntype = \"revolute\"\nstiffness = 1e6\nspan = 0.1\naxis = [0, 0, 1]\ndamping = 5\narm = 0.3\n\
    [defaults.spherical]\nstiffness = 2e6\n[defaults.body]\nmass = 2\ninertia = [1, 1, 1]\n";

#[test]
fn defaults_stand_for_what_a_table_does_not_give() {
    let elements = |first: &str, second: &str, body: &str| {
        format!(
            "[[body]]\nname = \"b\"\nposition = [0, 0, 0]\n{body}\n\
             [[joint]]\nname = \"r\"\nbetween = [\"world\", \"b\"]\nat = [0, 0, 0]\n{first}\n\
             [[joint]]\nname = \"s\"\nbetween = [\"world\", \"b\"]\nat = [1, 0, 0]\n{second}\n"
        )
    };
    let short = elements(
        "axis = [0, 1, 0]",
        "type = \"spherical\"\ndamping_ratio = 0.1\nfrequency = 50",
        "",
    );
    let long = elements(
        "type = \"revolute\"\nstiffness = 1e6\nspan = 0.1\naxis = [0, 1, 0]\ndamping = 5",
        "type = \"spherical\"\nstiffness = 2e6\narm = 0.3\ndamping_ratio = 0.1\nfrequency = 50",
        "mass = 2\ninertia = [1, 1, 1]",
    );
    // A revolute has no arm, a spherical joint no span and no axis: what another type needs is not theirs.
    let (short, long) = (read(&format!("{DEFAULTS}{short}")), read(&long));
    assert_eq!(short.model, long.model);
    assert_eq!(short.joints, long.joints);
}

#[test]
fn a_default_may_be_changed_by_its_path() {
    let text = format!(
        "name = \"s\"\nduration = 1\n{DEFAULTS}[[body]]\nname = \"b\"\nposition = [0, 0, 0]\n\
         [[joint]]\nname = \"r\"\nbetween = [\"world\", \"b\"]\nat = [0, 0, 0]\n"
    );
    let changed = Scene::parse_with(&text, "s", &["defaults.joint.stiffness=3e6"]).unwrap();
    assert_eq!(changed.model.tsdas[0].stiffness, 3e6);
    let changed = Scene::parse_with(&text, "s", &["joint.r.stiffness=4e6"]).unwrap();
    assert_eq!(changed.model.tsdas[0].stiffness, 4e6);
}
