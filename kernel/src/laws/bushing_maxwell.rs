//! A spring and a damper in series along and about each axis of a bushing: the dynamic stiffening of rubber.
//!
//! With the coordinates e of [`super::Bushing`] and the deflections z of the dampers: `f = k·(e − z)`, `ż = (e − z)/τ`,
//! the complex stiffness `k·iωτ/(1 + iωτ)` (Maxwell 1867; Flügge, Viscoelasticity, ch. 1).
//!
//! Over a step at the constant rate ė the spring's part y = e − z becomes `(y + h·ė·(1 + x/2))/(1 + x + x²/2)`, x = h/τ:
//! the exact flow with the (0,2) Padé approximant of `exp(−x)`, of order 2, without oscillation at any step. The work of
//! the mean force of both ends of steps, starting from y = 0, is never negative: with D = 1 + x + x²/2 it is
//! `½·k·(1 + D)/(2 + x)·y²` of the last y plus `k·(D − 1)/(4 + 2·x)·(yₙ + yₙ₊₁)²` of each step.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::deflection::{
    Deflected, LOADS, Mount, STIFFNESSES, Sixfold, any, each, flat, sixfold,
};
use crate::laws::end::Seen;
use crate::laws::interaction::{Interaction, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::words::{Word, WordSource, WordVisitor, Words};

law! {
    /// Springs and dampers in series along and about three axes of the first body, beside a bushing: soft rubber.
    pub struct BushingMaxwell = "bushing-maxwell" {
        /// A point of the first body and one of the second, at the same place where the bushing is not deflected.
        points: Points,
        /// First axis, perpendicular to `z`; the second is z × x.
        x: Normal,
        /// Third axis. The bushing is not twisted at t = 0.
        z: Axis,
        /// Relaxation time: damping over stiffness of each axis.
        relaxation: Number("s"),
        /// Stiffness along x at high frequencies.
        stiffness_x: Number("N/m") = 0.0,
        /// Stiffness along y at high frequencies.
        stiffness_y: Number("N/m") = 0.0,
        /// Stiffness along z at high frequencies.
        stiffness_z: Number("N/m") = 0.0,
        /// Stiffness of a rotation about x at high frequencies.
        turn_stiffness_x: Number("N·m/rad") = 0.0,
        /// Stiffness of a rotation about y at high frequencies.
        turn_stiffness_y: Number("N·m/rad") = 0.0,
        /// Stiffness of a rotation about z at high frequencies.
        turn_stiffness_z: Number("N·m/rad") = 0.0,
    }
}

/// The memory of dampers in series with springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxed<R> {
    /// \[m, rad\] the deflection of the damper along and about x, y, z.
    pub dampers: [R; 6],
    /// Whether they are initialised: the springs are relaxed at first.
    pub begun: bool,
}

impl<R: Real> Default for Relaxed<R> {
    fn default() -> Self {
        Self { dampers: [R::ZERO; 6], begun: false }
    }
}

impl<R: Real> Words for Relaxed<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.dampers.iter().for_each(|number| visitor.word(number.word()));
        visitor.word(Word::I32(i32::from(self.begun)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        for number in &mut self.dampers {
            *number = R::from_words(source);
        }
        self.begun = source.take(4) != 0;
    }
}

/// The spring's part of a deflection after a step: that before it, the change of the deflection, h/τ.
#[inline(always)]
fn relaxed<R: Real>(before: R, change: R, x: R) -> R {
    let half = R::ONE + R::HALF * x;
    (before + change * half) / (R::ONE + x * half)
}

impl<P: Geometry> BushingMaxwell<P> {
    #[inline(always)]
    fn mount(&self) -> Mount<'_, P> {
        Mount { points: &self.points, x: self.x, z: &self.z }
    }

    #[inline(always)]
    fn stiffnesses(&self) -> Sixfold<P::Real> {
        [
            [self.stiffness_x, self.stiffness_y, self.stiffness_z],
            [self.turn_stiffness_x, self.turn_stiffness_y, self.turn_stiffness_z],
        ]
    }

    /// \[m, rad\] the deflections of the springs.
    #[inline(always)]
    fn springs(deflected: &Deflected<P>, memory: &Relaxed<P::Real>) -> Sixfold<P::Real> {
        let values = deflected.values();
        let dampers = if memory.begun { sixfold(memory.dampers) } else { values };
        each(values, dampers, |value, damper| value - damper)
    }

    /// \[N, N·m\]
    #[inline(always)]
    fn forces(&self, deflected: &Deflected<P>, memory: &Relaxed<P::Real>) -> Sixfold<P::Real> {
        let springs = Self::springs(deflected, memory);
        each(self.stiffnesses(), springs, |stiffness, spring| stiffness * spring)
    }
}

