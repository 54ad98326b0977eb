//! What went wrong with a step, in the scene's names.
//!
//! `cause => sentence`, the same for everyone who runs the scene.

use dbd_kernel::status::{Cause, MOST_TURN};

use crate::scene::Scene;

/// What went wrong with a step, to go into a sentence: ``body `crank` turns by more than 1 rad in a step``.
#[must_use]
pub fn fault(scene: &Scene, cause: &Cause) -> String {
    let name = |body: &dbd_kernel::BodyIndex| scene.body_name(body.row());
    let spring = |row: usize| scene.torsion_names.get(row).map_or("", String::as_str);
    match cause {
        Cause::NonFinite { body } => {
            format!("a number of body `{}`'s state is not finite", name(body))
        }
        Cause::Spin { body } => {
            format!("body `{}` turns by more than {MOST_TURN} rad in a step", name(body))
        }
        Cause::Turn { body } => {
            format!("body `{}` turns farther in a step than the scheme bears", name(body))
        }
        Cause::Extent { body } => {
            let body = name(body);
            format!("body `{body}` is farther away, or faster, than fixed-point numbers hold")
        }
        Cause::Turns { spring: row } => {
            format!("the turn count of {} is at its end", spring(usize::from(row.0)))
        }
        Cause::Pivot { body } => {
            format!("the matrix of the step has no factor at body `{}`", name(body))
        }
        Cause::Steps => "the step counter is at its end".to_owned(),
        Cause::Frequency { body } => {
            let body = name(body);
            format!("what is mounted to body `{body}` can vibrate faster than the step bears")
        }
        Cause::Energy { body } => {
            format!("the energy is beyond its limit, most of it in body `{}`,", name(body))
        }
        Cause::Undefined { law } => {
            let law = scene.law_names.get(usize::from(law.0)).map_or("", String::as_str);
            format!("what {law} does is undefined: its bodies turned half a turn across its axis")
        }
        Cause::UndefinedTwist { spring: row } => {
            let spring = spring(usize::from(row.0));
            format!("the twist of {spring} is undefined: its bodies turned half a turn across it")
        }
    }
}
