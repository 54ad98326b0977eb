//! The laws `bushing-curves`, `bushing-matrix` and `bushing-maxwell` against closed forms and other methods.

use dbd_plant::instance::{Instance, LinearOptions, Settings};
use nalgebra::{Matrix3, Matrix6, Rotation3, SymmetricEigen, Unit, Vector3, Vector6};

use crate::relaxing::{TIME, body, decayed, soft};
use crate::values::{Case, at, mass};
use crate::{instance, relaxing, value};

/// The axes of the bushing, world.
const AXES: [[f64; 3]; 3] = [[0.6, 0.0, 0.8], [0.0, -1.0, 0.0], [0.8, 0.0, -0.6]];
const INERTIA: [f64; 3] = [0.05, 0.04, 0.07];
const MASS: f64 = 2.0;

/// The rotation of the body at t = 0.
fn turned() -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, 2.0, 2.0)), 0.7)
}

/// A body on a bushing with tilted axes at `arm` \[m\] from its centre of mass, its axes.
fn mounted(arm: [f64; 3], start: &str, law: &str) -> String {
    let [x, y, z] = (turned() * Vector3::from(arm) + Vector3::new(0.3, 0.2, 0.1)).into();
    format!(
        "name = \"mount\"\nduration = 1\n[[body]]\nname = \"engine\"\nmass = {MASS}\ninertia = {INERTIA:?}\n\
         position = [0.3, 0.2, 0.1]\norientation = {{ axis = [1, 2, 2], angle = 0.7 }}\n{start}\n\
         [[interaction]]\nname = \"mount\"\nbetween = [\"world\", \"engine\"]\npoints = [[{x}, {y}, {z}], {arm:?}]\n\
         x = {:?}\nz = {:?}\n{law}\n",
        AXES[0], AXES[2]
    )
}

/// A full matrix: 160 kN/m and 144 N·m/rad and less on its diagonal.
fn full() -> Matrix6<f64> {
    let size = [400.0, 200.0, 300.0, 12.0, 5.0, 8.0];
    let g = Matrix6::from_fn(|i, j| {
        let (row, column) = (i as f64, j as f64);
        f64::from(i == j) + 0.25 * (1.0 + 3.0 * row + 7.0 * column).sin()
    });
    let product = g * g.transpose();
    Matrix6::from_fn(|i, j| size[i] * product[(i.max(j), i.min(j))] * size[j])
}

fn rows(matrix: &Matrix6<f64>) -> Vec<Vec<f64>> {
    (0..6).map(|i| (0..6).map(|j| matrix[(i, j)]).collect()).collect()
}

fn by_matrix(more: &str) -> String {
    format!("law = \"bushing-matrix\"\nmatrix = {:?}\n{more}", rows(&full()))
}

const ARM: [f64; 3] = [0.03, -0.02, 0.05];

/// \[rad²/s²\] squares of the frequencies: eigenvalues of stiffness and inertia about the centre of mass.
fn squares() -> Vec<f64> {
    let axes = Matrix3::from_fn(|row, column| AXES[column][row]);
    let arm = turned() * Vector3::from(ARM);
    let mut coordinates = Matrix6::zeros();
    coordinates.fixed_view_mut::<3, 3>(0, 0).copy_from(&axes.transpose());
    coordinates.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-axes.transpose() * arm.cross_matrix()));
    coordinates.fixed_view_mut::<3, 3>(3, 3).copy_from(&axes.transpose());
    let stiffness = coordinates.transpose() * full() * coordinates;
    let turn = turned().into_inner();
    let mut inertia = Matrix6::identity() * MASS;
    let about = turn * Matrix3::from_diagonal(&Vector3::from(INERTIA)) * turn.transpose();
    inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&about);
    let inverse = inertia.cholesky().unwrap().l().try_inverse().unwrap();
    let mut found: Vec<f64> = SymmetricEigen::new(inverse * stiffness * inverse.transpose())
        .eigenvalues
        .iter()
        .copied()
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn a_matrix_has_the_frequencies_of_its_eigenvalues() {
    let plant = instance(&mounted(ARM, "", &by_matrix("")), 1e-4, "f64");
    let poles = plant.linearise(&LinearOptions::default()).unwrap().poles().unwrap();
    let exact = squares();
    assert_eq!(poles.len(), 12);
    for (pair, square) in poles.chunks(2).zip(exact) {
        for pole in pair {
            let (found, exact) = (pole.im.abs(), square.sqrt());
            assert!((found / exact - 1.0).abs() < 1e-6 && pole.re.abs() < 1e-3, "{pole} {exact}");
        }
    }
}

