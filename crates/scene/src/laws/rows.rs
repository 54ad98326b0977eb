//! The rows of a law in one precision; their memories are stored as words.

use dbd_kernel::Geometry;
use dbd_kernel::laws::{self, Interaction, Need, Row, Several as _};
use dbd_kernel::words::{Word, WordSource, WordVisitor, Words as _};

/// A word of the same kind as another one.
pub(super) fn of_bits(like: Word, bits: u64) -> Word {
    match like {
        Word::F32(_) => Word::F32(f32::from_bits(bits as u32)),
        Word::F64(_) => Word::F64(f64::from_bits(bits)),
        Word::I32(_) => Word::I32(bits as i32),
        Word::U64(_) => Word::U64(bits),
    }
}

/// Memories in another precision: each number is converted to the kind given by `like`.
#[must_use]
pub fn convert_words(words: &[Word], like: impl Fn(f64) -> Word) -> Vec<Word> {
    let one = |word: &Word| match *word {
        Word::F32(x) => like(f64::from(x)),
        Word::F64(x) => like(x),
        other => other,
    };
    words.iter().map(one).collect()
}

/// Words as a source.
struct Stored<'w>(std::slice::Iter<'w, Word>);

impl WordSource for Stored<'_> {
    fn take(&mut self, _: usize) -> u64 {
        self.0.next().map_or(0, |word| word.bits())
    }
}

/// Words written back in place.
struct Store<'w>(std::slice::IterMut<'w, Word>);

impl WordVisitor for Store<'_> {
    fn word(&mut self, word: Word) {
        if let Some(place) = self.0.next() {
            *place = word;
        }
    }
}

/// Words in a list.
#[derive(Default)]
pub(crate) struct Listed(pub(crate) Vec<Word>);

impl WordVisitor for Listed {
    fn word(&mut self, word: Word) {
        self.0.push(word);
    }
}

/// The rows of a law in one precision.
pub(crate) trait Rows<P: Geometry>: Send + Sync {
    fn count(&self) -> usize;
    /// Dampers of a row.
    fn dampers(&self) -> usize;
    fn is_damped(&self) -> bool;
    fn is_driven(&self) -> bool;
    /// A row's memory at t = 0.
    fn initial(&self) -> Vec<Word>;
    fn memory(&self) -> Option<(&'static str, Need)>;
    /// Passes a row to `act`, which may change its memory.
    fn act(&self, row: usize, words: &mut [Word], act: &mut dyn FnMut(&mut dyn Row<P>));
}

/// The rows of `T`.
pub(super) struct Of<T>(pub(super) Vec<T>);

impl<P: Geometry, T: Interaction<P>> Rows<P> for Of<T> {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn dampers(&self) -> usize {
        T::Dampers::COUNT
    }
    fn is_damped(&self) -> bool {
        T::Dampers::COUNT > 0 && self.0.iter().any(Interaction::is_damped)
    }
    fn is_driven(&self) -> bool {
        T::DRIVEN && !self.0.is_empty()
    }
    fn initial(&self) -> Vec<Word> {
        let mut list = Listed::default();
        T::State::default().visit(&mut list);
        list.0
    }
    fn memory(&self) -> Option<(&'static str, Need)> {
        laws::memory::<P, T>(&self.0)
    }
    fn act(&self, row: usize, words: &mut [Word], act: &mut dyn FnMut(&mut dyn Row<P>)) {
        let Some(law) = self.0.get(row) else { return };
        let mut state = T::State::default();
        state.fill(&mut Stored(words.iter()));
        act(&mut laws::row(law, &mut state));
        state.visit(&mut Store(words.iter_mut()));
    }
}
