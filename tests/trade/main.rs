//! Speed against accuracy: what a survey of a small scene comes to, kept, interrupted, repeated.

mod advice;
mod command;
mod estimate;
mod limits;
mod linkage;
mod models;

use std::fs;
use std::path::{Path, PathBuf};

use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::time::Time;
use dbd_plant::{Frequencies, Method, Named as _, PrecisionName, SchemeName};
use dbd_scene::Scene;
use dbd_study::advice::{advice, choice, remark};
use dbd_study::command::Command;
use dbd_study::files::{Piece, Report};
use dbd_study::limits::Limits;
use dbd_study::point::Cause;
use dbd_study::stability::MARGIN;
use dbd_study::ways::Way;
use dbd_study::{Machine, Point, Trade, TradeOptions, front, survey};
use dbd_tests::scene;

/// A survey of a scene's first moments; `cache` where results are kept.
fn trade(name: &str, window: f64, cache: Option<&Path>) -> Trade {
    let cache = cache.map(Path::to_owned);
    let scene = scene(name);
    let shipped = Some(scene.clone());
    let options = TradeOptions { window: Some(window), period: None, cache, shipped };
    survey(&scene, &options, &mut |_| ()).unwrap()
}

/// The files of results in a folder.
fn caches(folder: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    files.filter(|file| file.extension().is_some_and(|extension| extension == "cache")).collect()
}

/// What does not depend on a clock.
fn accuracy(trade: &Trade) -> Vec<(String, u64, bool, [Option<u64>; 3])> {
    let bits = |value: Option<f64>| value.map(f64::to_bits);
    let of = |p: &Point| {
        let errors = [p.error, p.energy_rms, p.energy_peak].map(bits);
        (p.stepper.label(), p.steps, p.stable, errors)
    };
    trade.points.iter().map(of).collect()
}

#[test]
fn two_surveys_give_the_same_accuracy_to_the_last_bit_however_they_are_interrupted() {
    let trade = |cache| trade("spring-ball", 0.02, cache);
    let folder = tempfile::tempdir().unwrap();
    let first = trade(None);
    let kept = trade(Some(folder.path()));
    assert_eq!(accuracy(&first), accuracy(&kept));
    // The second call reads what the first has kept, times included.
    assert_eq!(trade(Some(folder.path())), kept);

    let path = caches(folder.path()).remove(0);
    let text = fs::read_to_string(&path).unwrap();
    // Interrupted in the middle of a line.
    fs::write(&path, &text[..text.len() / 2]).unwrap();
    let before = text.len() / 2;
    let resumed = trade(Some(folder.path()));
    assert_eq!(accuracy(&resumed), accuracy(&kept));
    assert!(fs::read_to_string(&path).unwrap().len() > before);
    // The lines that were there are there still.
    let whole = &text[..text[..before].rfind('\n').unwrap()];
    assert!(fs::read_to_string(&path).unwrap().starts_with(whole));
    // Another window has a file of its own.
    let all = fs::read(&path).unwrap();
    self::trade("spring-ball", 0.01, Some(folder.path()));
    assert_eq!(caches(folder.path()).len(), 2);
    assert_eq!(fs::read(&path).unwrap(), all);
}

