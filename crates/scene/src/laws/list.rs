//! The laws of a model whose sizes are known at run time: a list of tables, one per law.
//!
//! `(rows in double precision) => tables in any precision`. A table is accessed through its functions only, so a
//! program can have laws that it was not compiled with; each law is compiled once per precision, not once per scheme. A
//! memory is stored as words.

use std::any::TypeId;
use std::fmt;
use std::sync::Arc;

use dbd_kernel::damping::Share;
use dbd_kernel::forces::Wrench;
use dbd_kernel::laws::{Act, DamperPass, Instant, Laws, Need, Row};
use dbd_kernel::words::{Word, WordSource, WordVisitor};
use dbd_kernel::{BodyIndex, Geometry};

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
        for (table, [_, from, _]) in self.each() {
            if let Some(words) = states.get_mut(from..) {
                table.rows.turn(words, turn);
            }
        }
    }

    /// Table and row of each row over all tables, with the start indices of its words and its damper fractions.
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
    const TURNS: bool = true;
    const PUSHES: bool = true;
    const ADVANCES: bool = true;

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
        act: Act<'_, P>,
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
        states: &mut Vec<Word>,
        shares: &Self::Shares,
        pass: &mut dyn DamperPass<P>,
    ) {
        let tables: Vec<_> = self.each().filter(|(table, _)| table.rows.dampers() > 0).collect();
        let mut act = |(table, [_, words, first]): &(&Table<P>, [usize; 3])| {
            if let (Some(words), Some(shares)) = (states.get_mut(*words..), shares.get(*first..)) {
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
    fn memory(&self) -> Option<(&'static str, Need)> {
        let memories = self.tables.iter().filter_map(|table| table.rows.memory());
        memories.reduce(|a, b| if a.1 < b.1 { b } else { a })
    }
}
