//! A sparse symmetric system of one block per body and per pair of bodies, solved in place.
//!
//! `(plan, blocks, right sides) => solution`: block L·D·Lᵀ without pivoting (Golub & Van Loan 2013, section 4.1),
//! bodies in the elimination order. A positive definite matrix needs no pivoting.

use crate::forces::Wrench;
use crate::freedoms::Freedoms;
use crate::index::BodyIndex;
use crate::model::Plan;
use crate::space::{BlockOf, Space};

/// The blocks of a system, borrowed for a step.
pub(crate) struct System<'s, S: Space> {
    pub(crate) plan: Plan<'s>,
    /// One per body.
    pub(crate) diagonal: &'s mut [BlockOf<S>],
    /// One per pair: rows of the body that is eliminated later.
    pub(crate) pairs: &'s mut [BlockOf<S>],
}

impl<S: Space> System<'_, S> {
    /// Zeros the blocks of pairs; those of decoupled bodies have translations alone.
    pub(crate) fn clear_pairs(&mut self) {
        let mut pairs = self.pairs.iter_mut();
        for &[body, count] in self.plan.order {
            let decoupled = self.plan.is_decoupled(usize::from(body));
            for block in pairs.by_ref().take(usize::from(count)) {
                if decoupled {
                    S::Row::set_translations(block, &Translation::<S>::EMPTY);
                } else {
                    *block = S::Row::EMPTY;
                }
            }
        }
    }

    /// Factors the matrix in place. `DECOUPLED` looks for bodies whose rotations couple with nothing: the products of their
    /// blocks are those of translations, 27 instead of 216 multiplications, with the same bits.
    ///
    /// # Errors
    /// The first body with a pivot that is not positive: its state or its neighbours' is out of the number's range.
    pub(crate) fn factor<const DECOUPLED: bool>(&mut self) -> Result<(), BodyIndex> {
        let Plan { order, mut pairs, mut targets, .. } = self.plan;
        let (mut blocks, mut first) = (&mut *self.pairs, 0);
        for &[body, count] in order {
            let row = usize::from(body);
            let Some(block) = self.diagonal.get_mut(row) else { continue };
            if !S::Row::factor(block) {
                return Err(BodyIndex(body));
            }
            let factor = *block;
            let count = usize::from(count);
            let Some((with, other_pairs)) = pairs.split_at_checked(count) else { break };
            let Some((here, later)) = blocks.split_at_mut_checked(count) else { break };
            first += count;
            if DECOUPLED && self.plan.is_decoupled(row) {
                let Some((own, rest)) =
                    targets.split_at_checked(count * count.saturating_sub(1) / 2)
                else {
                    break;
                };
                eliminate_translations::<S>(
                    &factor,
                    (with, here),
                    own,
                    (later, first),
                    self.diagonal,
                );
                (pairs, blocks, targets) = (other_pairs, later, rest);
                continue;
            }
            for (i, [_, second]) in with.iter().enumerate() {
                let Some((before, [block, ..])) = here.split_at_mut_checked(i) else { break };
                S::Row::forward_block(block, &factor);
                let divided = S::Row::divided(block, &factor);
                for other in before.iter() {
                    let Some((target, rest)) = targets.split_first() else { break };
                    targets = rest;
                    let target = (*target as usize).checked_sub(first);
                    if let Some(target) = target.and_then(|row| later.get_mut(row)) {
                        // The previous blocks are already divided.
                        S::Row::reduce(target, block, other);
                    }
                }
                if let Some(target) = self.diagonal.get_mut(usize::from(*second)) {
                    S::Row::reduce_square(target, block, &divided);
                }
                *block = divided;
            }
            (pairs, blocks) = (other_pairs, later);
        }
        Ok(())
    }

    /// Solves a factored system for right sides stored in wrenches; `DECOUPLED` as in [`Self::factor`].
    pub(crate) fn substitute<const DECOUPLED: bool>(&self, right: &mut [Wrench<S>]) {
        let mut links = self.plan.pairs.iter().zip(self.pairs.iter());
        for &[body, count] in self.plan.order {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            x.forward(factor);
            let decoupled = DECOUPLED && self.plan.is_decoupled(row);
            let part = x.translation();
            for _ in 0..count {
                let Some(([_, second], block)) = links.next() else { break };
                if let Some(other) = right.get_mut(usize::from(*second)) {
                    let mut y = S::row(other.force, other.torque);
                    if decoupled {
                        let mut reduced = y.translation();
                        reduced.reduce_by(&S::Row::translations(block), &part);
                        y.set_translation(reduced);
                    } else {
                        y.reduce_by(block, &x);
                    }
                    *other = wrench::<S>(y);
                }
            }
            x.divide(factor);
            if let Some(own) = right.get_mut(row) {
                *own = wrench::<S>(x);
            }
        }
        let mut end = self.plan.pairs.len();
        for &[body, count] in self.plan.order.iter().rev() {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            let decoupled = DECOUPLED && self.plan.is_decoupled(row);
            let begin = end.saturating_sub(usize::from(count));
            for at in begin..end {
                let (Some([_, second]), Some(block)) =
                    (self.plan.pairs.get(at), self.pairs.get(at))
                else {
                    break;
                };
                if let Some(other) = right.get(usize::from(*second)) {
                    let other = S::row(other.force, other.torque);
                    if decoupled {
                        let mut reduced = x.translation();
                        let block = S::Row::translations(block);
                        reduced.reduce_by_transposed(&block, &other.translation());
                        x.set_translation(reduced);
                    } else {
                        x.reduce_by_transposed(block, &other);
                    }
                }
            }
            end = begin;
            x.backward(factor);
            if let Some(own) = right.get_mut(row) {
                *own = wrench::<S>(x);
            }
        }
    }
}

