//! `modes`: frequencies, shapes, damping ratios, masses and shares against closed forms; its files; what it refuses.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use dbd_kernel::{State, Vec3, forces::wrenches};
use dbd_scene::Scene;
use dbd_study::modes::{
    MAX_BODIES, Matrices, elements, extremes, modes, softened, strain_shares, table,
};
use host_sim::terminal::Exit;
use nalgebra::Matrix4;
use serde_json::Value;

use crate::{Folder, call};

fn parsed(text: &str) -> Scene {
    let head = "name = \"s\"\nduration = 1\n";
    Scene::parse(&format!("{head}{text}"), "s.toml").unwrap_or_else(|e| panic!("{e}"))
}

fn shipped(name: &str) -> Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    Scene::load(root.join(name).with_extension("toml")).unwrap()
}

/// Equal masses in line, the first held by the ground; nothing else holds them.
fn chain(count: usize, [mass, stiffness, damping]: [f64; 3]) -> String {
    let mut text = String::new();
    let mut before = "world".to_owned();
    for i in 0..count {
        let x = 0.1 * (i + 1) as f64;
        let _ = write!(
            text,
            "[[body]]\nname = \"m{i}\"\nmass = {mass}\ninertia = [1e-3, 1e-3, 1e-3]\nposition = [{x:?}, 0, 0]\n\
             [[tsda]]\nname = \"k{i}\"\nbetween = [\"{before}\", \"m{i}\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
             stiffness = {stiffness}\ndamping = {damping}\nfree_length = 0.1\n"
        );
        before = format!("m{i}");
    }
    text
}

/// \[rad/s\] of mode j, from 1, of a chain of n masses, one end held.
fn of_chain(n: usize, j: usize, mass: f64, stiffness: f64) -> f64 {
    let angle = (2 * j - 1) as f64 * PI / (2.0 * (2 * n + 1) as f64);
    2.0 * (stiffness / mass).sqrt() * angle.sin()
}

#[test]
fn a_chain_of_masses_has_its_frequencies_shapes_ratios_and_masses() {
    const N: usize = 5;
    let (mass, stiffness, damping) = (0.5, 2e3, 4.0);
    let scene = parsed(&chain(N, [mass, stiffness, damping]));
    let table = table(&scene, 6 * N).unwrap();
    let first = 5 * N;
    assert!(table.rows[..first].iter().all(|row| row.frequency == 0.0 && row.ratio.is_none()));
    let mut sums = [0.0; 3];
    for (j, row) in table.rows.iter().enumerate() {
        (0..3).for_each(|axis| sums[axis] += row.effective_mass[axis]);
        let Some(j) = (j + 1).checked_sub(first).filter(|j| *j > 0) else { continue };
        let omega = of_chain(N, j, mass, stiffness);
        assert!((row.frequency * TAU / omega - 1.0).abs() < 1e-8, "{row:?}");
        // C = (c/k)·K.
        let ratio = 0.5 * damping / stiffness * omega;
        assert!((row.ratio.unwrap() / ratio - 1.0).abs() < 1e-8, "{row:?} {ratio}");
        let shape =
            |i: usize| ((2 * j - 1) as f64 * (i + 1) as f64 * PI / (2 * N + 1) as f64).sin();
        let motion = table.modes.motion(&scene.model, first + j - 1);
        let largest =
            (0..N).map(shape).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        for (i, body) in motion.iter().enumerate() {
            assert!((body[0] - shape(i) / largest).abs() < 1e-7, "{j} {i}: {body:?}");
        }
        // Spring i stretches by the difference of its ends.
        let deformation = |i: usize| if i == 0 { shape(0) } else { shape(i) - shape(i - 1) };
        let all: f64 = (0..N).map(|i| deformation(i).powi(2)).sum();
        let (name, share) = &row.elements[0];
        let most =
            (0..N).max_by(|a, b| deformation(*a).abs().total_cmp(&deformation(*b).abs())).unwrap();
        assert!(name.contains(&format!("`k{most}`")), "{row:?} {most}");
        assert!((share - deformation(most).powi(2) / all).abs() < 1e-8, "{row:?}");
    }
    // Nothing else than the held end reaches the ground: all of the mass is in some mode.
    assert!(sums.iter().all(|sum| (sum / (N as f64 * mass) - 1.0).abs() < 1e-9), "{sums:?}");
    assert!(table.is_complete && (table.total_mass - N as f64 * mass).abs() < 1e-12);
}

