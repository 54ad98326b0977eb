use dbd_plant::{Method, PrecisionName};

use super::*;
use crate::stability::MARGIN;

/// A body of 1 kg on a joint and on a soft spring.
const ARM: &str = r#"
    name = "arm"
    duration = 0.2
    gravity = [0, -9.81, 0]
    [[body]]
    name = "arm"
    mass = 1
    inertia = [0.001, 0.01, 0.01]
    position = [0.15, 0, 0]
    [[joint]]
    name = "pivot"
    type = "revolute"
    between = ["world", "arm"]
    at = [0, 0, 0]
    axis = [0, 0, 1]
    span = 0.05
    stiffness = 1e6
    [[tsda]]
    name = "spring"
    between = ["world", "arm"]
    points = [[0.15, 0.2, 0], [0.15, 0, 0]]
    stiffness = 100
    free_length = 0.1
"#;

fn arm() -> Scene {
    Scene::parse(ARM, "arm.toml").unwrap()
}

fn request(accuracy: Option<f64>) -> Request {
    let mcu = Mcu::of_name("cortex-m4f").unwrap();
    let window = Some(0.1);
    Request { mcu, clock: mcu.clock, rate: None, accuracy, window, shipped: None }
}

fn search<'s>(scene: &'s Scene, request: &'s Request) -> Search<'s> {
    let options = TradeOptions { window: request.window, ..TradeOptions::default() };
    let frame = frame(scene, &options).unwrap();
    let (head, reference_solution) = look(scene, 0, frame, &mut |_| ()).unwrap();
    Search::new(scene, request, head, reference_solution)
}

/// Leapfrog in double precision on the scene as it is, at its longest step.
fn leapfrog(search: &mut Search<'_>) -> Trial {
    let wanted = Method::default().with_precision(PrecisionName::F64);
    let is = |row: &usize| {
        let candidate = search.candidates[*row];
        candidate.model == 0 && candidate.method == wanted
    };
    let row = (0..search.candidates.len()).find(is).unwrap();
    search.longest(row, f64::INFINITY, f64::INFINITY).unwrap()
}

/// Excluded methods are not cheaper at their longest steps.
#[test]
fn nothing_that_was_not_run_is_cheaper() {
    let (scene, request) = (arm(), request(None));
    let mut search = search(&scene, &request);
    let (count, mut run) = (search.candidates.len(), Vec::new());
    for accuracy in [1e-3, 1e-5] {
        let (best, _) = search.verified(accuracy).unwrap().unwrap();
        assert!(best.error <= accuracy);
        run.push(search.counts().0);
        let of = |row| search.longest(row, accuracy, f64::INFINITY);
        let all: Vec<Trial> = (0..count).filter_map(of).collect();
        let cheapest = all.iter().map(Trial::cost).fold(f64::INFINITY, f64::min);
        assert_eq!(best.cost(), cheapest, "{accuracy:e}");
    }
    assert!(run[0] < count / 2, "{run:?} of {count}");
}

/// The longest step keeps the margin below the stable one, which is 2/ω of leapfrog.
#[test]
fn vibrations_limit_a_step_by_their_frequency() {
    let (scene, request) = (arm(), Request { window: Some(0.2), ..request(None) });
    let mut search = search(&scene, &request);
    let trial = leapfrog(&mut search);
    let stable = search.stable(&trial).unwrap();
    let linear = 2.0 / Frequencies::of(&scene).estimate;
    assert!((stable / linear - 1.0).abs() < 0.02, "{stable:e} {linear:e}");
    let share = trial.step / stable;
    assert!((0.7..=1.0 - MARGIN).contains(&share), "{share}");
    // Steps are parts of the duration: one that could be longer by a tenth is limited by that.
    match search.limit(&trial) {
        Limit::Vibration { element, .. } => assert_eq!(element.as_deref(), Some("joint `pivot`")),
        limit => {
            assert!(limit == Limit::Period && share * 1.1 <= 1.0 - MARGIN, "{share} {limit:?}")
        }
    }
}

