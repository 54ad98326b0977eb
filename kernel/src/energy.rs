//! The energy of a state, by kind.
//!
//! `(model, state) => energies`, in the model's precision. To evaluate a run, convert model and state to double
//! precision first: the stored numbers are then taken as exact, whatever precision stepped them. Sums run in ascending
//! order of bodies, groups, springs and loads.

use crate::elements::element::Element;
use crate::elements::gravity;
use crate::geometry::Geometry;
use crate::laws::{Instant, Laws as _};
use crate::model::{FrameOf, ModelOwner, RealOf, Terms};
use crate::pose::{Places, each_element, place_bodies, torsion_angle_of};
use crate::real::Real;
use crate::schedule::LoadWindow;
use crate::space::{Linear as _, Moment as _};
use crate::state::State;

/// Energies \[J\] by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Energy<R> {
    /// \[J\] `½·m·v² + ½·ω·I·ω` of all bodies except driven ones.
    pub kinetic: R,
    /// \[J\] `−m·g·x` of all bodies except driven ones.
    pub gravity: R,
    /// \[J\] TSDAs.
    pub tsda: R,
    /// \[J\] bushings, including those of joints.
    pub bushing: R,
    /// \[J\] points on lines.
    pub line: R,
    /// \[J\] torsion springs, preload included.
    pub torsion: R,
    /// \[J\] laws, see [`crate::laws`].
    pub law: R,
    /// \[J\] `−F·x` of world-frame force loads while they act. Not part of the potential energy: it appears and
    /// vanishes with a load's window, and its zero is at the world's origin. While a load acts, its work is minus the
    /// change of this.
    pub load: R,
}

impl<R: Real> Energy<R> {
    /// The energy of gravity and springs, a function of the pose only.
    pub fn potential(&self) -> R {
        self.gravity + self.tsda + self.bushing + self.line + self.torsion + self.law
    }

    /// Kinetic and potential energy: continuous at the start and end of a load, as loads, inputs and dampers change it
    /// only by their work.
    pub fn total(&self) -> R {
        self.kinetic + self.potential()
    }
}

/// The energies of a state, with loads active at its time for steps of `step_size` \[s\]. A torsion spring whose
/// torsion angle is undefined counts 0.
pub fn energy<M: ModelOwner>(model: &M, state: &State<M>, step_size: f64) -> Energy<RealOf<M>> {
    energy_with_extensions(model, state, step_size, |_, _| {})
}

/// [`energy()`], and a visit as in [`each_extension`]: the points of each element are computed once for both.
pub fn energy_with_extensions<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
    mut visit: impl FnMut(usize, RealOf<M>),
) -> Energy<RealOf<M>> {
    let view = model.view();
    let bodies = state.bodies.as_ref();
    let mut sum = Energy::default();
    let half = RealOf::<M>::HALF;
    for (body, state) in view.bodies.iter().zip(bodies) {
        if M::Terms::DRIVEN && body.is_driven() {
            continue;
        }
        let v = M::Precision::velocity(&state.velocity);
        let w = M::Precision::spin(&state.angular_velocity);
        sum.kinetic =
            sum.kinetic + half * (body.mass * v.dot(v)) + half * w.dot(body.inertia.scale(w));
        for gravity in view.gravity {
            let position = M::Precision::position(&state.position);
            sum.gravity = sum.gravity + gravity::energy(body.mass, *gravity, position);
        }
    }
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    each_element(&view, places, |placed| {
        let Some(law) = view.element(placed.group.law, placed.index) else { return };
        let clearance = view.clearance(placed.group);
        let energy = law.energy(&placed.deformation, clearance);
        let kind = match law {
            Element::Tsda(_) => &mut sum.tsda,
            Element::PointBushing(_) | Element::Revolute(_) | Element::Universal(_) => {
                &mut sum.bushing
            }
            Element::PointOnLine(_) => &mut sum.line,
        };
        *kind = *kind + energy;
        visit(placed.number, law.extension(&placed.deformation));
    });
    let turns = RealOf::<M>::counts(state.turns.as_ref());
    for (spring, &turns) in view.torsions.iter().zip(turns) {
        if let Some(torsion_angle) = torsion_angle_of::<M::Precision>(spring, bodies, turns) {
            sum.torsion = sum.torsion + spring.energy(torsion_angle.angle);
        }
    }
    let at = Instant { frames: frames.as_ref(), bodies, signals: state.signals.as_ref() };
    view.laws.look_at_all(&state.laws, &mut |_, law| {
        if let Some(seen) = law.seen(at) {
            sum.law = sum.law + law.energy(&seen);
        }
    });
    for load in view.loads {
        let window = LoadWindow::new(load.from, load.until, step_size);
        if let (true, Some(body)) = (window.contains(state.step), bodies.get(load.body.row())) {
            sum.load = sum.load + load.energy(M::Precision::position(&body.position));
        }
    }
    sum
}

/// \[J\] the energy of the laws whose memory is not a degree of freedom: energy removed by a change of memory is
/// dissipated.
pub fn of_memories<M: ModelOwner>(model: &M, state: &State<M>) -> RealOf<M> {
    let (view, bodies) = (model.view(), state.bodies.as_ref());
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let at = Instant { frames: frames.as_ref(), bodies, signals: state.signals.as_ref() };
    let mut sum = RealOf::<M>::ZERO;
    view.laws.look_at_all(&state.laws, &mut |_, law| {
        if let (None, Some(seen)) = (law.inner(RealOf::<M>::ZERO), law.seen(at)) {
            sum = sum + law.energy(&seen);
        }
    });
    sum
}

/// The largest extension \[m\] of the groups' elements, `|L − L0|`.
pub fn largest_extension<M: ModelOwner>(model: &M, state: &State<M>) -> RealOf<M> {
    let mut largest = RealOf::<M>::ZERO;
    each_extension(model, state, |_, extension| {
        let extension = extension.abs();
        if extension > largest {
            largest = extension;
        }
    });
    largest
}

/// Visits the extension `L − L0` \[m\] of every element of the groups in order, with the index of
/// its group.
pub fn each_extension<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    mut visit: impl FnMut(usize, RealOf<M>),
) {
    let view = model.view();
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(state.bodies.as_ref(), frames.as_mut());
    let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
    each_element(&view, places, |placed| {
        if let Some(law) = view.element(placed.group.law, placed.index) {
            visit(placed.number, law.extension(&placed.deformation));
        }
    });
}
