//! Discrete Body Dynamics for firmware: `no_std`, allocation-free, deterministic.
//!
//! A mechanism is rigid bodies joined by translational spring-dampers (TSDAs); there are no
//! constraints, and explicit schemes need no matrix (Franco & Degani, Appl. Sci. 2026, 16, 2297). The same scene,
//! scheme, precision and step give the same bits on every target.
//!
//! ```
//! use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
//! use dbd_kernel::{BodyIndex, Leapfrog, Plant, model};
//!
//! // A mass of 2 kg on a spring of 50 N/m, 0.1 m beyond its free length of 1 m.
//! const SPRING: Spring = Spring { stiffness: 50.0, damping: 0.0, free_length: 1.0 };
//! const MODEL_SPEC: ModelSpec = ModelSpec::new()
//!     .body(2.0, [0.1; 3], Start::at([1.1, 0.0, 0.0]))
//!     .tsda([BodyIndex::WORLD, BodyIndex(0)], [[0.0; 3]; 2], SPRING);
//! model!(static OSCILLATOR: F64 = MODEL_SPEC);
//!
//! let mut plant = Plant::new(&OSCILLATOR, Leapfrog, 1e-3)?;
//! plant.advance(1_000)?;
//! // x = 1 + 0.1·cos(ω·t), ω = 5 rad/s.
//! let x = plant.state().bodies[0].position.x;
//! assert!((x - 1.0 - 0.1 * 5.0_f64.cos()).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # By task
//!
//! | task | items |
//! |---|---|
//! | a model from a scene | the build script's crate `dbd-scene` writes a const [`Model`] |
//! | a const model by hand | [`model!`], [`model_spec`] |
//! | a model at run time | [`builder`] (feature `heapless`) |
//! | choice of precision, in space or in a plane | the types [`F64`], [`F32`], [`Fixed`], [`Planar64`], [`Planar32`] |
//! | steps and their failures | [`Plant`], [`schemes`], [`Failure`] |
//! | inputs, sensors, signal chains | [`Plant::set_input`], [`sources`], [`readouts`], [`chain`], [`random`] |
//! | checks and balances of energy | [`watch`], [`energy`], [`power`] |
//! | a state on another machine | [`snapshot`], [`fingerprint`], [`Plant::hash`] |
//! | a user-defined law | [`laws`], [`law!`] |
//! | a user-defined scheme | [`Scheme`], [`step`], [`keep`] |
//!
//! # Features
//!
//! None is on by default.
//!
//! | feature | brings |
//! |---|---|
//! | `defmt` | on a microcontroller, `defmt::Format` on every public type |
//! | `heapless` | [`builder`]: models of fixed capacity, assembled at run time |
//! | `fpu` | square roots by instructions of a Cortex-M7 (f64) or RISC-V with F (f32); a core without them faults |
//! | `nalgebra` | `From` and `Into` between the vectors and quaternions of both |
//! | `micromath` | `approximate`: single precision with micromath's square root, for comparison |
//!
//! # Order of modules
//!
//! Each module uses only those before it (a test checks it). Modules without a link serve the project's other crates:
//! they are hidden from this documentation and may change. What users need of them is at the root.
//!
//! - `words`, `square_root`, `real`, `vector`, `freedoms`, `space`, `plane`, `arctangent`: arithmetic,
//!   including blocks of numbers, and the words in which state is stored.
//! - `compositions`, `index`: coefficients of schemes, and indices of a model's parts.
//! - `attitude`, `elongation`, `pass_sum`, `lanes`, `force_pair`: orientations, displacements, sums; numbers of several
//!   lanes; forces on two bodies.
//! - `geometry`, `fixed`, `planar`, `euler`, `approximate`: a precision is a type: [`F64`], [`F32`], [`Fixed`], in the
//!   plane [`Planar64`], [`Planar32`]; an orientation is a quaternion or, as in the paper, Euler angles.
//! - `body`, `rotation`, `lockstep`: one rigid body, and its rotation, alone or in lanes.
//! - [`random`], [`chain`]: random numbers; signal chains of sensors and actuators.
//! - `status`, `elements`, `schedule`, [`sources`]: failures; the element laws, one per file; the timing of loads
//!   and inputs; sines and tables that drive inputs.
//! - [`laws`]: user-defined laws, each a type that a model lists.
//! - [`mod@model`], [`model_spec`], [`state`]: read-only constants of bodies and elements, and their source form; the state
//!   and its hash.
//! - `pose`, `sensors`, `forces`, `damping`: points of elements; motion sensors; one force evaluation; dampers as
//!   impulses.
//! - `solve`, [`keep`]: the linear system of implicit schemes; the storage of a scheme in its plant.
//! - [`step`], [`schemes`]: kick and drift; schemes composed of them.
//! - `frequency`: the highest natural frequency of a model.
//! - `guards`, `extents`, `refusal`, [`plant`]: checks after every step; the range of a precision; errors of a plant;
//!   model, scheme, step and state together.
//! - [`energy`], [`power`], [`watch`]: the energy of a state; its change by loads, inputs and dampers; guards on energy
//!   and frequency.
//! - [`fingerprint`], [`snapshot`], [`readouts`]: the identity of a state's model; a state as bytes, portable between
//!   machines; sensors.
//! - [`builder`], `convert`, `format`: models assembled at run time, nalgebra's types, defmt's (features).
//! - [`generated`]: the names in exported source.
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

