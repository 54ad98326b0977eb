//! The powers of loads, inputs, moved ground and dampers, which change the energy of a state.
//!
//! `(model, state) => powers`, in the model's precision; for hosts, which evaluate a run by them. With the energy E of
//! [`crate::energy`], `dE/dt = loads + inputs + ground − dampers`, whatever the pose: springs and gravity only convert
//! energy. Not included: a jump of moved ground, which changes the energy at once.

use crate::body::Body;
use crate::elements::gravity;
use crate::forces::{
    At, Dampers, DampersLeft, Evaluation, ExplicitDampers, Instant, Memories, Wrench,
    evaluate_out_of_line, force_pair_out_of_line, push_loads_and_inputs, wrenches,
};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::{Instant as LawInstant, Laws as _};
use crate::model::{FrameOf, ModelOwner, ModelRef, RealOf, SpaceOf, Terms};
use crate::pose::{End, Places, place_bodies};
use crate::real::Real;
use crate::schedule::LoadWindow;
use crate::space::Linear;
use crate::state::State;
use crate::status::Cause;

/// Powers \[W\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Power<R> {
    /// \[W\] of loads on the bodies.
    pub loads: R,
    /// \[W\] of inputs on the bodies: forces, torques, actuators; and of driven bodies on the others, minus the power of
    /// all forces on them.
    pub inputs: R,
    /// \[W\] of moved ground through springs and dampers.
    pub ground: R,
    /// \[W\] dissipated by dampers, including those at moved ground.
    pub dampers: R,
}

/// The powers in a state, with loads active in its step of `step_size` \[s\], dampers by their law `c·v²`.
///
/// # Errors
/// [`Cause::UndefinedTorsionAngle`] names the first torsion spring whose torsion angle is undefined.
pub fn power<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
) -> Result<Power<RealOf<M>>, Cause> {
    let view = model.view();
    let (bodies, signals) = (state.bodies.as_ref(), state.signals.as_ref());
    let mut windows = model.per_load();
    for (window, load) in windows.as_mut().iter_mut().zip(view.loads) {
        *window = LoadWindow::new(load.from, load.until, step_size);
    }
    let mut frames = model.per_body(FrameOf::<M>::default());
    place_bodies::<M::Precision>(bodies, frames.as_mut());
    let mut wrenches = model.per_body(Wrench::<SpaceOf<M>>::default());
    let into_bodies = |wrenches: &[Wrench<SpaceOf<M>>]| {
        let rows = bodies.iter().zip(wrenches);
        rows.fold(RealOf::<M>::ZERO, |sum, (body, wrench)| {
            let v = M::Precision::velocity(&body.velocity);
            let w = M::Precision::spin(&body.angular_velocity);
            sum + wrench.force.dot(v) + wrench.torque.dot(w)
        })
    };
    let places = Places { frames: frames.as_ref(), signals };
    let unmoved = Places { signals: &[], ..places };
    push_loads_and_inputs(&view, windows.as_ref(), state.step, unmoved, wrenches.as_mut());
    let loads = into_bodies(wrenches.as_ref());
    push_loads_and_inputs(&view, &[], state.step, places, wrenches.as_mut());
    let mut inputs = into_bodies(wrenches.as_ref());
    if M::Terms::DRIVEN && view.bodies.iter().any(Body::is_driven) {
        inputs = inputs - on_driven::<M>(model, state, step_size)?;
    }

    // The power of springs, and of springs and dampers, on the bodies and from moved ground.
    let with = forces::<M, ExplicitDampers>(model, state, into_bodies)?;
    let without = forces::<M, DampersLeft>(model, state, into_bodies)?;
    let mut ground = [RealOf::<M>::ZERO; 2];
    for group in view.groups {
        let (anchor, sign) = match [group.a, group.b].map(BodyIndex::anchor_row) {
            [Some(_), _] => (group.a, -RealOf::<M>::ONE),
            [_, Some(_)] => (group.b, RealOf::<M>::ONE),
            _ => continue,
        };
        let rate = End::new(&view, places, anchor, None).velocity;
        let on = (bodies, &[][..]);
        let records = [
            force_pair_out_of_line::<_, _, ExplicitDampers>(&view, places, on, group),
            force_pair_out_of_line::<_, _, DampersLeft>(&view, places, on, group),
        ];
        for (sum, force_pair) in ground.iter_mut().zip(records) {
            let Some(force_pair) = force_pair else { continue };
            *sum = *sum + sign * force_pair.force.dot(rate);
        }
    }
    let [whole, springs] = ground;
    let [supplied, taken] = of_drives::<M>(&view, state, frames.as_ref());
    let dampers = (whole - springs) - (with - without) + taken;
    Ok(Power { loads, inputs: inputs + supplied, ground: whole, dampers })
}

