//! One large model in lanes: its joints and its bodies lie beside one another.
//!
//! `(plant, steps) => plant`. A register holds as many bodies, then as many joints, as it has lanes. Records are
//! added to the bodies' wrenches one by one, in the order of the joints, so that every sum is that of the plant by
//! itself. Steps are made in blocks without the guards of a step; a block in which a body turns too far in a step, or
//! after which one is not finite, is done anew by the plant itself, which tells what failed where.

use dbd_kernel::body::Diagonal;
use dbd_kernel::elements::gravity::weight;
use dbd_kernel::geometry::{Float, Named, Pose};
use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::model::Law;
use dbd_kernel::parts::{self, Wrench};
use dbd_kernel::real::Truth as _;
use dbd_kernel::{Body, BodyState, Geometry as _, Leapfrog, Quaternion, Real, Status, Tsda, Vec3};
use dbd_scene::SceneModel;

use crate::batch::PlantOf;
use crate::instructions::InstructionSet;
use crate::lanes::Lanes;
use crate::number::Number;
use crate::register::{Register, Work};

#[cfg(test)]
mod tests;

/// Steps between two looks.
const BLOCK: u64 = 64;
/// Lanes of the widest register.
const MOST_LANES: usize = 16;

/// A plant of a large model, stepped in lanes with the bits it has by itself.
pub struct Large<R: Number> {
    rows: Box<dyn Rows<R>>,
}

impl<R: Number> Large<R> {
    /// A plant in lanes on the best instruction set of this machine; `Err` with the plant where its model is not
    /// [of the kind](fits).
    ///
    /// # Errors
    /// The plant, as it was, where its model does not fit.
    pub fn new(plant: PlantOf<R, Leapfrog>) -> Result<Self, Box<PlantOf<R, Leapfrog>>> {
        Self::with_instructions(plant, InstructionSet::best())
    }

    /// [`Self::new`] on a chosen instruction set.
    ///
    /// # Errors
    /// As [`Self::new`], and where the machine lacks the instruction set.
    pub fn with_instructions(
        plant: PlantOf<R, Leapfrog>,
        set: InstructionSet,
    ) -> Result<Self, Box<PlantOf<R, Leapfrog>>> {
        if set.is_there() && fits(plant.model()) {
            Ok(Self { rows: R::rows(set, plant) })
        } else {
            Err(Box::new(plant))
        }
    }

    /// `steps` steps, or as many as succeed.
    pub fn advance(&mut self, steps: u64) -> Status {
        self.rows.advance(steps)
    }

    /// The plant, brought to the present: state, status, time, hash, read-outs. It counts none of the evaluations of
    /// lanes.
    pub fn plant(&mut self) -> &PlantOf<R, Leapfrog> {
        self.rows.plant()
    }

    /// The plant, to be changed.
    pub fn plant_mut(&mut self) -> &mut PlantOf<R, Leapfrog> {
        self.rows.plant_mut()
    }
}

/// Whether lanes can step a model by itself: every joint is six TSDAs between two points and three of a body, and
/// there is nothing else but gravity. No dampers, no clearances, loads, inputs or torsion springs.
#[must_use]
pub fn fits<R: Real + Named>(model: &SceneModel<Float<R>>) -> bool {
    let bodies = model.bodies.len();
    let is_plain = |group: &dbd_kernel::model::Group| {
        group.law == Law::Tsda
            && (group.stars, group.arms, group.shared) == (2, 3, true)
            && usize::from(group.b.0) < bodies
            && group.damper == DamperIndex::NONE
            && group.clearance == ClearanceIndex::NONE
    };
    let others = [
        model.torsions.len(),
        model.loads.len(),
        model.inputs.len(),
        model.dampers.len(),
        model.clearances.len(),
    ];
    others == [0; 5] && model.groups.iter().all(is_plain)
}

/// A plant in the lanes of whatever register.
pub(crate) trait Rows<R: Real + Named>: Send {
    fn advance(&mut self, steps: u64) -> Status;
    fn plant(&mut self) -> &PlantOf<R, Leapfrog>;
    fn plant_mut(&mut self) -> &mut PlantOf<R, Leapfrog>;
}

/// Bodies of a register.
struct Bodies<V: Register> {
    body: Body<Lanes<V>>,
    diagonal: Diagonal<Lanes<V>>,
    state: BodyState<Float<Lanes<V>>>,
    /// Torque in body axes.
    wrench: Wrench<Lanes<V>>,
    frame: [Lanes<V>; 12],
}

/// Joints of a register.
struct Joints<V: Register> {
    a: [u32; MOST_LANES],
    b: [u32; MOST_LANES],
    centres: [Vec3<Lanes<V>>; 2],
    tips: [Vec3<Lanes<V>>; 3],
    springs: [[Tsda<Lanes<V>>; 3]; 2],
}

/// A wrench while it is summed: force and torque, world axes.
type Sum<R> = [R; 6];

