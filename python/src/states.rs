//! The bodies' states as arrays.
//!
//! `plant <=> positions, orientations, velocities, angular velocities`, a row per body.

use dbd_kernel::plant::StateError;
use dbd_kernel::{BodyState, F64};
use dbd_plant::AnyPlant;
use dbd_plant::instance::Instance;

use crate::error::Refusal;

/// The parts of a body's state with their numbers of components.
pub(crate) const PARTS: [(&str, usize); 4] =
    [("position", 3), ("orientation", 4), ("velocity", 3), ("angular_velocity", 3)];

/// The parts of a body's state.
fn parts(body: &BodyState<F64>) -> [Vec<f64>; 4] {
    [
        body.position.to_f64().to_vec(),
        body.orientation.to_f64().to_vec(),
        body.velocity.to_f64().to_vec(),
        body.angular_velocity.to_f64().to_vec(),
    ]
}

/// Each part of all bodies, one body after another.
pub(crate) fn arrays(plant: &dyn AnyPlant) -> [Vec<f64>; 4] {
    let mut all: [Vec<f64>; 4] = Default::default();
    for body in &plant.state().bodies {
        for (all, part) in all.iter_mut().zip(parts(body)) {
            all.extend(part);
        }
    }
    all
}

/// Sets the given parts of the bodies' states, each bodies × its width.
pub(crate) fn set(instance: &mut Instance, given: &[Option<Vec<f64>>; 4]) -> Result<(), Refusal> {
    let mut state = instance.plant().state();
    for (row, body) in state.bodies.iter_mut().enumerate() {
        let mut now = parts(body);
        for ((now, given), (_, width)) in now.iter_mut().zip(given).zip(PARTS) {
            if let Some(given) =
                given.as_ref().and_then(|all| all.get(row * width..(row + 1) * width))
            {
                now.copy_from_slice(given);
            }
        }
        let [position, orientation, velocity, spin] = now;
        let three = |part: &[f64]| std::array::from_fn(|i| part[i]);
        *body = BodyState::from_f64(
            three(&position),
            std::array::from_fn(|i| orientation[i]),
            three(&velocity),
            three(&spin),
        );
    }
    let refused = instance.plant_mut().set_state(&state);
    refused.map_err(|error| Refusal::new("StateError", sentence(instance, &error)))
}

/// The error of a state, with the body's name.
fn sentence(instance: &Instance, error: &StateError) -> String {
    let name = |row: u16| {
        let names = &instance.scene().body_names;
        names.get(usize::from(row)).map_or_else(String::new, Clone::clone)
    };
    match error {
        StateError::NotFinite(body) => format!("the state of `{}` is not finite", name(body.0)),
        StateError::Extent(body) => {
            format!("the position of `{}` exceeds the range of fixed-point numbers", name(body.0))
        }
        StateError::Orientation(body) => {
            format!(
                "the orientation of `{}` is not a unit quaternion; give it scalar first, with length 1",
                name(body.0)
            )
        }
        StateError::OffPlane(body) => {
            format!("the state of `{}` leaves the plane of the scene", name(body.0))
        }
        _ => error.to_string(),
    }
}
