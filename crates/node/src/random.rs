//! Random numbers for sensors: a separate stream for each, the same bits on every machine.
//!
//! `(seed, name, lane) => stream of normal numbers`. The generator is xoshiro128++ (Blackman & Vigna, ACM Trans. Math.
//! Softw. 47, 2021), whose 32-bit words suit a Cortex-M. Its state is derived by SplitMix64 from a hash of seed, name
//! and lane, so that adding a sensor does not change the others. A normal number is the sum of twelve 16-bit uniform
//! ones minus its mean (Irwin-Hall): deviation √(1 − 2⁻³²), mean 0, within ±6, excess kurtosis −0.1; exact in both
//! precisions.

use dbd_kernel::Real;
use dbd_kernel::words::{Fnv1a, Word, WordVisitor};
use rand_xoshiro::Xoshiro128PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// A stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream(Xoshiro128PlusPlus);

impl Stream {
    /// The stream of a name; `lane` distinguishes the streams of one sensor: axes, noise and walk.
    #[must_use]
    pub fn new(seed: u64, name: &str, lane: u32) -> Self {
        let mut hash = Fnv1a::new();
        hash.word(Word::U64(seed));
        // Eight bytes at a time, because the hash works on words. The length distinguishes padded names.
        for bytes in name.as_bytes().chunks(8) {
            let word = bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte));
            hash.word(Word::U64(word));
        }
        hash.word(Word::U64(name.len() as u64));
        hash.word(Word::U64(u64::from(lane)));
        Self(Xoshiro128PlusPlus::seed_from_u64(hash.finish()))
    }

    /// The next 32 random bits.
    #[inline]
    pub fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// The next normal number: mean 0, deviation 1, within ±6.
    #[inline]
    pub fn normal<R: Real>(&mut self) -> R {
        let mut sum = 0;
        for _ in 0..6 {
            let bits = self.bits();
            sum += (bits & 0xffff) as i32 + (bits >> 16) as i32;
        }
        // Twelve times half of 65535; below 2^20, so no rounding.
        R::from_i32(sum - 393_210) * R::constant(TO_ONE)
    }
}

const TO_ONE: dbd_kernel::real::Constant = dbd_kernel::real::Constant::new(1.0 / 65_536.0);
