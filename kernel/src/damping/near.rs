//! Which mounts of dampers share a body: so that not every one is held against every other.
//!
//! `(model) => per body the first mounts that it holds => of a pair all that may meet it`, in
//! ascending order. A body that holds more than it keeps is taken to hold any.

use core::iter::Peekable;

use crate::index::BodyIndex;

/// Mounts that a body keeps: a link has two joints, and on each a spring of two kinds.
const KEPT: usize = 8;

/// The mounts of dampers that a body holds, ascending.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Held {
    rows: [u32; KEPT],
    /// Those that it holds, also beyond what it keeps.
    count: u32,
}

impl Held {
    /// The mounts that it keeps, `None` where there are more.
    fn kept(&self) -> Option<&[u32]> {
        self.rows.get(..self.count as usize)
    }
}

/// Takes note of a mount between two bodies; mounts come in ascending order.
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

/// Of `mounts` those that may share a body with a pair, ascending, none twice.
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

    /// A body's joints, then their springs, and a hub with all of them: none that meets is missed,
    /// and the order is that of the scene.
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

    /// In a chain with springs beside its joints a mount looks at six, however long the chain is.
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
