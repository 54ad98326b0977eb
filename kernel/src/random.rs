//! Random numbers for sensors: a separate stream for each, the same bits on every machine.
//!
//! `(seed, name, lane) => stream of normal numbers`. The generator is xoshiro128++ (Blackman & Vigna, ACM Trans. Math.
//! Softw. 47, 2021), whose 32-bit words suit a Cortex-M. Its state is derived by SplitMix64 (Steele, Lea & Flood, OOPSLA
//! 2014) from a hash of seed, name and lane, so that adding a sensor does not change the others. A normal number is the
//! sum of twelve 16-bit uniform ones minus its mean (Irwin-Hall): deviation √(1 − 2⁻³²), mean 0, within ±6, excess
//! kurtosis −0.1; exact in both precisions.

use crate::real::{Constant, Real};
use crate::words::{Fnv1a, Word, WordSource, WordVisitor, Words};

/// A stream of random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stream([u32; 4]);

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
        Self::of(hash.finish())
    }

    /// The stream of a number.
    #[must_use]
    pub fn of(seed: u64) -> Self {
        let [first, second] = [1, 2].map(|step: u64| split_mix(seed, step));
        Self([first as u32, (first >> 32) as u32, second as u32, (second >> 32) as u32])
    }

    /// The next 32 random bits.
    #[inline]
    pub fn bits(&mut self) -> u32 {
        let [a, b, c, d] = self.0;
        let result = a.wrapping_add(d).rotate_left(7).wrapping_add(a);
        let (c, d) = (c ^ a, d ^ b);
        self.0 = [a ^ d, b ^ c, c ^ (b << 9), d.rotate_left(11)];
        result
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

const TO_ONE: Constant = Constant::new(1.0 / 65_536.0);

/// Output `step`, from 1, of SplitMix64.
fn split_mix(seed: u64, step: u64) -> u64 {
    let z = seed.wrapping_add(step.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Words for Stream {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.0.iter().for_each(|word| visitor.word(Word::I32(*word as i32)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.0.iter_mut().for_each(|word| *word = source.take(4) as u32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first outputs of the authors' C programs: `splitmix64.c` from 0, `xoshiro128plusplus.c` from 1, 2, 3, 4.
    #[test]
    fn the_generators_are_those_of_their_authors() {
        assert_eq!(
            [1, 2].map(|step| split_mix(0, step)),
            [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4]
        );
        let mut stream = Stream([1, 2, 3, 4]);
        let first = [(); 8].map(|()| stream.bits());
        let expected = [
            641,
            1_573_767,
            3_222_811_527,
            3_517_856_514,
            836_907_274,
            4_247_214_768,
            3_867_114_732,
            1_355_841_295,
        ];
        assert_eq!(first, expected);
    }
}
