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
    pub targets: &'m [u16],
    /// For each group and then each torsion spring the slot of its bodies' pair; [`Plan::GROUND`] with the ground.
    pub slots: &'m [u16],
}

impl Plan<'_> {
    /// The slot of an element with one body only.
    pub const GROUND: u16 = u16::MAX;
    /// The empty plan.
    pub const NONE: Self = Self { order: &[], pairs: &[], targets: &[], slots: &[] };

    /// Whether it is valid for a model with the given number of bodies, and for these ends of its groups and torsion
    /// springs: then a solution by it is that of the whole matrix.
    #[must_use]
    pub fn fits(&self, bodies: usize, ends: impl Iterator<Item = [u16; 2]>) -> bool {
        let is_ground = |body: u16| usize::from(body) >= bodies;
        let place = |body: u16| self.order.iter().position(|[known, _]| *known == body);
        let all_once = self.order.len() == bodies
            && (0..bodies).all(|body| u16::try_from(body).is_ok_and(|body| place(body).is_some()));
        if !all_once {
            return false;
        }
        let places = |pair: &[u16; 2]| Some([place(pair[0])?, place(pair[1])?]);
        let mut last = None;
        for pair in self.pairs {
            let Some(now) = places(pair) else { return false };
            if now[0] >= now[1] || last.is_some_and(|last| last >= now) {
                return false;
            }
            last = Some(now);
        }
        let mut slots = self.slots.iter();
        for [a, b] in ends {
            let Some(&slot) = slots.next() else { return false };
            let held = match self.pairs.get(usize::from(slot)) {
                Some(pair) => *pair == [a, b] || *pair == [b, a],
                None => slot == Self::GROUND && (is_ground(a) || is_ground(b)),
            };
            if !held {
                return false;
            }
        }
        slots.next().is_none() && self.counts_fit() && self.targets_fit()
    }

    fn counts_fit(&self) -> bool {
        let of = |body: u16| self.pairs.iter().filter(|pair| pair[0] == body).count();
        self.order.iter().all(|[body, count]| of(*body) == usize::from(*count))
    }

    fn targets_fit(&self) -> bool {
        let mut targets = self.targets.iter();
        for [body, _] in self.order {
            let mut column = self.pairs.iter().filter(|pair| pair[0] == *body).enumerate();
            let with_it = self.pairs.iter().filter(|pair| pair[0] == *body);
            let all = column.all(|(i, [_, second])| {
                with_it.clone().take(i).all(|[_, first]| {
                    let target = targets.next().and_then(|row| self.pairs.get(usize::from(*row)));
                    target == Some(&[*first, *second])
                })
            });
            if !all {
                return false;
            }
        }
        targets.next().is_none()
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
