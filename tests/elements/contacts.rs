//! The laws `wheel-contact` and `sphere-contact` against closed forms.

use dbd_kernel::{F32, Leapfrog, Plant};
use dbd_scene::{Scene, SceneModel};

use crate::values::{Case, at};
use crate::{instance, value};

const G: f64 = 9.81;

/// \[N\] stiffnesses of the tyre on the rig, along and across, and what its friction can bear.
const ALONG: f64 = 8e4;
const ACROSS: f64 = 5e4;
const LIMIT: f64 = 0.9 * LOAD;
const LOAD: f64 = 4000.0;

/// A wheel of radius 0.3 m so heavy that its motion stays: 10 m/s of rolling, and a slip along and across.
fn rig([along, across]: [f64; 2], more: &str) -> String {
    let lever = 0.3 - LOAD / 2e5;
    format!(
        "name = \"rig\"\nduration = 1\ngravity = [0, 0, 0]\n[[body]]\nname = \"wheel\"\nmass = 1e12\n\
         inertia = [1e12, 1e12, 1e12]\nposition = [0, 0, {lever}]\nvelocity = [{}, {}, 0]\n\
         angular_velocity = [0, {}, 0]\n[[interaction]]\nname = \"tyre\"\nlaw = \"wheel-contact\"\n\
         between = [\"world\", \"wheel\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nnormal = [0, 0, 1]\n\
         axis = [0, 1, 0]\nradius = 0.3\ntread = 0.05\nstiffness = 2e5\nfriction = 0.9\n\
         slip_stiffness = {ALONG}\ncornering_stiffness = {ACROSS}\n{more}\n{}",
        10.0 * (1.0 + along),
        10.0 * across,
        10.0 / lever,
        readouts("tyre", &["force", "force_along", "force_across", "slip_along", "slip_across"]),
    )
}

fn readouts(target: &str, quantities: &[&str]) -> String {
    let each = |quantity: &&str| {
        format!(
            "[[readout]]\nname = \"{quantity}\"\ntype = \"interaction\"\ntarget = \"{target}\"\n\
             quantity = \"{quantity}\"\n"
        )
    };
    quantities.iter().map(each).collect()
}

/// A text with another value of the first line of a key.
fn with(text: &str, key: &str, value: &str) -> String {
    let from = text.find(&format!("\n{key} = ")).unwrap() + 1;
    let to = from + text[from..].find('\n').unwrap();
    format!("{}{key} = {value}{}", &text[..from], &text[to..])
}

/// \[N\] on the wheel along and across: `μ·N·(3y − 3y² + y³)` against the slip, weighted by the stiffnesses.
fn brush([along, across]: [f64; 2]) -> [f64; 2] {
    let (a, b) = (ALONG * along, ACROSS * across);
    let y = (a.hypot(b) / (3.0 * LIMIT)).min(1.0);
    [a, b].map(|part| -part / a.hypot(b) * LIMIT * y * (3.0 - y * (3.0 - y)))
}

/// The brush's force at slips to both sides, along, across and of both, whatever the damping.
#[test]
fn a_tyre_has_the_brush_force() {
    let slips = [0.002, 0.01, 0.03, 0.08, 0.125, 0.3];
    let pure = slips.iter().flat_map(|s| [[*s, 0.0], [-s, 0.0], [0.0, *s], [0.0, -s]]);
    for slip in pure.chain([[0.02, 0.03], [-0.05, 0.04], [0.01, -0.12]]) {
        for (precision, step, near) in [("f64", 5e-5, 2e-5), ("f32", 2e-4, 5e-3)] {
            for damping in ["", "damping = 500"] {
                let mut run = instance(&rig(slip, damping), step, precision);
                run.advance_to(0.8).unwrap();
                let names = ["force_along", "force_across"];
                for (name, exact) in names.into_iter().zip(brush(slip)) {
                    let found = value(&run, name);
                    let off = (found - exact).abs() / LIMIT;
                    assert!(off < near, "{precision} {slip:?} {name}: {found} {exact}");
                }
                for (name, exact) in ["slip_along", "slip_across"].into_iter().zip(slip) {
                    let found = value(&run, name);
                    assert!((found - exact).abs() < 2e-4, "{precision} {name}: {found} {exact}");
                }
            }
        }
    }
}

