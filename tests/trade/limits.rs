//! What is advised is stable: within the margin of what `check --stability` finds, with dampers, in
//! space, on the scenes that ship and on random damped linkages.

use dbd_kernel::State;
use dbd_kernel::damping::Damping;
use dbd_plant::{DampingName, Frequencies, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_study::limits::{Limit, Limits};
use dbd_study::stability::{MARGIN, Vibration, stability};
use dbd_study::ways::{Way, ways};
use dbd_study::words::percent;
use dbd_tests::{scene, scene_names};
use host_sim::commands::warnings::of_step;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::linkage::Linkage;

fn explicit(scheme: SchemeName) -> Method {
    let method = Method::new(scheme, None, PrecisionName::F64).unwrap();
    method.with_damping(DampingName::Explicit).unwrap()
}

/// The limit of a method as a survey has it.
fn limit(limits: &Limits, method: &Method) -> Limit {
    limits.limit(&Way::Kernel(*method), Some(limits.found(method)))
}

/// \[J\] the largest energy of a run over 0.2 s, infinite where it failed.
fn largest_energy(scene: &Scene, method: &Method, step: f64) -> f64 {
    let mut plant = plant(scene, method, step).unwrap();
    let mut largest = 0.0_f64;
    while plant.steps() as f64 * step < 0.2 {
        if plant.advance(50).is_err() {
            return f64::INFINITY;
        }
        largest = largest.max(plant.energy().total().abs());
    }
    largest
}

/// Seven bars whose dampers, at the velocities of a step's start, leave the modes out of the plane
/// a shorter step than springs alone would. In the plane, exactly, nothing shows: the run of a survey
/// stays calm at a step that diverges from 1e-6 m/s out of the plane of one body.
#[test]
fn a_mode_out_of_the_plane_is_not_overlooked() {
    let flat = Linkage {
        bars: 7,
        mass: 3.0,
        stiffness: 5e6,
        damping: 165.0,
        height: 0.4,
        out_of_plane: 0.0,
    };
    let aside = Linkage { out_of_plane: 1e-6, ..flat }.scene();
    let flat = flat.scene();
    let limits = Limits::of(&flat);
    for method in [explicit(SchemeName::SemiImplicitEuler), explicit(SchemeName::Dbd)] {
        // The largest rung of a ladder on the limit of an undamped oscillator.
        let undamped = 0.98 * method.stability_limit() / limits.highest();
        let calm = largest_energy(&flat, &method, undamped);
        let torn = largest_energy(&aside, &method, undamped);
        assert!(calm < 150.0 && torn > 10.0 * calm, "{method:?}: {calm:e} J, {torn:e} J");
        let limit = limit(&limits, &method);
        assert!(limit.is_beyond(undamped) && !limit.advises(undamped), "{method:?}: {limit:?}");
        let kept = largest_energy(&aside, &method, limit.advised);
        assert!((kept / calm - 1.0).abs() < 1e-3, "{method:?}: {kept:e} J of {calm:e} J");
    }
}

/// The pages ask for the margin that the code keeps.
#[test]
fn the_margin_is_that_of_the_pages() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/command-line.md");
    let page = std::fs::read_to_string(path).unwrap();
    let margin = format!("a margin of {}", percent(MARGIN));
    assert_eq!(page.matches("a margin of ").count(), page.matches(&margin).count());
    assert_eq!(page.matches(&margin).count(), 2, "{margin}");
}

/// A run warns of a step beyond what the highest frequency allows, and of one that turns a body too far: no advised step
/// does either, not where the bound of the frequency allows less either.
#[test]
fn an_advised_step_is_taken_without_a_warning() {
    let mut beyond_bound = 0;
    for name in ["four-bar", "gyroscope", "spring-ball", "3rrr", "macpherson"] {
        let scene = scene(name);
        let (frequencies, limits) = (Frequencies::of(&scene), Limits::of(&scene));
        for way in ways(&scene, false) {
            let Way::Kernel(method) = way else { continue };
            let advised = limits.limit(&way, None).advised;
            let said = |step| {
                let all = of_step(&scene, &frequencies, &method, step, "the step");
                all.iter().any(|said| {
                    said.contains("exceeds the stability limit") || said.contains("turns by")
                })
            };
            assert!(!said(advised), "{name}, {method:?}: {advised:e}");
            beyond_bound += usize::from(frequencies.bound * advised > method.stability_limit());
            let stable = method.stability_limit() / limits.highest();
            assert!(stable.is_infinite() || said(1.01 * stable), "{name}, {method:?}: {stable:e}");
        }
    }
    assert!(beyond_bound > 0, "no bound is far above the frequency");
    // Where a spin allows less than a vibration, the spin decides.
    let text = "name = \"top\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\n\
                inertia = [1, 1, 2]\nposition = [0, 0, 0]\nangular_velocity = [0, 0, 400]\n";
    let top = Scene::parse(text, "top.toml").unwrap();
    let way = Way::Kernel(Method::default());
    let limit = Limits::of(&top).limit(&way, None);
    assert!(limit.stable.is_infinite() && (limit.advised - 0.1 / 400.0).abs() < 1e-12);
    let said = Frequencies::of(&top).warning(&top, 1.1 * limit.advised).unwrap();
    assert!(said.contains("turns by"), "{said}");
}

