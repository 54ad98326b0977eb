//! A share of a model in lanes.
//!
//! `(poses, joints) => what joints do; (that, bodies) => bodies, poses`. A register holds as many joints, then as many
//! bodies, as it has lanes. What a joint does to its bodies has rows of its own, from which each body adds in the order
//! of the joints: every sum is that of the plant by itself.

use dbd_kernel::body::Diagonal;
use dbd_kernel::elements::gravity::weight;
use dbd_kernel::geometry::{Float, Named, Pose};
use dbd_kernel::parts::{self, Wrench};
use dbd_kernel::real::Truth as _;
use dbd_kernel::{Body, BodyState, Geometry as _, Quaternion, Real, Tsda, Vec3};
use dbd_scene::SceneModel;

use super::links::Links;
use super::plan::{Batch, Plan};
use super::share::{Ends, Share};
use super::table::{Table, load, store};
use crate::lanes::Lanes;
use crate::register::{Register, Work};

/// Numbers of a body's pose.
const POSE: usize = 12;
/// Numbers of what a joint does to a body: force and torque, world axes.
const DONE: usize = 6;

/// Links that hand over poses.
pub(super) type PoseLinks<V> = Links<<V as Register>::Number, POSE>;

/// Bodies of a register.
struct Bodies<V: Register> {
    /// \[1\] of the moments of inertia, all that a drift takes of a [`Body`].
    ratios: [Vec3<Lanes<V>>; 2],
    diagonal: Diagonal<Lanes<V>>,
    /// \[N\].
    weight: Vec3<Lanes<V>>,
    state: BodyState<Float<Lanes<V>>>,
    /// The first rows of what joints do to them, in the order of the joints.
    added: Box<[u32]>,
}

/// Joints of a register.
struct Joints<V: Register> {
    /// The first rows of their bodies.
    ends: [u32; 2],
    centres: [Vec3<Lanes<V>>; 2],
    tips: [Vec3<Lanes<V>>; 3],
    springs: [[Tsda<Lanes<V>>; 3]; 2],
}

/// What one thread steps.
pub(super) struct Part<V: Register> {
    /// The bodies' rows in the model.
    rows: Vec<usize>,
    bodies: Vec<Bodies<V>>,
    joints: Vec<Joints<V>>,
    poses: Table<V::Number, POSE>,
    /// The row of the first guest's pose.
    guests: usize,
    /// What joints do to their first bodies, to their second ones, and nothing.
    done: Table<V::Number, DONE>,
    batches: Vec<Batch>,
}

#[inline(always)]
fn lanes<V: Register>(of: impl Fn(usize) -> V::Number) -> Lanes<V> {
    Lanes::new(of)
}

fn vector<V: Register>(of: impl Fn(usize) -> Vec3<V::Number>) -> Vec3<Lanes<V>> {
    Vec3::new(lanes(|i| of(i).x), lanes(|i| of(i).y), lanes(|i| of(i).z))
}

fn at_rest<R: Real + Named>() -> BodyState<Float<R>> {
    let (position, orientation) = (Vec3::default(), Quaternion::IDENTITY);
    BodyState {
        position,
        orientation,
        velocity: Vec3::default(),
        angular_velocity: Vec3::default(),
    }
}

