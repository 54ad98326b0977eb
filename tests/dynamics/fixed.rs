//! Fixed point: every scene and scheme beside double precision, energies, places far from the origin, limits.

use dbd_bench::kept::{Keeper, Kept};
use dbd_kernel::forces::wrenches;
use dbd_kernel::plant::{InputError, PlantError, StateError};
use dbd_kernel::{
    BlanesMoanS6, BodyState, Cause, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Fixed, Geometry,
    JointWise, Leapfrog, Pefrl, Plant, Rk4, Scheme, SemiImplicitEuler, Vec3,
};
use dbd_scene::{Scene, SceneModel, widen};
use dbd_tests::{distance, scene, scene_names};

/// Bodies after some steps of the scene's own.
fn end<P: Geometry, S: Scheme>(
    model: &SceneModel<F64>,
    scheme: S,
    step: f64,
    steps: u64,
) -> Vec<BodyState<F64>> {
    let model: SceneModel<P> = model.convert();
    let mut plant = Plant::new(&model, scheme, step).unwrap();
    plant.advance(steps).unwrap();
    widen(plant.state()).bodies
}

/// Bodies of a scene in fixed point, in single and in double precision, each beside double precision with its own
/// constants \[m\].
fn off<S: Scheme + Copy>(scene: &Scene, scheme: S, steps: u64) -> [f64; 2] {
    fn of<P: Geometry, S: Scheme + Copy>(scene: &Scene, scheme: S, steps: u64) -> f64 {
        // A number of single precision, or the runs would not be at the same time.
        let step = f64::from(scene.step.unwrap() as f32);
        let exact = scene.model.convert::<P>().convert::<F64>();
        let own = end::<P, S>(&scene.model, scheme, step, steps);
        distance(&own, &end::<F64, S>(&exact, scheme, step, steps))
    }
    [of::<Fixed, S>(scene, scheme, steps), of::<F32, S>(scene, scheme, steps)]
}

#[test]
fn every_scene_moves_nearly_as_in_double_precision() {
    let (mut fixed, mut single) = (0.0, 0.0);
    for name in scene_names() {
        let [own, plain] = off(&scene(&name), Leapfrog, 2_000);
        assert!(own < 1e-7, "{name}: {own:e} m, in single precision {plain:e} m");
        // Where single precision is as exact, nothing moves far.
        assert!(own < plain || plain < 1e-8, "{name}: {own:e} m, in single precision {plain:e} m");
        fixed += own.max(1e-12).ln();
        single += plain.max(1e-12).ln();
    }
    let times = ((single - fixed) / scene_names().len() as f64).exp();
    assert!(times > 10.0, "{times}");
}

#[test]
fn every_scheme_has_it() {
    for name in ["3ruu", "double-wishbone", "crank-slider"] {
        let scene = scene(name);
        macro_rules! near {
            ($($scheme:expr),*) => {$(
                let [own, single] = off(&scene, $scheme, 500);
                assert!(own < 2e-8 && own < single, "{name} {:?}: {own:e} {single:e}", $scheme);
            )*};
        }
        near!(
            Dbd { newton: 1 },
            DbdP1::default(),
            DbdP2::default(),
            SemiImplicitEuler,
            Explicit(Leapfrog),
            JointWise(Leapfrog),
            JointWise(SemiImplicitEuler),
            Pefrl,
            BlanesMoanS6,
            Rk4
        );
    }
}

/// A whole model elsewhere: its bodies, and the points of the ground.
fn moved(model: &SceneModel<F64>, by: [f64; 3]) -> SceneModel<F64> {
    let (mut model, by) = (model.clone(), Vec3::from_f64(by));
    for body in &mut model.initial {
        body.position = body.position + by;
    }
    for group in &model.groups {
        let first = usize::from(group.point);
        let middle = first + usize::from(group.triples);
        for (end, rows) in [(group.a, first..middle), (group.b, middle..first + group.points())] {
            if end.is_world() {
                model.points[rows].iter_mut().for_each(|point| *point = *point + by);
            }
        }
    }
    model
}

/// Not nearly, but bit for bit: places are integers, and forces know their differences alone.
#[test]
fn far_from_the_origin_every_bit_is_the_same() {
    const PLACE: [i64; 3] = [10 << 57, -(10 << 57), 20 << 57];
    for name in ["hexagon", "3ruu", "double-wishbone", "crank-slider", "cart-pendulum"] {
        let scene = scene(name);
        let here: SceneModel<Fixed> = scene.model.convert();
        let mut away: SceneModel<Fixed> = moved(&scene.model, [10.0, -10.0, 20.0]).convert();
        // The sum in double precision has a digit less or two.
        for (away, here) in away.initial.iter_mut().zip(&here.initial) {
            for (axis, place) in PLACE.into_iter().enumerate() {
                away.position.at[axis] = here.position.at[axis] + place;
            }
        }
        let step = scene.step.unwrap();
        let mut plants = [&here, &away].map(|model| Plant::new(model, Leapfrog, step).unwrap());
        for plant in &mut plants {
            plant.advance(1_000).unwrap();
        }
        let [here, away] = plants.each_ref().map(|plant| &plant.state().bodies);
        for (here, away) in here.iter().zip(away) {
            let mut back = *away;
            for (at, place) in back.position.at.iter_mut().zip(PLACE) {
                *at -= place;
            }
            assert_eq!(*here, back, "{name}");
        }
    }
}

