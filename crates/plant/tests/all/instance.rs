//! Instances against plain plants, and what they refuse.

use dbd_kernel::Vec3;
use dbd_plant::instance::linearisation::Probe;
use dbd_plant::instance::{Blueprint, Instance, InstanceError, LinearOptions, Settings};
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

fn path(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn of(name: &str, settings: Settings) -> Instance {
    Instance::new(Blueprint::load(path(name)).unwrap(), settings).unwrap()
}

fn cart() -> Instance {
    of("cart-pendulum", Settings::default())
}

#[test]
fn a_run_has_the_bits_of_a_plain_plant() {
    for (name, precision) in [("3ruu", None), ("cart-pendulum", Some("f32")), ("hexagon", None)] {
        let settings = Settings { precision: precision.map(str::to_owned), ..Settings::default() };
        let mut instance = of(name, settings.clone());
        let scene = Scene::load(path(name)).unwrap();
        let method: Method = settings.method().unwrap();
        let mut plain = plant(&scene, &method, instance.step_size()).unwrap();
        instance.advance_to(instance.step_size() * 500.0).unwrap();
        plain.advance(500).unwrap();
        assert_eq!(instance.hash(), plain.hash(), "{name}");
        let values = instance.values();
        assert_eq!(values.len() + 1, scene.columns().len());
        assert_eq!(values[..3], plain.state().bodies[0].position.to_f64());
        assert_eq!(values[7..10], plain.state().bodies[0].velocity.to_f64());
        let total = instance.output("energy.total").unwrap();
        assert_eq!(instance.value(total), plain.energy().total());
        // One by one as all together.
        for (row, value) in values.iter().enumerate() {
            assert_eq!(instance.value(row).to_bits(), value.to_bits());
        }
        let names: Vec<_> = instance.outputs().iter().map(|output| output.name.clone()).collect();
        assert_eq!(names, scene.columns()[1..]);
    }
}

#[test]
fn a_state_goes_on_in_another_instance_with_inputs_and_parameters() {
    let mut one = cart();
    let mass = one.parameters().unwrap().into_iter().find(|p| p.path.ends_with(".mass")).unwrap();
    assert_eq!(mass.unit, "kg");
    one.set_parameters([(mass.path.as_str(), mass.value * 1.5)]).unwrap();
    let now = one.parameters().unwrap().into_iter().find(|p| p.path == mass.path).unwrap();
    assert_eq!(now.value, mass.value * 1.5);
    one.set_input(0, 3.0).unwrap();
    one.advance(100).unwrap();
    let state = one.save().unwrap();
    one.advance(400).unwrap();

    let mut other = cart();
    other.restore(&state).unwrap();
    assert_eq!((other.input_value(0), other.plant().steps()), (Some(3.0), 100));
    let mut copy = other.duplicate().unwrap();
    for instance in [&mut other, &mut copy] {
        instance.advance(400).unwrap();
        assert_eq!(instance.hash(), one.hash());
        assert_eq!(instance.values(), one.values());
    }
    // Back in the same one.
    one.restore(&state).unwrap();
    one.advance(400).unwrap();
    assert_eq!(one.hash(), other.hash());
    // The parameter did change the run.
    let mut plain = cart();
    plain.set_input(0, 3.0).unwrap();
    plain.advance(500).unwrap();
    assert_ne!(plain.hash(), one.hash());
}

#[test]
fn damaged_and_foreign_states_change_nothing() {
    let mut one = cart();
    one.set_parameters([("body.cart.mass", 2.0)]).unwrap();
    one.advance(10).unwrap();
    let (state, hash) = (one.save().unwrap(), one.hash());
    for length in 0..state.len() {
        assert!(one.restore(&state[..length]).is_err());
    }
    for byte in 0..state.len() {
        let mut damaged = state.clone();
        damaged[byte] ^= 0x10;
        assert!(one.restore(&damaged).is_err(), "{byte}");
    }
    let foreign = of("four-bar", Settings::default()).save().unwrap();
    assert!(matches!(one.restore(&foreign), Err(InstanceError::State(_))));
    assert_eq!(one.hash(), hash);
    one.restore(&state).unwrap();
}

#[test]
fn times_are_whole_numbers_of_steps_within_a_hundredth() {
    let mut one = cart();
    let step = one.step_size();
    // As an importer adds them up.
    let mut time = 0.0;
    for _ in 0..1000 {
        time += 10.0 * step;
        one.advance_to(time).unwrap();
    }
    assert_eq!(one.plant().steps(), 10_000);
    for (time, message) in [
        (time + 0.5 * step, "is not a whole number of steps of"),
        (time - step, "cannot advance to"),
        (f64::NAN, "cannot advance to"),
        (f64::INFINITY, "cannot advance to"),
        (-1.0, "cannot advance to"),
    ] {
        let error = one.advance_to(time).unwrap_err().sentence();
        assert!(error.contains(message), "{error}");
    }
    assert_eq!(one.plant().steps(), 10_000);
}

#[test]
fn what_is_wrong_is_said_with_what_would_be_right() {
    let blueprint = |text: &str| Blueprint::new("bad.toml", text);
    let text = std::fs::read_to_string(path("cart-pendulum")).unwrap();
    let settings = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        settings
    };
    for (blueprint, settings, message) in [
        (blueprint("name = 3"), Settings::default(), "bad.toml:1:8: "),
        (blueprint(&text).with("body.cat.mass=1"), Settings::default(), "did you mean `cart`?"),
        (blueprint(&text), settings(|s| s.scheme = Some("euler".into())), "dbd, dbd-p1"),
        (blueprint(&text), settings(|s| s.step = Some(f64::NAN)), "step NaNs is not representable"),
        (blueprint(&text), settings(|s| s.newton = Some(2)), "has no Newton iterations"),
        (
            blueprint(&text),
            settings(|s| (s.scheme, s.damping) = (Some("rk4".into()), Some("sweeps".into()))),
            "does not support sweeps damping",
        ),
    ] {
        let error = Instance::new(blueprint, settings).err().unwrap().sentence();
        assert!(error.contains(message), "{error}");
    }
    let mut one = cart();
    for (error, message) in [
        (one.set_input(0, f64::NAN).unwrap_err(), "cannot take NaN"),
        (one.set_input(7, 0.0).unwrap_err(), "no input `number 7`"),
        (one.input("forse").unwrap_err(), "no input `forse`"),
        (one.output("cart.xx").unwrap_err(), "did you mean `cart."),
        (
            one.set_parameters([("body.cart.mass", f64::INFINITY)]).unwrap_err(),
            "cannot be set to inf",
        ),
        (one.set_parameters([("body.cart.mass", -1.0)]).unwrap_err(), "a finite number > 0 in kg"),
        (one.set_parameters([("body.cat.mass", 1.0)]).unwrap_err(), "did you mean `cart`?"),
    ] {
        assert!(error.sentence().contains(message), "{}", error.sentence());
    }
    assert!(Blueprint::load("nowhere.toml").is_err());
}