/// Proportional damping: each mode has the damping ratio ω·t/2.
#[test]
fn a_damping_time_damps_each_mode() {
    let time = 4e-4;
    let law = by_matrix(&format!("damping_time = {time}"));
    let plant = instance(&mounted(ARM, "", &law), 1e-4, "f64");
    let poles = plant.linearise(&LinearOptions::default()).unwrap().poles().unwrap();
    let mut found: Vec<f64> = poles.iter().map(|pole| pole.re).collect();
    found.sort_by(|a, b| b.total_cmp(a));
    for (pair, square) in found.chunks(2).zip(squares()) {
        let exact = -0.5 * time * square;
        for rate in pair {
            assert!((rate / exact - 1.0).abs() < 1e-5, "{rate} {exact}");
        }
    }
}

const PRELOAD: [f64; 6] = [300.0, -80.0, 150.0, 3.0, 0.8, -2.0];

fn preloaded(more: &str) -> String {
    let names = ["preload_x", "preload_y", "preload_z"];
    let names = names.into_iter().map(str::to_owned);
    let names = names.clone().chain(names.map(|name| format!("turn_{name}")));
    let keys = names.zip(PRELOAD).map(|(name, value)| format!("{name} = {value}\n"));
    by_matrix(&(keys.collect::<String>() + more))
}

/// At rest K·e = p, at any deflection: the displacement is that of the inverse matrix.
#[test]
fn a_preload_deflects_by_the_inverse_matrix() {
    let exact = full().lu().solve(&Vector6::from(PRELOAD)).unwrap();
    for (precision, near) in [("f64", 1e-10), ("f32", 2e-7), ("fixed", 2e-7)] {
        let mut plant = instance(&mounted([0.0; 3], "", &preloaded("")), 1e-4, precision);
        plant.settle().unwrap();
        let moved = [("x", 0.3), ("y", 0.2), ("z", 0.1)]
            .map(|(name, start)| value(&plant, &format!("engine.{name}")) - start);
        for (row, axis) in AXES.iter().enumerate() {
            let along: f64 = moved.iter().zip(axis).map(|(moved, axis)| moved * axis).sum();
            assert!((along - exact[row]).abs() < near, "{precision} {row}: {along} {exact}");
        }
    }
}

/// \[rad\] the largest rotation, and the largest relative change of the energy, over 0.1 s.
fn kept(law: &str) -> [f64; 2] {
    let spinning = "angular_velocity = [60, -60, 100]\nvelocity = [3, 1, -2]";
    let mut plant = instance(&mounted(ARM, spinning, law), 1e-5, "f64");
    let start = value(&plant, "energy.total");
    let (mut worst, mut turned): (f64, f64) = (0.0, 0.0);
    let orientation = |plant: &Instance| plant.plant().state().bodies[0].orientation;
    let before = orientation(&plant);
    for _ in 0..1000 {
        plant.advance(10).unwrap();
        worst = worst.max((value(&plant, "energy.total") / start - 1.0).abs());
        let w = before.conjugate().product(orientation(&plant)).w.abs().min(1.0);
        turned = turned.max(2.0 * w.acos());
    }
    [turned, worst]
}

/// Curves as stiff as a bushing along each axis, progressive, with a preload.
const CURVES: &str = "law = \"bushing-curves\"\nforce_x = [[-0.01, -3000], [0, 10], [0.01, 2000]]\n\
                      force_y = [[-0.01, -500], [0, 0], [0.002, 100], [0.01, 900]]\n\
                      force_z = [[-0.01, -900], [0.01, 900]]\ntorque_x = [[-0.5, -40], [0, 0], [0.2, 30], [1, 200]]\n\
                      torque_y = [[-1, -20], [0, 0], [1, 30]]\ntorque_z = [[-1, -30], [0, 1], [1, 40]]";

