//! A batch: as many instances as a register has lanes, stepped together.
//!
//! `(members, steps) => members`. Steps are executed in blocks, without the checks of a single step. A lane is suspect
//! if it rotated too far in a step or is not finite at the end of a block: its instance then repeats the block on a
//! scalar plant, which reports what failed and where. An unused lane runs a copy of another instance; a lane whose
//! instance has failed continues with meaningless values. Laws are compiled for scalar instances only: instances of a
//! model with laws or driven bodies are stepped one by one.

use dbd_kernel::lanes::{Lanes, Named, Register, Work};
use dbd_kernel::{Body, Plant, Real, State};

use crate::gather::{self, LanesModel, ModelOf};
use crate::in_lanes::InLanes;

/// Steps between two checks of a batch.
const BLOCK: u64 = 64;

/// The plant of one instance.
pub type PlantOf<R, S> = Plant<Box<ModelOf<R>>, S>;
/// The plant of a register's lanes.
type LanesPlant<V, S> = Plant<Box<LanesModel<V>>, S>;

/// A batch with any register type.
pub(crate) trait Batch<R, S>: Send
where
    R: Real + Named,
    S: InLanes,
{
    /// `steps` steps of all running instances.
    fn advance(&mut self, steps: u64);
    /// An instance, with its present state.
    fn member(&mut self, member: usize) -> &PlantOf<R, S>;
    /// An instance for modification.
    fn member_mut(&mut self, member: usize) -> &mut PlantOf<R, S>;
    /// The force evaluations of an instance that has run in its lane since t = 0; `None` for others.
    fn evaluations(&self, member: usize) -> Option<u64>;
}

/// Location of the present state of the instances.
#[derive(Clone, Copy, PartialEq)]
enum Present {
    /// Only in their scalar plants.
    Members,
    /// Only in the lanes.
    Lanes,
    /// In both.
    Both,
}

/// Instances in the lanes of `V`.
pub(crate) struct Members<V: Register, S: InLanes> {
    plants: Vec<PlantOf<V::Number, S>>,
    /// The member in each lane; the first lane of a member is the authoritative one.
    lumped_joints: Vec<usize>,
    /// The plant of the lanes, once any member runs.
    lanes: Option<LanesPlant<V, S>>,
    present: Present,
    /// The lanes with running instances, lane 0 lowest; copies are excluded.
    running: u32,
    /// Whether the lanes have run since t = 0.
    from_start: bool,
}

impl<V: Register, S: InLanes> Members<V, S> {
    /// A batch of at most as many plants as the register has lanes, with the same structure, scheme and step.
    pub(crate) fn new(plants: Vec<PlantOf<V::Number, S>>) -> Self {
        let lumped_joints = Vec::new();
        let (lanes, present) = (None, Present::Members);
        Self { plants, lumped_joints, lanes, present, running: 0, from_start: false }
    }

    /// Loads the members' states into the lanes; `None` if none of them runs. All lanes are at the step of the first
    /// running member.
    fn lumped_joint(&mut self) -> Option<()> {
        if self.present == Present::Members {
            let all = 0..self.plants.len();
            let running = |&member: &usize| self.plants[member].status().is_ok();
            let step = |member: usize| self.plants[member].state().step;
            let first = all.clone().find(running)?;
            let mut lumped_joints: Vec<usize> =
                all.filter(running).filter(|&member| step(member) == step(first)).collect();
            lumped_joints.resize(V::LANES, first);
            let plants: Vec<_> = lumped_joints.iter().map(|&member| &self.plants[member]).collect();
            if self.lanes.is_none() || self.lumped_joints != lumped_joints {
                let models: Vec<_> = plants.iter().map(|plant| plant.model()).collect();
                let model = Box::new(gather::model::<V>(&models));
                let plant = Plant::new(model, *plants[0].scheme(), plants[0].step_size());
                self.lanes = Some(plant.ok()?);
            }
            let states: Vec<_> = plants.iter().map(|plant| plant.state()).collect();
            let state = gather::state::<V>(&states);
            let lanes = self.lanes.as_mut()?;
            self.from_start = state.step == 0 && lanes.evaluations() == 0;
            lanes.resume(state);
            self.running = own_lanes(&lumped_joints).fold(0, |running, lane| running | 1 << lane);
            self.lumped_joints = lumped_joints;
            self.present = Present::Both;
        }
        Some(())
    }

    /// Stores the lanes' states in the members' plants.
    fn leave(&mut self) {
        if let (Present::Lanes, Some(lanes)) = (self.present, &self.lanes) {
            for lane in own_lanes(&self.lumped_joints).filter(|lane| self.running >> lane & 1 != 0)
            {
                let state = gather::lane(lanes.state(), lane);
                self.plants[self.lumped_joints[lane]].resume(state);
            }
            self.present = Present::Both;
        }
    }

