//! The roots of the audit: `step` of every shipped model, linked alone.
//!
//! Never run. Linked without start-up code and with the linker's garbage collection, so that
//! what the image holds is what the steps reach. Each `plant-*` feature adds one fault that the
//! audit must find.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod roots {
    use dbd_kernel::{Dbd, Leapfrog, Plant, Status};
    use firmware::models::*;

    macro_rules! roots {
        ($($module:ident $scene:literal $step:literal, $f64:ident: $m64:ident, $f32:ident: $m32:ident;)*) => {
            $(mod $module {
                use super::*;
                root!(dbd_f64, $m64, Dbd);
                root!(leapfrog_f64, $m64, Leapfrog);
                root!(dbd_f32, $m32, Dbd);
                root!(leapfrog_f32, $m32, Leapfrog);
            })*
            static ROOTS: Roots = ($((
                $module::dbd_f64,
                $module::leapfrog_f64,
                $module::dbd_f32,
                $module::leapfrog_f32,
            ),)*);
            type Roots = ($((Root<$m64, Dbd>, Root<$m64, Leapfrog>, Root<$m32, Dbd>, Root<$m32, Leapfrog>),)*);
        };
    }
    macro_rules! root {
        ($name:ident, $model:ty, $scheme:ty) => {
            #[inline(never)]
            pub fn $name(plant: &mut Plant<'static, $model, $scheme>) -> Status {
                plant.step()
            }
        };
    }
    type Root<M, S> = fn(&mut Plant<'static, M, S>) -> Status;
    firmware::shipped!(roots);

    /// Where the linker starts to look.
    // The linker finds the entry by this name, and the image has no other symbol of it.
    #[allow(unsafe_code)]
    #[unsafe(no_mangle)]
    extern "C" fn audit_roots() -> *const u8 {
        core::ptr::addr_of!(ROOTS).cast()
    }
}

#[cfg(not(target_os = "none"))]
fn main() {}