/// Each way's advised step, on all scenes that ship: stable when it is run, in space, dampers
/// included, the margin on top of it, too.
#[test]
fn what_is_advised_on_the_shipped_scenes_is_stable() {
    for name in scene_names() {
        let scene = scene(&name);
        let limits = Limits::of(&scene);
        let vibration = Vibration::about(&scene.model, &State::initial(&scene.model)).unwrap();
        let damped = !scene.model.dampers.is_empty();
        let mut seen = Vec::new();
        for way in ways(&scene, false) {
            let Some(method) = limits.decisive(&way) else { continue };
            if seen.contains(&method) {
                continue;
            }
            seen.push(method);
            // Without dampers a method's limit is that of one oscillator, to a few per cent; with
            // them one method is looked at closely, for it takes seconds.
            let searched = damped && method == explicit(SchemeName::SemiImplicitEuler);
            let found = searched.then(|| limits.found(&method));
            let limit = limits.limit(&way, found);
            // Most of the margin is there.
            let z = limit.advised * (1.0 + 0.6 * MARGIN) * vibration.frequency;
            if searched || !damped || method.damping() != Damping::Explicit {
                assert!(vibration.is_stable(&method, z), "{name}, {method:?}: {limit:?}");
            }
        }
        assert!(seen.len() >= 8, "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4, failure_persistence: None, rng_seed: RngSeed::Fixed(2297), ..Default::default()
    })]

    /// Whatever the bars and dampers: no way is advised a step beyond what `check --stability`
    /// finds for it, less the margin; nor one that differs from it by more.
    #[test]
    fn no_step_is_advised_that_a_check_refuses(
        bars in 2_usize..4,
        mass in 0.5..5.0,
        height in 0.15..0.6,
        ratio in 0.0..1.2,
        which in 0_usize..100,
    ) {
        let stiffness = 4e6;
        let undamped =
            Linkage { bars, mass, stiffness, damping: 0.0, height, out_of_plane: 0.0 };
        let highest = Limits::of(&undamped.scene()).highest();
        // Up to strong dampers: ratio is that of the fastest mode.
        let scene = Linkage { damping: 2.0 * ratio * stiffness / highest, ..undamped }.scene();
        let limits = Limits::of(&scene);
        let state = State::initial(&scene.model);
        let all = ways(&scene, true);
        let kernel: Vec<&Way> = all.iter().filter(|way| way.method().is_some()).collect();
        let way = kernel[which % kernel.len()];
        let Way::Kernel(method) = way else { unreachable!() };
        let limit = limits.limit(way, limits.decisive(way).map(|method| limits.found(&method)));
        let checked = match stability(&scene.model, &state, method) {
            Ok(found) => found.unwrap().largest_step,
            // There is no check of micromath, and no advice.
            Err(_) => { prop_assert!(!way.stepper().is_exact()); return Ok(()) }
        };
        if method.stability_limit().is_infinite() {
            // Stable as far as the scan goes, which is no limit.
            prop_assert!(limit.advised > checked, "{:?}: {:?}, scanned {:e}", method, limit, checked);
            return Ok(());
        }
        let most = (1.0 - MARGIN) * checked;
        prop_assert!(limit.advised <= most, "{:?}: {:?}, checked {:e}", method, limit, checked);
        // Dampers may lengthen a stable step: what they add is not advised.
        let undamped = (1.0 - MARGIN) * method.stability_limit() / limits.highest();
        prop_assert!(limit.advised > 0.93 * most.min(undamped), "{:?}: {:?}, checked {:e}", method, limit, checked);
        prop_assert!(!limit.advises(checked) && limit.is_beyond(1.02 * checked));
    }
}