/// Sliding much faster than it rolls, the force is opposite to the slip: a locked wheel thrown askew.
#[test]
fn a_locked_wheel_slides_against_its_velocity() {
    let locked = with(&rig([0.2, 0.4], ""), "angular_velocity", "[0, 0, 0]");
    let mut run = instance(&locked, 2e-4, "f64");
    run.advance_to(0.2).unwrap();
    let size = 12.0_f64.hypot(4.0);
    for (name, part) in [("force_along", 12.0), ("force_across", 4.0)] {
        let (found, exact) = (value(&run, name), -LIMIT * part / size);
        assert!((found - exact).abs() < 1e-4 * LIMIT, "{name}: {found} {exact}");
    }
}

/// A sledge of 400 kg on four locked wheels, on a slope of 20°, with 0.9 of friction; 15° askew.
fn sledge() -> String {
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let mut text = format!(
        "name = \"sledge\"\nduration = 1\ngravity = [{}, 0, {}]\n[[body]]\nname = \"sledge\"\nmass = 400\n\
         inertia = [40, 80, 100]\nposition = [0, 0, {}]\n",
        G * sin,
        -G * cos,
        0.5 - 400.0 * G * cos / 8e5,
    );
    for (x, y) in [(-0.8, -0.5), (0.8, -0.5), (-0.8, 0.5), (0.8, 0.5)] {
        text += &format!(
            "[[interaction]]\nlaw = \"wheel-contact\"\nbetween = [\"world\", \"sledge\"]\n\
             points = [[0, 0, 0], [{x}, {y}, -0.2]]\nnormal = [0, 0, 1]\naxis = [-0.26, 0.97, 0]\nradius = 0.3\n\
             tread = 0.05\nstiffness = 2e5\ndissipation = 1\nfriction = 0.9\nslip_stiffness = 3e4\n\
             cornering_stiffness = 2e4\ndamping = 1500\n"
        );
    }
    text
}

/// A car of 300 kg in its plane, its two wheels held by brakes of 500 N·m, on a slope or thrown.
fn car(slope: f64, speed: f64, brake: f64) -> String {
    let (sin, cos) = slope.to_radians().sin_cos();
    let (x, y) = (G * sin, -G * cos);
    let height = 0.3 - 170.0 * G * cos / 1e5;
    let mut text = format!(
        "name = \"car\"\nduration = 1\nplanar = true\ngravity = [{x}, {y}, 0]\n[[body]]\nname = \"chassis\"\n\
         mass = 300\ninertia = [30, 90, 90]\nposition = [0, {}, 0]\nvelocity = [{speed}, 0, 0]\n",
        height + 0.2
    );
    for (name, x) in [("rear", -1.0), ("front", 1.0)] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = 20\ninertia = [0.8, 0.8, 0.8]\nposition = [{x}, {height}, 0]\n\
             velocity = [{speed}, 0, 0]\nangular_velocity = [0, 0, {}]\n[[joint]]\nname = \"{name}_hub\"\n\
             type = \"revolute\"\nbetween = [\"chassis\", \"{name}\"]\nat = [{x}, {height}, 0]\naxis = [0, 0, 1]\n\
             span = 0.1\nstiffness = \"1 MN/m\"\ndamping_ratio = 0.3\nfrequency = \"40 Hz\"\n\
             friction = {{ coulomb = {brake}, give = \"1 mrad\", damping = 100 }}\n[[interaction]]\n\
             name = \"{name}_tyre\"\nlaw = \"wheel-contact\"\nbetween = [\"world\", \"{name}\"]\n\
             points = [[0, 0, 0], [0, 0, 0]]\nnormal = [0, 1, 0]\naxis = [0, 0, -1]\nradius = 0.3\n\
             stiffness = 1e5\ndissipation = 1\nfriction = 0.9\nslip_stiffness = 3e4\ndamping = 4000\n",
            -speed / height
        );
    }
    text
}

/// How far a body has moved \[m\] in 1e5 steps after it has come to rest.
fn creep(text: &str, precision: &str, name: &str) -> f64 {
    let mut run = instance(text, 2e-4, precision);
    run.advance_to(6.0).unwrap();
    let early = value(&run, name);
    run.advance(100_000).unwrap();
    value(&run, name) - early
}

