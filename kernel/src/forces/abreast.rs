//! Alike joints of TSDAs, several at a time, one per lane.
//!
//! `(groups, poses) => force pairs, added to the wrenches`: with the bits of one joint after the other, and in their
//! order. Only on a PC, in models whose size is known at run time: spherical and revolute joints, in the plane revolute
//! joints, two at a time in double precision and four in single.

use core::marker::PhantomData;
use core::slice::Iter;

use crate::elements::tsda::Tsda;
use crate::force_pair::{ForcePair, Wrench, apply};
use crate::forces::force_pair::DampersLeft;
use crate::forces::springs::Springs;
use crate::forces::triples::grid;
use crate::geometry::Geometry;
use crate::model::{AllTerms, Group, Law, ModelRef, Terms};
use crate::pose::End;
use crate::real::Real;
use crate::space::Space as _;

/// Whether joints of a model are computed several at a time.
pub(super) struct Abreast<P, T>(PhantomData<(P, T)>);

impl<P: Geometry, T: Terms<P>> Abreast<P, T> {
    pub(super) const MAY_BE: bool = cfg!(all(target_arch = "x86_64", target_feature = "sse2"))
        && T::ALL
        && P::Real::ONE_LANE
        && !<P::Abreast as Geometry>::Real::ONE_LANE;
}

/// The parts of a joint of `TRIPLES` triples with `ARMS` common points of B.
struct Joint<'s, P: Geometry, const TRIPLES: usize, const ARMS: usize> {
    ends: [&'s P::Frame; 2],
    centres: &'s [P::Local; TRIPLES],
    endpoints: &'s [P::Local; ARMS],
    springs: &'s [[Tsda<P::Real>; ARMS]; TRIPLES],
}

impl<P: Geometry, const TRIPLES: usize, const ARMS: usize> Clone for Joint<'_, P, TRIPLES, ARMS> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: Geometry, const TRIPLES: usize, const ARMS: usize> Copy for Joint<'_, P, TRIPLES, ARMS> {}

/// What the joints are made of.
struct Source<'s, P: Geometry> {
    frames: &'s [P::Frame],
    /// The frame of the ground, with which its points have the bits of those as stored.
    ground: &'s P::Frame,
    points: &'s [P::Local],
    springs: &'s [Tsda<P::Real>],
    /// Whether dampers act.
    damped: bool,
}

impl<'s, P: Geometry> Source<'s, P> {
    /// The parts of a group of this kind without damper, clearance and moved ground.
    #[inline(always)]
    fn joint<const TRIPLES: usize, const ARMS: usize>(
        &self,
        group: &Group,
    ) -> Option<Joint<'s, P, TRIPLES, ARMS>> {
        let is_alike = group.law == Law::Tsda
            && (group.triples as usize, group.arms as usize) == (TRIPLES, ARMS)
            && group.shared == (TRIPLES > 1)
            && group.clearance.row().is_none()
            && !(self.damped && group.damper.row().is_some())
            && group.a.anchor_row().is_none()
            && group.b.anchor_row().is_none();
        if !is_alike {
            return None;
        }
        let frame = |row| self.frames.get(row).unwrap_or(self.ground);
        let (centres, others) =
            self.points.get(group.point as usize..)?.split_first_chunk::<TRIPLES>()?;
        Some(Joint {
            ends: [frame(group.a.row()), frame(group.b.row())],
            centres,
            endpoints: others.first_chunk()?,
            springs: grid(self.springs, group.element as usize)?,
        })
    }

    /// Adds the force pairs of the first groups, as long as there are two alike; `LANES` at a time.
    #[inline(always)]
    fn add<const LANES: usize, const TRIPLES: usize, const ARMS: usize>(
        &self,
        groups: &mut Iter<'_, Group>,
        wrenches: &mut [Wrench<P::Space>],
    ) {
        loop {
            let block = groups.as_slice();
            let joint = |row| block.get(row).and_then(|group| self.joint::<TRIPLES, ARMS>(group));
            let Some(first) = joint(0) else { return };
            let mut joints = [first; LANES];
            let mut count = 1;
            while count < LANES
                && let Some(place) = joints.get_mut(count)
                && let Some(next) = joint(count)
            {
                *place = next;
                count += 1;
            }
            if count < 2 {
                return;
            }
            let pairs = force_pairs(&joints);
            for lane in 0..LANES {
                if lane < count
                    && let Some(group) = groups.next()
                {
                    let force_pair = P::force_pair_of(&pairs, lane);
                    apply(wrenches, group.a.row(), group.b.row(), &force_pair);
                }
            }
        }
    }
}

