//! Energy and joint extensions of a state, and checks whether a run can continue.
//!
//! `(model in the plant's precision, state) => energy, largest joint extension | failure`, in double precision: the
//! stored words are taken as exact. A diverging run need not reach infinity before its end; it is detected by energy
//! that neither the initial state nor gravity, loads and inputs can have supplied, see `budget`.

use dbd_kernel::energy::{energy, energy_with_extensions};
use dbd_kernel::laws::Laws as _;
use dbd_kernel::model::{Group, Law};
use dbd_kernel::readouts::each_tension;
use dbd_kernel::{BodyState, Cause, Energy, F64, State};
use dbd_scene::{OneSided, Scene, SceneModel};

use crate::any::AnyPlant;
use crate::budget::{Budget, free_length};
use crate::number_format::{Digits, NumberFormat};
use dbd_scene::default_step::LARGEST_TURN;

/// With unexplained energy, a joint's element that is longer than this many times the largest
/// free length of all joints is torn by it. A soft one may well be as long under its load.
const TORN: f64 = 1000.0;

/// A joint extended by more than this fraction of its free length no longer acts as intended: its elements may tilt by
/// as many radians, and their stiffness per direction changes by as much. Rubber mounts that carry a car extend by a
/// fifth.
pub const OPENED: f64 = 0.25;

/// \[1\] fraction of its free length by which a spring must be extended or compressed: far above rounding.
const SIDE: f64 = 1e-5;

/// Factor for the scene's warnings at t = 0.
const WARNED: f64 = 100.0;

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunFailure {
    /// A step failed.
    Step(Cause),
    /// The energy of a sample is infinite or not a number, though no velocity is.
    Energy {
        /// The row of the fastest body.
        body: usize,
    },
    /// The energy grew far beyond the bound of what the scene can supply.
    Growth {
        /// \[J\] growth.
        growth: f64,
        /// The row of the fastest body.
        body: usize,
    },
    /// The energy grew likewise, and a joint is stretched beyond all that can be meant.
    Torn {
        /// The row of the joint.
        joint: usize,
        /// \[m\] the extension of its elements.
        extension: f64,
    },
}

/// Extension of a joint in the checked states. Values between two of them are unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// The row of the joint.
    pub joint: usize,
    /// \[m\] largest free length of its elements.
    pub free_length: f64,
    /// \[m\] the largest |L − L0| of an element, less the joint's clearance.
    pub extension: f64,
    /// \[s\] when.
    pub time: f64,
    /// \[s\] when it was first beyond [`OPENED`].
    pub since: Option<f64>,
}

impl Opening {
    /// The extension as a fraction of the free length.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.extension / self.free_length
    }
}

/// The body with the largest rotation per step in the checked states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turning {
    /// The row of the body.
    pub body: usize,
    /// \[rad\] rotation.
    pub turn: f64,
    /// \[s\] when.
    pub time: f64,
    /// \[s\] when a body first turned by more than [`LARGEST_TURN`] in a step.
    pub since: Option<f64>,
}

/// A two-sided spring whose name suggests a one-sided one, in the checked states.
#[derive(Clone, Debug, PartialEq)]
pub struct Reversal {
    /// The spring.
    pub spring: OneSided,
    /// \[N\] its tension at first.
    first: Option<f64>,
    /// \[N\] the smallest tension that counts.
    least: f64,
    /// \[s\] when it was first found on the other side, and \[N\] its tension then.
    pub since: Option<(f64, f64)>,
    /// \[N\] the largest tension on the other side, and \[s\] when.
    pub most: (f64, f64),
}

impl Reversal {
    /// Takes the tension \[N\] at `time` \[s\].
    fn push(&mut self, tension: f64, time: f64) {
        let other = if self.spring.pulls { -tension } else { tension };
        let first = *self.first.get_or_insert(other);
        // A spring on the other side at the start is reported before the run.
        if other <= self.least || first > WARNED * self.least {
            return;
        }
        self.since.get_or_insert((time, tension));
        if other > self.most.0.abs() {
            self.most = (tension, time);
        }
    }
}

/// Energy and extensions of a state.
pub struct Verdict {
    /// \[J\] its energy.
    pub energy: Energy<f64>,
    /// \[m\] the largest extension of the joints' elements.
    pub extension: f64,
}

