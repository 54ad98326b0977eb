//! The shipped models: const, in flash, stepped alike on the target and on a host.
//!
//! [`shipped`] is the one list; a scene is one line of it. [`for_each`] shows every pair of
//! model and scheme to a visitor, which is generic as the step itself is.

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Dbd, Leapfrog, Scheme};

pub use crate::pendulum::*;

/// Calls a macro with all shipped models: module, name, step \[s\], static and type per precision.
#[macro_export]
macro_rules! shipped {
    ($then:path) => {
        $then! {
            pendulum "pendulum" 1e-4, PENDULUM_F32: PendulumF32, PENDULUM_F64: PendulumF64;
        }
    };
}

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
        ($($module:ident $scene:literal $step:literal,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(both(visitor, $scene, &$f32, $step);)*
            $(both(visitor, $scene, &$f64, $step);)*
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