#[test]
fn shares_of_strain_energy_sum_to_one_where_elements_alone_hold() {
    for name in ["3ruu", "double-wishbone", "gripper", "cart-pendulum", "macpherson"] {
        let scene = dbd_scene::relaxed(&shipped(name)).unwrap();
        let (model, state) = (&scene.model, State::initial(&scene.model));
        let (found, elements) = (modes(model, &state).unwrap(), elements(&scene));
        let last = found.frequencies.len() - 1;
        for mode in [last, last / 2, 3 * last / 4] {
            let shape = found.shapes.column(mode);
            let shares = strain_shares(model, &state, &elements, shape).unwrap();
            let sum: f64 = shares.iter().sum();
            assert!((sum - 1.0).abs() < 1e-6, "{name} {mode}: {sum}");
        }
    }
}

/// Interactions have their share, too.
#[test]
fn a_stop_that_is_engaged_holds_its_mode() {
    let scene = parsed(
        "[[body]]\nname = \"b\"\nmass = 2\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n[[tsda]]\n\
         between = [\"world\", \"b\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nstiffness = 100\nfree_length = 1\n\
         [[interaction]]\nname = \"rope\"\nlaw = \"distance-stop\"\nbetween = [\"world\", \"b\"]\n\
         points = [[0, 0, 0], [0, 0, 0]]\nto = 0.9\nstiffness = 300\n",
    );
    let fastest = table(&scene, 6).unwrap().fastest.unwrap();
    assert!((fastest.frequency * TAU - 200_f64.sqrt()).abs() < 1e-6, "{fastest:?}");
    assert!(fastest.element.contains("`rope`") && (fastest.share - 0.75).abs() < 1e-8);
    assert_eq!(fastest.halved_solved, None);
}

#[test]
fn half_the_stiffness_is_predicted_and_solved() {
    // One spring alone: all of the energy, and both are √½.
    let fastest = table(&parsed(&chain(1, [1.0, 100.0, 0.0])), 6).unwrap().fastest.unwrap();
    let half = (50_f64).sqrt() / TAU;
    for found in [fastest.halved_predicted, fastest.halved_solved.unwrap()] {
        assert!((found / half - 1.0).abs() < 1e-7, "{fastest:?}");
    }
    // The same as the scene with that value; the estimate of a frequency is never above the highest one.
    let scene = shipped("double-wishbone");
    let fastest = table(&scene, 1).unwrap().fastest.unwrap();
    let (_, name) = fastest.element.split_once('`').unwrap();
    let name = name.trim_end_matches('`');
    let row = scene.joints.iter().position(|joint| joint.name == name).unwrap();
    let stiffness = dbd_scene::joint_elements(&scene)
        .iter()
        .find(|element| element.joint == row)
        .unwrap()
        .stiffness;
    let half = scene.with(&format!("joint.\"{name}\".stiffness={:?}", stiffness / 2.0)).unwrap();
    let solved =
        *modes(&half.model, &State::initial(&half.model)).unwrap().frequencies.last().unwrap();
    assert!((fastest.highest_then.unwrap() / solved - 1.0).abs() < 1e-6, "{fastest:?} {solved}");
    assert!(fastest.halved_predicted < solved && fastest.overlap.unwrap() > 0.9, "{fastest:?}");
    // To first order ω² changes by the share.
    let state = State::initial(&scene.model);
    let found = modes(&scene.model, &state).unwrap();
    let element = elements(&scene).into_iter().find(|one| one.name == fastest.element).unwrap();
    let softer = softened(&scene.model, &element, 1.0 - 1e-4).unwrap();
    let then = *modes(&softer, &state).unwrap().frequencies.last().unwrap();
    let slope = (1.0 - (then / found.frequencies.last().unwrap()).powi(2)) / 1e-4;
    assert!((slope / fastest.share - 1.0).abs() < 2e-2, "{slope} {}", fastest.share);
}