#[test]
fn a_failure_latches_and_names_the_body() {
    let mut one = of("four-bar", Settings { step: Some(0.1), ..Settings::default() });
    let error = one.advance(1000).unwrap_err().sentence();
    assert!(error.contains("body `") && error.contains("a shorter step"), "{error}");
    assert_eq!(one.advance(1).unwrap_err().sentence(), error);
    assert!(matches!(one.save(), Err(InstanceError::State(_))));
    one.reset();
    assert_eq!(one.plant().steps(), 0);
    one.save().unwrap();
}

/// A weight on a spring of 200 N/m, 1 m long and 0.9 m unstretched: stiffer along it than across.
const SPRING: &str = r#"
name = "spring"
duration = 1.0
step = "1 ms"
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, -1.0, 0]
[[tsda]]
between = ["world", "weight"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 200.0
damping = 3.0
free_length = 0.9
[[input]]
name = "push"
type = "force"
body = "weight"
axis = [0, 1, 0]
"#;

#[test]
fn a_spring_answers_to_small_changes_as_on_paper() {
    let spring = Instance::new(Blueprint::new("spring.toml", SPRING), Settings::default()).unwrap();
    let (push, height) = (spring.input("push").unwrap(), spring.output("weight.y").unwrap());
    let mut probe = Probe::new(&spring).unwrap();
    let all = probe.jacobians(&[push], &[height], 1e-4).unwrap();
    let near = |value: f64, exact: f64| {
        assert!((value - exact).abs() < 1e-6 * exact.abs().max(1.0), "{value} {exact}");
    };
    // Rows of the rates of the shift's rates: 6 + 0 across, 6 + 1 along.
    let a = |row: usize, column: usize| all.a[(row, column)];
    near(all.rate[7], 10.0);
    near(a(6, 0), -10.0);
    near(a(7, 1), -100.0);
    near(a(7, 7), -1.5);
    near(a(6, 6), 0.0);
    near(a(1, 7), 1.0);
    near(all.b[7], 0.5);
    near(all.c[1], 1.0);
    near(all.d[0], 0.0);
    // A turn about an axis changes with the rate about it, and by no force.
    near(a(3, 9), 1.0);
    near(a(9, 3), 0.0);
}

const STATES: [&str; 4] = ["cart_point.x", "angle", "cart_velocity.x", "rate"];

fn names(of: &[&str]) -> Vec<String> {
    of.iter().map(|&name| name.to_owned()).collect()
}

fn by_states() -> LinearOptions {
    LinearOptions { states: Some(names(&STATES)), ..LinearOptions::default() }
}

#[test]
fn inverse_dynamics_are_those_of_the_ideal_cart_and_pendulum() {
    // M, m, l, I, friction and g of the scene; turned by φ about z from upright, turning with w.
    let [cart_mass, mass, l, inertia, friction, g] = [0.94, 0.23, 0.33, 0.00788, 0.0024, 9.81];
    let lean = 5_f64.to_radians();
    for (turning, wanted) in [(0.0, 2.0), (3.0, -1.5)] {
        let mut instance = cart();
        let mut state = instance.plant().state();
        state.bodies[1].velocity = Vec3::new(-l * lean.cos(), -l * lean.sin(), 0.0) * turning;
        state.bodies[1].angular_velocity = Vec3::new(0.0, 0.0, turning);
        instance.plant_mut().set_state(&state).unwrap();
        instance.set_input(0, 4.0).unwrap();
        let before = instance.hash();
        let found =
            instance.inverse_dynamics(&by_states(), &[("cart_velocity.x".into(), wanted)]).unwrap();
        let moment = mass * l * lean.cos();
        let turn = (moment * wanted + mass * g * l * lean.sin() - friction * turning)
            / (inertia + mass * l * l);
        let force =
            (cart_mass + mass) * wanted - moment * turn + mass * l * lean.sin() * turning * turning;
        assert_eq!(found[0].0, "drive");
        assert!((found[0].1 - force).abs() < 2e-3 * force.abs(), "{found:?}, not {force}");
        assert_eq!(instance.hash(), before);
    }
}

#[test]
fn accelerations_that_inputs_cannot_give_are_refused() {
    let refused = |wanted: &[(&str, f64)], options: &LinearOptions| {
        let wanted: Vec<_> = wanted.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
        cart().inverse_dynamics(options, &wanted).unwrap_err().sentence()
    };
    let said = refused(&[("cart_velocity.x", 1.0), ("rate", 1.0)], &by_states());
    assert!(said.contains("drive cannot give `cart_velocity.x`, `rate` these"), "{said}");
    assert!(refused(&[("angle", 1.0)], &by_states()).contains("`angle` is a position"));
    assert!(refused(&[("rat", 1.0)], &by_states()).contains("did you mean `rate`?"));
    assert!(refused(&[("rate", f64::NAN)], &by_states()).contains("cannot be NaN"));
    let said = refused(&[("rate", 1.0)], &LinearOptions::default());
    assert!(
        said.contains("0 of the 0 states") && said.contains("a position and its rate"),
        "{said}"
    );
    let uneven = LinearOptions { states: Some(names(&STATES[..3])), ..LinearOptions::default() };
    assert!(refused(&[("cart_velocity.x", 1.0)], &uneven).contains("1 of the 3 states"));
}

#[test]
fn a_plant_settles_under_its_present_inputs() {
    let text = &SPRING.replace("[[body]]", "gravity = [0, -10, 0]\n[[body]]");
    let new = |text: &str| Instance::new(Blueprint::new("hung.toml", text), Settings::default());
    let mut hung = new(text).unwrap();
    hung.advance(100).unwrap();
    hung.set_input(0, 4.0).unwrap();
    hung.settle().unwrap();
    let at = |name: &str| hung.value(hung.output(name).unwrap());
    // 2 kg · 10 m/s² less 4 N on 200 N/m: 0.08 m below the end of the free spring.
    assert!((at("weight.y") + 0.98).abs() < 1e-9, "{}", at("weight.y"));
    assert_eq!([at("weight.vx"), at("weight.vy"), hung.time()], [0.0, 0.0, 0.1]);
    hung.advance(500).unwrap();
    assert!((hung.value(hung.output("weight.y").unwrap()) + 0.98).abs() < 1e-9);

    let mut free = new(&text.replace("stiffness = 200.0", "stiffness = 0.0")).unwrap();
    let before = free.hash();
    let said = free.settle().unwrap_err().sentence();
    assert!(said.contains("nothing holds `weight`") && said.contains("add a spring"), "{said}");
    assert_eq!(free.hash(), before);
}

#[test]
fn a_plane_s_plant_settles_too() {
    for planar in ["planar=true", "planar=false"] {
        let blueprint = Blueprint::load(path("cart-pendulum")).unwrap().with(planar);
        let mut instance = Instance::new(blueprint, Settings::default()).unwrap();
        instance.settle().unwrap();
        let at = |name: &str| instance.value(instance.output(name).unwrap());
        // The pendulum hangs below the cart, wherever that is.
        let [x, y] = [at("pendulum.x") - at("cart.x"), at("pendulum.y") - at("cart.y")];
        assert!(x.abs() < 1e-6 && (y + 0.33).abs() < 1e-4, "{planar}: {x} {y}");
    }
}
