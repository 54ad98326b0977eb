//! Slow motion of strongly damped elements: what a step of the order of the undamped period makes
//! of it.

use dbd_kernel::damping::Damping;
use dbd_kernel::forces::{self, At, DampersLeft};
use dbd_kernel::keep::NoStorage;
use dbd_kernel::model::Terms;
use dbd_kernel::step::Stepper;
use dbd_kernel::{
    Cause, F32, F64, Geometry, JointWise, Leapfrog, Pefrl, Plant, Real, Scheme, SemiImplicitEuler,
    State,
};
use dbd_scene::{Scene, SceneModel};
use dbd_study::reference::trajectory::Trajectory;
use dbd_tests::mechanisms::Random;
use dbd_tests::page::{block, table};
use dbd_tests::scene;
use nalgebra::Vector3;

/// Leapfrog with sweeps that are told of no kick: before the first and after the second.
#[derive(Clone, Copy)]
struct SweepsAlone;

impl Scheme for SweepsAlone {
    const NAME: &'static str = "sweeps-alone";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    type Memory<P: Geometry> = ();
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        1
    }

    fn stability_limit(&self) -> f64 {
        2.0
    }

    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        if !stepper.is_fresh() {
            stepper.evaluate::<DampersLeft>(At::Boundary)?;
        }
        stepper.sweep_forward();
        stepper.kick(P::Real::HALF);
        stepper.drift(stepper.step_size());
        stepper.evaluate::<DampersLeft>(At::Boundary)?;
        stepper.kick(P::Real::HALF);
        stepper.sweep_reverse();
        Ok(())
    }
}

/// One body of 1 kg that gravity of 1 m/s² along −z pulls from rest.
struct Creep {
    scene: Scene,
    /// \[N/m\] of its mount along z.
    stiffness: f64,
}

/// Steps per radian of the undamped vibration.
const FINENESS: f64 = 10.0;

impl Creep {
    fn new(mount: &str) -> Self {
        let text = format!(
            "name = \"creep\"\nduration = 1\ngravity = [0, 0, -1]\n[[body]]\nname = \"b\"\nmass = 1\n\
             inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\n{mount}"
        );
        let scene = Scene::parse(&text, "creep.toml").unwrap();
        let mut state = State::initial(&scene.model);
        let by = 1e-7;
        state.bodies[0].position.z += by;
        let wrench = &forces::wrenches(&scene.model, &state, 1e-3).unwrap()[0];
        let stiffness = -(wrench.force.z + 1.0) / by;
        Self { scene, stiffness }
    }

    /// \[s\] a step.
    fn step(&self) -> f64 {
        1.0 / (FINENESS * self.stiffness.sqrt())
    }

    /// The model with dampers of `damping` \[1/s\] over the mass along z.
    fn damped<P: Geometry>(&self, damping: f64) -> SceneModel<P> {
        let mut model = self.scene.model.clone();
        let per_stiffness = damping / self.stiffness;
        let stiffnesses = model.tsdas.iter().map(|tsda| tsda.stiffness);
        let stiffnesses = stiffnesses.chain(model.bushings.iter().map(|b| b.stiffness));
        let dampers: Vec<f64> = stiffnesses.map(|k| k * per_stiffness).collect();
        // Those of bushings have rows for their levers behind their coefficients.
        model.dampers.fill(0.0);
        model.dampers[..dampers.len()].copy_from_slice(&dampers);
        model.convert()
    }

    /// How far it sank \[m\] under such dampers after a time \[s\].
    fn sunk(&self, damping: f64, t: f64) -> f64 {
        let omega = self.stiffness.sqrt();
        let half = 0.5 * damping;
        let square = half * half - omega * omega;
        let share = if square > 0.0 {
            let root = square.sqrt();
            let fast = -half - root;
            let slow = -self.stiffness / (half + root);
            (fast * (slow * t).exp() - slow * (fast * t).exp()) / (fast - slow)
        } else {
            let root = (-square).sqrt();
            (-half * t).exp() * ((root * t).cos() + half / root * (root * t).sin())
        };
        (1.0 - share) / self.stiffness
    }

    /// The largest error of the motion in 1,000 steps, as a share of the motion, with dampers for
    /// which h·c/m along z is `x`.
    fn error<P: Geometry, S: Scheme>(&self, scheme: S, x: f64) -> f64 {
        let damping = x / self.step();
        let model = self.damped::<P>(damping);
        let mut plant = Plant::new(&model, scheme, self.step()).unwrap();
        let [mut error, mut motion] = [0.0_f64; 2];
        for i in 1..=100 {
            plant.advance(10).unwrap();
            let sunk = -P::position_to_f64(&plant.state().bodies[0].position)[2];
            let reference_solution = self.sunk(damping, f64::from(10 * i) * self.step());
            error = error.max((sunk - reference_solution).abs());
            motion = motion.max(reference_solution);
        }
        error / motion
    }
}

