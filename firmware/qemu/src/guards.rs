//! The cost of guards relative to the guarded step.
//!
//! `(pairs, SysTick) => lines "guard SCENE SCHEMEVARIANT PRECISION STEP FAULT LOOK MAX ENERGY"`, all in
//! instructions: a step with its guards; the guards of every step alone; a check by the monitor at one
//! body's frequencies, mean and most over the bodies; what looking at the energy adds to it. Counted as
//! in [`cost`](crate::cost).

use core::hint::black_box;

use dbd_kernel::model::{ModelOwner, RealOf};
use dbd_kernel::watch::Watch;
use dbd_kernel::{Geometry, Plant, Real, Scheme};

use crate::board::systick::SysTick;
use crate::cost::count;
use crate::models::{Shipped, Visitor};
use crate::say;

/// Calls of each; a multiple of no scene's number of bodies, so that looks take all bodies.
const CALLS: u32 = 64;

/// Prints a line for each pair that `show` shows; `false` where a guard fired.
pub fn run(systick: &mut SysTick, show: impl FnOnce(&mut Guarding<'_>)) -> bool {
    let mut guarding = Guarding { systick, well: true };
    show(&mut guarding);
    guarding.well
}

/// Counts and prints each visited model.
pub struct Guarding<'t> {
    systick: &'t mut SysTick,
    well: bool,
}

/// A plant and its watch.
struct Guarded<M: ModelOwner + 'static, S: Scheme> {
    plant: Plant<&'static M, S>,
    watch: Watch<RealOf<M>>,
}

impl Visitor for Guarding<'_> {
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
        let Ok(plant) = Plant::new(shipped.model, shipped.scheme, shipped.step) else {
            say!("guard {} refused its step", shipped.scene);
            self.well = false;
            return;
        };
        let watch = Watch::new(&plant);
        let mut guarded = Guarded { plant, watch };
        let stepped = self.count(step::<M, S>, &mut guarded);
        let faults = self.count(fault::<M, S>, &mut guarded);
        let looks = self.count(look::<M, S>, &mut guarded);
        guarded.watch = watch.with_energy(RealOf::<M>::from_f64(1e30));
        let energy = self.count(look::<M, S>, &mut guarded);
        say!(
            "guard {} {}{} {} {} {} {} {} {}",
            shipped.scene,
            S::NAME,
            shipped.variant,
            M::Precision::NAME,
            stepped.0,
            faults.0,
            looks.0,
            looks.1,
            energy.0.saturating_sub(looks.0)
        );
    }
}

impl Guarding<'_> {
    /// Instructions of a call, mean and most.
    fn count<T>(&mut self, call: fn(&mut T) -> bool, subject: &mut T) -> (u64, u64) {
        let (total, most, well) = count(self.systick, CALLS, call, subject);
        self.well &= well;
        (SysTick::instructions(total, CALLS), SysTick::instructions(most, 1))
    }
}

#[inline(never)]
fn step<M: ModelOwner, S: Scheme>(guarded: &mut Guarded<M, S>) -> bool {
    guarded.plant.step().is_ok()
}

#[inline(never)]
fn fault<M: ModelOwner, S: Scheme>(guarded: &mut Guarded<M, S>) -> bool {
    black_box(&guarded.plant).fault().is_none()
}

#[inline(never)]
fn look<M: ModelOwner, S: Scheme>(guarded: &mut Guarded<M, S>) -> bool {
    guarded.watch.look(&mut guarded.plant).is_ok()
}
