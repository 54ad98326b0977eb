use dbd_plant::PrecisionName;

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
    let (head, truth) = look(scene, 0, frame, &mut |_| ()).unwrap();
    Search::new(scene, request, head, truth)
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

/// What is left out because it cannot be cheaper is not cheaper: of all ways at their longest steps none is.
#[test]
fn nothing_that_was_not_run_is_cheaper() {
    let (scene, request) = (arm(), request(None));
    let mut search = search(&scene, &request);
    let (count, mut run) = (search.candidates.len(), Vec::new());
    for accuracy in [1e-3, 1e-5] {
        let best = search.cheapest(accuracy, &BTreeSet::new()).unwrap();
        assert!(best.error <= accuracy);
        run.push(search.counts().0);
        let of = |row| search.longest(row, accuracy, f64::INFINITY);
        let all: Vec<Trial> = (0..count).filter_map(of).collect();
        let cheapest = all.iter().map(Trial::cost).fold(f64::INFINITY, f64::min);
        assert_eq!(best.cost(), cheapest, "{accuracy:e}");
        // A broken way is passed over.
        let next = search.cheapest(accuracy, &[best.candidate].into()).unwrap();
        assert!(next.candidate != best.candidate && next.cost() >= best.cost());
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

/// A softer joint gives what its frequency says, and a spring that is the mechanism's own is left alone.
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

/// A stricter accuracy costs more, and is kept; the run that verifies goes over the whole scene.
#[test]
fn accuracy_is_paid_for() {
    let of = |accuracy| recommend(&arm(), &request(Some(accuracy)), &mut |_| ()).unwrap();
    let [coarse, fine] = [1e-5, 1e-8].map(of);
    assert!(coarse.meets && coarse.way.error <= 1e-5, "{coarse:#?}");
    assert!(fine.meets && fine.way.error <= 1e-8 && fine.limit == Limit::Accuracy, "{fine:#?}");
    assert!(fine.way.load > coarse.way.load);
    assert_eq!(fine.verified.0, (0.2 / fine.way.step).round() as u64);
    let beyond = recommend(&arm(), &request(Some(1e-20)), &mut |_| ());
    assert!(matches!(beyond, Err(AdviseError::Accuracy { .. })));
}
