//! A planar scene's plant: in its plane within, in the world without.

use dbd_kernel::plant::StateError;
use dbd_kernel::readouts::Reading;
use dbd_kernel::{BodyIndex, BodyState, F64, Vec3};
use dbd_plant::monitor::Monitor;
use dbd_plant::{Method, OrientationName, PlantError, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;

/// A pendulum in the plane y = 0.5, whose body lies with its own x along the normal.
const SCENE: &str = r#"
name = "pendulum"
duration = 1
gravity = [0, 0, -9.81]
[[body]]
name = "arm"
mass = 2
inertia = [0.3, 0.2, 0.15]
position = [0.4, 0.5, 0]
orientation = { axis = [0, 0, 1], angle = "90 deg" }
[[joint]]
name = "pin"
type = "revolute"
between = ["world", "arm"]
at = [0, 0.5, 0]
axis = [0, 1, 0]
stiffness = 2e5
damping = 5
span = 0.05
[[input]]
name = "push"
type = "force"
body = "arm"
axis = [1, 0, 0]
point = [0, -0.1, 0]
[[readout]]
name = "turn"
type = "joint_angle"
target = "pin"
[[readout]]
name = "tip"
type = "point"
body = "arm"
point = [0.02, -0.4, 0.1]
[[readout]]
name = "speed"
type = "point_velocity"
body = "arm"
point = [0.02, -0.4, 0.1]
[[readout]]
name = "load"
type = "joint_force"
target = "pin"
[[readout]]
name = "sensor"
type = "imu"
body = "arm"
point = [0.02, -0.4, 0.1]
"#;

fn scene(planar: bool) -> Scene {
    Scene::parse_with(SCENE, "pendulum.toml", &[format!("planar={planar}")])
        .unwrap_or_else(|error| panic!("{error}: {}", error.help()))
}

fn near(a: Vec3<f64>, b: Vec3<f64>, by: f64) -> bool {
    let d = a - b;
    d.dot(d).sqrt() <= by
}

/// States, energies and read-outs of every scheme are the spatial plant's, but for what a pin gives.
#[test]
fn what_comes_out_is_the_worlds() {
    let (flat, whole) = (scene(true), scene(false));
    for scheme in [SchemeName::Leapfrog, SchemeName::Rk4, SchemeName::DbdP2] {
        for (precision, by) in [(PrecisionName::F64, 2e-6), (PrecisionName::F32, 4e-5)] {
            let method = Method::new(scheme, None, precision).unwrap();
            let [mut own, mut other] =
                [&flat, &whole].map(|scene| plant(scene, &method, 1e-4).unwrap());
            for plant in [&mut own, &mut other] {
                plant.set(flat.inputs[0].index, 3.0, 0.0).unwrap();
                plant.advance(2000).unwrap();
            }
            let (a, b) = (own.state(), other.state());
            let (a, b) = (&a.bodies[0], &b.bodies[0]);
            assert!(near(a.position, b.position, by), "{method:?}: {a:?} {b:?}");
            assert!(near(a.velocity, b.velocity, 30.0 * by), "{method:?}: {a:?} {b:?}");
            assert!(near(a.angular_velocity, b.angular_velocity, 100.0 * by), "{a:?} {b:?}");
            let turn = a.orientation.conjugate().product(b.orientation);
            assert!(turn.w.abs() > 1.0 - by, "{turn:?}");
            assert!(!near(a.position, flat.model.initial[0].position, 0.05));
            let (a, b) = (own.energy(), other.energy());
            assert!((a.total() - b.total()).abs() < 2e-2 * b.kinetic, "{a:?} {b:?}");
            for info in &flat.readouts {
                let [a, b] = [own.read(&info.readout), other.read(&info.readout)];
                // Forces and accelerations are those of stiff springs, wherever they just are.
                let same = match (a.unwrap(), b.unwrap()) {
                    (Reading::Scalar(a), Reading::Scalar(b)) => (a - b).abs() < 10.0 * by,
                    (Reading::Vector(a), Reading::Vector(b)) if info.name == "load" => {
                        near(a, b, 0.1 * b.dot(b).sqrt())
                    }
                    (Reading::Vector(a), Reading::Vector(b)) => near(a, b, 30.0 * by),
                    (
                        Reading::Imu { specific_force: a, rate: r },
                        Reading::Imu { specific_force: b, rate: s },
                    ) => near(a, b, 0.1 * b.dot(b).sqrt()) && near(r, s, 100.0 * by),
                    _ => false,
                };
                assert!(same, "{}: {a:?} {b:?}", info.name);
            }
        }
    }
}

/// The model that a plant shows lies in the world, as its states do.
#[test]
fn its_model_and_its_states_go_together() {
    let flat = scene(true);
    let mut own = plant(&flat, &Method::default(), 1e-4).unwrap();
    let mut monitor = Monitor::new(&flat, own.as_ref());
    own.advance(3000).unwrap();
    let verdict =
        monitor.check(&own.state()).unwrap_or_else(|run_failure| panic!("{run_failure:?}"));
    assert_eq!(verdict.energy, own.energy());
    assert!(verdict.extension > 0.0 && verdict.extension < 1e-3, "{}", verdict.extension);
}

#[test]
fn a_state_goes_in_again_and_one_beside_the_plane_is_refused() {
    let flat = scene(true);
    let mut own = plant(&flat, &Method::default(), 1e-4).unwrap();
    own.advance(500).unwrap();
    let (state, hash) = (own.state(), own.hash());
    let snapshot = own.snapshot().unwrap();
    own.advance(500).unwrap();
    own.set_state(&state).unwrap();
    // Turned out of the plane and in again, all but rounded.
    let (body, again) = (state.bodies[0], own.state().bodies[0]);
    assert!(near(body.position, again.position, 1e-15) && state.step == own.steps());
    assert!(near(body.angular_velocity, again.angular_velocity, 1e-14));
    own.advance(1).unwrap();
    own.restore(&snapshot).unwrap();
    assert_eq!(own.hash(), hash);
    let beside = |change: &dyn Fn(&mut BodyState<F64>)| {
        let mut state = state.clone();
        change(&mut state.bodies[0]);
        plant(&flat, &Method::default(), 1e-4).unwrap().set_state(&state)
    };
    let off = Err(StateError::OffPlane(BodyIndex(0)));
    assert_eq!(beside(&|body| body.position.y += 1e-3), off);
    assert_eq!(beside(&|body| body.velocity.y += 1e-3), off);
    assert_eq!(beside(&|body| body.angular_velocity.z += 1e-3), off);
    assert_eq!(
        beside(&|body| body.position.x = f64::NAN),
        Err(StateError::NotFinite(BodyIndex(0)))
    );
    assert_eq!(beside(&|body| body.position.x += 1e-9), Ok(()));
}

#[test]
fn euler_angles_have_no_plane() {
    let method = Method::default().with_orientation(OrientationName::Euler321);
    let refused = plant(&scene(true), &method, 1e-4).err().unwrap();
    let built = method.check_built().is_ok();
    assert!(!built || refused == PlantError::Planar { what: "euler-321" }, "{refused:?}");
}
