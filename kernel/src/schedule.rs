//! The timing of loads and inputs: load windows and tables in whole steps, the inputs' present signals.
//!
//! `(times, step) => windows, knots in steps; (table, step n, part θ) => signal`. A signal is set by the caller and
//! held, or follows a table that is held or linear between its knots, sampled at the time of each stage, θ of step n:
//! `value + slope·((n − first + θ)·h + offset)`, `first` the knot's first step and `offset` the time from the knot to
//! that step. A value read between two steps is the one at the start of the next. At θ = 1 a knot at the step's end
//! does not act yet: a jump belongs to the step that it begins.

use crate::elements::input::{Input, InputKind, Knot};
use crate::geometry::Geometry;
use crate::real::{Constant, Real, choose};
use crate::words::{WordSource, WordVisitor, Words};

/// The steps during which a load acts: `first ≤ n < end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct LoadWindow {
    /// First step.
    pub first: u64,
    /// First step after the window.
    pub end: u64,
}

impl LoadWindow {
    /// The steps of size `step` \[s\] that start within \[from, until).
    #[must_use]
    pub fn new(from: f64, until: f64, step: f64) -> Self {
        Self { first: first_step(from, step), end: first_step(until, step) }
    }

    /// Whether the load acts during step `n`.
    #[inline(always)]
    #[must_use]
    pub fn contains(self, n: u64) -> bool {
        self.first <= n && n < self.end
    }

    /// Whether the load starts or ends at step `n`.
    #[inline(always)]
    #[must_use]
    pub fn changes_at(self, n: u64) -> bool {
        n == self.first || n == self.end
    }
}

/// The first step that starts at or after `time`; a multiple of the step within 1e-9 counts as exact.
pub(crate) fn first_step(time: f64, step: f64) -> u64 {
    if time <= 0.0 {
        return 0;
    }
    let steps = time / step;
    // The conversion saturates: an infinite end becomes the largest step number.
    let below = steps as u64;
    let excess = steps - below as f64;
    if excess <= 1e-9 * steps {
        below
    } else {
        // `excess` close to 1 rounds up to the same step as any other fraction.
        below.saturating_add(1)
    }
}

/// The position of a knot among a plant's steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct KnotStep<R> {
    /// The first step that starts at or after the knot's time.
    pub first: u64,
    /// \[s\] from the knot's time to that step's start.
    pub offset: R,
}

impl<R: Real> KnotStep<R> {
    /// A knot at `time` \[s\] among steps of `step` \[s\].
    #[must_use]
    pub fn new(time: f64, step: f64) -> Self {
        let first = first_step(time, step);
        Self { first, offset: R::from_f64(first as f64 * step - time) }
    }
}

/// The present value of an input and its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Signal<R> {
    /// \[N, N·m or m\] by the kind of its input.
    pub value: R,
    /// \[m/s, rad/s\] for an anchor and for laws that read it; unused by other kinds.
    pub rate: R,
}

impl<R: Real> Signal<R> {
    /// The same signal in another precision.
    pub fn convert<Q: Real>(&self) -> Signal<Q> {
        Signal { value: Q::from_f64(self.value.to_f64()), rate: Q::from_f64(self.rate.to_f64()) }
    }
}

impl<R: Real> Words for Signal<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(self.value.word());
        visitor.word(self.rate.word());
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.value = R::from_words(source);
        self.rate = R::from_words(source);
    }
}

/// The position of a stage among a plant's steps of size `h` \[s\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageTime<R> {
    /// The step.
    pub(crate) step: u64,
    /// The elapsed fraction of it, 0 to 1.
    pub(crate) part: R,
    /// \[s\] the step size.
    pub(crate) h: R,
}

/// Samples the signals of tables at a stage; returns whether any changed. Not inlined, except for lanes: a step calls
/// it more than once. Not called where there is no table.
#[inline(always)]
pub(crate) fn sample<P: Geometry>(
    inputs: &[Input<P>],
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    at: StageTime<P::Real>,
    signals: &mut [Signal<P::Real>],
) -> bool {
    if inputs.is_empty() || knots.is_empty() {
        false
    } else if P::Real::ONE_LANE {
        sample_apart(inputs, knots, steps, at, signals)
    } else {
        sample_here(inputs, knots, steps, at, signals)
    }
}

#[inline(never)]
fn sample_apart<P: Geometry>(
    inputs: &[Input<P>],
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    at: StageTime<P::Real>,
    signals: &mut [Signal<P::Real>],
) -> bool {
    sample_here(inputs, knots, steps, at, signals)
}

#[inline(always)]
fn sample_here<P: Geometry>(
    inputs: &[Input<P>],
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    at: StageTime<P::Real>,
    signals: &mut [Signal<P::Real>],
) -> bool {
    let mut changed = false;
    for (input, signal) in inputs.iter().zip(signals) {
        let Some(now) = self::at(input, knots, steps, at) else { continue };
        changed |= now != *signal;
        *signal = now;
    }
    changed
}

/// The signal of an input's table at a stage, `None` without a table.
#[inline(always)]
pub(crate) fn at<P: Geometry>(
    input: &Input<P>,
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    at: StageTime<P::Real>,
) -> Option<Signal<P::Real>> {
    let range = input.knot as usize..input.knot as usize + input.knots as usize;
    table(knots.get(range.clone())?, steps.get(range)?, at)
}

/// A knot counts as at a step's end within this fraction of the step: the tolerance of [`first_step`] for a time late
/// in a run.
const ON_THE_END: Constant = Constant::new(0.01);

