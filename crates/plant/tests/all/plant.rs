//! The plant of any method: its bits, what it leaves and takes up, what it refuses.

use dbd_kernel::energy::energy;
use dbd_kernel::readouts::Reading;
use dbd_kernel::{InputIndex, Leapfrog, Plant};
use dbd_plant::{
    DampingName, Method, Named as _, OrientationName, PlantError, PrecisionName, SchemeName, plant,
};
use dbd_scene::Scene;

/// A mass of 2 kg on a spring and a damper, pushed by a caller, with its place read out.
const SCENE: &str = r#"
    name = "pushed"
    duration = 1
    [[body]]
    name = "mass"
    mass = 2
    inertia = [0.1, 0.1, 0.1]
    position = [1.1, 0, 0]
    [[tsda]]
    between = ["world", "mass"]
    points = [[0, 0, 0], [0, 0, 0]]
    stiffness = 50
    damping = 0.3
    free_length = 1
    [[input]]
    name = "push"
    type = "force"
    body = "mass"
    axis = [1, 0, 0]
    [[readout]]
    name = "place"
    type = "point"
    body = "mass"
    point = [0, 0, 0]
"#;

fn scene() -> Scene {
    Scene::parse(SCENE, "pushed.toml").unwrap_or_else(|error| panic!("{error:?}"))
}

fn methods() -> impl Iterator<Item = Method> {
    let all = PrecisionName::ALL.iter().flat_map(|precision| {
        SchemeName::ALL.iter().flat_map(|scheme| {
            let own = Method::new(*scheme, None, *precision).unwrap();
            let explicit = own.with_damping(DampingName::Explicit).ok();
            [own].into_iter().chain(explicit).flat_map(|method| {
                OrientationName::ALL.iter().map(move |name| method.with_orientation(*name))
            })
        })
    });
    all.filter(|method| method.check_built().is_ok())
}

#[test]
fn its_bits_are_those_of_the_kernel() {
    let scene = scene();
    let mut own = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
    let mut any = plant(&scene, &Method::default(), 1e-3).unwrap();
    for push in [0.0, 3.0] {
        own.set_input(InputIndex(0), push).unwrap();
        any.set(InputIndex(0), push, 0.0).unwrap();
        own.advance(100).unwrap();
        any.advance(99).unwrap();
        any.step().unwrap();
        assert_eq!(any.hash(), own.hash());
    }
    assert_eq!((any.steps(), any.time(), any.step_size()), (200, 0.2, 1e-3));
    assert_eq!(any.evaluations(), own.evaluations());
    let place = any.read(&scene.readout("place").unwrap()).and_then(Reading::vector);
    assert_eq!(place.map(|p| p.x), Some(own.state().bodies[0].position.x));
    let total = energy(&scene.model, own.state(), 1e-3).total();
    assert_eq!(any.energy().total().to_bits(), total.to_bits());
}

#[test]
fn every_method_goes_on_from_what_it_left_and_begins_again() {
    let scene = scene();
    for method in methods() {
        let mut one = plant(&scene, &method, 1e-3).unwrap();
        let start = one.hash();
        one.set(InputIndex(0), 1.0, 0.0).unwrap();
        one.advance(20).unwrap();
        let (bytes, state, hash) = (one.snapshot().unwrap(), one.state(), one.hash());
        let mut other = plant(&scene, &method, 1e-3).unwrap();
        other.restore(&bytes).unwrap();
        assert_eq!(other.hash(), one.hash(), "{method:?}");
        one.advance(20).unwrap();
        other.advance(20).unwrap();
        assert_eq!(other.hash(), one.hash(), "{method:?}");
        other.set_state(&state).unwrap();
        assert_eq!(other.steps(), 20);
        // Angles are converted to a quaternion and back, and rounded then; a word of fixed point has more digits than
        // a double, of which its position keeps 53.
        let is_quaternion = method.orientation() == OrientationName::Quaternion;
        if is_quaternion && method.precision() != PrecisionName::Fixed {
            assert_eq!(other.hash(), hash, "{method:?}");
        }
        assert_eq!(other.state().bodies[0].position, state.bodies[0].position, "{method:?}");
        one.reset();
        assert_eq!((one.hash(), one.steps(), one.evaluations()), (start, 0, 0));
        // Bytes of another method are refused.
        if method != Method::default() {
            assert!(plant(&scene, &Method::default(), 1e-3).unwrap().restore(&bytes).is_err());
        }
    }
}

#[test]
fn a_plant_can_be_sent_to_another_thread() {
    let mut plant = plant(&scene(), &Method::default(), 1e-3).unwrap();
    let done = std::thread::spawn(move || plant.advance(10).is_ok()).join();
    assert!(done.unwrap());
}

#[test]
fn what_cannot_be_stepped_is_refused() {
    let scene = scene();
    let single = Method::new(SchemeName::Rk4, None, PrecisionName::F32).unwrap();
    for (method, step) in [(Method::default(), 0.0), (Method::default(), f64::NAN), (single, 1e-60)]
    {
        let refused = plant(&scene, &method, step).map(|_| ());
        assert!(matches!(refused, Err(PlantError::Step { .. })), "{step}");
    }
    let huge = SCENE.replace("axis = [1, 0, 0]", "axis = [1, 0, 0]\nvalue = 1e300");
    let huge = Scene::parse(&huge, "huge.toml").unwrap();
    assert!(matches!(plant(&huge, &single, 1e-3).map(|_| ()), Err(PlantError::Input(_))));
    assert!(plant(&huge, &Method::default(), 1e-3).is_ok());
    let approximate = Method::new(SchemeName::Rk4, None, PrecisionName::F32Micromath).unwrap();
    let built = cfg!(feature = "comparison");
    assert_eq!(plant(&scene, &approximate, 1e-3).is_ok(), built);
}

#[test]
fn a_failure_latches_until_the_plant_is_reset() {
    let mut plant = plant(&scene(), &Method::default(), 1e3).unwrap();
    assert!(plant.advance(10_000).is_err());
    let steps = plant.steps();
    assert!(plant.step().is_err() && plant.steps() == steps);
    assert!(plant.snapshot().is_err());
    plant.reset();
    assert!(plant.status().is_ok());
}
