//! One large model in lanes: its joints and its bodies lie beside one another.
//!
//! `(plant, steps) => plant`. A register holds as many joints, then as many bodies, as it has lanes. What a joint does
//! to its bodies has places of its own, from which each body adds in the order of the joints: every sum is that of the
//! plant by itself. Steps are made in blocks without the guards of a step; a block in which a body turns too far in a
//! step, or after which one is not finite, is done anew by the plant itself, which tells what failed where.

use dbd_kernel::body::Diagonal;
use dbd_kernel::elements::gravity::weight;
use dbd_kernel::geometry::{Float, Named, Pose};
use dbd_kernel::parts::{self, Wrench};
use dbd_kernel::real::Truth as _;
use dbd_kernel::{Body, BodyState, Geometry as _, Leapfrog, Quaternion, Real, Status, Tsda, Vec3};

use crate::batch::PlantOf;
use crate::lanes::Lanes;
use crate::register::{Register, Work};

mod plan;
mod table;
#[cfg(test)]
mod tests;
mod unfit;

use plan::Plan;
use table::{Table, load, store};
pub use unfit::{Unfit, fits};

/// Steps between two looks.
const BLOCK: u64 = 64;
/// Numbers of a body's pose.
const POSE: usize = 12;
/// Numbers of what a joint does to a body: force and torque, world axes.
const DONE: usize = 6;

/// A plant in the lanes of whatever register.
pub(crate) trait Rowed<R: Real + Named>: Send {
    fn advance(&mut self, steps: u64) -> Status;
    fn plant(&self) -> &PlantOf<R, Leapfrog>;
    fn plant_mut(&mut self) -> &mut PlantOf<R, Leapfrog>;
    fn into_plant(self: Box<Self>) -> PlantOf<R, Leapfrog>;
}

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

/// A plant and its rows of lanes.
pub(crate) struct InRows<V: Register> {
    plant: PlantOf<V::Number, Leapfrog>,
    bodies: Vec<Bodies<V>>,
    joints: Vec<Joints<V>>,
    /// Poses: idle rows, the last of which is the ground, then the bodies'.
    poses: Table<V::Number, POSE>,
    /// What joints do to their first bodies, to their second ones, and nothing.
    done: Table<V::Number, DONE>,
    /// Whether poses and what joints do are those of the plant's present state.
    present: bool,
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

impl<V: Register> InRows<V> {
    /// The rows of a plant whose model [`fits`].
    pub(crate) fn new(plant: PlantOf<V::Number, Leapfrog>) -> Self {
        let model = plant.model();
        let h = Lanes::<V>::from_f64(plant.step_size());
        let ends = model.groups.iter();
        let ends = ends.map(|group| ((!group.a.is_world()).then(|| group.a.row()), group.b.row()));
        let ends: Vec<_> = ends.collect();
        let plan = Plan::new(&ends, model.bodies.len(), V::LANES);
        // What no lane needs is as heavy as anything, at the origin and at rest.
        let idle = Body::from_f64(1.0, [1.0; 3]);
        let gravity = model.gravity.first().copied();
        let bodies = plan.added.into_iter().enumerate().map(|(block, added)| {
            let known = |lane: usize| model.bodies.get(block * V::LANES + lane);
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
        Self { plant, bodies, joints, poses, done, present: false }
    }

    /// Brings the plant's state into the lanes.
    fn seat(&mut self) {
        let states = &self.plant.state().bodies;
        let rest = at_rest();
        for (block, bodies) in self.bodies.iter_mut().enumerate() {
            let of = |lane: usize| states.get(block * V::LANES + lane).unwrap_or(&rest);
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

    /// Brings the lanes' state into the plant, `steps` later.
    fn leave(&mut self, steps: u64) {
        let mut state = self.plant.state().clone();
        state.step += steps;
        for (states, bodies) in state.bodies.chunks_mut(V::LANES).zip(&self.bodies) {
            let BodyState { position, orientation, velocity, angular_velocity } = bodies.state;
            for (lane, state) in states.iter_mut().enumerate() {
                let vector =
                    |v: Vec3<Lanes<V>>| Vec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
                *state = BodyState {
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
        self.plant.resume(state);
    }

    /// What all joints do at the present poses.
    #[inline(always)]
    fn pull(&mut self) {
        let Self { joints, poses, done, .. } = self;
        poses.copy();
        let (poses, mut done) = (poses.columns(), done.columns_mut());
        let second = joints.len() * V::LANES + V::LANES;
        for (block, joint) in joints.iter().enumerate() {
            let [a, b] = joint.ends.map(|first| Pose::from_numbers(load(&poses, first as usize)));
            let points = (&joint.centres, &joint.tips);
            let record = parts::revolute::<Float<Lanes<V>>>([&a, &b], points, &joint.springs);
            let parts::Record { force: f, torque_a: a, torque_b: b } = record;
            store(&mut done, block * V::LANES, [f.x, f.y, f.z, a.x, a.y, a.z]);
            store(&mut done, second + block * V::LANES, [-f.x, -f.y, -f.z, -b.x, -b.y, -b.z]);
        }
    }

    /// Ends a step of all bodies, where one has begun, and begins the next one, where there is one.
    /// Whether no body turned too far.
    #[inline(always)]
    fn move_on(&mut self, h: Lanes<V>, ends: bool, begins: bool) -> V::Truth {
        let one = Lanes::<V>::ONE;
        let mut calm = Lanes::<V>::truth(true);
        let Self { bodies, poses, done, .. } = self;
        done.copy();
        let (mut poses, done) = (poses.columns_mut(), done.columns());
        for (block, bodies) in bodies.iter_mut().enumerate() {
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
            let wrench = Wrench {
                force: Vec3::new(fx, fy, fz),
                torque: Float::<Lanes<V>>::moment_to_body(&pose, Vec3::new(tx, ty, tz)),
            };
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

/// Steps of all rows.
struct Block<'b, V: Register> {
    rows: &'b mut InRows<V>,
    steps: u64,
}

impl<V: Register> Work for Block<'_, V> {
    /// Whether no body turned too far, and all are finite.
    type Outcome = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let Self { rows, steps } = self;
        let h = Lanes::<V>::from_f64(rows.plant.step_size());
        let mut calm = Lanes::<V>::truth(true);
        if !rows.present {
            rows.place();
        }
        for step in 0..=steps {
            if step > 0 || !rows.present {
                rows.pull();
            }
            calm = calm & rows.move_on(h, step > 0, step < steps);
        }
        for bodies in &rows.bodies {
            calm = calm & are_finite(&bodies.state);
        }
        calm.all()
    }
}

impl<V: Register> Rowed<V::Number> for InRows<V> {
    fn advance(&mut self, steps: u64) -> Status {
        let mut left = steps;
        while left > 0 && self.plant.status().is_running() {
            let block = left.min(BLOCK);
            left -= block;
            let is_far = self.plant.state().step.checked_add(block + 1).is_none();
            if !is_far {
                if !self.present {
                    self.seat();
                }
                self.present = V::enter(Block { rows: self, steps: block });
                if self.present {
                    self.leave(block);
                    continue;
                }
            }
            self.present = false;
            let _ = self.plant.advance(block);
        }
        self.plant.status()
    }

    fn plant(&self) -> &PlantOf<V::Number, Leapfrog> {
        &self.plant
    }

    fn plant_mut(&mut self) -> &mut PlantOf<V::Number, Leapfrog> {
        self.present = false;
        &mut self.plant
    }

    fn into_plant(self: Box<Self>) -> PlantOf<V::Number, Leapfrog> {
        self.plant
    }
}