/// A softer joint has the predicted effect, and springs of the mechanism are unchanged.
#[test]
fn what_would_help_is_measured() {
    let (scene, request) = (arm(), request(None));
    let mut search = search(&scene, &request);
    let trial = leapfrog(&mut search);
    let changes = changes::of(&search, &trial);
    let [change, ..] = &changes[..] else { panic!() };
    assert_eq!(change.set, ["joint.pivot.stiffness=2.5e5"], "{change:?}");
    let measured = change.measured.unwrap();
    assert!((change.predicted - 0.5).abs() < 0.02 && (measured - 0.5).abs() < 0.05, "{change:?}");
    assert!(change.moves.is_some_and(|moves| moves > 0.0 && moves < 1e-3), "{change:?}");
    assert!(changes.iter().all(|change| !change.set[0].contains("tsda")));
}

/// A stricter accuracy costs more, and is met; the verifying run covers the whole scene.
#[test]
fn accuracy_is_paid_for() {
    let of = |accuracy| recommend(&arm(), &request(Some(accuracy)), &mut |_| ()).unwrap();
    let [coarse, fine] = [1e-5, 1e-8].map(of);
    assert!(coarse.meets && coarse.way.error <= 1e-5, "{coarse:#?}");
    assert!(fine.meets && fine.way.error <= 1e-8 && fine.limit == Limit::Accuracy, "{fine:#?}");
    assert!(fine.way.load > coarse.way.load);
    assert_eq!(fine.verified.0, (FURTHER * 0.2 / fine.way.step).round() as u64);
    let beyond = recommend(&arm(), &request(Some(1e-20)), &mut |_| ());
    assert!(matches!(beyond, Err(AdviseError::Accuracy { .. })));
}

/// A disc of 1 kg about its axle, driven by a torque that lasts.
fn driven_disc(stiffness: f64, torque: f64) -> Scene {
    let text = format!(
        "name = \"disc\"\nduration = 0.2\n[[body]]\nname = \"disc\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n\
         position = [0, 0, 0]\n[[joint]]\nname = \"axle\"\ntype = \"revolute\"\nbetween = [\"world\", \"disc\"]\n\
         at = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.05\nstiffness = {stiffness:e}\n[[load]]\nbody = \"disc\"\n\
         torque = [0, 0, {torque:?}]\n"
    );
    Scene::parse(&text, "disc.toml").unwrap()
}

/// A step that rotates the disc too far only long after the scene's end is not advised.
#[test]
fn what_fails_later_is_not_advised() {
    let asked = Request { window: Some(0.2), ..request(Some(0.05)) };
    let found = recommend(&driven_disc(1e5, 10.0), &asked, &mut |_| ()).unwrap();
    let Limit::Motion { fails } = found.limit else { panic!("{found:#?}") };
    assert!(fails > 0.2 && fails < FURTHER * 0.2 + 1e-9, "{fails}");
    assert!(found.meets && found.ends.is_none(), "{found:#?}");
    assert!((found.verified.1 - FURTHER * 0.2).abs() < 1e-9, "{found:#?}");
    // At the end it rotates at 2000 rad/s.
    assert!(found.way.step < 1.01 / 2000.0 && found.way.step > 0.25 / 2000.0, "{found:#?}");
}

/// A scene that fails beyond its duration with any step is verified over its duration, and the recommendation states
/// the failure.
#[test]
fn a_scene_that_ends_is_verified_up_to_its_duration() {
    let asked = Request { window: Some(0.2), ..request(None) };
    let arm = ARM.replace("[[tsda]]", "[[load]]\nbody = \"arm\"\ntorque = [0, 0, 60]\n[[tsda]]");
    let arm = Scene::parse(&arm, "arm.toml").unwrap();
    let found = recommend(&arm, &asked, &mut |_| ()).unwrap();
    let ends = found.ends.as_ref().unwrap();
    assert_eq!(ends.joint.as_deref(), Some("pivot"), "{found:#?}");
    assert!(ends.time > 0.2 && ends.time < FURTHER * 0.2, "{found:#?}");
    assert!(found.meets && (found.verified.1 - 0.2).abs() < 1e-9, "{found:#?}");
}
