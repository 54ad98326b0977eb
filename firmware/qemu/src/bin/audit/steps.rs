//! Roots `audit.step.MODEL.SCHEME.PRECISION`: steps of all schemes.
//!
//! All schemes with the four-bar and with a model that has every kind of element, in single precision and in fixed
//! point; of double precision, which is compiled from the same text, leapfrog, and pefrl with the four-bar. Every law with
//! leapfrog, every other shipped model with leapfrog in single precision, some in fixed point.

use dbd_kernel::model::Planned;
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Failure, Fixed, GeneralizedAlpha,
    GeneralizedAlpha3, JointWise, Leapfrog, Model, Pefrl, Plant, Rk4, SemiImplicitEuler, laws,
};
use firmware::alone::Alone;
use firmware::models::{
    self,
    four_bar::{FourBarF32, FourBarF64},
};

use crate::Keep;

/// A model with elements of every kind. Their numbers are of no matter to a step's code, their
/// values even less: a kind that is there is compiled.
pub type EveryKind<P> = Model<P, 4, 6, 24, 12, 2, 14, 2, 1, 2, 4, 3, 4, 2>;

/// The same with the plan of a matrix.
pub type EveryKindPlanned<P> = Planned<&'static EveryKind<P>, 4, 6, 4, 8>;

/// Bodies with laws between them alone.
type Lawful<P, L> = Model<P, 3, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 3, 0, L>;

macro_rules! step {
    ($keep:ident, $model:literal $type:ty, $name:literal $scheme:ty, $precision:literal) => {{
        #[inline(never)]
        #[unsafe(export_name = concat!("audit.step.", $model, ".", $name, ".", $precision))]
        fn root(plant: &mut Plant<&'static $type, $scheme>) -> Result<(), Failure> {
            plant.step()
        }
        $keep(root as *const ());
    }};
}

pub fn keep(keep: Keep) {
    macro_rules! shipped {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(
                step!(keep, $scene models::$module::$model32, "leapfrog" Leapfrog, "f32");
                step!(keep, $scene models::$module::$model32, "dbd" Dbd, "f32");
                step!(keep, $scene models::$module::$model64, "leapfrog" Leapfrog, "f64");
            )*
        };
    }
    macro_rules! shipped_f32 {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model32:ident;)*) => {
            $(step!(keep, $scene models::$module::$model32, "leapfrog" Leapfrog, "f32");)*
        };
    }
    // A model of its own for each: with shared code, sizes would not be those of one scheme.
    macro_rules! four_bar {
        ($($name:literal $scheme:ty;)*) => {
            $(
                step!(keep, "four-bar" Alone<FourBarF32, $scheme>, $name $scheme, "f32");
            )*
        };
    }
    macro_rules! every_kind {
        ($($name:literal $scheme:ty;)*) => {
            $(
                step!(keep, "every-kind" EveryKind<F32>, $name $scheme, "f32");
                step!(keep, "every-kind" EveryKind<Fixed>, $name $scheme, "fixed");
            )*
        };
    }
    macro_rules! fixed {
        ($($module:ident $scene:literal $step:ident, $fixed:ident: $model:ident;)*) => {
            $(step!(keep, $scene models::$module::$model, "leapfrog" Leapfrog, "fixed");)*
        };
    }
    step!(keep, "every-kind" EveryKind<F64>, "leapfrog" Leapfrog, "f64");
    // Every law, up to eight in a model.
    macro_rules! lawful {
        ([$name:literal $($names:literal)*]
            $a:ident, $b:ident, $c:ident, $d:ident, $e:ident, $f:ident, $g:ident, $h:ident, $($rest:ident),+ $(,)?) => {
            lawful!([$name] $a, $b, $c, $d, $e, $f, $g, $h);
            lawful!([$($names)*] $($rest),+);
        };
        ([$name:literal] $($law:ident),+ $(,)?) => {
            step!(keep, $name Lawful<F32, ($([laws::$law<F32>; 1],)+)>, "leapfrog" Leapfrog, "f32");
            step!(keep, $name Lawful<Fixed, ($([laws::$law<Fixed>; 1],)+)>, "leapfrog" Leapfrog, "fixed");
        };
    }
    macro_rules! every_law {
        ($($law:ident),+ $(,)?) => {
            lawful!(["laws-1" "laws-2" "laws-3" "laws-4" "laws-5"] $($law),+);
        };
    }
    dbd_kernel::each_law!(every_law);
    firmware::shipped!(shipped);
    firmware::fixed!(fixed);
    firmware::shipped_f32!(shipped_f32);
    // With a matrix, on models with its plan.
    macro_rules! solved {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model:ident of $base:ident;)*) => {
            $(step!(keep, $scene models::$module::$model, "generalized-alpha" GeneralizedAlpha, "f32");)*
        };
    }
    firmware::solved!(solved);
    macro_rules! every_kind_solved {
        ($($name:literal $scheme:ty;)*) => {
            $(
                step!(keep, "every-kind" EveryKindPlanned<F32>, $name $scheme, "f32");
                step!(keep, "every-kind" EveryKindPlanned<Fixed>, $name $scheme, "fixed");
            )*
        };
    }
    every_kind_solved! {
        "generalized-alpha" GeneralizedAlpha;
        "generalized-alpha-3" GeneralizedAlpha3;
    }
    step!(keep, "3ruu" models::_3ruu_solved::_3ruuPlannedF32,
        "generalized-alpha-3" GeneralizedAlpha3, "f32");
    step!(keep, "six-bar-planar" models::six_bar_planar_solved::SixBarPlannedF32,
        "generalized-alpha-3" GeneralizedAlpha3, "f32");
    // What a controller drives, without the scene's tables.
    step!(keep, "delta-pick-and-place" models::delta_pick_and_place::DeltaPickAndPlaceF32,
        "leapfrog" Leapfrog, "f32");
    // What the shipped four-bar has not: all but leapfrog and dbd.
    four_bar! {
        "dbd-p1" DbdP1;
        "dbd-p2" DbdP2;
        "semi-implicit-euler" SemiImplicitEuler;
        "pefrl" Pefrl;
        "blanes-moan-s6" BlanesMoanS6;
        "rk4" Rk4;
        "semi-implicit-euler-explicit" Explicit<SemiImplicitEuler>;
        "leapfrog-explicit" Explicit<Leapfrog>;
        "semi-implicit-euler-joint-wise" JointWise<SemiImplicitEuler>;
        "leapfrog-joint-wise" JointWise<Leapfrog>;
    }
    // The README has its size.
    step!(keep, "four-bar" Alone<FourBarF64, Pefrl>, "pefrl" Pefrl, "f64");
    every_kind! {
        "dbd" Dbd;
        "dbd-p1" DbdP1;
        "dbd-p2" DbdP2;
        "semi-implicit-euler" SemiImplicitEuler;
        "leapfrog" Leapfrog;
        "pefrl" Pefrl;
        "blanes-moan-s6" BlanesMoanS6;
        "rk4" Rk4;
        "semi-implicit-euler-explicit" Explicit<SemiImplicitEuler>;
        "leapfrog-explicit" Explicit<Leapfrog>;
        "semi-implicit-euler-joint-wise" JointWise<SemiImplicitEuler>;
        "leapfrog-joint-wise" JointWise<Leapfrog>;
    }
}
