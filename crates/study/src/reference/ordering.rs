//! The order in which bodies are eliminated: least degree first.
//!
//! `(bodies, pairs) => order`. Each elimination connects the neighbours of the eliminated body; the one with the fewest
//! neighbours is next, the first of several (Tinney & Walker 1967). Chains and loops have almost no fill-in.

use std::collections::BTreeSet;

/// The bodies in the order of their elimination.
#[must_use]
pub fn least_degree(bodies: usize, pairs: &BTreeSet<(usize, usize)>) -> Vec<usize> {
    let mut neighbours = vec![BTreeSet::new(); bodies];
    for &(a, b) in pairs {
        neighbours[a].insert(b);
        neighbours[b].insert(a);
    }
    let mut left: BTreeSet<usize> = (0..bodies).collect();
    let mut order = Vec::with_capacity(bodies);
    while let Some(next) = left.iter().copied().min_by_key(|body| neighbours[*body].len()) {
        left.remove(&next);
        order.push(next);
        let joined = std::mem::take(&mut neighbours[next]);
        for &a in &joined {
            neighbours[a].remove(&next);
            neighbours[a].extend(joined.iter().copied().filter(|b| *b != a));
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_gives_its_middle_last() {
        let pairs = (1..5).map(|tip| (0, tip)).collect();
        let order = least_degree(5, &pairs);
        assert_eq!(order.iter().position(|body| *body == 0), Some(3), "{order:?}");
        assert_eq!(order.iter().copied().collect::<BTreeSet<_>>(), (0..5).collect());
    }
}
