//! The laws of a model whose sizes are known at run time: a list of tables, each of one law.
//!
//! `(rows in double precision) => tables in any precision`. A table is known by its functions alone, so a program
//! can have laws that it was not compiled with; each law is compiled once per precision, not once per scheme. A
//! memory is kept as its words.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;

use dbd_kernel::damping::Share;
use dbd_kernel::forces::Wrench;
use dbd_kernel::laws::{self, Act, DamperPass, FieldSink, FieldSource, Instant, Interaction, Law};
use dbd_kernel::laws::{Constants, Laws, Row, Several};
use dbd_kernel::words::{Word, WordSource, WordVisitor, Words};
use dbd_kernel::{BodyIndex, F32, F64, Fixed, Geometry, Planar32, Planar64};

/// Laws of a model on the heap.
#[derive(Clone)]
pub struct LawList<P: Geometry> {
    tables: Vec<Table<P>>,
}

/// A table in one precision, and where it is from.
#[derive(Clone)]
struct Table<P: Geometry> {
    rows: Arc<dyn Rows<P>>,
    source: Arc<dyn SourceRows>,
}

impl<P: Geometry> Default for LawList<P> {
    fn default() -> Self {
        Self { tables: Vec::new() }
    }
}

impl<P: Geometry> fmt::Debug for LawList<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tables = self.tables.iter().map(|table| (table.source.name(), table.source.words()));
        f.debug_map().entries(tables).finish()
    }
}

impl<P: Geometry> PartialEq for LawList<P> {
    fn eq(&self, other: &Self) -> bool {
        let words = |list: &Self| -> Vec<_> {
            list.tables.iter().map(|one| (one.source.name(), one.source.words())).collect()
        };
        words(self) == words(other)
    }
}

impl<P: Geometry> LawList<P> {
    /// The tables in this precision; none where their laws are not compiled for it: lanes, and precisions that
    /// exist for comparison alone.
    pub(crate) fn of(sources: &[Arc<dyn SourceRows>]) -> Self {
        let table = |source: &Arc<dyn SourceRows>| {
            let rows = source.in_precision(TypeId::of::<P>())?;
            let rows = rows.downcast::<Arc<dyn Rows<P>>>().ok()?;
            Some(Table { rows: *rows, source: source.clone() })
        };
        Self { tables: sources.iter().map(table).collect::<Option<_>>().unwrap_or_default() }
    }

    /// The same in another precision.
    pub(crate) fn convert<Q: Geometry>(&self) -> LawList<Q> {
        LawList::of(&self.sources())
    }

    /// The name of each table's law, in order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.tables.iter().map(|table| table.source.name())
    }

    pub(crate) fn sources(&self) -> Vec<Arc<dyn SourceRows>> {
        self.tables.iter().map(|table| table.source.clone()).collect()
    }

    /// The laws with the number of dampers of each row.
    pub(crate) fn tables_with_dampers(&self) -> impl Iterator<Item = (&dyn SourceRows, usize)> {
        self.tables.iter().map(|table| (&*table.source, table.rows.dampers()))
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tables.is_empty()
    }

    /// A and B of every row.
    pub fn bodies(&self) -> impl Iterator<Item = [BodyIndex; 2]> + '_ {
        self.tables.iter().flat_map(|table| table.source.bodies())
    }

    /// Table and row of a row over all tables, with where its words and its shares begin.
    fn each(&self) -> impl Iterator<Item = (&Table<P>, [usize; 3])> {
        let mut next = [0; 3];
        self.tables.iter().map(move |table| {
            let here = next;
            let rows = table.rows.count();
            next[0] += rows;
            next[1] += rows * table.rows.words();
            next[2] += rows * table.rows.dampers();
            (table, here)
        })
    }
}

impl<P: Geometry> Laws<P> for LawList<P> {
    type States = Vec<Word>;
    type Shares = Vec<Share<P::Real>>;
    const EMPTY: bool = false;
    const DAMPED: bool = true;
    const ADVANCES: bool = true;

