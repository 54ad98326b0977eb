//! The elimination order of the bodies, and the fill-in of pairs.
//!
//! `(order, pairs, targets, slots) => plan`, plain index arrays stored in flash with the model. Computed when a model
//! is built; here they are only checked and used.

/// The blocks of a model's matrix, and the order in which its bodies are eliminated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Plan<'m> {
    /// Every body once, with the number of pairs that are eliminated with it.
    pub order: &'m [[u16; 2]],
    /// Pairs of bodies whose block is not empty, including fill-in: the one that is eliminated first, then the other;
    /// sorted by their positions in the order.
    pub pairs: &'m [[u16; 2]],
    /// For each body in order, for each two of its pairs that are eliminated with it, (second, first), (third, first),
    /// (third, second) …: the pair that their product changes.
    pub targets: &'m [u32],
    /// For each group and then each torsion spring the slot of its bodies' pair; [`Plan::GROUND`] with the ground.
    pub slots: &'m [u32],
    /// Per body, whether its rotations and those of the bodies eliminated with it later couple with nothing: all its
    /// elements act at centres of mass. Empty where that is not known.
    pub decoupled: &'m [bool],
}

impl Plan<'_> {
    /// The slot of an element with one body only: no pair has it.
    pub const GROUND: u32 = u32::MAX;
    /// The empty plan.
    pub const NONE: Self =
        Self { order: &[], pairs: &[], targets: &[], slots: &[], decoupled: &[] };

    /// Whether it is valid for a model with the given number of bodies, and for these ends of its groups and torsion
    /// springs: then a solution by it is that of the whole matrix.
    #[must_use]
    pub fn fits(&self, bodies: usize, ends: impl Iterator<Item = [u16; 2]>) -> bool {
        let is_there =
            |body: usize| self.order.iter().any(|[known, _]| usize::from(*known) == body);
        self.order.len() == bodies
            && (0..bodies).all(is_there)
            && self.columns_fit()
            && self.slots_fit(bodies, ends)
    }

    /// Whether the rotations of a body and of those eliminated with it later couple with nothing.
    #[inline(always)]
    pub(crate) fn is_decoupled(&self, body: usize) -> bool {
        self.decoupled.get(body).is_some_and(|decoupled| *decoupled)
    }

    /// Pairs and targets, body by body in order.
    fn columns_fit(&self) -> bool {
        let Self { mut order, mut pairs, mut targets, .. } = *self;
        while let Some(([body, count], later)) = order.split_first() {
            let Some((column, rest)) = pairs.split_at_checked(usize::from(*count)) else {
                return false;
            };
            let mut others = later.iter();
            let mut ascending = column
                .iter()
                .map(|[first, second]| first == body && others.any(|[other, _]| other == second));
            if !ascending.all(|follows| follows) {
                return false;
            }
            for (i, [_, second]) in column.iter().enumerate() {
                for [_, first] in column.iter().take(i) {
                    let Some((target, left)) = targets.split_first() else { return false };
                    if self.pairs.get(*target as usize) != Some(&[*first, *second]) {
                        return false;
                    }
                    targets = left;
                }
            }
            (order, pairs) = (later, rest);
        }
        pairs.is_empty() && targets.is_empty()
    }

    fn slots_fit(&self, bodies: usize, ends: impl Iterator<Item = [u16; 2]>) -> bool {
        let is_ground = |body: u16| usize::from(body) >= bodies;
        let mut slots = self.slots.iter();
        for [a, b] in ends {
            let Some(&slot) = slots.next() else { return false };
            let held = match self.pairs.get(slot as usize) {
                Some(pair) => *pair == [a, b] || *pair == [b, a],
                None => is_ground(a) || is_ground(b),
            };
            if !held {
                return false;
            }
        }
        slots.next().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of four bodies, the first on the ground: one pair is fill-in.
    const RING: Plan<'static> = Plan {
        order: &[[0, 2], [1, 2], [2, 1], [3, 0]],
        pairs: &[[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]],
        targets: &[3, 4],
        slots: &[Plan::GROUND, 0, 2, 4, 1],
        decoupled: &[],
    };
    const ENDS: [[u16; 2]; 5] = [[u16::MAX, 0], [0, 1], [2, 1], [2, 3], [3, 0]];

    #[test]
    fn a_plan_is_one_for_its_own_model_alone() {
        assert!(RING.fits(4, ENDS.into_iter()));
        assert!(!RING.fits(5, ENDS.into_iter()));
        assert!(!RING.fits(4, ENDS.into_iter().take(4)));
        assert!(
            !Plan { order: &[[0, 2], [1, 2], [1, 1], [3, 0]], ..RING }.fits(4, ENDS.into_iter())
        );
        let order = &[[0, 1], [1, 2], [2, 1], [3, 0]];
        assert!(!Plan { order, ..RING }.fits(4, ENDS.into_iter()));
        assert!(!Plan { targets: &[3], ..RING }.fits(4, ENDS.into_iter()));
        assert!(!Plan { targets: &[4, 3], ..RING }.fits(4, ENDS.into_iter()));
        assert!(!Plan { slots: &[Plan::GROUND, 0, 2, 4, 2], ..RING }.fits(4, ENDS.into_iter()));
        // Fill-in without a slot.
        let order = &[[0, 2], [1, 1], [2, 1], [3, 0]];
        let unfilled = Plan { order, pairs: &[[0, 1], [0, 3], [1, 2], [2, 3]], ..RING };
        let slots = &[Plan::GROUND, 0, 2, 3, 1];
        let unfilled = Plan { targets: &[3], slots, ..unfilled };
        assert!(!unfilled.fits(4, ENDS.into_iter()));
    }
}
