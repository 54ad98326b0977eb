//! The roots of the audit: `step` of every shipped model, linked alone.
//!
//! Never run. Linked without start-up code and with the linker's garbage collection, so that
//! what the image holds is what the steps reach. Each `plant-*` feature adds one fault that the
//! audit must find.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod roots {
    use dbd_kernel::{Dbd, Leapfrog, Plant, Status};
    use firmware::models;

    /// One function per combination, named `roots::SCENE::SCHEME_PRECISION`.
    macro_rules! roots {
        ($($module:ident $scene:literal $step:ident,
            $f32:ident: $model32:ident, $f64:ident: $model64:ident;)*) => {
            $(mod $module {
                use super::*;
                use models::$module::{$model32, $model64};
                root!(leapfrog_f32, $model32, Leapfrog, plant::into_f32());
                root!(dbd_f32, $model32, Dbd, plant::into_f32());
                root!(leapfrog_f64, $model64, Leapfrog, ());
                root!(dbd_f64, $model64, Dbd, ());
                pub static STEPS: (
                    Root<$model32, Leapfrog>,
                    Root<$model32, Dbd>,
                    Root<$model64, Leapfrog>,
                    Root<$model64, Dbd>,
                ) = (leapfrog_f32, dbd_f32, leapfrog_f64, dbd_f64);
            })*

            firmware::shipped_f32!(roots_f32);

            /// Where the linker starts to look.
            // The linker finds the entry by this name; the image has no other symbol of it.
            #[allow(unsafe_code)]
            #[unsafe(no_mangle)]
            extern "C" fn audit_roots(keep: extern "C" fn(*const u8)) {
                $(keep((&raw const $module::STEPS).cast());)*
                keep((&raw const STEPS_F32).cast());
            }
        };
    }
    macro_rules! roots_f32 {
        ($($module:ident $scene:literal $step:ident, $f32:ident: $model32:ident;)*) => {
            $(mod $module {
                use super::*;
                use models::$module::$model32;
                root!(leapfrog_f32, $model32, Leapfrog, ());
                pub type Step = Root<$model32, Leapfrog>;
                pub const STEP: Step = leapfrog_f32;
            })*
            static STEPS_F32: ($($module::Step,)*) = ($($module::STEP,)*);
        };
    }
    macro_rules! root {
        ($name:ident, $model:ty, $scheme:ty, $plant:expr) => {
            #[inline(never)]
            fn $name(plant: &mut Plant<&'static $model, $scheme>) -> Status {
                $plant;
                plant.step()
            }
        };
    }
    type Root<M, S> = fn(&mut Plant<&'static M, S>) -> Status;
    firmware::shipped!(roots);

    /// Linked only where a step can panic.
    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        loop {}
    }

    /// The planted faults.
    mod plant {
        #[inline(always)]
        pub fn into_f32() {
            #[cfg(feature = "plant-panic")]
            index();
            #[cfg(feature = "plant-alloc")]
            allocation::allocate();
            #[cfg(feature = "plant-fma")]
            fuse();
            #[cfg(feature = "plant-soft-float")]
            soften();
        }

        /// A slice's index that may be out of bounds.
        #[cfg(feature = "plant-panic")]
        fn index() {
            use core::hint::black_box;
            black_box(black_box(&[1, 2, 3][..])[black_box(4)]);
        }

        /// One instruction that rounds once for two operations.
        #[cfg(feature = "plant-fma")]
        #[allow(unsafe_code)]
        fn fuse() {
            // SAFETY: the register is declared; the image is never run.
            unsafe { core::arch::asm!("vfma.f32 s0, s0, s0", out("s0") _) }
        }

        /// Double precision, which this core computes in software.
        #[cfg(feature = "plant-soft-float")]
        fn soften() {
            use core::hint::black_box;
            black_box(f64::from(black_box(1.0_f32)) * black_box(3.0));
        }

        #[cfg(feature = "plant-alloc")]
        mod allocation {
            extern crate alloc;

            use core::alloc::{GlobalAlloc, Layout};

            struct Nothing;

            // The trait is unsafe to implement; handing out nothing is always sound.
            #[allow(unsafe_code)]
            unsafe impl GlobalAlloc for Nothing {
                #[inline(never)]
                unsafe fn alloc(&self, _: Layout) -> *mut u8 {
                    core::hint::black_box(core::ptr::null_mut())
                }
                unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
            }

            #[global_allocator]
            static NOTHING: Nothing = Nothing;

            pub fn allocate() {
                core::hint::black_box(alloc::boxed::Box::new(1_u32));
            }
        }
    }
}

#[cfg(not(target_os = "none"))]
fn main() {}