    fn count(&self) -> usize {
        self.tables.iter().map(|table| table.rows.count()).sum()
    }
    fn is_damped(&self) -> bool {
        self.tables.iter().any(|table| table.rows.dampers() > 0)
    }
    fn is_driven(&self) -> bool {
        self.tables.iter().any(|table| table.rows.is_driven())
    }
    fn states(&self) -> Vec<Word> {
        self.tables.iter().flat_map(|table| table.rows.initial()).collect()
    }
    fn shares(&self) -> Self::Shares {
        let count = |table: &Table<P>| table.rows.count() * table.rows.dampers();
        vec![Share::ALONE; self.tables.iter().map(count).sum()]
    }
    fn act(
        &self,
        at: Instant<'_, P>,
        states: &mut Vec<Word>,
        act: Act<P::Real>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize> {
        for (table, [before, from, _]) in self.each() {
            let Some(words) = states.get_mut(from..) else { return Err(before) };
            table.rows.act(at, words, act, wrenches).map_err(|row| before + row)?;
        }
        Ok(())
    }
    fn sweep(
        &self,
        reverse: bool,
        states: &Vec<Word>,
        shares: &Self::Shares,
        pass: &mut dyn DamperPass<P>,
    ) {
        let tables: Vec<_> = self.each().filter(|(table, _)| table.rows.dampers() > 0).collect();
        let mut act = |(table, [_, words, first]): &(&Table<P>, [usize; 3])| {
            if let (Some(words), Some(shares)) = (states.get(*words..), shares.get(*first..)) {
                table.rows.sweep(reverse, words, shares, pass);
            }
        };
        if reverse {
            tables.iter().rev().for_each(&mut act);
        } else {
            tables.iter().for_each(&mut act);
        }
    }
    fn look(&self, row: usize, states: &Vec<Word>, look: &mut dyn FnMut(&dyn Row<P>)) {
        for (table, [before, words, _]) in self.each() {
            if (before..before + table.rows.count()).contains(&row)
                && let Some(words) = states.get(words..)
            {
                return table.rows.look(row - before, words, look);
            }
        }
    }
    fn share_mut<'s>(
        &self,
        shares: &'s mut Self::Shares,
        row: usize,
        damper: usize,
    ) -> Option<&'s mut Share<P::Real>> {
        let of = |(table, [before, _, first]): (&Table<P>, [usize; 3])| {
            let here = (before..before + table.rows.count()).contains(&row);
            (here && damper < table.rows.dampers())
                .then(|| first + (row - before) * table.rows.dampers() + damper)
        };
        let place = self.each().find_map(of)?;
        shares.get_mut(place)
    }
    fn visit(states: &Vec<Word>, visitor: &mut dyn WordVisitor) {
        states.iter().for_each(|word| visitor.word(*word));
    }
    fn fill(states: &mut Vec<Word>, source: &mut dyn WordSource) {
        for word in states {
            let bits = source.take(word.size());
            *word = of_bits(*word, bits);
        }
    }
    fn memory(&self) -> Option<(&'static str, bool)> {
        let mut memories = self.tables.iter().filter_map(|table| table.rows.memory());
        let advancing = memories.clone().find(|(_, advances)| *advances);
        advancing.or_else(|| memories.next())
    }
}

/// A word of the kind of another one.
fn of_bits(like: Word, bits: u64) -> Word {
    match like {
        Word::F32(_) => Word::F32(f32::from_bits(bits as u32)),
        Word::F64(_) => Word::F64(f64::from_bits(bits)),
        Word::I32(_) => Word::I32(bits as i32),
        Word::U64(_) => Word::U64(bits),
    }
}

/// Memories in another precision: numbers converted as `like` says, one by one.
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

