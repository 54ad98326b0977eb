//! Times with a unit, as scenes and command lines have them: [`dbd_scene::time`].

pub use dbd_scene::time::*;
