//! Every lane has the bits of its instance stepped by itself.

#[cfg(dbd_long)]
use dbd_ensemble::Ensemble;
use dbd_ensemble::{
    AnyEnsemble, Difference, EnsembleError, InLanes, InstructionSet, Number, PlantOf,
    ensemble_in_f32, ensemble_in_f64,
};
use dbd_kernel::Cause;
use dbd_kernel::elements::source::SourceLaw;
use dbd_kernel::index::{ClearanceIndex, DamperIndex, InputIndex};
use dbd_kernel::model::{Group, Law};
#[cfg(dbd_long)]
use dbd_kernel::{BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, Pefrl, Rk4, SemiImplicitEuler};
use dbd_kernel::{
    Body, BodyIndex, BodyState, F64, Leapfrog, Plant, Quaternion, TorsionSpring, Tsda, Vec3,
};
use dbd_scene::{Scene, SceneModel};

/// The instruction sets of this machine.
fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_there())
}

/// A scene that ships, and its step.
fn shipped(name: &str) -> (SceneModel<F64>, f64) {
    let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap();
    let scene = Scene::parse(&text, &path).unwrap();
    (scene.model, scene.step.unwrap())
}

/// Instances of a model: the first as it is, every other with masses, springs, dampers, clearances,
/// tables and velocities of its own, also out of the plane of a planar mechanism.
fn instances(model: &SceneModel<F64>, count: usize) -> Vec<SceneModel<F64>> {
    let instance = |i: usize| {
        let mut own = model.clone();
        let part = 1.0 + 0.03 * i as f64;
        for (row, body) in own.bodies.iter_mut().enumerate() {
            let [x, y, z] = body.inertia.to_f64();
            let taller = 1.0 + 0.01 * ((i * 7 + row * 3) % 5) as f64;
            *body = Body::from_f64(body.mass * part, [x * part, y * part * taller, z * part]);
        }
        own.tsdas.iter_mut().for_each(|spring| spring.stiffness *= 2.0 - part);
        own.lines.iter_mut().for_each(|line| line.stiffness *= 2.0 - part);
        own.dampers.iter_mut().for_each(|damper| *damper *= part);
        own.clearances.iter_mut().for_each(|clearance| *clearance *= part);
        own.torsions.iter_mut().for_each(|spring| spring.stiffness *= part);
        own.knots.iter_mut().for_each(|knot| knot.value *= part);
        for state in &mut own.initial {
            let push = 0.02 * i as f64;
            state.velocity = state.velocity + Vec3::new(push, -push, 0.5 * push);
            let spin = state.angular_velocity;
            state.angular_velocity = spin + Vec3::new(0.3 * push, 0.0, push);
        }
        own
    };
    (0..count).map(instance).collect()
}

fn plants<R: Number, S: InLanes>(
    models: &[SceneModel<F64>],
    scheme: S,
    step: f64,
) -> Vec<PlantOf<R, S>> {
    let plant = |model: &SceneModel<F64>| Plant::new(Box::new(model.convert()), scheme, step);
    models.iter().map(|model| plant(model).unwrap()).collect()
}

/// Steps instances in lanes and by themselves, in parts that are no blocks, and compares all bits.
fn compare<R: Number, S: InLanes>(
    name: &str,
    ensemble: &mut dyn AnyEnsemble,
    mut alone: Vec<PlantOf<R, S>>,
) -> Vec<PlantOf<R, S>> {
    for steps in [1, 70, 64, 30] {
        ensemble.advance(steps);
        for (i, plant) in alone.iter_mut().enumerate() {
            let _ = plant.advance(steps);
            let what = format!("{name}, {}, {}, instance {i}", S::NAME, R::NAME);
            assert_eq!(ensemble.status(i), plant.status(), "{what}");
            assert_eq!(ensemble.hash(i), plant.hash(), "{what}");
            let counted = ensemble.evaluations(i);
            assert!(counted.is_none_or(|counted| counted == plant.evaluations()), "{what}");
        }
    }
    alone
}

/// In double precision with an instruction set.
fn in_f64(
    name: &str,
    models: &[SceneModel<F64>],
    step: f64,
    set: InstructionSet,
) -> Vec<PlantOf<f64, Leapfrog>> {
    let mut ensemble = ensemble_in_f64(models.to_vec(), step, set).unwrap();
    compare(name, ensemble.as_mut(), plants(models, Leapfrog, step))
}

/// In single precision with an instruction set.
fn in_f32(
    name: &str,
    models: &[SceneModel<F64>],
    step: f64,
    set: InstructionSet,
) -> Vec<PlantOf<f32, Leapfrog>> {
    let mut ensemble = ensemble_in_f32(models.to_vec(), step, set).unwrap();
    compare(name, ensemble.as_mut(), plants(models, Leapfrog, step))
}

