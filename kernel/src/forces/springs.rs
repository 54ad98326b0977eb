//! TSDAs between points of A, the centres of spring triples, and common points of B.
//!
//! `(points, ends) => force_pair`. Counts are compile-time constants: loops and lists are eliminated.

use core::marker::PhantomData;

use crate::elements::tsda::Tsda;
use crate::elongation::{AtRest, Beside, Beyond, Elongation};
use crate::forces::force_pair::{Dampers, ForcePair};
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::pose::{End, Spot};
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
fn at<T: Copy + Default, const TRIPLES: usize, const ARMS: usize>(
    block: &[[T; ARMS]; TRIPLES],
    (triple, arm): (usize, usize),
) -> T {
    block.get(triple).and_then(|arms| arms.get(arm)).copied().unwrap_or_default()
}

/// The springs at the points of a block.
pub(super) struct Springs<'m, P: Geometry, T, D, const TRIPLES: usize, const ARMS: usize> {
    pub(super) springs: &'m [[Tsda<P::Real>; ARMS]; TRIPLES],
    pub(super) rests: Option<&'m [[P::Rest; ARMS]; TRIPLES]>,
    pub(super) dampers: Option<&'m [[P::Real; ARMS]; TRIPLES]>,
    pub(super) clearance: Option<P::Real>,
    /// What the model's groups may have, and whether dampers act: code of others is not compiled.
    pub(super) kinds: PhantomData<(T, D)>,
}

impl<P: Geometry, T: Terms<P>, D: Dampers, const ARMS: usize> Springs<'_, P, T, D, 1, ARMS> {
    /// Adds the forces of one triple's springs to a record of the triples before it.
    #[inline(always)]
    pub(super) fn add(
        &self,
        centre: &P::Local,
        endpoints: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
        force_pair: &mut ForcePair<P::Space>,
    ) {
        let spot = [end_a.place(centre)];
        let mut pull_a = P::Vector::ZERO;
        for (arm, endpoint) in endpoints.iter().enumerate() {
            let ([pull], torque) = self.arm(arm, endpoint, &spot, end_a, end_b);
            pull_a = pull_a + pull;
            force_pair.torque_b = force_pair.torque_b + torque;
        }
        force_pair.force = force_pair.force + pull_a;
        force_pair.torque_a = force_pair.torque_a + end_a.moment(spot[0].1, pull_a);
    }
}

