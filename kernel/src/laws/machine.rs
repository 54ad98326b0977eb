//! The windings of a permanent-magnet synchronous machine in rotor axes: d along the magnets, q a quarter of a period
//! ahead.
//!
//! `(voltages u, rate v, currents i) => effort τ = 1.5·p·(λ + (L_d − L_q)·i_d)·i_q`, with
//! `L_d·i_d' = u_d − R·i_d + p·v·L_q·i_q`, `L_q·i_q' = u_q − R·i_q − p·v·(L_d·i_d + λ)` (Park, Trans. AIEE 48 (1929)
//! 716; Krishnan 2001, ch. 9): currents and voltages are amplitudes of a phase. p is the number of pole pairs times the
//! gear ratio, as rates and efforts are those at the side of the coordinate.
//!
//! The rate and both currents advance half a step together by the L-stable method of two stages and order two
//! (Alexander, SIAM J. Numer. Anal. 14 (1977) 1006), `γ = 1 − 1/√2`. The equations are made linear about the middle of
//! the pass, found by the implicit Euler method: p·v in the rotation of the flux, and λ + (L_d − L_q)·i_d, in effort and
//! voltage alike. What the windings take from the rotor they thus give to the currents, and without voltages the energy
//! `m·v² + 1.5·(L_d·i_d² + L_q·i_q²)` never grows, at any step.

use crate::laws::gear::Gear;
use crate::laws::interaction::Wrong;
use crate::laws::shaft_friction::Flow;
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

/// The currents of the windings in rotor axes: memory of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Currents<R> {
    /// \[A\] along the magnets.
    pub d: R,
    /// \[A\] a quarter of a period ahead.
    pub q: R,
}

impl<R: Real> Default for Currents<R> {
    fn default() -> Self {
        Self { d: R::ZERO, q: R::ZERO }
    }
}

impl<R: Real> Words for Currents<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        [self.d, self.q].iter().for_each(|number| visitor.word(number.word()));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        for number in [&mut self.d, &mut self.q] {
            *number = R::from_words(source);
        }
    }
}

/// The constants of the windings.
#[derive(Clone, Copy)]
pub(super) struct Machine<R> {
    /// \[Ω\] R of a phase; 0 where the inputs are the currents.
    pub(super) resistance: R,
    /// \[H\] L_d, L_q.
    pub(super) inductances: [R; 2],
    /// \[V·s\] λ.
    pub(super) flux: R,
    /// \[1, 1/m\] p.
    pub(super) poles: R,
    /// \[A\] the largest amplitude of the currents.
    pub(super) most_current: R,
}

/// γ.
const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// (1 − γ)/γ.
const NEXT: f64 = core::f64::consts::SQRT_2 + 1.0;

/// Rate and currents.
#[derive(Clone, Copy)]
struct Three<R> {
    rate: R,
    d: R,
    q: R,
}

impl<R: Real> Three<R> {
    /// `self + by·other`.
    #[inline(always)]
    fn plus(self, by: R, other: Self) -> Self {
        Self {
            rate: self.rate + by * other.rate,
            d: self.d + by * other.d,
            q: self.q + by * other.q,
        }
    }

    /// `self − other`.
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { rate: self.rate - other.rate, d: self.d - other.d, q: self.q - other.q }
    }
}

/// The linear equations `x' = A·x` of a pass, times its duration: A has the rows `[−brake, push, 0]` for `[rate, q, d]`,
/// `[0, across, −decay_d]` and `[−emf, −decay_q, −back]`.
struct Linear<R> {
    brake: R,
    push: R,
    decay_d: R,
    across: R,
    emf: R,
    decay_q: R,
    back: R,
}

impl<R: Real> Linear<R> {
    /// The solution x of `x − t·A·x = right`; its divisors are at least 1.
    #[inline(always)]
    fn solved(&self, t: R, right: Three<R>) -> Three<R> {
        let one = R::ONE;
        let rate = one / (one + t * self.brake);
        let d = one / (one + t * self.decay_d);
        let (push, across) = (t * self.push * rate, t * self.across * d);
        let (emf, back) = (t * self.emf, t * self.back);
        let (rate, d) = (right.rate * rate, right.d * d);
        let divisor = one + t * self.decay_q + emf * push + back * across;
        let q = (right.q - emf * rate - back * d) / divisor;
        Three { rate: rate + push * q, d: d + across * q, q }
    }