#[test]
fn a_survey_holds_every_way_and_says_what_is_unstable() {
    let trade = trade("four-bar", 0.02, None);
    let has = |label: &str| trade.points.iter().any(|point| point.stepper.label() == label);
    for label in ["dbd f64", "dbd +1 f32", "leapfrog f32", "pefrl f64", "rk4 f32"] {
        assert!(has(label), "{label}");
    }
    for label in ["std leapfrog f64", "std semi-implicit-euler f64"] {
        assert!(has(label), "{label}");
    }
    assert!(has("std linearly-implicit-euler f64"));
    // The four-bar moves in a plane and has no dampers.
    assert!(!has("leapfrog f64, euler-321") && !has("leapfrog (explicit) f64"));
    // Every step divides the scene's sampling interval.
    assert!(trade.points.iter().all(|point| {
        let parts = 1e-3 / point.step;
        (parts - parts.round()).abs() < 1e-9 * parts
    }));
    // In space, whatever else it could be made into.
    assert!(trade.points.iter().all(|point| point.step_in_space.is_none()));
    // What is advised keeps its distance from what is stable, and so does the front.
    let scene = scene("four-bar");
    let highest = Frequencies::of(&scene).estimate;
    for point in trade.points.iter().filter(|point| point.stepper.kernel && point.advisable) {
        let method = SchemeName::of_name(&point.stepper.scheme).unwrap();
        let method = Method::new(method, point.stepper.newton, PrecisionName::F64).unwrap();
        let z = highest * point.step;
        assert!(z <= (1.0 - MARGIN) * method.stability_limit(), "{}: {z}", point.stepper.label());
    }
    let near = |point: &&Point| point.stable && !point.advisable;
    assert!(trade.points.iter().filter(near).count() > 10);
    for machine in [Machine::Host, Machine::Target] {
        assert!(front(&trade.points, machine).iter().all(|row| trade.points[*row].advisable));
    }
    let unstable: Vec<_> = trade.points.iter().filter(|point| !point.stable).collect();
    assert!(!unstable.is_empty());
    assert!(unstable.iter().all(|point| point.error.is_none() && point.energy_rms.is_none()));
    let best = |label: &str| {
        let of = trade.points.iter().filter(|point| point.stepper.label() == label);
        of.filter_map(|point| point.error).fold(f64::INFINITY, f64::min)
    };
    assert!(best("pefrl f64") < 1e-3 * best("leapfrog f64"));
    // The paper's ladder goes further down; compared are equal steps.
    let points = |label: &'static str| {
        trade.points.iter().filter(move |point| point.stepper.label() == label)
    };
    let smallest = points("leapfrog f64").map(|point| point.step).fold(1.0, f64::min);
    let paper = points("dbd f64").filter(|point| point.step > 0.9 * smallest);
    let paper = paper.filter_map(|point| point.error).fold(f64::INFINITY, f64::min);
    assert!(best("leapfrog f64") < 0.1 * paper);
    assert!(points("dbd f64").map(|point| point.step).fold(1.0, f64::min) < 0.1 * smallest);
    assert!(trade.head.uncertainty < 1e-11, "{:e}", trade.head.uncertainty);
    // Loose square roots are off by far more than single precision is, at any step.
    assert!(best("leapfrog f32-micromath") > 100.0 * best("leapfrog f32"));
    let counted = |label: &str| {
        let mut of = trade.points.iter().filter(|point| point.stepper.label() == label);
        of.next().and_then(|point| point.target_instructions.map(|count| count * point.step))
    };
    // As docs/costs.csv has them.
    let costs = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/costs.csv");
    let costs = fs::read_to_string(costs).unwrap();
    let written = |row: &str| -> f64 {
        let line = costs.lines().find(|line| line.starts_with(row)).unwrap();
        line.split(',').nth(4).unwrap().parse().unwrap()
    };
    let agrees = |label: &str, row: &str| {
        counted(label).is_some_and(|count| (count / written(row) - 1.0).abs() < 1e-9)
    };
    assert!(agrees("leapfrog f32", "four-bar,leapfrog,f32,"));
    assert_eq!(counted("std leapfrog f64"), None);
    // The paper's scheme is the reference on the target, too.
    assert!(agrees("dbd f64", "four-bar,dbd,f64,"));
    for advice in advice(&trade.points, Machine::Target, trade.head.uncertainty) {
        assert!(!advice.sentence.contains("stable step"), "{}", advice.sentence);
    }
    let front = front(&trade.points, Machine::Host);
    let errors: Vec<_> = front.iter().map(|row| trade.points[*row].error.unwrap()).collect();
    assert!(errors.len() > 3 && errors.windows(2).all(|pair| pair[1] < pair[0]));
}

/// A scene with one body.
fn body(name: &str, more: &str) -> Scene {
    let text = format!(
        "name = \"{name}\"\nduration = 0.2\nstep = 1e-3\nevery = 5e-3\n[[body]]\nname = \"b\"\nmass = 1.0\n\
         inertia = [0.02, 0.03, 0.04]\nposition = [0.0, 0.0, 0.0]\n{more}"
    );
    Scene::parse(&text, "a.toml").unwrap()
}

fn survey_of(scene: &Scene) -> Trade {
    survey(scene, &TradeOptions::default(), &mut |_| ()).unwrap()
}

#[test]
fn a_free_rotors_error_is_that_of_its_attitude() {
    let trade = survey_of(&body("rotor", "angular_velocity = [9.0, 20.0, 3.0]\n"));
    let points = &trade.points;
    assert_eq!(remark(points, Machine::Host), None);
    let errors = |label: &str| -> Vec<f64> {
        let of = points.iter().filter(|point| point.stepper.label() == label);
        of.filter_map(|point| point.error).collect()
    };
    let (leapfrog, pefrl) = (errors("leapfrog f64"), errors("pefrl f64"));
    assert!(leapfrog.iter().all(|error| *error > 0.0), "{leapfrog:?}");
    // A smaller step is better, and so is a better scheme.
    assert!(leapfrog.last() < leapfrog.first() && pefrl.last() < leapfrog.last());
    for target in [1e-2, 1e-4, 1e-6] {
        if let Some(row) = choice(points, Machine::Host, target, true) {
            assert_ne!(points[row].stepper.precision, "f32-micromath");
        }
    }
}

