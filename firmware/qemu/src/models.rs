//! The shipped models: const, in flash, stepped alike on the target and on a host.
//!
//! The build script makes them from the scene files that it lists, and the macros
//! [`shipped`](crate::shipped), [`shipped_f32`](crate::shipped_f32), [`charted`](crate::charted),
//! [`fixed`](crate::fixed), [`solved`](crate::solved), [`solved_double`](crate::solved_double),
//! [`solved_fixed`](crate::solved_fixed) and [`varied`](crate::varied) from the same lists.
//! [`for_each`] shows pairs of model and scheme to a visitor, which is generic as the step is.

use dbd_kernel::model::ModelOwner;
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, GeneralizedAlpha, GeneralizedAlpha3, JointWise, Leapfrog, Pefrl, Rk4,
    Scheme, SemiImplicitEuler,
};

include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// A shipped model with a scheme.
pub struct Shipped<M: 'static, S> {
    /// Name of the scene.
    pub scene: &'static str,
    /// The model in flash.
    pub model: &'static M,
    /// \[bytes\] what it points to.
    pub beside: usize,
    /// The scheme.
    pub scheme: S,
    /// What follows the scheme's name: nothing, `+1` for a Newton iteration, `-explicit` or
    /// `-joint-wise` for another damping than the scheme's own.
    pub variant: &'static str,
    /// \[s\] the step of the shipped programs.
    pub step: f64,
    /// Most steps that a comparison of bits takes.
    pub steps: u64,
}

/// Is shown every shipped model with every scheme.
pub trait Visitor {
    /// One pair of model and scheme.
    fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>);
}

/// Shows models by name with a number of steps and a scheme.
macro_rules! show {
    ($visitor:ident: $($scene:literal $module:ident::$model:ident $step:ident $steps:expr,
        $scheme:expr;)*) => {
        $($visitor.visit(Shipped {
            scene: $scene,
            model: &$module::$model,
            beside: 0,
            scheme: $scheme,
            variant: "",
            step: $module::$step,
            steps: $steps,
        });)*
    };
}

/// Steps of a run that changes machines half way.
const LONG: u64 = 10_000;

/// Steps that every golden hash is taken at; the scenes of both precisions go on as asked.
const SHORT: u64 = 1_000;

/// Shows all pairs, those that are cheap on the target first: the scenes of both precisions in
/// f32, each with leapfrog, then dbd; those of single precision with leapfrog; the first in f64.
pub fn for_each(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(both(visitor, $scene, &$module::$f32, $module::$step);)*
            both(visitor, "four-bar", &four_bar::FOUR_BAR_FIXED, four_bar::FOUR_BAR_STEP);
            shipped_f32!(visit_f32);
            $(both(visitor, $scene, &$module::$f64, $module::$step);)*
        };
    }
    macro_rules! visit_f32 {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model32:ident;)*) => {
            $(visitor.visit(Shipped {
                scene: $scene,
                model: &$module::$f32,
                beside: 0,
                scheme: Leapfrog,
                variant: "",
                step: $module::$step,
                steps: SHORT,
            });)*
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
    let (variant, beside, steps) = ("", 0, u64::MAX);
    visitor.visit(Shipped { scene, model, beside, scheme: Leapfrog, variant, step, steps });
    visitor.visit(Shipped { scene, model, beside, scheme: Dbd::default(), variant, step, steps });
}

/// Shows what a run that changes machines is tried with: both precisions, a scheme that keeps its
/// last evaluation and ones that do not, torsion springs, loads, points on lines, dampers and inputs.
pub fn for_each_relayed(visitor: &mut impl Visitor) {
    show! { visitor:
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP LONG, Leapfrog;
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP LONG, Dbd::default();
        "five-bar-b" five_bar_b::FIVE_BAR_B_F32 FIVE_BAR_B_STEP LONG, Leapfrog;
        "crank-slider" crank_slider::CRANK_SLIDER_F32 CRANK_SLIDER_STEP LONG, Pefrl;
        "cart-pendulum" cart_pendulum::CART_PENDULUM_F32 CART_PENDULUM_STEP LONG, Leapfrog;
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_F32 DOUBLE_WISHBONE_STEP LONG, Leapfrog;
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_FIXED DOUBLE_WISHBONE_STEP LONG, Leapfrog;
        "four-bar" four_bar::FOUR_BAR_F64 FOUR_BAR_STEP SHORT, Leapfrog;
    }
}

