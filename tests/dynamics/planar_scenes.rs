//! How far planar scenes move apart from the spatial ones: the table of docs/planar.md.

use dbd_kernel::{
    F64, Leapfrog, Planar32, Planar64, Plant, SemiImplicitEuler, State, Vec3, frequency,
};
use dbd_scene::planar::Planar;
use dbd_scene::{Scene, SceneModel, widen};
use dbd_tests::{page, scene, scene_names};

/// \[s\] the longest that is compared.
const LONGEST: f64 = 1.0;

/// Instants at which both runs are compared.
const INSTANTS: u64 = 100;

/// What a comparison found, \[m\].
#[derive(Default)]
struct Found {
    /// How far centres of mass move from where they begin.
    moved: f64,
    /// How far the same centres are apart.
    apart: f64,
    /// How far those of the spatial run with half the step are apart from it.
    step: f64,
    /// How far the spatial run leaves the plane.
    off: f64,
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

fn duration(scene: &Scene) -> f64 {
    scene.duration.min(LONGEST)
}

/// The world's states of a planar run.
fn outward(planar: &Planar, state: &State<SceneModel<Planar64>>) -> State<SceneModel<F64>> {
    let mut state = widen(state);
    planar.states_outward(&mut state.bodies);
    state
}

fn compared(scene: &Scene, planar: &Planar) -> Found {
    let step = scene.step.unwrap();
    let flat: SceneModel<Planar64> = planar.model.convert();
    let mut whole = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let mut flat = Plant::new(&flat, Leapfrog, step).unwrap();
    let mut fine = Plant::new(&scene.model, Leapfrog, step / 2.0).unwrap();
    let mut found = Found::default();
    let per_instant = (duration(scene) / step / INSTANTS as f64) as u64;
    for _ in 0..INSTANTS {
        assert!(whole.advance(per_instant).is_ok() && flat.advance(per_instant).is_ok());
        fine.advance(2 * per_instant).unwrap();
        let other = outward(planar, flat.state());
        let pairs = whole.state().bodies.iter().zip(&other.bodies);
        for ((own, other), start) in pairs.zip(&scene.model.initial) {
            found.moved = found.moved.max(length(own.position - start.position));
            found.apart = found.apart.max(length(own.position - other.position));
            found.off = found.off.max(planar.plane.place_inward(own.position).z.abs());
        }
        for (own, fine) in whole.state().bodies.iter().zip(&fine.state().bodies) {
            found.step = found.step.max(length(own.position - fine.position));
        }
    }
    found
}

fn bound_hz(model: &SceneModel<F64>) -> f64 {
    frequency::bound(model, &State::initial(model)) / std::f64::consts::TAU
}

#[test]
fn the_page_says_how_far_planar_runs_are_apart_from_spatial_ones() {
    let mut table = "| scene | TSDAs | highest frequency ≤ \\[Hz\\] | time | moved \\[m\\] | apart \\[m\\] | half the step \\[m\\] | off \\[m\\] |\n\
                     |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let mut seen = 0;
    for name in scene_names() {
        let scene = scene(&name);
        let Ok(planar) = dbd_scene::reduced(&scene) else { continue };
        seen += 1;
        let Found { moved, apart, step, off } = compared(&scene, &planar);
        // It is the same mechanism, unless that tells apart whatever differs at all.
        assert!(apart < 0.05 * moved || step > 0.05 * moved, "{name}: {apart} of {moved}");
        table += &format!(
            "| {name} | {} → {} | {:.0} → {:.0} | {} s | {moved:.2} | {apart:.1e} | {step:.1e} | {off:.0e} |\n",
            scene.model.tsda_count(),
            planar.model.tsda_count(),
            bound_hz(&scene.model),
            bound_hz(&planar.model),
            duration(&scene),
        );
    }
    assert_eq!(seen, 16);
    page::block("docs/planar.md", "planar", &table);
}

/// A planar model and the same in space at z = 0, in the bits of neither but to rounding.
#[test]
fn three_freedoms_are_those_of_six_at_rest_across() {
    for name in ["hexagon", "crank-slider", "cart-pendulum"] {
        let scene = scene(name);
        let planar = dbd_scene::reduced(&scene).unwrap_or_else(|found| panic!("{found:?}"));
        let step = scene.step.unwrap();
        let flat: SceneModel<Planar64> = planar.model.convert();
        let single: SceneModel<Planar32> = planar.model.convert();
        let mut flat = Plant::new(&flat, SemiImplicitEuler, step).unwrap();
        let mut single = Plant::new(&single, SemiImplicitEuler, step).unwrap();
        let mut space = Plant::new(&planar.model, SemiImplicitEuler, step).unwrap();
        assert!(flat.advance(1000).is_ok() && space.advance(1000).is_ok());
        single.advance(1000).unwrap();
        for (row, own) in widen(flat.state()).bodies.iter().enumerate() {
            let other = space.state().bodies[row];
            // In space the dampers of guides act off the plane, too.
            assert!(length(own.position - other.position) < 1e-9, "{name}: {own:?} {other:?}");
            let rough = widen(single.state()).bodies[row];
            assert!(length(own.position - rough.position) < 1e-4, "{name}: {own:?} {rough:?}");
        }
    }
}
