//! Laws against closed forms; in lists of const models and of scenes; what they remember.

use dbd_kernel::energy::energy;
use dbd_kernel::laws::{EndStop, Hinge, HingeStop};
use dbd_kernel::plant::PlantError;
use dbd_kernel::{
    BlanesMoanS6, Body, BodyIndex, BodyState, Dbd, Explicit, F32, F64, Fixed, GeneralizedAlpha,
    Geometry, JointWise, Leapfrog, Model, Pefrl, Planar64, Plant, Quaternion, Real, Rk4, Scheme,
    SemiImplicitEuler, Vec3,
};
use dbd_scene::{Scene, SceneModel, widen};

// The law that `host-sim new laws` writes.
#[path = "../../host-sim/templates/laws/drag.rs.in"]
mod drag;

fn scene(text: &str) -> Scene {
    Scene::parse(text, "laws.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A body of 1 kg that meets a stop at 1 m/s (`docs`: Hunt & Crossley).
fn impact() -> Scene {
    scene(
        r#"
        name = "impact"
        duration = 1
        [[body]]
        name = "ball"
        mass = 1
        inertia = [1, 1, 1]
        position = [0, 0.001, 0]
        velocity = [0, -1, 0]
        [[interaction]]
        law = "end-stop"
        between = ["world", "ball"]
        points = [[0, 0, 0], [0, 0, 0]]
        normal = [0, 1, 0]
        stiffness = 1e5
        dissipation = 0.6
        "#,
    )
}

/// A disc on a pivot with dry friction, driven by a torque.
fn disc(speed: f64, more: &str) -> Scene {
    scene(&format!(
        r#"
        name = "disc"
        duration = 1
        step = "50us"
        [[body]]
        name = "disc"
        mass = 1
        inertia = [0.01, 0.01, 0.01]
        position = [0, 0, 0]
        angular_velocity = [0, 0, {speed}]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "disc"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        stiffness = "1 MN/m"
        span = 0.05
        [[interaction]]
        name = "rub"
        law = "hinge-friction"
        between = ["world", "disc"]
        axis = [0, 0, 1]
        coulomb = 0.5
        breakaway = 0.5
        give = "0.5 mrad"
        damping = 2
        [[input]]
        name = "drive"
        type = "joint_torque"
        target = "pivot"
        {more}
        "#
    ))
}

/// ELEMENTS' figures from Lambert's W: penetration and rebound of a stop with k = 1e5 N/m and a = 0.6 s/m.
#[test]
fn a_ball_rebounds_as_hunt_and_crossley_say() {
    let model = impact().model;
    let mut off = Vec::new();
    for step in [4e-4, 2e-4, 1e-4, 5e-5] {
        let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
        let mut deepest: f64 = 0.0;
        let begin = energy(&model, plant.state(), step).total();
        while plant.time() < 0.03 {
            plant.step().unwrap();
            deepest = deepest.min(plant.state().bodies[0].position.y);
            // A stop makes no energy but by the step's error, whose square it is.
            let grown = energy(&model, plant.state(), step).total() - begin;
            assert!(grown < 2e9 * step * step * 1e-3, "{step}: {grown:e} J");
        }
        let rebound = plant.state().bodies[0].velocity.y;
        assert!(
            (deepest + 2.687_381_736_5e-3).abs() < 8.0 * step * step * 1e3,
            "{step}: {deepest}"
        );
        off.push((rebound - 0.711_950_179_6).abs());
    }
    assert!(off[0] < 1e-2 && off[3] < 3e-4, "{off:?}");
    assert!(off[3] < off[0] / 8.0, "{off:?}");
}

/// The same in single precision, in fixed point, and by schemes of other orders; dampers are explicit, sweeps, or part
/// of a matrix.
#[test]
fn every_scheme_and_precision_has_stops() {
    fn rebound<P: Geometry, S: Scheme>(scheme: S) -> f64 {
        let model: SceneModel<P> = impact().model.convert();
        let model = if S::Storage::MATRIX { model.planned() } else { model };
        let mut plant = Plant::new(&model, scheme, 5e-5).unwrap();
        plant.advance(600).unwrap();
        widen(plant.state()).bodies[0].velocity.y
    }
    use dbd_kernel::keep::Storage as _;
    let near = |what: &str, rebound: f64| {
        assert!((rebound - 0.711_950_18).abs() < 2e-3, "{what}: {rebound}");
    };
    near("f32", rebound::<F32, _>(Leapfrog));
    near("fixed", rebound::<Fixed, _>(Leapfrog));
    near("joint-wise", rebound::<F64, _>(JointWise(Leapfrog)));
    near("explicit", rebound::<F64, _>(Explicit(Leapfrog)));
    near("pefrl", rebound::<F64, _>(Pefrl));
    near("blanes-moan", rebound::<F64, _>(BlanesMoanS6));
    near("rk4", rebound::<F64, _>(Rk4));
    near("dbd", rebound::<F64, _>(Dbd::default()));
    near("generalized-alpha", rebound::<F64, _>(GeneralizedAlpha::default()));
    // Of first order.
    let euler = rebound::<F64, _>(SemiImplicitEuler);
    assert!((euler - 0.712).abs() < 2e-2, "{euler}");
}

/// A list in a const model has the bits of the same laws in a scene.
#[test]
fn a_const_model_has_the_bits_of_the_scene() {
    fn bits<P: Geometry>() -> [u64; 2] {
        let exact = impact().model;
        let of_scene: SceneModel<P> = exact.convert();
        let world = [BodyIndex::WORLD, BodyIndex(0)];
        let zero = P::local_from_f64([0.0; 3]);
        let stop = EndStop {
            bodies: world,
            points: [zero; 2],
            normal: dbd_kernel::space::Linear::from_f64([0.0, 1.0, 0.0]),
            from: P::Real::ZERO,
            to: P::Real::from_f64(1e30),
            stiffness: P::Real::from_f64(1e5),
            dissipation: P::Real::from_f64(0.6),
        };
        // As many sums as bodies, where the precision has any: there is a damper.
        let model: Model<P, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, ([EndStop<P>; 1],)> =
            Model {
                bodies: [Body::convert(&exact.bodies[0])],
                initial: [BodyState::convert(&exact.initial[0])],
                gravity: [],
                groups: [],
                points: [],
                tsdas: [],
                bushings: [],
                dampers: [],
                torsions: [],
                loads: [],
                lines: [],
                inputs: [],
                knots: [],
                clearances: [],
                revolutes: [],
                universals: [],
                sources: [],
                laws: ([stop],),
            };
        let model = model.checked();
        let mut listed = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        let mut heap = Plant::new(&of_scene, Leapfrog, 1e-4).unwrap();
        assert_eq!(listed.fingerprint(), heap.fingerprint());
        listed.advance(300).unwrap();
        heap.advance(300).unwrap();
        [listed.hash(), heap.hash()]
    }
    for [listed, heap] in [bits::<F64>(), bits::<F32>(), bits::<Fixed>(), bits::<Planar64>()] {
        assert_eq!(listed, heap);
    }
}

/// Coulomb friction stops a disc after ω·J/M, which then stays.
#[test]
fn friction_stops_a_disc_and_holds_it() {
    for (name, stop) in
        [("f64", held::<F64>(4.0)), ("f32", held::<F32>(4.0)), ("fixed", held::<Fixed>(4.0))]
    {
        let [angle, rate] = stop;
        // ω²·J/(2·M) = 0.16 rad, and what it gives.
        assert!((angle - 0.16).abs() < 2e-3, "{name}: {angle}");
        // In single precision the last digit of an angle of 0.16 rad pulls at its give.
        let digits = if name == "f64" { 1e-6 } else { 5e-4 };
        assert!(rate.abs() < digits, "{name}: {rate:e}");
    }
}

/// Angle and rate of the disc after 2 s.
fn held<P: Geometry>(speed: f64) -> [f64; 2] {
    let scene = disc(speed, "");
    let model: SceneModel<P> = scene.model.convert();
    let mut plant = Plant::new(&model, Leapfrog, 5e-5).unwrap();
    plant.advance(40_000).unwrap();
    let state = widen(plant.state()).bodies[0];
    let q = state.orientation;
    [2.0 * q.v.z.atan2(q.w), state.angular_velocity.z]
}

/// Held below its breakaway torque it gives a little and never creeps; a snapshot goes on with the same bits.
#[test]
fn what_sticks_does_not_creep_and_goes_on_from_a_snapshot() {
    let scene = disc(0.0, "");
    let model: SceneModel<F32> = scene.model.convert();
    let mut plant = Plant::new(&model, Leapfrog, 5e-5).unwrap();
    let drive = scene.inputs[0].index;
    let turn = |plant: &Plant<&SceneModel<F32>, Leapfrog>| {
        let q = plant.state().bodies[0].orientation;
        2.0 * f64::from(q.v.z).atan2(f64::from(q.w))
    };
    // A torque that comes at once would overshoot its limit.
    for part in 1..=4_000 {
        plant.set_input(drive, 1e-4 * f64::from(part)).unwrap();
        plant.step().unwrap();
    }
    plant.advance(20_000).unwrap();
    let early = turn(&plant);
    plant.advance(100_000).unwrap();
    let before = turn(&plant);
    assert!((before - 0.4e-3).abs() < 2e-5, "{before:e}");
    assert!((before - early).abs() < 1e-6, "{before:e} {early:e}");
    let mut bytes = vec![0; plant.snapshot_size()];
    let size = plant.snapshot(&mut bytes).unwrap();
    let mut other = Plant::new(&model, Leapfrog, 5e-5).unwrap();
    other.restore(&bytes[..size]).unwrap();
    for plant in [&mut plant, &mut other] {
        plant.set_input(drive, -0.45).unwrap();
        plant.advance(100_000).unwrap();
        plant.set_input(drive, 0.6).unwrap();
        plant.advance(500).unwrap();
        plant.set_input(drive, 0.0).unwrap();
        plant.advance(1_000).unwrap();
    }
    assert_eq!(plant.hash(), other.hash());
    // A snapshot of no memory is another model's.
    let bare = impact().model.convert::<F32>();
    let mut bare = Plant::new(&bare, Leapfrog, 5e-5).unwrap();
    assert!(bare.restore(&bytes[..size]).is_err());
}

/// A memory that steps bring on is refused where a scheme steps back or evaluates more than once per step.
#[test]
fn a_memory_is_refused_where_a_scheme_cannot_bring_it_on() {
    fn refused<S: Scheme>(scheme: S) -> bool {
        let model = disc(0.0, "").model;
        let refused = Plant::new(&model.planned(), scheme, 5e-5).map(|_| ());
        refused == Err(PlantError::Memory("hinge-friction"))
    }
    assert!(refused(Pefrl) && refused(BlanesMoanS6) && refused(Rk4) && refused(Dbd::default()));
    assert!(!refused(Leapfrog) && !refused(JointWise(Leapfrog)) && !refused(Explicit(Leapfrog)));
}

/// A pendulum in stops, in space and in the plane: the same motion, and the torque is along the gradient.
#[test]
fn a_stop_of_turns_holds_in_space_and_in_the_plane() {
    let text = disc(
        3.0,
        "[[interaction]]\nlaw = \"hinge-stop\"\nbetween = [\"world\", \"disc\"]\naxis = [0, 0, 1]\n\
         from = \"-20 deg\"\nto = \"5 deg\"\nstiffness = 500\ndissipation = 0.2",
    );
    let flat = dbd_scene::reduced(&text).unwrap();
    let mut spatial = Plant::new(&text.model, Leapfrog, 5e-5).unwrap();
    let model: SceneModel<Planar64> = flat.model.convert();
    let mut planar = Plant::new(&model, Leapfrog, 5e-5).unwrap();
    let mut most: f64 = 0.0;
    for _ in 0..200 {
        spatial.advance(10).unwrap();
        planar.advance(10).unwrap();
        let q = spatial.state().bodies[0].orientation;
        let z = planar.state().bodies[0].orientation.z;
        most = most.max(2.0 * q.v.z.atan2(q.w));
        assert!((q.v.z - z).abs() < 1e-6, "{} {z}", q.v.z);
    }
    // 5° and √(J/k)·ω of a stop that is hit at 3 rad/s at most.
    assert!(
        most > 5_f64.to_radians() && most < 5_f64.to_radians() + 3.0 * (0.01_f64 / 500.0).sqrt()
    );
}

/// A memory that only counts turns goes with schemes that step back in time, too.
#[test]
fn a_stop_of_turns_goes_with_every_scheme() {
    fn turned<S: Scheme>(scheme: S) -> f64 {
        let stop = "name = \"stop\"\nduration = 1\n[[body]]\nname = \"disc\"\nmass = 1\n\
                    inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\nangular_velocity = [0, 0, 3]\n\
                    [[interaction]]\nlaw = \"hinge-stop\"\nbetween = [\"world\", \"disc\"]\n\
                    axis = [0, 0, 1]\nfrom = -1\nto = 0.1\nstiffness = 100\n";
        let model = scene(stop).model.planned();
        let mut plant = Plant::new(&model, scheme, 1e-4).unwrap();
        plant.advance(1_000).unwrap();
        plant.state().bodies[0].angular_velocity.z
    }
    for rate in [turned(Pefrl), turned(BlanesMoanS6), turned(Rk4), turned(Leapfrog)] {
        assert!((rate + 3.0).abs() < 2e-2, "{rate}");
    }
}

/// A rope that becomes taut, spheres that touch and a slide at the upper end of its travel throw a ball back as a plane does.
#[test]
fn ropes_spheres_and_slides_rebound_as_planes_do() {
    fn rebound<P: Geometry>(position: f64, speed: f64, law: &str) -> f64 {
        let text = format!(
            "name = \"stop\"\nduration = 1\n[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [0, {position}, 0]\nvelocity = [0, {speed}, 0]\n[[interaction]]\nstiffness = 1e5\n\
             dissipation = 0.6\nbetween = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n{law}"
        );
        let model: SceneModel<P> = scene(&text).model.convert();
        let mut plant = Plant::new(&model, Leapfrog, 1e-5).unwrap();
        plant.advance(3_000).unwrap();
        widen(plant.state()).bodies[0].velocity.y / -speed
    }
    let rope = "law = \"distance-stop\"\nto = 1.2\n";
    let spheres = "law = \"distance-stop\"\nfrom = 0.3\n";
    let slide = "law = \"end-stop\"\nnormal = [0, 1, 0]\nfrom = -1\nto = 0.4\n";
    for (position, speed, law) in
        [(1.199, 1.0, rope), (0.301, -1.0, spheres), (0.399, 1.0, slide), (-0.999, -1.0, slide)]
    {
        for found in [
            rebound::<F64>(position, speed, law),
            rebound::<F32>(position, speed, law),
            rebound::<Fixed>(position, speed, law),
        ] {
            assert!((found - 0.711_950_18).abs() < 2e-3, "{law}: {found}");
        }
    }
    // Within its length a rope does nothing, and points that may not meet do not meet.
    assert_eq!(rebound::<F64>(0.5, 1e-3, rope), -1.0);
    let stuck = "name = \"s\"\nduration = 1\n[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\n\
                 position = [0, 0, 0]\n[[interaction]]\nlaw = \"distance-stop\"\nfrom = 0.1\nstiffness = 1\n\
                 between = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n";
    let model = scene(stuck).model;
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    assert!(plant.step().is_err());
}

/// A mass on a spring that rubs on its slide: each half swing is shorter by 2·F/k, and the eighth does not begin.
#[test]
fn friction_of_a_slide_ends_a_swing_and_holds() {
    fn swing<P: Geometry>() -> [f64; 2] {
        let text = r#"
        name = "slide"
        duration = 2
        [[body]]
        name = "block"
        mass = 1
        inertia = [1, 1, 1]
        position = [-0.145, 0, 0]
        [[tsda]]
        between = ["world", "block"]
        points = [[-1, 0, 0], [0, 0, 0]]
        stiffness = 1000
        free_length = 1
        [[interaction]]
        law = "slide-friction"
        between = ["world", "block"]
        points = [[0, 0, 0], [0, 0, 0]]
        axis = [1, 0, 0]
        coulomb = 10
        breakaway = 10
        give = 1e-4
        damping = 100
        "#;
        let model: SceneModel<P> = scene(text).model.convert();
        let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        plant.advance(20_000).unwrap();
        let state = widen(plant.state());
        [state.bodies[0].position.x, state.bodies[0].velocity.x]
    }
    for (name, [x, rate]) in
        [("f64", swing::<F64>()), ("f32", swing::<F32>()), ("fixed", swing::<Fixed>())]
    {
        // Within 3·F over the stiffness of its give.
        assert!((x - 0.005).abs() < 3e-4, "{name}: {x}");
        let digits = if name == "f64" { 1e-9 } else { 1e-4 };
        assert!(rate.abs() < digits, "{name}: {rate:e}");
    }
}

/// Ten turns on, a stop is where it was.
#[test]
fn a_stop_counts_whole_turns() {
    let hinge = Hinge { axis: Vec3::new(0.0, 0.0, 1.0), reference: Quaternion::IDENTITY };
    let stop = HingeStop {
        bodies: [BodyIndex::WORLD, BodyIndex(0)],
        axis: hinge,
        from: -1.0,
        to: 20.0 * core::f64::consts::PI,
        stiffness: 100.0,
        dissipation: 0.0,
    };
    let spin = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 5.0]);
    let model: Model<F64, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, ([HingeStop; 1],)> =
        Model {
            bodies: [Body::from_f64(1.0, [0.01; 3])],
            initial: [spin],
            gravity: [],
            groups: [],
            points: [],
            tsdas: [],
            bushings: [],
            dampers: [],
            torsions: [],
            loads: [],
            lines: [],
            inputs: [],
            knots: [],
            clearances: [],
            revolutes: [],
            universals: [],
            sources: [],
            laws: ([stop],),
        };
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let mut turned = 0.0;
    let mut most: f64 = 0.0;
    for _ in 0..20_000 {
        plant.step().unwrap();
        turned += 1e-3 * plant.state().bodies[0].angular_velocity.z;
        most = most.max(turned);
    }
    // ω·√(J/k) beyond the ten turns, and back.
    let beyond = 20.0 * core::f64::consts::PI + 5.0 * 0.01;
    assert!((most - beyond).abs() < 5e-3, "{most} {beyond}");
    assert!((plant.state().bodies[0].angular_velocity.z + 5.0).abs() < 2e-2);
}