#[test]
fn damped_oscillators_have_the_ratios_of_their_eigenvalues() {
    for ratio in [0.0, 0.03, 0.7, 1.5] {
        let (mass, stiffness) = (2.0, 800.0);
        let damping: f64 = 2.0 * ratio * f64::sqrt(mass * stiffness);
        let rows = table(&parsed(&chain(1, [mass, stiffness, damping])), 6).unwrap().rows;
        assert!((rows[5].ratio.unwrap() - ratio).abs() < 1e-8, "{ratio}: {rows:?}");
    }
    // One damper of two: the damped shapes are not the undamped ones.
    let (k, c, m) = (900.0, 25.0, 1.0);
    let text = chain(2, [m, k, 0.0]).replacen("damping = 0", &format!("damping = {c}"), 1);
    let system = Matrix4::new(
        0.0,
        0.0,
        1.0,
        0.0, //
        0.0,
        0.0,
        0.0,
        1.0, //
        -2.0 * k / m,
        k / m,
        -c / m,
        0.0, //
        k / m,
        -k / m,
        0.0,
        0.0,
    );
    let mut expected: Vec<f64> = system
        .complex_eigenvalues()
        .iter()
        .filter(|value| value.im > 0.0)
        .map(|value| -value.re / value.norm())
        .collect();
    let rows = table(&parsed(&text), 12).unwrap().rows;
    let mut found: Vec<f64> = rows.iter().filter_map(|row| row.ratio).collect();
    for list in [&mut expected, &mut found] {
        list.sort_by(f64::total_cmp);
    }
    assert_eq!(found.len(), 2);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-7, "{found} {expected}");
    }
}

#[test]
fn a_pendulum_swings_about_its_rest() {
    let folder = Folder::new();
    let text = "name = \"p\"\nduration = 1\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"arm\"\nmass = 2\n\
        inertia = [0.1, 0.01, 0.1]\nposition = [0.5, 0, 0]\norientation = { axis = [0, 0, 1], angle = \"90 deg\" }\n\
        [[joint]]\nname = \"pin\"\ntype = \"revolute\"\nbetween = [\"world\", \"arm\"]\nat = [0, 0, 0]\n\
        axis = [0, 0, 1]\nstiffness = 1e8\nspan = 0.1\n";
    let scene = folder.scene(text);
    let first = |more: &[&str]| {
        let done = call(&[&["modes", &scene, "--json", "--count", "1"][..], more].concat());
        let said: Value =
            serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err));
        (said["modes"][0]["frequency"].as_f64().unwrap(), said)
    };
    let expected = (2.0 * 9.81 * 0.5 / (0.1 + 2.0 * 0.25_f64)).sqrt() / TAU;
    let (frequency, said) = first(&["--relax"]);
    assert!((frequency / expected - 1.0).abs() < 1e-3, "{frequency} {expected}");
    assert!(said["pose"] == "rest" && said["remarks"].as_array().unwrap().is_empty(), "{said}");
    // Level it is not in equilibrium, which is said.
    let (frequency, said) = first(&[]);
    assert!((frequency / expected - 1.0).abs() > 0.1 && !said["remarks"][0].is_null(), "{said}");
}

/// Rigid links with springs between them bend as an elastic beam that is held at one end.
#[test]
fn a_chain_of_links_bends_as_a_beam() {
    const N: usize = 20;
    let (length, mass, bending) = (1.0 / N as f64, 0.05, 3.0);
    let mut text = String::new();
    let mut before = "world".to_owned();
    for i in 0..N {
        let (x, at) = ((i as f64 + 0.5) * length, i as f64 * length);
        let stiffness = bending / length * if i == 0 { 2.0 } else { 1.0 };
        let inertia = mass * length * length / 12.0;
        let _ = write!(
            text,
            "[[body]]\nname = \"l{i}\"\nmass = {mass}\ninertia = [1e-5, {inertia:?}, {inertia:?}]\n\
             position = [{x:?}, 0, 0]\n[[joint]]\nname = \"j{i}\"\ntype = \"revolute\"\n\
             between = [\"{before}\", \"l{i}\"]\nat = [{at:?}, 0, 0]\naxis = [0, 0, 1]\nstiffness = 1e8\n\
             span = 0.05\n[[torsion_spring]]\nbetween = [\"{before}\", \"l{i}\"]\naxis = [0, 0, 1]\n\
             stiffness = {stiffness:?}\n"
        );
        before = format!("l{i}");
    }
    let rows = table(&parsed(&text), 2).unwrap().rows;
    let per_length = mass / length;
    for (row, root, tolerance) in [(0, 1.875_104_f64, 0.005), (1, 4.694_091, 0.01)] {
        let expected = root * root * (bending / per_length).sqrt() / TAU;
        let found = rows[row].frequency;
        assert!((found / expected - 1.0).abs() < tolerance, "{row}: {found} {expected}");
        assert!(rows[row].elements[0].0.starts_with("torsion_spring"), "{:?}", rows[row]);
    }
    // A cantilever's first mode has 61.3 % of its mass.
    assert!((rows[0].mass_share[1] - 0.613).abs() < 0.01, "{:?}", rows[0]);
}

