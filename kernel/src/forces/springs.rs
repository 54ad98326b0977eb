//! TSDAs between points of A, the centres of spring triples, and common points of B.
//!
//! `(points, ends) => record`. Counts are compile-time constants: loops and lists are eliminated.

use crate::elements::tsda::Tsda;
use crate::forces::record::Record;
use crate::geometry::Geometry;
use crate::pose::{End, Spot};
use crate::reach::{AtRest, Beside, Beyond, Reach};
use crate::real::Real;
use crate::space::{Linear, Space as _, Vector as _};

/// The sum in ascending order, starting with the first term: a start from 0 would cost an addition, and what records
/// are added to is never −0, so the sign of a zero does not matter.
#[inline(always)]
fn sum<V: Linear>(terms: &[V]) -> V {
    let Some((&first, others)) = terms.split_first() else { return V::ZERO };
    others.iter().fold(first, |sum, &term| sum + term)
}

/// The entry of a block for a leg of a triple: with constant counts there is no search.
#[inline(always)]
fn at<T: Copy + Default, const STARS: usize, const ARMS: usize>(
    block: &[[T; ARMS]; STARS],
    (star, arm): (usize, usize),
) -> T {
    block.get(star).and_then(|arms| arms.get(arm)).copied().unwrap_or_default()
}

/// The springs at the points of a block.
pub(super) struct Springs<'m, P: Geometry, const STARS: usize, const ARMS: usize> {
    pub(super) springs: &'m [[Tsda<P::Real>; ARMS]; STARS],
    pub(super) rests: Option<&'m [[P::Rest; ARMS]; STARS]>,
    pub(super) dampers: Option<&'m [[P::Real; ARMS]; STARS]>,
    pub(super) clearance: Option<P::Real>,
}

impl<P: Geometry, const ARMS: usize> Springs<'_, P, 1, ARMS> {
    /// Adds the forces of one triple's springs to a record of the triples before it.
    #[inline(always)]
    pub(super) fn add(
        &self,
        centre: &P::Local,
        tips: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
        record: &mut Record<P::Space>,
    ) {
        let spot = [end_a.place(centre)];
        let mut pull_a = P::Vector::ZERO;
        for (arm, tip) in tips.iter().enumerate() {
            let ([pull], torque) = self.arm(arm, tip, &spot, end_a, end_b);
            pull_a = pull_a + pull;
            record.torque_b = record.torque_b + torque;
        }
        record.force = record.force + pull_a;
        record.torque_a = record.torque_a + end_a.moment(spot[0].1, pull_a);
    }
}

impl<P: Geometry, const STARS: usize, const ARMS: usize> Springs<'_, P, STARS, ARMS> {
    /// Their record between two ends: unrolled, each sum starting with its first term.
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
            // One point of B at a time, for all triples: its data stay in registers.
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

    /// [`Self::record`] from the offsets of the triples' centres from their reference positions in B. A force along a
    /// line through the centre has the same torque on B as if it acted there.
    #[inline(always)]
    fn beside_rest(
        &self,
        rests: &[[P::Rest; ARMS]; STARS],
        centres: &[P::Local; STARS],
        tip: &P::Local,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> Record<P::Space> {
        let (Some(apart), Some(b)) = (end_a.apart(end_b), end_b.frame()) else {
            return Record::ZERO;
        };
        let a = end_a.frame();
        let (Some(centre), Some(of_first)) = (centres.first(), rests.first()) else {
            return Record::ZERO;
        };
        let Beside { off, arm_a, arm_b } = P::beside(&apart, (a, centre), (b, tip), of_first);
        let off = end_b.to_axes(off);
        let pull = self.star((0, of_first), off, [(end_a, arm_a), (end_b, arm_b)]);
        let (Some(other), Some(of_other)) = (centres.get(1), rests.get(1)) else {
            let force = end_b.to_world(pull);
            let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
            return Record { force, torque_a, torque_b };
        };
        // The second triple's position relative to the first is the same in both bodies up to their deflection.
        let Beyond { off: by, way } =
            P::beyond((a, [centre, other]), (b, tip), [of_first, of_other]);
        let off = off + end_b.to_axes(by);
        let ends = [(end_a, arm_a + way), (end_b, arm_b + way)];
        let other = self.star((1, of_other), off, ends);
        let (force, other) = (end_b.to_world(pull + other), end_b.to_world(other));
        let turned = way.cross(other);
        Record {
            force,
            torque_a: if a.is_some() { arm_a.cross(force) + turned } else { P::Moment::ZERO },
            torque_b: arm_b.cross(force) + turned,
        }
    }

    /// The force of a triple on its centre with the offset `off` from its reference position; in the axes of B.
    #[inline(always)]
    fn star(
        &self,
        (star, rests): (usize, &[P::Rest; ARMS]),
        off: P::Vector,
        ends: [(&End<'_, P>, P::Vector); 2],
    ) -> P::Vector {
        if self.dampers.is_some() || self.clearance.is_some() {
            self.star_of_any(star, rests, off, ends)
        } else {
            self.star_of_springs(star, rests, off)
        }
    }

    /// A triple of springs without dampers or clearance.
    #[inline(always)]
    fn star_of_springs(&self, star: usize, rests: &[P::Rest; ARMS], off: P::Vector) -> P::Vector {
        let mut at_rest = [AtRest::default(); ARMS];
        for (at, rest) in at_rest.iter_mut().zip(rests) {
            *at = P::at_rest(rest);
        }
        let near = rests.first().map_or(P::Real::ZERO, P::near_rest);
        let square = off.dot(off);
        match self.springs.get(star) {
            Some(springs) if square < near => {
                Tsda::pull_near_rest(springs, &at_rest, (off, square))
            }
            Some(springs) => Self::star_far_off(springs, rests, off),
            None => P::Vector::ZERO,
        }
    }

    /// The same far from the reference. Not inlined: the near case, which is nearly always taken, keeps its registers.
    #[cold]
    #[inline(never)]
    fn star_far_off(
        springs: &[Tsda<P::Real>; ARMS],
        rests: &[P::Rest; ARMS],
        off: P::Vector,
    ) -> P::Vector {
        let mut reaches = [Reach::default(); ARMS];
        for (reach, rest) in reaches.iter_mut().zip(rests) {
            *reach = P::at_rest(rest).reach(off);
        }
        sum(&Tsda::pulls(springs, &reaches))
    }

    /// The same with dampers or a clearance; its lever arms in world axes.
    #[inline(always)]
    fn star_of_any(
        &self,
        star: usize,
        rests: &[P::Rest; ARMS],
        off: P::Vector,
        [(end_a, arm_a), (end_b, arm_b)]: [(&End<'_, P>, P::Vector); 2],
    ) -> P::Vector {
        let mut each = [(star, 0); ARMS];
        let (mut reaches, mut rates) = ([Reach::default(); ARMS], [P::Vector::ZERO; ARMS]);
        for (arm, ((reach, each), rest)) in reaches.iter_mut().zip(&mut each).zip(rests).enumerate()
        {
            *reach = P::at_rest(rest).reach(off);
            each.1 = arm;
        }
        if self.dampers.is_some() {
            let rate = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            rates = [end_b.to_axes(rate); ARMS];
        }
        sum(&self.pulls(each, &reaches, &rates))
    }

    /// The forces of all triples at a point of B, and the torque on it.
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

    /// The same at all points of B: in the plane they fit into registers.
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

    /// The forces of springs, one per triple at a point of B, from their displacements and, where dampers act, rates.
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
