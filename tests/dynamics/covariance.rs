//! A scene that is moved, turned, mirrored or made heavier moves as before: every scheme, both
//! precisions, in the plane and in space.
//!
//! Rounding alone may tell the runs apart; where all numbers change by a sign or by a power of two, not
//! even that.

use dbd_kernel::builder::{LineLaw, Triples};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Geometry, Leapfrog,
    Load, LoadFrame, Pefrl, Plant, Quaternion, Rk4, Scheme, SemiImplicitEuler, Vec3,
};
use dbd_tests::Bench;
use dbd_tests::page::{block, table};

/// \[s\] the step and the time, in which the joints swing several times.
const STEP: f64 = 2e-4;
const TIME: f64 = 0.1;

/// What is done to a scene: mirrored at x = 0, then turned, then moved; masses, stiffnesses,
/// dampings and loads are multiplied.
#[derive(Clone, Copy)]
struct Change {
    mirrored: bool,
    turn: Quaternion<f64>,
    shift: [f64; 3],
    factor: f64,
}

const NONE: Change =
    Change { mirrored: false, turn: Quaternion::IDENTITY, shift: [0.0; 3], factor: 1.0 };

/// A turn about no axis in particular, of unit length to rounding.
fn turn() -> Quaternion<f64> {
    let q: [f64; 4] = [0.7, -0.3, 0.5, 0.2];
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    Quaternion::from_f64(q.map(|c| c / norm))
}

impl Change {
    /// A vector in a body's axes, which are mirrored with it.
    fn in_body(&self, v: [f64; 3]) -> [f64; 3] {
        if self.mirrored { [-v[0], v[1], v[2]] } else { v }
    }

    /// An axis of turning in a body's axes: its sense of turning is mirrored, too.
    fn axis_in_body(&self, v: [f64; 3]) -> [f64; 3] {
        if self.mirrored { [v[0], -v[1], -v[2]] } else { v }
    }

    /// A vector in the world.
    fn in_world(&self, v: [f64; 3]) -> [f64; 3] {
        if self.turn == Quaternion::IDENTITY {
            return self.in_body(v);
        }
        self.turn.rotation().to_world(Vec3::from_f64(self.in_body(v))).to_f64()
    }

    /// An axis of turning in the world.
    fn axis_in_world(&self, v: [f64; 3]) -> [f64; 3] {
        self.turn.rotation().to_world(Vec3::from_f64(self.axis_in_body(v))).to_f64()
    }

    /// A point of the world.
    fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let p = self.in_world(p);
        [0, 1, 2].map(|i| p[i] + self.shift[i])
    }

    /// A point of a body, or of the world where it is the ground's.
    fn point_of(&self, body: BodyIndex, p: [f64; 3]) -> [f64; 3] {
        if body.is_world() { self.point(p) } else { self.in_body(p) }
    }

    /// A body's state.
    fn state(&self, state: &BodyState<F64>) -> BodyState<F64> {
        let q = state.orientation.to_f64();
        let v = self.axis_in_body([q[1], q[2], q[3]]);
        let mut q = Quaternion::new(q[0], v[0], v[1], v[2]);
        if self.turn != Quaternion::IDENTITY {
            q = self.turn.product(q);
        }
        let velocity = self.in_world(state.velocity.to_f64());
        let spin = self.axis_in_body(state.angular_velocity.to_f64());
        BodyState::from_f64(self.point(state.position.to_f64()), q.to_f64(), velocity, spin)
    }
}

/// A scene as it is built, unchanged in `bodies`.
struct Scene<P: Geometry> {
    model: Bench<P>,
    bodies: Vec<BodyState<F64>>,
    change: Change,
}

const GROUND: BodyIndex = BodyIndex::WORLD;

impl<P: Geometry> Scene<P> {
    fn new(change: Change, gravity: [f64; 3]) -> Self {
        let mut model = Bench::new();
        model.set_gravity(change.in_world(gravity)).unwrap();
        Self { model, bodies: Vec::new(), change }
    }

    fn body(&mut self, mass: f64, inertia: [f64; 3], state: BodyState<F64>) -> BodyIndex {
        let factor = self.change.factor;
        let changed = self.change.state(&state);
        let (q, v) = (changed.orientation.to_f64(), changed.velocity.to_f64());
        let changed: BodyState<P> =
            BodyState::from_f64(changed.position.to_f64(), q, v, changed.angular_velocity.to_f64());
        self.bodies.push(state);
        self.model.add_body(mass * factor, inertia.map(|i| i * factor), changed).unwrap()
    }

