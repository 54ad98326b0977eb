//! Torsion springs, summed after all groups.
//!
//! `(springs, orientations, revolution counts) => torques; revolution counts, updated near a step's boundary`.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::forces::force_pair::{At, Dampers, ForcePair, Wrench, apply};
use crate::geometry::Geometry;
use crate::index::TorsionIndex;
use crate::model::{ModelRef, Terms};
use crate::pose::{End, Places};
use crate::real::{Mask as _, Real as _};
use crate::space::Linear as _;
use crate::status::Cause;

/// The torsion springs.
#[inline(always)]
pub(super) fn torsions<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    (turns, at): (&mut [i32], At),
    wrenches: &mut [Wrench<P::Space>],
) -> Result<(), Cause> {
    let settle = at == At::Boundary;
    let counts = P::Real::counts_mut(turns);
    for (i, (spring, turns)) in model.torsions.iter().zip(counts).enumerate() {
        let (a, b) = (bodies.get(spring.a.row()), bodies.get(spring.b.row()));
        let relative =
            P::Orientation::relative(a.map(|s| &s.orientation), b.map(|s| &s.orientation));
        let Some(since) = spring.since_start(relative) else {
            return Err(Cause::UndefinedTorsionAngle { spring: TorsionIndex(i as u16) });
        };
        if settle {
            *turns = since.settled(*turns);
        }
        // A pure damper acts elsewhere.
        let zero = P::Real::ZERO;
        let slack = spring.stiffness.equals(zero) & spring.preload.equals(zero);
        if !D::ACT && slack.all() {
            continue;
        }
        let torsion_angle = spring.torsion_angle(&since, *turns);
        let end_a = End::new(model, places, spring.a, Some(bodies));
        let damper = match spring.damper.row() {
            Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
            _ => None,
        };
        let torque = match damper {
            Some(&damping) => {
                let end_b = End::new(model, places, spring.b, Some(bodies));
                let rate = end_a.moment_to_axes(end_b.spin - end_a.spin);
                spring.damped_torque(damping, &torsion_angle, rate)
            }
            None => spring.torque(&torsion_angle),
        };
        let torque = end_a.moment_to_world(torque);
        let force_pair = ForcePair { force: P::Vector::ZERO, torque_a: -torque, torque_b: -torque };
        apply(wrenches, spring.a.row(), spring.b.row(), &force_pair);
    }
    Ok(())
}
