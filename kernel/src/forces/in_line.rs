//! Uniform groups: all of one kind, their points and elements in the order of the groups.
//!
//! `(model, ends) => records, added to the wrenches`. The kind of a group and the location of its parts need no lookup:
//! for most mechanisms, whose joints are all revolutes. Whether a model may be uniform is known at compile time from
//! its kinds of element; a model of every kind, whose size is known at run time, takes the general path.

use core::marker::PhantomData;

use crate::body::BodyState;
use crate::elements::element::Law;
use crate::forces::force_pair::{Dampers, ForcePair, Wrench, apply};
use crate::forces::triples::{grid, pull};
use crate::forces::two_points::TwoPoints;
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, Places};
use crate::space::Space as _;

/// The kind of all groups of a model with these kinds of element, as far as they determine it: its law, spring triples
/// and legs.
const fn kind<P: Geometry, T: Terms<P>>(planar: bool) -> Option<(Law, usize, usize)> {
    let others = T::LINES || T::UNIVERSALS || T::CLEARANCES || T::INPUTS;
    match (T::TSDAS, T::BUSHINGS, T::REVOLUTES) {
        _ if others => None,
        (true, false, false) if planar => Some((Law::Tsda, 1, 2)),
        (true, false, false) => Some((Law::Tsda, 2, 3)),
        (false, true, false) => Some((Law::PointBushing, 1, 1)),
        (false, false, true) => Some((Law::Revolute, 1, 1)),
        _ => None,
    }
}

/// Whether a model with these kinds of element may be uniform: a constant, so that the code of others is not compiled.
pub(super) struct MayBe<P, T>(PhantomData<(P, T)>);

impl<P: Geometry, T: Terms<P>> MayBe<P, T> {
    pub(super) const UNIFORM: bool = kind::<P, T>(P::Space::PLANAR).is_some();
}

/// Whether the groups of a model are uniform, each on a body.
pub(crate) fn are_in_line<P: Geometry, T: Terms<P>>(model: &ModelRef<'_, P, T>) -> bool {
    let Some((law, triples, arms)) = kind::<P, T>(P::Space::PLANAR) else { return false };
    let is_next = |(i, group): (usize, &Group)| {
        let (point, element) = (i * (triples + arms), i * triples * arms);
        group.law == law
            && (group.triples as usize, group.arms as usize) == (triples, arms)
            && group.shared == (triples > 1)
            && (group.point as usize, group.element as usize) == (point, element)
            && !group.b.is_world()
    };
    model.groups.iter().enumerate().all(is_next)
}

/// Adds the records of the groups of a model that [`are_in_line`]. Branches on constants, not a match on [`kind`]: what a
/// model does not have is not compiled.
#[inline(always)]
pub(super) fn add<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (bodies, rests): (&[BodyState<P>], &[P::Rest]),
    wrenches: &mut [Wrench<P::Space>],
) {
    let at = (places, bodies);
    if T::TSDAS {
        if P::Space::PLANAR {
            add_triples::<P, T, D, 1, 2, 3, 2>(model, rests, at, wrenches);
        } else {
            add_triples::<P, T, D, 2, 3, 5, 6>(model, rests, at, wrenches);
        }
    } else if T::BUSHINGS {
        add_pairs::<P, T, D, _>(model, model.bushings, at, wrenches);
    } else {
        add_pairs::<P, T, D, _>(model, model.revolutes, at, wrenches);
    }
}

/// Poses and velocities of the bodies.
type Where<'s, P> = (Places<'s, P>, &'s [BodyState<P>]);

/// Spring triples with common points of B.
#[inline(always)]
fn add_triples<
    P: Geometry,
    T: Terms<P>,
    D: Dampers,
    const TRIPLES: usize,
    const ARMS: usize,
    const POINTS: usize,
    const SPRINGS: usize,
>(
    model: &ModelRef<'_, P, T>,
    rests: &[P::Rest],
    at: Where<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let (places, bodies) = at;
    let points = model.points.as_chunks::<POINTS>().0;
    let springs = model.tsdas.as_chunks::<SPRINGS>().0;
    let rests = rests.as_chunks::<SPRINGS>().0;
    for (i, (group, (points, springs))) in
        model.groups.iter().zip(points.iter().zip(springs)).enumerate()
    {
        let moving = D::ACT && T::DAMPERS && group.damper.row().is_some();
        let moving = if moving { Some(bodies) } else { None };
        let end_a = End::new(model, places, group.a, moving);
        let Some(b) = End::new(model, places, group.b, moving).body() else {
            if P::Space::PLANAR {
                break;
            }
            continue;
        };
        let Some(springs) = grid(springs, 0) else { break };
        let rests = if P::RESTS {
            let Some(rests) = rests.get(i) else { break };
            grid(rests, 0)
        } else {
            None
        };
        let parts = (points.as_slice(), springs, rests);
        let force_pair: Option<ForcePair<_>> = match end_a.body() {
            Some(a) => pull::<P, T, D, TRIPLES, ARMS>(model, group, parts, &a, &b),
            None => pull::<P, T, D, TRIPLES, ARMS>(model, group, parts, &end_a.ground(), &b),
        };
        let Some(force_pair) = force_pair else { break };
        apply(wrenches, group.a.row(), group.b.row(), &force_pair);
    }
}