impl<P: Geometry, T: Terms<P>, D: Dampers, const TRIPLES: usize, const ARMS: usize>
    Springs<'_, P, T, D, TRIPLES, ARMS>
{
    /// Whether its springs may have dampers that act.
    const DAMPED: bool = D::ACT && T::DAMPERS;

    /// Their record between two ends: unrolled, each sum starting with its first term.
    #[inline(always)]
    pub(super) fn force_pair(
        &self,
        centres: &[P::Local; TRIPLES],
        endpoints: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ForcePair<P::Space> {
        if P::RESTS
            && let Some(rests) = self.rests
        {
            return self.beside_rest(rests, centres, &endpoints[0], end_a, end_b);
        }
        let mut spots = [(P::Location::default(), P::Vector::ZERO); TRIPLES];
        for (spot, centre) in spots.iter_mut().zip(centres) {
            *spot = end_a.place(centre);
        }
        let (pulls_a, torque_b) = if TRIPLES == 1 && P::Space::PLANAR {
            self.all_arms(&spots, endpoints, end_a, end_b)
        } else {
            // One point of B at a time, for all triples: its data stay in registers.
            let (mut pulls_a, mut torque_b) = self.arm(0, &endpoints[0], &spots, end_a, end_b);
            for arm in 1..ARMS {
                let Some(endpoint) = endpoints.get(arm) else { break };
                let (pulls, torque) = self.arm(arm, endpoint, &spots, end_a, end_b);
                for (pull_a, pull) in pulls_a.iter_mut().zip(pulls) {
                    *pull_a = *pull_a + pull;
                }
                torque_b = torque_b + torque;
            }
            (pulls_a, torque_b)
        };
        let mut torques_a = [P::Moment::ZERO; TRIPLES];
        for (torque, (pull, (_, arm))) in torques_a.iter_mut().zip(pulls_a.iter().zip(&spots)) {
            *torque = end_a.moment(*arm, *pull);
        }
        ForcePair { force: sum(&pulls_a), torque_a: sum(&torques_a), torque_b }
    }

    /// [`Self::force_pair`] from the offsets of the triples' centres from their reference positions in B. A force along a
    /// line through the centre has the same torque on B as if it acted there.
    #[inline(always)]
    fn beside_rest(
        &self,
        rests: &[[P::Rest; ARMS]; TRIPLES],
        centres: &[P::Local; TRIPLES],
        endpoint: &P::Local,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ForcePair<P::Space> {
        let (Some(apart), Some(b)) = (end_a.apart(end_b), end_b.frame()) else {
            return ForcePair::ZERO;
        };
        let a = end_a.frame();
        let (Some(centre), Some(of_first)) = (centres.first(), rests.first()) else {
            return ForcePair::ZERO;
        };
        let Beside { off, arm_a, arm_b } = P::beside(&apart, (a, centre), (b, endpoint), of_first);
        let off = end_b.to_axes(off);
        let pull = self.triple((0, of_first), off, [(end_a, arm_a), (end_b, arm_b)]);
        let (Some(other), Some(of_other)) = (centres.get(1), rests.get(1)) else {
            let force = end_b.to_world(pull);
            let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
            return ForcePair { force, torque_a, torque_b };
        };
        // The second triple's position relative to the first is the same in both bodies up to their deflection.
        let Beyond { off: by, way } =
            P::beyond((a, [centre, other]), (b, endpoint), [of_first, of_other]);
        let off = off + end_b.to_axes(by);
        let ends = [(end_a, arm_a + way), (end_b, arm_b + way)];
        let other = self.triple((1, of_other), off, ends);
        let (force, other) = (end_b.to_world(pull + other), end_b.to_world(other));
        let turned = way.cross(other);
        ForcePair {
            force,
            torque_a: if a.is_some() { arm_a.cross(force) + turned } else { P::Moment::ZERO },
            torque_b: arm_b.cross(force) + turned,
        }
    }

    /// The force of a triple on its centre with the offset `off` from its reference position; in the axes of B.
    #[inline(always)]
    fn triple(
        &self,
        (triple, rests): (usize, &[P::Rest; ARMS]),
        off: P::Vector,
        ends: [(&End<'_, P>, P::Vector); 2],
    ) -> P::Vector {
        if Self::DAMPED && self.dampers.is_some() || T::CLEARANCES && self.clearance.is_some() {
            self.triple_of_any(triple, rests, off, ends)
        } else {
            self.triple_of_springs(triple, rests, off)
        }
    }

    /// A triple of springs without dampers or clearance.
    #[inline(always)]
    fn triple_of_springs(
        &self,
        triple: usize,
        rests: &[P::Rest; ARMS],
        off: P::Vector,
    ) -> P::Vector {
        let mut at_rest = [AtRest::default(); ARMS];
        for (at, rest) in at_rest.iter_mut().zip(rests) {
            *at = P::at_rest(rest);
        }
        let near = rests.first().map_or(P::Real::ZERO, P::near_rest);
        let square = off.dot(off);
        match self.springs.get(triple) {
            Some(springs) if square < near => {
                Tsda::pull_near_rest(springs, &at_rest, (off, square))
            }
            Some(springs) => Self::triple_far_off(springs, rests, off),
            None => P::Vector::ZERO,
        }
    }

    /// The same far from the reference. Not inlined: the near case, which is nearly always taken, keeps its registers.
    #[cold]
    #[inline(never)]
    fn triple_far_off(
        springs: &[Tsda<P::Real>; ARMS],
        rests: &[P::Rest; ARMS],
        off: P::Vector,
    ) -> P::Vector {
        let mut reaches = [Elongation::default(); ARMS];
        for (elongation, rest) in reaches.iter_mut().zip(rests) {
            *elongation = P::at_rest(rest).elongation(off);
        }
        sum(&Tsda::pulls(springs, &reaches))
    }

    /// The same with dampers or a clearance; its lever arms in world axes.
    #[inline(always)]
    fn triple_of_any(
        &self,
        triple: usize,
        rests: &[P::Rest; ARMS],
        off: P::Vector,
        [(end_a, arm_a), (end_b, arm_b)]: [(&End<'_, P>, P::Vector); 2],
    ) -> P::Vector {
        let mut each = [(triple, 0); ARMS];
        let (mut reaches, mut rates) = ([Elongation::default(); ARMS], [P::Vector::ZERO; ARMS]);
        for (arm, ((elongation, each), rest)) in
            reaches.iter_mut().zip(&mut each).zip(rests).enumerate()
        {
            *elongation = P::at_rest(rest).elongation(off);
            each.1 = arm;
        }
        if Self::DAMPED && self.dampers.is_some() {
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
        endpoint: &P::Local,
        spots: &[Spot<P>; TRIPLES],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; TRIPLES], P::Moment) {
        let (endpoint, endpoint_arm) = end_b.place(endpoint);
        let mut reaches = [Elongation::default(); TRIPLES];
        let (mut each, mut rates) = ([(0, arm); TRIPLES], [P::Vector::ZERO; TRIPLES]);
        let rows = reaches.iter_mut().zip(&mut each).zip(spots);
        for (triple, ((elongation, each), (centre, _))) in rows.enumerate() {
            each.0 = triple;
            *elongation = P::elongation(centre, &endpoint, at(self.springs, *each).free_length);
        }
        if Self::DAMPED && self.dampers.is_some() {
            let velocity = end_b.point_velocity(endpoint_arm);
            for (rate, (_, arm_a)) in rates.iter_mut().zip(spots) {
                *rate = velocity - end_a.point_velocity(*arm_a);
            }
        }
        let pulls = self.pulls(each, &reaches, &rates);
        (pulls, end_b.moment(endpoint_arm, sum(&pulls)))
    }

    /// The same at all points of B: in the plane they fit into registers.
    #[inline(always)]
    fn all_arms(
        &self,
        spots: &[Spot<P>; TRIPLES],
        endpoints: &[P::Local; ARMS],
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ([P::Vector; TRIPLES], P::Moment) {
        let (mut each, mut arms) = ([(0, 0); ARMS], [P::Vector::ZERO; ARMS]);
        let (mut reaches, mut rates) = ([Elongation::default(); ARMS], arms);
        let rows = reaches.iter_mut().zip(&mut rates).zip(each.iter_mut().zip(&mut arms));
        for (arm, (((elongation, rate), (each, arm_b)), endpoint)) in
            rows.zip(endpoints).enumerate()
        {
            let (endpoint, endpoint_arm) = end_b.place(endpoint);
            (each.1, *arm_b) = (arm, endpoint_arm);
            *elongation =
                P::elongation(&spots[0].0, &endpoint, at(self.springs, *each).free_length);
            if Self::DAMPED && self.dampers.is_some() {
                *rate = end_b.point_velocity(endpoint_arm) - end_a.point_velocity(spots[0].1);
            }
        }
        let pulls = self.pulls(each, &reaches, &rates);
        let mut torques = [P::Moment::ZERO; ARMS];
        for (torque, (arm, pull)) in torques.iter_mut().zip(arms.iter().zip(pulls)) {
            *torque = end_b.moment(*arm, pull);
        }
        ([sum(&pulls); TRIPLES], sum(&torques))
    }

    /// The forces of springs, one per triple at a point of B, from their displacements and, where dampers act, rates.
    #[inline(always)]
    fn pulls<const N: usize>(
        &self,
        each: [(usize, usize); N],
        reaches: &[Elongation<P::Vector>; N],
        rates: &[P::Vector; N],
    ) -> [P::Vector; N] {
        let mut springs = [Tsda::default(); N];
        for (spring, place) in springs.iter_mut().zip(each) {
            *spring = at(self.springs, place);
        }
        let mut pulls = [P::Vector::ZERO; N];
        match (self.dampers, self.clearance) {
            (None, clearance) if T::CLEARANCES && clearance.is_some() => {
                for (pull, (spring, elongation)) in
                    pulls.iter_mut().zip(springs.iter().zip(reaches))
                {
                    *pull = spring.pull(elongation, clearance);
                }
            }
            (Some(dampers), None) if Self::DAMPED => {
                let mut dampings = [P::Real::ZERO; N];
                for (damping, place) in dampings.iter_mut().zip(each) {
                    *damping = at(dampers, place);
                }
                pulls = Tsda::damped_pulls(&springs, &dampings, reaches, rates);
            }
            (Some(dampers), clearance) if Self::DAMPED && T::CLEARANCES => {
                let rows = springs.iter().zip(reaches.iter().zip(rates)).zip(each);
                for (pull, ((spring, (elongation, rate)), place)) in pulls.iter_mut().zip(rows) {
                    *pull = spring.damped_pull(at(dampers, place), elongation, *rate, clearance);
                }
            }
            _ => pulls = Tsda::pulls(&springs, reaches),
        }
        pulls
    }
}
