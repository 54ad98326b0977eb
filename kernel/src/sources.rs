//! Signals of sources: sines, periodic tables, tables over a sensor that `sensors` reads.
//!
//! `(source, step n, part θ) => signal`. The phase of a source in its period is an integer, in units of 2⁻⁶⁴ of the
//! period: `phase + n·advance` modulo 2⁶⁴. It is exact at any step number, the same on every target, and does not lose
//! precision late in a run in single precision. A sine is a polynomial in the remainder to the nearest quarter of a
//! revolution (Taylor, below 1e-17).
//!
//! A knot counts as reached up to a thousandth of a step before it: a period of whole steps is not whole in floating
//! point. At θ > 0 a knot less than 1/128 of a step before the stage belongs to the next step, see [`crate::schedule`].

use crate::elements::input::Knot;
use crate::elements::source::{Source, SourceLaw};
use crate::geometry::Geometry;
use crate::real::{Constant, Real};
use crate::schedule::{KnotStep, Signal, StageTime};

/// A source among a plant's steps, in units of 2⁻⁶⁴ of its period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct SourceStep {
    /// Its phase at t = 0.
    pub phase: u64,
    /// Its advance per step.
    pub advance: u64,
}

impl SourceStep {
    /// A source among steps of `step` \[s\]; `knots` are those of the model.
    pub fn new<P: Geometry>(source: &Source<P>, knots: &[Knot<P::Real>], step: f64) -> Self {
        let (period, phase) = match source.law {
            SourceLaw::Sine { period, phase, .. } => (period, phase),
            SourceLaw::Periodic { period } => {
                let start = source.knots_of(knots).first().map_or(0.0, |knot| knot.time);
                (period, -start / period)
            }
            SourceLaw::Over { .. } => return Self::default(),
        };
        Self { phase: fraction(phase), advance: fraction(step / period) }
    }
}

/// Converts the knots of sources to a plant's steps: a knot of a periodic table by its phase in `first`, one of a table
/// over a sensor by the sensor's value in `offset`.
pub(crate) fn place_knots<P: Geometry>(
    sources: &[Source<P>],
    knots: &[Knot<P::Real>],
    steps: &mut [KnotStep<P::Real>],
) {
    for source in sources {
        let own = source.knots_of(knots);
        let first = source.knot as usize;
        let steps = steps.get_mut(first..first + own.len()).unwrap_or(&mut []);
        for (knot, step) in own.iter().zip(steps) {
            *step = match (source.law, own.first()) {
                (SourceLaw::Periodic { period }, Some(start)) => {
                    let phase = fraction((knot.time - start.time) / period);
                    KnotStep { first: phase, offset: P::Real::ZERO }
                }
                _ => KnotStep { first: 0, offset: P::Real::from_f64(knot.time) },
            };
        }
    }
}

/// The fractional part of `turns`, in units of 2⁻⁶⁴.
fn fraction(turns: f64) -> u64 {
    // The conversion saturates: a value that rounds up to a whole revolution is one unit less.
    ((turns - libm::floor(turns)) * (TURN * TURN)) as u64
}

/// 2³².
const TURN: f64 = 4_294_967_296.0;

/// Samples the signals of sines and periodic tables at a stage; returns whether any changed.
pub(crate) fn sample<P: Geometry>(
    sources: &[Source<P>],
    knots: &[Knot<P::Real>],
    steps: &[SourceStep],
    knot_steps: &[KnotStep<P::Real>],
    at: StageTime<P::Real>,
    signals: &mut [Signal<P::Real>],
) -> bool {
    let mut changed = false;
    for (source, step) in sources.iter().zip(steps) {
        let now = self::at(source, knots, knot_steps, step, at);
        changed |= put(source, now, signals);
    }
    changed
}

/// The signal of a sine or a periodic table at a stage; `None` of a table over a sensor.
#[inline(always)]
pub(crate) fn at<P: Geometry>(
    source: &Source<P>,
    knots: &[Knot<P::Real>],
    steps: &[KnotStep<P::Real>],
    step: &SourceStep,
    at: StageTime<P::Real>,
) -> Option<Signal<P::Real>> {
    match source.law {
        SourceLaw::Sine { amplitude, rate, offset, .. } => {
            let (sine, cosine) = sine::<P::Real>(step.at(at).0);
            Some(Signal { value: offset + amplitude * sine, rate: rate * cosine })
        }
        SourceLaw::Periodic { period } => {
            let (knots, steps) = (source.knots_of(knots), source.knots_of(steps));
            repeated(knots, steps, step.at(at), P::Real::from_f64(period))
        }
        SourceLaw::Over { .. } => None,
    }
}

/// Writes the present signal of a source to its input; returns whether it changed.
pub(crate) fn put<P: Geometry>(
    source: &Source<P>,
    now: Option<Signal<P::Real>>,
    signals: &mut [Signal<P::Real>],
) -> bool {
    let (Some(now), Some(signal)) = (now, signals.get_mut(source.input.0 as usize)) else {
        return false;
    };
    let changed = now != *signal;
    *signal = now;
    changed
}

