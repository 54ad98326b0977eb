//! The degrees of freedom of one body: rows with one number each, square blocks of rows, and their algebra.
//!
//! `block => factor L·D·Lᵀ; row, factor => solution`. A diagonal block is symmetric: only its lower triangle is used.
//! Sums run over the columns in ascending order.

use core::fmt::Debug;

use crate::real::Real;

/// One number per degree of freedom of a body: six in space, three in the plane.
pub trait Freedoms: Copy + Debug + Send + 'static {
    /// The number.
    type Real: Real;
    /// One row per degree of freedom.
    type Block: Copy + Debug + Send;
    /// The translations of a body alone.
    type Translation: Freedoms<Real = Self::Real>;

    /// The row of zeros.
    const ZERO: Self;
    /// The block of zeros.
    const EMPTY: Self::Block;

    /// Adds `weight·self·selfᵀ` to the lower triangle of a block.
    fn add_square(&self, weight: Self::Real, block: &mut Self::Block);
    /// Adds `weight·self·otherᵀ` to a block.
    fn add_product(&self, weight: Self::Real, other: &Self, block: &mut Self::Block);
    /// Whether the lower triangles of two blocks differ by at most `least` in every entry.
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
    /// Subtracts `a·bᵀ` from a block.
    fn reduce(block: &mut Self::Block, a: &Self::Block, b: &Self::Block);
    /// Subtracts `a·b` from a block, each sum that of [`Self::reduce`].
    fn reduce_by_block(block: &mut Self::Block, a: &Self::Block, b: &Self::Block);
    /// The transposed block.
    fn transposed(block: &Self::Block) -> Self::Block;
    /// Subtracts `a·bᵀ`, which is symmetric, from the lower triangle of a block.
    fn reduce_square(block: &mut Self::Block, a: &Self::Block, b: &Self::Block);
    /// Subtracts `block·other` from the row.
    fn reduce_by(&mut self, block: &Self::Block, other: &Self);
    /// Subtracts `blockᵀ·other` from the row.
    fn reduce_by_transposed(&mut self, block: &Self::Block, other: &Self);
    /// Its translations.
    fn translation(&self) -> Self::Translation;
    /// Replaces its translations.
    fn set_translation(&mut self, translation: Self::Translation);
    /// The part of a block for translations of both bodies.
    fn translations(block: &Self::Block) -> BlockIn<Self::Translation>;
    /// Replaces the part of a block for translations of both bodies.
    fn set_translations(block: &mut Self::Block, part: &BlockIn<Self::Translation>);
}

/// The block of a row.
type BlockIn<R> = <R as Freedoms>::Block;