/// Parked wheels hold for ever: locked ones in space, and braked ones behind hubs.
#[test]
fn a_parked_vehicle_does_not_creep() {
    for (precision, most) in [("f64", 1e-9), ("f32", 1e-6), ("fixed", 1e-6)] {
        for name in ["sledge.x", "sledge.y"] {
            let moved = creep(&sledge(), precision, name);
            assert!(moved.abs() < most, "{precision}: {name} {moved:e} m in 20 s");
        }
        if precision != "fixed" {
            let moved = creep(&car(15.0, 0.0, 500.0), precision, "chassis.x");
            assert!(moved.abs() < most, "{precision}: {moved:e} m in 20 s");
        }
    }
}

/// Brakes of 100 N·m slow the car by 2·T/r over its mass with that of its wheels, and then it rests without rocking.
#[test]
fn a_braked_car_comes_to_rest() {
    let mut run = instance(&car(0.0, 5.0, 100.0), 2e-4, "f64");
    run.advance_to(1.0).unwrap();
    let lever: f64 = 0.3 - 170.0 * G / 1e5;
    let slowing = 2.0 * 100.0 / lever / (340.0 + 2.0 * 0.8 / (lever * lever));
    let speed = value(&run, "chassis.vx");
    assert!((speed - (5.0 - slowing)).abs() < 0.02 * slowing, "{speed} {slowing}");
    run.advance_to((5.0 / slowing + 2.0).round()).unwrap();
    for name in ["chassis.vx", "front.wz", "rear.wz"] {
        assert!(value(&run, name).abs() < 1e-4, "{name}: {}", value(&run, name));
    }
}

/// A disc of 1 kg, radius 0.1 m, on a plane that gravity leans over.
fn disc(slope: f64, start: &str, contact: &str) -> String {
    let (sin, cos) = slope.sin_cos();
    format!(
        "name = \"disc\"\nduration = 1\ngravity = [{}, {}, 0]\n[[body]]\nname = \"disc\"\nmass = 1\n\
         inertia = [0.005, 0.005, 0.005]\nposition = [0, {}, 0]\n{start}\n[[interaction]]\nname = \"tyre\"\n\
         law = \"wheel-contact\"\nbetween = [\"world\", \"disc\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         normal = [0, 1, 0]\naxis = [0, 0, -1]\nradius = 0.1\nstiffness = 1e6\ndissipation = 1\n\
         slip_stiffness = 100\n{contact}\n",
        G * sin,
        -G * cos,
        0.1 - G * cos / 1e6,
    )
}

/// \[m/s²\] of the disc: with the slip s, `a·(1 + 1/(2·(1 + s))) = g·sin`, and the brush has the force `a/(2·(1 + s))`.
fn rolls(slope: f64, friction: f64) -> f64 {
    let (sin, cos) = slope.sin_cos();
    let limit = friction * G * cos;
    let (mut least, mut most) = (0.0, 1.0);
    for _ in 0..60 {
        let slip = 0.5 * (least + most);
        let y: f64 = (100.0 * slip / (3.0 * limit)).min(1.0);
        let needed = G * sin / (2.0 * (1.0 + slip) + 1.0);
        if limit * y * (3.0 - y * (3.0 - y)) < needed { least = slip } else { most = slip }
    }
    G * sin / (1.0 + 0.5 / (1.0 + least))
}

/// In its plane and in space the same, in every precision.
#[test]
fn a_planar_contact_is_the_spatial_one() {
    let wheel =
        disc(0.3, "angular_velocity = [0, 0, 20]", "friction = 0.5\ndamping = 50\nrolling = 1e-3");
    let spheres = spheres([1.0, 3.0], "rolling = 1e-3\ndamping = 30");
    for (text, time, names) in [
        (wheel, 0.5, ["disc.x", "disc.vx", "disc.wz"]),
        (spheres, 0.02, ["second.y", "second.vy", "second.wz"]),
    ] {
        let flat = text.replacen("duration", "planar = true\nduration", 1);
        for (precision, near) in [("f64", 1e-9), ("f32", 2e-3)] {
            let run = |text: &str| {
                let mut plant = instance(text, 2e-5, precision);
                plant.advance_to(time).unwrap();
                names.map(|name| value(&plant, name))
            };
            for ((space, plane), name) in run(&text).into_iter().zip(run(&flat)).zip(names) {
                let off = (space - plane).abs() / (1.0 + space.abs());
                assert!(off < near, "{precision} {name}: {space} {plane}");
            }
        }
    }
}

