//! The laws of a model whose sizes are known at run time: a list of tables, one per law.
//!
//! `(rows in double precision) => tables in any precision`. A table is accessed through its functions only, so a
//! program can have laws that it was not compiled with; each law is compiled once per precision, not once per scheme. A
//! memory is stored as words.

use std::any::TypeId;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use dbd_kernel::damping::Share;
use dbd_kernel::forces::Wrench;
use dbd_kernel::laws::{self, Act, Damper, DamperPass, Instant, Laws, Need, Row};
use dbd_kernel::words::{Word, WordSource, WordVisitor};
use dbd_kernel::{BodyIndex, Geometry, Real as _};

use crate::laws::rows::{Rows, of_bits};
use crate::laws::source::SourceRows;

/// Laws of a model on the heap.
#[derive(Clone)]
pub struct LawList<P: Geometry> {
    tables: Vec<Table<P>>,
}

/// A table in one precision, and its source.
#[derive(Clone)]
struct Table<P: Geometry> {
    rows: Arc<dyn Rows<P>>,
    source: Arc<dyn SourceRows>,
    /// A row's memory at t = 0.
    initial: Vec<Word>,
    first: First,
}

/// A table's first row, the first word of its memories and the first of its dampers, over all tables.
#[derive(Clone, Copy, Default)]
struct First {
    row: usize,
    word: usize,
    damper: usize,
}

impl<P: Geometry> Table<P> {
    /// The words of a row's memory among those of all tables.
    fn words(&self, row: usize) -> Range<usize> {
        let from = self.first.word + row * self.initial.len();
        from..from + self.initial.len()
    }

    /// Passes a row with its memory to `act`.
    fn act(&self, row: usize, states: &mut [Word], act: &mut dyn FnMut(&mut dyn Row<P>)) {
        if let Some(words) = states.get_mut(self.words(row)) {
            self.rows.act(row, words, act);
        }
    }

    /// The dampers of a row among those of all tables.
    fn dampers(&self, row: usize) -> Range<usize> {
        let from = self.first.damper + row * self.rows.dampers();
        from..from + self.rows.dampers()
    }
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
    /// The tables in this precision; none where the laws are not compiled for it (lanes, and precisions used for
    /// comparison only).
    pub(crate) fn of(sources: &[Arc<dyn SourceRows>]) -> Self {
        let mut next = First::default();
        let mut table = |source: &Arc<dyn SourceRows>| {
            let rows = source.in_precision(TypeId::of::<P>())?;
            let rows = *rows.downcast::<Arc<dyn Rows<P>>>().ok()?;
            let (first, initial, count) = (next, rows.initial(), rows.count());
            next.row += count;
            next.word += count * initial.len();
            next.damper += count * rows.dampers();
            Some(Table { rows, source: source.clone(), initial, first })
        };
        Self { tables: sources.iter().map(&mut table).collect::<Option<_>>().unwrap_or_default() }
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

    /// Whether the list has no table.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tables.is_empty()
    }

    /// A and B of every row.
    pub fn bodies(&self) -> impl Iterator<Item = [BodyIndex; 2]> + '_ {
        self.tables.iter().flat_map(|table| table.source.bodies())
    }

    /// Pairs of bodies between which a row acts; for a coupling all pairs of its bodies.
    #[must_use]
    pub fn pairs(&self) -> Vec<[BodyIndex; 2]> {
        let mut pairs = Vec::new();
        self.look_at_all(&self.states(), &mut |_, law| {
            let mut bodies = law.bodies().to_vec();
            law.branch_bodies(&mut |more| bodies.extend(more));
            for (place, &b) in bodies.iter().enumerate() {
                pairs.extend(bodies[..place].iter().filter(|a| **a != b).map(|a| [*a, b]));
            }
        });
        pairs
    }

    /// Replaces the vectors of memories, each in the axes of a body; used to convert between a plane and space.
    pub fn turn_memories(
        &self,
        states: &mut [Word],
        turn: &mut dyn FnMut(BodyIndex, [f64; 3]) -> [f64; 3],
    ) {
        for table in &self.tables {
            for row in 0..table.rows.count() {
                table.act(row, states, &mut |law| {
                    let bodies = law.bodies();
                    law.turn(&mut |end, v| turn(bodies[end], v));
                });
            }
        }
    }

    /// The table of a row, and the row in it.
    fn table_of(&self, row: usize) -> Option<(&Table<P>, usize)> {
        let place = |table: &Table<P>| row.checked_sub(table.first.row);
        let of = |table| place(table).filter(|row| *row < table.rows.count());
        self.tables.iter().find_map(|table| Some((table, of(table)?)))
    }
}

