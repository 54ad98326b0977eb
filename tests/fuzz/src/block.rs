//! Inputs in numbered blocks: a block is made again from its number.

use fastrand::Rng;

use crate::scene::fnv;
use crate::target::Target;

/// The inputs of a block of a target.
pub fn inputs(target: &dyn Target, seed: u64, block: u64) -> impl Iterator<Item = Vec<u8>> + '_ {
    let name = fnv(target.name().as_bytes());
    // Far apart whatever seeds and numbers are chosen: the generator mixes what it begins with.
    let begin = fnv(&[seed.to_le_bytes(), name.to_le_bytes(), block.to_le_bytes()].concat());
    let mut random = Rng::with_seed(begin);
    (0..target.block()).map(move |_| target.input(&mut random))
}

/// The file's name of an input.
#[must_use]
pub fn file_name(target: &dyn Target, input: &[u8]) -> String {
    format!("{}-{:016x}", target.name(), fnv(input))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::targets;

    #[test]
    fn a_block_is_made_again_and_no_other_is_like_it() {
        for target in targets::ALL {
            let block =
                |seed, number| -> Vec<Vec<u8>> { inputs(target, seed, number).take(20).collect() };
            assert_eq!(block(1, 2), block(1, 2), "{}", target.name());
            assert_ne!(block(1, 2), block(1, 3), "{}", target.name());
            assert_ne!(block(1, 2), block(2, 2), "{}", target.name());
        }
    }
}