/// Shows the further schemes: all of them with the four-bar in single precision, and those of
/// fourth order with a mechanism that has points on lines and, for few steps, with one that has
/// dampers, with one in space and in double precision; and dampers joint by joint.
pub fn for_each_further(visitor: &mut impl Visitor) {
    show! { visitor:
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP SHORT, DbdP1::default();
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP SHORT, SemiImplicitEuler;
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP SHORT, Pefrl;
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP SHORT, BlanesMoanS6;
        "four-bar" four_bar::FOUR_BAR_F32 FOUR_BAR_STEP SHORT, Rk4;
        "crank-slider" crank_slider::CRANK_SLIDER_F32 CRANK_SLIDER_STEP SHORT, Pefrl;
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_F32 DOUBLE_WISHBONE_STEP 200, Pefrl;
        "3ruu" _3ruu::_3RUU_F32 _3RUU_STEP 100, BlanesMoanS6;
        "3ruu" _3ruu::_3RUU_F32 _3RUU_STEP 100, Rk4;
        "four-bar" four_bar::FOUR_BAR_FIXED FOUR_BAR_STEP SHORT, Pefrl;
        "3ruu" _3ruu::_3RUU_FIXED _3RUU_STEP 100, Rk4;
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_FIXED DOUBLE_WISHBONE_STEP 200, Leapfrog;
        "four-bar" four_bar::FOUR_BAR_F64 FOUR_BAR_STEP 20, Pefrl;
        "four-bar" four_bar::FOUR_BAR_F64 FOUR_BAR_STEP 20, Rk4;
    }
    joint_wise(
        visitor,
        "cart-pendulum",
        &cart_pendulum::CART_PENDULUM_F32,
        cart_pendulum::CART_PENDULUM_STEP,
    );
    joint_wise(
        visitor,
        "double-wishbone",
        &double_wishbone::DOUBLE_WISHBONE_F32,
        double_wishbone::DOUBLE_WISHBONE_STEP,
    );
    joint_wise(visitor, "gripper", &gripper::GRIPPER_F32, gripper::GRIPPER_STEP);
}

/// Shows the models that have the plan of a matrix, with the scheme that takes it: in single precision, those
/// in fixed point, and the four-bar in double precision for few steps.
pub fn for_each_solved(visitor: &mut impl Visitor) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident,
            $constant:ident: $model:ident of $base:ident;)*) => {
            $(
                let of = (&$module::$constant, size_of::<$module::$base>());
                solved_by_one(visitor, $scene, of, $module::$step, SHORT);
            )*
        };
    }
    solved!(visit);
    solved_fixed!(visit);
    let of = (&four_bar_solved::FOUR_BAR_PLANNED_F64, size_of::<four_bar_solved::FourBarF64>());
    solved_by_one(visitor, "four-bar", of, four_bar_solved::FOUR_BAR_STEP, 20);
    extrapolated(visitor, SHORT);
}

/// Shows models of every precision and of the plane with the scheme that solves three times; that in double precision
/// for few steps.
pub(crate) fn extrapolated(visitor: &mut impl Visitor, steps: u64) {
    macro_rules! visit {
        ($($module:ident $scene:literal $step:ident, $constant:ident: $base:ident, $steps:expr;)*) => {
            $({
                let beside = size_of::<$module::$base>();
                let (scheme, variant) = (GeneralizedAlpha3, "");
                let (scene, model) = ($scene, &$module::$constant);
                let (step, steps) = ($module::$step, $steps);
                visitor.visit(Shipped { scene, model, beside, scheme, variant, step, steps });
            })*
        };
    }
    visit! {
        _3ruu_solved "3ruu" _3RUU_STEP, _3RUU_PLANNED_F32: _3ruuF32, steps;
        six_bar_planar_solved "six-bar-planar" SIX_BAR_STEP, SIX_BAR_PLANNED_F32: SixBarF32, steps;
        six_bar_solved "six-bar" SIX_BAR_STEP, SIX_BAR_PLANNED_FIXED: SixBarFixed, steps;
        four_bar_solved "four-bar" FOUR_BAR_STEP, FOUR_BAR_PLANNED_F64: FourBarF64, steps.min(20);
    }
}

/// Shows a model with the scheme that solves.
pub(crate) fn solved_by_one<M: ModelOwner>(
    visitor: &mut impl Visitor,
    scene: &'static str,
    (model, beside): (&'static M, usize),
    step: f64,
    steps: u64,
) {
    let (scheme, variant) = (GeneralizedAlpha::DEFAULT, "");
    visitor.visit(Shipped { scene, model, beside, scheme, variant, step, steps });
}

/// Shows a model with leapfrog and its dampers joint by joint.
fn joint_wise<M: ModelOwner>(
    visitor: &mut impl Visitor,
    scene: &'static str,
    model: &'static M,
    step: f64,
) {
    let (scheme, variant) = (JointWise(Leapfrog), "-joint-wise");
    visitor.visit(Shipped { scene, model, beside: 0, scheme, variant, step, steps: SHORT });
}
