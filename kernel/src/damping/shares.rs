//! The weight of each damper among dampers that act on a common force.
//!
//! `(model, pose) => weight per damper`. An impulse along damper i moves its bodies; its weight is the power that it
//! takes from this motion over the power that all dampers take: `w_i = c_i·K_ii² / Σ_j c_j·K_ij²`, `K_ij` the rate
//! along j per impulse along i. It is 1 for a damper alone or orthogonal to all others, ½ for each of two equal
//! parallel dampers. A damper of several directions has their mean. Computed once, at the initial pose: it affects how
//! dampers divide a force, not how much they resist.

use crate::damping::motion::{Motion, Mount, Pose};
use crate::damping::near::Held;
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::laws::Laws as _;
use crate::model::{ModelRef, SharesIn, Terms};
use crate::real::{Real, choose};

/// Writes the weight of every damper; `shares` is as long as the dampers, `held` has an empty entry per body.
pub(crate) fn share<P: Geometry, T: Terms<P>>(
    pose: &Pose<'_, '_, P, T>,
    held: &mut [Held],
    (shares, of_laws): (&mut [Share<P::Real>], &mut SharesIn<P, T>),
) {
    let zero = P::Real::ZERO;
    let model = pose.model;
    pose.hold(held);
    let none = Share { own: zero, later: zero };
    shares.fill(none);
    each_of_laws(model, of_laws, |share| *share = none);
    // First the power of all dampers and of the later ones, over the damper's own.
    for (place, mount) in pose.mounts().enumerate() {
        let Some(ends) = pose.ends(mount) else { continue };
        for (other_place, other, others) in pose.meeting(held, ends) {
            pose.each_damper(mount, |row, part, coefficient, direction| {
                let Some(motion) = Motion::new(model, ends, coefficient, direction) else { return };
                let [mut all, mut later] = [zero; 2];
                pose.each_damper(other, |other_row, _, coefficient, direction| {
                    let power = motion.power(others, coefficient, direction);
                    all = all + power;
                    if (other_place, other_row) > (place, row) {
                        later = later + power;
                    }
                });
                let share = match mount {
                    Mount::Law(law) => model.laws.share_mut(of_laws, law, row),
                    _ => shares.get_mut(row),
                };
                if let Some(share) = share {
                    let (own, after) = (share.own + part * all, share.later + part * later);
                    share.own = P::Real::pick(motion.known, own, share.own);
                    share.later = P::Real::pick(motion.known, after, share.later);
                }
            });
        }
    }
    let finish = |share: &mut Share<P::Real>| {
        let Share { own: all, later } = *share;
        // A damper without a direction or a coefficient causes no motion.
        let known = zero.less_than(all) & (all * zero).equals(zero);
        let alone = Share::<P::Real>::ALONE;
        let (own, later) =
            choose!(P::Real, known, (P::Real::ONE / all, later / all), (alone.own, alone.later));
        *share = Share { own, later };
    };
    shares.iter_mut().for_each(finish);
    each_of_laws(model, of_laws, finish);
}

/// Visits the weights of the laws' dampers.
fn each_of_laws<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    shares: &mut SharesIn<P, T>,
    visit: impl Fn(&mut Share<P::Real>),
) {
    for row in 0..model.laws.count() {
        let mut damper = 0;
        while let Some(share) = model.laws.share_mut(shares, row, damper) {
            visit(share);
            damper += 1;
        }
    }
}
