//! Roots `audit.planted.FAULT`: a step of the four-bar in single precision with one fault each.

use core::hint::black_box;

use dbd_kernel::{Failure, Leapfrog, Plant};
use firmware::models::four_bar::FourBarF32;

use crate::Keep;

macro_rules! planted {
    ($keep:ident: $($fault:literal $into:path;)*) => {
        $({
            #[inline(never)]
            #[unsafe(export_name = concat!("audit.planted.", $fault))]
            fn root(plant: &mut Plant<&'static FourBarF32, Leapfrog>) -> Result<(), Failure> {
                $into();
                plant.step()
            }
            $keep(root as *const ());
        })*
    };
}

pub fn keep(keep: Keep) {
    planted! { keep:
        "index" index;
        "box" allocation::allocate;
        "fused" fuse;
        "soft-float" soften;
        "pointer" indirect;
    }
}

/// A slice's index that may be out of bounds.
#[inline(always)]
fn index() {
    black_box(black_box(&[1, 2, 3][..])[black_box(4)]);
}

/// One instruction that rounds once for two operations.
#[inline(always)]
fn fuse() {
    // SAFETY: the register is declared; the image is never run.
    unsafe { core::arch::asm!("vfma.f32 s0, s0, s0", out("s0") _) }
}

/// Double precision, which this core computes in software.
#[inline(always)]
fn soften() {
    black_box(f64::from(black_box(1.0_f32)) * black_box(3.0));
}

/// A call whose destination no listing shows.
#[inline(always)]
fn indirect() {
    let call: fn() = black_box(index);
    call();
}

mod allocation {
    extern crate alloc;

    use core::alloc::{GlobalAlloc, Layout};

    struct Nothing;

    // The trait is unsafe to implement; handing out nothing is always sound.
    unsafe impl GlobalAlloc for Nothing {
        #[inline(never)]
        unsafe fn alloc(&self, _: Layout) -> *mut u8 {
            core::hint::black_box(core::ptr::null_mut())
        }
        unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
    }

    #[global_allocator]
    static NOTHING: Nothing = Nothing;

    #[inline(always)]
    pub fn allocate() {
        core::hint::black_box(alloc::boxed::Box::new(1_u32));
    }
}