/// Adds the force pairs of the first groups, as long as there are two alike.
// Not inlined, as [`force_pairs`]: it is compiled once for all schemes.
#[inline(never)]
pub(super) fn add<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    frames: &[P::Frame],
    damped: bool,
    groups: &mut Iter<'_, Group>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let Some(first) = groups.as_slice().first() else { return };
    let ground = &P::frame(&P::Position::default(), &P::Orientation::default());
    let (points, springs) = (model.points, model.tsdas);
    let source = Source::<P> { frames, ground, points, springs, damped };
    match (first.triples, first.arms, <P::Abreast as Geometry>::Real::LANES) {
        (2, 3, 2) if !P::Space::PLANAR => source.add::<2, 2, 3>(groups, wrenches),
        (2, 3, 4) if !P::Space::PLANAR => source.add::<4, 2, 3>(groups, wrenches),
        (1, 3, 2) if !P::Space::PLANAR => source.add::<2, 1, 3>(groups, wrenches),
        (1, 3, 4) if !P::Space::PLANAR => source.add::<4, 1, 3>(groups, wrenches),
        (1, 2, 2) if P::Space::PLANAR => source.add::<2, 1, 2>(groups, wrenches),
        (1, 2, 4) if P::Space::PLANAR => source.add::<4, 1, 2>(groups, wrenches),
        _ => {}
    }
}

