//! A plant of any method behind one type; maps the names of a method to the kernel's types.
//!
//! `(model, method, step) => plant`. Every scheme is compiled here for every precision, once for all host tools. Unit
//! tests of this crate do not create plants, which would compile all of it again; such tests are in `tests/`. A plant
//! owns its model and can be sent to another thread.

use std::sync::Arc;

#[cfg(feature = "comparison")]
use dbd_kernel::approximate::Approximate32;
use dbd_kernel::energy::energy;
#[cfg(feature = "comparison")]
use dbd_kernel::euler::{EulerF32, EulerF64};
use dbd_kernel::frequency::bound;
use dbd_kernel::keep::Storage as _;
use dbd_kernel::laws::Laws as _;
use dbd_kernel::plant::{self as kernel, InputError, Plant, StateError};
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::schedule::Signal;
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::{
    BodyIndex, BodyState, Energy, F32, F64, Failure, Fixed, Geometry, InputIndex, Planar32,
    Planar64, Real as _, Scheme, State, Vec3,
};
use dbd_scene::{Misfit, Planar, Scene, SceneModel, rounded, widen};

use crate::any::AnyPlant;
use crate::method::{Method, SchemeChoice};
use crate::names::{Named, OrientationName, PrecisionName};
use crate::number_format::NumberFormat;
use crate::readings::widened;
pub use crate::refusal::PlantError;

/// `$body` with `$P` the kernel's type for a method's precision and orientation.
macro_rules! with_precision {
    ($method:expr, $P:ident => $body:expr) => {
        match ($method.precision(), $method.orientation()) {
            (PrecisionName::F64, OrientationName::Quaternion) => {
                type $P = F64;
                $body
            }
            (PrecisionName::F32, OrientationName::Quaternion) => {
                type $P = F32;
                $body
            }
            (PrecisionName::Fixed, OrientationName::Quaternion) => {
                type $P = Fixed;
                $body
            }
            #[cfg(feature = "comparison")]
            (PrecisionName::F64, OrientationName::Euler321) => {
                type $P = EulerF64;
                $body
            }
            #[cfg(feature = "comparison")]
            (PrecisionName::F32, OrientationName::Euler321) => {
                type $P = EulerF32;
                $body
            }
            #[cfg(feature = "comparison")]
            (PrecisionName::F32Micromath, OrientationName::Quaternion) => {
                type $P = Approximate32;
                $body
            }
            (_, _) => Err($method.not_built().into()),
        }
    };
}

/// `$body` with `$P` the kernel's type for a method's precision in the plane, where orientations are
/// headings.
macro_rules! with_planar_precision {
    ($method:expr, $P:ident => $body:expr) => {
        match ($method.precision(), $method.orientation()) {
            (PrecisionName::F64, OrientationName::Quaternion) => {
                type $P = Planar64;
                $body
            }
            (PrecisionName::F32, OrientationName::Quaternion) => {
                type $P = Planar32;
                $body
            }
            (precision, orientation) => Err(PlantError::Planar {
                what: match orientation {
                    OrientationName::Quaternion => Named::name(precision),
                    _ => Named::name(orientation),
                },
            }),
        }
    };
}

/// `$body` with `$scheme` a method's scheme in the kernel's type.
macro_rules! with_scheme {
    ($method:expr, $scheme:ident => $body:expr) => {
        match $method.scheme {
            SchemeChoice::Dbd($scheme) => $body,
            SchemeChoice::DbdP1($scheme) => $body,
            SchemeChoice::DbdP2($scheme) => $body,
            SchemeChoice::SemiImplicitEuler($scheme) => $body,
            SchemeChoice::ExplicitSemiImplicitEuler($scheme) => $body,
            SchemeChoice::Leapfrog($scheme) => $body,
            SchemeChoice::ExplicitLeapfrog($scheme) => $body,
            SchemeChoice::JointWiseLeapfrog($scheme) => $body,
            SchemeChoice::JointWiseSemiImplicitEuler($scheme) => $body,
            SchemeChoice::Pefrl($scheme) => $body,
            SchemeChoice::BlanesMoanS6($scheme) => $body,
            SchemeChoice::Rk4($scheme) => $body,
            SchemeChoice::GeneralizedAlpha($scheme) => $body,
            SchemeChoice::GeneralizedAlpha3($scheme) => $body,
        }
    };
}
/// A plant of a scene at t = 0, with the step `step` \[s\]. A planar scene runs in its plane; its inputs and outputs
/// are spatial.
///
/// # Errors
/// [`PlantError`] if the precision cannot represent the step or an input's values, or this build does not include the
/// method.
pub fn plant(scene: &Scene, method: &Method, step: f64) -> Result<Box<dyn AnyPlant>, PlantError> {
    check_driven(scene, method)?;
    check_inputs(scene, method)?;
    let Some(planar) = &scene.planar else {
        check_extents(scene, method, step)?;
        return plant_of_model(&scene.model, method, step);
    };
    check_step(method, step)?;
    let new = New { model: &planar.model, plane: Some((planar, &scene.model)), method, step };
    with_planar_precision!(method, P => with_scheme!(method, scheme => new.typed::<P, _>(scheme)))
}