/// The axle is given at the pose of `[[body]]`, and a body that starts turned takes it along: a slip angle.
#[test]
fn an_axle_moves_with_its_body() {
    let angle = 0.05_f64;
    let (sin, cos) = angle.sin_cos();
    // The rolling is about the turned axle, the velocity along x.
    let text = with(&rig([0.0, 0.0], ""), "velocity", &format!("[{}, 0, 0]", 10.0 / cos));
    let rolling = text.find("angular_velocity").unwrap();
    let rate = text[rolling..].lines().next().unwrap().to_owned();
    let text = text.replace(&rate, "");
    let turned = format!(
        "{text}[start.wheel]\nvelocity = [{}, 0, 0]\n{rate}\n\
         orientation = {{ axis = [0, 0, 1], angle = {angle} }}\n",
        10.0 / cos
    );
    let mut run = instance(&turned, 5e-5, "f64");
    run.advance_to(0.8).unwrap();
    let exact = brush([0.0, -sin / cos]);
    for (name, exact) in ["force_along", "force_across"].into_iter().zip(exact) {
        let found = value(&run, name);
        assert!((found - exact).abs() < 2e-5 * LIMIT, "{name}: {found} {exact}");
    }
}

/// Two balls of radius 1 m and given masses: the first hits the second at 2 m/s, 0.5 m/s beside.
fn spheres([first, second]: [f64; 2], contact: &str) -> String {
    format!(
        "name = \"balls\"\nduration = 1\ngravity = [0, 0, 0]\n[[body]]\nname = \"first\"\nmass = {first}\n\
         inertia = [{a}, {a}, {a}]\nposition = [-1.000001, 0, 0]\nvelocity = [2, 0.5, 0]\n[[body]]\n\
         name = \"second\"\nmass = {second}\ninertia = [{b}, {b}, {b}]\nposition = [1, 0, 0]\n[[interaction]]\n\
         name = \"contact\"\nlaw = \"sphere-contact\"\nbetween = [\"first\", \"second\"]\n\
         points = [[0, 0, 0], [0, 0, 0]]\nfirst_radius = 1\nsecond_radius = 1\nstiffness = 1e10\n\
         friction = 0.02\n{contact}\n",
        a = 0.4 * first,
        b = 0.4 * second,
    )
}

/// A ball of radius 0.1 m at rest on a fixed one of 0.4 m, 0.2 rad beside its top.
fn perched(contact: &str) -> String {
    let (sin, cos) = 0.2_f64.sin_cos();
    let distance = 0.5 - G * cos / 1e7;
    format!(
        "name = \"perched\"\nduration = 3\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"ball\"\nmass = 1\n\
         inertia = [0.004, 0.004, 0.004]\nposition = [{}, {}, 0]\n[[interaction]]\nname = \"contact\"\n\
         law = \"sphere-contact\"\nbetween = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         first_radius = 0.4\nsecond_radius = 0.1\nstiffness = 1e7\ndissipation = 0.1\n{contact}\n{}",
        distance * sin,
        distance * cos,
        readouts("contact", &["force"]),
    )
}

/// The angle from the top \[rad\] where the ball leaves.
fn leaves(contact: &str, step: f64) -> f64 {
    let mut run = instance(&perched(contact), step, "f64");
    let force = run.output("force").unwrap();
    run.advance_to(0.1).unwrap();
    while run.value(force) > 0.0 {
        run.advance(1).unwrap();
    }
    let [x, y] = ["ball.x", "ball.y"].map(|name| value(&run, name));
    x.atan2(y)
}

