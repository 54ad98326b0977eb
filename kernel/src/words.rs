//! The state's words: one visitor lists them in order, for all code that reads bits.
//!
//! `state => words => hash | snapshot | comparison`. The hash is FNV-1a 64 (Fowler, Noll, Vo;
//! offset 0xcbf29ce484222325, prime 0x100000001b3) over the words' little-endian bytes.

/// One stored word of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Word {
    /// A single-precision number.
    F32(f32),
    /// A double-precision number.
    F64(f64),
    /// A revolution count.
    I32(i32),
    /// The step counter.
    U64(u64),
}

impl Word {
    /// The word's bits, zero-extended to 64. Every NaN has the same bits: sign and payload of a NaN differ between
    /// machines, and between builds for one machine.
    #[must_use]
    pub fn bits(self) -> u64 {
        match self {
            Word::F32(x) => u64::from(canonical_f32(x.to_bits())),
            Word::F64(x) => canonical_f64(x.to_bits()),
            Word::I32(x) => u64::from(x as u32),
            Word::U64(x) => x,
        }
    }

    /// The number of bytes the word is stored in: 4 or 8.
    #[must_use]
    pub fn size(self) -> usize {
        match self {
            Word::F32(_) | Word::I32(_) => 4,
            Word::F64(_) | Word::U64(_) => 8,
        }
    }
}

/// The bits unchanged, those of a NaN replaced by the quiet one without a payload. In integers: the target has no
/// double-precision comparison.
const fn canonical_f64(bits: u64) -> u64 {
    const INFINITY: u64 = 0x7ff << 52;
    if bits & (u64::MAX >> 1) > INFINITY { INFINITY | 1 << 51 } else { bits }
}

/// As [`canonical_f64`].
const fn canonical_f32(bits: u32) -> u32 {
    const INFINITY: u32 = 0xff << 23;
    if bits & (u32::MAX >> 1) > INFINITY { INFINITY | 1 << 22 } else { bits }
}

/// Receives words in their fixed order.
pub trait WordVisitor {
    /// Accepts the next word.
    fn word(&mut self, word: Word);
}

/// Provides words in their fixed order.
pub trait WordSource {
    /// The bits of the next word of `size` bytes, zero-extended to 64.
    fn take(&mut self, size: usize) -> u64;
}

/// A value made of words in a fixed order.
pub trait Words {
    /// Passes every word to the visitor, in the order that is part of the interface.
    fn visit(&self, visitor: &mut impl WordVisitor);
    /// Reads every word from the source, in the same order.
    fn fill(&mut self, source: &mut impl WordSource);
}

/// FNV-1a 64 over the little-endian bytes of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Fnv1a(u64);

impl Fnv1a {
    /// The hash of the empty input.
    #[must_use]
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// The hash of the words visited so far.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }
}

impl Default for Fnv1a {
    fn default() -> Self {
        Self::new()
    }
}

impl WordVisitor for Fnv1a {
    fn word(&mut self, word: Word) {
        let mut bits = word.bits();
        for _ in 0..word.size() {
            self.0 = (self.0 ^ (bits & 0xff)).wrapping_mul(0x0000_0100_0000_01b3);
            bits >>= 8;
        }
    }
}

/// Whether every number visited so far is finite.
pub(crate) struct Finite(pub(crate) bool);

impl WordVisitor for Finite {
    fn word(&mut self, word: Word) {
        self.0 &= match word {
            Word::F32(x) => x.is_finite(),
            Word::F64(x) => x.is_finite(),
            Word::I32(_) | Word::U64(_) => true,
        };
    }
}

/// Accumulators that detect numbers that are not finite.
pub(crate) struct Sums {
    /// The sum of products of two single-precision numbers each; a number that is not finite makes the sum not finite:
    /// two numbers per operation.
    products: f32,
    /// The number that waits for its second factor.
    waiting: Option<f32>,
    /// The highest bit is set by an exponent of ones, the mark of a number that is not finite, in the upper halves of
    /// double-precision numbers: in integers, because the target adds double precision in software.
    double: u32,
}

impl Sums {
    pub(crate) const ZERO: Self = Self { products: 0.0, waiting: None, double: 0 };

    /// Ends a body: the next begins a new product, so that the compiler knows whether a number waits.
    #[inline(always)]
    pub(crate) fn end(&mut self) {
        if let Some(x) = self.waiting.take() {
            self.products += x;
        }
    }

    /// Whether every double-precision number was finite.
    #[inline(always)]
    pub(crate) fn are_finite(&self) -> bool {
        self.double >> 31 == 0
    }

    /// 0 where every single-precision number until an end was certainly finite, else NaN: products and sums of finite
    /// numbers may overflow, too.
    // As for a spatial vector.
    #[allow(clippy::eq_op)]
    #[inline(always)]
    pub(crate) fn nought(&self) -> f32 {
        self.products - self.products
    }
}

