//! Spring triples of TSDAs: a point of A joined to one or three points of B.
//!
//! `(group, ends) => force_pair`. Each distinct point is computed once; the forces on a point of B are added in the order
//! of its elements; force and torque on A add triple by triple, the torque on B leg by leg.
//!
//! Nearly every group has two triples with three common points or one triple and takes the specialised path of
//! [`block`]: its counts are compile-time constants, which eliminates loops, bounds and lists. [`rare`] handles the
//! rest.

use core::marker::PhantomData;

use crate::elements::tsda::Tsda;
use crate::forces::force_pair::{Dampers, ForcePair};
use crate::forces::springs::Springs;
use crate::geometry::Geometry;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{End, MAX_ARMS, Places};
use crate::real::Real as _;
use crate::space::{Linear, Space, Vector as _};

/// A group of TSDA triples.
#[inline(always)]
pub(super) fn triples<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    rests: &[P::Rest],
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    if P::RESTS && (rests.is_empty() || end_b.body().is_none()) {
        return rare::<P, T, D>(model, group, end_a, end_b);
    }
    match (group.triples, group.arms, end_b.body()) {
        (2, 3, Some(b)) if group.shared && !P::Space::PLANAR => {
            straight::<P, T, D, 2, 3>(model, rests, group, end_a, &b)
        }
        (1, 2, Some(b)) if P::Space::PLANAR => {
            straight::<P, T, D, 1, 2>(model, rests, group, end_a, &b)
        }
        (1, 3, Some(b)) if P::RESTS => block::<P, T, D, 1, 3>(model, rests, group, end_a, &b),
        (1, 1, Some(b)) if P::RESTS => block::<P, T, D, 1, 1>(model, rests, group, end_a, &b),
        (1, 3, _) if !P::Space::PLANAR => block::<P, T, D, 1, 3>(model, rests, group, end_a, end_b),
        (1, 1, _) => block::<P, T, D, 1, 1>(model, rests, group, end_a, end_b),
        _ => rare::<P, T, D>(model, group, end_a, end_b),
    }
}

/// Uncommon groups. More paths beside the common ones cost those registers, 3 % of a step of a chain of balls: so
/// [`apart`] is used only in models that have points on lines, too, whose joints are of several kinds; not in those of
/// every kind, whose size is known at run time: on a PC it costs these 2 % in single precision.
#[inline(always)]
fn rare<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    match (group.arms, end_b.body()) {
        (3, Some(b)) if T::LINES && !T::ALL && !P::RESTS && !group.shared => {
            apart::<P, T, D, 3>(model, group, end_a, &b)
        }
        _ => many::<P, T, D>(model, group, end_a, end_b),
    }
}

/// The reference TSDAs of a model, from its bodies' initial frames.
pub(crate) fn find_rests<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    rests: &mut [P::Rest],
) {
    let places = Places { frames, signals: &[] };
    for group in model.groups.iter().filter(|group| group.law == Law::Tsda) {
        let Some(frame) = frames.get(group.b.row()) else { continue };
        let end_a = End::new(model, places, group.a, None);
        for triple in 0..group.triples as usize {
            let Some(centre) = model.points.get(group.centre(triple)) else { break };
            let (centre, _) = end_a.place(centre);
            let arms = group.arms as usize;
            let first = group.element as usize + triple * arms;
            let (endpoints, springs) =
                (group.endpoints(triple), model.tsdas.get(first..first + arms));
            let (Some(endpoints), Some(springs), Some(rests)) = (
                model.points.get(endpoints..endpoints + arms),
                springs,
                rests.get_mut(first..first + arms),
            ) else {
                break;
            };
            let mut free_lengths = [P::Real::ZERO; MAX_ARMS];
            for (length, spring) in free_lengths.iter_mut().zip(springs) {
                *length = spring.free_length;
            }
            P::find_rests(frame, &centre, endpoints, &free_lengths, rests);
        }
    }
}

