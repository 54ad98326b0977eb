//! The correctly rounded square root: the FPU's where it has one, pure Rust elsewhere.
//!
//! IEEE 754 rounds the root correctly, so the bits are the same either way. `core` has no root; libm's is a hundred
//! instructions or more on microcontrollers, whose FPUs need one. The ABI of a Cortex-M tells of an FPU of single
//! precision; the feature `fpu` of what no stable `cfg` tells: of double precision there, and of any on RISC-V.
//! WebAssembly has an instruction for both, which only `std` exposes. On x86-64 the compiler orders and pairs intrinsics
//! as it cannot libm's assembly, which is of SSE besides and waits for the upper halves of AVX registers.

/// √x in double precision.
#[cfg(not(any(
    all(feature = "fpu", target_arch = "arm", target_os = "none", target_abi = "eabihf"),
    all(target_arch = "x86_64", target_feature = "sse2")
)))]
#[inline(always)]
pub fn sqrt_f64(x: f64) -> f64 {
    #[cfg(target_family = "wasm")]
    return x.sqrt();
    #[cfg(not(target_family = "wasm"))]
    libm::sqrt(x)
}

/// √x in double precision, by SQRTSD.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code)]
#[inline(always)]
pub fn sqrt_f64(x: f64) -> f64 {
    use core::arch::x86_64::{_mm_cvtsd_f64, _mm_set_sd, _mm_sqrt_sd};
    // SAFETY: the target has SSE2.
    unsafe { _mm_cvtsd_f64(_mm_sqrt_sd(_mm_set_sd(x), _mm_set_sd(x))) }
}

/// √x in double precision, by VSQRT of an FPU that has it, as a Cortex-M7's.
#[cfg(all(feature = "fpu", target_arch = "arm", target_os = "none", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
pub fn sqrt_f64(x: f64) -> f64 {
    let bits = x.to_bits();
    let (low, high): (u32, u32);
    // SAFETY: the instructions read and write the named registers only, touch no memory and no condition flags.
    unsafe {
        core::arch::asm!(
            "vmov d0, {low}, {high}",
            // VSQRT.F64 d0, d0, by its code: the assembler takes the name only where the compiler's target has it.
            ".inst.w 0xeeb10bc0",
            "vmov {low}, {high}, d0",
            low = inlateout(reg) bits as u32 => low,
            high = inlateout(reg) (bits >> 32) as u32 => high,
            out("d0") _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f64::from_bits(u64::from(high) << 32 | u64::from(low))
}

/// √x in single precision.
#[cfg(not(any(
    all(target_arch = "arm", target_os = "none", target_abi = "eabihf"),
    all(feature = "fpu", target_arch = "riscv32"),
    all(target_arch = "x86_64", target_feature = "sse2")
)))]
#[inline(always)]
pub fn sqrt_f32(x: f32) -> f32 {
    #[cfg(target_family = "wasm")]
    return x.sqrt();
    #[cfg(not(target_family = "wasm"))]
    libm::sqrtf(x)
}

/// √x in single precision, by SQRTSS.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code)]
#[inline(always)]
pub fn sqrt_f32(x: f32) -> f32 {
    use core::arch::x86_64::{_mm_cvtss_f32, _mm_set_ss, _mm_sqrt_ss};
    // SAFETY: the target has SSE.
    unsafe { _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x))) }
}

