//! Observed orders of convergence: what each scheme states, in the plane and in space, without
//! and with dampers. The truth is a fourth-order run at a step far below.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::model::ModelOwner;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, Explicit, F64, GeneralizedAlpha,
    GeneralizedAlpha3, Leapfrog, LoadFrame, Pefrl, Rk4, Scheme, SemiImplicitEuler, Vec3,
};
use dbd_scene::Eliminated;
use dbd_tests::{Bench, distance, hung_ring, run, turned};

/// Observed orders differ from the stated ones by less.
const TOLERANCE: f64 = 0.1;

/// Two bars hung in a row in a plane, turning, on springs at points of the plane.
fn flat(damping: f64) -> Bench<F64> {
    let mut model = Bench::new();
    model.set_gravity([0.4, -9.81, 0.0]).unwrap();
    let mut bar = |x: f64, angle: f64, rate: f64| {
        let pose = turned([0.0, 0.0, 1.0], angle);
        let state = BodyState::from_f64([x, 0.0, 0.0], pose, [0.3, -0.2, 0.0], [0.0, 0.0, rate]);
        model.add_body(1.0 + x, [0.01, 0.08, 0.09], state).unwrap()
    };
    let [a, b] = [bar(0.5, 0.3, 1.5), bar(1.5, -0.4, -2.0)];
    let world = BodyIndex::WORLD;
    let mut spring = |between, points, stiffness, free_length| {
        model.add_tsda(between, points, stiffness, damping, free_length).unwrap();
    };
    spring([world, a], [[0.0, 0.1, 0.0], [-0.5, 0.0, 0.0]], 900.0, 0.1);
    spring([world, a], [[0.2, -0.6, 0.0], [-0.3, -0.1, 0.0]], 700.0, 0.0);
    spring([a, b], [[0.5, 0.1, 0.0], [-0.5, 0.0, 0.0]], 800.0, 0.05);
    spring([a, b], [[0.5, -0.2, 0.0], [-0.4, -0.1, 0.0]], 600.0, 0.15);
    model.add_torsion_spring([a, b], [0.0, 0.0, 1.0], 5.0, damping * 0.01, 1.0).unwrap();
    model
}

/// A system over a time \[s\], with its truth.
struct Case {
    title: &'static str,
    model: Bench<F64>,
    time: f64,
    reference_solution: Vec<BodyState<F64>>,
}

impl Case {
    fn new(title: &'static str, model: Bench<F64>, damped: bool, time: f64) -> Self {
        let steps = (time / 5e-5).round() as u64;
        let reference_solution = if damped {
            run(&model, Rk4, time / steps as f64, steps)
        } else {
            run(&model, BlanesMoanS6, time / steps as f64, steps)
        };
        Self { title, reference_solution: reference_solution.bodies.to_vec(), model, time }
    }

    fn error<S: Scheme>(&self, scheme: S, steps: u64) -> f64 {
        let end = run(&self.model, scheme, self.time / steps as f64, steps);
        distance(&end.bodies, &self.reference_solution)
    }

    /// Compares the order between `steps` and twice as many with the stated one.
    fn check<S: Scheme>(&self, scheme: S, stated: u32, steps: u64) {
        let (coarse, fine) = (self.error(scheme, steps), self.error(scheme, 2 * steps));
        let order = (coarse / fine).log2();
        let name = S::NAME;
        let off = (order - f64::from(stated)).abs();
        assert!(off < TOLERANCE, "{}, {name}: {order} from {coarse:e}, {fine:e}", self.title);
    }

    /// Every scheme at its steps for first, second and fourth order.
    fn check_all(&self, order: fn(u32, u32) -> u32, [first, second, fourth]: [u64; 3]) {
        macro_rules! check {
            ($($scheme:ty = $value:expr;)*) => {$(
                let stated = order(<$scheme>::ORDER, <$scheme>::ORDER_DAMPED);
                let steps = match stated {
                    1 => first,
                    2 => second,
                    _ => fourth,
                };
                self.check($value, stated, steps);
            )*};
        }
        check! {
            Dbd = Dbd::default();
            DbdP1 = DbdP1::default();
            DbdP2 = DbdP2::default();
            Dbd = Dbd { newton: 2 };
            DbdP1 = DbdP1 { newton: 1 };
            DbdP2 = DbdP2 { newton: 3 };
            SemiImplicitEuler = SemiImplicitEuler;
            Leapfrog = Leapfrog;
            Pefrl = Pefrl;
            BlanesMoanS6 = BlanesMoanS6;
            Rk4 = Rk4;
            Explicit<SemiImplicitEuler> = Explicit(SemiImplicitEuler);
            Explicit<Leapfrog> = Explicit(Leapfrog);
        }
        macro_rules! solved {
            ($($scheme:ty = $value:expr, $steps:expr;)*) => {$(
                let least = order(<$scheme>::ORDER, <$scheme>::ORDER_DAMPED);
                self.check_solved($value, least, $steps);
            )*};
        }
        solved! {
            GeneralizedAlpha = GeneralizedAlpha::DEFAULT, second;
            // Its error of third order is small: that of the next shows in longer steps.
            GeneralizedAlpha3 = GeneralizedAlpha3, 8 * fourth;
        }
    }