/// The force pairs of joints, one per lane.
#[inline(never)]
fn force_pairs<P: Geometry, const LANES: usize, const TRIPLES: usize, const ARMS: usize>(
    joints: &[Joint<'_, P, TRIPLES, ARMS>; LANES],
) -> ForcePair<<P::Abreast as Geometry>::Space> {
    let [a, b] = [0, 1].map(|end| P::frames_abreast(|lane| *joints[lane].ends[end]));
    let centres: [_; TRIPLES] =
        core::array::from_fn(|i| P::points_abreast(|lane| joints[lane].centres[i]));
    let endpoints: [_; ARMS] =
        core::array::from_fn(|i| P::points_abreast(|lane| joints[lane].endpoints[i]));
    let springs: [[_; ARMS]; TRIPLES] = core::array::from_fn(|triple| {
        core::array::from_fn(|arm| Tsda {
            stiffness: P::numbers_abreast(|lane| joints[lane].springs[triple][arm].stiffness),
            free_length: P::numbers_abreast(|lane| joints[lane].springs[triple][arm].free_length),
        })
    });
    let springs = Springs::<P::Abreast, AllTerms, DampersLeft, TRIPLES, ARMS> {
        springs: &springs,
        rests: None,
        dampers: None,
        clearance: None,
        kinds: PhantomData,
    };
    springs.force_pair(&centres, &endpoints, &End::at(&a), &End::at(&b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, BodyState};
    use crate::forces::{DampersLeft, ExplicitDampers, force_pair};
    use crate::geometry::{F32, F64};
    use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
    use crate::model::{Model, ModelOwner as _};
    use crate::planar::{Planar32, Planar64};
    use crate::pose::Places;
    use crate::space::Linear as _;

    /// Joints between three bodies and the ground.
    const JOINTS: usize = 7;
    const POINTS: usize = 5;
    const SPRINGS: usize = 6;
    type Joints<P> = Model<
        P,
        3,
        JOINTS,
        { JOINTS * POINTS },
        { JOINTS * SPRINGS },
        0,
        SPRINGS,
        0,
        0,
        0,
        0,
        0,
        0,
        1,
    >;

    fn joints<P: Geometry>(triples: u8, arms: u8) -> Joints<P> {
        let body = |row| if row == 3 { BodyIndex::WORLD } else { BodyIndex(row) };
        let between = [(3, 0), (0, 1), (1, 2), (2, 3), (3, 1), (2, 0), (1, 0)];
        let state = |i: f64| {
            BodyState::<P>::from_f64(
                [0.3 + i, -0.2 * i, 0.0],
                [0.8, 0.0, 0.0, 0.6],
                [1.0, i, 0.0],
                [0.0, 0.0, 0.7 - i],
            )
        };
        Model {
            bodies: [Body::from_f64(1.0, [1.0; 3]); 3],
            initial: core::array::from_fn(|i| state(0.37 * i as f64)),
            gravity: [],
            groups: core::array::from_fn(|i| Group {
                law: Law::Tsda,
                a: body(between[i].0),
                b: body(between[i].1),
                triples,
                arms,
                shared: triples > 1,
                point: (i * POINTS) as u16,
                element: (i * SPRINGS) as u16,
                damper: DamperIndex::NONE,
                clearance: ClearanceIndex::NONE,
            }),
            points: core::array::from_fn(|i| {
                let i = i as f64;
                P::local_from_f64([
                    0.1 * i,
                    0.03 * i * i,
                    if P::Space::PLANAR { 0.0 } else { 0.02 * i },
                ])
            }),
            tsdas: core::array::from_fn(|i| {
                Tsda::from_f64(100.0 + i as f64, 0.2 + 0.01 * i as f64)
            }),
            bushings: [],
            dampers: [P::Real::from_f64(3.0); SPRINGS],
            torsions: [],
            loads: [],
            lines: [],
            inputs: [],
            knots: [],
            clearances: [P::Real::from_f64(0.01)],
            revolutes: [],
            universals: [],
            sources: [],
            laws: (),
        }
    }

    /// How many of the joints are computed several at a time, with the bits of one after the other.
    fn taken<P: Geometry>(model: &Joints<P>, damped: bool) -> usize {
        let view = model.view();
        let mut frames = model.per_body(P::Frame::default());
        crate::pose::place_bodies(model.initial(), &mut frames);
        let places = Places { frames: &frames, signals: &[] };
        let mut one_by_one = model.per_body(Wrench::default());
        let mut abreast = one_by_one;
        let apply_one = |group: &Group, wrenches: &mut [Wrench<P::Space>]| {
            let known = (model.initial(), &[][..]);
            let force_pair = if damped {
                force_pair::<P, _, ExplicitDampers>(&view, places, known, group)
            } else {
                force_pair::<P, _, DampersLeft>(&view, places, known, group)
            };
            apply(wrenches, group.a.row(), group.b.row(), &force_pair.unwrap());
        };
        for group in &model.groups {
            apply_one(group, &mut one_by_one);
        }
        let mut groups = model.groups.iter();
        let mut taken = 0;
        loop {
            let before = groups.len();
            add(&view, &frames, damped, &mut groups, &mut abreast);
            taken += before - groups.len();
            let Some(group) = groups.next() else { break };
            apply_one(group, &mut abreast);
        }
        assert_eq!(abreast, one_by_one);
        assert!(abreast.iter().all(|wrench| wrench.force.dot(wrench.force) > P::Real::ONE));
        taken
    }

    #[test]
    fn alike_joints_have_the_bits_of_one_after_the_other() {
        fn check<P: Geometry>(lanes: usize, kinds: &[(u8, u8)]) {
            for &(triples, arms) in kinds {
                let model = joints::<P>(triples, arms);
                let last = if JOINTS % lanes == 1 { JOINTS - 1 } else { JOINTS };
                assert_eq!(taken(&model, false), last, "{} {triples}", P::NAME);
                // A joint in the middle with a clearance or with a damper that acts is computed alone.
                let middle = if lanes == 2 { 2 } else { 3 };
                let apart: [fn(&mut Group); 2] = [
                    |group| group.clearance = ClearanceIndex(0),
                    |group| group.damper = DamperIndex(0),
                ];
                for (change, damped) in apart.into_iter().zip([false, true]) {
                    let mut model = joints::<P>(triples, arms);
                    change(&mut model.groups[middle]);
                    assert_eq!(taken(&model, damped), JOINTS - 1, "{} {triples}", P::NAME);
                }
                let mut model = joints::<P>(triples, arms);
                model.groups[middle].damper = DamperIndex(0);
                assert_eq!(taken(&model, false), last);
            }
        }
        check::<F64>(2, &[(2, 3), (1, 3)]);
        check::<F32>(4, &[(2, 3), (1, 3)]);
        check::<Planar64>(2, &[(1, 2)]);
        check::<Planar32>(4, &[(1, 2)]);
    }

    #[test]
    fn joints_of_other_kinds_are_left() {
        for (triples, arms) in [(1, 1), (1, 2)] {
            assert_eq!(taken(&joints::<F64>(triples, arms), false), 0);
        }
        assert_eq!(taken(&joints::<Planar64>(1, 1), false), 0);
        let mut model = joints::<F64>(2, 3);
        for group in model.groups.iter_mut().step_by(2) {
            (group.triples, group.shared) = (1, false);
        }
        assert_eq!(taken(&model, false), 0);
    }
}
