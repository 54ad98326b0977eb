//! Sines, tables that repeat and tables over read-outs: against closed forms and other ways to say the same, in
//! every owner and precision.

use dbd_kernel::elements::input::{Input, InputKind};
use dbd_kernel::elements::source::Source;
use dbd_kernel::plant::InputError;
use dbd_kernel::{
    Body, F32, F64, Fixed, Geometry, InputIndex, Leapfrog, LoadFrame, Model, ModelOwner, Pefrl,
    Planar64, Plant, Rk4, Scheme, Vec3,
};
use dbd_scene::{Scene, SceneModel};
use dbd_study::reference::Mechanism;
use dbd_study::reference::reference_solution::{Integrator, integrate};
use dbd_study::reference::state::State;
use dbd_tests::at;

/// A cart of 2 kg on a spring of 50 N/m along x, with this input.
fn cart(input: &str) -> Scene {
    let text = format!(
        "name = \"cart\"\nduration = 1\n[[body]]\nname = \"cart\"\nmass = 2\ninertia = [0.1, 0.1, 0.1]\n\
         position = [0.25, 0, 0]\n[[tsda]]\nname = \"spring\"\nbetween = [\"world\", \"cart\"]\n\
         points = [[-1, 0, 0], [0, 0, 0]]\nstiffness = 50\nfree_length = 1\n\
         [[input]]\nname = \"push\"\n{input}\n\
         [[readout]]\nname = \"at\"\ntype = \"point\"\nbody = \"cart\"\n\
         [[readout]]\nname = \"speed\"\ntype = \"point_velocity\"\nbody = \"cart\"\n"
    );
    Scene::parse(&text, "cart.toml").unwrap_or_else(|e| panic!("{e}"))
}

const FORCE: &str = "type = \"force\"\nbody = \"cart\"\naxis = [1, 0, 0]\n";
const GROUND: &str = "type = \"anchor\"\ntarget = \"spring\"\naxis = [1, 0, 0]\n";

/// x \[m\] of the cart after a second.
fn end<S: Scheme>(scene: &Scene, scheme: S, step: f64) -> f64 {
    end_in::<F64, S>(scene, scheme, step)
}

fn end_in<P: Geometry, S: Scheme>(scene: &Scene, scheme: S, step: f64) -> f64 {
    let model: SceneModel<P> = scene.model.convert();
    let mut plant = Plant::new(&model, scheme, step).unwrap();
    plant.advance((1.0 / step).round() as u64).unwrap();
    P::position_to_f64(&plant.state().bodies[0].position)[0]
}

/// x after a second by an integrator of order 8 that has its own tables.
fn reference_solution(scene: &Scene) -> f64 {
    let (mechanism, start) = Mechanism::of(scene);
    let states: Vec<State> = integrate(Integrator::Dop853, &mechanism, &start, &[1.0]).unwrap();
    states[0].bodies[0].position.x
}

/// The error falls with the order of the scheme: the value at each stage is that of its time.
#[test]
fn a_sine_keeps_the_order_of_a_scheme() {
    for (kind, amplitude) in [(FORCE, 3.0), (GROUND, 0.05)] {
        let sine = format!(
            "sine = {{ amplitude = {amplitude}, frequency = 4, phase = \"40 deg\", offset = -0.02 }}"
        );
        let scene = cart(&format!("{kind}{sine}"));
        let exact = reference_solution(&scene);
        let order = |of: &dyn Fn(f64) -> f64| {
            let errors = [1.0 / 128.0, 1.0 / 256.0].map(|step| (of(step) - exact).abs());
            (errors[0] / errors[1]).log2()
        };
        let found = order(&|step| end(&scene, Leapfrog, step));
        assert!((found - 2.0).abs() < 0.2, "{kind} leapfrog: {found}");
        let found = order(&|step| end(&scene, Rk4, step));
        assert!((found - 4.0).abs() < 0.4, "{kind} rk4: {found}");
    }
}

