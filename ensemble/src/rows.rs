//! One large model in lanes: its joints and its bodies lie beside one another, on one thread or on several.
//!
//! `(plant, steps) => plant`. Steps are made in blocks without the guards of a step; a block in which a body turns too
//! far in a step, or after which one is not finite, is done anew by the plant itself, which tells what failed where.

use std::num::NonZeroUsize;
use std::thread;

use dbd_kernel::geometry::Named;
use dbd_kernel::{Leapfrog, Real, Status};

use crate::batch::PlantOf;
use crate::lanes::Lanes;
use crate::register::Register;

mod links;
mod part;
mod plan;
mod share;
mod table;
#[cfg(test)]
mod tests;
mod unfit;

use links::Links;
use part::{Block, Part, PoseLinks};
use plan::Plan;
use share::{Share, along_joints, in_order};
pub use unfit::{Unfit, fits};

/// Steps between two looks.
const BLOCK: u64 = 64;
/// The same of several threads, which are started for each block.
const BLOCK_OF_THREADS: u64 = 512;

/// A plant in the lanes of whatever register.
pub(crate) trait Rowed<R: Real + Named>: Send {
    fn advance(&mut self, steps: u64) -> Status;
    fn plant(&self) -> &PlantOf<R, Leapfrog>;
    fn plant_mut(&mut self) -> &mut PlantOf<R, Leapfrog>;
    fn into_plant(self: Box<Self>) -> PlantOf<R, Leapfrog>;
}

/// A plant and its parts in lanes.
pub(crate) struct InRows<V: Register> {
    plant: PlantOf<V::Number, Leapfrog>,
    shares: Vec<Share>,
    /// One per share.
    parts: Vec<Part<V>>,
    /// Whether what parts hold is the plant's present state.
    present: bool,
}

impl<V: Register> InRows<V> {
    /// The parts of a plant whose model [`fits`], a thread for each; no more threads than bodies.
    pub(crate) fn new(plant: PlantOf<V::Number, Leapfrog>, threads: NonZeroUsize) -> Self {
        let model = plant.model();
        let ends = model.groups.iter();
        let ends = ends.map(|group| ((!group.a.is_world()).then(|| group.a.row()), group.b.row()));
        let ends: Vec<_> = ends.collect();
        let bodies = model.bodies.len();
        // Where bodies stand otherwise than they are joined, they lie as joints come to them.
        let (own, along) = ((0..bodies).collect(), along_joints(&ends, bodies));
        let copies = |order: &Vec<usize>| Plan::copies(&in_order(&ends, order), bodies, V::LANES);
        let order = [own, along].into_iter().min_by_key(copies).unwrap_or_default();
        let ends = in_order(&ends, &order);
        let h = Lanes::from_f64(plant.step_size());
        let shares = Share::all(&ends, bodies, threads.get());
        let parts = shares.iter().map(|share| Part::new(model, &order, &ends, share, h)).collect();
        Self { plant, shares, parts, present: false }
    }

    /// Steps of all parts; whether nothing is in doubt.
    fn block(&mut self, steps: u64) -> bool {
        let Self { plant, shares, parts, present } = self;
        if !*present {
            parts.iter_mut().for_each(|part| part.seat(&plant.state().bodies));
        }
        let (h, present) = (plant.step_size(), *present);
        let work =
            |(part, links): (_, PoseLinks<V>)| V::enter(Block { part, links, h, steps, present });
        let mut parts = parts.iter_mut().zip(Links::all(shares));
        let Some(first) = parts.next() else { return true };
        let is_calm = thread::scope(|scope| {
            let others: Vec<_> = parts.map(|part| scope.spawn(move || work(part))).collect();
            let is_first_calm = work(first);
            others.into_iter().all(|other| other.join().is_ok_and(|is_calm| is_calm))
                && is_first_calm
        });
        if is_calm {
            let mut state = self.plant.state().clone();
            state.step += steps;
            self.parts.iter().for_each(|part| part.leave(&mut state.bodies));
            self.plant.resume(state);
        }
        is_calm
    }
}

impl<V: Register> Rowed<V::Number> for InRows<V> {
    fn advance(&mut self, steps: u64) -> Status {
        let most = if self.parts.len() > 1 { BLOCK_OF_THREADS } else { BLOCK };
        let mut left = steps;
        while left > 0 && self.plant.status().is_running() {
            let block = left.min(most);
            left -= block;
            let is_far = self.plant.state().step.checked_add(block + 1).is_none();
            self.present = !is_far && self.block(block);
            if !self.present {
                let _ = self.plant.advance(block);
            }
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
