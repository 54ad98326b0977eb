//! A sparse symmetric system of one block per body and per pair of bodies, solved in place.
//!
//! `(plan, blocks, right sides) => solution`: block L·D·Lᵀ without pivoting (Golub & Van Loan 2013, section
//! 4.1), bodies in the order of the plan. For a positive definite matrix no pivot is needed.

use crate::forces::Wrench;
use crate::index::BodyIndex;
use crate::solve::freedoms::Freedoms;
use crate::solve::plan::Plan;
use crate::space::Space;

/// The block of a space's freedoms.
pub type BlockOf<S> = <<S as Space>::Row as Freedoms>::Block;

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
        let (mut first, mut targets) = (0, self.plan.targets.iter());
        for &body in self.plan.order {
            let row = usize::from(body);
            let Some(block) = self.diagonal.get_mut(row) else { continue };
            if !S::Row::factor(block) {
                return Err(BodyIndex(body));
            }
            let factor = *block;
            let with = column(&self.plan, first, body);
            let Some((head, later)) = self.pairs.split_at_mut_checked(first + with.len()) else {
                continue;
            };
            let here = head.get_mut(first..).unwrap_or_default();
            for block in here.iter_mut() {
                S::Row::forward_block(block, &factor);
            }
            for i in 0..with.len() {
                let (Some((before, [block, ..])), Some([_, second])) =
                    (here.split_at_mut_checked(i), with.get(i))
                else {
                    continue;
                };
                let divided = S::Row::divided(block, &factor);
                for other in before.iter() {
                    let target = targets.next().map_or(0, |row| usize::from(*row));
                    let target = target.checked_sub(first + with.len());
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
            first += with.len();
        }
        Ok(())
    }

    /// Solves a factored system for right sides that lie in wrenches.
    pub(crate) fn substitute(&self, right: &mut [Wrench<S>]) {
        let mut first = 0;
        for &body in self.plan.order {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get_mut(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            x.forward(factor);
            let with = column(&self.plan, first, body);
            let blocks = self.pairs.get(first..).unwrap_or_default();
            for ([_, second], block) in with.iter().zip(blocks) {
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
            first += with.len();
        }
        for &body in self.plan.order.iter().rev() {
            let row = usize::from(body);
            let (Some(factor), Some(own)) = (self.diagonal.get(row), right.get(row)) else {
                continue;
            };
            let mut x = S::row(own.force, own.torque);
            let with = self.plan.pairs.get(..first).unwrap_or_default();
            let with = with.iter().rev().take_while(|pair| pair[0] == body).count();
            first -= with;
            let pairs = self.plan.pairs.iter().zip(self.pairs.iter()).skip(first).take(with);
            for ([_, second], block) in pairs {
                if let Some(other) = right.get(usize::from(*second)) {
                    x.reduce_by_transposed(block, &S::row(other.force, other.torque));
                }
            }
            x.backward(factor);
            if let Some(own) = right.get_mut(row) {
                *own = wrench::<S>(x);
            }
        }
    }
}

/// The pairs of a plan from `first` on that are eliminated with a body.
fn column<'p>(plan: &Plan<'p>, first: usize, body: u16) -> &'p [[u16; 2]] {
    let rest = plan.pairs.get(first..).unwrap_or_default();
    let count = rest.iter().take_while(|pair| pair[0] == body).count();
    rest.get(..count).unwrap_or_default()
}

fn wrench<S: Space>(row: S::Row) -> Wrench<S> {
    let (force, torque) = S::parts(row);
    Wrench { force, torque }
}