#[test]
fn a_large_rotation_keeps_the_energy() {
    for law in [preloaded(""), CURVES.into()] {
        let [turned, worst] = kept(&law);
        assert!(turned > 2.5 && worst < 1e-4, "{turned} rad {worst:e}: {law}");
    }
}

/// Straight tables and a diagonal matrix are the law `bushing`.
#[test]
fn special_cases_are_the_bushing() {
    let (along, about) = ([2e5, 5e4, 9e4], [300.0, 20.0, 90.0]);
    let keys = |names: [&str; 6], one: &dyn Fn(f64) -> String| {
        let all = names.iter().zip(along.into_iter().chain(about));
        all.map(|(name, k)| format!("{name} = {}\n", one(k))).collect::<String>()
    };
    let stiffnesses = ["x", "y", "z"].map(|axis| format!("stiffness_{axis}"));
    let turning = stiffnesses.clone().map(|name| format!("turn_{name}"));
    let [[a, b, c], [d, e, f]] =
        [&stiffnesses, &turning].map(|names| names.each_ref().map(|n| n.as_str()));
    let plain = format!("law = \"bushing\"\n{}", keys([a, b, c, d, e, f], &|k| k.to_string()));
    let tables = ["force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"];
    let curves = keys(tables, &|k| format!("[[-0.1, {}], [0.1, {}]]", -0.1 * k, 0.1 * k));
    let curves = format!("law = \"bushing-curves\"\n{curves}");
    let diagonal = Matrix6::from_diagonal(&Vector6::from_iterator(along.into_iter().chain(about)));
    let matrix = format!("law = \"bushing-matrix\"\nmatrix = {:?}", rows(&diagonal));
    let run = |law: &str, precision: &str| {
        let spinning = "angular_velocity = [6, -9, 10]\nvelocity = [0.3, 1, -0.2]";
        let mut plant = instance(&mounted(ARM, spinning, law), 5e-5, precision);
        plant.advance_to(0.1).unwrap();
        ["engine.x", "engine.y", "engine.vz", "engine.wy"].map(|name| value(&plant, name))
    };
    for (precision, near) in [("f64", 1e-9), ("f32", 2e-3), ("fixed", 2e-3)] {
        let exact = run(&plain, "f64");
        for law in [&plain, &curves, &matrix] {
            for (found, exact) in run(law, precision).into_iter().zip(exact) {
                assert!((found - exact).abs() < near, "{precision}: {found} {exact}: {law}");
            }
        }
    }
}

/// A block in a plane on the three laws.
const FLAT: &str = "name = \"mount\"\nduration = 1\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"engine\"\nmass = 2\n\
                    inertia = [0.05, 0.05, 0.05]\nposition = [0.1, 0.02, 0]\nangular_velocity = [0, 0, 9]\n";

fn flat(law: &str) -> String {
    format!(
        "[[interaction]]\nbetween = [\"world\", \"engine\"]\npoints = [[0, 0, 0], [-0.1, -0.02, 0]]\n\
         x = [0.6, 0.8, 0]\nz = [0, 0, 1]\n{law}\n"
    )
}

