//! Translational spring-damper (TSDA; Shabana 2010; Franco & Degani 2026, section 2.4).
//!
//! `(d, v_rel) => force on A`, with `d = x_b − x_a` and `v_rel` the rate of `d`:
//! tension `k·(L − L0) + c·(d·v_rel)/L` along `d/L`; the force on B is the opposite.
//! Energy `½·k·(L − L0)²`; a clearance changes `L − L0` and c, see [`crate::elements::clearance`].
//! Where the points coincide the direction is undefined and the force 0: below a distance of 1e-18 m (in double
//! precision 1e-100 m) it falls to 0 with the distance; above it is unchanged.

use crate::elements::clearance::{beyond, engaged};
use crate::elements::point_law::{Deformation, PointLaw, Turning, geometric_stiffness};
use crate::elongation::{AtRest, Elongation};
use crate::real::{Constant, Real};
use crate::space::{Linear, Vector};

/// \[m²\] Lower limit added to squared lengths, which avoids a test for 0. It changes no bit of a square that is 2^54
/// (f32: 2^25) times as large, and is the smallest that keeps forces of 1e20 N finite.
const LEAST_SQUARE: Constant = Constant { double: 1e-200, single: 1e-36 };

/// The length of `d` \[m\].
#[inline(always)]
fn length<V: Linear>(d: V) -> V::Real {
    (d.dot(d) + V::Real::constant(LEAST_SQUARE)).sqrt()
}

/// The constants of a TSDA with a free length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Tsda<R> {
    /// \[N/m\] axial stiffness, ≥ 0.
    pub stiffness: R,
    /// \[m\] free length L0, > 0.
    pub free_length: R,
}

impl<R: Real> Tsda<R> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(stiffness: f64, free_length: f64) -> Self {
        Self { stiffness: R::from_f64(stiffness), free_length: R::from_f64(free_length) }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Real>(&self) -> Tsda<Q> {
        Tsda::from_f64(self.stiffness.to_f64(), self.free_length.to_f64())
    }

    /// Force on A \[N\] without damping, beyond a clearance \[m\] if there is one.
    #[inline(always)]
    pub fn force<V: Linear<Real = R>>(&self, d: V, clearance: Option<R>) -> V {
        self.pull(&Elongation { way: d, more: None }, clearance)
    }

    /// [`Self::force`] for a given displacement with its length data.
    #[inline(always)]
    pub(crate) fn pull<V: Linear<Real = R>>(
        &self,
        elongation: &Elongation<V>,
        clearance: Option<R>,
    ) -> V {
        let d = elongation.way;
        let length = length(d);
        let inverse = R::ONE / length;
        let tension = self.stiffness * beyond(self.extended(length, elongation), clearance);
        d * (tension * inverse)
    }

    /// Several lengths \[m\].
    #[inline(always)]
    fn lengths<V: Linear<Real = R>, const N: usize>(reaches: &[Elongation<V>; N]) -> [R; N] {
        let mut squares = [R::ZERO; N];
        for (square, Elongation { way, .. }) in squares.iter_mut().zip(reaches) {
            *square = way.dot(*way) + R::constant(LEAST_SQUARE);
        }
        // A planar joint has little else to compute meanwhile.
        if V::DIMENSION == 2 { R::roots_apart(squares) } else { R::roots(squares) }
    }

    /// [`Self::pull`] for several springs without clearance.
    #[inline(always)]
    pub(crate) fn pulls<V: Linear<Real = R>, const N: usize>(
        springs: &[Self; N],
        reaches: &[Elongation<V>; N],
    ) -> [V; N] {
        let lengths = Self::lengths(reaches);
        let mut pulls = [V::ZERO; N];
        for i in 0..N {
            // One division in either case.
            let (beyond, divisor) = match reaches[i].more {
                None => (lengths[i] - springs[i].free_length, lengths[i]),
                Some(more) => (more, lengths[i] * (lengths[i] + springs[i].free_length)),
            };
            pulls[i] = reaches[i].way * (springs[i].stiffness * beyond * (R::ONE / divisor));
        }
        pulls
    }