impl<P: Geometry> Laws<P> for LawList<P> {
    type States = Vec<Word>;
    type Shares = Vec<Share<P::Real>>;
    // No law is compiled for lanes.
    const EMPTY: bool = !P::Real::ONE_LANE;
    const DAMPED: bool = P::Real::ONE_LANE;
    const TURNS: bool = P::Real::ONE_LANE;
    const PUSHES: bool = P::Real::ONE_LANE;
    const ADVANCES: bool = P::Real::ONE_LANE;

    fn count(&self) -> usize {
        self.tables.iter().map(|table| table.rows.count()).sum()
    }
    fn is_damped(&self) -> bool {
        self.tables.iter().any(|table| table.rows.is_damped())
    }
    fn is_driven(&self) -> bool {
        self.tables.iter().any(|table| table.rows.is_driven())
    }
    fn states(&self) -> Vec<Word> {
        self.tables.iter().flat_map(|table| table.initial.repeat(table.rows.count())).collect()
    }
    fn shares(&self) -> Self::Shares {
        let count = |table: &Table<P>| table.rows.count() * table.rows.dampers();
        vec![Share::ALONE; self.tables.iter().map(count).sum()]
    }
    fn act(
        &self,
        at: Instant<'_, P>,
        states: &mut Vec<Word>,
        act: Act<'_, P>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize> {
        for table in &self.tables {
            for row in 0..table.rows.count() {
                let mut done = None;
                table.act(row, states, &mut |law| done = laws::act(law, at, act, wrenches));
                done.ok_or(table.first.row + row)?;
            }
        }
        Ok(())
    }
    fn sweep(
        &self,
        reverse: bool,
        states: &mut Vec<Word>,
        shares: &Self::Shares,
        pass: &mut dyn DamperPass<P>,
    ) {
        // The words of a memory keep nothing of a pose.
        let order = [reverse, false];
        let ordered = |count: usize, place: usize| if reverse { count - 1 - place } else { place };
        for place in 0..self.tables.len() {
            let table = &self.tables[ordered(self.tables.len(), place)];
            let (rows, count) = (table.rows.count(), table.rows.dampers());
            if count == 0 {
                continue;
            }
            let mut dampers = vec![Damper::idle(); count];
            for row in (0..rows).map(|row| ordered(rows, row)) {
                let Some(shares) = shares.get(table.dampers(row)) else { break };
                table.act(row, states, &mut |law| {
                    laws::sweep(law, order, shares, || &mut dampers[..], pass);
                });
            }
        }
    }
    fn look(&self, row: usize, states: &Vec<Word>, look: &mut dyn FnMut(&mut dyn Row<P>)) {
        if let Some((table, row)) = self.table_of(row)
            && let Some(words) = states.get(table.words(row))
        {
            table.rows.act(row, &mut words.to_vec(), look);
        }
    }
    fn share_mut<'s>(
        &self,
        shares: &'s mut Self::Shares,
        row: usize,
        damper: usize,
    ) -> Option<&'s mut Share<P::Real>> {
        let (table, row) = self.table_of(row)?;
        shares.get_mut(table.dampers(row).nth(damper)?)
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
    fn memory(&self) -> Option<(&'static str, Need)> {
        let memories = self.tables.iter().filter_map(|table| table.rows.memory());
        memories.reduce(|a, b| if a.1 < b.1 { b } else { a })
    }
}