/// The products of [`System::factor`] for a decoupled body: column by column, so that registers hold what a column's
/// products have in common.
fn eliminate_translations<S: Space>(
    factor: &BlockOf<S>,
    (with, mut blocks): (&[[u16; 2]], &mut [BlockOf<S>]),
    targets: &[u32],
    (later, first): (&mut [BlockOf<S>], usize),
    diagonal: &mut [BlockOf<S>],
) {
    let factor = S::Row::translations(factor);
    for block in blocks.iter_mut() {
        let mut part = S::Row::translations(block);
        Translation::<S>::forward_block(&mut part, &factor);
        S::Row::set_translations(block, &part);
    }
    for (column, [_, second]) in with.iter().enumerate() {
        let Some((block, others)) = blocks.split_first_mut() else { break };
        let part = S::Row::translations(block);
        let divided = Translation::<S>::divided(&part, &factor);
        S::Row::set_translations(block, &divided);
        if let Some(target) = diagonal.get_mut(usize::from(*second)) {
            let mut reduced = S::Row::translations(target);
            Translation::<S>::reduce_square(&mut reduced, &part, &divided);
            S::Row::set_translations(target, &reduced);
        }
        let divided = Translation::<S>::transposed(&divided);
        for (row, other) in (column + 1..).zip(others.iter()) {
            let target = targets.get(row * (row - 1) / 2 + column);
            let target = target.and_then(|target| (*target as usize).checked_sub(first));
            if let Some(target) = target.and_then(|row| later.get_mut(row)) {
                let mut reduced = S::Row::translations(target);
                let other = S::Row::translations(other);
                Translation::<S>::reduce_by_block(&mut reduced, &other, &divided);
                S::Row::set_translations(target, &reduced);
            }
        }
        blocks = others;
    }
}

/// The translations of a body alone.
type Translation<S> = <<S as Space>::Row as Freedoms>::Translation;

fn wrench<S: Space>(row: S::Row) -> Wrench<S> {
    let (force, torque) = S::parts(row);
    Wrench::new(force, torque)
}

#[cfg(test)]
mod tests {
    use std::vec;

    use super::*;