#[test]
fn planar_bushings_are_the_spatial_ones() {
    let mut matrix = Matrix6::from_diagonal(&Vector6::new(2e4, 5e3, 9e4, 1e3, 1e3, 15.0));
    for (i, j, entry) in [(0, 1, 2e3), (1, 5, -60.0), (0, 5, 40.0), (2, 3, 300.0)] {
        (matrix[(i, j)], matrix[(j, i)]) = (entry, entry);
    }
    let damped = "damping_time = 1e-3\npreload_x = 20\nturn_preload_z = 0.2";
    let laws = [
        format!("law = \"bushing-matrix\"\nmatrix = {:?}\n{damped}", rows(&matrix)),
        format!("{CURVES}\ndamping_x = 10\nturn_damping_x = 1\nturn_damping_z = 0.02"),
        "law = \"bushing-maxwell\"\nrelaxation = 0.02\nstiffness_x = 3e3\nstiffness_y = 4e3\nstiffness_z = 5e3\n\
         turn_stiffness_x = 9\nturn_stiffness_z = 7"
            .into(),
    ];
    let text = laws.iter().fold(FLAT.to_owned(), |text, law| text + &flat(law));
    for (precision, near) in [("f64", 1e-9), ("f32", 2e-3)] {
        let run = |text: &str| {
            let mut plant = instance(text, 5e-5, precision);
            plant.advance_to(0.3).unwrap();
            ["engine.x", "engine.y", "engine.vx", "engine.wz"].map(|name| value(&plant, name))
        };
        let space = run(&text);
        let plane = run(&text.replacen("duration", "planar = true\nduration", 1));
        for (space, plane) in space.into_iter().zip(plane) {
            assert!((space - plane).abs() < near, "{precision}: {space} {plane}");
        }
    }
    (matrix[(2, 5)], matrix[(5, 2)]) = (1.0, 1.0);
    let text = FLAT.replacen("duration", "planar = true\nduration", 1)
        + &flat(&format!("law = \"bushing-matrix\"\nmatrix = {:?}", rows(&matrix)));
    let refused = dbd_scene::Scene::parse(&text, "mount.toml").unwrap_err().to_string();
    assert!(refused.contains("matrix"), "{refused}");
}

/// The same motion with an implicit scheme; a branch needs one evaluation per step.
#[test]
fn other_schemes_step_them_or_refuse() {
    let run = |law: &str, scheme: &str, step: f64| {
        let settings =
            Settings { scheme: Some(scheme.into()), step: Some(step), ..Settings::default() };
        let text = mounted(ARM, "angular_velocity = [4, -3, 6]", law);
        let blueprint = dbd_plant::instance::Blueprint::new("mount.toml", text);
        let mut plant = Instance::new(blueprint, settings).map_err(|error| error.to_string())?;
        plant.advance_to(0.05).unwrap();
        Ok::<_, String>(["engine.x", "engine.z", "engine.wx"].map(|name| value(&plant, name)))
    };
    for law in [preloaded("damping_time = 3e-4"), format!("{CURVES}\ndamping_x = 20")] {
        let exact = run(&law, "leapfrog", 5e-6).unwrap();
        for (scheme, step) in [("generalized-alpha-3", 5e-5), ("rk4", 2e-5)] {
            let found = run(&law, scheme, step).unwrap();
            for (exact, found) in exact.into_iter().zip(found) {
                assert!(
                    (exact - found).abs() < 2e-4 * (1.0 + exact.abs()),
                    "{scheme}: {exact} {found}"
                );
            }
        }
    }
    for scheme in ["rk4", "pefrl", "generalized-alpha"] {
        let refused = run(&branch(0.02), scheme, 5e-5).unwrap_err();
        assert!(refused.contains("bushing-maxwell"), "{refused}");
    }
}

fn branch(relaxation: f64) -> String {
    format!(
        "law = \"bushing-maxwell\"\nrelaxation = {relaxation}\nstiffness_x = 2e5\nstiffness_y = 5e4\nstiffness_z = 9e4\n\
         turn_stiffness_x = 300\nturn_stiffness_y = 20\nturn_stiffness_z = 90"
    )
}

/// The arithmetic-geometric mean (Gauss): a pendulum's period at the amplitude φ is 2π/(ω·mean(1, cos(φ/2))).
fn mean(a: f64, b: f64) -> f64 {
    if (a - b).abs() < 1e-15 { a } else { mean(0.5 * (a + b), (a * b).sqrt()) }
}