    /// x after the time of x' = A·x + b from x0.
    #[inline(always)]
    fn flow(&self, from: Three<R>, by: Three<R>) -> Three<R> {
        let (t, next) = (R::from_f64(GAMMA), R::from_f64(NEXT));
        let start = from.plus(t, by);
        let stage = self.solved(t, start);
        self.solved(t, start.plus(next, stage.minus(from)))
    }
}

impl<R: Real> Machine<R> {
    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        let [d, q] = self.inductances;
        let least = "a number ≥ 0; 0 where the inputs are currents";
        Wrong::unless(self.resistance >= zero, "resistance", "is negative", least)?;
        let positive = "an inductance > 0";
        Wrong::unless(d > zero, "inductance_d", "is not positive", positive)?;
        Wrong::unless(q > zero, "inductance_q", "is not positive", positive)?;
        Wrong::unless(self.flux >= zero, "flux", "is negative", "a flux linkage ≥ 0")?;
        let drives = self.flux > zero || d != q;
        let other = "a flux linkage > 0, or different inductances";
        Wrong::unless(drives, "flux", "is 0 with equal inductances", other)?;
        Wrong::unless(self.poles != zero, "poles", "is 0", "a number other than 0")?;
        let most = self.most_current > zero;
        Wrong::unless(most, "most_current", "is not positive", "a current > 0")
    }

    /// Whether the inputs are its currents.
    #[inline(always)]
    pub(super) fn is_fed(&self) -> bool {
        self.resistance == R::ZERO
    }

    /// λ + (L_d − L_q)·i_d.
    #[inline(always)]
    fn linked(&self, d: R) -> R {
        let [of_d, of_q] = self.inductances;
        self.flux + (of_d - of_q) * d
    }

    /// \[N·m\] per \[V·s·A\] the effort per linked flux and current: 1.5·p.
    #[inline(always)]
    fn gain(&self) -> R {
        (R::ONE + R::HALF) * self.poles
    }

    /// \[N, N·m\] τ.
    #[inline(always)]
    pub(super) fn effort(&self, currents: Currents<R>) -> R {
        self.gain() * self.linked(currents.d) * currents.q
    }

    /// The currents within their largest amplitude.
    #[inline(always)]
    pub(super) fn bounded(&self, [d, q]: [R; 2]) -> Currents<R> {
        let (square, most) = (d * d + q * q, self.most_current);
        let scale = most * square.sqrt().reciprocal_or_zero();
        let scale = R::pick((most * most).less_than(square), scale, R::ONE);
        Currents { d: d * scale, q: q * scale }
    }

    /// The equations for the time `h` about a rate and a current d.
    #[inline(always)]
    fn about(&self, (gear, viscous): (&Gear<R>, R), h: R, rate: R, d: R) -> Linear<R> {
        let [of_d, of_q] = self.inductances;
        let (turn, linked) = (h * self.poles, self.linked(d));
        let (inverse, decay) = (h / gear.inertia, h * self.resistance);
        let back = turn * rate;
        Linear {
            brake: inverse * viscous,
            push: inverse * self.gain() * linked,
            decay_d: decay / of_d,
            across: back * of_q / of_d,
            emf: turn * linked / of_q,
            decay_q: decay / of_q,
            back,
        }
    }

    /// The rotor of a rate, which includes the kick, after the time `[h, kick]`, at voltages of d and q: the flow of
    /// effort and viscous friction.
    #[inline(always)]
    pub(super) fn flow(
        &self,
        (gear, viscous): (&Gear<R>, R),
        volts: [R; 2],
        ([h, kick], rate): ([R; 2], R),
        currents: Currents<R>,
    ) -> Flow<R, Currents<R>> {
        let ([of_d, of_q], zero) = (self.inductances, R::ZERO);
        let [of_volts_d, of_volts_q] = volts;
        let from = Three { rate: rate - kick, d: currents.d, q: currents.q };
        let by = Three { rate: kick, d: h * of_volts_d / of_d, q: h * of_volts_q / of_q };
        let first = self.about((gear, viscous), h, from.rate, from.d);
        let middle = first.solved(R::HALF, from.plus(R::HALF, by));
        let linear = self.about((gear, viscous), h, middle.rate, middle.d);
        let to = linear.flow(from, by);
        let none = Three { rate: zero, d: zero, q: zero };
        let response = linear.flow(none, Three { rate: R::ONE, ..none }).rate;
        Flow { rate: to.rate, after: self.bounded([to.d, to.q]), response }
    }
}
