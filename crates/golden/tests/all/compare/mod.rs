//! What a comparison finds, and how it says so.

mod words;

use crate::shared::{four_bar, plant, record, scene};
use dbd_golden::{
    Bands, Comparison, Component, Difference, Golden, Head, Identity, Mismatch, Moment, Recorder,
    Recording, Subject as _, Tolerance,
};
use dbd_kernel::{F32, F64, Leapfrog, Pefrl, Plant};
use std::sync::LazyLock;

static TEXT: LazyLock<String> = LazyLock::new(|| four_bar().text());

fn difference(of: Box<Mismatch<String>>) -> Difference<String> {
    match *of {
        Mismatch::Difference(difference) => difference,
        other => panic!("{other}"),
    }
}

#[test]
fn a_run_is_equal_to_itself() {
    let recording = four_bar();
    let same = recording.compare(&TEXT, &Tolerance::Bits).unwrap();
    assert!(same.is_equal() && same.samples == 5);
    let same = recording.compare(&TEXT, &Tolerance::Within(Bands::all(0.0))).unwrap();
    assert!(same.is_equal());
}

#[test]
fn the_first_difference_is_named() {
    let scene = scene("four-bar");
    let mut plant = plant::<F32>(&scene);
    let mut recording = Recording::of_scene(&scene, &plant, 50, &[]).unwrap();
    for sample in 0..=4 {
        if sample == 2 {
            let mut state = plant.state().clone();
            let x = &mut state.bodies[1].position.x;
            *x = f32::from_bits(x.to_bits() + 2);
            plant.set_state(state).unwrap();
        }
        recording.look(&plant).unwrap();
        plant.advance(50).unwrap();
    }
    let mismatch = recording.compare(&TEXT, &Tolerance::Bits).unwrap_err();
    let words = mismatch.to_string();
    let found = difference(mismatch);
    assert_eq!((found.step, found.equal, found.ulps), (100, Some(50), Some(2)));
    let component = Component::Body { body: "coupler".to_owned(), column: 0 };
    assert_eq!((found.component, found.differing, found.numbers), (component, 1, 41));
    let off = (found.present - found.golden).abs();
    assert_eq!(found.furthest.quantities[0], Some((off, "coupler".to_owned())));
    assert_eq!(found.furthest.quantities[1..], [const { None }; 3]);
    for part in [
        "step 100 is different, step 50 was still equal",
        "coupler.x is ",
        ", golden ",
        " m, 2 ULP)",
        "1 of 41 numbers differ",
        "\n  position ",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    // What is sampled every step names the step itself.
    let fine = |nudged: bool| {
        let mut plant = crate::shared::plant::<F32>(&scene);
        plant.advance(98).unwrap();
        let mut recording = Recording::of_scene(&scene, &plant, 1, &[]).unwrap();
        for step in 98..105 {
            if nudged && step == 101 {
                let mut state = plant.state().clone();
                state.bodies[0].velocity.y += 1.0;
                plant.set_state(state).unwrap();
            }
            recording.look(&plant).unwrap();
            plant.step().unwrap();
        }
        recording
    };
    let mismatch = fine(true).compare(&fine(false).text(), &Tolerance::Bits).unwrap_err();
    assert!(mismatch.to_string().contains("step 101 is the first that is different: crank.vy"));
}

#[test]
fn turns_and_values_are_compared_too() {
    let scene = scene("four-bar");
    let mut plant = plant::<F32>(&scene);
    let mut run = |force: f64, turn: i32| {
        let names = ["force", "flag"];
        let bodies: Vec<&str> = scene.body_names.iter().map(String::as_str).collect();
        let mut run = Recording::of_plant("arm", &plant, 1, &bodies, &names).unwrap();
        let mut state = plant.state().clone();
        state.turns[1] = turn;
        plant.set_state(state).unwrap();
        run.sample(&plant, &[force, f64::NAN]).unwrap();
        run
    };
    let golden = run(0.1, 0).text();
    assert!(golden.contains("\t0.1d\tNaN\t"), "{golden}");
    assert!(run(0.1, 0).compare(&golden, &Tolerance::Bits).is_ok());
    let found = difference(run(0.2, 0).compare(&golden, &Tolerance::Bits).unwrap_err());
    assert_eq!(found.component, Component::Value { name: "force".to_owned() });
    assert_eq!((found.golden, found.present, found.equal), (0.1, 0.2, None));
    let found = difference(run(0.1, 2).compare(&golden, &Tolerance::Bits).unwrap_err());
    assert_eq!(found.component, Component::Turns { spring: 1 });
    // Bands of values are stated by name; an undefined one is like another.
    let bands = |values| Bands { values, others: None, ..Bands::all(0.0) };
    let mut within = |values| run(0.2, 0).compare(&golden, &Tolerance::Within(bands(values)));
    assert!(within(&[("force", 0.11), ("flag", 0.0)]).is_ok());
    let found = difference(within(&[("force", 0.09), ("flag", 0.0)]).unwrap_err());
    assert!(found.beyond.is_some_and(|(off, band)| (off - 0.1).abs() < 1e-15 && band == 0.09));
    assert_eq!(within(&[("force", 1.0)]), Err(Box::new(Mismatch::NoBand("flag".to_owned()))));
    let unknown = within(&[("force", 1.0), ("flag", 1.0), ("flap", 1.0)]);
    assert_eq!(unknown, Err(Box::new(Mismatch::UnknownBand("flap".to_owned()))));
}

#[test]
fn each_thing_that_is_another_has_its_own_message() {
    let text = &*TEXT;
    let refused = |recording: Recording| *recording.compare(text, &Tolerance::Bits).unwrap_err();
    let words = |mismatch: &Mismatch<String>, parts: [&str; 2]| {
        let words = mismatch.to_string();
        assert!(parts.iter().all(|part| words.contains(part)), "{parts:?}: {words}");
    };
    let of = scene("four-bar");
    let model = || Box::new(of.model.convert::<F32>());

    let mismatch = refused(record(&mut plant::<F64>(&of)));
    assert!(matches!(mismatch, Mismatch::Precision { .. }));
    words(&mismatch, ["f32", "f64"]);

    let pefrl = Plant::new(model(), Pefrl, 2e-5).unwrap();
    let mismatch = refused(Recording::of_scene(&of, &pefrl, 50, &[]).unwrap());
    assert!(matches!(mismatch, Mismatch::Scheme { .. }));
    words(&mismatch, ["leapfrog (sweeps, 1 per step)", "pefrl"]);

    let mismatch = refused(record(&mut Plant::new(model(), Leapfrog, 1e-5).unwrap()));
    assert_eq!(mismatch, Mismatch::Step { golden: 2e-5, present: 1e-5 });
    words(&mismatch, ["2e-5", "1e-5"]);

    let mut heavier = of.clone();
    heavier.model.bodies[0].mass = 1.001;
    let mismatch = refused(record(&mut plant::<F32>(&heavier)));
    assert!(matches!(mismatch, Mismatch::Model { golden, present } if golden != present));
    words(&mismatch, ["another model", "hash"]);

    let mut renamed = of.clone();
    renamed.name = "bar".into();
    let mismatch = refused(Recording::of_scene(&renamed, &plant::<F32>(&of), 50, &[]).unwrap());
    words(&mismatch, ["`four-bar`", "`bar`"]);

    let mut renamed = of.clone();
    renamed.body_names[1] = "rod".into();
    let mismatch = refused(Recording::of_scene(&renamed, &plant::<F32>(&of), 50, &[]).unwrap());
    assert!(matches!(mismatch, Mismatch::Column { number: 16, .. }), "{mismatch}");
    words(&mismatch, ["`coupler.x`", "`rod.x`"]);

    let mismatch = refused(Recording::of_scene(&of, &plant::<F32>(&of), 25, &[]).unwrap());
    assert_eq!(mismatch, Mismatch::Every { golden: 50, present: 25 });
    words(&mismatch, ["50", "25"]);

    let next = text.replacen("golden 1", "golden 7", 1);
    let mismatch = four_bar().compare(&next, &Tolerance::Bits).unwrap_err();
    words(&mismatch, ["version 7", "expected 1"]);

    // A run that ends early, and one that goes on.
    let short = Recording::of_scene(&of, &plant::<F32>(&of), 50, &[]).unwrap();
    assert_eq!(refused(short), Mismatch::Sample { golden: Some(0), present: None });
    let mut long = plant::<F32>(&of);
    let mut recording = record(&mut long);
    recording.look(&long).unwrap();
    assert_eq!(refused(recording), Mismatch::Sample { golden: None, present: Some(250) });
}

/// Another scheme or precision is compared where bands are stated for any method, and only there.
#[test]
fn other_methods_are_compared_within_bands() {
    let of = scene("four-bar");
    let double = record(&mut plant::<F64>(&of));
    let any = |band| double.compare(&TEXT, &Tolerance::AnyMethod(Bands::all(band)));
    let summary = any(0.1).unwrap();
    let far = summary.furthest.quantities.map(|far| far.map_or(0.0, |(distance, _)| distance));
    assert!(far.iter().all(|distance| *distance > 0.0 && *distance < 0.1), "{far:?}");
    let found = difference(any(1e-9).unwrap_err());
    let (off, band) = found.beyond.unwrap();
    assert!(off > 1e-9 && band == 1e-9 && found.differing > 1);
    // Counted in the golden run's numbers, not in those of the run.
    let single = |x: f64| i64::from((x as f32).to_bits());
    let between = (single(found.golden) - single(found.present)).unsigned_abs();
    assert_eq!(found.ulps, Some(between));
    let words = any(1e-9).unwrap_err().to_string();
    assert!(words.contains("beyond its band") && words.contains("its band is 1e-9"), "{words}");
    let within = double.compare(&TEXT, &Tolerance::Within(Bands::all(1e-3))).unwrap_err();
    assert!(matches!(*within, Mismatch::Precision { .. }));
    // A band of each quantity is its own.
    let wide = Bands::all(1.0);
    for (bands, end) in [
        (Bands { position: 0.0, ..wide }, [".x", ".y", ".z"].as_slice()),
        (Bands { orientation: 0.0, ..wide }, &[".qw", ".qx", ".qy", ".qz"]),
        (Bands { velocity: 0.0, ..wide }, &[".vx", ".vy", ".vz"]),
        (Bands { angular_velocity: 0.0, ..wide }, &[".wx", ".wy", ".wz"]),
    ] {
        let refused = double.compare(&TEXT, &Tolerance::AnyMethod(bands)).unwrap_err();
        let name = difference(refused).component.to_string();
        assert!(end.iter().any(|end| name.ends_with(end)), "{name}");
    }
    // What is no number is within no band.
    let mut broken = plant::<F32>(&of);
    let mut recording = Recording::of_scene(&of, &broken, 50, &[]).unwrap();
    let mut state = broken.state().clone();
    state.bodies[2].velocity.z = 1e30;
    broken.set_state(state).unwrap();
    while broken.step().is_ok() {}
    recording.sample(&Shifted(&broken), &[]).unwrap();
    let refused = recording.compare(&TEXT, &Tolerance::Within(Bands::all(f64::MAX)));
    assert!(difference(refused.unwrap_err()).beyond.is_some_and(|(off, _)| !off.is_finite()));
}

/// A moment that says it is the first.
struct Shifted<'p, M>(&'p M);

