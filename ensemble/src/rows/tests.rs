//! A model in rows has the bits of its plant by itself.

use dbd_kernel::geometry::{Float, Named};
use dbd_kernel::{F64, Leapfrog, Plant, Real, Vec3};
use dbd_scene::{Scene, SceneModel};

use super::{InRows, Rowed, fits};
#[cfg(target_arch = "x86_64")]
use crate::InstructionSet;
use crate::batch::PlantOf;
use crate::register::{Doubles, Register, Singles};
#[cfg(target_arch = "x86_64")]
use crate::register::{Doubles256, Singles256};

/// A scene that ships, and its step.
fn shipped(name: &str) -> (SceneModel<F64>, f64) {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let scene = Scene::parse(&std::fs::read_to_string(&path).unwrap(), &path).unwrap();
    (scene.model, scene.step.unwrap())
}

fn plant<R: Real + Named>(model: &SceneModel<F64>, step: f64) -> PlantOf<R, Leapfrog> {
    Plant::new(Box::new(model.convert::<Float<R>>()), Leapfrog, step).unwrap()
}

/// Steps a model in rows and by itself, in parts that are no blocks, and compares all bits.
fn compare<V: Register>(
    name: &str,
    model: &SceneModel<F64>,
    step: f64,
) -> PlantOf<V::Number, Leapfrog> {
    let mut alone = plant::<V::Number>(model, step);
    assert_eq!(fits(alone.model()), Ok(()), "{name}");
    let mut rows = InRows::<V>::new(plant(model, step));
    for steps in [1, 70, 64, 30] {
        let status = rows.advance(steps);
        let what = format!("{name}, {}, {} lanes", V::Number::NAME, V::LANES);
        assert_eq!(alone.advance(steps), status, "{what}");
        assert_eq!(rows.plant().hash(), alone.hash(), "{what}");
    }
    alone
}

fn in_every_register(name: &str, model: &SceneModel<F64>, step: f64, runs: bool) {
    let mut ended = vec![compare::<Doubles>(name, model, step).status()];
    ended.push(compare::<Singles>(name, model, step).status());
    #[cfg(target_arch = "x86_64")]
    if InstructionSet::Avx2.is_there() {
        ended.push(compare::<Doubles256>(name, model, step).status());
        ended.push(compare::<Singles256>(name, model, step).status());
    }
    assert!(ended.iter().all(|status| status.is_running() == runs), "{name}: {ended:?}");
}

/// Closed and open, with the ground at one end, at both and at none; in the plane and tumbling.
#[test]
fn rows_have_the_bits_of_the_plant_by_itself() {
    for name in ["hexagon", "chain-open-30", "chain-closed"] {
        let (mut model, step) = shipped(name);
        in_every_register(name, &model, step, true);
        for (row, state) in model.initial.iter_mut().enumerate() {
            let push = 0.01 * (row % 5) as f64;
            state.velocity = state.velocity + Vec3::new(push, -push, 0.5 * push);
            state.angular_velocity = state.angular_velocity + Vec3::new(0.3 * push, 0.0, push);
        }
        in_every_register(&format!("{name}, tumbling"), &model, step, true);
        model.gravity.clear();
        in_every_register(&format!("{name}, without gravity"), &model, step, true);
    }
}

#[test]
fn what_fails_fails_as_by_itself() {
    let (mut model, step) = shipped("chain-open-30");
    in_every_register("unstable", &model, 30.0 * step, false);
    model.initial[3].angular_velocity = Vec3::new(0.0, 0.0, 2.0 / step);
    in_every_register("too fast", &model, step, false);
}

#[test]
fn what_is_more_than_joints_and_weight_does_not_fit() {
    for name in ["gripper", "four-bar", "cart-pendulum", "3ruu", "macpherson"] {
        assert!(fits(&shipped(name).0).is_err(), "{name}");
    }
}
