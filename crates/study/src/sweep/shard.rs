//! A shard of the cases: `3/8` is the third of eight.
//!
//! `(case, shard) => whether it contains the case`. Cases are distributed in rotation, so that shards take equally long
//! if cases grow along an axis.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// A shard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

/// Invalid text of a shard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected I/N, from 1/N to N/N, for example 3/8")]
pub struct ShardError;

impl Shard {
    /// All cases.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether a case, from 0, is of it.
    #[must_use]
    pub fn holds(self, case: usize) -> bool {
        case % self.of + 1 == self.number
    }

    /// Whether it is all cases.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.of == 1
    }

    /// Its name in names of files: `3-of-8`.
    #[must_use]
    pub fn name(self) -> String {
        format!("{}-of-{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (number, of) = text.split_once('/').ok_or(ShardError)?;
        let [number, of] = [number, of].map(|part| part.parse::<usize>().map_err(|_| ShardError));
        let (number, of) = (number?, of?);
        if (1..=of).contains(&number) { Ok(Self { number, of }) } else { Err(ShardError) }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_is_of_one_share() {
        let shards: Vec<Shard> = (1..=3).map(|i| format!("{i}/3").parse().unwrap()).collect();
        for case in 0..20 {
            assert_eq!(shards.iter().filter(|shard| shard.holds(case)).count(), 1);
        }
        assert!("1/1".parse::<Shard>().unwrap().is_whole());
        for text in ["", "0/3", "4/3", "1", "1/0", "a/b", "1/-1", "1/3/5", "1/1e3"] {
            assert_eq!(text.parse::<Shard>(), Err(ShardError), "{text}");
        }
    }
}
