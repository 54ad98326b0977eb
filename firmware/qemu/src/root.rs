//! Square roots in single precision, as the machine at hand takes them.
//!
//! `() => line "root INPUTS inputs, WRONG wrong"`. Every significand with an even and an odd exponent,
//! which is all but the exponent itself; of every exponent, of either sign, some. What is right is told by
//! whole numbers: with x = X·4ᵏ and a root of n·2ᵏ, n² − n < X ≤ n² + n.

use dbd_kernel::Real;

use crate::say;

/// Binary digits of a stored significand.
const FRACTION: u32 = 23;
/// The exponent of 1 as it is stored.
const ONE: u32 = 127;

/// Tries them; `false` where one is wrong.
// Compiled with the program that calls it, not with the library, which the audit links too.
#[inline]
pub fn run() -> bool {
    let every = (0..2 << FRACTION).map(|i| (ONE << FRACTION) + i);
    // All 512 pairs of sign and exponent: zeros, denormals, infinities and NaNs are among them.
    let some = (0..512_u32).flat_map(|upper| {
        let spread = (0..64).map(|i: u32| i.wrapping_mul(131_101));
        let ends = [1, 2, (1 << FRACTION) - 2, (1 << FRACTION) - 1];
        spread.chain(ends).map(move |lower| upper << FRACTION | lower)
    });
    let (mut inputs, mut wrong) = (0_u32, 0_u32);
    for bits in every.chain(some) {
        let x = f32::from_bits(bits);
        inputs += 1;
        if !is_right(x, <f32 as Real>::sqrt(x)) {
            wrong += 1;
        }
    }
    say!("root {} inputs, {} wrong", inputs, wrong);
    wrong == 0
}

/// Whether this is the root.
fn is_right(x: f32, root: f32) -> bool {
    if x.is_nan() || x < 0.0 {
        return root.is_nan();
    }
    if x == 0.0 || x == f32::INFINITY {
        return root.to_bits() == x.to_bits();
    }
    if x < f32::MIN_POSITIVE {
        // By powers of two, exactly.
        return is_right(x * 16_777_216.0, root * 4_096.0);
    }
    let parts = |value: f32| {
        let bits = value.to_bits();
        let fraction = bits & ((1 << FRACTION) - 1);
        (u64::from(fraction | 1 << FRACTION), (bits >> FRACTION) as i32 - ONE as i32)
    };
    let ((m, exponent), (n, half)) = (parts(x), parts(root));
    let square = m << (FRACTION + exponent.rem_euclid(2) as u32);
    half == exponent.div_euclid(2) && n * n - n < square && square <= n * n + n
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_a_root_are_told_from_it() {
        for bits in (1..0x7f80_0000_u32).step_by(99_991) {
            let x = f32::from_bits(bits);
            let root = <f32 as Real>::sqrt(x);
            assert!(is_right(x, root), "{x:e}");
            for wrong in [root.next_up(), root.next_down(), -root, 2.0 * root, f32::NAN] {
                assert!(!is_right(x, wrong), "{x:e} {wrong:e}");
            }
        }
        assert!(!is_right(-0.0, 0.0) && !is_right(-1.0, 1.0) && is_right(f32::NAN, f32::NAN));
    }

    #[test]
    fn the_hosts_roots_are_right() {
        assert!(run());
    }
}
