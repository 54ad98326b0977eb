//! The element types of lanes, and the batches of each.
//!
//! `(instruction set, plants) => batch`.

use dbd_kernel::Real;
use dbd_kernel::lanes::{self, Named};

use crate::batch::{Batch, Members, PlantOf};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;

/// A number that has registers: `f64` and `f32`.
pub trait Number: Real + Named + sealed::Batches {
    /// Number of instances in lockstep.
    fn lanes(set: InstructionSet) -> usize;
}

pub(crate) mod sealed {
    use super::{Batch, InLanes, InstructionSet, PlantOf};

    /// Crate-internal operations of a number.
    pub trait Batches: super::Real + super::Named {
        /// A batch of plants.
        #[allow(private_interfaces)]
        fn batch<S: InLanes + Send + 'static>(
            set: InstructionSet,
            plants: Vec<PlantOf<Self, S>>,
        ) -> Box<dyn Batch<Self, S>>;
    }
}

macro_rules! number {
    ($number:ty, $array:ident, $narrow:ident, $wide:ident) => {
        impl Number for $number {
            fn lanes(set: InstructionSet) -> usize {
                use lanes::Register as _;
                match set {
                    InstructionSet::Baseline => lanes::$array::LANES,
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => lanes::$narrow::LANES,
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => lanes::$wide::LANES,
                    #[cfg(not(target_arch = "x86_64"))]
                    InstructionSet::Avx2 | InstructionSet::Avx512 => lanes::$array::LANES,
                }
            }
        }

        impl sealed::Batches for $number {
            #[allow(private_interfaces)]
            fn batch<S: InLanes + Send + 'static>(
                set: InstructionSet,
                plants: Vec<PlantOf<Self, S>>,
            ) -> Box<dyn Batch<Self, S>> {
                match set {
                    InstructionSet::Baseline => Box::new(Members::<lanes::$array, S>::new(plants)),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => Box::new(Members::<lanes::$narrow, S>::new(plants)),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => Box::new(Members::<lanes::$wide, S>::new(plants)),
                    #[cfg(not(target_arch = "x86_64"))]
                    InstructionSet::Avx2 | InstructionSet::Avx512 => {
                        Box::new(Members::<lanes::$array, S>::new(plants))
                    }
                }
            }
        }
    };
}

number!(f64, Doubles, Doubles256, Doubles512);
number!(f32, Singles, Singles256, Singles512);