    /// The force of the springs of a triple on its centre, without clearance. The centre is `off` \[m\] from its
    /// reference position, less than a quarter of any reference displacement; `square` \[m²\] is `off·off`. With w a
    /// reference displacement and o the offset, the squared length of w − o differs from that of w by o·o − 2·o·w, and
    /// so does its difference to the squared free length: the result has the precision of o.
    #[inline(always)]
    pub(crate) fn pull_near_rest<V: Linear<Real = R>, const N: usize>(
        springs: &[Self; N],
        rests: &[AtRest<V>; N],
        (off, square): (V, R),
    ) -> V {
        let twice = off + off;
        let (mut squares, mut mores) = ([R::ZERO; N], [R::ZERO; N]);
        for ((length, more), rest) in squares.iter_mut().zip(&mut mores).zip(rests) {
            let change = square - twice.dot(rest.way);
            (*length, *more) = (rest.square + change, rest.more + change);
        }
        let lengths = R::roots(squares);
        // Starts with the first term.
        let (mut pull, mut sum) = (V::ZERO, R::ZERO);
        for i in 0..N {
            // (L − L0)/L = (L² − L0²)/(L² + L·L0).
            let of_way = springs[i].stiffness * mores[i]
                / (squares[i] + lengths[i] * springs[i].free_length);
            let along = rests[i].way * of_way;
            (pull, sum) = if i == 0 { (along, of_way) } else { (pull + along, sum + of_way) };
        }
        pull - off * sum
    }

    /// \[m\] the length minus the free length.
    #[inline(always)]
    fn extended<V: Linear<Real = R>>(&self, length: R, elongation: &Elongation<V>) -> R {
        match elongation.more {
            None => length - self.free_length,
            // L² − L0² = (L − L0)·(L + L0).
            Some(more) => more * (R::ONE / (length + self.free_length)),
        }
    }

    /// [`Self::damped_pull`] for several springs without clearance.
    #[inline(always)]
    pub(crate) fn damped_pulls<V: Linear<Real = R>, const N: usize>(
        springs: &[Self; N],
        dampings: &[R; N],
        reaches: &[Elongation<V>; N],
        rates: &[V; N],
    ) -> [V; N] {
        let lengths = Self::lengths(reaches);
        let mut pulls = [V::ZERO; N];
        for i in 0..N {
            let (d, inverse) = (reaches[i].way, R::ONE / lengths[i]);
            let tension = springs[i].stiffness * springs[i].extended(lengths[i], &reaches[i])
                + dampings[i] * (d.dot(rates[i]) * inverse);
            pulls[i] = d * (tension * inverse);
        }
        pulls
    }

    /// Force on A \[N\] including the damper, `damping` in N·s/m.
    #[inline(always)]
    pub fn damped_force<V: Linear<Real = R>>(
        &self,
        damping: R,
        d: V,
        v_rel: V,
        clearance: Option<R>,
    ) -> V {
        self.damped_pull(damping, &Elongation { way: d, more: None }, v_rel, clearance)
    }

    /// [`Self::damped_force`] for a given displacement with its length data.
    #[inline(always)]
    pub(crate) fn damped_pull<V: Linear<Real = R>>(
        &self,
        damping: R,
        elongation: &Elongation<V>,
        v_rel: V,
        clearance: Option<R>,
    ) -> V {
        let d = elongation.way;
        let length = length(d);
        let inverse = R::ONE / length;
        let extension = self.extended(length, elongation);
        let damping = engaged(damping, extension, clearance);
        let tension =
            self.stiffness * beyond(extension, clearance) + damping * (d.dot(v_rel) * inverse);
        d * (tension * inverse)
    }
}

impl<V: Vector> PointLaw<V> for Tsda<V::Real> {
    /// `L − L0` \[m\].
    #[inline(always)]
    fn extension(&self, deformation: &Deformation<V>) -> V::Real {
        let d = deformation.displacement;
        d.dot(d).sqrt() - self.free_length
    }

