//! One number of a sensor: the kernel's error model ([`dbd_kernel::chain`]) in the plant's precision, `DELAY` samples
//! late.

use dbd_kernel::chain::{Errors as ErrorModel, Wander};
use dbd_kernel::random::Stream;

use crate::fault::{Problem, WiringError};
use crate::number::Number;

/// Errors of a sensor, in its unit. The default is a sensor without errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// \[unit\] standard deviation of the white noise of a sample, ≥ 0.
    pub noise: f64,
    /// \[unit\] constant bias.
    pub bias: f64,
    /// \[unit/√s\] standard deviation of the bias's random walk after one second, ≥ 0.
    pub walk: f64,
    /// \[unit\] resolution, ≥ 0; 0 for none.
    pub resolution: f64,
    /// \[unit\] smallest and largest output.
    pub range: [f64; 2],
    /// Seed of the random numbers; sensors with one seed and different names have different ones.
    pub seed: u64,
}

impl Errors {
    /// A sensor without errors.
    pub const NONE: Self = Self {
        noise: 0.0,
        bias: 0.0,
        walk: 0.0,
        resolution: 0.0,
        range: [f64::NEG_INFINITY, f64::INFINITY],
        seed: 0,
    };
}

impl Default for Errors {
    fn default() -> Self {
        Self::NONE
    }
}

/// One number of a sensor, sampled at a fixed period; `DELAY` samples late.
#[derive(Clone, Debug)]
pub struct Sensor<R, const DELAY: usize = 0> {
    errors: Errors,
    name: &'static str,
    lane: u16,
    model: ErrorModel<R>,
    per_root: R,
    wander: Wander<R>,
    late: [R; DELAY],
    next: usize,
    begun: bool,
}

impl<R: Number, const DELAY: usize> Sensor<R, DELAY> {
    /// A sensor sampled every `period` \[s\], with random numbers determined by seed, name and `lane`.
    ///
    /// # Errors
    /// [`Problem::Parameter`] if a deviation, the resolution or the period is negative or not finite, the bias is not
    /// finite or the range is empty.
    pub fn new(
        name: &'static str,
        lane: u16,
        errors: Errors,
        period: f64,
    ) -> Result<Self, WiringError> {
        let refuse = |which| WiringError { name, problem: Problem::Parameter(which) };
        let fine = |value: f64, which| {
            if value >= 0.0 && value.is_finite() { Ok(value) } else { Err(refuse(which)) }
        };
        let period = fine(period, "the sample period")?;
        if !errors.bias.is_finite() {
            return Err(refuse("the bias"));
        }
        let [least, most] = errors.range;
        if least >= most || least.is_nan() || most.is_nan() {
            return Err(refuse("the range"));
        }
        let per_root = R::from_f64(fine(errors.walk, "the random walk")?);
        Ok(Self {
            errors,
            name,
            lane,
            model: ErrorModel {
                noise: R::from_f64(fine(errors.noise, "the noise")?),
                bias: R::from_f64(errors.bias),
                walk: per_root * R::from_f64(period).sqrt(),
                resolution: R::from_f64(fine(errors.resolution, "the resolution")?),
                range: errors.range.map(R::from_f64),
            },
            per_root,
            wander: wander(errors.seed, name, lane),
            late: [R::ZERO; DELAY],
            next: 0,
            begun: false,
        })
    }

    /// Continues with another sample period \[s\], which is not negative.
    #[inline]
    pub fn set_period(&mut self, period: R) {
        self.model.walk = self.per_root * period.sqrt();
    }

    /// The output for the present exact value. Before `DELAY` samples have been taken it is the first one.
    #[inline]
    pub fn sample(&mut self, actual: R) -> R {
        let shown = self.model.sample(actual, &mut self.wander);
        if DELAY == 0 {
            return shown;
        }
        if !self.begun {
            self.begun = true;
            self.late = [shown; DELAY];
        }
        let Some(place) = self.late.get_mut(self.next) else { return shown };
        let old = core::mem::replace(place, shown);
        self.next = if self.next + 1 < DELAY { self.next + 1 } else { 0 };
        old
    }

    /// Its errors.
    pub fn errors(&self) -> &Errors {
        &self.errors
    }

    /// \[unit\] the present bias, including the walk.
    pub fn bias(&self) -> R {
        self.model.bias + self.wander.walk
    }

    /// Resets the random numbers, the walk and the delay.
    pub fn reset(&mut self) {
        self.wander = wander(self.errors.seed, self.name, self.lane);
        self.next = 0;
        self.begun = false;
    }
}

/// The streams of noise and walk.
fn wander<R: Number>(seed: u64, name: &str, lane: u16) -> Wander<R> {
    let lane = 2 * u32::from(lane);
    let [noises, walks] = [lane, lane + 1].map(|lane| Stream::new(seed, name, lane));
    Wander { noises, walks, walk: R::ZERO }
}
