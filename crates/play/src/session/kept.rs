//! Saved states of a session.

use std::collections::VecDeque;

use crate::session::asked::Change;

/// A saved state.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub(super) time: f64,
    pub(super) asked: Change,
    pub(super) snapshot: Vec<u8>,
    pub(super) disturbed: bool,
    pub(super) work: f64,
    pub(super) inputs_set: usize,
}

/// Saved states, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct Marks(pub(super) VecDeque<Mark>);