/// A revolute's triples. Duplicated: where an end is known to be a body or the ground, no point is tested for its
/// owner. The ground is nearly always the first.
#[inline(always)]
fn straight<P: Geometry, T: Terms<P>, D: Dampers, const TRIPLES: usize, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    rests: &[P::Rest],
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    // Ground moved by an input is tested for at each point, or takes the general path: see [`rare`].
    if T::LINES && !T::ALL {
        return match (end_a.body(), end_a.still()) {
            (Some(a), _) => block::<P, T, D, TRIPLES, ARMS>(model, rests, group, &a, end_b),
            (None, Some(a)) => block::<P, T, D, TRIPLES, ARMS>(model, rests, group, &a, end_b),
            (None, None) => rare::<P, T, D>(model, group, end_a, end_b),
        };
    }
    match end_a.body() {
        Some(a) => block::<P, T, D, TRIPLES, ARMS>(model, rests, group, &a, end_b),
        None => block::<P, T, D, TRIPLES, ARMS>(model, rests, group, &end_a.ground(), end_b),
    }
}

/// `TRIPLES` triples with `ARMS` common points of B. `None` where the model lacks them.
#[inline(always)]
fn block<P: Geometry, T: Terms<P>, D: Dampers, const TRIPLES: usize, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    rests: &[P::Rest],
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let points = model.points.get(group.centre(0)..group.centre(0) + TRIPLES + ARMS)?;
    let springs = grid(model.tsdas, group.element as usize)?;
    let rests = if P::RESTS { Some(grid(rests, group.element as usize)?) } else { None };
    pull::<P, T, D, TRIPLES, ARMS>(model, group, (points, springs, rests), end_a, end_b)
}

/// The points of triples, their springs, and the reference TSDAs where the precision stores any.
type Parts<'m, P, const TRIPLES: usize, const ARMS: usize> = (
    &'m [<P as Geometry>::Local],
    &'m [[Tsda<<P as Geometry>::Real>; ARMS]; TRIPLES],
    Option<&'m [[<P as Geometry>::Rest; ARMS]; TRIPLES]>,
);

/// The record of `TRIPLES` triples with `ARMS` common points of B: unrolled, each sum starting with its first term.
/// `None` where the model lacks a part.
#[inline(always)]
pub(super) fn pull<
    P: Geometry,
    T: Terms<P>,
    D: Dampers,
    const TRIPLES: usize,
    const ARMS: usize,
>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    (points, springs, rests): Parts<'_, P, TRIPLES, ARMS>,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let (centres, endpoints) = points.split_first_chunk::<TRIPLES>()?;
    let endpoints: &[_; ARMS] = endpoints.first_chunk()?;
    let (clearance, kinds) = (model.clearance(group), PhantomData);
    Some(match group.damper.row() {
        // Separate: damping is not tested for each spring.
        Some(row) if D::ACT && T::DAMPERS => {
            let dampers = Some(grid(model.dampers, row)?);
            let springs = Springs::<P, T, D, _, _> { springs, rests, dampers, clearance, kinds };
            springs.force_pair(centres, endpoints, end_a, end_b)
        }
        _ => {
            let dampers = None;
            let springs = Springs::<P, T, D, _, _> { springs, rests, dampers, clearance, kinds };
            springs.force_pair(centres, endpoints, end_a, end_b)
        }
    })
}

/// `M` times `N` rows from `first` on.
#[inline(always)]
pub(super) fn grid<V, const N: usize, const M: usize>(
    all: &[V],
    first: usize,
) -> Option<&[[V; N]; M]> {
    all.get(first..first + N * M)?.as_chunks().0.first_chunk()
}

/// Any number of triples with `ARMS` separate points of B each, as in a fixed joint: as [`many`], but without tests at
/// each point.
#[inline(always)]
fn apart<P: Geometry, T: Terms<P>, D: Dampers, const ARMS: usize>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let clearance = model.clearance(group);
    let mut force_pair = ForcePair::ZERO;
    for triple in 0..group.triples as usize {
        let centre = model.points.get(group.centre(triple))?;
        let endpoints = model.points.get(group.endpoints(triple)..)?.first_chunk::<ARMS>()?;
        let springs = grid(model.tsdas, group.element as usize + triple * ARMS)?;
        let dampers = match group.damper.row() {
            Some(row) if D::ACT && T::DAMPERS => Some(grid(model.dampers, row + triple * ARMS)?),
            _ => None,
        };
        let kinds = PhantomData::<(T, D)>;
        let triple = Springs { springs, rests: None, dampers, clearance, kinds };
        triple.add(centre, endpoints, end_a, end_b, &mut force_pair);
    }
    Some(force_pair)
}