impl SourceStep {
    /// The phase of a source at a stage, and the phase up to which its knots count as reached.
    fn at<R: Real>(&self, at: StageTime<R>) -> (u64, u64) {
        let advance = self.advance;
        let start = self.phase.wrapping_add(advance.wrapping_mul(at.step));
        let part = if at.part == R::ZERO {
            0
        } else if at.part == R::ONE {
            advance
        } else {
            (at.part.to_f64() * advance as f64) as u64
        };
        let ahead = part.saturating_sub(advance >> 7).max(advance >> 10);
        (start.wrapping_add(part), start.wrapping_add(ahead))
    }
}

/// The value of a periodic table with the given period \[s\].
fn repeated<R: Real>(
    knots: &[Knot<R>],
    steps: &[KnotStep<R>],
    (phase, reached): (u64, u64),
    period: R,
) -> Option<Signal<R>> {
    let row = steps.partition_point(|knot| knot.first <= reached).checked_sub(1)?;
    let (knot, step) = (knots.get(row)?, steps.get(row)?);
    // A knot that is reached early does not use its slope yet.
    let (early, lead) = (step.first.wrapping_sub(phase), reached.wrapping_sub(phase) as i64);
    let is_early = early != 0 && lead > 0 && early <= lead as u64;
    let since = if is_early { 0 } else { phase.wrapping_sub(step.first) };
    Some(Signal { value: knot.value + knot.slope * (turns::<R>(since) * period), rate: knot.slope })
}

/// The value of a table over the reading of a sensor, lane by lane.
pub(crate) fn over<R: Real>(knots: &[Knot<R>], steps: &[KnotStep<R>], reading: R) -> Option<R> {
    let first = knots.first()?.value;
    Some(knots.iter().zip(steps).fold(first, |value, (knot, step)| {
        let rise = knot.slope * (reading - step.offset);
        R::pick(step.offset.at_most(reading), knot.value + rise, value)
    }))
}

/// Units of 2⁻⁶⁴ revolutions as revolutions.
fn turns<R: Real>(phase: u64) -> R {
    R::from_u64(phase) * R::constant(Constant::new(1.0 / (TURN * TURN)))
}

/// Taylor's coefficients of sin(x)/x and cos(x) in powers of x², for |x| ≤ π/4.
const SERIES: [[Constant; 2]; 9] = series();

const fn series() -> [[Constant; 2]; 9] {
    let mut series = [[Constant::new(1.0); 2]; 9];
    let (mut sine, mut cosine, mut i) = (1.0, 1.0, 1);
    while i < 9 {
        let n = (2 * i) as f64;
        sine /= -(n * (n + 1.0));
        cosine /= -((n - 1.0) * n);
        series[i] = [Constant::new(sine), Constant::new(cosine)];
        i += 1;
    }
    series
}