#[test]
fn a_table_that_repeats_is_the_same_table_written_out() {
    let row = |time: f64, value: f64| format!("[{time:?}, {value:?}], ");
    let out: String = (0..10)
        .map(|i| 0.125 * f64::from(i))
        .map(|t| row(t, 2.0) + &row(t + 0.03125, -1.0))
        .collect();
    let short = "[[0, 2], [0.03125, -1], [0.125, 2]]";
    for (way, steps) in [("held", true), ("linear", false)] {
        let of = |table: &str, periodic: &str| {
            cart(&format!("{FORCE}table = {table}\ninterpolate = \"{way}\"\n{periodic}"))
        };
        let [repeated, written] = [of(short, "periodic = true"), of(&format!("[{out}]"), "")];
        for step in [1.0 / 128.0, 1.0 / 1000.0] {
            let [one, other] = [&repeated, &written].map(|scene| end(scene, Pefrl, step));
            let same = if steps { one == other } else { (one - other).abs() < 1e-12 };
            assert!(same, "{way} {step}: {one} {other}");
        }
        let far = (end(&repeated, Pefrl, 1.0 / 256.0) - reference_solution(&repeated)).abs();
        assert!(far < 1e-8, "{way}: {far}");
    }
    let saw = cart(&format!(
        "{FORCE}table = [[-1, 0], [0, 4]]\ninterpolate = \"linear\"\nperiodic = true\njump = true"
    ));
    let far = (end(&saw, Pefrl, 1.0 / 256.0) - reference_solution(&saw)).abs();
    assert!(far < 1e-8, "{far}");
}

/// Held over a step, a table over a read-out costs an error of the step's order; at half the step half.
#[test]
fn a_table_over_a_read_out_is_a_spring_or_a_damper() {
    let spring = "over = \"at.x\"\ninterpolate = \"linear\"\ntable = [[-2, 60], [2, -60]]";
    let brake = "over = \"speed.x\"\ninterpolate = \"linear\"\ntable = [[-9, 5], [0, 0], [9, -5]]";
    for table in [spring, brake] {
        let scene = cart(&format!("{FORCE}{table}"));
        let exact = reference_solution(&scene);
        let errors = [1e-3, 5e-4].map(|step| (end(&scene, Leapfrog, step) - exact).abs());
        let ratio = errors[0] / errors[1];
        assert!(errors[1] < 1e-3 && (ratio - 2.0).abs() < 0.2, "{table}: {errors:?}");
        let without = end(&cart(FORCE), Leapfrog, 1e-3);
        assert!((without - exact).abs() > 5e-3, "{table}: {without} {exact}");
    }
}

#[test]
fn every_precision_follows_and_a_snapshot_goes_on_with_the_same_bits() {
    let sources = [
        format!("{FORCE}sine = {{ amplitude = 3, frequency = 4, phase = 1 }}"),
        format!("{GROUND}sine = {{ amplitude = 0.02, frequency = 9 }}"),
        format!("{FORCE}table = [[0, 1], [0.1, -3], [0.3, 1]]\nperiodic = true"),
        format!("{FORCE}table = [[-1, 9], [1, -9]]\nover = \"at.x\"\ninterpolate = \"linear\""),
    ];
    for source in &sources {
        let scene = cart(source);
        let exact = end(&scene, Leapfrog, 1e-3);
        for near in
            [end_in::<F32, _>(&scene, Leapfrog, 1e-3), end_in::<Fixed, _>(&scene, Leapfrog, 1e-3)]
        {
            assert!((near - exact).abs() < 2e-5, "{source}: {near} {exact}");
        }
        let input = InputIndex(0);
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
        assert_eq!(plant.set_input(input, 1.0), Err(InputError::Table(input)));
        plant.advance(333).unwrap();
        let state = plant.state().clone();
        plant.advance(400).unwrap();
        let mut other = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
        assert_eq!(plant.fingerprint(), other.fingerprint(), "{source}");
        other.set_state(state).unwrap();
        other.advance(400).unwrap();
        assert_eq!(plant.hash(), other.hash(), "{source}");
        let free = cart(FORCE);
        let none = Plant::new(&free.model, Leapfrog, 1e-3).unwrap();
        assert_ne!(plant.fingerprint(), none.fingerprint(), "{source}");
    }
}