/// Planar and in space, with torsion springs, points on lines, dampers, clearances, inputs.
const SCENES: [&str; 8] = [
    "hexagon",
    "gripper",
    "double-wishbone",
    "macpherson",
    "delta-pick-and-place",
    "cart-pendulum",
    "crank-slider",
    "gyroscope",
];

/// All run, and no two alike.
fn differ<R: Number, S: InLanes>(name: &str, alone: &[PlantOf<R, S>]) {
    assert!(alone.iter().all(|plant| plant.status().is_ok()), "{name}");
    assert!(alone.windows(2).all(|pair| pair[0].hash() != pair[1].hash()), "{name}");
}

#[test]
fn lanes_of_double_precision_have_the_bits_of_their_instances() {
    for name in SCENES {
        let (model, step) = shipped(name);
        for set in sets() {
            // One lane runs a twin.
            let models = instances(&model, f64::lanes(set) - 1);
            differ(name, &in_f64(name, &models, step, set));
        }
    }
}

#[test]
fn lanes_of_single_precision_have_the_bits_of_their_instances() {
    for name in SCENES {
        let (model, step) = shipped(name);
        for set in sets() {
            let models = instances(&model, f32::lanes(set) - 1);
            differ(name, &in_f32(name, &models, step, set));
        }
    }
}

/// Each scheme takes a minute to compile: `RUSTFLAGS="--cfg dbd_long" cargo test -p dbd-ensemble`.
#[cfg(dbd_long)]
#[test]
fn lanes_have_the_bits_of_their_instances_in_every_scheme() {
    fn in_scheme<S: InLanes + Send + 'static>(
        name: &str,
        models: &[SceneModel<F64>],
        scheme: S,
        step: f64,
    ) -> Vec<PlantOf<f32, S>> {
        let singles = models.iter().map(SceneModel::convert).collect();
        let mut ensemble = Ensemble::<f32, S>::new(singles, scheme, step).unwrap();
        compare(name, &mut ensemble, plants::<f32, S>(models, scheme, step))
    }
    fn every_scene<S: InLanes + Send + 'static>(scheme: S) {
        for name in ["gripper", "macpherson", "gyroscope"] {
            let (model, step) = shipped(name);
            let models = instances(&model, f32::lanes(InstructionSet::best()) - 1);
            differ(name, &in_scheme(name, &models, scheme, step));
        }
    }
    let flywheels: Vec<_> = [40.0, -40.0, 0.0, 7.0].into_iter().map(flywheel).collect();
    in_scheme("flywheel", &flywheels, BlanesMoanS6, 0.01);
    in_scheme("flywheel", &flywheels, Rk4, 0.01);
    every_scene(Explicit(Leapfrog));
    every_scene(SemiImplicitEuler);
    every_scene(Pefrl);
    every_scene(BlanesMoanS6);
    every_scene(Rk4);
    every_scene(Dbd { newton: 1 });
    every_scene(DbdP1 { newton: 0 });
    every_scene(DbdP2 { newton: 2 });
}

/// A flywheel on a torsion spring whose axis leans on no principal axis, let go with a spin about it.
fn flywheel(spin: f64) -> SceneModel<F64> {
    let axis = [0.0, 0.6, 0.8];
    SceneModel {
        bodies: vec![Body::from_f64(1.0, [0.4, 0.5, 0.6])],
        initial: vec![BodyState::<F64>::new(
            [0.0; 3],
            [1.0, 0.0, 0.0, 0.0],
            [0.0; 3],
            axis.map(|part| spin * part),
        )],
        torsions: vec![TorsionSpring {
            a: BodyIndex::WORLD,
            b: BodyIndex(0),
            axis: Vec3::from_f64(axis),
            reference: Quaternion::IDENTITY,
            stiffness: 0.02,
            preload: 0.01,
            damper: DamperIndex(0),
        }],
        dampers: vec![1e-3],
        ..SceneModel::default()
    }
}

#[test]
fn points_that_coincide_in_one_lane_give_it_no_force() {
    // A ball tied to the origin, at it or apart from it, and let go or thrown.
    let ball = |x: f64| {
        let mut model = flywheel(0.0);
        model.torsions.clear();
        model.dampers.clear();
        model.initial[0].position.x = x;
        model.initial[0].velocity.y = x;
        model.groups = vec![Group {
            law: Law::Tsda,
            a: BodyIndex::WORLD,
            b: BodyIndex(0),
            triples: 1,
            arms: 1,
            shared: false,
            point: 0,
            element: 0,
            damper: DamperIndex::NONE,
            clearance: ClearanceIndex::NONE,
        }];
        model.points = vec![Vec3::ZERO; 2];
        model.tsdas = vec![Tsda { stiffness: 30.0, free_length: 0.2 }];
        model
    };
    let models: Vec<_> = [0.5, 0.0, -0.1].into_iter().map(ball).collect();
    let alone = in_f32("ball", &models, 0.01, InstructionSet::best());
    assert_eq!(alone[1].state().bodies[0].position, Vec3::ZERO);
}