/// The model that runs, its stored words taken as exact in double precision.
pub struct Monitor {
    model: SceneModel<F64>,
    /// The joint of each of the joints' groups, which come first.
    owners: Vec<usize>,
    /// \[m\] the clearance of each of these groups.
    clearances: Vec<f64>,
    /// \[m\] the largest extension of each joint in the last checked state.
    extensions: Vec<f64>,
    /// \[m\] the part of it beyond the clearance.
    beyond: Vec<f64>,
    openings: Vec<Opening>,
    turning: Turning,
    reversals: Vec<Reversal>,
    /// \[m\] the extension of a joint's element at which it counts as torn.
    torn: f64,
    step_size: f64,
    budget: Budget,
}

impl Monitor {
    /// The checker of a scene's plant.
    #[must_use]
    pub fn new(scene: &Scene, plant: &dyn AnyPlant) -> Self {
        let model = plant.model();
        let step_size = plant.step_size();
        let joints = scene.joints.last().map_or(0, |joint| joint.groups.end);
        let joints = &model.groups[..joints];
        let groups = scene.joints.iter().enumerate();
        let owners = groups.flat_map(|(row, joint)| joint.groups.clone().map(move |_| row));
        let owners: Vec<usize> = owners.collect();
        let clearance = |group: &Group| group.clearance.row().map(|row| model.clearances[row]);
        let clearances = joints.iter().map(|group| clearance(group).unwrap_or(0.0)).collect();
        let mut lengths = vec![0.0_f64; scene.joints.len()];
        for (group, joint) in joints.iter().zip(&owners) {
            lengths[*joint] = lengths[*joint].max(free_length(model, group));
        }
        let opening = |(joint, free_length): (usize, &f64)| Opening {
            joint,
            free_length: *free_length,
            extension: 0.0,
            time: 0.0,
            since: None,
        };
        let openings = lengths.iter().enumerate().map(opening).collect();
        // Guides are excluded: the distance of their points from the lines is not a size.
        let triples = joints.iter().filter(|group| group.law == Law::Tsda);
        let torn = TORN * triples.map(|group| free_length(model, group)).fold(0.0, f64::max);
        let start = State::initial(model);
        let budget = Budget::new(model, &start, &energy(model, &start, step_size), unit(plant));
        let [extensions, beyond] = [(); 2].map(|()| vec![0.0; scene.joints.len()]);
        let reversals = reversals(scene, model);
        let (model, turning) = (model.clone(), Turning::default());
        Self {
            model,
            owners,
            clearances,
            extensions,
            beyond,
            openings,
            turning,
            reversals,
            torn,
            step_size,
            budget,
        }
    }

    /// Extension of each joint in the states so far, in scene order.
    #[must_use]
    pub fn openings(&self) -> &[Opening] {
        &self.openings
    }

    /// \[m\] the largest extension of each joint's elements in the last checked state, in scene order.
    #[must_use]
    pub fn extensions(&self) -> &[f64] {
        &self.extensions
    }

    /// The body with the largest rotation per step so far.
    #[must_use]
    pub fn turning(&self) -> Turning {
        self.turning
    }

    /// The springs named like one-sided ones, and whether they acted on the other side so far.
    #[must_use]
    pub fn reversals(&self) -> &[Reversal] {
        &self.reversals
    }

    /// Energy and extensions of a state.
    ///
    /// # Errors
    /// A [`RunFailure`] if the run cannot continue.
    pub fn check(&mut self, state: &State<SceneModel<F64>>) -> Result<Verdict, RunFailure> {
        let energy = self.measure(state);
        if !energy.total().is_finite() {
            return Err(RunFailure::Energy { body: fastest(state) });
        }
        let (joint, extension) = self.look(state);
        self.look_at_turns(state);
        self.look_at_springs(state);
        let time = state.step as f64 * self.step_size;
        if let Some(growth) = self.budget.beyond(&self.model, state, &energy, time) {
            return Err(if self.torn > 0.0 && extension > self.torn {
                RunFailure::Torn { joint, extension }
            } else {
                RunFailure::Growth { growth, body: fastest(state) }
            });
        }
        Ok(Verdict { energy, extension })
    }