    /// A point of the unchanged world in a body's axes, changed.
    fn local(&self, body: BodyIndex, p: [f64; 3]) -> [f64; 3] {
        let Some(state) = self.bodies.get(body.row()) else { return self.change.point(p) };
        let arm = Vec3::from_f64(p) - state.position;
        self.change.in_body(state.orientation.rotation().to_body(arm).to_f64())
    }

    /// A revolute about z, or a spherical joint.
    fn joint(&mut self, between: [BodyIndex; 2], at: [f64; 3], revolute: bool, damping: f64) {
        let shifted = |d: [f64; 3]| [0, 1, 2].map(|i| at[i] + d[i]);
        let [depth, height] = if revolute { [0.2, 0.0] } else { [0.0, 0.1] };
        let mut centres = vec![self.local(between[0], shifted([0.0, 0.0, depth]))];
        if revolute {
            centres.push(self.local(between[0], shifted([0.0, 0.0, -depth])));
        }
        let ring = [[0.2, 0.0, height], [-0.1, 0.17, height], [-0.1, -0.17, height]];
        let arms = ring.map(|d| self.local(between[1], shifted(d)));
        let triples = Triples {
            between,
            centres: &centres,
            arms: &arms,
            stiffness: 2_000.0 * self.change.factor,
            damping: damping * self.change.factor,
            free_length: 0.25,
            clearance: 0.0,
        };
        self.model.add_triples(triples).unwrap();
    }

    fn tsda(&mut self, between: [BodyIndex; 2], points: [[f64; 3]; 2], law: [f64; 3]) {
        let points = [0, 1].map(|i| self.change.point_of(between[i], points[i]));
        let [stiffness, damping] = [law[0], law[1]].map(|value| value * self.change.factor);
        self.model.add_tsda(between, points, stiffness, damping, law[2]).unwrap();
    }

    fn torsion(&mut self, between: [BodyIndex; 2], axis: [f64; 3], law: [f64; 3]) {
        let ground = between[0].is_world();
        let axis =
            if ground { self.change.axis_in_world(axis) } else { self.change.axis_in_body(axis) };
        let [stiffness, damping, preload] = law.map(|value| value * self.change.factor);
        self.model.add_torsion_spring(between, axis, stiffness, damping, preload).unwrap();
    }

    fn load(&mut self, body: BodyIndex, frame: LoadFrame, force: [f64; 3], torque: [f64; 3]) {
        let change = self.change;
        let [force, torque] = match frame {
            LoadFrame::World => [change.in_world(force), change.axis_in_world(torque)],
            LoadFrame::Body => [change.in_body(force), change.axis_in_body(torque)],
        };
        let [force, torque] = [force, torque].map(|v| v.map(|c| c * change.factor));
        let (force, torque) = (P::Vector::from_f64(force), P::Moment::from_f64(torque));
        let load = Load { body, frame, force, torque, from: 0.01, until: 0.06 };
        self.model.add_load(load).unwrap();
    }
}

fn state(p: [f64; 3], q: [f64; 4], v: [f64; 3], spin: [f64; 3]) -> BodyState<F64> {
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    BodyState::from_f64(p, q.map(|c| c / norm), v, spin)
}

/// Two links that swing in the plane z = 0.
fn planar<P: Geometry>(change: Change) -> Scene<P> {
    let mut scene = Scene::new(change, [0.0, -9.81, 0.0]);
    let first = state([0.5, 0.0, 0.0], [1.0, 0.0, 0.0, 0.1], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]);
    let second = state([1.3, 0.2, 0.0], [1.0, 0.0, 0.0, -0.3], [0.2, 1.0, 0.0], [0.0, 0.0, -4.0]);
    let a = scene.body(1.0, [0.02, 0.05, 0.06], first);
    let b = scene.body(1.7, [0.03, 0.07, 0.09], second);
    scene.joint([GROUND, a], [0.0; 3], true, 2.0);
    scene.joint([a, b], [1.0, 0.1, 0.0], true, 0.0);
    scene.tsda([b, GROUND], [[0.3, 0.1, 0.0], [1.0, 1.5, 0.0]], [80.0, 3.0, 0.9]);
    scene.torsion([GROUND, a], [0.0, 0.0, 1.0], [9.0, 0.1, 2.0]);
    scene.load(b, LoadFrame::World, [3.0, -2.0, 0.0], [0.0, 0.0, 1.5]);
    scene
}