/// A pendulum whose motion out of its plane is faster than all in it: what the plane bears, space need not.
#[test]
fn a_planar_scenes_points_have_the_stable_step_in_space_beside_them() {
    let pin = "angular_velocity = [0, 0, 3]\nvelocity = [0, 0.9, 0]\n[[joint]]\nname = \"pin\"\n\
               type = \"revolute\"\nbetween = [\"world\", \"b\"]\nat = [-0.3, 0, 0]\naxis = [0, 0, 1]\n\
               span = 0.2\nstiffness = 1e7\n";
    let space = body("pendulum", pin).with("body.b.inertia=[0.02, 0.021, 0.04]").unwrap();
    let scene = space.with("planar=true").unwrap();
    let trade = survey_of(&scene);
    let limits = Limits::of(&space);
    let leapfrog = Method::default();
    let stable = limits.limit(&Way::Kernel(leapfrog), Some(limits.found(&leapfrog))).stable;
    for point in &trade.points {
        match point.stepper.scheme.as_str() {
            "leapfrog" => assert_eq!(point.step_in_space, Some(stable)),
            _ => assert!(point.step_in_space.unwrap() > 0.0, "{}", point.stepper.label()),
        }
    }
    let beyond = |point: &&Point| point.advisable && Some(point.step) > point.step_in_space;
    assert!(trade.points.iter().filter(beyond).count() > 5);
    let report = Report { scene: &scene, called: "pendulum", trade: &trade };
    let said = |piece: &Piece| matches!(piece, Piece::Sentence(s) if s.contains("is planar"));
    assert!(report.pieces().iter().any(said));
}

/// A load that begins and ends within steps leaves any scheme first order, and the choice says so; single
/// precision says from which step on a smaller one buys nothing.
#[test]
fn what_limits_an_order_is_said_with_the_choice() {
    let spring = "[[tsda]]\nbetween = [\"world\", \"b\"]\npoints = [[0, 0, 0], [0.3, 0, 0]]\n\
                  stiffness = 1e3\nfree_length = 0.25\n";
    let load = "[[load]]\nbody = \"b\"\nforce = [0.0, 5.0, 0.0]\nfrom = 0.01234567\n\
                until = 0.1111111\n";
    let orders = |more: &str| {
        let trade = survey_of(&body("loaded", &format!("{spring}{more}")));
        let fall = |label: &str| {
            let of = trade.points.iter().filter(|point| point.stepper.label() == label);
            of.filter(|point| point.advisable).map(|point| point.fall).nth(3).unwrap()
        };
        let said: Vec<String> = advice(&trade.points, Machine::Host, trade.head.uncertainty)
            .into_iter()
            .map(|advice| advice.sentence)
            .collect();
        (fall("pefrl f64"), fall("pefrl f32"), said.join("\n"))
    };
    let why = "loads or tables change within its steps";
    let (calm, single, said) = orders("");
    assert!((calm.order.unwrap() - 4.0).abs() < 0.5 && calm.cause.is_none(), "{calm:?}");
    assert!(single.finest.is_some() && !said.contains(why), "{single:?}\n{said}");
    let (driven, ..) = orders(load);
    assert_eq!(driven.cause, Some(Cause::LoadsAndTables), "{driven:?}");
}

#[test]
fn a_body_at_rest_has_no_unstable_step_and_no_error() {
    let trade = survey_of(&body("rest", ""));
    let points = &trade.points;
    assert!(points.iter().all(|point| point.stable && !point.lost));
    assert_eq!(remark(points, Machine::Host), Some("every error is zero"));
}

#[test]
fn every_step_of_a_survey_is_one_that_a_run_accepts() {
    for (name, window) in [("spring-ball", 0.137), ("gyroscope", 1e-3)] {
        let scene = scene(name);
        let trade = trade(name, window, None);
        let command = Command::new(&scene, name);
        for point in trade.points.iter().filter(|point| point.stepper.kernel) {
            let line = command.line(point).unwrap();
            let step = line.split(" --step ").nth(1).unwrap().parse::<Time>().unwrap().seconds();
            assert_eq!(step.to_bits(), point.step.to_bits(), "{line}");
            let step = StepRequest::Given(step);
            let request = Request { step, duration: scene.duration, every: scene.every };
            assert!(plan(&request).is_ok(), "{line}");
        }
    }
}