/// A point of each body and one element.
#[inline(always)]
fn add_pairs<P: Geometry, T: Terms<P>, D: Dampers, L: TwoPoints<P>>(
    model: &ModelRef<'_, P, T>,
    elements: &[L],
    at: Where<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let (places, bodies) = at;
    let points = model.points.as_chunks().0;
    for (group, (points, element)) in model.groups.iter().zip(points.iter().zip(elements)) {
        let moving = D::ACT && T::DAMPERS && group.damper.row().is_some();
        let moving = if moving { Some(bodies) } else { None };
        let end_a = End::new(model, places, group.a, moving);
        let Some(b) = End::new(model, places, group.b, moving).body() else { continue };
        let damping = match group.damper.row() {
            Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
            _ => None,
        };
        let force_pair = match end_a.body() {
            Some(a) => element.force_pair(points, damping, &a, &b),
            None => element.force_pair(points, damping, &end_a.ground(), &b),
        };
        apply(wrenches, group.a.row(), group.b.row(), &force_pair);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::elements::point_bushing::PointBushing;
    use crate::elements::revolute::Revolute;
    use crate::elements::tsda::Tsda;
    use crate::forces::force_pair::{At, ExplicitDampers, Memories};
    use crate::forces::{Evaluation, Instant, evaluate};
    use crate::geometry::F64;
    use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
    use crate::laws::Laws as _;
    use crate::model::{Model, ModelOwner, SpaceOf};
    use crate::planar::Planar64;
    use crate::space::Linear as _;

    /// The wrenches of a uniform model by both paths.
    fn both_ways<M: ModelOwner>(model: &M) -> [M::PerBody<Wrench<SpaceOf<M>>>; 2] {
        let view = model.view();
        [true, false].map(|in_line| {
            let mut frames = model.per_body(Default::default());
            let mut wrenches = model.per_body(Wrench::default());
            let instant = Instant {
                step: 0,
                windows: &[],
                signals: &[],
                bodies: model.initial(),
                in_line,
                rests: &[],
                placed: false,
            };
            let out = Evaluation {
                frames: frames.as_mut(),
                wrenches: wrenches.as_mut(),
                unpushed: &mut [],
            };
            let mut laws = view.laws.states();
            let memories =
                Memories { turns: &mut [], laws: &mut laws, at: At::Stage, advance: None };
            evaluate::<_, _, ExplicitDampers>(&view, instant, memories, out).unwrap();
            wrenches
        })
    }

    /// A body on the ground and another on it, with the elements of a kind between them.
    macro_rules! assert_same {
        ($geometry:ident, $model:ty, $kind:expr, $tsdas:expr, $bushings:expr, $revolutes:expr) => {{
            let (law, triples, arms) = $kind;
            let group = |i: u8, a| Group {
                law,
                a,
                b: BodyIndex(u16::from(i)),
                triples,
                arms,
                shared: triples > 1,
                point: u16::from(i * (triples + arms)),
                element: u16::from(i * triples * arms),
                damper: if i == 0 { DamperIndex::NONE } else { DamperIndex(0) },
                clearance: ClearanceIndex::NONE,
            };
            let state = |at: f64| {
                let (x, turn) = ([0.3 + at, -0.2 * at, 0.0], [0.8, 0.0, 0.0, 0.6]);
                BodyState::<$geometry>::from_f64(x, turn, [1.0, at, 0.0], [0.0, 0.0, 0.7 - at])
            };
            let mut model: $model = Model {
                bodies: [Body::from_f64(1.0, [1.0; 3]); 2],
                initial: [state(0.0), state(0.4)],
                gravity: [],
                groups: [group(0, BodyIndex::WORLD), group(1, BodyIndex(0))],
                points: core::array::from_fn(|i| {
                    let i = i as f64;
                    $geometry::local_from_f64([0.1 * i, 0.03 * i * i, 0.02 * i])
                }),
                tsdas: $tsdas,
                bushings: $bushings,
                dampers: [3.0; 6],
                torsions: [],
                loads: [],
                lines: [],
                inputs: [],
                knots: [],
                clearances: [],
                revolutes: $revolutes,
                universals: [],
                sources: [],
                laws: (),
            };
            assert!(are_in_line(&model.view()));
            let [short, long] = both_ways(&model);
            assert_eq!(short, long);
            assert!(short.iter().all(|wrench| wrench.force.dot(wrench.force) > 1.0));
            model.groups.swap(0, 1);
            assert!(!are_in_line(&model.view()));
        }};
    }

    #[test]
    fn groups_in_line_pull_as_the_long_way_does() {
        let spring = |i: usize| Tsda { stiffness: 100.0 + i as f64, free_length: 0.2 };
        let bushings = [40.0, 50.0].map(|stiffness| PointBushing { stiffness });
        let revolutes =
            [40.0, 50.0].map(|k| Revolute::from_f64(k, 0.3, [[0.0, 0.1, 0.3], [0.1, 0.0, 0.3]]));
        assert_same!(F64, Model<F64, 2, 2, 10, 12, 0, 6>, (Law::Tsda, 2, 3),
            core::array::from_fn(spring), [], []);
        assert_same!(Planar64, Model<Planar64, 2, 2, 6, 4, 0, 6>, (Law::Tsda, 1, 2),
            core::array::from_fn(spring), [], []);
        assert_same!(Planar64, Model<Planar64, 2, 2, 4, 0, 2, 6>, (Law::PointBushing, 1, 1),
            [], bushings, []);
        assert_same!(F64, Model<F64, 2, 2, 4, 0, 0, 6, 0, 0, 0, 0, 0, 0, 0, 2>, (Law::Revolute, 1, 1),
            [], [], revolutes);
    }
}