/// A plant of an assembled model at t = 0, with the step `step` \[s\].
///
/// # Errors
/// [`PlantError`] if the precision cannot represent the step, or this build does not include the method.
pub fn plant_of_model(
    model: &SceneModel<F64>,
    method: &Method,
    step: f64,
) -> Result<Box<dyn AnyPlant>, PlantError> {
    check_step(method, step)?;
    let new = New { model, plane: None, method, step };
    with_precision!(method, P => with_scheme!(method, scheme => new.typed::<P, _>(scheme)))
}

/// Checks that a method can run a scene with steps of `step` \[s\]: its precision represents the step, inputs,
/// positions and displacements, and its matrix allows the stiffness.
///
/// # Errors
/// Those of [`check_step`], [`check_laws`], [`check_inputs`], [`check_extents`] and [`check_stiffness`], in this order.
pub fn check(scene: &Scene, method: &Method, step: f64) -> Result<(), PlantError> {
    check_step(method, step)?;
    check_laws(scene, method)?;
    check_inputs(scene, method)?;
    check_extents(scene, method, step)?;
    check_stiffness(scene, method, step)
}

/// Checks that a method's precision supports a scene's interactions, that its scheme updates their internal states, and
/// that it moves driven bodies.
///
/// # Errors
/// [`PlantError::Laws`], [`PlantError::Driven`], [`PlantError::Memory`].
pub fn check_laws(scene: &Scene, method: &Method) -> Result<(), PlantError> {
    let laws = &scene.model.laws;
    if !(laws.is_empty() || method.has_laws()) {
        return Err(PlantError::Laws { precision: method.precision_name() });
    }
    check_driven(scene, method)?;
    match laws.memory() {
        Some((law, need)) if !method.bears(need) => {
            Err(PlantError::Memory { law, scheme: method.scheme_name() })
        }
        _ => Ok(()),
    }
}

/// Checks that a method's scheme moves driven bodies.
fn check_driven(scene: &Scene, method: &Method) -> Result<(), PlantError> {
    let driven = scene.model.bodies.iter().position(dbd_kernel::Body::is_driven);
    match driven {
        Some(row) if !method.drives() => Err(PlantError::Driven {
            body: scene.body_names[row].clone(),
            scheme: method.scheme_name(),
        }),
        _ => Ok(()),
    }
}

/// Whether a step is positive and finite once it is rounded to a method's precision.
///
/// # Errors
/// [`PlantError::Step`] where it is not.
pub fn check_step(method: &Method, step: f64) -> Result<(), PlantError> {
    let rounded = method.rounded(step);
    if rounded > 0.0 && rounded.is_finite() { Ok(()) } else { Err(refused(method, step)) }
}

/// Checks that a method's matrix allows a scene's stiffness at t = 0 with steps of `step` \[s\].
///
/// # Errors
/// [`PlantError::Stiff`] with the longest step where it does not.
pub fn check_stiffness(scene: &Scene, method: &Method, step: f64) -> Result<(), PlantError> {
    let Some(most) = method.most_vibration() else { return Ok(()) };
    let model = scene.stepped();
    let most = most / bound(model, &State::initial(model));
    let precision = method.precision_name();
    if step <= most { Ok(()) } else { Err(PlantError::Stiff { most, precision }) }
}

