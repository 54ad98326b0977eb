//! Numbers of rows, the first of all rows before the second of all: those of neighbours are one load.
//!
//! `(columns, first row) => lanes`, and back.

use std::ops::Range;

use dbd_kernel::Real;

use super::plan::Layout;
use crate::lanes::Lanes;
use crate::register::Register;

/// As many numbers of each row.
pub(super) struct Table<N, const NUMBERS: usize> {
    numbers: Vec<N>,
    rows: usize,
    layout: Layout,
}

impl<N: Real, const NUMBERS: usize> Table<N, NUMBERS> {
    /// A table whose rows are all the same.
    pub(super) fn new(layout: Layout, row: [N; NUMBERS]) -> Self {
        let rows = layout.rows();
        let numbers = row.iter().flat_map(|&number| std::iter::repeat_n(number, rows));
        Self { numbers: numbers.collect(), rows, layout }
    }

    /// The first numbers of all rows, the second, and so on.
    #[inline(always)]
    pub(super) fn columns(&self) -> [&[N]; NUMBERS] {
        let mut columns: [&[N]; NUMBERS] = [&[]; NUMBERS];
        let mut left = self.numbers.as_slice();
        for column in &mut columns {
            (*column, left) = left.split_at(self.rows);
        }
        columns
    }

    /// Likewise.
    #[inline(always)]
    pub(super) fn columns_mut(&mut self) -> [&mut [N]; NUMBERS] {
        let mut left = self.numbers.as_mut_slice();
        std::array::from_fn(|_| {
            let (column, others) = std::mem::take(&mut left).split_at_mut(self.rows);
            left = others;
            column
        })
    }

    /// A row.
    pub(super) fn row(&self, row: usize) -> [N; NUMBERS] {
        self.columns().map(|column| column[row])
    }

    /// Writes a row.
    pub(super) fn set_row(&mut self, row: usize, numbers: [N; NUMBERS]) {
        for (column, number) in self.columns_mut().into_iter().zip(numbers) {
            column[row] = number;
        }
    }

    /// Makes these of the copies of rows that are taken beside others.
    pub(super) fn copy(&mut self, copies: &Range<usize>) {
        if copies.is_empty() {
            return;
        }
        let Layout { written, copied, .. } = &self.layout;
        let rows = &copied[copies.clone()];
        for column in self.numbers.chunks_exact_mut(self.rows) {
            let (written, all) = column.split_at_mut(*written);
            for (copy, &row) in all[copies.clone()].iter_mut().zip(rows) {
                *copy = written[row as usize];
            }
        }
    }
}

/// What a register takes of columns, its rows from `first` on.
#[inline(always)]
pub(super) fn load<V: Register, C: AsRef<[V::Number]>, const NUMBERS: usize>(
    columns: &[C; NUMBERS],
    first: usize,
) -> [Lanes<V>; NUMBERS] {
    let mut numbers = [Lanes::ZERO; NUMBERS];
    for (numbers, column) in numbers.iter_mut().zip(columns) {
        *numbers = Lanes::load(&column.as_ref()[first..first + V::LANES]);
    }
    numbers
}

/// Writes a register's rows from `first` on.
#[inline(always)]
pub(super) fn store<V: Register, const NUMBERS: usize>(
    columns: &mut [&mut [V::Number]; NUMBERS],
    first: usize,
    numbers: [Lanes<V>; NUMBERS],
) {
    for (column, numbers) in columns.iter_mut().zip(numbers) {
        numbers.store(&mut column[first..first + V::LANES]);
    }
}
