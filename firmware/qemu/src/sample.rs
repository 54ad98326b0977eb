//! The pairs of model and scheme whose costs every test checks.
//!
//! `(models, schemes) => visitor`: every scheme, both precisions, with and without dampers, and
//! every kind of element at least once. As in [`chart`](crate::chart), each model is one [`Alone`]
//! with its scheme: the counts do not depend on what else an image holds.

use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, GeneralizedAlpha, GeneralizedAlpha3, JointWise,
    Leapfrog, Pefrl, Rk4, SemiImplicitEuler,
};

use crate::alone::Alone;
use crate::models::{self, Shipped, Visitor};

/// Shows all pairs.
pub fn for_each_sampled(visitor: &mut impl Visitor) {
    macro_rules! sample {
        ($($scene:literal $module:ident::$model:ident: $type:ident $step:ident,
            $scheme:expr => $scheme_type:ty, $variant:literal;)*) => {
            $({
                static MODEL: Alone<models::$module::$type, $scheme_type> =
                    Alone::new(models::$module::$model);
                visitor.visit(Shipped {
                    scene: $scene,
                    model: &MODEL,
                    beside: 0,
                    scheme: $scheme,
                    variant: $variant,
                    step: models::$module::$step,
                    steps: 0,
                });
            })*
        };
    }
    sample! {
        "four-bar" four_bar::FOUR_BAR_F32: FourBarF32 FOUR_BAR_STEP, Leapfrog => Leapfrog, "";
        "four-bar" four_bar::FOUR_BAR_F32: FourBarF32 FOUR_BAR_STEP, Dbd { newton: 1 } => Dbd, "+1";
        "four-bar" four_bar::FOUR_BAR_F64: FourBarF64 FOUR_BAR_STEP, Leapfrog => Leapfrog, "";
        "four-bar" four_bar::FOUR_BAR_F64: FourBarF64 FOUR_BAR_STEP, Rk4 => Rk4, "";
        "3rrr" _3rrr::_3RRR_F32: _3rrrF32 _3RRR_STEP, DbdP1 { newton: 0 } => DbdP1, "";
        "3ruu" _3ruu::_3RUU_F32: _3ruuF32 _3RUU_STEP, DbdP2 { newton: 0 } => DbdP2, "";
        "five-bar-b" five_bar_b::FIVE_BAR_B_F64: FiveBarBF64 FIVE_BAR_B_STEP,
            Dbd { newton: 0 } => Dbd, "";
        "crank-slider" crank_slider::CRANK_SLIDER_F32: CrankSliderF32 CRANK_SLIDER_STEP,
            Pefrl => Pefrl, "";
        "hexagon" hexagon::HEXAGON_F32: HexagonF32 HEXAGON_STEP, BlanesMoanS6 => BlanesMoanS6, "";
        "six-bar" six_bar::SIX_BAR_F32: SixBarF32 SIX_BAR_STEP,
            SemiImplicitEuler => SemiImplicitEuler, "";
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_F32: DoubleWishboneF32
            DOUBLE_WISHBONE_STEP, Leapfrog => Leapfrog, "";
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_F32: DoubleWishboneF32
            DOUBLE_WISHBONE_STEP, Explicit(Leapfrog) => Explicit<Leapfrog>, "-explicit";
        "cart-pendulum" cart_pendulum::CART_PENDULUM_F32: CartPendulumF32 CART_PENDULUM_STEP,
            Leapfrog => Leapfrog, "";
        "gripper" gripper::GRIPPER_F32: GripperF32 GRIPPER_STEP, Leapfrog => Leapfrog, "";
        "double-wishbone" double_wishbone::DOUBLE_WISHBONE_F32: DoubleWishboneF32
            DOUBLE_WISHBONE_STEP, JointWise(Leapfrog) => JointWise<Leapfrog>, "-joint-wise";
        "cart-pendulum" cart_pendulum::CART_PENDULUM_F32: CartPendulumF32 CART_PENDULUM_STEP,
            JointWise(Leapfrog) => JointWise<Leapfrog>, "-joint-wise";
        "gripper" gripper::GRIPPER_F32: GripperF32 GRIPPER_STEP,
            JointWise(Leapfrog) => JointWise<Leapfrog>, "-joint-wise";
        "3ruu" _3ruu_solved::_3RUU_PLANNED_F32: _3ruuPlannedF32 _3RUU_STEP,
            GeneralizedAlpha::DEFAULT => GeneralizedAlpha, "";
        "six-bar-planar" six_bar_planar_solved::SIX_BAR_PLANNED_F32: SixBarPlannedF32 SIX_BAR_STEP,
            GeneralizedAlpha::DEFAULT => GeneralizedAlpha, "";
        "double-wishbone" double_wishbone_solved::DOUBLE_WISHBONE_PLANNED_F64: DoubleWishbonePlannedF64
            DOUBLE_WISHBONE_STEP, GeneralizedAlpha::DEFAULT => GeneralizedAlpha, "";
        "six-bar-planar" six_bar_planar_solved::SIX_BAR_PLANNED_F32: SixBarPlannedF32 SIX_BAR_STEP,
            GeneralizedAlpha3 => GeneralizedAlpha3, "";
    }
}