// For tests, and for WebAssembly's square root.
#[cfg(any(test, target_family = "wasm"))]
extern crate std;

#[doc(hidden)]
#[cfg(feature = "micromath")]
pub mod approximate;
#[doc(hidden)]
pub mod arctangent;
#[doc(hidden)]
pub mod attitude;
#[doc(hidden)]
pub mod body;
#[cfg(feature = "heapless")]
pub mod builder;
pub mod chain;
mod compositions;
#[cfg(feature = "nalgebra")]
mod convert;
#[doc(hidden)]
pub mod damping;
#[doc(hidden)]
pub mod elements;
#[doc(hidden)]
pub mod elongation;
pub mod energy;
#[doc(hidden)]
pub mod euler;
#[doc(hidden)]
pub mod extents;
pub mod fingerprint;
#[doc(hidden)]
pub mod fixed;
mod force_pair;
#[doc(hidden)]
pub mod forces;
#[cfg(all(feature = "defmt", target_os = "none"))]
mod format;
#[doc(hidden)]
pub mod freedoms;
#[doc(hidden)]
pub mod frequency;
pub mod generated;
#[doc(hidden)]
pub mod geometry;
mod guards;
#[doc(hidden)]
pub mod index;
pub mod keep;
#[doc(hidden)]
pub mod lanes;
pub mod laws;
mod lockstep;
pub mod model;
pub mod model_spec;
#[doc(hidden)]
pub mod pass_sum;
#[doc(hidden)]
pub mod planar;
#[doc(hidden)]
pub mod plane;
pub mod plant;
mod pose;
pub mod power;
pub mod random;
pub mod readouts;
#[doc(hidden)]
pub mod real;
mod refusal;
#[doc(hidden)]
pub mod rotation;
#[doc(hidden)]
pub mod schedule;
pub mod schemes;
mod sensors;
pub mod snapshot;
#[doc(hidden)]
pub mod solve;
pub mod sources;
#[doc(hidden)]
pub mod space;
mod square_root;
pub mod state;
#[doc(hidden)]
pub mod status;
pub mod step;
#[doc(hidden)]
pub mod vector;
pub mod watch;
#[doc(hidden)]
pub mod words;

pub use body::{Body, BodyState};
pub use elements::load::{Load, LoadFrame};
pub use elements::point_bushing::PointBushing;
pub use elements::point_on_line::PointOnLine;
pub use elements::revolute::Revolute;
pub use elements::torsion_spring::TorsionSpring;
pub use elements::tsda::Tsda;
pub use elements::universal::Universal;
pub use energy::Energy;
pub use fixed::Fixed;
pub use geometry::{F32, F64, Geometry};
pub use index::{BodyIndex, GroupIndex, InputIndex, LawIndex, TorsionIndex};
pub use model::{Model, ModelOwner};
pub use planar::{Planar32, Planar64};
pub use plant::Plant;
pub use real::Real;
pub use schemes::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, GeneralizedAlpha, GeneralizedAlpha3, JointWise,
    Leapfrog, Pefrl, Rk4, Scheme, SemiImplicitEuler,
};
pub use state::State;
pub use status::{Cause, Failure};
pub use vector::{Quaternion, Vec3};