#[test]
fn each_lane_counts_its_own_turns() {
    let spins = [40.0, -40.0, 0.0, 7.0];
    let models: Vec<_> = spins.into_iter().map(flywheel).collect();
    let alone = in_f32("flywheel", &models, 0.01, InstructionSet::best());
    let turns: Vec<i32> = alone.iter().map(|plant| plant.state().turns[0]).collect();
    assert!(turns[0] > 5 && turns[1] < -5 && turns[2] == 0, "{turns:?}");
}

#[test]
fn a_failed_lane_stops_alone_with_the_bits_of_its_failure() {
    let (model, step) = shipped("gripper");
    let mut models = instances(&model, 4);
    // Too stiff for the step: it leaves the range of numbers or spins too fast.
    models[1].tsdas.iter_mut().for_each(|spring| spring.stiffness *= 1e4);
    // Fails in the first step.
    models[2].initial[0].angular_velocity = Vec3::new(0.0, 0.0, 3.0 / step);
    let alone = in_f32("gripper", &models, step, InstructionSet::best());
    let failed: Vec<bool> = alone.iter().map(|plant| plant.status().is_err()).collect();
    assert_eq!(failed, [false, true, true, false]);
    // Those that did not fail have gone on in their lanes.
    let mut ensemble = ensemble_in_f32(models, step, InstructionSet::best()).unwrap();
    ensemble.advance(165);
    let counted = [0, 1, 2, 3].map(|instance| ensemble.evaluations(instance));
    let own = |member: usize| Some(alone[member].evaluations());
    assert_eq!(counted, [own(0), None, None, own(3)]);
    assert!(matches!(
        alone[2].status(),
        Err(failure) if failure.step == 1 && matches!(failure.cause, Cause::Spin { .. })
    ));
}

#[test]
fn a_lane_without_a_twist_fails_where_its_instance_does() {
    // Half a turn about an axis normal to the spring's.
    let tumbling = |rate: f64| {
        let mut model = flywheel(0.0);
        model.initial[0].angular_velocity = Vec3::new(rate, 0.0, 0.0);
        model.torsions[0].stiffness = 0.0;
        model.torsions[0].preload = 0.0;
        model.dampers[0] = 0.0;
        model
    };
    // Exactly half a turn after 157 steps of 0.01 s.
    let rate = std::f64::consts::PI / 1.57;
    let models: Vec<_> = [0.0, rate, 0.3].into_iter().map(tumbling).collect();
    let alone = in_f32("tumbling", &models, 0.01, InstructionSet::best());
    assert!(matches!(
        alone[1].status(),
        Err(failure) if matches!(failure.cause, Cause::UndefinedTorsionAngle { .. })
    ));
    assert!(alone[0].status().is_ok() && alone[2].status().is_ok());
}

#[test]
fn an_instance_may_be_changed_between_steps() {
    let (model, step) = shipped("cart-pendulum");
    let models = instances(&model, 4);
    let mut alone = plants::<f32, _>(&models, Leapfrog, step);
    let mut ensemble = ensemble_in_f32(models, step, InstructionSet::best()).unwrap();
    for round in 0..6 {
        let value = 0.3 * f64::from(round);
        alone[1].set_input(InputIndex(0), value).unwrap();
        ensemble.set_input(1, InputIndex(0), value).unwrap();
        // One that is at another step than the others.
        if round == 3 {
            alone[2].reset();
            ensemble.reset(2);
        }
        ensemble.advance(17);
        for (i, plant) in alone.iter_mut().enumerate() {
            let _ = plant.advance(17);
            assert_eq!(ensemble.hash(i), plant.hash(), "round {round}, instance {i}");
        }
    }
    assert!(alone[0].hash() != alone[1].hash() && alone[2].state().step < alone[0].state().step);
}

/// What a sweep weighs is each lane's own.
#[test]
fn shares_of_dampers_are_each_lanes_own() {
    let (model, step) = shipped("double-wishbone");
    let mut models = instances(&model, 3);
    // Without dampers of its own a lane has none of the others' shares.
    models[1].dampers.iter_mut().for_each(|damper| *damper = 0.0);
    in_f32("double-wishbone", &models, step, InstructionSet::best());
}