impl<V: Register> Part<V> {
    /// A share of a model whose bodies lie in an order, for steps of `h` \[s\].
    pub(super) fn new(
        model: &SceneModel<Float<V::Number>>,
        order: &[usize],
        ends: &[Ends],
        share: &Share,
        h: Lanes<V>,
    ) -> Self {
        let plan = Plan::new(ends, share, V::LANES);
        let rows = order[share.bodies.clone()].to_vec();
        // What no lane needs is as heavy as anything, at the origin and at rest.
        let idle = Body::from_f64(1.0, [1.0; 3]);
        let gravity = model.gravity.first().copied();
        let bodies = plan.added.into_iter().enumerate().map(|(block, added)| {
            let known =
                |lane: usize| rows.get(block * V::LANES + lane).map(|&row| &model.bodies[row]);
            let of = |lane: usize| *known(lane).unwrap_or(&idle);
            let body = Body {
                mass: lanes(|i| of(i).mass),
                inertia: vector(|i| of(i).inertia),
                inverse_mass: lanes(|i| of(i).inverse_mass),
                inverse_inertia: vector(|i| of(i).inverse_inertia),
                ratio: vector(|i| of(i).ratio),
                inverse_ratio: vector(|i| of(i).inverse_ratio),
            };
            let weight = vector(|i| {
                known(i).zip(gravity).map_or_else(Vec3::default, |(body, g)| weight(body.mass, g))
            });
            let ratios = [body.ratio, body.inverse_ratio];
            let diagonal = Diagonal::new(&body, h);
            Bodies { ratios, diagonal, weight, state: at_rest(), added }
        });
        let bodies = bodies.collect();
        let joints = plan.joints.chunks(V::LANES).zip(plan.ends).map(|(joints, ends)| {
            let group = |lane: usize| joints[lane].map(|joint| &model.groups[joint]);
            let point = |lane: usize, i: usize| {
                group(lane).map_or_else(Vec3::default, |g| model.points[g.point as usize + i])
            };
            let spring = |lane: usize, i: usize| {
                group(lane).map_or_else(Tsda::default, |g| model.tsdas[g.element as usize + i])
            };
            Joints {
                ends,
                centres: core::array::from_fn(|i| vector(|lane| point(lane, i))),
                tips: core::array::from_fn(|i| vector(|lane| point(lane, 2 + i))),
                springs: core::array::from_fn(|star| {
                    core::array::from_fn(|arm| Tsda {
                        stiffness: lanes(|lane| spring(lane, 3 * star + arm).stiffness),
                        free_length: lanes(|lane| spring(lane, 3 * star + arm).free_length),
                    })
                }),
            }
        });
        let joints = joints.collect();
        let BodyState { position, orientation, .. } = at_rest::<V::Number>();
        let pose = Float::<V::Number>::frame(&position, &orientation).numbers();
        let poses = Table::new(plan.poses, pose);
        // Nothing is a negative zero, which changes no sum.
        let done = Table::new(plan.done, [-V::Number::ZERO; DONE]);
        Self { rows, bodies, joints, poses, guests: plan.guests, done, batches: plan.batches }
    }

    /// Brings the states of a model's bodies into the lanes.
    pub(super) fn seat(&mut self, states: &[BodyState<Float<V::Number>>]) {
        let rest = at_rest();
        for (block, bodies) in self.bodies.iter_mut().enumerate() {
            let row = |lane: usize| self.rows.get(block * V::LANES + lane);
            let of = |lane: usize| row(lane).map_or(&rest, |&row| &states[row]);
            bodies.state = BodyState {
                position: vector(|lane| of(lane).position),
                orientation: Quaternion {
                    w: lanes(|lane| of(lane).orientation.w),
                    v: vector(|lane| of(lane).orientation.v),
                },
                velocity: vector(|lane| of(lane).velocity),
                angular_velocity: vector(|lane| of(lane).angular_velocity),
            };
        }
    }

    /// Brings the lanes' states into those of a model's bodies.
    pub(super) fn leave(&self, states: &mut [BodyState<Float<V::Number>>]) {
        for (rows, bodies) in self.rows.chunks(V::LANES).zip(&self.bodies) {
            let BodyState { position, orientation, velocity, angular_velocity } = bodies.state;
            for (lane, &row) in rows.iter().enumerate() {
                let vector =
                    |v: Vec3<Lanes<V>>| Vec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
                states[row] = BodyState {
                    position: vector(position),
                    orientation: Quaternion {
                        w: orientation.w.lane(lane),
                        v: vector(orientation.v),
                    },
                    velocity: vector(velocity),
                    angular_velocity: vector(angular_velocity),
                };
            }
        }
    }

    /// What the joints of a batch do at the present poses.
    #[inline(always)]
    fn pull(&mut self, batch: usize) {
        let Self { joints, poses, done, batches, .. } = self;
        let batch = &batches[batch];
        poses.copy(&batch.poses);
        let (poses, mut done) = (poses.columns(), done.columns_mut());
        let second = joints.len() * V::LANES + V::LANES;
        for (block, joint) in batch.joints.clone().zip(&joints[batch.joints.clone()]) {
            // Written out: a closure may be compiled apart.
            let [a, b] = joint.ends;
            let a = Pose::from_numbers(load(&poses, a as usize));
            let b = Pose::from_numbers(load(&poses, b as usize));
            let points = (&joint.centres, &joint.tips);
            let record = parts::revolute::<Float<Lanes<V>>>([&a, &b], points, &joint.springs);
            let parts::Record { force: f, torque_a: a, torque_b: b } = record;
            store(&mut done, block * V::LANES, [f.x, f.y, f.z, a.x, a.y, a.z]);
            store(&mut done, second + block * V::LANES, [-f.x, -f.y, -f.z, -b.x, -b.y, -b.z]);
        }
    }