/// The exported stiffness answers a motion of all bodies at once as the wrenches do.
#[test]
fn the_stiffness_matrix_answers_as_the_wrenches() {
    for name in ["macpherson", "gripper", "hanging-chain"] {
        let scene = dbd_scene::relaxed(&shipped(name)).unwrap();
        let (model, state) = (&scene.model, State::initial(&scene.model));
        let shift = |row: usize, axis: usize| ((3 * row + axis) as f64 * 1.7).sin();
        let at = |by: f64| {
            let mut state = state.clone();
            for (row, body) in state.bodies.iter_mut().enumerate() {
                body.position =
                    body.position + Vec3::new(shift(row, 0), shift(row, 1), shift(row, 2)) * by;
            }
            wrenches(model, &state, 1e-3).unwrap()
        };
        let matrices = Matrices::of(&scene).unwrap();
        let mut answer = vec![0.0; matrices.size];
        for (row, column, value) in &matrices.stiffness {
            if column % 6 < 3 {
                answer[*row] += value * shift(column / 6, column % 6);
            }
        }
        let (ahead, behind) = (at(1e-6), at(-1e-6));
        let largest = answer.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        for (row, (ahead, behind)) in ahead.iter().zip(&behind).enumerate() {
            let force = (behind.force - ahead.force) * (0.5 / 1e-6);
            for (axis, force) in force.to_f64().into_iter().enumerate() {
                let expected = answer[6 * row + axis];
                assert!(
                    (force - expected).abs() < 1e-5 * largest,
                    "{name} {row}: {force} {expected}"
                );
            }
        }
    }
}

#[test]
fn the_iteration_finds_the_modes_of_the_whole_matrix() {
    let scene = shipped("3ruu");
    let state = State::initial(&scene.model);
    let all = modes(&scene.model, &state).unwrap();
    let some = extremes(&scene.model, &state, [7, 4]).unwrap();
    let count = all.frequencies.len();
    let wanted = all.frequencies[..7].iter().chain(&all.frequencies[count - 4..]);
    for (found, wanted) in some.frequencies.iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() < 1e-5, "{found} {wanted}");
    }
    let last = some.shapes.column(10).norm();
    assert!((last - 1.0).abs() < 1e-9);
}

#[test]
fn more_bodies_than_a_whole_matrix_bears_are_iterated() {
    let folder = Folder::new();
    let n = MAX_BODIES + 20;
    let text = format!("name = \"long\"\nduration = 1\n{}", chain(n, [0.5, 2e3, 1.0]));
    let done = call(&["modes", &folder.scene(&text), "--count", "3", "--json"]);
    let said: Value = serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err));
    let found = said["fastest"]["frequency"].as_f64().unwrap();
    let expected = of_chain(n, n, 0.5, 2e3) / TAU;
    assert!((found / expected - 1.0).abs() < 1e-7, "{found} {expected}");
    let done = call(&["modes", folder.path("scene.toml").to_str().unwrap(), "--relax"]);
    assert!(
        done.exit == Exit::Refused && done.err.contains("cannot bring 220 bodies to rest"),
        "{}",
        done.err
    );
    assert_eq!(said["damping_ratios"], "modal-diagonal");
    assert_eq!(said["modes"][2]["frequency"], 0.0);
}

