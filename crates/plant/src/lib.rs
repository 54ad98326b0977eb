//! Scenes stepped by any scheme in any precision behind one type, for everything that runs a scene on a host.
//!
//! `(scene, method, step) => plant => state, energy, sensors`. The modules in dependency order:
//!
//! - [`time`]: times with a unit, as text.
//! - [`digits`]: rounded numbers for display.
//! - [`plan`]: a run in whole numbers.
//! - [`names`]: scheme, damping, precision and orientation by name.
//! - [`method`]: their combination.
//! - [`number_format`]: number formats of the precisions.
//! - [`readings`]: sensor values in double precision.
//! - [`frequencies`]: highest frequency of a scene, and the advised step.
//! - [`any`]: interface of a plant, independent of its method.
//! - `budget`: upper bound of the energy of a run.
//! - `refusal`: errors when creating a plant.
//! - [`plant`](mod@plant): plant of any method, with the kernel's types.
//! - [`monitor`]: energy and joint extensions of a state, and whether a run can continue.
//! - [`failure`]: failed runs: position, cause, and a step that works.
//! - [`rounding`]: rounding losses of slow motion in single precision.
//! - [`instance`]: a scene as a component of another tool, with named inputs and outputs.
//!
//! A scene and a run:
//!
//! ```
//! use dbd_plant::{Method, plant};
//! use dbd_scene::Scene;
//!
//! # let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(folder)?;
//! let scene = Scene::load("scenes/four-bar.toml")?;
//! let mut plant = plant(&scene, &Method::default(), 2e-5)?;
//! while plant.time() < scene.duration {
//!     plant.advance(500)?;
//!     let crank = &plant.state().bodies[0];
//!     println!("{:.2} s: {:?} m, {} J", plant.time(), crank.position, plant.energy().total());
//! }
//! # assert_eq!(plant.steps(), 25_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! | feature | brings |
//! |---|---|
//! | `comparison` | methods that exist for comparison only, micromath's square root and Euler angles: three of six precisions in space, and as much more to compile |
//! | `lanes` | [`instance::lockstep`]: similar instances together, one per SIMD lane; it doubles what is compiled |

pub mod any;
mod budget;
pub mod digits;
pub mod failure;
pub mod frequencies;
pub mod instance;
pub mod method;
pub mod monitor;
pub mod names;
pub mod number_format;
pub mod plan;
pub mod plant;
pub mod readings;
mod refusal;
pub mod rounding;
pub mod time;

pub use any::AnyPlant;
pub use failure::FailedRun;
pub use frequencies::Frequencies;
pub use method::{MAX_RHO, Method, MethodError};
pub use names::{DampingName, Named, OrientationName, PrecisionName, SchemeName};
pub use plan::{Plan, PlanError};
pub use plant::{PlantError, plant, plant_of_model};
