//! The pairs of model and scheme of a chart of speed against accuracy.
//!
//! `(models, schemes) => visitor`: what [`models::for_each`] leaves out, all schemes with the
//! paper's mechanisms and a damped one, in every precision. Each model is one [`Alone`] with its
//! scheme. A part for each image that they fill.

use dbd_kernel::model::{ModelOwner, Terms};
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, F32, JointWise, Leapfrog, Pefrl, Rk4,
    SemiImplicitEuler,
};

use crate::alone::Alone;
use crate::models::{self, Shipped, Visitor};

/// Most steps that a comparison of bits would take.
const STEPS: u64 = 1_000;

/// The kinds of element of a model in single precision.
type TermsOf<M> = <M as ModelOwner>::Terms;

/// Shows models and schemes, each scheme as `VALUE => TYPE, VARIANT;`.
macro_rules! chart {
    ($visitor:ident: $scene:literal $module:ident::$model:ident: $type:ident $step:ident,
        $($scheme:expr => $scheme_type:ty, $variant:literal;)*) => {
        $({
            static MODEL: Alone<models::$module::$type, $scheme_type> =
                Alone::new(models::$module::$model);
            $visitor.visit(Shipped {
                scene: $scene,
                model: &MODEL,
                beside: 0,
                scheme: $scheme,
                variant: $variant,
                step: models::$module::$step,
                steps: STEPS,
            });
        })*
    };
}
/// What no shipped model has: all schemes but leapfrog and, without iterations, dbd.
macro_rules! others {
    ($($of:tt)*) => {
        chart! { $($of)*,
            Dbd { newton: 1 } => Dbd, "+1";
            DbdP1 { newton: 0 } => DbdP1, "";
            DbdP2 { newton: 0 } => DbdP2, "";
            SemiImplicitEuler => SemiImplicitEuler, "";
            Pefrl => Pefrl, "";
            BlanesMoanS6 => BlanesMoanS6, "";
            Rk4 => Rk4, "";
        }
    };
}
/// What a model lacks that is shipped with leapfrog.
macro_rules! all {
    ($($of:tt)*) => {
        chart! { $($of)*, Dbd { newton: 0 } => Dbd, ""; }
        others! { $($of)* }
    };
}
/// Dampers that act explicitly where the scheme's own way is another.
macro_rules! damped {
    ($($of:tt)*) => {
        chart! { $($of)*,
            Explicit(SemiImplicitEuler) => Explicit<SemiImplicitEuler>, "-explicit";
            Explicit(Leapfrog) => Explicit<Leapfrog>, "-explicit";
            JointWise(SemiImplicitEuler) => JointWise<SemiImplicitEuler>, "-joint-wise";
        }
        joint_wise! { $($of)* }
    };
}
macro_rules! joint_wise {
    ($($of:tt)*) => {
        chart! { $($of)*, JointWise(Leapfrog) => JointWise<Leapfrog>, "-joint-wise"; }
    };
}

/// Shows the pairs in single precision, scene by scene.
pub fn for_each_single(visitor: &mut impl Visitor) {
    // Scenes shipped in both precisions have leapfrog and dbd already.
    macro_rules! shipped_in_both {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(others! { visitor: $scene $module::$f32: $model32 $step })*
        };
    }
    // Of the others, leapfrog is shipped.
    macro_rules! shipped_in_single {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(all! { visitor: $scene $module::$f32: $model32 $step })*
        };
    }
    // Other values of a scene; dampers both ways where they have any.
    macro_rules! with_other_values {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model32:ident;)*) => {
            $(
                chart! { visitor: $scene $module::$f32: $model32 $step,
                    Leapfrog => Leapfrog, "";
                    SemiImplicitEuler => SemiImplicitEuler, "";
                }
                if <TermsOf<models::$module::$model32> as Terms<F32>>::DAMPERS {
                    damped! { visitor: $scene $module::$f32: $model32 $step }
                }
            )*
        };
    }
    shipped!(shipped_in_both);
    charted!(shipped_in_single);
    varied!(with_other_values);
    damped! { visitor: "double-wishbone"
    double_wishbone::DOUBLE_WISHBONE_F32: DoubleWishboneF32 DOUBLE_WISHBONE_STEP }
    joint_wise! { visitor: "cart-pendulum"
    cart_pendulum::CART_PENDULUM_F32: CartPendulumF32 CART_PENDULUM_STEP }
    joint_wise! { visitor: "gripper" gripper::GRIPPER_F32: GripperF32 GRIPPER_STEP }
}

/// Shows the pairs in double precision, scene by scene.
pub fn for_each_double(visitor: &mut impl Visitor) {
    // Leapfrog and dbd are shipped.
    macro_rules! shipped_in_both {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(others! { visitor: $scene $module::$f64: $model64 $step })*
        };
    }
    macro_rules! shipped_in_single {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(
                chart! { visitor: $scene $module::$f64: $model64 $step, Leapfrog => Leapfrog, ""; }
                all! { visitor: $scene $module::$f64: $model64 $step }
            )*
        };
    }
    shipped!(shipped_in_both);
    charted!(shipped_in_single);
    damped! { visitor: "double-wishbone"
    double_wishbone::DOUBLE_WISHBONE_F64: DoubleWishboneF64 DOUBLE_WISHBONE_STEP }
}