#[inline(always)]
fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// The unrolled algebra of rows of the given size, and of its translations: for each row the columns before it, for each
/// of these the columns before that; then the rows from the last on with the columns before each.
macro_rules! freedoms {
    ($n:literal of [$($t:literal)*] $m:literal: $($r:literal [$($c:literal [$($k:literal)*])*])*; $($last:literal [$($before:literal)*])*) => {
        impl<R: Real> Freedoms for [R; $n] {
            type Real = R;
            type Block = [[R; $n]; $n];
            type Translation = [R; $m];

            const ZERO: Self = [R::ZERO; $n];
            const EMPTY: Self::Block = [[R::ZERO; $n]; $n];

            #[inline(always)]
            fn add_square(&self, weight: R, block: &mut Self::Block) {
                $(
                    let scaled = weight * self[$r];
                    $(block[$r][$c] = block[$r][$c] + scaled * self[$c];)*
                    block[$r][$r] = block[$r][$r] + scaled * self[$r];
                )*
            }

            #[inline(always)]
            fn add_product(&self, weight: R, other: &Self, block: &mut Self::Block) {
                for (row, own) in block.iter_mut().zip(self) {
                    let scaled = weight * *own;
                    $(row[$r] = row[$r] + scaled * other[$r];)*
                }
            }

            fn are_near(a: &Self::Block, b: &Self::Block, least: R) -> bool {
                let near = |a: R, b: R| (a - b).abs() <= least;
                true $($(&& near(a[$r][$c], b[$r][$c]))* && near(a[$r][$r], b[$r][$r]))*
            }

            #[inline(always)]
            fn factor(block: &mut Self::Block) -> bool {
                let (mut positive, mut row) = (true, Self::ZERO);
                $(
                    let pivot = block[$r][$r];
                    $(
                        row[$c] = block[$r][$c];
                        $(row[$c] = row[$c] - block[$c][$k] * row[$k];)*
                    )*
                    $(
                        let l = row[$c] * block[$c][$c];
                        let pivot = pivot - l * row[$c];
                        block[$r][$c] = l;
                    )*
                    positive &= R::ZERO < pivot;
                    block[$r][$r] = R::ONE / pivot;
                )*
                positive
            }

            #[inline(always)]
            fn forward(&mut self, factor: &Self::Block) {
                $($(self[$r] = self[$r] - factor[$r][$c] * self[$c];)*)*
            }

            #[inline(always)]
            fn backward(&mut self, factor: &Self::Block) {
                $($(self[$before] = self[$before] - factor[$last][$before] * self[$last];)*)*
            }

            #[inline(always)]
            fn divide(&mut self, factor: &Self::Block) {
                $(self[$r] = self[$r] * factor[$r][$r];)*
            }

            #[inline(always)]
            fn forward_block(block: &mut Self::Block, factor: &Self::Block) {
                for row in block {
                    let mut own = *row;
                    own.forward(factor);
                    *row = own;
                }
            }

            #[inline(always)]
            fn divided(block: &Self::Block, factor: &Self::Block) -> Self::Block {
                let mut out = *block;
                for row in &mut out {
                    row.divide(factor);
                }
                out
            }

            #[inline]
            fn reduce(block: &mut Self::Block, a: &Self::Block, b: &Self::Block) {
                for (row, a) in block.iter_mut().zip(a) {
                    let a = *a;
                    $(row[$r] = row[$r] - dot(&a, &b[$r]);)*
                }
            }

            #[inline(always)]
            fn reduce_by_block(block: &mut Self::Block, a: &Self::Block, b: &Self::Block) {
                for (row, a) in block.iter_mut().zip(a) {
                    let mut sums = b[0];
                    $(sums[$r] = a[0] * b[0][$r];)*
                    for k in 1..$n {
                        $(sums[$r] = sums[$r] + a[k] * b[k][$r];)*
                    }
                    $(row[$r] = row[$r] - sums[$r];)*
                }
            }

            #[inline(always)]
            fn transposed(block: &Self::Block) -> Self::Block {
                let mut out = *block;
                $($(
                    out[$r][$c] = block[$c][$r];
                    out[$c][$r] = block[$r][$c];
                )*)*
                out
            }

            #[inline(always)]
            fn reduce_square(block: &mut Self::Block, a: &Self::Block, b: &Self::Block) {
                $(
                    let row = a[$r];
                    $(block[$r][$c] = block[$r][$c] - dot(&row, &b[$c]);)*
                    block[$r][$r] = block[$r][$r] - dot(&row, &b[$r]);
                )*
            }

            #[inline(always)]
            fn reduce_by(&mut self, block: &Self::Block, other: &Self) {
                for (own, row) in self.iter_mut().zip(block) {
                    *own = *own - dot(row, other);
                }
            }

            #[inline(always)]
            fn reduce_by_transposed(&mut self, block: &Self::Block, other: &Self) {
                for (row, x) in block.iter().zip(other) {
                    $(self[$r] = self[$r] - row[$r] * *x;)*
                }
            }

            #[inline(always)]
            fn translation(&self) -> [R; $m] {
                [$(self[$t]),*]
            }

            #[inline(always)]
            fn set_translation(&mut self, translation: [R; $m]) {
                $(self[$t] = translation[$t];)*
            }

            #[inline(always)]
            fn translations(block: &Self::Block) -> [[R; $m]; $m] {
                [$(block[$t].translation()),*]
            }

            #[inline(always)]
            fn set_translations(block: &mut Self::Block, part: &[[R; $m]; $m]) {
                $(block[$t].set_translation(part[$t]);)*
            }
        }
    };
}

freedoms!(2 of [0 1] 2: 0 [] 1 [0 []]; 1 [0]);
freedoms!(3 of [0 1] 2: 0 [] 1 [0 []] 2 [0 [] 1 [0]]; 2 [0 1] 1 [0]);
freedoms!(6 of [0 1 2] 3:
    0 []
    1 [0 []]
    2 [0 [] 1 [0]]
    3 [0 [] 1 [0] 2 [0 1]]
    4 [0 [] 1 [0] 2 [0 1] 3 [0 1 2]]
    5 [0 [] 1 [0] 2 [0 1] 3 [0 1 2] 4 [0 1 2 3]];
    5 [0 1 2 3 4] 4 [0 1 2 3] 3 [0 1 2] 2 [0 1] 1 [0]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factored_block_solves_and_one_that_is_not_positive_is_refused() {
        let mut random = 0.37_f64;
        let mut next = || {
            random = 3.9 * random * (1.0 - random);
            random - 0.5
        };
        let mut block = <[f64; 6]>::EMPTY;
        for _ in 0..8 {
            core::array::from_fn::<f64, 6, _>(|_| next()).add_square(2.0, &mut block);
        }
        let whole = |r: usize, c: usize| block[r.max(c)][r.min(c)];
        let meant: [f64; 6] = core::array::from_fn(|_| next());
        let mut x = core::array::from_fn(|r| (0..6).map(|c| whole(r, c) * meant[c]).sum());
        let mut factor = block;
        assert!(<[f64; 6]>::factor(&mut factor));
        <[f64; 6]>::forward(&mut x, &factor);
        x.divide(&factor);
        x.backward(&factor);
        for (found, meant) in x.into_iter().zip(meant) {
            assert!((found - meant).abs() < 1e-12, "{found} {meant}");
        }
        // A matrix of rank two has no third pivot.
        let mut thin = <[f64; 3]>::EMPTY;
        [1.0, 2.0, 3.0].add_square(1.0, &mut thin);
        [0.0, 1.0, 1.0].add_square(1.0, &mut thin);
        thin[2][2] -= 1e-9;
        assert!(!<[f64; 3]>::factor(&mut thin));
        assert!(!<[f32; 3]>::factor(&mut [[f32::NAN; 3]; 3]));
    }
}