/// Sine and cosine of a phase in units of 2⁻⁶⁴ revolutions.
fn sine<R: Real>(phase: u64) -> (R, R) {
    // The nearest quarter, and the remainder, at most an eighth of a revolution.
    let quarter = phase.wrapping_add(1 << 61) >> 62;
    let rest = phase.wrapping_sub(quarter << 62) as i64;
    let unit = R::constant(Constant::new(2.0 * core::f64::consts::PI / (TURN * TURN)));
    let angle = R::from_u64(rest.unsigned_abs()) * unit;
    let x = if rest < 0 { -angle } else { angle };
    let square = x * x;
    let (sinc, cosine) = SERIES.iter().rev().fold((R::ZERO, R::ZERO), |(sinc, cosine), c| {
        (R::constant(c[0]) + square * sinc, R::constant(c[1]) + square * cosine)
    });
    let sine = x * sinc;
    match quarter {
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        3 => (-cosine, sine),
        _ => (sine, cosine),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{F32, F64};
    use crate::index::InputIndex;

    fn sine_at<R: Real>(turns: f64) -> [f64; 2] {
        let (sine, cosine) = sine::<R>(fraction(turns));
        [sine.to_f64(), cosine.to_f64()]
    }

    #[test]
    fn a_sine_is_one_all_the_way_round() {
        for i in -4000..4000 {
            let turns = f64::from(i) / 1000.0 + 1.7e-5 * f64::from(i);
            let (sine, cosine) = libm::sincos(2.0 * core::f64::consts::PI * turns);
            for (ours, exact) in sine_at::<f64>(turns).into_iter().zip([sine, cosine]) {
                assert!((ours - exact).abs() < 8e-15, "{turns}: {ours} {exact}");
            }
            for (ours, exact) in sine_at::<f32>(turns).into_iter().zip([sine, cosine]) {
                assert!((ours - exact).abs() < 3e-7, "{turns}: {ours} {exact}");
            }
        }
        let quarters = [0.0, 0.25, 0.5, 0.75].map(sine_at::<f64>);
        assert_eq!(quarters, [[0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]]);
    }

    /// No precision is lost late in a run, also in single precision: the phase is an integer.
    #[test]
    fn a_sine_keeps_its_phase() {
        let source = Source::<F32>::sine(InputIndex(0), [2.0, 50.0, 0.25, 1.0]);
        let step = SourceStep::new(&source, &[], 1e-4);
        for n in [0, 1, 77, 1_000_003, 40_000_000_001] {
            let at = StageTime { step: n, part: 0.5_f32, h: 1e-4 };
            // 200 steps are a period.
            let turns = ((n % 200) as f64 + 0.5) / 200.0;
            let exact = libm::sin(2.0 * core::f64::consts::PI * turns + 0.25);
            let ours = sine::<f32>(step.at(at).0).0;
            assert!((f64::from(ours) - exact).abs() < 4e-7, "{n}: {ours} {exact}");
        }
    }

    /// A table of one period, whose last knot is its end.
    fn value(table: &[[f64; 2]], linear: bool, n: u64, part: f64, step: f64) -> [f64; 2] {
        let knot = |i| Knot::<f64>::of_table(table, i, linear).unwrap();
        let knots: [Knot<f64>; 2] = core::array::from_fn(knot);
        let period = table[2][0] - table[0][0];
        let law = SourceLaw::Periodic { period };
        let source = Source::<F64> { input: InputIndex(0), knot: 0, knots: 2, law };
        let mut steps = [KnotStep::default(); 2];
        place_knots(&[source], &knots, &mut steps);
        let at = StageTime { step: n, part, h: step };
        let at = SourceStep::new(&source, &knots, step).at(at);
        let signal = repeated(&knots, &steps, at, period).unwrap();
        [signal.value, signal.rate]
    }

    #[test]
    fn a_table_repeats_and_a_jump_belongs_to_the_step_it_begins() {
        let square = [[0.0, 1.0], [0.3, -1.0], [0.7, 1.0]];
        for (step, round) in [(0.1, 7), (0.05, 14), (1e-3, 700), (0.7 / 3000.0, 3000)] {
            let high = round * 3 / 7;
            for turn in [0, 1, 2, 1000, 1_000_001] {
                let at = |n: u64, part: f64| value(&square, false, turn * round + n, part, step)[0];
                if round % 7 == 0 {
                    assert_eq!([at(high - 1, 0.0), at(high - 1, 1.0)], [1.0; 2], "{step} {turn}");
                    assert_eq!([at(high, 0.0), at(high, 0.5)], [-1.0; 2], "{step} {turn}");
                }
                assert_eq!([at(round - 1, 0.0), at(round - 1, 1.0)], [-1.0; 2], "{step} {turn}");
                assert_eq!([at(round, 0.0), at(round, 0.25)], [1.0; 2], "{step} {turn}");
            }
        }
    }

    #[test]
    fn lines_lead_from_knot_to_knot_before_and_after() {
        let triangle = [[0.1, 0.0], [0.3, 2.0], [0.5, 0.0]];
        let at = |n, part| value(&triangle, true, n, part, 0.01);
        let near = |[v, r]: [f64; 2], [value, rate]: [f64; 2]| {
            assert!((v - value).abs() < 1e-9 && (r - rate).abs() < 1e-9, "{v} {r} {value} {rate}");
        };
        near(at(0, 0.0), [1.0, -10.0]);
        near(at(10, 0.0), [0.0, 10.0]);
        near(at(20, 0.5), [1.05, 10.0]);
        near(at(49, 1.0), [0.0, -10.0]);
        near(at(4_000_050, 0.0), [0.0, 10.0]);
        assert_eq!(at(29, 1.0)[1].to_bits(), 10.0_f64.to_bits());
    }

    #[test]
    fn over_a_sensor_lines_lead_from_knot_to_knot_and_the_ends_hold() {
        let table = [[-1.0, 3.0], [0.0, 1.0], [2.0, 5.0]];
        let of = |linear, reading| {
            let knot = |i| Knot::<f64>::of_table(&table, i, linear).unwrap();
            let knots: [Knot<f64>; 3] = core::array::from_fn(knot);
            let steps = knots.map(|knot| KnotStep { first: 0, offset: knot.time });
            over(&knots, &steps, reading).unwrap()
        };
        let readings = [-9.0, -1.0, -0.5, 0.0, 1.0, 2.0, 9.0];
        assert_eq!(readings.map(|r| of(true, r)), [3.0, 3.0, 2.0, 1.0, 3.0, 5.0, 5.0]);
        assert_eq!(readings.map(|r| of(false, r)), [3.0, 3.0, 3.0, 1.0, 1.0, 5.0, 5.0]);
    }
}