    /// Records the largest angular velocity.
    fn look_at_turns(&mut self, state: &State<SceneModel<F64>>) {
        let squares =
            state.bodies.iter().map(|body| body.angular_velocity.dot(body.angular_velocity));
        let fastest = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((body, turn)) =
            fastest.map(|(body, square)| (body, square.sqrt() * self.step_size))
        else {
            return;
        };
        let time = state.step as f64 * self.step_size;
        if turn > self.turning.turn {
            let since = self.turning.since;
            self.turning = Turning { body, turn, time, since };
        }
        if turn > LARGEST_TURN * (1.0 + 1e-9) {
            self.turning.since.get_or_insert(time);
        }
    }

    /// Records the side on which springs act.
    fn look_at_springs(&mut self, state: &State<SceneModel<F64>>) {
        if self.reversals.is_empty() {
            return;
        }
        let time = state.step as f64 * self.step_size;
        each_tension(&self.model, state, |group, tension| {
            let of_group = |one: &&mut Reversal| one.spring.group == group;
            if let Some(one) = self.reversals.iter_mut().find(of_group) {
                one.push(tension, time);
            }
        });
    }

    /// The energy, and every joint's extension, in one pass over the elements.
    fn measure(&mut self, state: &State<SceneModel<F64>>) -> Energy<f64> {
        self.extensions.fill(0.0);
        self.beyond.fill(0.0);
        let Self { extensions, beyond, owners, clearances, .. } = self;
        energy_with_extensions(&self.model, state, self.step_size, |group, extension| {
            let Some((&owner, clearance)) = owners.get(group).zip(clearances.get(group)) else {
                return;
            };
            let extension = extension.abs();
            let [whole, open] = [&mut extensions[owner], &mut beyond[owner]];
            *whole = whole.max(extension);
            *open = open.max(extension - clearance);
        })
    }

    /// Records every joint's extension; returns the joint with the largest one, and its value.
    fn look(&mut self, state: &State<SceneModel<F64>>) -> (usize, f64) {
        let time = state.step as f64 * self.step_size;
        for (opening, beyond) in self.openings.iter_mut().zip(&self.beyond) {
            if *beyond > opening.extension {
                (opening.extension, opening.time) = (*beyond, time);
                if *beyond > OPENED * opening.free_length {
                    opening.since.get_or_insert(time);
                }
            }
        }
        let rows = self.extensions.iter().copied().enumerate();
        rows.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    }
}

/// The springs to be looked at.
fn reversals(scene: &Scene, model: &SceneModel<F64>) -> Vec<Reversal> {
    let one = |spring: OneSided| {
        let group = model.groups.get(spring.group).filter(|group| group.law == Law::Tsda)?;
        let tsda = model.tsdas.get(usize::from(group.element))?;
        let least = SIDE * tsda.stiffness * tsda.free_length;
        Some(Reversal { spring, first: None, least, since: None, most: (0.0, 0.0) })
    };
    dbd_scene::one_sided_springs(scene).into_iter().filter_map(one).collect()
}

/// Whether a scene's total energy is meant to stay as it is.
#[must_use]
pub fn conserves_energy(scene: &Scene) -> bool {
    let model = &scene.model;
    undriven(model) && model.dampers.iter().all(|c| c.abs() == 0.0) && !laws_dissipate(scene)
}

/// Whether a law of the scene has a damper that may act, or a memory that may lose energy.
#[must_use]
pub fn laws_dissipate(scene: &Scene) -> bool {
    let laws = &scene.model.laws;
    laws.is_damped() || laws.memory().is_some()
}

/// Whether the initial state is the only source of energy.
fn undriven(model: &SceneModel<F64>) -> bool {
    model.loads.is_empty() && model.inputs.is_empty()
}

/// The relative rounding of the coarsest numbers of a plant's state.
fn unit(plant: &dyn AnyPlant) -> f64 {
    let NumberFormat { position, orientation, velocity, reading: _ } = plant.number_format();
    match [position, orientation, velocity].contains(&Digits::Single) {
        true => f32::EPSILON.into(),
        false => f64::EPSILON,
    }
}

/// The row of the body with the largest component of a velocity.
fn fastest(state: &State<SceneModel<F64>>) -> usize {
    let speed = |body: &BodyState<F64>| {
        let components = [body.velocity.to_f64(), body.angular_velocity.to_f64()];
        components.as_flattened().iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    };
    let speeds = state.bodies.iter().map(speed).enumerate();
    speeds.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(row, _)| row)
}
