//! The brush tyre with parabolic pressure, in series with a spring.
//!
//! Slip s of the tread in the patch, `y = |(C_x·s_x, C_y·s_y)|/(3·μ·N)` ↦ force `μ·N·(3y − 3y² + y³)` along
//! `(C_x·s_x, C_y·s_y)`, `μ·N` for y ≥ 1 (Fromm; Pacejka, Tire and Vehicle Dynamics, ch. 3). A spring of stiffness k has the
//! same force: its deflection u grows by the slip of the wheel less `s` times the rolled distance (the single contact
//! point with a carcass, ch. 7), so rolling relaxes it and rest holds it.

use crate::real::Real;
use crate::space::Linear;

/// The constants of a tread.
#[derive(Clone, Copy)]
pub(super) struct Brush<R> {
    /// \[N\] force per slip at small slip, along the wheel and across it.
    pub(super) slip: [R; 2],
    /// \[N/m\] of the spring in series.
    pub(super) stiffness: R,
}

/// A deflection after rolling.
pub(super) struct Relaxed<V: Linear> {
    /// \[m\]
    pub(super) give: V,
    /// \[1\] `(3y − 3y² + y³)/y`, from 3 without slip to 1 where it slides.
    pub(super) secant: V::Real,
    /// Whether the whole patch slides.
    pub(super) slides: bool,
}

/// Steps of Newton's method: an error of 1e-5 of the limit where the stiffnesses differ by a factor of 2.5, of 2e-9
/// where they are equal.
const STEPS: usize = 5;

impl<R: Real> Brush<R> {
    /// \[1\] slip per deflection \[m\], times the secant: along and across.
    #[inline(always)]
    pub(super) fn slip_per_give(&self) -> [R; 2] {
        let three = R::ONE + R::TWO;
        let [along, across] = self.slip;
        [three * self.stiffness / along, three * self.stiffness / across]
    }

    /// The deflection after rolling a distance \[m\]: `u + s·distance = give`. `along` is the unit direction of rolling,
    /// `limit` \[m\] the deflection at μ·N, `beyond` the excess at which it counts as sliding.
    #[inline(always)]
    pub(super) fn relaxed<V: Linear<Real = R>>(
        &self,
        give: V,
        along: V,
        rolled: R,
        [limit, beyond]: [R; 2],
    ) -> Relaxed<V> {
        let one = R::ONE;
        let first = along * along.dot(give);
        let second = give - first;
        let [x, y] = self.slip_per_give();
        let [x, y] = [x * rolled, y * rolled];
        // Where the patch slides, the bristles' slip is that of y = 1; the rest of the slip is along the force.
        let whole = first * (one / (one + x)) + second * (one / (one + y));
        let square = whole.dot(whole);
        let cone = limit * beyond;
        if cone * cone < square {
            let give = whole * (limit * square.sqrt().reciprocal_or_zero());
            return Relaxed { give, secant: one, slides: true };
        }
        let inverse = limit.reciprocal_or_zero();
        let parts = [first.dot(first).sqrt() * inverse, second.dot(second).sqrt() * inverse];
        let secant = secant(parts, [x, y]);
        let mut give = first * (secant / (secant + x)) + second * (secant / (secant + y));
        // An error of Newton's method must not leave the cone.
        let square = give.dot(give);
        if cone * cone < square {
            give = give * (limit * square.sqrt().reciprocal_or_zero());
        }
        Relaxed { give, secant, slides: false }
    }
}