/// Sines, tables that repeat and tables over what a lane's own sensor reads.
#[test]
fn sources_are_each_lanes_own() {
    let text = r#"
name = "driven"
duration = 1
[[body]]
name = "b"
mass = 2
inertia = [0.1, 0.2, 0.25]
position = [0.3, 0, 0]
[[tsda]]
between = ["world", "b"]
points = [[0, 1, 0], [0.1, 0, 0]]
stiffness = 50
free_length = 1
[[torsion_spring]]
name = "coil"
between = ["world", "b"]
axis = [0, 0, 1]
stiffness = 5
[[input]]
name = "hum"
type = "torque"
body = "b"
axis = [0, 0, 1]
sine = { amplitude = 0.5, frequency = 7 }
[[input]]
name = "beat"
type = "force"
body = "b"
axis = [0, 1, 0]
table = [[0, 1], [0.01, -1], [0.03, 1]]
periodic = true
interpolate = "linear"
[[input]]
name = "tilt"
type = "gravity"
axis = [0.6, 0, 0.8]
sine = { amplitude = 3, frequency = 5 }
[[input]]
name = "wind"
type = "force"
body = "b"
axis = [1, 0, 0]
over = "turn"
table = [[-0.02, 3], [0, 1], [0.02, -3]]
[[input]]
name = "brake"
type = "force"
body = "b"
axis = [0, 1, 0]
over = "speed.y"
table = [[-1, 3], [1, -3]]
interpolate = "linear"
[[body]]
name = "c"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1, 0, 0]
[[joint]]
name = "guide"
type = "translational"
between = ["world", "c"]
at = [1, 0, 0]
axis = [1, 0, 0]
span = 0.2
gauge = 0.2
offset = 0.05
stiffness = 1000
[[input]]
name = "push"
type = "joint_force"
target = "guide"
table = [[0, 2], [0.02, -3]]
[[readout]]
name = "turn"
type = "joint_angle"
target = "coil"
[[readout]]
name = "speed"
type = "point_velocity"
body = "b"
"#;
    let model = Scene::parse(text, "driven.toml").unwrap().model;
    let mut models = instances(&model, 3);
    for (i, own) in models.iter_mut().enumerate() {
        if let SourceLaw::Sine { amplitude, .. } = &mut own.sources[0].law {
            *amplitude *= 1.0 + i as f64;
        }
    }
    for set in sets() {
        in_f32("driven", &models, 1e-3, set);
    }
    if let SourceLaw::Sine { period, .. } = &mut models[1].sources[0].law {
        *period *= 2.0;
    }
    let found = ensemble_in_f64(models, 1e-3, InstructionSet::Baseline).err();
    let difference = Difference::Part { part: "input source", row: 0 };
    assert_eq!(found, Some(EnsembleError::Structure { instance: 1, difference }));
}

#[test]
fn the_scenes_have_what_lanes_decide_by() {
    let models = SCENES.map(|name| shipped(name).0);
    let any = |part: fn(&SceneModel<F64>) -> bool| models.iter().any(part);
    assert!(any(|model| !model.clearances.is_empty()));
    assert!(any(|model| !model.knots.is_empty()));
    assert!(any(|model| !model.lines.is_empty()));
    assert!(any(|model| !model.torsions.is_empty()));
    assert!(any(|model| model.dampers.is_empty()));
    assert!(any(|model| model.dampers.len() > 30));
}

/// Instances with interactions have the bits of plants of their own.
#[test]
fn instances_with_interactions_go_one_by_one() {
    let of = |speed: f64| {
        let text = format!(
            "name = \"b\"\nduration = 1\n[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [0, 0.001, 0]\nvelocity = [0, -{speed}, 0]\n[[interaction]]\n\
             law = \"end-stop\"\nbetween = [\"world\", \"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
             normal = [0, 1, 0]\nstiffness = 1e5\ndissipation = 0.6\n"
        );
        Scene::parse(&text, "b.toml").unwrap().model
    };
    let models: Vec<_> = [1.0, 0.5, 2.0, 0.1, 3.0].map(of).to_vec();
    let mut ensemble = ensemble_in_f64(models.clone(), 1e-4, InstructionSet::best()).unwrap();
    ensemble.advance(300);
    for (i, model) in models.iter().enumerate() {
        let mut plant = Plant::new(model, Leapfrog, 1e-4).unwrap();
        plant.advance(300).unwrap();
        assert_eq!(ensemble.hash(i), plant.hash(), "{i}");
        assert!(plant.state().bodies[0].velocity.y > 0.0, "{i} has met its stop");
    }
}
