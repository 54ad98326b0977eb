//! A hand at a body: a damped spring between a point of it and a point of the world.
//!
//! `(point, target, speed) => impulse per step`. The impulse is given between two steps, so the model is unchanged and
//! every scheme supports it. The spring pulls the whole mechanism to the target within about one second of real time,
//! at any playback speed; for a body much lighter than the mechanism the impulse is limited for stability.

use dbd_kernel::{BodyState, Quaternion, Vec3};
use dbd_scene::Planar;

use crate::refused::Refused;
use crate::session::asked::Grab;
use crate::session::live::Session;

/// \[1/s\] rate at which a mechanism follows the hand, in real time.
const FOLLOWS: f64 = 8.0;
/// \[1\] largest fraction of the body's distance and rate that a step may remove.
const MAX_SHARE: f64 = 0.05;
/// \[1\] damping ratio.
const RATIO: f64 = 0.7;

impl Session {
    /// Attaches the hand to a body, or moves its target; `None` releases it.
    ///
    /// # Errors
    /// Where there is no such body or a number is not finite; nothing is changed then.
    pub fn grab(&mut self, grab: Option<Grab>) -> Result<(), Refused> {
        if let Some(Grab { body, point, target, speed }) = grab {
            let bodies = self.instance.scene().body_names.len();
            if body >= bodies {
                return Err(Refused::new(
                    format!("there is no body {body}"),
                    format!("the scene has {bodies}"),
                ));
            }
            let numbers = point.iter().chain(&target).chain([&speed]);
            if !numbers.copied().all(f64::is_finite) || speed <= 0.0 {
                return Err(Refused::new(
                    "the hand has a value that is not finite",
                    "give a finite point and target, and a speed above 0",
                ));
            }
        }
        self.grab = grab;
        Ok(())
    }

    /// Pulls for some of the coming steps, at most `steps`; returns their number.
    pub(super) fn pull(&mut self, steps: u64) -> u64 {
        let Some(Grab { body: row, point, target, speed }) = self.grab else { return steps };
        let plant = self.instance.plant();
        let (model, mut state) = (plant.model(), plant.state());
        let (body, held) = (model.bodies[row], state.bodies[row]);
        let whole: f64 = model.bodies.iter().map(|body| body.mass).sum();
        let rate = FOLLOWS / speed;
        let step = plant.step_size();
        // Often enough for the whole mechanism; at every step for fast bodies.
        let count = ((MAX_SHARE / (rate * step)) as u64).clamp(1, steps.min(64));
        let time = count as f64 * step;
        let stiffness = (whole * rate * rate).min(MAX_SHARE * body.mass / (time * time));
        let damping = (2.0 * RATIO * rate * whole).min(MAX_SHARE * body.mass / time);
        let rotation = Quaternion::from_f64(held.orientation.to_f64()).rotation();
        let arm_b = Vec3::from_f64(point);
        let arm = rotation.to_world(arm_b);
        let spin = |state: &BodyState<dbd_kernel::F64>| rotation.to_world(state.angular_velocity);
        let velocity = |state: &BodyState<dbd_kernel::F64>| state.velocity + spin(state).cross(arm);
        let before = velocity(&held);
        let away = Vec3::from_f64(target) - (held.position + arm);
        let impulse = (away * stiffness - before * damping) * time;
        let mut pulled = held;
        pulled.velocity = held.velocity + impulse * body.inverse_mass;
        let turn = rotation.to_body(arm.cross(impulse));
        let [x, y, z] = body.inverse_inertia.to_f64();
        pulled.angular_velocity =
            held.angular_velocity + Vec3::new(turn.x * x, turn.y * y, turn.z * z);
        if let Some(planar) = &self.instance.scene().planar {
            pulled = flat(planar, row, &pulled);
        }
        let work = 0.5 * impulse.dot(before + velocity(&pulled));
        state.bodies[row] = pulled;
        // An impulse that the precision cannot represent is left out.
        if work.is_finite() && self.instance.plant_mut().set_state(&state).is_ok() {
            self.work += work;
            self.disturbed = true;
        }
        count
    }
}

/// The state projected onto the plane.
fn flat(
    planar: &Planar,
    row: usize,
    state: &BodyState<dbd_kernel::F64>,
) -> BodyState<dbd_kernel::F64> {
    planar.plane.state_outward(row, &planar.plane.state_inward(row, state))
}
