//! The rows of a law in one precision; their memories are stored as words.

use dbd_kernel::damping::Share;
use dbd_kernel::forces::Wrench;
use dbd_kernel::laws::{self, Act, DamperPass, Instant, Interaction, Need, Row, Several};
use dbd_kernel::words::{Word, WordSource, WordVisitor, Words};
use dbd_kernel::{BodyIndex, Geometry};

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

fn listed(words: &impl Words) -> Vec<Word> {
    let mut list = Listed::default();
    words.visit(&mut list);
    list.0
}

/// The rows of a law in one precision.
pub(crate) trait Rows<P: Geometry>: Send + Sync {
    fn count(&self) -> usize;
    /// Words of a row's memory.
    fn words(&self) -> usize;
    /// Dampers of a row.
    fn dampers(&self) -> usize;
    fn is_damped(&self) -> bool;
    fn is_driven(&self) -> bool;
    fn initial(&self) -> Vec<Word>;
    fn memory(&self) -> Option<(&'static str, Need)>;
    fn act(
        &self,
        at: Instant<'_, P>,
        words: &mut [Word],
        act: Act<'_, P>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize>;
    fn sweep(
        &self,
        reverse: bool,
        words: &mut [Word],
        shares: &[Share<P::Real>],
        pass: &mut dyn DamperPass<P>,
    );
    fn look(&self, row: usize, words: &[Word], look: &mut dyn FnMut(&dyn Row<P>));
    /// Replaces the memory vectors that are in the axes of a body.
    fn turn(&self, words: &mut [Word], turn: &mut dyn FnMut(BodyIndex, [f64; 3]) -> [f64; 3]);
}

/// The rows of `T`.
pub(super) struct Of<T>(pub(super) Vec<T>);

/// A row's memory.
fn state<P: Geometry, T: Interaction<P>>(words: &[Word]) -> T::State {
    let mut state = T::State::default();
    state.fill(&mut Stored(words.iter()));
    state
}

impl<P: Geometry, T: Interaction<P>> Rows<P> for Of<T> {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn words(&self) -> usize {
        if size_of::<T::State>() == 0 { 0 } else { listed(&T::State::default()).len() }
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
        listed(&T::State::default()).repeat(self.0.len())
    }
    fn memory(&self) -> Option<(&'static str, Need)> {
        laws::memory::<P, T>(&self.0)
    }
    fn act(
        &self,
        at: Instant<'_, P>,
        words: &mut [Word],
        act: Act<'_, P>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize> {
        let each = Rows::<P>::words(self);
        for (number, law) in self.0.iter().enumerate() {
            let Some(words) = words.get_mut(number * each..(number + 1) * each) else { break };
            let mut states = [state::<P, T>(words)];
            let done = laws::act(std::slice::from_ref(law), at, &mut states, act, wrenches);
            states[0].visit(&mut Store(words.iter_mut()));
            done.map_err(|_| number)?;
        }
        Ok(())
    }
    fn sweep(
        &self,
        reverse: bool,
        words: &mut [Word],
        shares: &[Share<P::Real>],
        pass: &mut dyn DamperPass<P>,
    ) {
        let (each, dampers) = (Rows::<P>::words(self), T::Dampers::COUNT);
        for number in 0..self.0.len() {
            let number = if reverse { self.0.len() - 1 - number } else { number };
            let (Some(words), Some(known)) = (
                words.get_mut(number * each..(number + 1) * each),
                shares.get(number * dampers..(number + 1) * dampers),
            ) else {
                break;
            };
            let mut shares = laws::shares_of::<P, T>(&self.0[number]);
            shares.as_mut().copy_from_slice(known);
            let mut states = [state::<P, T>(words)];
            // The words of a memory keep nothing of a pose.
            let order = [reverse, false];
            laws::sweep::<P, T>(&self.0[number..=number], order, &mut states, &[shares], pass);
            if T::INNER {
                states[0].visit(&mut Store(words.iter_mut()));
            }
        }
    }
    fn look(&self, row: usize, words: &[Word], look: &mut dyn FnMut(&dyn Row<P>)) {
        let each = Rows::<P>::words(self);
        if let (Some(law), Some(words)) = (self.0.get(row), words.get(row * each..(row + 1) * each))
        {
            let states = [state::<P, T>(words)];
            laws::look::<P, T>(std::slice::from_ref(law), 0, &states, look);
        }
    }
    fn turn(&self, words: &mut [Word], turn: &mut dyn FnMut(BodyIndex, [f64; 3]) -> [f64; 3]) {
        let each = Rows::<P>::words(self);
        for (number, law) in self.0.iter().enumerate() {
            let Some(words) = words.get_mut(number * each..(number + 1) * each) else { break };
            let mut memory = state::<P, T>(words);
            T::turn(&mut memory, &mut |end, v| turn(law.bodies()[end], v));
            memory.visit(&mut Store(words.iter_mut()));
        }
    }
}