/// √x in single precision, by FSQRT.S.
#[cfg(all(feature = "fpu", target_arch = "riscv32"))]
#[allow(unsafe_code)]
#[inline(always)]
pub fn sqrt_f32(x: f32) -> f32 {
    let root: f32;
    // SAFETY: the instruction reads and writes the named registers only and touches no memory.
    unsafe {
        core::arch::asm!(
            "fsqrt.s {root}, {x}",
            x = in(freg) x,
            root = lateout(freg) root,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    root
}

/// √x in single precision, by VSQRT: the hard-float ABI implies the FPU.
// `s0` is named and passed through a core register because stable Rust refuses the register
// class `sreg` on this target; a function would cost a call and the spilling of every caller-saved
// register of the FPU: see `roots_apart_f32` for where there is nothing to spill.
#[cfg(all(target_arch = "arm", target_os = "none", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
pub fn sqrt_f32(x: f32) -> f32 {
    let root: u32;
    // SAFETY: the instructions read and write the named registers only, touch no memory and no
    // condition flags.
    unsafe {
        core::arch::asm!(
            "vmov s0, {x}",
            "vsqrt.f32 s0, s0",
            "vmov {x}, s0",
            x = inlateout(reg) x.to_bits() => root,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f32::from_bits(root)
}

/// Several roots in single precision: two registers are transferred by one instruction.
#[inline(always)]
pub fn roots_f32<const N: usize>(mut values: [f32; N]) -> [f32; N] {
    let (pairs, rest) = values.as_chunks_mut();
    for pair in pairs {
        *pair = roots_of_pair(*pair);
    }
    for value in rest {
        *value = sqrt_f32(*value);
    }
    values
}

#[cfg(not(all(target_arch = "arm", target_os = "none", target_abi = "eabihf")))]
#[inline(always)]
fn roots_of_pair(pair: [f32; 2]) -> [f32; 2] {
    pair.map(sqrt_f32)
}

#[cfg(all(target_arch = "arm", target_os = "none", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
fn roots_of_pair([a, b]: [f32; 2]) -> [f32; 2] {
    let (root_a, root_b): (u32, u32);
    // SAFETY: as above. It touches no memory, but is not declared so, which keeps later loads behind it: the registers
    // could not hold the data of the next springs.
    unsafe {
        core::arch::asm!(
            "vmov s0, s1, {a}, {b}",
            "vsqrt.f32 s0, s0",
            "vsqrt.f32 s1, s1",
            "vmov {a}, {b}, s0, s1",
            a = inlateout(reg) a.to_bits() => root_a,
            b = inlateout(reg) b.to_bits() => root_b,
            out("s0") _,
            out("s1") _,
            options(nostack, preserves_flags),
        );
    }
    [f32::from_bits(root_a), f32::from_bits(root_b)]
}

/// [`roots_f32`] where so few other values are live that the call-preserved registers suffice: a call passes numbers in
/// FPU registers, without core registers.
#[cfg(not(all(target_arch = "arm", target_os = "none", target_abi = "eabihf")))]
#[inline(always)]
pub fn roots_apart_f32<const N: usize>(values: [f32; N]) -> [f32; N] {
    roots_f32(values)
}

#[cfg(all(target_arch = "arm", target_os = "none", target_abi = "eabihf"))]
pub use call::roots_apart_f32;

/// Roots by a function call.
#[cfg(all(target_arch = "arm", target_os = "none", target_abi = "eabihf"))]
mod call {
    #[repr(C)]
    struct Pair(f32, f32);

    // SAFETY: by the hard-float ABI two numbers are passed and returned in `s0` and `s1`, the only registers that it
    // writes. The target's FPU is enabled in functions only, hence the first line.
    #[allow(unsafe_code)]
    #[unsafe(naked)]
    extern "C" fn roots_of_pair(_: f32, _: f32) -> Pair {
        core::arch::naked_asm!(".fpu fpv4-sp-d16", "vsqrt.f32 s0, s0", "vsqrt.f32 s1, s1", "bx lr")
    }

    #[inline(always)]
    pub fn roots_apart_f32<const N: usize>(mut values: [f32; N]) -> [f32; N] {
        let (pairs, rest) = values.as_chunks_mut();
        for pair in pairs {
            let Pair(a, b) = roots_of_pair(pair[0], pair[1]);
            *pair = [a, b];
        }
        for value in rest {
            *value = super::sqrt_f32(*value);
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_correctly_rounded() {
        // For a correctly rounded root r of x, r·r in twice the precision is within r·ulp of x.
        let mut x = 1.0e-30_f32;
        while x < 1.0e30 {
            let r = sqrt_f32(x);
            let exact = sqrt_f64(f64::from(x));
            assert_eq!(r, exact as f32, "{x:e}");
            let roots = [r, core::f32::consts::SQRT_2, r];
            assert_eq!([roots_f32([x, 2.0, x]), roots_apart_f32([x, 2.0, x])], [roots; 2]);
            x *= 1.37;
        }
        assert_eq!(sqrt_f64(2.0), core::f64::consts::SQRT_2);
        assert!(sqrt_f32(-1.0).is_nan() && sqrt_f64(0.0) == 0.0);
    }
}
