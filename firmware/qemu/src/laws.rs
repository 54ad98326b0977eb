//! Scenes that have every law together, in every precision, and some in the plane.
//!
//! `=> lines "hash SCENE SCHEME PRECISION STEPS HASH"`, as of [`mod@crate::hash`].

use dbd_kernel::Leapfrog;

use crate::models::{Shipped, Visitor};

include!(concat!(env!("OUT_DIR"), "/laws.rs"));

/// Shows each model with leapfrog.
pub fn for_each(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident $steps:literal, $model:ident;)*) => {
            $(visitor.visit(Shipped {
                scene: $scene,
                model: &$module::$model,
                beside: 0,
                scheme: Leapfrog,
                variant: "",
                step: $module::$step,
                steps: $steps,
            });)*
        };
    }
    lawful!(visit);
}
