//! What a target is: a function of bytes that may refuse them, but never fails otherwise.

use fastrand::Rng;

/// How far an input came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// It was refused, as it may be.
    Refused,
    /// It was taken.
    Taken,
    /// It was not tried: it would rightly take too long.
    Skipped,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is the same in all findings of one fault: the place of a panic, what was promised.
    pub key: String,
    /// The whole message.
    pub message: String,
}

impl Finding {
    /// A broken promise with what shows it.
    #[must_use]
    pub fn new(promise: &str, shown: impl std::fmt::Display) -> Self {
        Self { key: promise.to_owned(), message: format!("{promise}: {shown}") }
    }

    /// [`Self::new`], where something does not hold.
    ///
    /// # Errors
    /// The finding, where `holds` is false.
    pub fn unless(
        holds: bool,
        promise: &str,
        shown: impl FnOnce() -> String,
    ) -> Result<(), Finding> {
        if holds { Ok(()) } else { Err(Self::new(promise, shown())) }
    }
}

/// Something that takes input.
pub trait Target: Sync {
    /// The name by which a campaign calls it.
    fn name(&self) -> &'static str;

    /// Its share of a campaign's time among the others.
    fn share(&self) -> f64;

    /// Inputs of one block: about a second's.
    fn block(&self) -> u64;

    /// The next input of a seeded source.
    fn input(&self, random: &mut Rng) -> Vec<u8>;

    /// Takes an input.
    ///
    /// # Errors
    /// The first promise that it breaks; a panic is one, too, and is left to the caller.
    fn execute(&self, input: &[u8]) -> Result<Reach, Finding>;

    /// An input as people read it.
    fn shown(&self, input: &[u8]) -> String {
        String::from_utf8_lossy(input).into_owned()
    }
}
