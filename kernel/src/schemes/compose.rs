//! One step of a symmetric composition of drifts and kicks, for [`super::Pefrl`] and
//! [`super::BlanesMoanS6`].
//!
//! `(state, composition) => state`. Damper passes come before and after, never within: some substeps are negative,
//! where a damper would add energy.

use crate::compositions::Composition;
use crate::forces::{At, DampersLeft};
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real;
use crate::status::Cause;
use crate::step::Stepper;

/// Drifts around kicks, beginning and ending with a drift; revolution counts are updated at the first evaluation.
#[inline(always)]
pub(super) fn compose<P: Geometry, T: Terms<P>>(
    stepper: &mut Stepper<'_, '_, P, T, ()>,
    composition: &Composition,
) -> Result<(), Cause> {
    stepper.place_for_sweep();
    stepper.sweep_forward();
    let Composition { drifts, kicks } = composition;
    let mut kicks = kicks.iter();
    let mut part = P::Real::ZERO;
    for (i, &drift) in drifts.iter().enumerate() {
        stepper.drift_of_order_four(P::Real::constant(drift) * stepper.h);
        part = part + P::Real::constant(drift);
        if let Some(&kick) = kicks.next() {
            stepper.sample_inputs(part);
            let at = if i == 0 { At::Boundary } else { At::Stage };
            stepper.evaluate::<DampersLeft>(at)?;
            stepper.kick(P::Real::constant(kick));
        }
    }
    if T::DAMPERS {
        stepper.sample_inputs(P::Real::ONE);
    }
    stepper.place_for_sweep();
    stepper.sweep_reverse();
    Ok(())
}
