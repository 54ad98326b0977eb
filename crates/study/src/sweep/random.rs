//! Seeded samples: each axis its own stream, the same on every machine and in every version.
//!
//! `(seed, path, count) => fractions, 0 to 1`. The generator is xoshiro256++ (Blackman & Vigna, ACM
//! Trans. Math. Softw. 47, 2021), its state by SplitMix64 from a hash of seed and path: an additional axis does not
//! change the values of others, and a random sample extends a shorter one. A Latin hypercube (McKay, Beckman & Conover,
//! Technometrics 21, 1979) puts one value into each of as many equal parts of an axis as there are cases, parts in
//! random order.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use crate::sweep::key::Digest;

/// How the cases of a sample lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    /// Each value by itself, even over the axis.
    Random,
    /// One value in each of as many parts of an axis as there are cases.
    LatinHypercube,
}

/// A requested sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// How its cases lie.
    pub kind: SampleKind,
    /// How many there are.
    pub count: usize,
    /// Its seed.
    pub seed: u64,
}

/// The generator of an axis.
fn stream(seed: u64, path: &str) -> Xoshiro256PlusPlus {
    let hash = Digest::new().with(&seed.to_string()).with(path);
    // The halves of a hash of 128 bits, so that all of it counts.
    let bits = hash.bits();
    Xoshiro256PlusPlus::seed_from_u64((bits >> 64) as u64 ^ bits as u64)
}

/// Even over 0 to 1, 1 not among them: multiples of 2⁻⁵³.
fn even(random: &mut Xoshiro256PlusPlus) -> f64 {
    (random.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// Uniform over the integers below `end`: biased draws are repeated.
fn below(random: &mut Xoshiro256PlusPlus, end: u64) -> u64 {
    let unfair = u64::MAX - u64::MAX % end;
    loop {
        let bits = random.next_u64();
        if bits < unfair {
            return bits % end;
        }
    }
}

impl Sample {
    /// The fractions of an axis in the order of the cases.
    #[must_use]
    pub fn shares(&self, path: &str) -> Vec<f64> {
        let mut random = stream(self.seed, path);
        if self.kind == SampleKind::Random {
            return (0..self.count).map(|_| even(&mut random)).collect();
        }
        let mut parts: Vec<usize> = (0..self.count).collect();
        // Fisher & Yates.
        for last in (1..self.count).rev() {
            let other = below(&mut random, last as u64 + 1);
            parts.swap(last, other as usize);
        }
        let within = |part: usize| (part as f64 + even(&mut random)) / self.count as f64;
        parts.into_iter().map(within).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(kind: SampleKind, count: usize) -> Sample {
        Sample { kind, count, seed: 7 }
    }

    #[test]
    fn a_longer_sample_goes_on_and_another_axis_is_another() {
        let few = sample(SampleKind::Random, 5).shares("a");
        let many = sample(SampleKind::Random, 1000).shares("a");
        assert_eq!(few[..], many[..5]);
        assert!(many.iter().all(|share| (0.0..1.0).contains(share)));
        let mean = many.iter().sum::<f64>() / 1000.0;
        assert!((mean - 0.5).abs() < 0.03, "{mean}");
        assert_ne!(few, sample(SampleKind::Random, 5).shares("b"));
        assert_ne!(few, Sample { seed: 8, ..sample(SampleKind::Random, 5) }.shares("a"));
    }

    #[test]
    fn each_part_of_an_axis_has_one_value_of_a_hypercube() {
        for count in [1, 2, 100] {
            let shares = sample(SampleKind::LatinHypercube, count).shares("a");
            let mut parts: Vec<usize> =
                shares.iter().map(|share| (share * count as f64) as usize).collect();
            assert!(count < 100 || !parts.is_sorted());
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..count));
        }
    }
}