/// A body of 2 kg on three points that stand on a ball of 1 m, 0.3 rad beside its top: it stays.
#[test]
fn feet_stand_on_a_ball_without_creep() {
    let (sin, cos) = 0.3_f64.sin_cos();
    let mut text = format!(
        "name = \"feet\"\nduration = 1\ngravity = [{}, 0, {}]\n[[body]]\nname = \"stool\"\nmass = 2\n\
         inertia = [0.02, 0.02, 0.02]\nposition = [0, 0, 1.02]\n",
        G * sin,
        -G * cos
    );
    let height = (1.0_f64 - 0.01).sqrt() - 1.02;
    for angle in [0.0_f64, 2.0, 4.0] {
        let (y, x) = angle.sin_cos();
        text += &format!(
            "[[interaction]]\nlaw = \"sphere-contact\"\nbetween = [\"world\", \"stool\"]\n\
             points = [[0, 0, 0], [{}, {}, {height}]]\nfirst_radius = 1\nsecond_radius = 0\nstiffness = 1e5\n\
             dissipation = 2\nfriction = 0.9\ndamping = 50\n",
            0.1 * x,
            0.1 * y
        );
    }
    for (precision, most) in [("f64", 1e-9), ("f32", 1e-6), ("fixed", 1e-6)] {
        for name in ["stool.x", "stool.y"] {
            let moved = creep(&text, precision, name);
            assert!(moved.abs() < most, "{precision}: {name} {moved:e} m in 20 s");
        }
    }
}

/// A snapshot in the middle of rolling, on a plane and on a ball, goes on with the same bits.
#[test]
fn contacts_go_on_from_a_snapshot() {
    let wheel =
        disc(0.3, "angular_velocity = [1, 2, 20]", "tread = 0.03\nfriction = 0.4\ndamping = 20");
    let ball = perched("friction = 0.4\ndamping = 20\nrolling = 1e-3");
    for text in [wheel, ball] {
        let scene = Scene::parse(&text, "snapshot.toml").unwrap();
        let model: SceneModel<F32> = scene.model.convert();
        let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        plant.advance(2_000).unwrap();
        let mut bytes = vec![0; plant.snapshot_size()];
        let size = plant.snapshot(&mut bytes).unwrap();
        let mut other = Plant::new(&model, Leapfrog, 1e-4).unwrap();
        other.restore(&bytes[..size]).unwrap();
        plant.advance(2_000).unwrap();
        other.advance(2_000).unwrap();
        assert_eq!(plant.hash(), other.hash());
    }
}

/// A wheel thrown spinning, that bounces, leans and falls on its side, gains no energy.
#[test]
fn a_tumbling_wheel_makes_no_energy() {
    let text = "name = \"hoop\"\nduration = 1\ngravity = [0, 0, -9.81]\n[[body]]\nname = \"hoop\"\nmass = 0.5\n\
                inertia = [1e-3, 2e-3, 1e-3]\nposition = [0, 0, 0.2]\nvelocity = [1, 0.5, 0]\n\
                angular_velocity = [3, 40, -2]\n[[interaction]]\nlaw = \"wheel-contact\"\n\
                between = [\"world\", \"hoop\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nnormal = [0, 0, 1]\n\
                axis = [0, 1, 0]\nradius = 0.08\ntread = 0.01\nstiffness = 2e4\ndissipation = 0.2\nfriction = 0.5\n\
                slip_stiffness = 200\ncornering_stiffness = 150\ndamping = 2\nrolling = 1e-3\n";
    let mut run = instance(text, 2e-5, "f64");
    let begin = value(&run, "energy.total");
    let mut least = begin;
    for _ in 0..2_000 {
        run.advance(100).unwrap();
        let now = value(&run, "energy.total");
        assert!(now < least + 5e-5 * begin, "{now} after {least} J");
        least = least.min(now);
    }
    assert!(least < 0.6 * begin, "{least} of {begin} J");
}

#[test]
fn constants_that_make_no_contact_are_refused() {
    let (wheel, ball) = (rig([0.0, 0.0], ""), perched("friction = 0.1"));
    for (text, from, to, why) in [
        (&wheel, "radius = 0.3", "radius = 0", "is not positive"),
        (&wheel, "tread = 0.05", "tread = 0.4", "is not within the radius"),
        (&wheel, "slip_stiffness = 80000", "slip_stiffness = 0", "is not positive"),
        (&wheel, "cornering_stiffness = 50000", "cornering_stiffness = -1", "is negative"),
        (&wheel, "friction = 0.9", "friction = -0.1", "is negative"),
        (&wheel, "axis = [0, 1, 0]\n", "", "axis"),
        (&wheel, "friction = 0.9\n", "", "friction"),
        (&ball, "first_radius = 0.4", "first_radius = -1", "is negative"),
        (
            &ball,
            "first_radius = 0.4\nsecond_radius = 0.1",
            "first_radius = 0\nsecond_radius = 0",
            "is 0 like",
        ),
        (&ball, "friction = 0.1", "shear = 0", "is not positive"),
    ] {
        assert!(text.contains(from), "{from}");
        let refused =
            Scene::parse(&text.replace(from, to), "contact.toml").unwrap_err().to_string();
        assert!(refused.contains(why), "{refused}: {to}");
    }
}

