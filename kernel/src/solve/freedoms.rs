//! The freedoms of one body: rows of as many numbers, square blocks of rows, and their algebra.
//!
//! `block => factor L·D·Lᵀ; row, factor => solution`. A block on the diagonal is symmetric: of it the
//! lower triangle counts. Sums run over the columns in ascending order.

use core::fmt::Debug;

use crate::real::Real;

/// As many numbers as a body has freedoms: six in space, three in the plane.
pub trait Freedoms: Copy + Debug + Send + 'static {
    /// The number.
    type Real: Real;
    /// One row per freedom.
    type Block: Copy + Debug + Send;

    /// The row of zeros.
    const ZERO: Self;
    /// The block of zeros.
    const EMPTY: Self::Block;

    /// Adds `weight·self·selfᵀ` to the lower triangle of a block.
    fn add_square(&self, weight: Self::Real, block: &mut Self::Block);
    /// Adds `weight·self·otherᵀ` to a block.
    fn add_product(&self, weight: Self::Real, other: &Self, block: &mut Self::Block);
    /// Whether the lower triangles of two blocks are no farther apart than `least` anywhere.
    fn are_near(a: &Self::Block, b: &Self::Block, least: Self::Real) -> bool;
    /// Writes the factor over a symmetric block: L below the diagonal, D⁻¹ on it. `false` where a pivot
    /// is not positive.
    fn factor(block: &mut Self::Block) -> bool;
    /// `L⁻¹·self`.
    fn forward(&mut self, factor: &Self::Block);
    /// `L⁻ᵀ·self`.
    fn backward(&mut self, factor: &Self::Block);
    /// `D⁻¹·self`.
    fn divide(&mut self, factor: &Self::Block);
    /// `block·L⁻ᵀ`.
    fn forward_block(block: &mut Self::Block, factor: &Self::Block);
    /// `block·D⁻¹`.
    fn divided(block: &Self::Block, factor: &Self::Block) -> Self::Block;
    /// Takes `a·bᵀ` from a block.
    fn reduce(block: &mut Self::Block, a: &Self::Block, b: &Self::Block);
    /// Takes `a·bᵀ`, which is symmetric, from the lower triangle of a block.
    fn reduce_square(block: &mut Self::Block, a: &Self::Block, b: &Self::Block);
    /// Takes `block·other` from the row.
    fn reduce_by(&mut self, block: &Self::Block, other: &Self);
    /// Takes `blockᵀ·other` from the row.
    fn reduce_by_transposed(&mut self, block: &Self::Block, other: &Self);
}

#[inline(always)]
fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = sum + a[i] * b[i];
    }
    sum
}

impl<R: Real, const N: usize> Freedoms for [R; N] {
    type Real = R;
    type Block = [[R; N]; N];

    const ZERO: Self = [R::ZERO; N];
    const EMPTY: Self::Block = [[R::ZERO; N]; N];

    #[inline(always)]
    fn add_square(&self, weight: R, block: &mut Self::Block) {
        for r in 0..N {
            let scaled = weight * self[r];
            for c in 0..=r {
                block[r][c] = block[r][c] + scaled * self[c];
            }
        }
    }

    #[inline(always)]
    fn add_product(&self, weight: R, other: &Self, block: &mut Self::Block) {
        for r in 0..N {
            let scaled = weight * self[r];
            for c in 0..N {
                block[r][c] = block[r][c] + scaled * other[c];
            }
        }
    }

    fn are_near(a: &Self::Block, b: &Self::Block, least: R) -> bool {
        let apart = |r: usize| (0..=r).any(|c| !((a[r][c] - b[r][c]).abs() <= least));
        !(0..N).any(apart)
    }

    #[inline]
    fn factor(block: &mut Self::Block) -> bool {
        let mut positive = true;
        for c in 0..N {
            let pivot = block[c][c];
            positive &= R::ZERO < pivot;
            let inverse = R::ONE / pivot;
            block[c][c] = inverse;
            for r in c + 1..N {
                let l = block[r][c] * inverse;
                for k in c + 1..=r {
                    block[r][k] = block[r][k] - l * block[k][c];
                }
            }
            for row in block.iter_mut().skip(c + 1) {
                row[c] = row[c] * inverse;
            }
        }
        positive
    }

    #[inline(always)]
    fn forward(&mut self, factor: &Self::Block) {
        for r in 1..N {
            for c in 0..r {
                self[r] = self[r] - factor[r][c] * self[c];
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self, factor: &Self::Block) {
        for c in (1..N).rev() {
            for r in 0..c {
                self[r] = self[r] - factor[c][r] * self[c];
            }
        }
    }

    #[inline(always)]
    fn divide(&mut self, factor: &Self::Block) {
        for r in 0..N {
            self[r] = self[r] * factor[r][r];
        }
    }

    #[inline]
    fn forward_block(block: &mut Self::Block, factor: &Self::Block) {
        for row in block {
            row.forward(factor);
        }
    }

    #[inline]
    fn divided(block: &Self::Block, factor: &Self::Block) -> Self::Block {
        let mut out = *block;
        for row in &mut out {
            row.divide(factor);
        }
        out
    }

    #[inline]
    fn reduce(block: &mut Self::Block, a: &Self::Block, b: &Self::Block) {
        for r in 0..N {
            for c in 0..N {
                block[r][c] = block[r][c] - dot(&a[r], &b[c]);
            }
        }
    }

    #[inline]
    fn reduce_square(block: &mut Self::Block, a: &Self::Block, b: &Self::Block) {
        for r in 0..N {
            for c in 0..=r {
                block[r][c] = block[r][c] - dot(&a[r], &b[c]);
            }
        }
    }

    #[inline]
    fn reduce_by(&mut self, block: &Self::Block, other: &Self) {
        for r in 0..N {
            self[r] = self[r] - dot(&block[r], other);
        }
    }

    #[inline]
    fn reduce_by_transposed(&mut self, block: &Self::Block, other: &Self) {
        for (row, x) in block.iter().zip(other) {
            for c in 0..N {
                self[c] = self[c] - row[c] * *x;
            }
        }
    }
}