/// Checks that a method's precision represents the values of a scene's inputs.
///
/// # Errors
/// [`PlantError::Input`] with the first input that does not fit; [`PlantError::Method`] if this build does not include
/// the precision, [`PlantError::Planar`] if it does not support planar scenes.
pub fn check_inputs(scene: &Scene, method: &Method) -> Result<(), PlantError> {
    if scene.planar.is_some() {
        return with_planar_precision!(method, P => Ok(dbd_scene::check_inputs::<P>(scene)?));
    }
    with_precision!(method, P => Ok(dbd_scene::check_inputs::<P>(scene)?))
}

/// Checks that a method's precision represents a scene's positions and displacements, with steps of `step` \[s\].
///
/// # Errors
/// [`PlantError::Extent`] with the first part that does not fit; [`PlantError::Method`] if this build does not include
/// the precision.
pub fn check_extents(scene: &Scene, method: &Method, step: f64) -> Result<(), PlantError> {
    if scene.planar.is_some() {
        return Ok(());
    }
    with_precision!(method, P => Ok(dbd_scene::check_extents::<P>(scene, step)?))
}

fn refused(method: &Method, step: f64) -> PlantError {
    PlantError::Step { step, rounded: method.rounded(step), precision: method.precision_name() }
}

/// Source of a plant.
struct New<'n> {
    /// The stepped model.
    model: &'n SceneModel<F64>,
    /// For a planar scene: its plane in the world, and the spatial model.
    plane: Option<(&'n Planar, &'n SceneModel<F64>)>,
    method: &'n Method,
    step: f64,
}

impl New<'_> {
    fn typed<P, S>(&self, scheme: S) -> Result<Box<dyn AnyPlant>, PlantError>
    where
        P: Geometry,
        S: Scheme,
        Typed<P, S>: AnyPlant + 'static,
    {
        let (model, shown) = self.converted::<P>(S::Storage::MATRIX)?;
        let plant = Plant::new(model, scheme, self.step);
        let plant = plant.map_err(|error| self.refusal::<P>(error))?;
        Ok(Box::new(Typed { plant, shown }))
    }

    /// The model in a precision, planned where a matrix is to be solved.
    fn converted<P: Geometry>(
        &self,
        planned: bool,
    ) -> Result<(Arc<SceneModel<P>>, Shown), PlantError> {
        let mut model: SceneModel<P> = self.model.convert();
        if model.laws.is_empty() && !self.model.laws.is_empty() {
            return Err(PlantError::Laws { precision: self.method.precision_name() });
        }
        if planned {
            model = model.planned();
        }
        let exact = model.convert();
        let exact = match self.plane {
            Some((planar, whole)) => planar.in_world(whole, &exact),
            None => exact,
        };
        let planar = self.plane.map(|(planar, _)| planar.clone());
        Ok((Arc::new(model), Shown { planar, exact, method: *self.method }))
    }

    /// Errors of the kernel, with the names of scene and method.
    fn refusal<P: Geometry>(&self, error: kernel::PlantError) -> PlantError {
        match error {
            kernel::PlantError::Step(_) => refused(self.method, self.step),
            kernel::PlantError::Extent(excess) => Misfit::unnamed::<P>(&excess, self.step).into(),
            kernel::PlantError::Plan => PlantError::Pairs,
            kernel::PlantError::Memory(law) => {
                PlantError::Memory { law, scheme: self.method.scheme_name() }
            }
            kernel::PlantError::Driven(body) => {
                PlantError::Driven { body: body.0.to_string(), scheme: self.method.scheme_name() }
            }
            kernel::PlantError::Stiff(most) => {
                PlantError::Stiff { most, precision: self.method.precision_name() }
            }
        }
    }
}

/// A plant of one precision and one scheme.
struct Typed<P: Geometry, S: Scheme> {
    plant: Plant<Arc<SceneModel<P>>, S>,
    shown: Shown,
}

/// External view of a plant: in double precision, in world axes.
struct Shown {
    /// The plane of a planar scene.
    planar: Option<Planar>,
    /// The spatial model in world axes, also for a planar scene.
    exact: SceneModel<F64>,
    method: Method,
}

impl Shown {
    /// A state of the plant in the world.
    fn outward<P: Geometry>(&self, state: &State<SceneModel<P>>) -> State<SceneModel<F64>> {
        let mut state = widen(state);
        if let Some(planar) = &self.planar {
            planar.states_outward(&mut state.bodies);
            self.exact.laws.turn_memories(&mut state.laws, &mut |body, v| {
                planar.plane.of_body_outward(body.row(), Vec3::from_f64(v)).to_f64()
            });
        }
        state
    }

