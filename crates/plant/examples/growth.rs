//! Looks at a chain in one of the ways that the command line does: what `cargo xtask growth` runs below
//! callgrind, which counts nothing but [`counted_work`] and what it calls.
//!
//! `growth load|check|run LINKS`: prints what came of it, so that nothing of it is left out. `check` is what is
//! asked of a scene once it is read, `run` what a run asks before its first step, and at a sample.

use std::fmt::Write as _;
use std::hint::black_box;
use std::process::ExitCode;

use dbd_kernel::State;
use dbd_kernel::frequency;
use dbd_plant::monitor::Monitor;
use dbd_plant::{Method, plant};
use dbd_scene::Scene;

/// \[s\].
const STEP: f64 = 2e-5;
/// Every so many links have springs of their own.
const SOME: usize = 4;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let asked = match &arguments[..] {
        [way, links] => links.parse().ok().map(|links| (way.as_str(), links)),
        _ => None,
    };
    let done = asked.ok_or_else(|| "growth load|check|run LINKS".to_owned());
    match done.and_then(|(way, links)| run(way, links)) {
        Ok(came_to) => {
            println!("{came_to}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn run(way: &str, links: usize) -> Result<usize, String> {
    let text = chain(links);
    let parse = || Scene::parse(&text, "chain.toml").map_err(|why| why.to_string());
    if way == "load" {
        let joints = counted_work(&|| parse().map_or(0, |scene| scene.joints.len()));
        return if joints == links { Ok(joints) } else { parse().map(|scene| scene.joints.len()) };
    }
    let scene = parse()?;
    let state = State::initial(&scene.model);
    match way {
        "check" => Ok(counted_work(&|| {
            let warnings = dbd_scene::warnings_with(&scene, &dbd_scene::facts(&scene)).len();
            let bound = frequency::bound(&scene.model, &state) as usize;
            warnings + dbd_scene::element_dampings(&scene).len() + bound
        })),
        "run" => Ok(counted_work(&|| {
            let Ok(plant) = plant(&scene, &Method::default(), STEP) else { return 0 };
            let mut monitor = Monitor::new(&scene, plant.as_ref());
            usize::from(monitor.check(&plant.state()).is_ok())
        })),
        _ => Err(format!("there is no way `{way}`")),
    }
}

/// What is counted. Its name is what callgrind is told.
#[inline(never)]
fn counted_work(work: &dyn Fn() -> usize) -> usize {
    black_box(work())
}

/// Links one behind the other, with everything that is held against joints and bodies when a scene is
/// read or looked at: dampers, torsion springs, raw springs, turned bodies, read-outs of angles.
fn chain(links: usize) -> String {
    let mut text = format!(
        "name = \"chain\"\nduration = 0.01\nstep = {STEP:e}\ngravity = [0, 0, -9.81]\n\
         [defaults.joint]\ntype = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 1e6\ndamping = 10\n\
         span = 0.02\n[defaults.body]\nmass = 0.1\ninertia = [1e-4, 1e-4, 1e-4]\n"
    );
    let name = |i: usize| if i == 0 { "world".to_owned() } else { format!("link {i}") };
    let mut add = |i: usize, table: &str, rest: String| {
        let [a, b] = [name(i), name(i + 1)];
        let own = match table {
            "body" => format!("name = \"{b}\"\n"),
            _ => format!("between = [\"{a}\", \"{b}\"]\n"),
        };
        let _ = write!(text, "[[{table}]]\n{own}{rest}");
    };
    for i in 0..links {
        let (x, angle) = (0.1 * i as f64 + 0.05, 0.01 * (i % 50) as f64);
        let orientation = format!("{{ axis = [0, 1, 0], angle = {angle} }}");
        add(i, "body", format!("position = [{x:.3}, 0, 0]\norientation = {orientation}\n"));
    }
    for i in 0..links {
        let x = 0.1 * i as f64;
        add(i, "joint", format!("name = \"pin {i}\"\nat = [{x:.3}, 0, 0]\n"));
    }
    // Springs of their own at some links: a model counts elements and dampers in 16 bits, and joints have six each.
    for i in (0..links).step_by(SOME) {
        let from = if i == 0 { -0.03 } else { 0.02 };
        let points = format!("points = [[{from}, 0, 0.01], [-0.02, 0, 0.01]]\n");
        let spring = "stiffness = 100\nfree_length = 0.05\ndamping = 1\n";
        add(i, "tsda", points + spring);
    }
    for i in (0..links).step_by(SOME) {
        add(i, "torsion_spring", "axis = [0, 1, 0]\nstiffness = 1\ndamping = 0.1\n".to_owned());
    }
    for i in 0..links {
        let _ = write!(
            text,
            "[[readout]]\nname = \"angle {i}\"\ntype = \"joint_angle\"\ntarget = \"pin {i}\"\n"
        );
    }
    text
}