/// \[W\] the power of all forces on driven bodies except their weights, whose energy is not counted either.
fn on_driven<M: ModelOwner>(
    model: &M,
    state: &State<M>,
    step_size: f64,
) -> Result<RealOf<M>, Cause> {
    let all = wrenches(model, state, step_size)?;
    let view = model.view();
    let field = view.gravity.first().copied().unwrap_or(Linear::ZERO);
    let rows = view.bodies.iter().zip(state.bodies.as_ref()).zip(all.as_ref());
    let mut sum = RealOf::<M>::ZERO;
    for ((body, state), wrench) in rows.filter(|((body, _), _)| body.is_driven()) {
        let v = M::Precision::velocity(&state.velocity);
        let w = M::Precision::spin(&state.angular_velocity);
        let force = wrench.force - gravity::weight(body.mass, field);
        sum = sum + force.dot(v) + wrench.torque.dot(w);
    }
    Ok(sum)
}

/// \[W\] the power of drives among the laws, and the power of dampers beyond that taken from the bodies: on the laws'
/// internal degrees of freedom and on inputs that move their dampers, minus the power of a drive's dampers.
fn of_drives<M: ModelOwner>(
    view: &ModelRef<'_, M::Precision, M::Terms>,
    state: &State<M>,
    frames: &[FrameOf<M>],
) -> [RealOf<M>; 2] {
    let at = LawInstant { frames, bodies: state.bodies.as_ref(), signals: state.signals.as_ref() };
    let mut sums = [RealOf::<M>::ZERO; 2];
    view.laws.look_at_all(&state.laws, &mut |_, law| {
        let Some(seen) = law.seen(at) else { return };
        let [supplied, taken] = &mut sums;
        *supplied = *supplied + law.supply(&seen);
        *taken = *taken + law.loss();
        let driven = law.driven_rate(&seen);
        let own = law.inner(RealOf::<M>::ZERO).map_or(RealOf::<M>::ZERO, |inner| inner.rate);
        law.each_damper(&seen, &mut |_, damper| {
            let rate = seen.rate(&damper.direction);
            let inner = damper.inner() * own;
            let tension = damper.tension(rate + inner);
            if law.drives() {
                *supplied = *supplied - tension * rate;
                *taken = *taken - tension * rate;
            } else {
                *supplied = *supplied - tension * driven;
                *taken = *taken + tension * (inner - driven);
            }
        });
    });
    sums
}

/// The power of all forces of a state on the bodies, without loads.
fn forces<M: ModelOwner, D: Dampers>(
    model: &M,
    state: &State<M>,
    into_bodies: impl Fn(&[Wrench<SpaceOf<M>>]) -> RealOf<M>,
) -> Result<RealOf<M>, Cause> {
    let mut frames = model.per_body(FrameOf::<M>::default());
    let mut wrenches = model.per_body(Wrench::default());
    let (mut turns, mut laws) = (state.turns.clone(), state.laws.clone());
    evaluate_out_of_line::<M::Precision, M::Terms, D>(
        &model.view(),
        Instant {
            step: state.step,
            windows: &[],
            signals: state.signals.as_ref(),
            bodies: state.bodies.as_ref(),
            in_line: false,
            rests: &[],
            placed: false,
        },
        Memories { turns: turns.as_mut(), laws: &mut laws, at: At::Stage, advance: None },
        Evaluation { frames: frames.as_mut(), wrenches: wrenches.as_mut(), unpushed: &mut [] },
    )?;
    Ok(into_bodies(wrenches.as_ref()))
}
