//! The shipped models: const, in flash, stepped alike on the target and on a host.
//!
//! The build script makes them from the scene files that it lists, and the macro
//! [`shipped`](crate::shipped) from the same list. [`for_each`] shows every pair of model and
//! scheme to a visitor, which is generic as the step itself is.

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Dbd, Leapfrog, Scheme};

include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// A shipped model with a scheme.
pub struct Shipped<M: 'static, S> {
    /// Name of the scene.
    pub scene: &'static str,
    /// The model in flash.
    pub model: &'static M,
    /// The scheme.
    pub scheme: S,
    /// \[s\] the step of the shipped programs.
    pub step: f64,
}

/// Is shown every shipped model with every scheme.
pub trait Visitor {
    /// One pair of model and scheme.
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>);
}

/// Shows all pairs: the scenes in f32, the cheap ones on the target, then those in f64; each with
/// leapfrog, then dbd.
pub fn for_each(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(both(visitor, $scene, &$module::$f32, $module::$step);)*
            $(both(visitor, $scene, &$module::$f64, $module::$step);)*
        };
    }
    shipped!(visit);
}

fn both<M: ModelOwner>(
    visitor: &mut impl Visitor,
    scene: &'static str,
    model: &'static M,
    step: f64,
) {
    visitor.visit(Shipped { scene, model, scheme: Leapfrog, step });
    visitor.visit(Shipped { scene, model, scheme: Dbd::default(), step });
}
