//! The ways to a step of a system: the kernel in both precisions, the std reference, a plain loop; and a cycle of the
//! machine's clock.
//!
//! `(system, rounds) => row of times and ratios`. All take leapfrog's steps, from t = 0 on.

use std::hint::black_box;

use crate::flops::per_step;
use crate::plain::Plain;
use dbd_kernel::{F64, Leapfrog, State as KernelState};
use dbd_plant::{AnyPlant, Method, PrecisionName, SchemeName, plant as plant_of, plant_of_model};
use dbd_study::reference::naive::Naive;
use dbd_study::reference::{Mechanism, State};
use dbd_study::timing::elapsed;
use serde::Serialize;

use super::error::BenchError;
use super::systems::{Size, System};
use super::turns::{Figure, in_turn, ratio};

/// \[s\] a measurement takes, where nobody says how many steps it has.
const BATCH: f64 = 2e-3;

/// Steps after which bodies turn as they will.
const BEGUN: u64 = 16;

/// Floating-point operations in a cycle: today's cores have two units for those of one number.
const FLOPS_PER_CYCLE: f64 = 2.0;

/// A way beside the kernel's: its time, and how many times the kernel's that is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Other {
    /// \[s\] per step; `None` where it does not step the system.
    pub time_s: Option<Figure>,
    /// Its time over that of the kernel in double precision, round by round.
    pub over_kernel: Option<Figure>,
    /// Why it does not step the system.
    pub why_not: Option<String>,
}

/// What a step of a system costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The system.
    #[serde(flatten)]
    pub size: Size,
    /// \[s\] the kernel, double precision.
    pub f64_s: Option<Figure>,
    /// The kernel in single precision.
    pub f32: Other,
    /// The std reference: what a std user would write.
    pub std: Other,
    /// A plain loop over the same elements.
    pub plain: Other,
    /// Bodies that turn about more than one of their axes, which takes more turns.
    pub tumbling: usize,
    /// Floating-point operations of a step in double precision.
    pub flops: Option<f64>,
    /// \[s\] a cycle of the clock.
    pub cycle_s: Option<Figure>,
    /// The kernel's time in double precision over that of its operations, two in a cycle.
    pub over_flop_bound: Option<Figure>,
}

/// Takes so many steps.
type Take<'t> = Box<dyn FnMut(u64) + 't>;

/// Measures a system.
///
/// # Errors
/// Where the kernel cannot step it.
pub fn measured(
    system: &System,
    rounds: usize,
    steps: Option<u64>,
    heard: &mut dyn FnMut(usize),
) -> Result<Row, BenchError> {
    let System { size, model, planar } = system;
    let plant = |precision| -> Result<Box<dyn AnyPlant>, BenchError> {
        let method = Method::new(SchemeName::Leapfrog, None, precision);
        let why = |why| BenchError::Plant { name: size.name.clone(), why };
        let method = method.map_err(|refused| why(refused.into()))?;
        match planar {
            Some(scene) => plant_of(scene, &method, size.step_s),
            None => plant_of_model(model, &method, size.step_s),
        }
        .map_err(why)
    };
    let kernel = |precision| -> Result<Take<'static>, BenchError> {
        let mut plant = plant(precision)?;
        Ok(Box::new(move |steps| advance(plant.as_mut(), steps)))
    };
    let tumbling = tumbling(plant(PrecisionName::F64)?.as_mut());
    let mechanism = Mechanism::of_model(model).0;
    let start = State::of(&KernelState::<dbd_scene::SceneModel<F64>>::initial(model));
    let mut naive = Naive::new(&mechanism, start, size.step_s);
    let plain = Plain::of_model(model, size.step_s);
    let lacks = plain.as_ref().err().map(ToString::to_string);
    let mut plain = plain.ok();
    let mut takes: Vec<Option<(Take<'_>, u64)>> = vec![
        Some((kernel(PrecisionName::F64)?, 0)),
        Some((kernel(PrecisionName::F32)?, 0)),
        Some((Box::new(|steps| (0..steps).for_each(|_| naive.leapfrog())), 0)),
        plain.as_mut().map(|plain| (Box::new(|steps| plain.advance(steps)) as Take<'_>, 0)),
    ];
    for (take, batch) in takes.iter_mut().flatten() {
        *batch = steps.unwrap_or_else(|| batch_of(take));
    }
    let cycles = takes.len();
    let times = in_turn(cycles + 1, rounds, heard, |way| match takes.get_mut(way) {
        Some(Some((take, steps))) => elapsed(|| take(*steps)) / *steps as f64,
        Some(None) => f64::NAN,
        None => cycle(),
    });
    drop(takes);
    let finite = |states: bool| (!states).then(|| "its state is not finite".to_owned());
    let naive_fails =
        finite(naive.state.bodies.iter().all(|body| body.velocity.norm().is_finite()));
    let plain_fails = plain.as_ref().and_then(|plain| {
        finite(plain.bodies.iter().all(|body| body.velocity.iter().all(|v| v.is_finite())))
    });
    let other = |way: usize, why_not: Option<String>| match why_not {
        Some(_) => Other { time_s: None, over_kernel: None, why_not },
        None => Other {
            time_s: Figure::of(times[way].clone()),
            over_kernel: ratio(&times[way], &times[0]),
            why_not,
        },
    };
    // They are counted in space.
    let flops = per_step::<f64, _>(model, Leapfrog, size.step_s).filter(|_| planar.is_none());
    let bound = flops.and_then(|flops| {
        let bounds: Vec<f64> = times[cycles].iter().map(|c| c * flops / FLOPS_PER_CYCLE).collect();
        ratio(&times[0], &bounds)
    });
    Ok(Row {
        size: size.clone(),
        f64_s: Figure::of(times[0].clone()),
        f32: other(1, None),
        std: other(2, naive_fails),
        plain: other(3, lacks.or(plain_fails)),
        tumbling,
        flops,
        cycle_s: Figure::of(times[cycles].clone()),
        over_flop_bound: bound,
    })
}

/// Bodies that turn about more than one axis soon: an axis at rest is exactly so, and is skipped.
fn tumbling(plant: &mut dyn AnyPlant) -> usize {
    advance(plant, BEGUN);
    let state = plant.state();
    let rates = state.bodies.iter().map(|body| body.angular_velocity.to_f64());
    rates.filter(|rates| rates.iter().filter(|rate| **rate != 0.0).count() > 1).count()
}

/// Takes so many steps in one call into the plant. One that has failed steps no more: it begins again.
pub fn advance(plant: &mut dyn AnyPlant, mut steps: u64) {
    loop {
        let before = plant.steps();
        if black_box(plant.advance(steps)).is_ok() {
            return;
        }
        steps = steps.saturating_sub(plant.steps() - before);
        plant.reset();
    }
}

/// Warms caches and finds how many steps a measurement takes.
fn batch_of(take: &mut Take<'_>) -> u64 {
    let mut steps = 1;
    loop {
        let seconds = elapsed(|| take(steps));
        if seconds >= 0.5 * BATCH {
            return ((BATCH / seconds * steps as f64).ceil() as u64).max(1);
        }
        steps *= 4;
    }
}

/// \[s\] a cycle of the clock: shifts and exclusive ors, each of which waits for the one before, take one each
/// (Marsaglia 2003 has three of either in a number).
fn cycle() -> f64 {
    const NUMBERS: u32 = 20_000;
    let seconds = elapsed(|| {
        let mut x = black_box(0x2545_f491_4f6c_dd1d_u64);
        for _ in 0..NUMBERS {
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
        }
        black_box(x);
    });
    seconds / (6.0 * f64::from(NUMBERS))
}