/// The time of a whole swing on a bushing of 30 N·m/rad about z, thrown so that it turns by 120°.
fn swung(step: f64) -> f64 {
    let text = mass(
        1.0,
        0.0,
        0.0,
        0.0,
        "angular_velocity = [0, 0, 30]\n[[interaction]]\nname = \"mount\"\nlaw = \"bushing\"\n\
         between = [\"world\", \"mass\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nx = [1, 0, 0]\nz = [0, 0, 1]\n\
         stiffness_x = 1e4\nstiffness_y = 1e4\nstiffness_z = 1e4\nturn_stiffness_x = 10\n\
         turn_stiffness_y = 20\nturn_stiffness_z = 30\n[[readout]]\nname = \"torque\"\ntype = \"interaction\"\n\
         target = \"mount\"\nquantity = \"torque_z\"",
    );
    period(&text, "torque", step)
}

/// The time until a column that starts at 0 rises through 0 again.
fn period(text: &str, column: &str, step: f64) -> f64 {
    let mut run = instance(text, step, "f64");
    let output = run.output(column).unwrap();
    let mut last = 0.0;
    loop {
        run.advance(1).unwrap();
        let now = run.value(output);
        if last < 0.0 && now >= 0.0 {
            return run.time() - step * now / (now - last);
        }
        last = now;
    }
}

/// 1 kg at 1 m/s between walls of 100 kN/m at ±2 mm.
const GAP: &str = "[[interaction]]\nlaw = \"bushing-curves\"\nbetween = [\"world\", \"mass\"]\n\
                   points = [[0, 0, 0], [0, 0, 0]]\nx = [0, 1, 0]\nz = [0, 0, 1]\n\
                   force_x = [[\"-12 mm\", -1000], [\"-2 mm\", 0], [\"2 mm\", 0], [\"12 mm\", 1000]]";

/// Of three displacements coupled by a matrix.
const COUPLED: [[f64; 3]; 3] = [[9e3, 2e3, -3e3], [2e3, 4e3, 1e3], [-3e3, 1e3, 6e3]];

/// 1 kg thrown at 1 m/s along the second axis.
fn coupled() -> String {
    let mut matrix = Matrix6::identity();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::from(COUPLED));
    let law = format!("law = \"bushing-matrix\"\nmatrix = {:?}", rows(&matrix));
    let at = "between = [\"world\", \"mass\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nx = [1, 0, 0]\nz = [0, 0, 1]";
    mass(1.0, 0.0, 1.0, 0.0, &format!("[[interaction]]\n{law}\n{at}"))
}

/// Its displacement along the first axis after a time: a sum over the eigenvectors.
fn thrown(time: f64) -> f64 {
    let parts = SymmetricEigen::new(Matrix3::from(COUPLED));
    let part = |mode: usize| {
        let (rate, vector) = (parts.eigenvalues[mode].sqrt(), parts.eigenvectors.column(mode));
        vector[0] * vector[1] * (rate * time).sin() / rate
    };
    (0..3).map(part).sum()
}

pub(crate) fn cases() -> Vec<Case> {
    let case = |element, what, unit, exact, step, near, found: Box<dyn Fn(f64) -> f64>| Case {
        element,
        what,
        unit,
        exact,
        step,
        found,
        near,
    };
    vec![
        case(
            "bushing",
            "period of a rotation by ±120°",
            "s",
            std::f64::consts::TAU / (300.0_f64.sqrt() * mean(1.0, 0.5)),
            2e-4,
            1e-5,
            Box::new(swung),
        ),
        case(
            "bushing-curves",
            "period across a gap of ±2 mm",
            "s",
            4.0 * 0.002 + std::f64::consts::TAU / 1e5_f64.sqrt(),
            1e-4,
            1e-3,
            Box::new(|h| period(&mass(1.0, 0.0, 1.0, 0.0, GAP), "mass.y", h)),
        ),
        case(
            "bushing-matrix",
            "displacement 0.1 s after a throw across",
            "m",
            thrown(0.1),
            4e-4,
            1e-3,
            Box::new(|h| at(&coupled(), h, 0.1, "mass.x")),
        ),
        case(
            "bushing-maxwell",
            "place 0.1 s after 1 m/s, beside a bushing",
            "m",
            decayed(0.1)[0],
            4e-4,
            1e-3,
            Box::new(|h| {
                at(&soft(TIME, relaxing::BRANCH, &body("velocity = [1, 0, 0]")), h, 0.1, "mass.x")
            }),
        ),
    ]
}
