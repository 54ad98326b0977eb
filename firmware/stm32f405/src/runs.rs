//! The runs of every program: a plant at a fixed rate, with a report.
//!
//! `(model, steps per tick, steps) => tick by tick => report "hash …", "pace …"`. A tick whose steps are not done when
//! the next one comes is an overrun: it is counted, the next steps follow at once, and the bits are the same.

use core::fmt;

use dbd_kernel::{Failure, Leapfrog, Plant};

use crate::board::RATE;
use crate::models::cart_pendulum::{CART_PENDULUM_F32, CART_PENDULUM_STEP, CartPendulumF32};
use crate::models::four_bar::{FOUR_BAR_F32, FOUR_BAR_STEP, FourBarF32};

/// A plant that is stepped at [`RATE`].
pub struct Run {
    scene: &'static str,
    steps_per_tick: u32,
    steps: u64,
    plant: Shipped,
    overruns: u32,
}

/// One type for all models: a program holds one run at a time.
enum Shipped {
    FourBar(Plant<&'static FourBarF32, Leapfrog>),
    CartPendulum(Plant<&'static CartPendulumF32, Leapfrog>),
}

/// How a run went.
#[derive(Clone, Copy)]
pub struct Report {
    scene: &'static str,
    steps_per_tick: u32,
    step: u64,
    hash: u64,
    overruns: u32,
    status: Result<(), Failure>,
}

impl Run {
    /// The run of this number; `None` after the last one, which asks for more than the chip can do: its overruns must
    /// be seen.
    #[must_use]
    pub fn numbered(number: usize) -> Option<Self> {
        match number {
            0 => Some(Self::four_bar(5, 10_000)),
            1 => Some(Self::cart_pendulum(1, 1_000)),
            2 => Some(Self::cart_pendulum(16, 1_000)),
            _ => None,
        }
    }

    fn four_bar(steps_per_tick: u32, steps: u64) -> Self {
        let plant = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP);
        let plant = Shipped::FourBar(plant.expect("the scene's step is positive"));
        Self { scene: "four-bar", steps_per_tick, steps, plant, overruns: 0 }
    }

    fn cart_pendulum(steps_per_tick: u32, steps: u64) -> Self {
        let plant = Plant::new(&CART_PENDULUM_F32, Leapfrog, CART_PENDULUM_STEP);
        let plant = Shipped::CartPendulum(plant.expect("the scene's step is positive"));
        Self { scene: "cart-pendulum", steps_per_tick, steps, plant, overruns: 0 }
    }

    /// The steps of a tick; the report after the last step of the run, or after one that failed.
    pub fn tick(&mut self) -> Option<Report> {
        (0..self.steps_per_tick).find_map(|_| self.step())
    }

    /// The steps were not done when the next tick came.
    pub fn overrun(&mut self) {
        self.overruns = self.overruns.saturating_add(1);
    }

    fn step(&mut self) -> Option<Report> {
        let (status, step) = match &mut self.plant {
            Shipped::FourBar(plant) => (plant.step(), plant.state().step),
            Shipped::CartPendulum(plant) => (plant.step(), plant.state().step),
        };
        (step == self.steps || status.is_err()).then(|| self.report(status, step))
    }

    fn report(&self, status: Result<(), Failure>, step: u64) -> Report {
        let hash = match &self.plant {
            Shipped::FourBar(plant) => plant.hash(),
            Shipped::CartPendulum(plant) => plant.hash(),
        };
        let Self { scene, steps_per_tick, overruns, .. } = *self;
        Report { scene, steps_per_tick, step, hash, overruns, status }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, steps_per_tick, step, hash, overruns, .. } = self;
        if let Err(failure) = self.status {
            return write!(f, "error: {scene} failed at step {step}: {:?}", failure.cause);
        }
        writeln!(f, "hash {scene} leapfrog f32 {step} {hash:016x}")?;
        write!(f, "pace {scene} {RATE} ticks/s, {steps_per_tick} steps each, {overruns} overruns")
    }
}