    /// A block of steps; returns whether any member still runs.
    fn block(&mut self, steps: u64) -> bool {
        let alone = |model: &ModelOf<V::Number>| {
            !model.laws.is_empty() || model.bodies.iter().any(Body::is_driven)
        };
        if self.plants.iter().any(|plant| alone(plant.model())) {
            let mut running = false;
            for plant in &mut self.plants {
                running |= plant.advance(steps).is_ok();
            }
            return running;
        }
        self.lumped_joint();
        let apart: Vec<usize> =
            (0..self.plants.len()).filter(|member| !self.lumped_joints.contains(member)).collect();
        let Some(lanes) = self.lanes.as_mut().filter(|_| self.present != Present::Members) else {
            return false;
        };
        let before = lanes.state().clone();
        let far = before.step.checked_add(steps + 1).is_none()
            || near_an_end(&before, steps, self.running);
        let doubted = if far { u32::MAX } else { V::enter(Block { lanes, steps }) };
        self.present = Present::Lanes;
        // Members at another step, and failed ones, which remain unchanged.
        for member in apart {
            let _ = self.plants[member].advance(steps);
        }
        let running = self.running;
        let doubted: Vec<usize> = own_lanes(&self.lumped_joints)
            .filter(|lane| (doubted & running) >> lane & 1 != 0)
            .collect();
        if doubted.is_empty() {
            return true;
        }
        self.leave();
        for lane in doubted {
            let plant = &mut self.plants[self.lumped_joints[lane]];
            let made = plant.hash();
            plant.resume(gather::lane(&before, lane));
            if plant.advance(steps).is_err() {
                self.running &= !(1 << lane);
            } else if plant.hash() != made {
                self.present = Present::Members;
            }
        }
        // Members that were at another step may still run: they are loaded into the lanes.
        if self.running == 0 {
            self.present = Present::Members;
        }
        true
    }
}

/// The authoritative lanes of the members.
fn own_lanes(lumped_joints: &[usize]) -> impl Iterator<Item = usize> {
    (0..lumped_joints.len()).filter(|&lane| !lumped_joints[..lane].contains(&lumped_joints[lane]))
}

/// Whether any revolution count of a running lane may overflow within the given number of steps.
fn near_an_end<V: Register>(state: &State<LanesModel<V>>, steps: u64, running: u32) -> bool {
    let most = u64::from(u32::MAX / 2) - 1 - steps;
    let counts = state.turns.iter().enumerate();
    let mut counts = counts.filter(|(row, _)| running >> (row % V::LANES) & 1 != 0);
    counts.any(|(_, &turns)| u64::from(turns.unsigned_abs()) > most)
}

impl<V: Register, S: InLanes + Send> Batch<V::Number, S> for Members<V, S> {
    fn advance(&mut self, steps: u64) {
        let mut left = steps;
        while left > 0 {
            let block = left.min(BLOCK);
            if !self.block(block) {
                return;
            }
            left -= block;
        }
    }

    fn member(&mut self, member: usize) -> &PlantOf<V::Number, S> {
        self.leave();
        &self.plants[member]
    }

    fn member_mut(&mut self, member: usize) -> &mut PlantOf<V::Number, S> {
        self.leave();
        self.present = Present::Members;
        &mut self.plants[member]
    }

    fn evaluations(&self, member: usize) -> Option<u64> {
        let lane =
            own_lanes(&self.lumped_joints).find(|&lane| self.lumped_joints[lane] == member)?;
        let steady = self.from_start && self.running >> lane & 1 != 0;
        Some(self.lanes.as_ref()?.evaluations()).filter(|_| steady)
    }
}

/// Steps of lanes.
struct Block<'b, V: Register, S: InLanes> {
    lanes: &'b mut LanesPlant<V, S>,
    steps: u64,
}

impl<V: Register, S: InLanes> Work for Block<'_, V, S> {
    /// The suspect lanes.
    type Outcome = u32;

    #[inline(always)]
    fn run(self) -> u32 {
        let Self { lanes, steps } = self;
        let h = Lanes::<V>::from_f64(lanes.step_size());
        let one = Lanes::<V>::ONE;
        let mut calm = Lanes::<V>::mask(true);
        for _ in 0..steps {
            // Lanes do not report failures: an invalid operation yields NaN.
            let _ = lanes.step_unguarded();
            for body in &lanes.state().bodies {
                let turn = body.angular_velocity * h;
                calm = calm & turn.dot(turn).at_most(one);
            }
        }
        for body in &lanes.state().bodies {
            let (q, zero) = (body.orientation, Lanes::<V>::ZERO);
            for v in [body.position, body.velocity, body.angular_velocity, q.v] {
                for x in [v.x, v.y, v.z] {
                    calm = calm & (x * zero).equals(zero);
                }
            }
            calm = calm & (q.w * zero).equals(zero);
        }
        V::bits(!calm)
    }
}