/// The value of a table at a stage: that of the last knot before it, `None` without knots.
#[inline(always)]
fn table<R: Real>(knots: &[Knot<R>], steps: &[KnotStep<R>], at: StageTime<R>) -> Option<Signal<R>> {
    let StageTime { step: n, part, h } = at;
    // The time since a knot within the step, negative before it.
    let within = |knot: &KnotStep<R>| (part - R::ONE) * h + knot.offset;
    let mut begun = steps.partition_point(|knot| knot.first <= n);
    while let Some(knot) = steps.get(begun)
        && part != R::ZERO
        && knot.first == n.wrapping_add(1)
        && within(knot) > R::constant(ON_THE_END) * h
    {
        begun += 1;
    }
    let Some(row) = begun.checked_sub(1) else {
        return knots.first().map(|knot| Signal { value: knot.value, rate: R::ZERO });
    };
    let (knot, step) = (knots.get(row)?, steps.get(row)?);
    let since = match n.checked_sub(step.first) {
        Some(steps) => (R::from_u64(steps) + part) * h + step.offset,
        None => within(step),
    };
    // A held value stays constant, also where the elapsed time exceeds the number's range.
    let rise = choose!(R, knot.slope.equals(R::ZERO), R::ZERO, knot.slope * since);
    Some(Signal { value: knot.value + rise, rate: knot.slope })
}

/// Whether the ground jumps at the start of this step or within it, by a table with held values.
pub(crate) fn ground_jumps<P: Geometry>(
    inputs: &[Input<P>],
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    (step, h): (u64, P::Real),
) -> bool {
    inputs.iter().any(|input| {
        let range = input.knot as usize..input.knot as usize + input.knots as usize;
        let (InputKind::Anchor { .. }, Some(knots), Some(steps)) =
            (input.kind, knots.get(range.clone()), steps.get(range))
        else {
            return false;
        };
        knots.windows(2).zip(steps.iter().skip(1)).any(|(pair, at)| {
            let within = at.offset > P::Real::constant(ON_THE_END) * h;
            let [before, after] = pair else { return false };
            at.first == step.wrapping_add(within.into())
                && before.slope == P::Real::ZERO
                && before.value != after.value
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(linear: bool, step: f64) -> [f64; 6] {
        let (slope0, slope1) = if linear { (10.0, -5.0) } else { (0.0, 0.0) };
        let knots = [
            Knot { time: 0.1, value: 1.0, slope: slope0 },
            Knot { time: 0.2, value: 2.0, slope: slope1 },
            Knot { time: 0.4, value: 1.0, slope: 0.0 },
        ];
        let steps = knots.map(|knot| KnotStep::new(knot.time, step));
        [0.0, 0.1, 0.15, 0.25, 0.4, 9.0].map(|time: f64| {
            let n = libm::round(time / step) as u64;
            table(&knots, &steps, StageTime { step: n, part: 0.0, h: step }).unwrap().value
        })
    }

    #[test]
    fn tables_are_held_or_linear() {
        assert_eq!(values(false, 0.01), [1.0, 1.0, 1.0, 2.0, 1.0, 1.0]);
        let expected = [1.0, 1.0, 1.5, 1.75, 1.0, 1.0];
        for (value, expected) in values(true, 0.01).into_iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{value} {expected}");
        }
    }

    #[test]
    fn a_knot_between_two_steps_begins_at_the_later_with_its_value_there() {
        let knots = [
            Knot { time: 0.0, value: 0.0_f64, slope: 0.0 },
            Knot { time: 0.015, value: 0.0, slope: 2.0 },
        ];
        let steps = knots.map(|knot| KnotStep::new(knot.time, 0.01));
        let at = |n, part| table(&knots, &steps, StageTime { step: n, part, h: 0.01 }).unwrap();
        assert_eq!((at(1, 0.0).value, at(1, 0.0).rate), (0.0, 0.0));
        assert!((at(2, 0.0).value - 0.01).abs() < 1e-15 && at(2, 0.0).rate == 2.0);
        // A stage within the step uses it from its time on.
        assert_eq!((at(1, 0.4).value, at(1, 0.4).rate), (0.0, 0.0));
        assert!((at(1, 0.75).value - 0.005).abs() < 1e-15 && at(1, 0.75).rate == 2.0);
        assert_eq!(at(1, 1.0).value.to_bits(), at(2, 0.0).value.to_bits());
    }

    #[test]
    fn a_jump_belongs_to_the_step_it_begins() {
        for (time, step) in [(0.1, 0.01), (0.3, 0.1), (1000.0, 1e-3)] {
            let knots = [
                Knot { time: 0.0, value: 1.0_f64, slope: 0.0 },
                Knot { time, value: 5.0, slope: 0.0 },
            ];
            let steps = knots.map(|knot| KnotStep::new(knot.time, step));
            let last = libm::round(time / step) as u64 - 1;
            let at = |n, part| {
                table(&knots, &steps, StageTime { step: n, part, h: step }).unwrap().value
            };
            assert_eq!([at(last, 0.0), at(last, 1.0), at(last + 1, 0.0)], [1.0, 1.0, 5.0]);
        }
    }

    #[test]
    fn windows_are_half_open_and_forgive_rounding() {
        let window = LoadWindow::new(0.0, 2.0, 2e-5);
        assert_eq!((window.first, window.end), (0, 100_000));
        assert!(window.contains(0) && window.contains(99_999) && !window.contains(100_000));
        assert_eq!(
            LoadWindow::new(0.3, f64::INFINITY, 0.1),
            LoadWindow { first: 3, end: u64::MAX }
        );
        assert_eq!(LoadWindow::new(0.25, 0.35, 0.1), LoadWindow { first: 3, end: 4 });
    }
}