    /// The plant's state of one in the world.
    fn inward<P: Geometry>(
        &self,
        state: &State<SceneModel<F64>>,
    ) -> Result<State<SceneModel<P>>, StateError> {
        let Some(planar) = &self.planar else { return Ok(rounded(state)) };
        let mut inner = state.clone();
        for (row, body) in inner.bodies.iter_mut().enumerate() {
            let turn = body.orientation.to_f64();
            let norm: f64 = turn.iter().map(|c| c * c).sum();
            if (norm - 1.0).abs() > UNIT {
                return Err(StateError::Orientation(BodyIndex(row as u16)));
            }
            if planar.plane.leaves(row, body, OFF_PLANE) {
                return Err(StateError::OffPlane(BodyIndex(row as u16)));
            }
            *body = planar.plane.state_inward(row, body);
        }
        self.exact.laws.turn_memories(&mut inner.laws, &mut |body, v| {
            planar.plane.of_body_inward(body.row(), Vec3::from_f64(v)).to_f64()
        });
        Ok(rounded(&inner))
    }

    /// A plant's bodies in the world.
    fn bodies<P: Geometry>(&self, state: &State<SceneModel<P>>, bodies: &mut Vec<BodyState<F64>>) {
        bodies.clear();
        bodies.extend(state.bodies.iter().map(BodyState::convert));
        if let Some(planar) = &self.planar {
            planar.states_outward(bodies);
        }
    }
}

/// Tolerance of a state out of the plane, relative to the size of the scene and of the state.
const OFF_PLANE: f64 = 1e-6;

/// Tolerance of the squared length of an orientation against 1, as in the kernel.
const UNIT: f64 = 2e-3;

impl<P: Geometry, S: Scheme> AnyPlant for Typed<P, S>
where
    Plant<Arc<SceneModel<P>>, S>: Send,
{
    // Shares the function above, so that a step is compiled once.
    fn step(&mut self) -> Result<(), Failure> {
        self.plant.advance(1)
    }

    fn advance(&mut self, n: u64) -> Result<(), Failure> {
        self.plant.advance(n)
    }

    fn set(&mut self, input: InputIndex, value: f64, rate: f64) -> Result<(), InputError> {
        self.plant.set_signal(input, value, rate)
    }

    fn read(&self, readout: &Readout<F64>) -> Option<Reading<f64>> {
        match &self.shown.planar {
            None => self.plant.read(&readout.convert()).map(widened),
            Some(planar) => {
                let reading = self.plant.read(&planar.readout(readout).convert()).map(widened);
                reading.map(|reading| planar.reading(readout, reading))
            }
        }
    }

    fn state(&self) -> State<SceneModel<F64>> {
        self.shown.outward(self.plant.state())
    }

    fn bodies(&self, bodies: &mut Vec<BodyState<F64>>) {
        self.shown.bodies(self.plant.state(), bodies);
    }

    fn signals_at_end(&self) -> Vec<Signal<f64>> {
        self.plant.signals_at(P::Real::ONE).iter().map(Signal::convert).collect()
    }

    fn energy(&self) -> Energy<f64> {
        energy(&self.shown.exact, &self.state(), self.step_size())
    }

    fn reset(&mut self) {
        self.plant.reset();
    }

    fn set_state(&mut self, state: &State<SceneModel<F64>>) -> Result<(), StateError> {
        self.plant.set_state(self.shown.inward(state)?)
    }

    fn snapshot(&self) -> Result<Vec<u8>, SnapshotError> {
        let mut bytes = vec![0; self.plant.snapshot_size()];
        self.plant.snapshot(&mut bytes)?;
        Ok(bytes)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        self.plant.restore(bytes)
    }

    fn hash(&self) -> u64 {
        self.plant.hash()
    }

    fn status(&self) -> Result<(), Failure> {
        self.plant.status()
    }

    fn time(&self) -> f64 {
        self.plant.time()
    }

    fn steps(&self) -> u64 {
        self.plant.state().step
    }

    fn evaluations(&self) -> u64 {
        self.plant.evaluations()
    }

    fn step_size(&self) -> f64 {
        self.plant.step_size()
    }

    fn number_format(&self) -> NumberFormat {
        NumberFormat::of::<P>()
    }

    fn method(&self) -> &Method {
        &self.shown.method
    }

    fn model(&self) -> &SceneModel<F64> {
        &self.shown.exact
    }
}
