//! The shipped models: const, in flash, stepped alike on the target and on a host.
//!
//! [`shipped`] is the one list; a scene is one line of it. [`for_each`] shows every pair of
//! model and scheme to a visitor, which is generic as the step itself is.

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{Dbd, Leapfrog, Scheme};

pub use crate::pendulum::*;

/// Calls a macro with all shipped models: name, module, step \[s\], static and type per
/// precision.
#[macro_export]
macro_rules! shipped {
    ($then:path) => {
        $then! {
            pendulum "pendulum" 1e-4, PENDULUM_F64: PendulumF64, PENDULUM_F32: PendulumF32;
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

/// Shows all pairs in the order scene, precision (f64, f32), scheme (dbd, leapfrog).
pub fn for_each(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:literal, $($table:ident: $model:ident),*;)*) => {
            $($(
                let (scene, model, step) = ($scene, &$table, $step);
                visitor.visit(Shipped { scene, model, scheme: Dbd::default(), step });
                visitor.visit(Shipped { scene, model, scheme: Leapfrog, step });
            )*)*
        };
    }
    shipped!(visit);
}
