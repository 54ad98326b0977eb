//! TSDAs between points of A, the centres of stars, and points of B that they share.
//!
//! `(points, ends) => record`. Counts are known to the compiler: nothing is left of loops and lists.

use crate::elements::tsda::Tsda;
use crate::forces::record::Record;
use crate::geometry::{Geometry, Reach};
use crate::pose::{End, Spot};
use crate::real::Real;
use crate::space::{Linear, Space as _};

/// The sum in ascending order. From the first term on: a start from 0 would cost an addition, and
/// what records are added to is never −0, so that the sign of a zero is no matter.
#[inline(always)]
fn sum<V: Linear>(terms: &[V]) -> V {
    let Some((&first, others)) = terms.split_first() else { return V::ZERO };
    others.iter().fold(first, |sum, &term| sum + term)
}

/// What pulls at the points of a block.
pub(super) struct Springs<'m, R, const STARS: usize, const ARMS: usize> {
    pub(super) springs: &'m [[Tsda<R>; ARMS]; STARS],
    pub(super) dampers: Option<&'m [[R; ARMS]; STARS]>,
    pub(super) clearance: Option<R>,
}

impl<R: Real, const STARS: usize, const ARMS: usize> Springs<'_, R, STARS, ARMS> {
    /// What they pull between two ends: written out, each sum from its first term.
    #[inline(always)]
    pub(super) fn record<P: Geometry<Real = R>>(
        &self,
        centres: &[P::Local; STARS],
        tips: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> Record<P::Space> {
        let mut spots = [(P::Location::default(), P::Vector::ZERO); STARS];
        for (spot, centre) in spots.iter_mut().zip(centres) {
            *spot = end_a.place(centre);
        }
        let (pulls_a, torque_b) = if STARS == 1 && P::Space::PLANAR {
            self.all_arms(&spots, tips, end_a, end_b)
        } else {
            // A point of B at a time, for all stars: what it takes is in registers, and forgotten with it.
            let (mut pulls_a, mut torque_b) = self.arm(0, &tips[0], &spots, end_a, end_b);
            for (arm, tip) in tips.iter().enumerate().skip(1) {
                let (pulls, torque) = self.arm(arm, tip, &spots, end_a, end_b);
                for (pull_a, pull) in pulls_a.iter_mut().zip(pulls) {
                    *pull_a = *pull_a + pull;
                }
                torque_b = torque_b + torque;
            }
            (pulls_a, torque_b)
        };
        let mut torques_a = [P::Moment::ZERO; STARS];
        for (torque, (pull, (_, arm))) in torques_a.iter_mut().zip(pulls_a.iter().zip(&spots)) {
            *torque = end_a.moment(*arm, *pull);
        }
        Record { force: sum(&pulls_a), torque_a: sum(&torques_a), torque_b }
    }

    /// The pulls of all stars at a point of B, and the torque on it.
    #[inline(always)]
    fn arm<P: Geometry<Real = R>>(
        &self,
        arm: usize,
        tip: &P::Local,
        spots: &[Spot<P>; STARS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; STARS], P::Moment) {
        let (tip, tip_arm) = end_b.place(tip);
        let mut reaches = [Reach::default(); STARS];
        let (mut at, mut rates) = ([(0, arm); STARS], [P::Vector::ZERO; STARS]);
        for (star, (centre, _)) in spots.iter().enumerate() {
            reaches[star] = P::reach(centre, &tip, self.springs[star][arm].free_length);
            at[star].0 = star;
        }
        if self.dampers.is_some() {
            let velocity = end_b.point_velocity(tip_arm);
            for (rate, (_, arm_a)) in rates.iter_mut().zip(spots) {
                *rate = velocity - end_a.point_velocity(*arm_a);
            }
        }
        let pulls = self.pulls(at, &reaches, &rates);
        (pulls, end_b.moment(tip_arm, sum(&pulls)))
    }

    /// The same at all points of B: in the plane they are few enough for the registers to hold.
    #[inline(always)]
    fn all_arms<P: Geometry<Real = R>>(
        &self,
        spots: &[Spot<P>; STARS],
        tips: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; STARS], P::Moment) {
        let (mut at, mut arms) = ([(0, 0); ARMS], [P::Vector::ZERO; ARMS]);
        let (mut reaches, mut rates) = ([Reach::default(); ARMS], arms);
        for (arm, tip) in tips.iter().enumerate() {
            let (tip, tip_arm) = end_b.place(tip);
            (at[arm].1, arms[arm]) = (arm, tip_arm);
            reaches[arm] = P::reach(&spots[0].0, &tip, self.springs[0][arm].free_length);
            if self.dampers.is_some() {
                rates[arm] = end_b.point_velocity(tip_arm) - end_a.point_velocity(spots[0].1);
            }
        }
        let pulls = self.pulls(at, &reaches, &rates);
        let mut torques = [P::Moment::ZERO; ARMS];
        for (torque, (arm, pull)) in torques.iter_mut().zip(arms.iter().zip(pulls)) {
            *torque = end_b.moment(*arm, pull);
        }
        ([sum(&pulls); STARS], sum(&torques))
    }

    /// The pulls of springs, each a star's at a point of B, at their reaches and, where dampers act,
    /// rates.
    #[inline(always)]
    fn pulls<V: Linear<Real = R>, const N: usize>(
        &self,
        at: [(usize, usize); N],
        reaches: &[Reach<V>; N],
        rates: &[V; N],
    ) -> [V; N] {
        let mut springs = [Tsda::default(); N];
        for (spring, (star, arm)) in springs.iter_mut().zip(at) {
            *spring = self.springs[star][arm];
        }
        let mut pulls = [V::ZERO; N];
        match (self.dampers, self.clearance) {
            (None, None) => pulls = Tsda::pulls(&springs, reaches),
            (None, clearance) => {
                for (i, pull) in pulls.iter_mut().enumerate() {
                    *pull = springs[i].pull(&reaches[i], clearance);
                }
            }
            (Some(dampers), None) => {
                let mut dampings = [R::ZERO; N];
                for (damping, (star, arm)) in dampings.iter_mut().zip(at) {
                    *damping = dampers[star][arm];
                }
                pulls = Tsda::damped_pulls(&springs, &dampings, reaches, rates);
            }
            (Some(dampers), clearance) => {
                for (i, (pull, (star, arm))) in pulls.iter_mut().zip(at).enumerate() {
                    let damping = dampers[star][arm];
                    *pull = springs[i].damped_pull(damping, &reaches[i], rates[i], clearance);
                }
            }
        }
        pulls
    }
}