/// Three tumbling bodies, joined by every kind of element, with dampers that know no axes.
fn spatial<P: Geometry>(change: Change) -> Scene<P> {
    tumbling(change, 0.0)
}

/// The same with dampers of a point bushing and of a point on a line, whose sweeps go from one axis of
/// the world to the next.
fn damped_axes<P: Geometry>(change: Change) -> Scene<P> {
    tumbling(change, 1.0)
}

fn tumbling<P: Geometry>(change: Change, damping: f64) -> Scene<P> {
    let mut scene = Scene::new(change, [0.4, 0.3, -9.81]);
    let tilted = [0.9, 0.2, -0.3, 0.1];
    let first = state([0.6, 0.1, -0.2], tilted, [0.1, 0.4, 0.0], [3.0, 1.0, -2.0]);
    let second = state([1.3, 0.3, 0.1], [0.5, -0.4, 0.6, 0.3], [0.3, 0.0, 0.6], [-2.0, 4.0, 1.0]);
    let third = state([1.0, -0.7, 0.3], [1.0, 0.0, 0.0, 0.0], [0.0, 0.3, 0.2], [1.0, 0.0, 5.0]);
    let a = scene.body(1.0, [0.05, 0.08, 0.11], first);
    let b = scene.body(2.0, [0.11, 0.06, 0.09], second);
    let c = scene.body(1.4, [0.07, 0.10, 0.05], third);
    scene.joint([GROUND, a], [0.0; 3], false, 1.5);
    scene.joint([a, b], [0.9, 0.2, 0.0], true, 0.0);
    scene.tsda([b, c], [[0.1, -0.2, 0.1], [0.2, 0.3, 0.0]], [120.0, 2.0, 0.6]);
    scene.tsda([GROUND, c], [[1.0, -0.9, 0.2], [0.05, -0.1, 0.0]], [90.0, damping, 0.0]);
    scene.torsion([a, b], [0.3, -0.6, 0.8], [6.0, 0.1, -1.0]);
    let factor = change.factor;
    let law = LineLaw {
        stiffness: 60.0 * factor,
        damping: damping * factor,
        free_length: 0.1,
        clearance: 0.0,
    };
    let (on, along) = (change.in_body([0.1, 0.2, 0.0]), change.in_body([1.0, -2.0, 0.5]));
    let point = change.in_body([-0.3, 0.1, 0.2]);
    scene.model.add_points_on_line([a, c], on, along, &[point], law).unwrap();
    scene.load(c, LoadFrame::Body, [2.0, -1.0, 4.0], [0.3, 0.2, -0.5]);
    scene.load(b, LoadFrame::World, [-1.0, 3.0, 2.0], [-0.4, 0.2, 0.1]);
    scene
}

type Build<P> = fn(Change) -> Scene<P>;

/// The bodies at the end, and the state's hash.
fn end<P: Geometry, S: Scheme>(
    build: Build<P>,
    scheme: S,
    change: Change,
    step: f64,
) -> (Bodies, u64) {
    let scene = build(change);
    let mut plant = Plant::new(&scene.model, scheme, step).unwrap();
    plant.advance((TIME / step).round() as u64).unwrap();
    (plant.state().bodies.iter().map(BodyState::convert).collect(), plant.hash())
}

type Bodies = Vec<BodyState<F64>>;

/// The largest difference of two runs in any number \[m, m/s, rad/s, or of a direction\].
fn apart(a: &[BodyState<F64>], b: &[BodyState<F64>]) -> f64 {
    let numbers = |body: &BodyState<F64>| {
        let turned = body.orientation.rotation();
        let vectors = [body.position, body.velocity, body.angular_velocity];
        vectors.into_iter().chain([turned.x, turned.y, turned.z]).flat_map(Vec3::to_f64).collect()
    };
    let pairs = a.iter().zip(b).flat_map(|(a, b)| {
        let [a, b]: [Vec<f64>; 2] = [numbers(a), numbers(b)];
        a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).collect::<Vec<_>>()
    });
    pairs.fold(0.0, f64::max)
}

/// The difference between a changed run and the change of a run.
fn deviation<P: Geometry, S: Scheme>(build: Build<P>, scheme: S, change: Change, step: f64) -> f64 {
    let unchanged = end(build, scheme, NONE, step).0;
    let expected: Bodies = unchanged.iter().map(|body| change.state(body)).collect();
    let deviation = apart(&end(build, scheme, change, step).0, &expected);
    assert!(deviation.is_finite(), "{}", S::NAME);
    deviation
}