impl WordVisitor for Sums {
    #[inline(always)]
    fn word(&mut self, word: Word) {
        match word {
            Word::F32(x) => match self.waiting.take() {
                Some(other) => self.products += other * x,
                None => self.waiting = Some(x),
            },
            Word::F64(x) => {
                let upper = (x.to_bits() >> 32) as u32;
                self.double |= (upper & (u32::MAX >> 1)) + (1 << 20);
            }
            Word::I32(_) | Word::U64(_) => {}
        }
    }
}

/// Whether every number of the given words is finite.
pub(crate) fn is_finite(words: &impl Words) -> bool {
    let mut finite = Finite(true);
    words.visit(&mut finite);
    finite.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_nan_has_other_bits_than_its_own() {
        for x in [0.0, -0.0, 1.5, f64::MAX, -f64::MIN_POSITIVE, 5e-324, f64::INFINITY] {
            for x in [x, -x] {
                assert_eq!(Word::F64(x).bits(), x.to_bits());
                assert_eq!(Word::F32(x as f32).bits(), u64::from((x as f32).to_bits()));
            }
        }
        for bits in [0x7ff8_0000_0000_0000, 0xfff8_0000_0000_0000, 0x7ff0_0000_0000_0001, u64::MAX]
        {
            assert_eq!(Word::F64(f64::from_bits(bits)).bits(), 0x7ff8_0000_0000_0000);
        }
        for bits in [0x7fc0_0000, 0xffc0_0000, 0x7f80_0001, u32::MAX] {
            assert_eq!(Word::F32(f32::from_bits(bits)).bits(), 0x7fc0_0000);
        }
    }

    #[test]
    fn words_are_finite_where_every_number_is() {
        use crate::vector::Vec3;
        let most = [0.0, -0.0, 5e-324, f64::MIN_POSITIVE, 1.0, f64::MAX, f64::MIN];
        for x in most {
            assert!(is_finite(&Vec3::new(x, x, x)), "{x:e}");
        }
        for x in [f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e-45, -0.0] {
            assert!(is_finite(&Vec3::new(x, x, x)), "{x:e}");
        }
        let lowest = f64::from_bits(0x7ff0_0000_0000_0001);
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::NAN, lowest] {
            for row in 0..3 {
                let mut double = [1.0; 3];
                double[row] = x;
                let [a, b, c] = double;
                assert!(!is_finite(&Vec3::new(a, b, c)), "{x}");
                assert!(!is_finite(&Vec3::new(a as f32, b as f32, c as f32)), "{x}");
            }
        }
        let opposite = [f32::INFINITY, f32::NEG_INFINITY];
        assert!(!is_finite(&Vec3::new(opposite[0], opposite[1], 0.0)));
    }

    #[test]
    fn sums_are_finite_of_nothing_that_is_not() {
        use crate::vector::Vec3;
        let are_finite = |words: &dyn Fn(&mut Sums)| {
            let mut sums = Sums::ZERO;
            words(&mut sums);
            sums.end();
            sums.are_finite() && sums.nought() == 0.0
        };
        for x in [0.0, -0.0, 5e-324, 1.0, f64::MAX, f64::MIN] {
            assert!(are_finite(&|sums| Vec3::new(x, x, x).visit(sums)), "{x:e}");
        }
        let lowest = f64::from_bits(0x7ff0_0000_0000_0001);
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::NAN, lowest] {
            for row in 0..3 {
                let mut double = [1.0; 3];
                double[row] = x;
                let v = Vec3::<f64>::from_f64(double);
                assert!(!are_finite(&|sums| v.visit(sums)), "{x}");
                let v = Vec3::<f32>::from_f64(double);
                assert!(!are_finite(&|sums| v.visit(sums)), "{x}");
            }
        }
        let infinity = f32::INFINITY;
        for (x, y, z) in [(infinity, -infinity, 0.0), (0.0, infinity, 0.0), (0.0, 0.0, -infinity)] {
            assert!(!are_finite(&|sums| Vec3::new(x, y, z).visit(sums)));
        }
        assert!(are_finite(&|sums| Vec3::new(1e19_f32, -1e19, f32::MAX).visit(sums)));
    }

    #[test]
    fn hash_is_fnv1a_over_little_endian_bytes() {
        // The published vector: FNV-1a 64 of "foobar" is 0x85944171f73967e8; its first four
        // bytes form one 32-bit word, the rest is checked by the byte loop written out here.
        let mut reference = 0xcbf2_9ce4_8422_2325_u64;
        for byte in *b"foobarba" {
            reference = (reference ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        let mut hash = Fnv1a::new();
        hash.word(Word::U64(u64::from_le_bytes(*b"foobarba")));
        assert_eq!(hash.finish(), reference);
        let mut halves = Fnv1a::new();
        halves.word(Word::I32(i32::from_le_bytes(*b"foob")));
        halves.word(Word::I32(i32::from_le_bytes(*b"arba")));
        assert_eq!(halves.finish(), reference);
        let mut six = 0xcbf2_9ce4_8422_2325_u64;
        for byte in *b"foobar" {
            six = (six ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        assert_eq!(six, 0x8594_4171_f739_67e8);
    }
}
