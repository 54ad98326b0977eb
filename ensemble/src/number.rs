//! The numbers that lanes are made of, and the batches of each.
//!
//! `(instruction set, plants) => batch`.

use std::num::NonZeroUsize;

use dbd_kernel::geometry::Named;
use dbd_kernel::{Leapfrog, Real};

use crate::batch::{Batch, Members, PlantOf};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::register;
use crate::rows::{InRows, Rowed};

/// A number that has registers: `f64` and `f32`.
pub trait Number: Real + Named + sealed::Batches {
    /// How many of them go in lockstep.
    fn lanes(set: InstructionSet) -> usize;
}

pub(crate) mod sealed {
    use dbd_kernel::Leapfrog;

    use super::{Batch, InLanes, InstructionSet, NonZeroUsize, PlantOf, Rowed};

    /// What only this crate does with a number.
    pub trait Batches: super::Real + super::Named {
        /// A batch of plants.
        #[allow(private_interfaces)]
        fn batch<S: InLanes + Send + 'static>(
            set: InstructionSet,
            plants: Vec<PlantOf<Self, S>>,
        ) -> Box<dyn Batch<Self, S>>;

        /// A large model's plant in rows.
        #[allow(private_interfaces)]
        fn rows(
            set: InstructionSet,
            plant: PlantOf<Self, Leapfrog>,
            threads: NonZeroUsize,
        ) -> Box<dyn Rowed<Self>>;
    }
}

macro_rules! number {
    ($number:ty, $array:ident, $narrow:ident, $wide:ident) => {
        impl Number for $number {
            fn lanes(set: InstructionSet) -> usize {
                use register::Register as _;
                match set {
                    InstructionSet::Baseline => register::$array::LANES,
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => register::$narrow::LANES,
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => register::$wide::LANES,
                    #[cfg(not(target_arch = "x86_64"))]
                    InstructionSet::Avx2 | InstructionSet::Avx512 => register::$array::LANES,
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
                    InstructionSet::Baseline => {
                        Box::new(Members::<register::$array, S>::new(plants))
                    }
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => Box::new(Members::<register::$narrow, S>::new(plants)),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => Box::new(Members::<register::$wide, S>::new(plants)),
                    #[cfg(not(target_arch = "x86_64"))]
                    InstructionSet::Avx2 | InstructionSet::Avx512 => {
                        Box::new(Members::<register::$array, S>::new(plants))
                    }
                }
            }

            #[allow(private_interfaces)]
            fn rows(
                set: InstructionSet,
                plant: PlantOf<Self, Leapfrog>,
                threads: NonZeroUsize,
            ) -> Box<dyn Rowed<Self>> {
                match set {
                    InstructionSet::Baseline => {
                        Box::new(InRows::<register::$array>::new(plant, threads))
                    }
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => {
                        Box::new(InRows::<register::$narrow>::new(plant, threads))
                    }
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => {
                        Box::new(InRows::<register::$wide>::new(plant, threads))
                    }
                    #[cfg(not(target_arch = "x86_64"))]
                    InstructionSet::Avx2 | InstructionSet::Avx512 => {
                        Box::new(InRows::<register::$array>::new(plant, threads))
                    }
                }
            }
        }
    };
}

number!(f64, Doubles, Doubles256, Doubles512);
number!(f32, Singles, Singles256, Singles512);
