//! A finding made small: pieces are left out for as long as the same fault is found.

use std::time::{Duration, Instant};

use crate::execution::execute;
use crate::target::Target;

/// No longer than this: a finding is worth more than a short one.
const LONGEST: Duration = Duration::from_secs(5);

/// The shortest input that was found to show the fault `key` of a target.
#[must_use]
pub fn shrunk(target: &dyn Target, input: &[u8], key: &str) -> Vec<u8> {
    let begun = Instant::now();
    let fails = |input: &[u8]| execute(target, input).is_err_and(|finding| finding.key == key);
    let mut best = input.to_vec();
    let mut piece = best.len().div_ceil(2);
    while piece > 0 && begun.elapsed() < LONGEST {
        let (mut from, mut shorter) = (0, false);
        while from < best.len() && begun.elapsed() < LONGEST {
            let to = best.len().min(from + piece);
            let rest = [&best[..from], &best[to..]].concat();
            if fails(&rest) {
                (best, shorter) = (rest, true);
            } else {
                from = to;
            }
        }
        if !shorter {
            piece /= 2;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::{PANIC, PlantedTarget};

    #[test]
    fn what_does_not_matter_is_left_out() {
        let input = [b"0123456789".repeat(20), PANIC.to_vec(), b"abc".repeat(33)].concat();
        let key = execute(&PlantedTarget, &input).unwrap_err().key;
        assert!(key.starts_with("panic at "), "{key}");
        assert_eq!(shrunk(&PlantedTarget, &input, &key), PANIC);
    }
}