/// A model in flash that a sine pushes steps with the bits of the scene's.
#[test]
fn a_const_model_has_the_bits_of_the_scene() {
    let text = "name = \"free\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 2\ninertia = [0.5, 0.5, 0.5]\n\
                position = [0.25, 0, 0]\n[[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"b\"\n\
                axis = [1, 0, 0]\nsine = { amplitude = 3, frequency = 5, phase = 0.5, offset = 0.25 }\n";
    let scene = Scene::parse(text, "free.toml").unwrap_or_else(|e| panic!("{e}"));
    let direction = Vec3::new(1.0, 0.0, 0.0);
    let frame = LoadFrame::World;
    let kind =
        InputKind::Force { body: dbd_kernel::BodyIndex(0), point: Vec3::ZERO, direction, frame };
    let model: Model<F64, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1> = Model {
        bodies: [Body::from_f64(2.0, [0.5; 3])],
        initial: [at([0.25, 0.0, 0.0])],
        gravity: [],
        groups: [],
        points: [],
        tsdas: [],
        bushings: [],
        dampers: [],
        torsions: [],
        loads: [],
        lines: [],
        inputs: [Input {
            kind,
            value: 0.0,
            knot: 0,
            knots: 0,
            range: [-f64::INFINITY, f64::INFINITY],
        }],
        knots: [],
        clearances: [],
        revolutes: [],
        universals: [],
        sources: [Source::sine(InputIndex(0), [3.0, 5.0, 0.5, 0.25])],
        laws: (),
    }
    .checked();
    assert_eq!(model.view().sources, scene.model.sources);
    let mut flash = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let mut heap = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
    flash.advance(1000).unwrap();
    heap.advance(1000).unwrap();
    assert_eq!(flash.hash(), heap.hash());
    // x(1) = x0 + F̄·t²/2m + (A·cos φ/(m·ω))·t, as the sine ends where it began.
    let w = 10.0 * std::f64::consts::PI;
    let exact = 0.25 + 0.25 / 4.0 + 3.0 * 0.5_f64.cos() / (2.0 * w);
    let x = flash.state().bodies[0].position.x;
    assert!((x - exact).abs() < 1e-5, "{x} {exact}");
}

/// Kapitza 1951: a pendulum stands upside down where the amplitude of its pivot's velocity exceeds √(2·g·l); without,
/// it falls.
#[test]
fn a_pendulum_on_a_shaken_pivot_stands_upside_down() {
    let upright = |amplitude: f64| {
        let text = format!(
            "name = \"kapitza\"\nduration = 2\nplanar = true\ngravity = [0, -9.81, 0]\n\
             [[body]]\nname = \"rod\"\nmass = 1\ninertia = [1e-3, 1e-3, 1e-3]\nposition = [0.01, 0.2, 0]\n\
             [[joint]]\nname = \"pivot\"\ntype = \"revolute\"\nbetween = [\"world\", \"rod\"]\nat = [0, 0, 0]\n\
             axis = [0, 0, 1]\nspan = 0.1\nstiffness = 2e6\n\
             [[input]]\nname = \"shake\"\ntype = \"anchor\"\ntarget = \"pivot\"\naxis = [0, 1, 0]\n\
             sine = {{ amplitude = {amplitude}, frequency = 50, phase = \"90 deg\", offset = -{amplitude} }}\n"
        );
        let scene = Scene::parse(&text, "kapitza.toml").unwrap_or_else(|e| panic!("{e}"));
        let model: SceneModel<Planar64> = scene.stepped().convert();
        let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        (0..2000).all(|_| {
            plant.advance(10).unwrap();
            let state = &scene.planar.as_ref().unwrap();
            let mut world = dbd_scene::widen(plant.state());
            state.states_outward(&mut world.bodies);
            world.bodies[0].position.y > 0.15
        })
    };
    // The velocity's amplitude is 314·a; √(2·9.81·0.2) = 1.98 m/s.
    assert!(upright(0.015) && !upright(0.001));
}

/// In a plane that is not that of x and y a column is still the world's.
#[test]
fn a_column_of_a_planar_scene_is_the_worlds() {
    let text = |planar: bool| {
        format!(
            "name = \"slide\"\nduration = 1\nplanar = {planar}\n[[body]]\nname = \"b\"\nmass = 2\n\
             inertia = [1, 1, 1]\nposition = [0, 0.5, 0.75]\n\
             [[tsda]]\nbetween = [\"world\", \"b\"]\npoints = [[0, 0.5, 2], [0, 0, 0]]\nstiffness = 9\nfree_length = 1\n\
             [[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"b\"\naxis = [0, 0, 1]\nover = \"at.z\"\n\
             interpolate = \"linear\"\ntable = [[0, 4], [1, -4]]\n\
             [[readout]]\nname = \"at\"\ntype = \"point\"\nbody = \"b\"\n"
        )
    };
    let read = |planar| Scene::parse(&text(planar), "slide.toml").unwrap_or_else(|e| panic!("{e}"));
    let (flat, whole) = (read(true), read(false));
    let model: SceneModel<Planar64> = flat.stepped().convert();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(1000).unwrap();
    let mut world = dbd_scene::widen(plant.state());
    flat.planar.as_ref().unwrap().states_outward(&mut world.bodies);
    let flat = world.bodies[0].position.z;
    let mut plant = Plant::new(&whole.model, Leapfrog, 1e-3).unwrap();
    plant.advance(1000).unwrap();
    let whole = plant.state().bodies[0].position.z;
    assert!((flat - whole).abs() < 1e-9 && (whole - 0.75).abs() > 0.02, "{flat} {whole}");
}