    /// Ends a step of the bodies of a batch, where one has begun, and begins the next one, where there is one.
    /// Whether no body turned too far.
    #[inline(always)]
    fn move_on(&mut self, batch: usize, h: Lanes<V>, ends: bool, begins: bool) -> V::Truth {
        let one = Lanes::<V>::ONE;
        let mut calm = Lanes::<V>::truth(true);
        let Self { bodies, poses, done, batches, .. } = self;
        let batch = &batches[batch];
        done.copy(&batch.done);
        let (mut poses, done) = (poses.columns_mut(), done.columns());
        for (block, bodies) in batch.bodies.clone().zip(&mut bodies[batch.bodies.clone()]) {
            let Bodies { ratios, diagonal, weight, state, added } = bodies;
            let first = V::LANES + block * V::LANES;
            let [mut fx, mut fy, mut fz] = [weight.x, weight.y, weight.z];
            let [mut tx, mut ty, mut tz] = [Lanes::ZERO; 3];
            for &first in &**added {
                let done: [_; DONE] = load(&done, first as usize);
                (fx, fy, fz) = (fx + done[0], fy + done[1], fz + done[2]);
                (tx, ty, tz) = (tx + done[3], ty + done[4], tz + done[5]);
            }
            let pose = Pose::from_numbers(load(&poses, first));
            let torque = Float::<Lanes<V>>::moment_to_body(&pose, Vec3::new(tx, ty, tz));
            let wrench = Wrench::new(Vec3::new(fx, fy, fz), torque);
            if ends {
                parts::kick::<Float<Lanes<V>>>(state, &wrench, diagonal);
                let turn = state.angular_velocity * h;
                calm = calm & turn.dot(turn).at_most(one);
            }
            if begins {
                parts::kick::<Float<Lanes<V>>>(state, &wrench, diagonal);
                let [ratio, inverse_ratio] = *ratios;
                let body = Body { ratio, inverse_ratio, ..Body::default() };
                parts::drift::<Float<Lanes<V>>>(state, &body, h);
                let frame = Float::<Lanes<V>>::frame(&state.position, &state.orientation);
                store(&mut poses, first, frame.numbers());
            }
        }
        calm
    }

    /// The poses of the present state.
    #[inline(always)]
    fn place(&mut self) {
        let mut poses = self.poses.columns_mut();
        for (block, bodies) in self.bodies.iter().enumerate() {
            let BodyState { position, orientation, .. } = &bodies.state;
            let frame = Float::<Lanes<V>>::frame(position, orientation);
            store(&mut poses, V::LANES + block * V::LANES, frame.numbers());
        }
    }
}

/// Whether all numbers are finite.
#[inline(always)]
fn are_finite<V: Register>(state: &BodyState<Float<Lanes<V>>>) -> V::Truth {
    let BodyState { position, orientation: q, velocity, angular_velocity } = *state;
    let zero = Lanes::<V>::ZERO;
    let mut finite = (q.w * zero).equals(zero);
    for v in [position, velocity, angular_velocity, q.v] {
        for x in [v.x, v.y, v.z] {
            finite = finite & (x * zero).equals(zero);
        }
    }
    finite
}

/// Steps of a part.
pub(super) struct Block<'b, V: Register> {
    pub(super) part: &'b mut Part<V>,
    pub(super) links: PoseLinks<V>,
    /// \[s\] in every lane.
    pub(super) h: f64,
    pub(super) steps: u64,
    /// Whether poses and what joints do are those of the states.
    pub(super) present: bool,
}

impl<V: Register> Work for Block<'_, V> {
    /// Whether no body turned too far, all are finite and no other thread has broken off.
    type Outcome = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let Self { part, links, h, steps, present } = self;
        let h = Lanes::<V>::from_f64(h);
        let rows = (V::LANES, part.guests);
        let mut calm = Lanes::<V>::truth(true);
        let mut complete = true;
        if !present {
            part.place();
            complete = links.exchange(&mut part.poses, rows);
        }
        for step in 0..=steps {
            let (ends, begins) = (step > 0, step < steps);
            for batch in 0..part.batches.len() {
                if ends || !present {
                    part.pull(batch);
                }
                calm = calm & part.move_on(batch, h, ends, begins);
            }
            complete = complete && (!begins || links.exchange(&mut part.poses, rows));
        }
        for bodies in &part.bodies {
            calm = calm & are_finite(&bodies.state);
        }
        complete && calm.all()
    }
}