impl<M: Moment> Moment for Shifted<'_, M> {
    fn steps_done(&self) -> u64 {
        0
    }
    fn state_hash(&self) -> u64 {
        self.0.state_hash()
    }
    fn body_numbers(&self, row: usize) -> Option<[f64; 13]> {
        self.0.body_numbers(row).map(|body| body.map(|x| if x.abs() > 1e9 { f64::NAN } else { x }))
    }
    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.0.turn_count(spring)
    }
}

/// As a firmware does it: no recording, no file, names as constants.
#[test]
fn a_firmware_prints_and_compares_what_a_pc_does() {
    let of = scene("four-bar");
    let mut plant = plant::<F32>(&of);
    const BODIES: [&str; 3] = ["crank", "coupler", "rocker"];
    let identity: Identity<'static> = plant.identity();
    let head = Head { scene: "four-bar", identity, every: 50, bodies: &BODIES, values: &[] };
    let mut printed = Recorder::begin(String::new(), &head).unwrap();
    let mut comparison =
        Comparison::new(Golden::read(&TEXT).unwrap(), head, Tolerance::Bits).unwrap();
    while let Some(due) = comparison.due() {
        while plant.state().step < due {
            assert!(!comparison.look(&plant, &[]).unwrap());
            assert!(!printed.look(&plant, &[]).unwrap());
            plant.step().unwrap();
        }
        assert!(comparison.look(&plant, &[]).unwrap());
        assert!(printed.look(&plant, &[]).unwrap());
    }
    assert_eq!(comparison.finish().unwrap().samples, 5);
    assert_eq!(printed.finish().unwrap(), *TEXT);
    let console = format!("boot\n{}tick 7\n", &*TEXT);
    assert_eq!(dbd_golden::recording::within(&console), Some(TEXT.as_str()));
    assert_eq!(dbd_golden::recording::within(&TEXT), Some(TEXT.as_str()));
    assert_eq!(dbd_golden::recording::within("boot\n# end: 0"), None);
}

