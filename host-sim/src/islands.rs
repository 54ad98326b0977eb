//! Which bodies hang together.
//!
//! `scene => islands`, sets of bodies joined by elements; the world joins nothing by itself.

use dbd_kernel::BodyIndex;
use dbd_scene::Scene;

/// Bodies joined by elements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Island {
    /// Rows of its bodies, ascending.
    pub bodies: Vec<usize>,
    /// Whether an element joins it to the world.
    pub grounded: bool,
    /// Groups and torsion springs that act on its bodies.
    pub elements: usize,
}

/// The islands of a scene in the order of their first bodies.
#[must_use]
pub fn islands(scene: &Scene) -> Vec<Island> {
    let model = &scene.model;
    let groups = model.groups.iter().map(|group| (group.a, group.b));
    let springs = model.torsions.iter().map(|spring| (spring.a, spring.b));
    islands_of(model.bodies.len(), &groups.chain(springs).collect::<Vec<_>>())
}

fn islands_of(bodies: usize, pairs: &[(BodyIndex, BodyIndex)]) -> Vec<Island> {
    // The lowest row known to hang together with each body; lowered until nothing changes.
    let mut root: Vec<usize> = (0..bodies).collect();
    let mut changed = true;
    while changed {
        changed = false;
        for (a, b) in pairs.iter().filter(|(a, b)| !a.is_world() && !b.is_world()) {
            let lowest = root[a.row()].min(root[b.row()]);
            for row in [a.row(), b.row()] {
                changed |= root[row] != lowest;
                root[row] = lowest;
            }
        }
    }
    let mut islands = vec![Island::default(); bodies];
    for (row, first) in root.iter().enumerate() {
        islands[*first].bodies.push(row);
    }
    for (a, b) in pairs {
        let body = if a.is_world() { b } else { a };
        let island = &mut islands[root[body.row()]];
        island.elements += 1;
        island.grounded |= a.is_world() || b.is_world();
    }
    islands.retain(|island| !island.bodies.is_empty());
    islands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_rings_and_lone_bodies() {
        let (w, b) = (BodyIndex::WORLD, BodyIndex);
        let pairs = [(w, b(3)), (b(3), b(1)), (b(4), b(2)), (b(2), b(4))];
        let found = islands_of(5, &pairs);
        let expected = [
            Island { bodies: vec![0], grounded: false, elements: 0 },
            Island { bodies: vec![1, 3], grounded: true, elements: 2 },
            Island { bodies: vec![2, 4], grounded: false, elements: 2 },
        ];
        assert_eq!(found, expected);
    }
}