/// Any number of triples with common or separate points of B.
#[inline(always)]
fn many<P: Geometry, T: Terms<P>, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let (triples, arms) = (group.triples as usize, group.arms as usize);
    let springs = model.tsdas.get(group.element as usize..)?;
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..),
        _ => None,
    };
    let clearance = model.clearance(group);
    let mut force_pair = ForcePair::ZERO;
    let mut pulls = [P::Vector::ZERO; MAX_ARMS];
    for triple in 0..triples {
        let (centre, arm_a) = end_a.place(model.points.get(group.centre(triple))?);
        let mut pull_a = P::Vector::ZERO;
        for (arm, pull_b) in pulls.iter_mut().take(arms).enumerate() {
            let element = triple * arms + arm;
            let spring = springs.get(element)?;
            let (endpoint, arm_b) = end_b.place(model.points.get(group.endpoints(triple) + arm)?);
            let elongation = P::elongation(&centre, &endpoint, spring.free_length);
            let pull = match dampers.and_then(|dampers| dampers.get(element)) {
                Some(&damping) => {
                    let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                    spring.damped_pull(damping, &elongation, v_rel, clearance)
                }
                None => spring.pull(&elongation, clearance),
            };
            pull_a = pull_a + pull;
            *pull_b = *pull_b + pull;
            if !group.shared || triple + 1 == triples {
                force_pair.torque_b = force_pair.torque_b + arm_b.cross(*pull_b);
                *pull_b = P::Vector::ZERO;
            }
        }
        force_pair.force = force_pair.force + pull_a;
        force_pair.torque_a = force_pair.torque_a + arm_a.cross(pull_a);
    }
    Some(force_pair)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, BodyState};
    use crate::elements::element::Law;
    use crate::forces::force_pair::{DampersLeft, ExplicitDampers};
    use crate::geometry::F64;
    use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
    use crate::model::{Model, ModelOwner as _};
    use crate::pose::Places;
    use crate::vector::Vec3;

    const WORLD: BodyIndex = BodyIndex::WORLD;
    const FIRST: BodyIndex = BodyIndex(0);
    const SECOND: BodyIndex = BodyIndex(1);

    /// Two triples with common points.
    fn group(between: [BodyIndex; 2], triples: u8, arms: u8) -> Group {
        Group {
            law: Law::Tsda,
            a: between[0],
            b: between[1],
            triples,
            arms,
            shared: triples == 2,
            point: 0,
            element: 0,
            damper: DamperIndex(0),
            clearance: ClearanceIndex::NONE,
        }
    }

    /// Both paths for one group, in a pose and motion without any symmetry.
    fn both_ways<D: Dampers>(group: Group, coincident: bool) -> [ForcePair<f64>; 2] {
        let spring = |i: i32| Tsda {
            stiffness: 1e4 + 37.0 * f64::from(i),
            free_length: 0.05 + 1e-3 * f64::from(i),
        };
        let mut points = [
            Vec3::new(0.11, -0.02, 0.03),
            Vec3::new(0.1, 0.01, -0.04),
            Vec3::new(-0.2, 0.05, 0.01),
            Vec3::new(-0.17, -0.03, 0.02),
            Vec3::new(-0.19, 0.02, -0.06),
        ];
        let mut state = BodyState::<F64>::new(
            [0.3, -0.1, 0.2],
            [0.8, 0.0, 0.6, 0.0],
            [1.0, -2.0, 0.5],
            [0.3, -0.7, 1.1],
        );
        let mut states = [state; 2];
        state.velocity = Vec3::new(-0.4, 0.2, 0.9);
        states[1] = state;
        if coincident {
            points[3] = points[1];
        } else {
            states[1].position = Vec3::new(0.35, -0.12, 0.21);
        }
        let model = Model::<F64, 2, 1, 12, 9, 0, 9, 0, 0, 0, 1, 0, 0, 1> {
            bodies: [Body::<f64>::new(1.0, [1.0; 3]); 2],
            initial: states,
            gravity: [],
            groups: [group],
            points: core::array::from_fn(|i| points[i % 5] * (1.0 + 0.1 * (i / 5) as f64)),
            tsdas: core::array::from_fn(|i| spring(i as i32)),
            bushings: [],
            dampers: core::array::from_fn(|i| 10.0 + i as f64),
            torsions: [],
            loads: [],
            lines: [Default::default()],
            inputs: [],
            knots: [],
            clearances: [1e-3],
            revolutes: [],
            universals: [],
            sources: [],
            laws: (),
        };
        let frames = states.map(|state| F64::frame(&state.position, &state.orientation));
        let view = model.view();
        let places = Places { frames: &frames, signals: &[] };
        let end = |body| End::new(&view, places, body, Some(&states));
        let (a, b) = (end(group.a), end(group.b));
        let straight = triples::<F64, _, D>(&view, &[], &group, &a, &b).unwrap();
        [straight, many::<F64, _, D>(&view, &group, &a, &b).unwrap()]
    }

    /// The moment on the ground is not compared.
    fn assert_same(group: Group, [straight, long]: [ForcePair<f64>; 2]) {
        assert_eq!(straight.force, long.force, "{group:?}");
        assert!(group.a.is_world() || straight.torque_a == long.torque_a, "{group:?}");
        assert!(group.b.is_world() || straight.torque_b == long.torque_b, "{group:?}");
        assert!(straight.force.dot(straight.force) > 0.0);
    }

    #[test]
    fn the_straight_line_has_the_bits_of_the_long_way() {
        for between in [[FIRST, SECOND], [WORLD, SECOND], [FIRST, WORLD]] {
            for (triples, arms) in [(2, 3), (1, 3), (1, 1), (3, 3)] {
                let free = group(between, triples, arms);
                let clear = Group { clearance: ClearanceIndex(0), ..free };
                for group in [free, clear] {
                    assert_same(group, both_ways::<DampersLeft>(group, false));
                    assert_same(group, both_ways::<ExplicitDampers>(group, false));
                }
            }
        }
        // Where points coincide there is no direction; the other springs still act.
        let group = group([FIRST, SECOND], 2, 3);
        let [straight, long] = both_ways::<DampersLeft>(group, true);
        assert_same(group, [straight, long]);
    }

    #[test]
    fn what_a_model_lacks_has_no_record() {
        let lacking = [
            Group { point: 1, ..group([FIRST, SECOND], 2, 3) },
            Group { element: 1, ..group([FIRST, SECOND], 2, 3) },
            Group { point: 3, ..group([FIRST, SECOND], 1, 3) },
        ];
        let model = Model::<F64, 1, 0, 5, 6, 0> {
            bodies: [Body::<f64>::new(1.0, [1.0; 3])],
            initial: [BodyState::default()],
            gravity: [],
            groups: [],
            points: [Vec3::ZERO; 5],
            tsdas: [Tsda::default(); 6],
            bushings: [],
            dampers: [],
            torsions: [],
            loads: [],
            lines: [],
            inputs: [],
            knots: [],
            clearances: [],
            revolutes: [],
            universals: [],
            sources: [],
            laws: (),
        };
        let view = model.view();
        let frame = F64::frame(&Vec3::ZERO, &Default::default());
        let places = Places { frames: &[frame; 2], signals: &[] };
        for group in lacking {
            let end = |body| End::new(&view, places, body, None);
            let (a, b) = (end(group.a), end(group.b));
            assert!(
                triples::<F64, _, DampersLeft>(&view, &[], &group, &a, &b).is_none(),
                "{group:?}"
            );
        }
    }
}