/// A joint of the world and the body.
fn joint(keys: &str) -> String {
    format!(
        "[[joint]]\nname = \"j\"\nbetween = [\"world\", \"b\"]\nat = [0, 0, 0]\nstiffness = 1e5\n\
         damping = 1\n{keys}\n"
    )
}

/// A raw element between the world and the body.
fn tsda(above: f64, stiffness: f64) -> String {
    format!(
        "[[tsda]]\nbetween = [\"world\", \"b\"]\npoints = [[0, 0, {above:?}], [0, 0, 0]]\n\
         stiffness = {stiffness:?}\ndamping = 1\nfree_length = {above:?}\n"
    )
}

/// h·c/m of the tables.
const STRENGTHS: [f64; 9] = [1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e4];

/// A body on a mount creeps as it ought to, whatever the mount's dampers: one alone, two side by side
/// and three at right angles to all digits of the scheme, those of a revolute, which cross, to a
/// fraction of what sweeps that know nothing of the forces make of it.
#[test]
fn strong_dampers_let_creep_what_they_should() {
    let side_by_side = tsda(1.0, 1e4) + &tsda(1.0, 3e4);
    let revolute = |axis: &str| joint(&format!("type = \"revolute\"\naxis = {axis}\nspan = 0.1"));
    let mounts = [
        ("a TSDA", tsda(1.0, 1e4)),
        ("two side by side, c and 3·c", side_by_side),
        ("a point bushing", tsda(0.0, 1e4)),
        ("a spherical joint", joint("type = \"spherical\"\narm = 0.1")),
        ("a revolute, along its axis", revolute("[0, 0, 1]")),
        ("a revolute, across it", revolute("[1, 0, 0]")),
    ];
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |title: String, errors: [f64; 9]| {
        rows.push([title].into_iter().chain(errors.map(|error| format!("{error:.1e}"))).collect());
    };
    let mut joint_wise = Vec::new();
    for (i, (name, mount)) in mounts.iter().enumerate() {
        let creep = Creep::new(mount);
        let alone = STRENGTHS.map(|x| creep.error::<F64, _>(SweepsAlone, x));
        let errors = STRENGTHS.map(|x| creep.error::<F64, _>(Leapfrog, x));
        let crossing = i >= 4;
        let joint = name.starts_with("a revolute") || name.starts_with("a spherical");
        if joint {
            // Nothing in a joint crosses: as true as a damper alone.
            let at_once = STRENGTHS.map(|x| creep.error::<F64, _>(JointWise(Leapfrog), x));
            assert!(at_once[1..].iter().all(|error| *error < 2e-3), "{name}: {at_once:?}");
            joint_wise.push((format!("{name}, `leapfrog`, joint-wise"), at_once));
        }
        for ((x, error), alone) in STRENGTHS.into_iter().zip(errors).zip(alone) {
            // Up to 0.01 the phase of a thousand steps of vibration decides.
            let most = match x {
                0.01.. if !crossing => 2e-3,
                0.01..=1.0 => 2e-3,
                ..0.01 => 2e-2,
                _ => 0.3 * alone,
            };
            assert!(error < most, "{name}, {x}: {error:e}, alone {alone:e}");
            assert!(error < 1.02 * alone, "{name}, {x}: {error:e}, alone {alone:e}");
        }
        row(format!("{name}, `leapfrog`"), errors);
        if i == 0 {
            // Slow motion in single precision moves by few digits of a position per step.
            let single = STRENGTHS.map(|x| creep.error::<F32, _>(Leapfrog, x));
            assert!(single[1..].iter().all(|error| *error < 2e-3), "{single:?}");
            row("the same in f32".to_owned(), single);
            let euler = STRENGTHS.map(|x| creep.error::<F64, _>(SemiImplicitEuler, x));
            assert!(euler.iter().all(|error| *error < 4e-2) && euler[8] < 1e-5, "{euler:?}");
            row("`semi-implicit-euler`".to_owned(), euler);
            let composed = STRENGTHS.map(|x| creep.error::<F64, _>(Pefrl, x));
            assert!(composed[3] < 1e-2 && composed[4] > 1e-2, "{composed:?}");
            row("`pefrl`".to_owned(), composed);
        }
        if i == 0 || crossing {
            row("passes without the kick".to_owned(), alone);
        }
    }
    joint_wise.into_iter().for_each(|(title, errors)| row(title, errors));
    let strengths = STRENGTHS
        .map(|x| if !(0.1..1e3).contains(&x) { format!("{x:.0e}") } else { x.to_string() });
    let head: Vec<&str> = [""].into_iter().chain(strengths.iter().map(String::as_str)).collect();
    block("docs/schemes-measured.md", "overdamped", &table(&head, &rows));
}