/// The rows of the table of `docs/elements.md`.
pub fn cases() -> Vec<Case> {
    let slope = 30_f64.to_radians();
    let backspin = "velocity = [2, 0, 0]\nangular_velocity = [0, 0, 30]";
    let lever = 0.1 - G / 1e6;
    let ends = (2.0 + 30.0 * lever) / (0.2 * G * (1.0 + lever * lever / 0.005));
    let case = |element, what, unit, exact, step, near, found: Box<dyn Fn(f64) -> f64>| Case {
        element,
        what,
        unit,
        exact,
        step,
        found,
        near,
    };
    let tyre = |slip, name: &'static str, what, exact| {
        let found = Box::new(move |h| at(&rig(slip, ""), h, 0.8, name));
        case("wheel-contact", what, "N", exact, 4e-4, 1e-4, found)
    };
    let angle = 3_f64.to_radians().tan();
    vec![
        tyre([0.03, 0.0], "force_along", "force along at a slip of 3 %", brush([0.03, 0.0])[0]),
        tyre(
            [0.0, angle],
            "force_across",
            "force across at a slip angle of 3°",
            brush([0.0, angle])[1],
        ),
        tyre([0.03, angle], "force_across", "force across at both", brush([0.03, angle])[1]),
        case(
            "wheel-contact",
            "speed after rolling 1 s on 30°, with slip",
            "m/s",
            rolls(slope, 0.5),
            1e-4,
            1e-3,
            Box::new(move |h| {
                at(&disc(slope, "", "friction = 0.5\ndamping = 100"), h, 1.0, "disc.vx")
            }),
        ),
        case(
            "wheel-contact",
            "speed after sliding 1 s on 30°, μ 0.15",
            "m/s",
            G * (slope.sin() - 0.15 * slope.cos()),
            1e-4,
            1e-3,
            Box::new(move |h| at(&disc(slope, "", "friction = 0.15"), h, 1.0, "disc.vx")),
        ),
        case(
            "wheel-contact",
            "speed after a backspin of 30 rad/s at 2 m/s, μ 0.2",
            "m/s",
            2.0 - 0.2 * G * ends,
            1e-4,
            1e-3,
            Box::new(move |h| {
                at(&disc(0.0, backspin, "friction = 0.2\ndamping = 100"), h, 3.0, "disc.vx")
            }),
        ),
        case(
            "sphere-contact",
            "speed after a central impact of 1 kg on 3 kg at 2 m/s",
            "m/s",
            1.0,
            4e-7,
            1e-3,
            Box::new(|h| {
                at(
                    &spheres([1.0, 3.0], "").replace("[2, 0.5, 0]", "[2, 0, 0]"),
                    h,
                    2e-4,
                    "second.vx",
                )
            }),
        ),
        case(
            "sphere-contact",
            "speed across an oblique impact, μ 0.02",
            "m/s",
            0.02 * 2.0 * 0.75 * 2.0 / 3.0,
            4e-7,
            2e-3,
            Box::new(|h| at(&spheres([1.0, 3.0], ""), h, 2e-4, "second.vy")),
        ),
        case(
            "sphere-contact",
            "angle from the top where a ball slides off a ball",
            "rad",
            (2.0 / 3.0 * 0.2_f64.cos()).acos(),
            8e-5,
            1e-3,
            Box::new(|h| leaves("", h)),
        ),
        case(
            "sphere-contact",
            "the same where it rolls, μ 20",
            "rad",
            (10.0 / 17.0 * 0.2_f64.cos()).acos(),
            8e-5,
            2e-3,
            Box::new(|h| leaves("friction = 20\ndamping = 100", h)),
        ),
    ]
}