/// Calls a generic function with every scheme.
macro_rules! every_scheme {
    ($function:ident $(, $argument:expr)*) => {
        [
            $function(Dbd::default() $(, $argument)*),
            $function(Dbd { newton: 2 } $(, $argument)*),
            $function(DbdP1::default() $(, $argument)*),
            $function(DbdP2 { newton: 1 } $(, $argument)*),
            $function(SemiImplicitEuler $(, $argument)*),
            $function(Explicit(SemiImplicitEuler) $(, $argument)*),
            $function(Leapfrog $(, $argument)*),
            $function(Explicit(Leapfrog) $(, $argument)*),
            $function(Pefrl $(, $argument)*),
            $function(BlanesMoanS6 $(, $argument)*),
            $function(Rk4 $(, $argument)*),
        ]
    };
}

/// The largest deviation of all schemes, of each scene.
fn worst<P: Geometry, const N: usize>(builds: [Build<P>; N], change: Change) -> [f64; N] {
    fn one<P: Geometry, S: Scheme>(scheme: S, build: Build<P>, change: Change) -> f64 {
        deviation(build, scheme, change, STEP)
    }
    builds.map(|build| every_scheme!(one, build, change).into_iter().fold(0.0, f64::max))
}

#[test]
fn a_scene_that_is_moved_turned_or_made_heavier_moves_as_before() {
    let mut rows = Vec::new();
    for (name, change, [double, single]) in [
        ("moved by 3.7 m", Change { shift: [2.1, -1.3, 2.7], ..NONE }, [1e-11, 5e-3]),
        ("turned", Change { turn: turn(), ..NONE }, [1e-11, 5e-3]),
        (
            "moved and turned",
            Change { turn: turn(), shift: [-3.0, 0.7, 1.9], ..NONE },
            [1e-11, 5e-3],
        ),
        ("3.7 times as heavy", Change { factor: 3.7, ..NONE }, [1e-11, 5e-3]),
    ] {
        let worst =
            [worst([planar::<F64>, spatial], change), worst([planar::<F32>, spatial], change)];
        for (worst, bound) in worst.iter().zip([double, single]) {
            assert!(worst.iter().all(|worst| *worst < bound), "{name}: {worst:?}");
            assert!(worst[1] > 0.0, "{name}: is to round otherwise");
        }
        let cells = worst.concat().into_iter().map(|worst| format!("{worst:.0e}"));
        rows.push([name.to_owned()].into_iter().chain(cells).collect());
    }
    let head = ["", "f64, plane", "f64, space", "f32, plane", "f32, space"];
    block("docs/proof.md", "covariance", &table(&head, &rows));
}

#[test]
fn a_mirrored_scene_moves_to_the_bit_as_its_mirror_image() {
    let change = Change { mirrored: true, ..NONE };
    assert_eq!(worst([planar::<F64>, spatial, damped_axes], change), [0.0; 3]);
    assert_eq!(worst([planar::<F32>, spatial, damped_axes], change), [0.0; 3]);
}

#[test]
fn a_scene_that_is_heavier_by_a_power_of_two_has_the_same_bits() {
    fn same<P: Geometry, S: Scheme>(scheme: S, build: Build<P>) -> bool {
        let hash = |exponent| {
            let change = Change { factor: f64::powi(2.0, exponent), ..NONE };
            end(build, scheme, change, STEP).1
        };
        let hashes = [0, -7, 20].map(hash);
        assert_eq!(hashes, [hashes[0]; 3], "{} {}", P::NAME, S::NAME);
        hashes[0] != 0
    }
    for build in [planar::<F64>, spatial, damped_axes] {
        assert_eq!(every_scheme!(same, build), [true; 11]);
    }
    for build in [planar::<F32>, spatial, damped_axes] {
        assert_eq!(every_scheme!(same, build), [true; 11]);
    }
}

#[test]
fn sweeps_along_the_worlds_axes_turn_with_the_scene_to_second_order() {
    fn check<S: Scheme>(scheme: S) -> bool {
        let change = Change { turn: turn(), ..NONE };
        let build: Build<F64> = damped_axes;
        let [coarse, fine] = [STEP, STEP / 2.0].map(|h| deviation(build, scheme, change, h));
        let rounding = 1e-11;
        assert!(
            coarse < 1e-6 && (fine < coarse / 3.0 || fine < rounding),
            "{}: {coarse:e} {fine:e}",
            S::NAME
        );
        coarse > rounding
    }
    let seen = every_scheme!(check);
    // Explicit dampers know no axes: dbd, and rk4.
    assert!(!seen[0] && !seen[10], "{seen:?}");
}