/// A bushing twenty times more damped than critically, at ever longer steps: h·c/m from 1 to 64.
#[test]
fn a_bushing_at_twenty_times_the_critical_damping() {
    let creep = Creep::new(&tsda(0.0, 1e4));
    let omega = creep.stiffness.sqrt();
    for z in [0.025, 0.1, 0.4, 1.6] {
        let error = |mut plant: Box<dyn FnMut(u64) -> f64>, h: f64| {
            let steps = (0.25 / h) as u64;
            let sunk = plant(steps);
            let reference_solution = creep.sunk(40.0 * omega, steps as f64 * h);
            (sunk / reference_solution - 1.0).abs()
        };
        let h = z / omega;
        let model = creep.damped::<F64>(40.0 * omega);
        let alone = error(Box::new(sunk(model.clone(), SweepsAlone, h)), h);
        let after = error(Box::new(sunk(model, Leapfrog, h)), h);
        assert!(after < 2e-2 * z && after < 0.1 * alone, "{z}: {after:e}, {alone:e}");
    }
}

/// How far a body sinks in so many steps.
fn sunk<S: Scheme + 'static>(model: SceneModel<F64>, scheme: S, h: f64) -> impl FnMut(u64) -> f64 {
    let mut plant = Plant::new(Box::new(model), scheme, h).unwrap();
    move |steps| {
        plant.advance(steps).unwrap();
        -plant.state().bodies[0].position.z
    }
}

/// Cars on rubber: the same step is more exact than with sweeps that know nothing of the forces, and
/// both are of second order.
#[test]
fn suspensions_are_more_exact_at_equal_steps() {
    for (name, window, steps) in
        [("macpherson", 0.05, [2e-4, 1e-4]), ("double-wishbone", 0.1, [4e-4, 2e-4])]
    {
        let scene = scene(name);
        let reference_solution = Trajectory::reference_solution(&scene, window, 10).unwrap();
        let mut errors = Vec::new();
        for step in steps {
            let every = (reference_solution.times[1] / step).round() as u64;
            let h = reference_solution.times[1] / every as f64;
            let alone = worst(
                &reference_solution,
                Plant::new(&scene.model, SweepsAlone, h).unwrap(),
                every,
            );
            let reported =
                worst(&reference_solution, Plant::new(&scene.model, Leapfrog, h).unwrap(), every);
            assert!(reported < 0.5 * alone, "{name}, {step}: {reported:e}, {alone:e}");
            errors.push([alone, reported]);
        }
        for (long, short) in errors[0].into_iter().zip(errors[1]) {
            let order = (long / short).log2();
            assert!((order - 2.0).abs() < 0.1, "{name}: {order}");
        }
    }
}

/// \[m\] the largest distance of a body from the truth.
fn worst<S: Scheme>(
    reference_solution: &Trajectory,
    mut plant: Plant<&SceneModel<F64>, S>,
    every: u64,
) -> f64 {
    let positions = |plant: &Plant<&SceneModel<F64>, S>| -> Vec<Vector3<f64>> {
        plant.state().bodies.iter().map(|body| body.position.to_f64().into()).collect()
    };
    let mut run = vec![positions(&plant)];
    for _ in 1..reference_solution.times.len() {
        plant.advance(every).unwrap();
        run.push(positions(&plant));
    }
    reference_solution.errors(&run).into_iter().fold(0.0, f64::max)
}

/// An undamped oscillator's leapfrog keeps `½·v² + ½·ω²·(1 − (ω·h)²/4)·q²`; dampers, alone or side by
/// side, never add to it where it is positive, over a whole step, whatever their strength and the
/// step.
#[test]
fn a_damped_step_never_adds_energy() {
    let mut random = Random(7);
    for _ in 0..4000 {
        let count = 1 + (random.unit() * 3.0) as usize;
        let mut text = String::new();
        for _ in 0..count {
            text += &tsda(0.0, 1e4 * (0.1 + random.unit()));
        }
        let creep = Creep::new(&text);
        let omega = creep.stiffness.sqrt();
        let z = 1.95 * random.unit() + 0.01;
        let mut model = creep.scene.model.clone();
        for damper in &mut model.dampers {
            *damper = omega / z * 10_f64.powf(8.0 * random.unit() - 3.0);
        }
        model.gravity.clear();
        model.initial[0].position.z = random.unit() - 0.5;
        model.initial[0].velocity.z = omega * (random.unit() - 0.5);
        let kept = |plant: &Plant<&SceneModel<F64>, Leapfrog>| {
            let body = plant.state().bodies[0];
            let (q, v) = (body.position.z, body.velocity.z / omega);
            v * v + (1.0 - 0.25 * z * z) * q * q
        };
        let mut plant = Plant::new(&model, Leapfrog, z / omega).unwrap();
        let start = kept(&plant);
        let mut most = start;
        for _ in 0..50 {
            plant.advance(1).unwrap();
            most = most.max(kept(&plant));
        }
        assert!(
            most <= start * (1.0 + 1e-13),
            "{z}: {} of {start}, {:?}",
            most / start,
            model.dampers
        );
    }
}
