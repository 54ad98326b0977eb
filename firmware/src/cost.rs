//! What a step of models with their schemes costs in instructions and memory.
//!
//! `(pairs, SysTick) => lines "cost SCENE SCHEMEVARIANT PRECISION STEP MEAN MAX PLANT MODEL STACK"`:
//! step \[ns\], instructions per step, bytes of the plant (state and scratch), of the const model
//! and of the stack below the call. The emulator must count instructions (`-icount shift=6`): an
//! instruction is 64 ns of virtual time, which is 1.6 ticks of SysTick. An empty call is timed
//! the same way and subtracted.

use core::hint::black_box;

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Geometry, Plant, Scheme, Status};

use crate::board::stack;
use crate::board::systick::SysTick;
use crate::models::{Shipped, Visitor};
use crate::say;

/// Timed steps per combination. Their costs differ by branches on data, in soft floats above all.
const STEPS: u32 = 64;
/// Steps before the first timed one; the first step of a plant is not a typical one.
const WARM_UP: u32 = 4;

/// Prints a line for each pair that `show` shows; `false` where a model did not step.
///
/// Generic, so that a program's pairs are compiled with that program alone.
pub fn run(systick: &mut SysTick, show: impl FnOnce(&mut Costing<'_>)) -> bool {
    let mut costing = Costing { systick, well: true };
    show(&mut costing);
    costing.well
}

/// Prints a line for every shipped and every charted pair.
#[cfg(feature = "cost")]
pub fn run_all(systick: &mut SysTick) -> bool {
    run(systick, |costing| {
        crate::models::for_each(costing);
        crate::chart::for_each_charted(costing);
    })
}

/// Counts and prints what it is shown.
pub struct Costing<'t> {
    systick: &'t mut SysTick,
    well: bool,
}

type Call<M, S> = fn(&mut Plant<&'static M, S>) -> Status;

impl Visitor for Costing<'_> {
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
        let precision = M::Precision::NAME;
        let plant = Plant::new(shipped.model, shipped.scheme, shipped.step);
        let Ok(mut plant) = plant else {
            say!(
                "cost {} {}{} {} refused its step",
                shipped.scene,
                S::NAME,
                shipped.variant,
                precision
            );
            self.well = false;
            return;
        };
        let empty: Call<M, S> = black_box(no_step::<M, S>);
        let step: Call<M, S> = black_box(one_step::<M, S>);
        for _ in 0..WARM_UP {
            self.well &= step(&mut plant).is_running();
        }
        let (mut total, mut most) = (0_u64, 0_u64);
        for _ in 0..STEPS {
            let nothing = self.time(empty, &mut plant);
            let ticks = self.time(step, &mut plant).saturating_sub(nothing);
            total += ticks;
            most = most.max(ticks);
        }
        let stack = stack::depth(|| {
            self.well &= step(&mut plant).is_running();
        });
        let nanoseconds = (shipped.step * 1e9 + 0.5) as u64;
        say!(
            "cost {} {}{} {} {} {} {} {} {} {}",
            shipped.scene,
            S::NAME,
            shipped.variant,
            precision,
            nanoseconds,
            SysTick::instructions(total, STEPS),
            SysTick::instructions(most, 1),
            size_of::<Plant<&'static M, S>>(),
            size_of::<M>(),
            stack
        );
    }
}

impl Costing<'_> {
    #[inline(never)]
    fn time<M: ModelOwner, S: Scheme>(
        &mut self,
        call: Call<M, S>,
        plant: &mut Plant<&'static M, S>,
    ) -> u64 {
        let start = self.systick.read();
        let status = call(black_box(plant));
        let end = self.systick.read();
        self.well &= status.is_running();
        SysTick::between(start, end)
    }
}

#[inline(never)]
fn one_step<M: ModelOwner, S: Scheme>(plant: &mut Plant<&'static M, S>) -> Status {
    plant.step()
}

#[inline(never)]
fn no_step<M: ModelOwner, S: Scheme>(plant: &mut Plant<&'static M, S>) -> Status {
    black_box(plant);
    Status::Running
}
