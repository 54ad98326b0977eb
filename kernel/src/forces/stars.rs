//! Stars of TSDAs: a point of A joined to one or three points of B.
//!
//! `(group, ends) => record`. Each distinct point is placed once; the pulls on a point of B are
//! added in the order of its elements; force and torque on A add star by star, the torque on B arm
//! by arm.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, blocks};
use crate::space::{Linear as _, Vector as _};

/// A group of TSDA stars with `ARMS` arms each.
#[inline(always)]
pub(super) fn stars<P: Geometry, T: Terms, D: Dampers, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let mut record = Record::ZERO;
    let Some(tsdas) = model.tsdas.get(group.element as usize..) else { return record };
    let (tsdas, _) = tsdas.as_chunks::<ARMS>();
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..),
        _ => None,
    }
    .map(|dampers| dampers.as_chunks::<ARMS>().0);
    let clearance = model.clearance(group);
    let (mut springs, mut dampers) = (tsdas.iter(), dampers.map(<[_]>::iter));
    for (centres, others) in blocks::<_, ARMS>(model.points, group) {
        let tips: [_; ARMS] = core::array::from_fn(|j| end_b.place(&others[j]));
        let mut pulls = [P::Vector::ZERO; ARMS];
        for (centre, springs) in centres.iter().zip(&mut springs) {
            let (centre, arm) = end_a.place(centre);
            let coefficients = dampers.as_mut().and_then(Iterator::next);
            let mut pull_a = P::Vector::ZERO;
            for j in 0..ARMS {
                let (tip, tip_arm) = &tips[j];
                let d = P::displacement(&centre, tip);
                let pull = match coefficients {
                    Some(coefficients) => {
                        let v_rel = end_b.point_velocity(*tip_arm) - end_a.point_velocity(arm);
                        springs[j].damped_force(coefficients[j], d, v_rel, clearance)
                    }
                    None => springs[j].force(d, clearance),
                };
                pull_a = pull_a + pull;
                pulls[j] = pulls[j] + pull;
            }
            record.force = record.force + pull_a;
            record.torque_a = record.torque_a + arm.cross(pull_a);
        }
        for j in 0..ARMS {
            record.torque_b = record.torque_b - tips[j].1.cross(pulls[j]);
        }
    }
    record
}
