//! Moments that a session keeps.

use std::collections::VecDeque;

use crate::session::asked::Change;

/// A state that was kept.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub(super) time: f64,
    pub(super) asked: Change,
    pub(super) snapshot: Vec<u8>,
    pub(super) disturbed: bool,
    pub(super) work: f64,
    pub(super) inputs_set: usize,
}

/// Those that are kept, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct Marks(pub(super) VecDeque<Mark>);