/// v = v∞·tanh(g·t/v∞): a law of one's own, known to scenes by its name.
#[test]
fn a_law_of_ones_own_falls_as_drag_does() {
    dbd_scene::laws::register::<drag::Drag>("my_laws::Drag");
    let coefficient = 9.81 / (14.007_141_0 * 14.007_141_0);
    let text = format!(
        "name = \"fall\"\nduration = 2\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"ball\"\nmass = 1\n\
         inertia = [1, 1, 1]\nposition = [0, 0, 0]\n[[interaction]]\nlaw = \"drag\"\n\
         between = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\ncoefficient = {coefficient}\n"
    );
    let scene = scene(&text);
    let mut plant = Plant::new(&scene.model, Leapfrog, 1e-4).unwrap();
    plant.advance(20_000).unwrap();
    let exact = 14.007_141_0 * (9.81 * 2.0 / 14.007_141_0_f64).tanh();
    let speed = -plant.state().bodies[0].velocity.y;
    assert!((speed - exact).abs() < 1e-3, "{speed} {exact}");
    let source = dbd_scene::laws::known_law("drag").unwrap();
    assert_eq!((source.path.as_str(), source.fields.len()), ("my_laws::Drag", 2));
    // A law that nobody knows is refused with those that are known.
    let error = Scene::parse(&text.replace("\"drag\"", "\"dragg\""), "fall.toml").unwrap_err();
    assert!(error.message().contains("names no law"), "{error}");
    assert!(error.help().contains("\"drag\"") && error.help().contains("new laws"), "{error}");
}
