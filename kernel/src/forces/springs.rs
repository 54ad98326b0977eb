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

/// What a block has at an arm of a star: as counts are known to the compiler, none is looked for.
#[inline(always)]
fn at<T: Copy + Default, const STARS: usize, const ARMS: usize>(
    block: &[[T; ARMS]; STARS],
    (star, arm): (usize, usize),
) -> T {
    block.get(star).and_then(|arms| arms.get(arm)).copied().unwrap_or_default()
}

/// What pulls at the points of a block.
pub(super) struct Springs<'m, P: Geometry, const STARS: usize, const ARMS: usize> {
    pub(super) springs: &'m [[Tsda<P::Real>; ARMS]; STARS],
    pub(super) rests: Option<&'m [[P::Rest; ARMS]; STARS]>,
    pub(super) dampers: Option<&'m [[P::Real; ARMS]; STARS]>,
    pub(super) clearance: Option<P::Real>,
}

impl<P: Geometry, const STARS: usize, const ARMS: usize> Springs<'_, P, STARS, ARMS> {
    /// What they pull between two ends: written out, each sum from its first term.
    #[inline(always)]
    pub(super) fn record(
        &self,
        centres: &[P::Local; STARS],
        tips: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> Record<P::Space> {
        if let Some(rests) = self.rests {
            return self.beside_rest(rests, centres, &tips[0], end_a, end_b);
        }
        let mut spots = [(P::Location::default(), P::Vector::ZERO); STARS];
        for (spot, centre) in spots.iter_mut().zip(centres) {
            *spot = end_a.place(centre);
        }
        let (pulls_a, torque_b) = if STARS == 1 && P::Space::PLANAR {
            self.all_arms(&spots, tips, end_a, end_b)
        } else {
            // A point of B at a time, for all stars: what it takes is in registers, and forgotten with it.
            let (mut pulls_a, mut torque_b) = self.arm(0, &tips[0], &spots, end_a, end_b);
            for arm in 1..ARMS {
                let Some(tip) = tips.get(arm) else { break };
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

    /// [`Self::record`] by how far the stars' centres are from where they rest in B. What pulls along a line
    /// that leads to the centre turns B as if it pulled there.
    #[inline(always)]
    fn beside_rest(
        &self,
        rests: &[[P::Rest; ARMS]; STARS],
        centres: &[P::Local; STARS],
        tip: &P::Local,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> Record<P::Space> {
        let (mut forces, mut torques_a) = ([P::Vector::ZERO; STARS], [P::Moment::ZERO; STARS]);
        let mut torques_b = torques_a;
        let rows = forces.iter_mut().zip(torques_a.iter_mut().zip(&mut torques_b));
        let rows = rows.zip(centres.iter().zip(rests));
        for (star, ((force, (torque_a, torque_b)), (centre, rests))) in rows.enumerate() {
            let Some(first) = rests.first() else { continue };
            let (centre, arm_a) = end_a.place(centre);
            let (rest, arm_b) = end_b.place(&P::centre(tip, first));
            let off = P::displacement(&rest, &centre);
            let arm_b = arm_b + off;
            let (off, mut each) = (end_b.to_axes(off), [(star, 0); ARMS]);
            let (mut reaches, mut rates) = ([Reach::default(); ARMS], [P::Vector::ZERO; ARMS]);
            let rows = reaches.iter_mut().zip(&mut each).zip(rests);
            for (arm, ((reach, each), rest)) in rows.enumerate() {
                *reach = P::reach_at_rest(rest, off);
                each.1 = arm;
            }
            if self.dampers.is_some() {
                let rate = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                rates = [end_b.to_axes(rate); ARMS];
            }
            *force = end_b.to_world(sum(&self.pulls(each, &reaches, &rates)));
            *torque_a = end_a.moment(arm_a, *force);
            *torque_b = end_b.moment(arm_b, *force);
        }
        Record { force: sum(&forces), torque_a: sum(&torques_a), torque_b: sum(&torques_b) }
    }

    /// The pulls of all stars at a point of B, and the torque on it.
    #[inline(always)]
    fn arm(
        &self,
        arm: usize,
        tip: &P::Local,
        spots: &[Spot<P>; STARS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; STARS], P::Moment) {
        let (tip, tip_arm) = end_b.place(tip);
        let mut reaches = [Reach::default(); STARS];
        let (mut each, mut rates) = ([(0, arm); STARS], [P::Vector::ZERO; STARS]);
        let rows = reaches.iter_mut().zip(&mut each).zip(spots);
        for (star, ((reach, each), (centre, _))) in rows.enumerate() {
            each.0 = star;
            *reach = P::reach(centre, &tip, at(self.springs, *each).free_length);
        }
        if self.dampers.is_some() {
            let velocity = end_b.point_velocity(tip_arm);
            for (rate, (_, arm_a)) in rates.iter_mut().zip(spots) {
                *rate = velocity - end_a.point_velocity(*arm_a);
            }
        }
        let pulls = self.pulls(each, &reaches, &rates);
        (pulls, end_b.moment(tip_arm, sum(&pulls)))
    }

    /// The same at all points of B: in the plane they are few enough for the registers to hold.
    #[inline(always)]
    fn all_arms(
        &self,
        spots: &[Spot<P>; STARS],
        tips: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; STARS], P::Moment) {
        let (mut each, mut arms) = ([(0, 0); ARMS], [P::Vector::ZERO; ARMS]);
        let (mut reaches, mut rates) = ([Reach::default(); ARMS], arms);
        let rows = reaches.iter_mut().zip(&mut rates).zip(each.iter_mut().zip(&mut arms));
        for (arm, (((reach, rate), (each, arm_b)), tip)) in rows.zip(tips).enumerate() {
            let (tip, tip_arm) = end_b.place(tip);
            (each.1, *arm_b) = (arm, tip_arm);
            *reach = P::reach(&spots[0].0, &tip, at(self.springs, *each).free_length);
            if self.dampers.is_some() {
                *rate = end_b.point_velocity(tip_arm) - end_a.point_velocity(spots[0].1);
            }
        }
        let pulls = self.pulls(each, &reaches, &rates);
        let mut torques = [P::Moment::ZERO; ARMS];
        for (torque, (arm, pull)) in torques.iter_mut().zip(arms.iter().zip(pulls)) {
            *torque = end_b.moment(*arm, pull);
        }
        ([sum(&pulls); STARS], sum(&torques))
    }

    /// The pulls of springs, each a star's at a point of B, at their reaches and, where dampers act,
    /// rates.
    #[inline(always)]
    fn pulls<const N: usize>(
        &self,
        each: [(usize, usize); N],
        reaches: &[Reach<P::Vector>; N],
        rates: &[P::Vector; N],
    ) -> [P::Vector; N] {
        let mut springs = [Tsda::default(); N];
        for (spring, place) in springs.iter_mut().zip(each) {
            *spring = at(self.springs, place);
        }
        let mut pulls = [P::Vector::ZERO; N];
        match (self.dampers, self.clearance) {
            (None, None) => pulls = Tsda::pulls(&springs, reaches),
            (None, clearance) => {
                for (pull, (spring, reach)) in pulls.iter_mut().zip(springs.iter().zip(reaches)) {
                    *pull = spring.pull(reach, clearance);
                }
            }
            (Some(dampers), None) => {
                let mut dampings = [P::Real::ZERO; N];
                for (damping, place) in dampings.iter_mut().zip(each) {
                    *damping = at(dampers, place);
                }
                pulls = Tsda::damped_pulls(&springs, &dampings, reaches, rates);
            }
            (Some(dampers), clearance) => {
                let rows = springs.iter().zip(reaches.iter().zip(rates)).zip(each);
                for (pull, ((spring, (reach, rate)), place)) in pulls.iter_mut().zip(rows) {
                    *pull = spring.damped_pull(at(dampers, place), reach, *rate, clearance);
                }
            }
        }
        pulls
    }
}
