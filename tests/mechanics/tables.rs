//! Springs and dampers by tables against closed forms and a fine integration of their own.

use dbd_kernel::energy::energy;
use dbd_kernel::{
    Explicit, F32, F64, Fixed, GeneralizedAlpha, Geometry, JointWise, Leapfrog, Pefrl, Planar64,
    Plant, Rk4, Scheme,
};
use dbd_scene::{Scene, SceneModel, widen};

fn scene(text: &str) -> Scene {
    Scene::parse(text, "tables.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A body of 5 kg on the y axis above a point at the origin.
fn falling(position: f64, speed: f64, gravity: f64, law: &str) -> Scene {
    scene(&format!(
        "name = \"tables\"\nduration = 1\ngravity = [0, {gravity}, 0]\n[[body]]\nname = \"mass\"\nmass = 5\n\
         inertia = [0.1, 0.1, 0.1]\nposition = [0, {position}, 0]\nvelocity = [0, {speed}, 0]\n\
         [[interaction]]\nname = \"law\"\nbetween = [\"world\", \"mass\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n{law}\n"
    ))
}

/// A progressive bump stop of 0.5 m: compression alone.
const BUMP: &str = "law = \"distance-spring\"\nfree_length = 0.5\n\
                    force = [[\"-60 mm\", -2400], [\"-20 mm\", -400], [0, 0], [\"1 mm\", 0]]";

/// What falls by 0.1 m on the stop goes as deep as the area under the table says, and leaves as fast as it came.
#[test]
fn a_bump_stop_throws_back_what_falls_on_it() {
    // m·g·(0.1 + x) = 4 + 400·(x − 0.02) + 25,000·(x − 0.02)².
    let (weight, fall) = (5.0 * 9.81, 0.1);
    let square: f64 = (400.0 - weight) * (400.0 - weight) + 1e5 * (weight * (fall + 0.02) - 4.0);
    let depth = 0.02 + (weight - 400.0 + square.sqrt()) / 5e4;
    fn run<P: Geometry, S: Scheme>(scheme: S) -> [f64; 2] {
        use dbd_kernel::keep::Storage as _;
        let model: SceneModel<P> = falling(0.6, 0.0, -9.81, BUMP).model.convert();
        let model = if S::Storage::MATRIX { model.planned() } else { model };
        let mut plant = Plant::new(&model, scheme, 1e-4).unwrap();
        let mut least: f64 = 1.0;
        while plant.time() < 0.3 {
            plant.step().unwrap();
            least = least.min(widen(plant.state()).bodies[0].position.y);
        }
        while widen(plant.state()).bodies[0].position.y < 0.5 {
            plant.step().unwrap();
        }
        let state = widen(plant.state()).bodies[0];
        let height = state.position.y + state.velocity.y * state.velocity.y / 19.62;
        [0.5 - least, height]
    }
    let all = [
        ("f64", run::<F64, _>(Leapfrog)),
        ("f32", run::<F32, _>(Leapfrog)),
        ("fixed", run::<Fixed, _>(Leapfrog)),
        ("pefrl", run::<F64, _>(Pefrl)),
        ("rk4", run::<F64, _>(Rk4)),
    ];
    for (name, [deepest, height]) in all {
        assert!((deepest - depth).abs() < 2e-5, "{name}: {deepest} of {depth}");
        assert!((height - 0.6).abs() < 2e-4, "{name}: {height}");
    }
    let [deepest, height] = run::<F64, _>(GeneralizedAlpha::default());
    assert!((deepest - depth).abs() < 2e-4 && (height - 0.6).abs() < 5e-3, "{deepest} {height}");
}

/// A digressive damper, other in bump than in rebound.
const DIGRESSIVE: &str = "law = \"distance-damper\"\n\
                          force = [[-1, -300], [-0.2, -150], [0, 0], [0.1, 400], [1, 700]]";

/// Velocity after 0.1 s by small steps of its own.
fn braked(mut v: f64, push: f64) -> f64 {
    let force = |v: f64| match v {
        v if v < -0.2 => -150.0 + (v + 0.2) * 187.5,
        v if v < 0.0 => v * 750.0,
        v if v < 0.1 => v * 4000.0,
        v => 400.0 + (v - 0.1) * (1000.0 / 3.0),
    };
    let (n, rate) = (100_000, |v: f64| (push - force(v)) / 5.0);
    let h = 0.1 / f64::from(n);
    for _ in 0..n {
        let middle = v + 0.5 * h * rate(v);
        v += h * rate(middle);
    }
    v
}

/// A mass that the damper brakes, by sweeps of order 2; and at coefficients at which an explicit step fails.
#[test]
fn a_digressive_damper_brakes_as_its_table_says() {
    fn velocity<P: Geometry, S: Scheme>(scheme: S, step: f64, [v, push]: [f64; 2]) -> f64 {
        use dbd_kernel::keep::Storage as _;
        let model: SceneModel<P> = falling(1.0, v, push / 5.0, DIGRESSIVE).model.convert();
        let model = if S::Storage::MATRIX { model.planned() } else { model };
        let mut plant = Plant::new(&model, scheme, step).unwrap();
        plant.advance((0.1 / step).round() as u64).unwrap();
        widen(plant.state()).bodies[0].velocity.y
    }
    for case in [[2.0, 0.0], [-2.0, 0.0], [0.0, 600.0], [1.0, -300.0]] {
        let exact = braked(case[0], case[1]);
        let off = |step| (velocity::<F64, _>(Leapfrog, step, case) - exact).abs();
        let (wide, narrow) = (off(2e-3), off(2.5e-4));
        // Order 2 but where the rate goes past a knot.
        assert!(wide < 2e-2 && narrow < 5e-4, "{case:?}: {wide:e} {narrow:e}");
        for (name, found) in [
            ("f32", velocity::<F32, _>(Leapfrog, 2.5e-4, case)),
            ("fixed", velocity::<Fixed, _>(Leapfrog, 2.5e-4, case)),
            ("joint-wise", velocity::<F64, _>(JointWise(Leapfrog), 2.5e-4, case)),
            ("explicit", velocity::<F64, _>(Explicit(Leapfrog), 2.5e-4, case)),
            ("generalized-alpha", velocity::<F64, _>(GeneralizedAlpha::default(), 2.5e-4, case)),
        ] {
            assert!((found - exact).abs() < 5e-3, "{name} {case:?}: {found} {exact}");
        }
    }
}

/// However strong it is beside the mass and the step, a damper only brakes.
#[test]
fn no_damper_turns_a_rate_around() {
    for scale in [1e2, 1e5, 1e9] {
        let law = format!(
            "law = \"distance-damper\"\nforce = [[-1, -{scale}], [-0.01, -{scale}], [0, 0], [0.01, {scale}], [1, {scale}]]"
        );
        for speed in [1e-3, 0.5, 20.0, -1e-3, -0.5] {
            let scene = falling(2.0, speed, 0.0, &law);
            let mut plant = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
            let mut last: f64 = speed.abs();
            for _ in 0..40 {
                plant.step().unwrap();
                let v = plant.state().bodies[0].velocity.y * speed.signum();
                assert!(
                    (-1e-12..=last * (1.0 + 1e-12)).contains(&v),
                    "{scale} {speed}: {v} after {last}"
                );
                last = v;
            }
        }
    }
}

/// A disc with a table of torque over angle and one of torque over rate, in space and in the plane.
#[test]
fn tables_about_an_axis_hold_in_space_and_in_the_plane() {
    let text = |rate: &str| {
        format!(
            "name = \"disc\"\nduration = 1\n[[body]]\nname = \"disc\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n\
             position = [0, 0, 0]\nangular_velocity = [0, 0, 8]\n[[interaction]]\nlaw = \"hinge-spring\"\n\
             between = [\"world\", \"disc\"]\naxis = [0, 0, 1]\n\
             torque = [[\"-1 deg\", 0], [0, 0], [\"180 deg\", 0], [\"540 deg\", 3]]\n{rate}"
        )
    };
    // ½·J·ω² against the area beyond half a turn: 0.32 J = ½·k·x², k = 3/(2·π).
    let free = scene(&text(""));
    let mut plant = Plant::new(&free.model, Leapfrog, 1e-4).unwrap();
    let begin = energy(&free.model, plant.state(), 1e-4).total();
    let mut angle = 0.0;
    let mut most: f64 = 0.0;
    for _ in 0..30_000 {
        plant.step().unwrap();
        angle += 1e-4 * plant.state().bodies[0].angular_velocity.z;
        most = most.max(angle);
        let now = energy(&free.model, plant.state(), 1e-4).total();
        assert!((now - begin).abs() < 1e-5 * begin, "{now} {begin}");
    }
    let beyond = (2.0 * 0.32 * std::f64::consts::TAU / 3.0).sqrt();
    assert!((most - std::f64::consts::PI - beyond).abs() < 2e-3, "{most}");
    let rate = "[[interaction]]\nlaw = \"hinge-damper\"\nbetween = [\"world\", \"disc\"]\naxis = [0, 0, 1]\n\
                torque = [[-10, -0.2], [-1, -0.1], [0, 0], [1, 0.02], [10, 0.1]]\n";
    let damped = scene(&text(rate));
    let mut spatial = Plant::new(&damped.model, Leapfrog, 1e-4).unwrap();
    let flat: SceneModel<Planar64> = dbd_scene::reduced(&damped).unwrap().model.convert();
    let mut planar = Plant::new(&flat, Leapfrog, 1e-4).unwrap();
    spatial.advance(10_000).unwrap();
    planar.advance(10_000).unwrap();
    let [space, plane] = [
        spatial.state().bodies[0].angular_velocity.z,
        widen(planar.state()).bodies[0].angular_velocity.z,
    ];
    assert!((space - plane).abs() < 1e-6 && space.abs() < 6.0, "{space} {plane}");
}

/// A table that falls, or a damper's that is not 0 at rest, is refused where it stands.
#[test]
fn tables_that_make_energy_are_refused() {
    for (law, says) in [
        ("law = \"distance-spring\"\nforce = [[0, 0], [0.1, 5], [0.2, 4]]", "decreases"),
        ("law = \"distance-damper\"\nforce = [[-1, 3], [0, 0], [1, 5]]", "decreases"),
        ("law = \"distance-damper\"\nforce = [[-1, -3], [1, 5]]", "is not 0 at rest"),
        ("law = \"distance-spring\"\nforce = [[0, 0]]", "has 1 knots"),
        (
            "law = \"distance-spring\"\nforce = [[0, 0], [0, 1]]",
            "not above that of the knot before",
        ),
    ] {
        let text = format!(
            "name = \"t\"\nduration = 1\n[[body]]\nname = \"m\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 1, 0]\n\
             [[interaction]]\nbetween = [\"world\", \"m\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n{law}\n"
        );
        let error = Scene::parse(&text, "t.toml").unwrap_err();
        let said = error.to_string();
        assert!(said.contains(says), "{law}: {said}");
    }
}