    const RING: Plan<'static> = Plan {
        order: &[[0, 2], [1, 2], [2, 1], [3, 0]],
        pairs: &[[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]],
        targets: &[3, 4],
        slots: &[Plan::GROUND, 0, 2, 4, 1],
        decoupled: &[],
    };

    /// Numbers between -0.5 and 0.5.
    fn numbers() -> impl FnMut() -> f64 {
        let mut random = 0.37_f64;
        move || {
            random = 3.9 * random * (1.0 - random);
            random - 0.5
        }
    }

    /// A ring of four bodies, the first on the ground: eliminating one pair's bodies fills another. The product of the
    /// whole matrix with the solution is the right side.
    #[test]
    fn a_ring_whose_elimination_fills_a_pair_is_solved() {
        let (plan, mut next) = (RING, numbers());
        let mut diagonal = [<[f64; 6]>::EMPTY; 4];
        let mut pairs = [<[f64; 6]>::EMPTY; 5];
        let mut whole = vec![[0.0; 24]; 24];
        let springs = [[usize::MAX, 0], [0, 1], [1, 2], [2, 3], [0, 3]];
        for (ends, slot) in springs.into_iter().zip(plan.slots) {
            for _ in 0..8 {
                let rows: [[f64; 6]; 2] = [(); 2].map(|()| core::array::from_fn(|_| next()));
                let mut of_all = [0.0; 24];
                for (end, row) in ends.into_iter().zip(rows) {
                    if let Some(block) = diagonal.get_mut(end) {
                        row.add_square(3.0, block);
                        of_all[6 * end..6 * end + 6].copy_from_slice(&row);
                    }
                }
                if let Some(block) = pairs.get_mut(*slot as usize) {
                    rows[1].add_product(3.0, &rows[0], block);
                }
                for (whole, a) in whole.iter_mut().zip(of_all) {
                    whole.iter_mut().zip(of_all).for_each(|(entry, b)| *entry += 3.0 * a * b);
                }
            }
        }
        assert_eq!(pairs[3], <[f64; 6]>::EMPTY);
        let meant: [[f64; 6]; 4] = [(); 4].map(|()| core::array::from_fn(|_| next()));
        let all: vec::Vec<f64> = meant.into_iter().flatten().collect();
        let product = |row: usize| -> f64 { whole[row].iter().zip(&all).map(|(a, x)| a * x).sum() };
        let mut right: [Wrench<f64>; 4] =
            core::array::from_fn(|body| wrench(core::array::from_fn(|i| product(6 * body + i))));
        let mut system: System<'_, f64> =
            System { plan, diagonal: &mut diagonal, pairs: &mut pairs };
        system.factor::<false>().unwrap();
        system.substitute::<false>(&mut right);
        for (found, meant) in right.into_iter().zip(meant) {
            let meant = wrench::<f64>(meant);
            let off = [found.force - meant.force, found.torque - meant.torque];
            assert!(off.iter().all(|off| off.dot(*off) < 1e-16), "{found:?} {meant:?}");
        }
        assert_ne!(pairs[3], <[f64; 6]>::EMPTY);
        // Without joints and mass, a body has no pivot.
        diagonal = [<[f64; 6]>::EMPTY; 4];
        let mut system: System<'_, f64> =
            System { plan, diagonal: &mut diagonal, pairs: &mut pairs };
        assert_eq!(system.factor::<false>(), Err(BodyIndex(0)));
    }

    /// A ring of four bodies, of which the third has lever arms: the others' rotations couple with nothing.
    #[test]
    fn decoupled_bodies_are_solved_as_whole_ones() {
        let mut next = numbers();
        let mut diagonal = [<[f64; 6]>::EMPTY; 4];
        let mut pairs = [<[f64; 6]>::EMPTY; 5];
        for block in &mut diagonal {
            (0..6).for_each(|i| block[i][i] = 1.0 + 0.1 * i as f64);
        }
        for (ends, slot) in [[0, 1], [0, 3], [1, 2], [2, 3]].into_iter().zip([0, 1, 2, 4]) {
            for _ in 0..3 {
                let rows: [[f64; 6]; 2] = ends.map(|end| {
                    core::array::from_fn(|i| if i < 3 || end == 2 { next() } else { 0.0 })
                });
                ends.iter()
                    .zip(rows)
                    .for_each(|(end, row)| row.add_square(3.0, &mut diagonal[*end]));
                rows[1].add_product(-3.0, &rows[0], &mut pairs[slot]);
            }
        }
        let right: [Wrench<f64>; 4] =
            core::array::from_fn(|_| wrench(core::array::from_fn(|_| next())));
        let solved = |decoupled| {
            let (mut diagonal, mut pairs, mut right) = (diagonal, pairs, right);
            let plan = Plan { decoupled, ..RING };
            let mut system: System<'_, f64> =
                System { plan, diagonal: &mut diagonal, pairs: &mut pairs };
            system.factor::<true>().unwrap();
            system.substitute::<true>(&mut right);
            (diagonal, pairs, right.map(|x| (x.force, x.torque)))
        };
        assert_eq!(solved(&[true, false, false, true]), solved(&[]));
    }
}
