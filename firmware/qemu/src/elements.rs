//! A plain scene alone and with one element each: the folder `elements`.
//!
//! Each model is one [`Alone`] with its scheme.

use dbd_kernel::Leapfrog;

use crate::alone::Alone;
use crate::models::{Shipped, Visitor};

include!(concat!(env!("OUT_DIR"), "/elements.rs"));

/// Shows each model in single precision with leapfrog.
pub fn for_each(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model32:ident;)*) => {
            $({
                static MODEL: Alone<$module::$model32, Leapfrog> = Alone::new($module::$f32);
                visitor.visit(Shipped {
                    scene: $scene,
                    model: &MODEL,
                    beside: 0,
                    scheme: Leapfrog,
                    variant: "",
                    step: $module::$step,
                    steps: 1_000,
                });
            })*
        };
    }
    elements!(visit);
}
