//! The laws of the project that `host-sim new laws` writes: a user's, on the target.

#[path = "../../../host-sim/templates/laws/cam.rs.in"]
mod cam;
#[path = "../../../host-sim/templates/laws/drag.rs.in"]
mod drag;

pub use cam::Cam;
pub use drag::Drag;
