//! Springs of a mechanism whose loops are open at the file's pose.
//!
//! `closed scene => preloads`. The torsion angle of a torsion spring is 0 at the closed pose, where the hinge
//! coordinate differs from that of the file's pose; the preload is therefore computed at the closed pose.

use dbd_scene::Scene;
use nalgebra::{UnitQuaternion, Vector3};

use crate::mechanism::Mechanism;
use crate::part::Side;
use crate::settings::quaternion;

/// Sets the preloads to those of the closed pose; returns whether any changed. A refused scene changes none: loading it
/// reports the reason.
pub(crate) fn settle(mechanism: &mut Mechanism<'_>, text: &str) -> bool {
    let open = mechanism.links.iter().any(|link| !link.is_closed());
    let stiff = mechanism.torsions.iter().any(|spring| spring.stiffness > 0.0);
    if !(open && stiff) {
        return false;
    }
    let Ok(scene) = Scene::parse(text, "") else { return false };
    let closed = |side: Side| -> UnitQuaternion<f64> {
        let state = side.and_then(|part| scene.model.initial.get(part));
        let turn = state.map(|state| {
            let turn = state.orientation;
            [turn.w, turn.v.x, turn.v.y, turn.v.z]
        });
        turn.and_then(quaternion).unwrap_or_else(UnitQuaternion::identity)
    };
    let given = |mechanism: &Mechanism<'_>, side: Side| {
        side.map_or_else(UnitQuaternion::identity, |part| mechanism.placed(part).rotation)
    };
    for number in 0..mechanism.torsions.len() {
        let spring = &mechanism.torsions[number];
        let [first, second] = spring.between;
        let before = given(mechanism, first).inverse() * given(mechanism, second);
        let after = closed(first).inverse() * closed(second);
        let axis = given(mechanism, first).inverse() * spring.axis;
        let change = torsion_angle(&(after * before.inverse()), &axis);
        let spring = &mut mechanism.torsions[number];
        spring.preload -= spring.stiffness * change;
    }
    true
}

/// \[rad\] the rotation about an axis, within ±π.
fn torsion_angle(turn: &UnitQuaternion<f64>, axis: &Vector3<f64>) -> f64 {
    let angle = 2.0 * turn.imag().dot(axis).atan2(turn.w);
    if angle > std::f64::consts::PI {
        angle - std::f64::consts::TAU
    } else if angle < -std::f64::consts::PI {
        angle + std::f64::consts::TAU
    } else {
        angle
    }
}
