//! The roots of the audit: what a program calls while a model runs, linked alone.
//!
//! Never run. Linked without start-up code and with the linker's garbage collection. Each root is
//! a function with a symbol `audit.WHAT.MODEL.SCHEME.PRECISION`, from which the audit follows the
//! calls. The [`planted`] ones have a fault each, that it must find.
#![cfg_attr(target_os = "none", no_std, no_main)]

// Roots have names that the audit knows. No symbol of the image's has one of them.
#[cfg(target_os = "none")]
#[allow(unsafe_code)]
mod calls;
#[cfg(target_os = "none")]
#[allow(unsafe_code)]
mod ends;
#[cfg(target_os = "none")]
#[allow(unsafe_code)]
mod planted;
#[cfg(target_os = "none")]
#[allow(unsafe_code)]
mod steps;

/// Is handed every root: the image keeps what it is handed.
#[cfg(target_os = "none")]
type Keep = extern "C" fn(*const ());

/// Where the linker starts to look.
// The linker finds the entry by this name; the image has no other symbol of it.
#[cfg(target_os = "none")]
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
extern "C" fn audit_roots(keep: Keep) {
    steps::keep(keep);
    calls::keep(keep);
    ends::keep(keep);
    planted::keep(keep);
}

/// What a panic ends in.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[cfg(not(target_os = "none"))]
fn main() {}
