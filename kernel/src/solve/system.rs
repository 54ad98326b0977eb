//! A sparse symmetric system of one block per body and per pair of bodies, solved in place.
//!
//! `(plan, blocks, right sides) => solution`: block L·D·Lᵀ without pivoting (Golub & Van Loan 2013, section
//! 4.1), bodies in the order of the plan. For a positive definite matrix no pivot is needed.

use crate::forces::Wrench;
use crate::freedoms::Freedoms;
use crate::index::BodyIndex;
use crate::model::Plan;
use crate::space::{BlockOf, Space};

/// The blocks of a system, lent for a step.
pub(crate) struct System<'s, S: Space> {
    pub(crate) plan: Plan<'s>,
    /// One per body.
    pub(crate) diagonal: &'s mut [BlockOf<S>],
    /// One per pair: rows of the body that is eliminated later.
    pub(crate) pairs: &'s mut [BlockOf<S>],
}

impl<S: Space> System<'_, S> {
    /// Factors the matrix in place.
    ///
    /// # Errors
    /// The first body with a pivot that is not positive: its state or its neighbours' is beyond numbers.
    pub(crate) fn factor(&mut self) -> Result<(), BodyIndex> {
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
            for (i, [_, second]) in with.iter().enumerate() {
                let Some((before, [block, ..])) = here.split_at_mut_checked(i) else { break };
                S::Row::forward_block(block, &factor);
                let divided = S::Row::divided(block, &factor);
                for other in before.iter() {
                    let Some((target, rest)) = targets.split_first() else { break };
                    targets = rest;
                    let target = usize::from(*target).checked_sub(first);
                    if let Some(target) = target.and_then(|row| later.get_mut(row)) {
                        // The ones before are divided by now.
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

    /// Solves a factored system for right sides that lie in wrenches.
    pub(crate) fn substitute(&self, right: &mut [Wrench<S>]) {
        let (mut pairs, mut blocks) = (self.plan.pairs, &*self.pairs);
        for &[body, count] in self.plan.order {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            x.forward(factor);
            let count = usize::from(count);
            let Some((with, other_pairs)) = pairs.split_at_checked(count) else { break };
            let Some((here, later)) = blocks.split_at_checked(count) else { break };
            for ([_, second], block) in with.iter().zip(here) {
                if let Some(other) = right.get_mut(usize::from(*second)) {
                    let mut y = S::row(other.force, other.torque);
                    y.reduce_by(block, &x);
                    *other = wrench::<S>(y);
                }
            }
            x.divide(factor);
            if let Some(own) = right.get_mut(row) {
                *own = wrench::<S>(x);
            }
            (pairs, blocks) = (other_pairs, later);
        }
        let (mut pairs, mut blocks) = (self.plan.pairs, &*self.pairs);
        for &[body, count] in self.plan.order.iter().rev() {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            let before = pairs.len().saturating_sub(usize::from(count));
            let Some((other_pairs, with)) = pairs.split_at_checked(before) else { break };
            let Some((earlier, here)) = blocks.split_at_checked(before) else { break };
            for ([_, second], block) in with.iter().zip(here) {
                if let Some(other) = right.get(usize::from(*second)) {
                    x.reduce_by_transposed(block, &S::row(other.force, other.torque));
                }
            }
            x.backward(factor);
            if let Some(own) = right.get_mut(row) {
                *own = wrench::<S>(x);
            }
            (pairs, blocks) = (other_pairs, earlier);
        }
    }
}

fn wrench<S: Space>(row: S::Row) -> Wrench<S> {
    let (force, torque) = S::parts(row);
    Wrench { force, torque }
}