/// \[J\] the largest change of the energy that leapfrog keeps.
fn change<P: Geometry>(model: &SceneModel<F64>, step: f64, steps: u64) -> f64 {
    let model: SceneModel<P> = model.convert();
    let exact: SceneModel<F64> = model.convert();
    let mut keeper = Keeper::new(&exact, Kept::KickDriftKick, step).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
    let start = keeper.energies(&widen(plant.state())).unwrap().kept;
    let mut most = 0.0_f64;
    for _ in 0..steps / 1_000 {
        plant.advance(1_000).unwrap();
        let now = keeper.energies(&widen(plant.state())).unwrap().kept;
        most = most.max((now - start).abs());
    }
    most
}

#[test]
fn rounding_takes_no_energy_that_counts() {
    let hexagon = scene("hexagon");
    let [fixed, single] = [change::<Fixed>, change::<F32>]
        .map(|change| change(&hexagon.model, f64::from(2e-5_f32), 50_000));
    assert!(fixed < 1e-6, "{fixed:e} J");
    assert!(100.0 * fixed < single, "{fixed:e} J, in single precision {single:e} J");
}

const FLIER: &str = r#"
    name = "flier"
    duration = 10
    [[body]]
    name = "ball"
    mass = 1
    inertia = [1, 1, 1]
    position = [0, 0, 0]
    velocity = [50, 0, 0]
    [[tsda]]
    name = "tether"
    between = ["world", "ball"]
    points = [[0, 0, 0], [0, 0, 0]]
    stiffness = 1e-3
    free_length = 0
    [[input]]
    name = "post"
    type = "anchor"
    target = "tether"
    axis = [0, 1, 0]
"#;

/// It flies on until it is too far away, and never comes back from the other side.
#[test]
fn who_flies_beyond_the_limits_is_stopped_by_name() {
    let scene = Scene::parse(FLIER, "flier.toml").unwrap_or_else(|error| panic!("{error:?}"));
    let model: SceneModel<Fixed> = scene.model.convert();
    for step in [1e-4, 1e-3, 2.4e-3] {
        let mut plant = Plant::new(&model, Leapfrog, step).unwrap();
        let failure = loop {
            let before = widen(plant.state()).bodies[0].position.x;
            if let Err(failure) = plant.step() {
                break failure;
            }
            assert!(widen(plant.state()).bodies[0].position.x > before);
        };
        let at = failure.step as f64 * step * 50.0;
        assert!(matches!(failure.cause, Cause::Extent { .. }), "{failure:?}");
        assert!((23.9..24.2).contains(&at), "{step}: {at} m");
        assert!(plant.step().is_err());
    }
    // A step in which it would go too far is none.
    let refused = Plant::new(&model, Leapfrog, 1e-2).map(|_| ());
    assert!(matches!(refused, Err(PlantError::Extent(_))), "{refused:?}");
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let input = scene.input("post").unwrap();
    assert_eq!(plant.set_signal(input, 7.5, 0.0), Err(InputError::Extent(input)));
    assert_eq!(plant.set_signal(input, 6.5, 0.0), Ok(()));
    let mut state = plant.state().clone();
    state.bodies[0].position = Fixed::position_from_f64([0.0, -25.0, 0.0]);
    assert!(matches!(plant.set_state(state), Err(StateError::Extent(_))));
}

const ALONE: &str = r#"
name = "alone"
duration = 1.0
step = 1e-4
gravity = [0.3, 0.0, -9.81]
[[body]]
name = "body"
mass = 0.7
inertia = [0.01, 0.02, 0.03]
position = [0.1, 0.2, 0.3]
velocity = [0.0, 0.0, 4.0]
"#;

/// Gravity is no force of a step there; what asks for forces has the weights all the same.
#[test]
fn bodies_fall_by_velocity_and_weigh_what_they_weigh() {
    let model: SceneModel<Fixed> = Scene::parse(ALONE, "alone").unwrap().model.convert();
    let mut plant = Plant::new(&model, Leapfrog, 1e-4).unwrap();
    let found = &wrenches(&model, plant.state(), 1e-4).unwrap()[0];
    assert_eq!(found.force, model.gravity[0] * 0.7);
    assert_eq!(found.torque, Vec3::new(0.0, 0.0, 0.0));
    plant.advance(10_000).unwrap();
    let velocity = Fixed::velocity_to_f64(&plant.state().bodies[0].velocity);
    let half = model.gravity[0] * (0.5 * 1e-4_f32);
    for (own, (half, start)) in
        velocity.into_iter().zip(half.to_f64().into_iter().zip([0.0, 0.0, 4.0]))
    {
        assert!((own - (start + 20_000.0 * half)).abs() < 1e-10, "{own:e}");
    }
}
