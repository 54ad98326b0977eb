//! A model in rows has the bits of its plant by itself.

use std::num::NonZeroUsize;

use dbd_kernel::geometry::{Float, Named};
use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::{BodyIndex, F64, Leapfrog, Plant, Real, Vec3};
use dbd_scene::{Scene, SceneModel};

use super::plan::Plan;
use super::share::{Share, along_joints, in_order};
use super::{InRows, Rowed, Unfit, fits};
#[cfg(target_arch = "x86_64")]
use crate::InstructionSet;
use crate::batch::PlantOf;
use crate::register::{Doubles, Register, Singles};
#[cfg(target_arch = "x86_64")]
use crate::register::{Doubles256, Doubles512, Singles256, Singles512};

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
    threads: usize,
) -> PlantOf<V::Number, Leapfrog> {
    let threads = NonZeroUsize::new(threads).unwrap();
    let mut alone = plant::<V::Number>(model, step);
    assert_eq!(fits(alone.model()), Ok(()), "{name}");
    let mut rows = InRows::<V>::new(plant(model, step), threads);
    for steps in [1, 70, 64, 30] {
        let status = rows.advance(steps);
        let what = format!("{name}, {}, {} lanes, {threads} threads", V::Number::NAME, V::LANES);
        assert_eq!(alone.advance(steps), status, "{what}");
        assert_eq!(rows.plant().hash(), alone.hash(), "{what}");
    }
    alone
}

fn in_every_register(name: &str, model: &SceneModel<F64>, step: f64, runs: bool) {
    let mut ended = vec![compare::<Doubles>(name, model, step, 1).status()];
    ended.push(compare::<Singles>(name, model, step, 3).status());
    #[cfg(target_arch = "x86_64")]
    if InstructionSet::Avx2.is_there() {
        ended.push(compare::<Doubles256>(name, model, step, 2).status());
        ended.push(compare::<Singles256>(name, model, step, 1).status());
    }
    #[cfg(target_arch = "x86_64")]
    if InstructionSet::Avx512.is_there() {
        ended.push(compare::<Doubles512>(name, model, step, 1).status());
        ended.push(compare::<Singles512>(name, model, step, 2).status());
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

/// Joints between bodies that do not follow one another, several of a body, some to the ground, in any order.
#[test]
fn a_tangle_has_the_bits_of_the_plant_by_itself() {
    let mut random = 7_u64;
    let mut below = |most: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (random >> 33) as usize % most
    };
    for joints in [1, 13, 30] {
        let (mut model, step) = shipped("chain-open-30");
        model.groups.truncate(joints);
        for group in &mut model.groups {
            group.b = BodyIndex(below(model.bodies.len()) as u16);
            group.a = if below(5) == 0 { BodyIndex::WORLD } else { BodyIndex(below(4) as u16) };
        }
        for spring in &mut model.tsdas {
            spring.stiffness = 1.0 + below(100) as f64;
        }
        in_every_register(&format!("a tangle of {joints}"), &model, step, true);
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
fn what_was_changed_goes_on_as_by_itself() {
    let (model, step) = shipped("chain-open-30");
    let mut alone = plant::<f64>(&model, step);
    let mut rows = InRows::<Doubles>::new(plant(&model, step), NonZeroUsize::MIN);
    for push in [0.0, 0.1, -0.2] {
        for plant in [&mut alone, rows.plant_mut()] {
            let mut state = plant.state().clone();
            state.bodies[4].velocity.x += push;
            plant.set_state(state).unwrap();
        }
        assert_eq!(alone.advance(70), rows.advance(70));
        assert_eq!(alone.hash(), rows.plant().hash());
    }
    alone.reset();
    rows.plant_mut().reset();
    assert_eq!(alone.advance(3), rows.advance(3));
    assert_eq!(alone.hash(), Box::new(rows).into_plant().hash());
}

/// Of a chain nothing is copied but what its ends lack.
#[test]
fn a_chain_lies_in_line() {
    let joints: Vec<_> = (0..100_usize).map(|body| (body.checked_sub(1), body)).collect();
    let share = &Share::all(&joints, joints.len(), 1)[0];
    for lanes in [2, 4, 8, 16] {
        let plan = Plan::new(&joints, share, lanes);
        assert_eq!(plan.poses.copied, []);
        assert!(plan.done.copied.len() <= lanes, "{lanes}");
        assert!(plan.joints.iter().flatten().copied().eq(0..100));
    }
}

/// A chain whose bodies stand in any order is one that lies in line.
#[test]
fn bodies_may_stand_as_joints_come_to_them() {
    // 2 is a primitive root of 101.
    let at = |place: usize| (0..place).fold(1, |power, _| 2 * power % 101) - 1;
    let joints: Vec<_> = (0..100).map(|i: usize| (i.checked_sub(1).map(at), at(i))).collect();
    let order = along_joints(&joints, 101);
    assert!(order.iter().copied().eq((0..100).map(at).chain([100])));
    let in_line = in_order(&joints, &order);
    assert!(Plan::copies(&in_line, 101, 4) <= 4);
    assert!(Plan::copies(&joints, 100, 4) > 100);
}

/// A closed chain of three threads: each has a guest at either end, and the joints to them.
#[test]
fn joints_across_a_border_are_of_both_threads() {
    let joints: Vec<_> = (0..9).map(|body| (Some((body + 8) % 9), body)).collect();
    let shares = Share::all(&joints, 9, 3);
    let seen: Vec<_> = shares.iter().map(|share| (&share.joints[..], &share.guests[..])).collect();
    let ends = [&[3, 8][..], &[2, 6], &[0, 5]];
    assert_eq!(seen[0], (&[0, 1, 2, 3][..], ends[0]));
    assert_eq!(seen[1], (&[3, 4, 5, 6][..], ends[1]));
    assert_eq!(seen[2], (&[0, 6, 7, 8][..], ends[2]));
    assert_eq!(Share::all(&joints, 9, 100).len(), 9);
}

#[test]
fn what_is_more_than_joints_and_weight_does_not_fit() {
    let (plain, _) = shipped("chain-open-30");
    let unfit = |change: fn(&mut SceneModel<F64>)| {
        let mut model = plain.clone();
        change(&mut model);
        fits(&model).unwrap_err()
    };
    assert_eq!(unfit(|model| model.groups[2].shared = false), Unfit::Joint(2));
    assert_eq!(unfit(|model| model.groups[3].stars = 1), Unfit::Joint(3));
    assert_eq!(unfit(|model| model.groups[4].b = BodyIndex::WORLD), Unfit::Ends(4));
    assert_eq!(unfit(|model| model.groups[5].a = BodyIndex(30)), Unfit::Ends(5));
    assert_eq!(unfit(|model| model.groups[6].damper = DamperIndex(0)), Unfit::Damper(6));
    assert_eq!(unfit(|model| model.groups[7].clearance = ClearanceIndex(0)), Unfit::Clearance(7));
    assert_eq!(unfit(|model| model.gravity[0].z = -0.0), Unfit::Weight(0));
    for (name, why) in
        [("four-bar", Unfit::Torsion), ("gripper", Unfit::Input), ("3ruu", Unfit::Torsion)]
    {
        assert_eq!(fits(&shipped(name).0), Err(why), "{name}");
    }
    let mut loaded = plain.clone();
    loaded.loads = shipped("crank-slider").0.loads;
    assert_eq!(fits(&loaded), Err(Unfit::Load));
}
