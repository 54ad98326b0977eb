//! Instructions and memory of a step of models with their schemes.
//!
//! `(pairs, SysTick) => lines "cost SCENE SCHEMEVARIANT PRECISION STEP MEAN MAX HELD PLANT MODEL STACK"`:
//! step \[ns\], instructions per step (mean, most, and mean where nothing sets the inputs), bytes of the plant (state
//! and scratch), of the const model and of the stack below the call. Before each step every input is set to another
//! value, as a controller does. The emulator must count instructions (`-icount shift=6`): an instruction is 64 ns of
//! virtual time, which is 1.6 ticks of SysTick. An empty call is timed the same way and subtracted.

use core::hint::black_box;

use dbd_kernel::model::{ModelOwner, RealOf};
use dbd_kernel::{Geometry, InputIndex, Plant, Real as _, Scheme};

use crate::board::stack;
use crate::board::systick::SysTick;
use crate::models::{Shipped, Visitor};
use crate::say;

/// Timed steps per combination. Their costs differ by branches on data, in soft floats above all.
const STEPS: u32 = 64;
/// Steps before the first timed one; the first step of a plant is not a typical one.
const WARM_UP: u32 = 4;
/// By how much inputs change, in their units: too little to change what a step takes otherwise.
const CHANGE: f64 = 1e-6;

/// Prints a line for each pair that `show` shows; `false` where a model did not step.
///
/// Generic, so that a program's pairs are compiled with that program alone.
pub fn run(systick: &mut SysTick, show: impl FnOnce(&mut Costing<'_>)) -> bool {
    let mut costing = Costing { systick, well: true };
    show(&mut costing);
    costing.well
}

/// Prints a line for every shipped pair and every charted one in single precision.
#[cfg(feature = "cost")]
pub fn run_single(systick: &mut SysTick) -> bool {
    run(systick, |costing| {
        crate::models::for_each(costing);
        crate::chart::for_each_single(costing);
    })
}

/// Prints a line for every charted pair in double precision.
#[cfg(feature = "cost")]
pub fn run_double(systick: &mut SysTick) -> bool {
    run(systick, |costing| crate::chart::for_each_double(costing))
}

/// Prints a line for every charted pair in fixed point.
#[cfg(feature = "cost")]
pub fn run_fixed(systick: &mut SysTick) -> bool {
    run(systick, |costing| crate::chart::for_each_fixed(costing))
}

/// Prints a line for every model with the plan of a matrix.
#[cfg(feature = "cost")]
pub fn run_solved(systick: &mut SysTick) -> bool {
    run(systick, |costing| crate::chart::for_each_solved(costing))
}

/// Counts and prints each visited model.
pub struct Costing<'t> {
    systick: &'t mut SysTick,
    well: bool,
}

/// The counts, and whether the steps succeeded.
type Call<T> = fn(&mut T) -> bool;

/// Ticks of one call, and whether it went well.
#[inline(never)]
pub fn time<T>(systick: &mut SysTick, call: Call<T>, subject: &mut T) -> (u64, bool) {
    let start = systick.read();
    let well = call(black_box(subject));
    let end = systick.read();
    (SysTick::between(start, end), well)
}

/// Ticks of some calls in sum and of the dearest, an empty call subtracted from each.
pub fn count<T>(
    systick: &mut SysTick,
    calls: u32,
    call: Call<T>,
    subject: &mut T,
) -> (u64, u64, bool) {
    let empty: Call<T> = black_box(nothing::<T>);
    let call: Call<T> = black_box(call);
    let (mut total, mut most, mut well) = (0_u64, 0_u64, true);
    for _ in 0..calls {
        let (nothing, _) = time(systick, empty, subject);
        let (ticks, went_well) = time(systick, call, subject);
        let ticks = ticks.saturating_sub(nothing);
        total += ticks;
        most = most.max(ticks);
        well &= went_well;
    }
    (total, most, well)
}

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
        for _ in 0..WARM_UP {
            self.well &= driven_step(&mut plant);
        }
        let (total, most, well) = count(self.systick, STEPS, driven_step::<M, S>, &mut plant);
        self.well &= well;
        let mut held = total;
        if inputs(shipped.model) > 0 {
            plant.reset();
            for _ in 0..WARM_UP {
                self.well &= one_step(&mut plant);
            }
            let (ticks, _, well) = count(self.systick, STEPS, one_step::<M, S>, &mut plant);
            held = ticks;
            self.well &= well;
        }
        let step: Call<Plant<&'static M, S>> = black_box(driven_step::<M, S>);
        let stack = stack::depth(|| {
            self.well &= step(&mut plant);
        });
        // The same steps once more, and as many empty calls before them: between the marks an
        // emulator that is asked to counts instructions by their address.
        plant.reset();
        for _ in 0..WARM_UP {
            self.well &= driven_step(&mut plant);
        }
        for call in [black_box(nothing::<_> as Call<_>), black_box(driven_step::<M, S>)] {
            mark();
            for _ in 0..STEPS {
                self.well &= call(black_box(&mut plant));
            }
        }
        mark();
        let nanoseconds = (shipped.step * 1e9 + 0.5) as u64;
        say!(
            "cost {} {}{} {} {} {} {} {} {} {} {}",
            shipped.scene,
            S::NAME,
            shipped.variant,
            precision,
            nanoseconds,
            SysTick::instructions(total, STEPS),
            SysTick::instructions(most, 1),
            SysTick::instructions(held, STEPS),
            size_of::<Plant<&'static M, S>>(),
            size_of::<M>() + shipped.beside,
            stack
        );
    }
}

/// Ends what the emulator counted by address since the mark before. A body that no other function
/// has: equal ones are made one.
#[inline(never)]
pub fn mark() {
    black_box(0x6d61_726b_u32);
}

#[inline(never)]
fn one_step<M: ModelOwner, S: Scheme>(plant: &mut Plant<&'static M, S>) -> bool {
    plant.step().is_ok()
}

/// Sets every input to another value than before the last step, and steps. An input that a source drives keeps its own.
#[inline(never)]
fn driven_step<M: ModelOwner, S: Scheme>(plant: &mut Plant<&'static M, S>) -> bool {
    let change = if plant.state().step % 2 == 0 { CHANGE } else { -CHANGE };
    for row in 0..inputs(plant.model()) {
        let _ = plant.set_input_real(InputIndex(row as u16), RealOf::<M>::from_f64(change));
    }
    plant.step().is_ok()
}

fn inputs<M: ModelOwner>(model: &M) -> usize {
    model.view().inputs.len()
}

#[inline(never)]
fn nothing<T>(subject: &mut T) -> bool {
    black_box(subject);
    true
}
