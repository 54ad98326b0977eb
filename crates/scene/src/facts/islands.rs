//! Connected bodies.
//!
//! `scene => islands`, sets of bodies joined by elements or interactions; the world does not connect bodies.

use crate::parts::Parts;
use crate::scene::Scene;

/// Bodies joined by elements or interactions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Island {
    /// Indices of its bodies, ascending.
    pub bodies: Vec<usize>,
    /// Whether an element or an interaction joins it to the world.
    pub grounded: bool,
    /// Groups, torsion springs and interactions that act on its bodies.
    pub elements: usize,
}

/// The islands of a scene in the order of their first bodies.
pub(super) fn islands(scene: &Scene) -> Vec<Island> {
    let model = &scene.model;
    let groups = model.groups.iter().map(|group| (group.a, group.b));
    let pairs = groups.chain(model.torsions.iter().map(|spring| (spring.a, spring.b)));
    let laws: Vec<_> = model.laws.bodies().collect();
    let pairs = pairs.chain(laws.iter().map(|[a, b]| (*a, *b)));
    let mut parts = Parts::apart(model.bodies.len());
    let coupled = model.laws.pairs().into_iter().map(|[a, b]| (a, b));
    for (a, b) in pairs.clone().chain(coupled).filter(|(a, b)| !a.is_world() && !b.is_world()) {
        parts.join(a.row(), b.row());
    }
    let mut islands = vec![Island::default(); model.bodies.len()];
    for row in 0..model.bodies.len() {
        islands[parts.first(row)].bodies.push(row);
    }
    for (a, b) in pairs {
        let body = if a.is_world() { b } else { a };
        let island = &mut islands[parts.first(body.row())];
        island.elements += 1;
        island.grounded |= a.is_world() || b.is_world();
    }
    islands.retain(|island| !island.bodies.is_empty());
    islands
}

#[cfg(test)]
mod tests {
    use crate::example;

    #[test]
    fn the_world_joins_nothing_by_itself() {
        let spring = |between: &str| {
            format!(
                "[[tsda]]\nbetween = {between}\npoints = [[0, 0, 0], [0, 0, 1]]\n\
                 stiffness = 1\nfree_length = 0\n"
            )
        };
        let islands = |elements: &str| {
            let islands = crate::facts::facts(&example::with(elements)).islands;
            islands.into_iter().map(|i| (i.bodies, i.grounded, i.elements)).collect::<Vec<_>>()
        };
        assert_eq!(islands(""), [(vec![0], false, 0), (vec![1], false, 0)]);
        let [grounded, joined] = [spring("[\"hand\", \"world\"]"), spring("[\"hand\", \"arm\"]")];
        assert_eq!(islands(&grounded), [(vec![0], false, 0), (vec![1], true, 1)]);
        assert_eq!(islands(&joined), [(vec![0, 1], false, 1)]);
        assert_eq!(islands(&(grounded + &joined)), [(vec![0, 1], true, 2)]);
    }
}