/// What does not fit is refused when it is recorded.
#[test]
fn a_record_that_does_not_fit_is_refused() {
    let of = scene("four-bar");
    let mut plant = plant::<F32>(&of);
    let refused = |error: dbd_golden::recording::RecordingError, part: &str| {
        assert!(error.to_string().contains(part), "{part}: {error}");
    };
    let new = |every, bodies: &[&str]| Recording::of_plant("a", &plant, every, bodies, &[]);
    refused(new(5, &["a"]).unwrap_err(), "1 names are given for 3 bodies");
    refused(new(5, &["a", "b\t", "c"]).unwrap_err(), "control character");
    refused(new(0, &["a", "b", "c"]).unwrap_err(), "at least one step");
    let unknown = Recording::of_scene(&of, &plant, 5, &["torq"]).unwrap_err();
    refused(unknown, "has no readout `torq`");
    let mut recording = Recording::of_scene(&of, &plant, 5, &[]).unwrap();
    recording.look(&plant).unwrap();
    refused(recording.sample(&plant, &[]).unwrap_err(), "is not after");
    plant.advance(4).unwrap();
    assert!(!recording.look(&plant).unwrap());
    plant.advance(4).unwrap();
    refused(recording.look(&plant).unwrap_err(), "due at step 5, but the plant is at step 8");
    refused(recording.look_with(&plant, &[1.0]).unwrap_err(), "due at step 5");
    refused(recording.sample(&plant, &[1.0]).unwrap_err(), "1 values are given for 0 names");
}