/// Words put where they were.
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
    fn is_driven(&self) -> bool;
    fn initial(&self) -> Vec<Word>;
    fn memory(&self) -> Option<(&'static str, bool)>;
    fn act(
        &self,
        at: Instant<'_, P>,
        words: &mut [Word],
        act: Act<P::Real>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize>;
    fn sweep(
        &self,
        reverse: bool,
        words: &[Word],
        shares: &[Share<P::Real>],
        pass: &mut dyn DamperPass<P>,
    );
    fn look(&self, row: usize, words: &[Word], look: &mut dyn FnMut(&dyn Row<P>));
}

struct Of<T>(Vec<T>);

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
    fn is_driven(&self) -> bool {
        T::DRIVEN && !self.0.is_empty()
    }
    fn initial(&self) -> Vec<Word> {
        listed(&T::State::default()).repeat(self.0.len())
    }
    fn memory(&self) -> Option<(&'static str, bool)> {
        laws::memory::<P, T>(&self.0)
    }
    fn act(
        &self,
        at: Instant<'_, P>,
        words: &mut [Word],
        act: Act<P::Real>,
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
        words: &[Word],
        shares: &[Share<P::Real>],
        pass: &mut dyn DamperPass<P>,
    ) {
        let (each, dampers) = (Rows::<P>::words(self), T::Dampers::COUNT);
        for number in 0..self.0.len() {
            let number = if reverse { self.0.len() - 1 - number } else { number };
            let (Some(words), Some(known)) = (
                words.get(number * each..(number + 1) * each),
                shares.get(number * dampers..(number + 1) * dampers),
            ) else {
                break;
            };
            let mut shares = laws::shares_of::<P, T>(&self.0[number]);
            shares.as_mut().copy_from_slice(known);
            let states = [state::<P, T>(words)];
            laws::sweep::<P, T>(&self.0[number..=number], reverse, &states, &[shares], pass);
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
}

/// The rows of a law in double precision, as a scene gives them.
pub(crate) trait SourceRows: Send + Sync {
    fn name(&self) -> &'static str;
    /// The path of its type in Rust.
    fn path(&self) -> &str;
    fn bodies(&self) -> Vec<[BodyIndex; 2]>;
    /// All constants.
    fn words(&self) -> Vec<Word>;
    /// One more row; `None` where the source has refused a constant.
    fn add(&mut self, bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<()>;
    /// What is wrong with the last row: a field, the problem, what would be right.
    fn wrong(&self) -> Option<laws::Wrong>;
    /// A table of the same law without rows.
    fn empty(&self) -> Box<dyn SourceRows>;
    /// A row's constants.
    fn write(&self, row: usize, sink: &mut dyn FieldSink);
    /// `Arc<dyn Rows<P>>` for the precision of this type.
    fn in_precision(&self, precision: TypeId) -> Option<Box<dyn Any>>;
}

/// The rows of `L`.
pub(crate) struct Source<L> {
    rows: Vec<L>,
    path: String,
}

impl<L: Law> Source<L> {
    pub(crate) fn new(path: String) -> Self {
        Self { rows: Vec::new(), path }
    }

    fn rows_in<P: Geometry>(&self) -> Box<dyn Any> {
        let rows: Arc<dyn Rows<P>> = Arc::new(Of(self.rows.iter().map(L::rounded::<P>).collect()));
        Box::new(rows)
    }
}

impl<L: Law> SourceRows for Source<L> {
    fn name(&self) -> &'static str {
        <L as Constants<F64>>::NAME
    }
    fn path(&self) -> &str {
        &self.path
    }
    fn bodies(&self) -> Vec<[BodyIndex; 2]> {
        self.rows.iter().map(Constants::bodies).collect()
    }
    fn words(&self) -> Vec<Word> {
        let mut list = Listed::default();
        self.rows.iter().for_each(|row| Constants::visit(row, &mut list));
        list.0
    }
    fn add(&mut self, bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<()> {
        self.rows.push(L::read_from(bodies, source)?);
        Some(())
    }
    fn wrong(&self) -> Option<laws::Wrong> {
        self.rows.last()?.check().err()
    }
    fn empty(&self) -> Box<dyn SourceRows> {
        Box::new(Self::new(self.path.clone()))
    }
    fn write(&self, row: usize, sink: &mut dyn FieldSink) {
        if let Some(row) = self.rows.get(row) {
            row.write_to(sink);
        }
    }
    fn in_precision(&self, precision: TypeId) -> Option<Box<dyn Any>> {
        let is = |id: TypeId| precision == id;
        match () {
            () if is(TypeId::of::<F64>()) => Some(self.rows_in::<F64>()),
            () if is(TypeId::of::<F32>()) => Some(self.rows_in::<F32>()),
            () if is(TypeId::of::<Fixed>()) => Some(self.rows_in::<Fixed>()),
            () if is(TypeId::of::<Planar64>()) => Some(self.rows_in::<Planar64>()),
            () if is(TypeId::of::<Planar32>()) => Some(self.rows_in::<Planar32>()),
            () => None,
        }
    }
}
