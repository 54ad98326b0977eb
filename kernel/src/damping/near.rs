//! Which mounts of dampers share a body, so that not all pairs need to be compared.
//!
//! `(model) => per body its first mounts => for a pair all candidates`, in ascending order. A body with more mounts
//! than are stored counts as sharing all.

use core::iter::Peekable;

use crate::index::BodyIndex;

/// Stored mounts per body: a link has two joints, each with springs of two kinds.
const KEPT: usize = 8;

/// The mounts of dampers on a body, ascending.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Held {
    rows: [u32; KEPT],
    /// The number of mounts, stored or not.
    count: u32,
}

impl Held {
    /// The stored mounts, `None` where there are more.
    fn kept(&self) -> Option<&[u32]> {
        self.rows.get(..self.count as usize)
    }
}

/// Records a mount between two bodies; mounts come in ascending order.
pub(super) fn hold(held: &mut [Held], ends: [BodyIndex; 2], mount: usize) {
    let [a, b] = ends;
    for body in [Some(a), (a != b).then_some(b)].into_iter().flatten() {
        let Some(body) = held.get_mut(body.row()) else { continue };
        if let Some(row) = body.rows.get_mut(body.count as usize) {
            *row = mount as u32;
        }
        body.count = body.count.saturating_add(1);
    }
}

/// Those of `mounts` that may share a body with a pair, ascending, without duplicates.
pub(super) fn near(held: &[Held], ends: [BodyIndex; 2], mounts: usize) -> Near<'_> {
    let [a, b] = ends.map(|body| held.get(body.row()).map_or(Some(&[][..]), Held::kept));
    match (a, b) {
        (Some(a), Some(b)) => Near::Kept([a, b].map(|rows| rows.iter().peekable())),
        _ => Near::All(0..mounts),
    }
}

/// Rows of mounts.
pub(super) enum Near<'h> {
    Kept([Peekable<core::slice::Iter<'h, u32>>; 2]),
    All(core::ops::Range<usize>),
}

impl Iterator for Near<'_> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        match self {
            Self::All(rows) => rows.next(),
            Self::Kept(lists) => {
                let [a, b] = lists.each_mut().map(|list| list.peek().map(|row| **row));
                let least = match (a, b) {
                    (Some(a), Some(b)) => a.min(b),
                    (one, other) => one.or(other)?,
                };
                for list in lists {
                    list.next_if(|row| **row == least);
                }
                Some(least as usize)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;
    use std::vec::Vec;

    use crate::damping::motion::meet;

    fn held(bodies: usize, pairs: &[[BodyIndex; 2]]) -> Vec<Held> {
        let mut held = vec![Held::default(); bodies];
        for (mount, ends) in pairs.iter().enumerate() {
            hold(&mut held, *ends, mount);
        }
        held
    }

    /// A body's joints, then their springs, and a hub with all of them: no mount that shares a body is missed, and the
    /// order is that of the scene.
    #[test]
    fn all_that_meet_are_near_in_order() {
        let chain = (0..30_u16)
            .map(|i| [i.checked_sub(1).map_or(BodyIndex::WORLD, BodyIndex), BodyIndex(i)]);
        let hub = (1..30).map(|i| [BodyIndex(0), BodyIndex(i)]);
        for pairs in [
            chain.clone().collect(),
            chain.clone().chain(chain.clone()).collect(),
            chain.chain(hub).collect::<Vec<_>>(),
        ] {
            let held = held(30, &pairs);
            for ends in &pairs {
                let near: Vec<usize> = near(&held, *ends, pairs.len()).collect();
                assert!(near.is_sorted_by(|a, b| a < b), "{near:?}");
                let meeting = (0..pairs.len()).filter(|other| meet(*ends, pairs[*other]));
                let found = near.iter().copied().filter(|other| meet(*ends, pairs[*other]));
                assert!(meeting.eq(found), "{ends:?}: {near:?}");
            }
        }
    }

    /// In a chain with springs parallel to its joints each mount has six candidates, however long the chain is.
    #[test]
    fn what_is_looked_at_grows_with_the_bodies_alone() {
        let looks = |bodies: u16| {
            let links = (0..bodies)
                .map(|i| [i.checked_sub(1).map_or(BodyIndex::WORLD, BodyIndex), BodyIndex(i)]);
            let pairs: Vec<_> = links.clone().chain(links).collect();
            let held = held(bodies.into(), &pairs);
            pairs.iter().map(|ends| near(&held, *ends, pairs.len()).count()).sum::<usize>()
        };
        assert_eq!(looks(10), 2 * (6 * 10 - 4));
        assert_eq!(looks(10_000), 2 * (6 * 10_000 - 4));
    }
}
