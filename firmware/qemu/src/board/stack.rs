//! How deep a call reaches into the stack: paint, call, look.

/// Bytes painted below the caller; a call that reaches further is reported as this depth.
const PAINTED: usize = 64 * 1024;
/// A word that code seldom stores.
const PAINT: u32 = 0xcccc_cccc;

/// Bytes of stack below the caller that `call` used, in whole words.
// Reads and writes the unused memory below the stack pointer, which no safe code can name.
#[allow(unsafe_code)]
#[inline(never)]
pub fn depth(call: impl FnOnce()) -> usize {
    let top = cortex_m::register::msp::read() as usize;
    let bottom = top - PAINTED;
    for address in (bottom..top).step_by(4) {
        // SAFETY: the stack grows downwards from `top` and has megabytes left; no interrupt is
        // enabled, so nothing lives below `top`.
        unsafe { core::ptr::with_exposed_provenance_mut::<u32>(address).write_volatile(PAINT) }
    }
    call();
    let touched = (bottom..top).step_by(4).find(|&address| {
        // SAFETY: as above.
        let word = unsafe { core::ptr::with_exposed_provenance::<u32>(address).read_volatile() };
        word != PAINT
    });
    top - touched.unwrap_or(top)
}
