//! A sphere on a plane against closed forms: it rolls, slides, sticks, bounces.

use dbd_kernel::energy::energy;
use dbd_kernel::plant::PlantError;
use dbd_kernel::{
    Explicit, F32, F64, Fixed, GeneralizedAlpha, Geometry, JointWise, Leapfrog, Pefrl, Planar32,
    Planar64, Plant, Scheme, SemiImplicitEuler,
};
use dbd_scene::{Scene, SceneModel, widen};

const G: f64 = 9.81;

fn scene(text: &str) -> Scene {
    Scene::parse(text, "contact.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A disc of 1 kg, radius 0.1 m, at rest on a plane that gravity leans over by an angle \[rad\].
fn disc(axis_error: f64, start: &str, contact: &str) -> Scene {
    let (sin, cos) = axis_error.sin_cos();
    let depth = G * cos / 1e5;
    scene(&format!(
        "name = \"disc\"\nduration = 1\ngravity = [{}, {}, 0]\n[[body]]\nname = \"disc\"\nmass = 1\n\
         inertia = [0.005, 0.005, 0.005]\nposition = [0, {}, 0]\n{start}\n[[interaction]]\nname = \"ground\"\n\
         law = \"plane-contact\"\nbetween = [\"world\", \"disc\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         normal = [0, 1, 0]\nradius = 0.1\nstiffness = 1e5\ndissipation = 1\n{contact}\n",
        G * sin,
        -G * cos,
        0.1 - depth,
    ))
}

/// Place along the plane, velocity along it, rate about z after a time.
fn after<P: Geometry, S: Scheme>(scene: &Scene, scheme: S, step: f64, time: f64) -> [f64; 3] {
    use dbd_kernel::keep::Storage as _;
    let model: SceneModel<P> = scene.model.convert();
    let model = if S::Storage::MATRIX { model.planned() } else { model };
    let mut plant = Plant::new(&model, scheme, step).unwrap();
    plant.advance((time / step).round() as u64).unwrap();
    let state = widen(plant.state()).bodies[0];
    [state.position.x, state.velocity.x, state.angular_velocity.z]
}

/// On a slope of 30° a disc rolls with g·sin/(1 + I/(m·r²)), slides with g·(sin − μ·cos) where friction is too small.
#[test]
fn a_disc_rolls_or_slides_down_a_slope() {
    let axis_error = 30_f64.to_radians();
    let rolls = disc(axis_error, "", "friction = 0.5\ndamping = 50");
    let slides = disc(axis_error, "", "friction = 0.15");
    let (rolling, sliding) = (3.27, G * (axis_error.sin() - 0.15 * axis_error.cos()));
    fn both<P: Geometry>(rolls: &Scene, slides: &Scene, scheme: impl Scheme) -> [[f64; 3]; 2] {
        [after::<P, _>(rolls, scheme, 1e-4, 1.0), after::<P, _>(slides, scheme, 1e-4, 1.0)]
    }
    let cases = [
        ("f64", both::<F64>(&rolls, &slides, Leapfrog)),
        ("f32", both::<F32>(&rolls, &slides, Leapfrog)),
        ("fixed", both::<Fixed>(&rolls, &slides, Leapfrog)),
        ("joint-wise", both::<F64>(&rolls, &slides, JointWise(Leapfrog))),
        ("explicit", both::<F64>(&rolls, &slides, Explicit(Leapfrog))),
        ("euler", both::<F64>(&rolls, &slides, SemiImplicitEuler)),
        ("generalized-alpha", both::<F64>(&rolls, &slides, GeneralizedAlpha::default())),
    ];
    for (name, [[_, v, spin], [_, u, turn]]) in cases {
        assert!((v - rolling).abs() < 5e-3 && (u - sliding).abs() < 5e-3, "{name}: {v} {u}");
        // The depth shortens the lever: v = −ω·(r − depth).
        assert!((v + spin * 0.1).abs() < 3e-3, "{name}: slips with {} m/s", v + spin * 0.1);
        // μ·N·r over the inertia: 25.5 rad/s² of spin, but while friction comes on at first.
        let spun = 0.15 * G * axis_error.cos() * 0.1 / 0.005;
        assert!((turn + spun).abs() < 0.1, "{name}: {turn} rad/s, not {spun}");
    }
}

/// The same in the plane, in both precisions.
#[test]
fn a_plane_has_the_same_motion() {
    let axis_error = 30_f64.to_radians();
    for contact in ["friction = 0.5\ndamping = 50\nrolling = 1e-3", "friction = 0.15"] {
        let space = disc(axis_error, "", contact);
        let flat = dbd_scene::reduced(&space).unwrap();
        let spatial = after::<F64, _>(&space, Leapfrog, 1e-4, 0.5);
        let double: SceneModel<Planar64> = flat.model.convert();
        let mut double = Plant::new(&double, Leapfrog, 1e-4).unwrap();
        double.advance(5_000).unwrap();
        let single: SceneModel<Planar32> = flat.model.convert();
        let mut single = Plant::new(&single, Leapfrog, 1e-4).unwrap();
        single.advance(5_000).unwrap();
        let [x, v, spin] = spatial;
        let of_double = widen(double.state()).bodies[0];
        let of_single = widen(single.state()).bodies[0];
        for (state, near) in [(of_double, 1e-6), (of_single, 1e-3)] {
            assert!((state.position.x - x).abs() < near, "{contact}: {} {x}", state.position.x);
            assert!((state.velocity.x - v).abs() < near, "{contact}: {} {v}", state.velocity.x);
            let rate = state.angular_velocity.z;
            assert!((rate - spin).abs() < 10.0 * near, "{contact}: {rate} {spin}");
        }
    }
}

/// A disc with backspin slides until it rolls: with the lever l, the radius less the depth, after (v + ω·l)/(μ·g·(1 + m·l²/I)).
#[test]
fn backspin_ends_where_rolling_begins() {
    let start = "velocity = [2, 0, 0]\nangular_velocity = [0, 0, 30]";
    let thrown = disc(0.0, start, "friction = 0.2\ndamping = 50");
    let (lever, braking) = (0.1 - G / 1e5, 0.2 * G);
    let ends = (2.0 + 30.0 * lever) / (braking * (1.0 + lever * lever / 0.005));
    // 0.8494733 s and 1/3 m/s of a disc that does not sink in.
    assert!((ends - 0.849_473_3).abs() < 1e-3, "{ends}");
    let [_, v, spin] = after::<F64, _>(&thrown, Leapfrog, 1e-4, ends - 0.01);
    assert!((v + lever * spin - 0.01 * braking * 3.0).abs() < 2e-3, "it slides still: {v} {spin}");
    let [_, v, spin] = after::<F64, _>(&thrown, Leapfrog, 1e-4, 1.0);
    assert!((v - (2.0 - braking * ends)).abs() < 2e-5, "{v}");
    assert!((v + lever * spin).abs() < 2e-5, "{v} {spin}");
    let [.., before] = after::<F64, _>(&thrown, Leapfrog, 1e-4, 2.0);
    let [.., later] = after::<F64, _>(&thrown, Leapfrog, 1e-4, 4.0);
    assert!((later / before - 1.0).abs() < 1e-6, "rolling costs nothing: {before} {later}");
}

/// Rolling resistance ρ·N slows a disc by ρ·g/r/(1 + I/(m·r²)), and then it stays.
#[test]
fn rolling_resistance_stops_a_disc() {
    let start = "velocity = [0.5, 0, 0]\nangular_velocity = [0, 0, -5]";
    let braked = disc(0.0, start, "friction = 0.5\ndamping = 50\nrolling = \"2 mm\"");
    let slowing = 0.002 * G / 0.1 / 1.5;
    let [_, v, _] = after::<F64, _>(&braked, Leapfrog, 1e-4, 2.0);
    assert!((v - (0.5 - 2.0 * slowing)).abs() < 2e-3, "{v}");
    let [x, ..] = after::<F64, _>(&braked, Leapfrog, 1e-4, 6.0);
    let [rest, v, _] = after::<F64, _>(&braked, Leapfrog, 1e-4, 8.0);
    assert!((x - 0.25 / (2.0 * slowing)).abs() < 1e-2, "{x}");
    assert!((rest - x).abs() < 1e-6 && v.abs() < 1e-4, "{x} {rest} {v}");
}

/// A plate on four points of its corners, on a slope.
fn plate(axis_error: f64, friction: f64) -> Scene {
    let (sin, cos) = axis_error.sin_cos();
    let mut text = format!(
        "name = \"plate\"\nduration = 1\ngravity = [{}, {}, 0]\n[[body]]\nname = \"plate\"\nmass = 2\n\
         inertia = [0.01, 0.02, 0.01]\nposition = [0, {}, 0]\n",
        G * sin,
        -G * cos,
        0.02 - 2.0 * G * cos / 4e5
    );
    for (x, z) in [(-0.1, -0.1), (0.1, -0.1), (-0.1, 0.1), (0.1, 0.1)] {
        text += &format!(
            "[[interaction]]\nlaw = \"plane-contact\"\nbetween = [\"world\", \"plate\"]\n\
             points = [[0, 0, 0], [{x}, -0.02, {z}]]\nnormal = [0, 1, 0]\nstiffness = 1e5\ndissipation = 2\n\
             friction = {friction}\ndamping = 50\n"
        );
    }
    scene(&text)
}

/// Four feet hold a plate on a slope of 20° with μ = 0.5 for ever; with μ = 0.2 it slides with g·(sin − μ·cos).
#[test]
fn feet_stick_without_creep_and_slide() {
    let axis_error = 20_f64.to_radians();
    fn creep<P: Geometry>(scene: &Scene) -> f64 {
        let model: SceneModel<P> = scene.model.convert();
        let mut plant = Plant::new(&model, Leapfrog, 2e-4).unwrap();
        plant.advance(5_000).unwrap();
        let early = widen(plant.state()).bodies[0].position.x;
        plant.advance(100_000).unwrap();
        widen(plant.state()).bodies[0].position.x - early
    }
    let held = plate(axis_error, 0.5);
    let all = [
        ("f64", creep::<F64>(&held), 1e-9),
        ("f32", creep::<F32>(&held), 1e-7),
        ("fixed", creep::<Fixed>(&held), 1e-7),
    ];
    for (name, creep, most) in all {
        assert!(creep.abs() < most, "{name}: {creep:e} m in 20 s");
    }
    let [_, v, _] = after::<F64, _>(&plate(axis_error, 0.2), Leapfrog, 2e-4, 1.0);
    let slides = G * (axis_error.sin() - 0.2 * axis_error.cos());
    assert!((v - slides).abs() < 1e-2, "{v} {slides}");
}

/// A snapshot of a disc that rolls goes on with the same bits.
#[test]
fn a_contact_goes_on_from_a_snapshot() {
    let scene =
        disc(0.3, "angular_velocity = [1, 2, 3]", "friction = 0.4\ndamping = 20\nrolling = 1e-3");
    let model: SceneModel<F32> = scene.model.convert();
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    plant.advance(3_000).unwrap();
    let mut bytes = vec![0; plant.snapshot_size()];
    let size = plant.snapshot(&mut bytes).unwrap();
    let mut other = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    other.restore(&bytes[..size]).unwrap();
    plant.advance(3_000).unwrap();
    other.advance(3_000).unwrap();
    assert_eq!(plant.hash(), other.hash());
}

/// A ball that spins and bounces: no step makes energy but by its error, and friction takes its share.
#[test]
fn a_bouncing_ball_with_spin_makes_no_energy() {
    let text = "name = \"ball\"\nduration = 1\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"ball\"\nmass = 0.5\n\
                inertia = [2e-4, 2e-4, 2e-4]\nposition = [0, 0.3, 0]\nvelocity = [1, 0, 0.5]\n\
                angular_velocity = [20, 30, -40]\n[[interaction]]\nlaw = \"plane-contact\"\n\
                between = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nnormal = [0, 1, 0]\n\
                radius = 0.03\nstiffness = 2e4\ndissipation = 0.2\nfriction = 0.3\ndamping = 2\nrolling = 1e-3\n";
    let model = scene(text).model;
    let step = 2e-5;
    let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
    let begin = energy(&model, plant.state(), step).total();
    let mut least = begin;
    for _ in 0..1_500 {
        plant.advance(100).unwrap();
        let now = energy(&model, plant.state(), step).total();
        assert!(now < least + 2e-5 * begin, "{now} after {least} J");
        least = least.min(now);
    }
    assert!(least < 0.6 * begin, "{least} of {begin} J");
    let refused = Plant::new(&model, Pefrl, step).map(|_| ());
    assert_eq!(refused, Err(PlantError::Memory("plane-contact")));
}
