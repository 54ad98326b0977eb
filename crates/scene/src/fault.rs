//! Causes of a failed step, with the names of the scene.
//!
//! `cause => sentence`, the same for all programs.

use dbd_kernel::status::{Cause, MAX_TURN};

use crate::scene::Scene;

/// The cause of a failed step as a clause: ``body `crank` turns by more than 1 rad in a step``.
#[must_use]
pub fn fault(scene: &Scene, cause: &Cause) -> String {
    let name = |body: &dbd_kernel::BodyIndex| scene.body_name(body.row());
    let spring = |row: usize| scene.torsion_names.get(row).map_or("", String::as_str);
    match cause {
        Cause::NonFinite { body } => {
            format!("the state of body `{}` is not finite", name(body))
        }
        Cause::Spin { body } => {
            format!("body `{}` turns by more than {MAX_TURN} rad in a step", name(body))
        }
        Cause::Turn { body } => {
            format!("body `{}` turns farther in a step than the scheme allows", name(body))
        }
        Cause::Extent { body } => {
            let body = name(body);
            format!("body `{body}` leaves the fixed-point range of positions or velocities")
        }
        Cause::Turns { spring: row } => {
            format!(
                "the revolution count of {} has reached its maximum",
                spring(usize::from(row.0))
            )
        }
        Cause::Pivot { body } => {
            format!("the iteration matrix is not positive definite (body `{}`)", name(body))
        }
        Cause::Steps => "the step counter has reached its maximum".to_owned(),
        Cause::Frequency { body } => {
            let body = name(body);
            format!("the mounts on body `{body}` can vibrate at a frequency too high for the step")
        }
        Cause::Energy { body } => {
            format!("the energy exceeds its limit, most of it in body `{}`,", name(body))
        }
        Cause::Undefined { law } => {
            let law = scene.law_names.get(usize::from(law.0)).map_or("", String::as_str);
            format!("{law} is undefined: its bodies have turned by 180° across its axis")
        }
        Cause::UndefinedTorsionAngle { spring: row } => {
            let spring = spring(usize::from(row.0));
            format!(
                "the torsion angle of {spring} is undefined: its bodies have turned by 180° across its axis"
            )
        }
        // Of a later kernel.
        other => format!("{other:?}"),
    }
}