/// A plant and its rows of lanes.
pub(crate) struct InRows<V: Register> {
    plant: PlantOf<V::Number, Leapfrog>,
    /// The last register is the ground's: at the origin, with the world's axes.
    bodies: Vec<Bodies<V>>,
    joints: Vec<Joints<V>>,
    /// \[N\] one per body.
    weights: Vec<Vec3<V::Number>>,
    /// One per lane of all bodies, the ground's among them.
    sums: Vec<Sum<V::Number>>,
}

fn lanes<V: Register>(of: impl Fn(usize) -> V::Number) -> Lanes<V> {
    Lanes::new(of)
}

fn vector<V: Register>(of: impl Fn(usize) -> Vec3<V::Number>) -> Vec3<Lanes<V>> {
    Vec3::new(lanes(|i| of(i).x), lanes(|i| of(i).y), lanes(|i| of(i).z))
}

impl<V: Register> InRows<V> {
    /// The rows of a plant whose model [`fits`].
    pub(crate) fn new(plant: PlantOf<V::Number, Leapfrog>) -> Self {
        let model = plant.model();
        let (count, h) = (model.bodies.len(), Lanes::<V>::from_f64(plant.step_size()));
        let ground = count.div_ceil(V::LANES) * V::LANES;
        // What no lane needs is as heavy as anything, at the origin and at rest.
        let idle = Body::from_f64(1.0, [1.0; 3]);
        let bodies = (0..=count.div_ceil(V::LANES)).map(|block| {
            let of = |lane: usize| *model.bodies.get(block * V::LANES + lane).unwrap_or(&idle);
            let body = Body {
                mass: lanes(|i| of(i).mass),
                inertia: vector(|i| of(i).inertia),
                inverse_mass: lanes(|i| of(i).inverse_mass),
                inverse_inertia: vector(|i| of(i).inverse_inertia),
                ratio: vector(|i| of(i).ratio),
                inverse_ratio: vector(|i| of(i).inverse_ratio),
            };
            let state = BodyState {
                position: Vec3::default(),
                orientation: Quaternion::IDENTITY,
                velocity: Vec3::default(),
                angular_velocity: Vec3::default(),
            };
            let frame = Float::<Lanes<V>>::frame(&state.position, &state.orientation).numbers();
            let diagonal = Diagonal::new(&body, h);
            Bodies { body, diagonal, state, wrench: Wrench::default(), frame }
        });
        let bodies = bodies.collect();
        let joints = model.groups.chunks(V::LANES).map(|groups| {
            let row = |body: u16| {
                let body = usize::from(body);
                (if body < count { body } else { ground }) as u32
            };
            let point = |lane: usize, i: usize| {
                groups.get(lane).map_or_else(Vec3::default, |g| model.points[g.point as usize + i])
            };
            let spring = |lane: usize, i: usize| {
                groups.get(lane).map_or_else(Tsda::default, |g| model.tsdas[g.element as usize + i])
            };
            let ends = |of: fn(&dbd_kernel::model::Group) -> u16| {
                core::array::from_fn(|lane| groups.get(lane).map_or(ground as u32, |g| row(of(g))))
            };
            Joints {
                a: ends(|group| group.a.0),
                b: ends(|group| group.b.0),
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
        let gravity = model.gravity.first().copied();
        let weights = model.bodies.iter();
        let weights =
            weights.map(|body| gravity.map_or_else(Vec3::default, |g| weight(body.mass, g)));
        let weights = weights.collect();
        let sums = vec![[V::Number::ZERO; 6]; ground + V::LANES];
        Self { plant, bodies, joints, weights, sums }
    }

    /// Brings the plant's state into the lanes.
    fn seat(&mut self) {
        let states = &self.plant.state().bodies;
        for (block, bodies) in self.bodies.iter_mut().enumerate() {
            let of = |lane: usize| states.get(block * V::LANES + lane);
            if of(0).is_none() {
                continue;
            }
            let part = |of_state: fn(&BodyState<Float<V::Number>>) -> Vec3<V::Number>| {
                vector(|lane| of(lane).map_or_else(Vec3::default, of_state))
            };
            bodies.state = BodyState {
                position: part(|state| state.position),
                orientation: Quaternion {
                    w: lanes(|lane| of(lane).map_or(V::Number::ONE, |state| state.orientation.w)),
                    v: part(|state| state.orientation.v),
                },
                velocity: part(|state| state.velocity),
                angular_velocity: part(|state| state.angular_velocity),
            };
        }
    }

    /// Brings the lanes' state into the plant, `steps` later.
    fn leave(&mut self, steps: u64) {
        let mut state = self.plant.state().clone();
        state.step += steps;
        for (row, body) in state.bodies.iter_mut().enumerate() {
            let (bodies, lane) = (&self.bodies[row / V::LANES].state, row % V::LANES);
            let vector =
                |v: Vec3<Lanes<V>>| Vec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
            *body = BodyState {
                position: vector(bodies.position),
                orientation: Quaternion {
                    w: bodies.orientation.w.lane(lane),
                    v: vector(bodies.orientation.v),
                },
                velocity: vector(bodies.velocity),
                angular_velocity: vector(bodies.angular_velocity),
            };
        }
        self.plant.resume(state);
    }

    /// The wrenches of the present pose: weights, joints in their order, torques turned into body axes.
    #[inline(always)]
    fn evaluate(&mut self) {
        let Self { bodies, joints, weights, sums, .. } = self;
        for (sum, weight) in sums.iter_mut().zip(weights) {
            let zero = V::Number::ZERO;
            *sum = [weight.x, weight.y, weight.z, zero, zero, zero];
        }
        for joint in joints {
            let frame = |rows: &[u32; MOST_LANES]| {
                Pose::from_numbers(core::array::from_fn(|number| {
                    lanes(|lane| {
                        let row = rows[lane] as usize;
                        bodies[row / V::LANES].frame[number].lane(row % V::LANES)
                    })
                }))
            };
            let frames = [frame(&joint.a), frame(&joint.b)];
            let points = (&joint.centres, &joint.tips);
            let record = parts::revolute::<Float<Lanes<V>>>(
                [&frames[0], &frames[1]],
                points,
                &joint.springs,
            );
            let parts::Record { force: f, torque_a: a, torque_b: b } = record;
            for lane in 0..V::LANES {
                let part = |lanes: Lanes<V>| lanes.lane(lane);
                let f = [part(f.x), part(f.y), part(f.z)];
                let on_a = &mut sums[joint.a[lane] as usize];
                for (sum, part) in
                    on_a.iter_mut().zip(f.into_iter().chain([a.x, a.y, a.z].map(part)))
                {
                    *sum = *sum + part;
                }
                let on_b = &mut sums[joint.b[lane] as usize];
                for (sum, part) in
                    on_b.iter_mut().zip(f.into_iter().chain([b.x, b.y, b.z].map(part)))
                {
                    *sum = *sum - part;
                }
            }
        }
        for (bodies, sums) in bodies.iter_mut().zip(sums.chunks(V::LANES)) {
            let of = |number: usize| lanes(|lane| sums[lane][number]);
            let torque = Vec3::new(of(3), of(4), of(5));
            let frame = Pose::from_numbers(bodies.frame);
            bodies.wrench = Wrench {
                force: Vec3::new(of(0), of(1), of(2)),
                torque: Float::<Lanes<V>>::moment_to_body(&frame, torque),
            };
        }
    }

    /// The bodies without the ground.
    #[inline(always)]
    fn moving(&mut self) -> &mut [Bodies<V>] {
        self.bodies.split_last_mut().map_or(&mut [], |(_, moving)| moving)
    }
}

impl<V: Register> Bodies<V> {
    #[inline(always)]
    fn place(&mut self) {
        let BodyState { position, orientation, .. } = &self.state;
        self.frame = Float::<Lanes<V>>::frame(position, orientation).numbers();
    }

    #[inline(always)]
    fn kick(&mut self) {
        parts::kick::<Float<Lanes<V>>>(&mut self.state, &self.wrench, &self.diagonal);
    }
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
        let (zero, one) = (Lanes::<V>::ZERO, Lanes::<V>::ONE);
        let mut calm = Lanes::<V>::truth(true);
        rows.moving().iter_mut().for_each(Bodies::place);
        rows.evaluate();
        for _ in 0..steps {
            for bodies in rows.moving() {
                bodies.kick();
                parts::drift::<Float<Lanes<V>>>(&mut bodies.state, &bodies.body, h);
                bodies.place();
            }
            rows.evaluate();
            for bodies in rows.moving() {
                bodies.kick();
                let turn = bodies.state.angular_velocity * h;
                calm = calm & turn.dot(turn).at_most(one);
            }
        }
        for bodies in rows.moving() {
            let BodyState { position, orientation: q, velocity, angular_velocity } = bodies.state;
            for v in [position, velocity, angular_velocity, q.v] {
                for x in [v.x, v.y, v.z] {
                    calm = calm & (x * zero).equals(zero);
                }
            }
            calm = calm & (q.w * zero).equals(zero);
        }
        calm.all()
    }
}

impl<V: Register> Rows<V::Number> for InRows<V> {
    fn advance(&mut self, steps: u64) -> Status {
        let mut left = steps;
        while left > 0 && self.plant.status().is_running() {
            let block = left.min(BLOCK);
            left -= block;
            let is_far = self.plant.state().step.checked_add(block + 1).is_none();
            if !is_far {
                self.seat();
                if V::enter(Block { rows: self, steps: block }) {
                    self.leave(block);
                    continue;
                }
            }
            let _ = self.plant.advance(block);
        }
        self.plant.status()
    }

    fn plant(&mut self) -> &PlantOf<V::Number, Leapfrog> {
        &self.plant
    }

    fn plant_mut(&mut self) -> &mut PlantOf<V::Number, Leapfrog> {
        &mut self.plant
    }
}