#[test]
fn the_kick_finds_a_frequency_of_the_pose() {
    let folder = Folder::new();
    let text = "name = \"k\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 2\ninertia = [0.5, 0.5, 0.5]\n\
        position = [0, 0, 0]\n[[joint]]\nname = \"ball\"\ntype = \"spherical\"\nbetween = [\"world\", \"b\"]\n\
        at = [0, 0, 0]\nstiffness = 5e4\narm = 1\n";
    let scene = folder.scene(text);
    let done = call(&["modes", &scene, "--kick", "--json"]);
    let said: Value = serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err));
    let kick = &said["kick"];
    let number = |key: &str| kick[key].as_f64().unwrap();
    // A spring that is 1 mm longer than its place of 1 m stiffens the joint by a thousandth.
    assert!((number("ratio") - 1.0).abs() < 3e-3, "{kick}");
    let frequency = (5e4_f64 / 2.0).sqrt() / TAU;
    assert!((number("nearest") / frequency - 1.0).abs() < 1e-3, "{kick} {frequency}");
    let damping = 2.0 * 5e4 / (TAU * number("dominant"));
    assert!((number("damping") / damping - 1.0).abs() < 1e-9, "{kick}");
    let out = folder.path("out");
    let done = call(&["modes", &scene, "--kick", "--out", out.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    for (name, title) in [("spectrum", "Magnitude spectrum"), ("scalogram", "Wavelet scalogram")] {
        let file = folder.path(&format!("out/scene/kick-{name}.svg"));
        assert!(fs::read_to_string(&file).unwrap().contains(title), "{name}");
    }
    let done = call(&["modes", &scene, "--kick=nobody"]);
    assert!(done.exit == Exit::Refused && done.err.contains("no joint `nobody`"), "{}", done.err);
    assert!(done.err.contains("its joints: ball"), "{}", done.err);
}

#[test]
fn table_page_and_matrices_are_written() {
    let folder = Folder::new();
    let out = folder.path("out");
    let out = out.to_str().unwrap();
    let text = format!("name = \"c\"\nduration = 1\n{}", chain(2, [0.5, 2e3, 1.0]));
    let scene = folder.scene(&text);
    let done = call(&["modes", &scene, "--out", out, "--count", "12"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    assert!(done.out.contains("fastest mode") && done.out.contains("written"), "{}", done.out);
    let read = |name: &str| fs::read_to_string(folder.path(&format!("out/scene/{name}"))).unwrap();
    assert_eq!(read("modes.csv").lines().count(), 13);
    let page = read("modes.html");
    assert!(page.contains("\"shape\":") && page.contains("held by") && page.contains("<svg"));
    let json: Value = serde_json::from_str(&read("modes.json")).unwrap();
    assert_eq!(json["modes"].as_array().unwrap().len(), 12);
    let stiffness = read("stiffness.mtx");
    assert!(stiffness.starts_with("%%MatrixMarket matrix coordinate real symmetric\n"));
    let entry = |row: usize, column: usize| {
        let line = stiffness.lines().skip(3).find_map(|line| {
            let parts: Vec<&str> = line.split(' ').collect();
            (parts[0] == row.to_string() && parts[1] == column.to_string())
                .then(|| parts[2].parse::<f64>().unwrap())
        });
        line.unwrap_or(0.0)
    };
    for (row, column, expected) in [(1, 1, 4e3), (7, 1, -2e3), (7, 7, 2e3)] {
        assert!((entry(row, column) / expected - 1.0).abs() < 1e-8, "{row} {column}");
    }
    assert!(read("mass.mtx").contains("\n1 1 5e-1\n") && read("damping.mtx").contains("\n1 1 "));
    // Another scene's results are not replaced unasked.
    let other = folder.path("other");
    fs::create_dir(&other).unwrap();
    let other = other.join("scene.toml");
    fs::write(&other, text.replace("name = \"c\"", "name = \"d\"")).unwrap();
    let done = call(&["modes", other.to_str().unwrap(), "--out", out]);
    assert!(done.exit == Exit::Refused && done.err.contains("another scene"), "{}", done.err);
    let done = call(&["modes", other.to_str().unwrap(), "--out", out, "--overwrite"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
}

#[test]
fn what_has_no_modes_is_refused() {
    let folder = Folder::new();
    let scene = folder.scene(&format!("name = \"c\"\nduration = 1\n{}", chain(1, [1.0, 1.0, 0.0])));
    for wrong in [&["--count", "0"][..], &["--count", "x"], &["--overwrite"]] {
        let done = call(&[&["modes", &scene][..], wrong].concat());
        assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""), "{wrong:?}");
    }
    let done = call(&["modes", "crank-slider", "--relax"]);
    assert!(done.exit == Exit::Failed && done.err.contains("nothing holds"), "{}", done.err);
    let done = call(&["modes", &scene, "--kick"]);
    assert!(
        done.exit == Exit::Refused && done.err.contains("no joint can be kicked"),
        "{}",
        done.err
    );
}
