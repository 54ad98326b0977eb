//! The energy of a state, by kind.
//!
//! `(model, state) => ledger`, in the model's precision. To judge a run, convert model and state
//! to double precision first: the stored words are then taken as exact, whatever precision
//! stepped them. Sums run in ascending order of bodies, groups, springs and loads.

use crate::elements::gravity;
use crate::elements::load::LoadWindow;
use crate::elements::torsion_spring::{TorsionSpring, Twist};
use crate::forces::{End, place_bodies};
use crate::geometry::{FrameOf, Geometry, RealOf};
use crate::model::{Group, Law, ModelOwner, ModelRef, Terms};
use crate::real::Real;
use crate::state::{BodyState, State};
use crate::vector::Vec3;

/// Energies \[J\] by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Energy<R> {
    /// `½·m·v² + ½·ω·I·ω` of all bodies.
    pub kinetic: R,
    /// `−m·g·x` of all bodies.
    pub gravity: R,
    /// TSDAs.
    pub tsda: R,
    /// Point bushings.
    pub bushing: R,
    /// Torsion springs, preload included.
    pub torsion: R,
    /// World-frame force loads while they act.
    pub load: R,
}

impl<R: Real> Energy<R> {
    /// All but the kinetic energy.
    pub fn potential(&self) -> R {
        self.gravity + self.tsda + self.bushing + self.torsion + self.load
    }

    /// Kinetic and potential energy.
    pub fn total(&self) -> R {
        self.kinetic + self.potential()
    }
}

/// The energies of a state, loads as they act at its time for steps of `step_size` \[s\]. A
/// torsion spring whose twist is undefined counts 0.
pub fn energy<M: ModelOwner>(model: &M, state: &State<M>, step_size: f64) -> Energy<RealOf<M>> {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut sum = Energy::default();
    let half = RealOf::<M>::HALF;
    for (body, state) in view.bodies.iter().zip(bodies) {
        let v = M::Precision::velocity(&state.velocity);
        let w = M::Precision::velocity(&state.angular_velocity);
        sum.kinetic =
            sum.kinetic + half * (body.mass * v.dot(v)) + half * w.dot(body.inertia.scale(w));
        for gravity in view.gravity {
            let position = M::Precision::position(&state.position);
            sum.gravity = sum.gravity + gravity::energy(body.mass, *gravity, position);
        }
    }
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    each_element(&view, frames.as_ref(), |element| match element.group.law {
        Law::Tsda => {
            if let Some(tsda) = view.tsdas.get(element.index) {
                sum.tsda = sum.tsda + tsda.energy(element.displacement);
            }
        }
        Law::PointBushing => {
            if let Some(bushing) = view.bushings.get(element.index) {
                sum.bushing = sum.bushing + bushing.energy(element.displacement);
            }
        }
    });
    for (spring, &turns) in view.torsions.iter().zip(state.turns.as_ref()) {
        if let Some(twist) = twist_of::<M::Precision>(spring, bodies, turns) {
            sum.torsion = sum.torsion + spring.energy(twist.angle);
        }
    }
    for load in view.loads {
        let window = LoadWindow::new(load.from, load.until, step_size);
        if let (true, Some(body)) = (window.contains(state.step), bodies.get(load.body.row())) {
            sum.load = sum.load + load.energy(M::Precision::position(&body.position));
        }
    }
    sum
}

/// The largest extension \[m\] of the groups' elements, `|L − L0|`.
pub fn largest_extension<M: ModelOwner>(model: &M, state: &State<M>) -> RealOf<M> {
    let view = model.view();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(state.bodies.as_ref(), frames.as_mut());
    let mut largest = RealOf::<M>::ZERO;
    each_element(&view, frames.as_ref(), |element| {
        let d = element.displacement;
        let extension = match element.group.law {
            Law::Tsda => view.tsdas.get(element.index).map(|tsda| tsda.extension(d).abs()),
            Law::PointBushing => Some(d.dot(d).sqrt()),
        };
        if let Some(extension) = extension.filter(|e| *e > largest) {
            largest = extension;
        }
    });
    largest
}

/// The twist of a torsion spring, `None` where it is undefined.
pub(crate) fn twist_of<P: Geometry>(
    spring: &TorsionSpring<P::Real>,
    bodies: &[BodyState<P>],
    turns: i32,
) -> Option<Twist<P::Real>> {
    let orientation = |row: usize| bodies.get(row).map(|s| &s.orientation);
    let relative = P::relative(orientation(spring.a.row()), orientation(spring.b.row()));
    spring.twist(relative, &mut { turns }, false)
}

/// An element of a group at a pose.
pub(crate) struct Placed<'m, R> {
    /// Its group.
    pub(crate) group: &'m Group,
    /// Its index among the elements of its law.
    pub(crate) index: usize,
    /// From its first point to its second, world axes.
    pub(crate) displacement: Vec3<R>,
    /// The arm of the first point, world axes; 0 on the ground.
    pub(crate) arm_a: Vec3<R>,
    /// The arm of the second point.
    pub(crate) arm_b: Vec3<R>,
}

/// Visits every element of the groups in order; frames are those of the pose.
pub(crate) fn each_element<'m, P: Geometry, T: Terms>(
    model: &ModelRef<'m, P, T>,
    frames: &[P::Frame],
    mut visit: impl FnMut(Placed<'m, P::Real>),
) {
    for group in model.groups {
        let (stars, arms) = (group.stars as usize, group.arms.max(1) as usize);
        let end_a = End::<P>::new(frames.get(group.a.row()), None, false);
        let end_b = End::<P>::new(frames.get(group.b.row()), None, false);
        for i in 0..group.elements() {
            let centre = group.point as usize + i / arms;
            let tip = group.point as usize + stars + if group.shared { i % arms } else { i };
            let (Some(a), Some(b)) = (model.points.get(centre), model.points.get(tip)) else {
                continue;
            };
            let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
            let displacement = P::displacement(&a, &b);
            visit(Placed { group, index: group.element as usize + i, displacement, arm_a, arm_b });
        }
    }
}