    /// A scheme with a matrix takes a model with a plan.
    fn check_solved<S: Scheme>(&self, scheme: S, least: u32, steps: u64) {
        let model = Eliminated::new(&self.model).unwrap();
        let [coarse, fine] = [steps, 2 * steps].map(|steps| {
            let end = run(&model, scheme, self.time / steps as f64, steps);
            distance(&end.bodies, &self.reference_solution)
        });
        let (order, title) = ((coarse / fine).log2(), self.title);
        println!("{title}, {}: {order} from {coarse:e}, {fine:e}", S::NAME);
        // Damped order is that of strong dampers: weak ones leave the other.
        let orders = f64::from(least) - TOLERANCE..f64::from(S::ORDER) + TOLERANCE;
        assert!(orders.contains(&order), "{title}, {}: {order} from {coarse:e}, {fine:e}", S::NAME);
    }
}

#[test]
fn in_the_plane() {
    let case = Case::new("plane", flat(0.0), false, 0.4);
    assert!(case.reference_solution.iter().all(|body| body.position.z == 0.0));
    case.check_all(|undamped, _| undamped, [4_000, 500, 320]);
}

#[test]
fn in_space_with_tumbling_bodies() {
    let case = Case::new("space", hung_ring(0.0), false, 0.1);
    case.check_all(|undamped, _| undamped, [4_000, 500, 320]);
}

#[test]
fn in_the_plane_with_dampers() {
    let case = Case::new("plane, damped", flat(3.0), true, 0.4);
    case.check_all(|_, damped| damped, [4_000, 500, 320]);
}

#[test]
fn in_space_with_dampers() {
    let case = Case::new("space, damped", hung_ring(2.0), true, 0.1);
    case.check_all(|_, damped| damped, [4_000, 500, 320]);
}

/// Two bars as in [`flat`], pushed by a force and shaken by the ground after tables, held or linear;
/// every knot is at a multiple of 1/40 of the time.
fn driven(damping: f64, linear: bool) -> Bench<F64> {
    let mut model = flat(damping);
    let bar = BodyIndex(1);
    let push = InputKind::Force {
        body: bar,
        point: Vec3::new(0.2, 0.1, 0.0),
        direction: Vec3::new(0.6, 0.8, 0.0),
        frame: LoadFrame::Body,
    };
    let table = [[0.0, 1.0], [0.1, 8.0], [0.15, -4.0], [0.3, 2.0]];
    model.add_table(push, &table, linear).unwrap();
    // A jump of the ground would be a jump of a length: held, it stands still.
    let table = [[0.05, 0.0], [0.2, 0.02], [0.35, -0.01]];
    let shaken = InputKind::Anchor { direction: Vec3::new(0.0, 1.0, 0.0) };
    let table = if linear { &table[..] } else { &table[..1] };
    let road = model.add_table(shaken, table, linear).unwrap();
    let between = [BodyIndex::anchor(road), BodyIndex(0)];
    model.add_tsda(between, [[0.3, -0.5, 0.0], [0.1, 0.0, 0.0]], 500.0, damping, 0.4).unwrap();
    model
}

#[test]
fn under_tables_every_scheme_keeps_its_order() {
    for (title, linear) in [("linear tables", true), ("held tables", false)] {
        let case = Case::new(title, driven(0.0, linear), false, 0.4);
        case.check_all(|undamped, _| undamped, [4_000, 800, 960]);
    }
}

#[test]
fn under_tables_every_scheme_keeps_its_order_with_dampers() {
    let case = Case::new("linear tables, damped", driven(3.0, true), true, 0.4);
    case.check_all(|_, damped| damped, [4_000, 800, 960]);
}

#[test]
fn a_free_asymmetric_body_on_a_spring() {
    // No damper, no joint: the rotor's order decides. A splitting of second order within PEFRL
    // would show order 2 here.
    let mut model = Bench::new();
    let state =
        BodyState::from_f64([1.0, 0.2, -0.1], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [3.0, -2.0, 4.0]);
    let body = model.add_body(2.0, [0.05, 0.08, 0.11], state).unwrap();
    let points = [[0.0; 3], [0.2, 0.3, -0.1]];
    model.add_tsda([BodyIndex::WORLD, body], points, 100.0, 0.0, 0.4).unwrap();
    assert_eq!(model.view().dampers.len(), 0);
    let case = Case::new("one body", model, false, 0.5);
    case.check_all(|undamped, _| undamped, [2_000, 500, 160]);
}