/// Shows the pairs in fixed point.
pub fn for_each_fixed(visitor: &mut impl Visitor) {
    // In fixed point the paper's scheme and those that are advised; the four-bar's first two are shipped.
    macro_rules! in_fixed_point {
        ($($module:ident $scene:literal $step:ident, $fixed:ident: $model:ident;)*) => {
            $(
                if $scene != "four-bar" {
                    chart! { visitor: $scene $module::$fixed: $model $step,
                        Leapfrog => Leapfrog, "";
                        Dbd { newton: 0 } => Dbd, "";
                    }
                }
                chart! { visitor: $scene $module::$fixed: $model $step,
                    SemiImplicitEuler => SemiImplicitEuler, "";
                    Pefrl => Pefrl, "";
                    BlanesMoanS6 => BlanesMoanS6, "";
                }
            )*
        };
    }
    fixed!(in_fixed_point);
    joint_wise! { visitor: "double-wishbone"
    double_wishbone::DOUBLE_WISHBONE_FIXED: DoubleWishboneFixed DOUBLE_WISHBONE_STEP }
}

/// Shows the models with the plan of a matrix in all precisions that are counted.
pub fn for_each_solved(visitor: &mut impl Visitor) {
    macro_rules! show {
        ($($module:ident $scene:literal $step:ident,
            $constant:ident: $model:ident of $base:ident;)*) => {
            $(
                let of = (&models::$module::$constant, size_of::<models::$module::$base>());
                models::solved_by_one(visitor, $scene, of, models::$module::$step, STEPS);
            )*
        };
    }
    solved!(show);
    solved_double!(show);
    solved_fixed!(show);
    models::extrapolated(visitor, STEPS);
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use dbd_kernel::{Geometry, Plant, Scheme};

    use super::*;
    use crate::models::for_each;
    use crate::sample::for_each_sampled;

    /// What pairs are called, and whether none was called so before.
    #[derive(Default)]
    struct Names {
        seen: BTreeSet<String>,
        twice: Vec<String>,
    }

    // Their steps are taken where they are counted: here they would take minutes to compile.
    impl Visitor for Names {
        fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
            let Shipped { scene, variant, .. } = shipped;
            let name = format!("{scene} {}{variant} {}", S::NAME, M::Precision::NAME);
            if !self.seen.insert(name.clone()) {
                self.twice.push(name);
            }
        }
    }

    /// Takes some steps of each pair.
    struct Steps;

    impl Visitor for Steps {
        fn visit<M: ModelOwner, S: Scheme>(&mut self, shipped: Shipped<M, S>) {
            let mut plant = Plant::new(shipped.model, shipped.scheme, shipped.step).unwrap();
            assert!(plant.advance(5).is_ok(), "{} {}", shipped.scene, S::NAME);
        }
    }

    #[test]
    fn every_pair_of_the_sample_steps() {
        for_each_sampled(&mut Steps);
    }

    /// All pairs whose steps are counted.
    fn counted() -> Names {
        let mut names = Names::default();
        for_each(&mut names);
        for_each_single(&mut names);
        for_each_double(&mut names);
        for_each_fixed(&mut names);
        for_each_solved(&mut names);
        names
    }

    #[test]
    fn every_pair_has_a_name_and_a_row_of_its_own() {
        let names = counted();
        assert!(names.twice.is_empty(), "{:?}", names.twice);
        let costs = include_str!("../../../docs/costs.csv").lines().skip(1);
        let rows: BTreeSet<String> =
            costs.map(|row| row.split(',').take(3).collect::<Vec<_>>().join(" ")).collect();
        let differing: Vec<_> = rows.symmetric_difference(&names.seen).collect();
        assert!(differing.is_empty(), "only in docs/costs.csv or only shipped: {differing:?}");
    }

    #[test]
    fn the_sample_is_part_of_all_and_has_every_scheme() {
        let (all, mut sample) = (counted(), Names::default());
        for_each_sampled(&mut sample);
        assert!(sample.twice.is_empty(), "{:?}", sample.twice);
        assert!(sample.seen.is_subset(&all.seen), "{:?}", sample.seen.difference(&all.seen));
        let schemes = |names: &Names| -> BTreeSet<String> {
            let scheme = |name: &String| name.split(' ').nth(1).unwrap().to_owned();
            names.seen.iter().map(scheme).collect()
        };
        let missing: Vec<_> = schemes(&all).difference(&schemes(&sample)).cloned().collect();
        assert_eq!(missing, ["semi-implicit-euler-explicit", "semi-implicit-euler-joint-wise"]);
    }
}