    #[inline]
    fn energy(&self, deformation: &Deformation<V>, clearance: Option<V::Real>) -> V::Real {
        let extension = beyond(self.extension(deformation), clearance);
        V::Real::HALF * self.stiffness * extension * extension
    }

    /// Along its line.
    #[inline(always)]
    fn damped(deformation: &Deformation<V>) -> ([V; 3], usize) {
        let d = deformation.displacement;
        let along = d * d.dot(d).sqrt().reciprocal_or_zero();
        ([along, V::ZERO, V::ZERO], 1)
    }

    /// k along its line, and its geometric stiffness; a clearance counts as closed.
    fn tangent(
        &self,
        deformation: &Deformation<V>,
        _: V,
        add: &mut impl FnMut(V::Real, V),
    ) -> Turning<V> {
        let d = deformation.displacement;
        add(self.stiffness, d * d.dot(d).sqrt().reciprocal_or_zero());
        geometric_stiffness(self.stiffness * self.extension(deformation), d, add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    const SPRING: Tsda<f64> = Tsda { stiffness: 250.0, free_length: 0.5 };

    #[test]
    fn a_stretched_spring_pulls_a_towards_b() {
        let f = SPRING.force(Vec3::new(0.0, 0.7, 0.0), None);
        assert!(f.x == 0.0 && f.z == 0.0);
        assert!((f.y - 250.0 * 0.2).abs() < 1e-12);
    }

    #[test]
    fn the_force_is_minus_the_gradient_of_the_energy() {
        let d = Vec3::new(0.3, -0.4, 0.25);
        let f = SPRING.force(d, None).to_f64();
        for (axis, force) in f.into_iter().enumerate() {
            let at = |s: f64| {
                let mut p = d.to_f64();
                p[axis] += s;
                SPRING.energy(&Deformation::of(Vec3::from_f64(p)), None)
            };
            // The force on A is +dU/dd, since d grows when A moves against it.
            let gradient = (at(1e-6) - at(-1e-6)) / 2e-6;
            assert!((gradient - force).abs() < 1e-6, "{gradient} {force}");
        }
    }

    #[test]
    fn a_separating_pair_is_damped_along_the_line_only() {
        let d = Vec3::new(0.5, 0.0, 0.0);
        let f = SPRING.damped_force(3.0, d, Vec3::new(2.0, 5.0, 0.0), None);
        assert_eq!((f.x, f.y, f.z), (6.0, 0.0, 0.0));
    }

    #[test]
    fn within_its_clearance_neither_spring_nor_damper_acts() {
        let rate = Vec3::new(0.0, 2.0, 0.0);
        let at = |length: f64| {
            let d = Vec3::new(0.0, length, 0.0);
            let clearance = Some(0.01);
            let energy = SPRING.energy(&Deformation::of(d), clearance);
            (SPRING.damped_force(3.0, d, rate, clearance).y, energy)
        };
        assert_eq!(at(0.505), (0.0, 0.0));
        assert_eq!(at(0.495), (0.0, 0.0));
        // Half a clearance beyond the edge half of the damper acts, from a whole clearance on all of it.
        assert!((at(0.515).0 - (250.0 * 0.005 + 3.0)).abs() < 1e-9);
        let (force, energy) = at(0.52);
        assert!((force - (250.0 * 0.01 + 6.0)).abs() < 1e-9);
        assert!((energy - 0.5 * 250.0 * 1e-4).abs() < 1e-12);
    }

    #[test]
    fn coincident_points_give_no_force() {
        assert_eq!(SPRING.force(Vec3::ZERO, None), Vec3::ZERO);
        let rate = Vec3::new(1.0, 0.0, 0.0);
        assert_eq!(SPRING.damped_force(1.0, Vec3::ZERO, rate, None), Vec3::ZERO);
    }
}