/// The secant ψ of the brush's force with `y = |p/(ψ + λ)|`, p the force over μ·N before rolling, λ the rolled distance
/// over the distances of relaxation.
///
/// With `w = 1 − y` it is `ψ = 1 + w + w²`, and `w³ + λ·w = 1 + λ − |p|` for equal λ. Otherwise λ is the mean at which both
/// hold. Newton's method from above converges monotonically.
#[inline(always)]
fn secant<R: Real>([p, q]: [R; 2], [of_p, of_q]: [R; 2]) -> R {
    let (zero, one) = (R::ZERO, R::ONE);
    let whole = (p * p + q * q).sqrt();
    let three = one + R::TWO;
    if whole == zero {
        return three;
    }
    let mean = (p * p * of_p + q * q * of_q) / (whole * whole);
    let rest = one + mean - whole;
    let rest = R::pick(rest.less_than(zero), zero, rest);
    let rest = R::pick(one.less_than(rest), one, rest);
    let mut w = rest.sqrt().sqrt();
    for _ in 0..STEPS {
        let secant = one + w + w * w;
        let (a, b) = (p / (secant + of_p), q / (secant + of_q));
        let mean = whole * (a * a + b * b).sqrt().reciprocal_or_zero() - secant;
        let slope = three * (w * w) + mean;
        let next = (R::TWO * (w * w * w) + (one + mean - whole)) * slope.reciprocal_or_zero();
        let next = R::pick(next.less_than(zero), zero, next);
        w = R::pick(one.less_than(next), one, next);
    }
    one + w + w * w
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    /// A wheel that rolls with a constant slip settles at the brush's force, whatever the distance of a step.
    #[test]
    fn a_constant_slip_settles_at_the_brush_force() {
        let brush = Brush { slip: [8e4, 5e4], stiffness: 2e5 };
        let (limit, cases) = (3000.0, [[0.01, 0.0], [0.0, 0.03], [0.04, -0.02], [-0.08, 0.06]]);
        for slip in cases {
            let [a, b] = [8e4 * slip[0], 5e4 * slip[1]];
            let size = f64::hypot(a, b);
            let y = (size / (3.0 * limit)).min(1.0);
            let force = limit * y * (3.0 - y * (3.0 - y)) / size;
            for distance in [1e-4, 1e-2, 0.3] {
                let mut give = Vec3::<f64>::ZERO;
                let along = Vec3::new(1.0, 0.0, 0.0);
                for _ in 0..200_000 {
                    give = give + Vec3::new(slip[0], slip[1], 0.0) * distance;
                    let most = [limit / 2e5, 1.0];
                    give = brush.relaxed(give, along, distance, most).give;
                }
                let off = Vec3::new(a * force, b * force, 0.0) - give * 2e5;
                assert!(off.dot(off).sqrt() < 2e-5 * limit, "{slip:?} {distance}: {off:?}");
            }
        }
    }

    /// Without rolling, a deflection within the limit stays, to the last bit; beyond it is limited.
    #[test]
    fn a_standing_wheel_holds_its_deflection() {
        let brush = Brush { slip: [8e4_f32, 5e4], stiffness: 2e5 };
        let (along, give) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(3e-3, 4e-3, 0.0));
        let relaxed = brush.relaxed(give, along, 0.0, [4e-3, 1.0]);
        let size = relaxed.give.dot(relaxed.give).sqrt();
        assert!(relaxed.slides && (size - 4e-3).abs() < 1e-9, "{size}");
        let relaxed = brush.relaxed(give, along, 0.0, [6e-3, 1.0]);
        assert!(!relaxed.slides);
        let off = relaxed.give - give;
        assert!(off.dot(off).sqrt() < 1e-9, "{off:?}");
    }

    /// Rolling takes energy only, also at no load.
    #[test]
    fn rolling_never_extends_a_deflection() {
        let brush = Brush { slip: [8e4, 5e4], stiffness: 2e5 };
        let along = Vec3::new(1.0, 0.0, 0.0);
        for row in 0..2_000 {
            let of = |times: u32| f64::from(row * times % 1_009) / 1_009.0;
            let give = Vec3::new(of(7) - 0.5, of(13) - 0.5, 0.0) * 0.02;
            let (limit, rolled) = (of(29) * 0.01, of(31) * of(31));
            let relaxed = brush.relaxed(give, along, rolled, [limit, 1.0]);
            let (before, after) = (give.dot(give), relaxed.give.dot(relaxed.give));
            assert!(after <= before * (1.0 + 1e-12), "{give:?} {limit} {rolled}");
            assert!(after.sqrt() <= limit * (1.0 + 1e-12), "{give:?} {limit} {rolled}");
        }
    }
}
