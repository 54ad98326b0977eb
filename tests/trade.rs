//! Speed against accuracy: what a survey of a small scene comes to, kept, interrupted, repeated.

use std::fs;

use dbd_tests::scene;
use host_sim::trade::{Machine, Point, Trade, TradeOptions, front, survey};

/// A survey of a scene's first moments; `cache` where results are kept.
fn trade(name: &str, window: f64, cache: Option<&std::path::Path>) -> Trade {
    let options = TradeOptions {
        window: Some(window),
        cache: cache.map(|path| path.join("trade.cache")),
        shipped: true,
    };
    survey(&scene(name), &options, &mut |_, _| ()).unwrap()
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
    let trade = |cache| trade("four-bar", 1e-3, cache);
    let folder = tempfile::tempdir().unwrap();
    let first = trade(None);
    let kept = trade(Some(folder.path()));
    assert_eq!(accuracy(&first), accuracy(&kept));
    // The second call reads what the first has kept, times included.
    assert_eq!(trade(Some(folder.path())), kept);

    let path = folder.path().join("trade.cache");
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
}

#[cfg_attr(debug_assertions, ignore = "a minute in a debug build; release runs it")]
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
    let unstable: Vec<_> = trade.points.iter().filter(|point| !point.stable).collect();
    assert!(!unstable.is_empty());
    assert!(unstable.iter().all(|point| point.error.is_none() && point.energy_rms.is_none()));
    let best = |label: &str| {
        let of = trade.points.iter().filter(|point| point.stepper.label() == label);
        of.filter_map(|point| point.error).fold(f64::INFINITY, f64::min)
    };
    assert!(best("pefrl f64") < 1e-3 * best("leapfrog f64"));
    assert!(best("leapfrog f64") < 0.1 * best("dbd f64"));
    assert!(trade.head.uncertainty < 1e-11, "{:e}", trade.head.uncertainty);
    // Loose square roots are off by far more than single precision is, at any step.
    assert!(best("leapfrog f32-micromath") > 100.0 * best("leapfrog f32"));
    let counted = |label: &str| {
        let mut of = trade.points.iter().filter(|point| point.stepper.label() == label);
        of.next().and_then(|point| point.target_instructions.map(|count| count * point.step))
    };
    assert!(counted("leapfrog f32").is_some_and(|count| (count - 4090.0).abs() < 100.0));
    assert_eq!(counted("std leapfrog f64"), None);
    let front = front(&trade.points, Machine::Host);
    let errors: Vec<_> = front.iter().map(|row| trade.points[*row].error.unwrap()).collect();
    assert!(errors.len() > 3 && errors.windows(2).all(|pair| pair[1] < pair[0]));
}