impl<P: Geometry> Interaction<P> for BushingMaxwell<P> {
    type State = Relaxed<P::Real>;
    type Dampers = [(); 0];
    const ADVANCES: bool = true;
    const QUANTITIES: &'static [Quantity] = LOADS;

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut Relaxed<P::Real>) {
        if !memory.begun {
            return;
        }
        let deflected = self.mount().deflected(seen);
        // Bodies have the velocities of the step.
        let rates = sixfold(deflected.rates(seen, deflected.gradients));
        let (values, x) = (deflected.values(), h / self.relaxation);
        let changes = rates.map(|rates| rates.map(|rate| h * rate));
        let before = each(values, changes, |value, change| value - change);
        let before = each(before, sixfold(memory.dampers), |value, damper| value - damper);
        let after = each(before, changes, |before, change| relaxed(before, change, x));
        memory.dampers = flat(each(values, after, |value, spring| value - spring));
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Relaxed<P::Real>) {
        if !memory.begun {
            let dampers = flat(self.mount().deflected(seen).values());
            *memory = Relaxed { dampers, begun: true };
        }
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &Relaxed<P::Real>,
    ) -> Option<ForcePair<P::Space>> {
        let deflected = self.mount().deflected(seen);
        let forces = self.forces(&deflected, memory);
        Some(deflected.force_pair(seen, forces))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Relaxed<P::Real>) -> P::Real {
        let springs = flat(Self::springs(&self.mount().deflected(seen), memory));
        let mut sum = P::Real::ZERO;
        for (stiffness, spring) in flat(self.stiffnesses()).into_iter().zip(springs) {
            sum = sum + stiffness * (spring * spring);
        }
        P::Real::HALF * sum
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Relaxed<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let deflected = self.mount().deflected(seen);
        let forces = self.forces(&deflected, memory);
        deflected.tangent(seen, self.stiffnesses(), forces, visit)
    }

    fn check(&self) -> Result<(), Wrong> {
        self.mount().check()?;
        let positive = self.relaxation > P::Real::ZERO;
        Wrong::unless(positive, "relaxation", "is not positive", "a time > 0")?;
        let acts = any(self.stiffnesses(), STIFFNESSES)?;
        Wrong::unless(acts, "stiffness_x", "is 0 like all others", "above 0, or another of them")
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Relaxed<P::Real>) -> P::Real {
        let forces = self.forces(&self.mount().deflected(seen), memory);
        flat(forces).into_iter().nth(quantity).unwrap_or(P::Real::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work of the mean force along random motions, at any ratio of step and relaxation time.
    #[test]
    fn a_branch_never_makes_energy() {
        let mut seed = 0x2545_f491_4f6c_dd1d_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        };
        for x in [1e-4, 1e-2, 0.3, 1.0, 7.0, 1e3, 1e6] {
            let (mut work, mut kept, mut lost, mut last) = (0.0, 0.0, 0.0, 0.0);
            for _ in 0..20_000 {
                let change = random() * random();
                let next = relaxed(last, change, x);
                work += 0.5 * (last + next) * change;
                let denominator = 1.0 + x + 0.5 * x * x;
                kept = 0.5 * (1.0 + denominator) / (2.0 + x) * next * next;
                lost += (denominator - 1.0) / (4.0 + 2.0 * x) * (last + next) * (last + next);
                assert!(work >= -1e-12, "{x}: {work:e}");
                last = next;
            }
            assert!((work - kept - lost).abs() < 1e-9 * work, "{x}: {work} {kept} {lost}");
        }
    }

    /// Order 2: a step at a constant rate against the exact flow.
    #[test]
    fn a_step_has_an_error_of_third_order() {
        let exact = |y: f64, change: f64, x: f64| y * libm::exp(-x) - change / x * libm::expm1(-x);
        let off = |x: f64| (relaxed(0.7, 0.3 * x, x) - exact(0.7, 0.3 * x, x)).abs();
        let order = libm::log2(off(0.02) / off(0.01));
        assert!((order - 3.0).abs() < 0.05, "{order}");
        // At rest the spring relaxes, at a constant rate its part is rate · τ.
        assert!(relaxed(1.0, 0.0, 1e8) < 1e-15);
        assert!((relaxed(0.2, 0.2 * 50.0, 50.0) - 0.2_f64).abs() < 1e-15);
    }
}
