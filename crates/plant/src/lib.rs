//! Scenes stepped by any scheme in any precision, behind one type: what stands between a scene and
//! all that runs one on a host.
//!
//! `(scene, method, step) => plant => state, energy, read-outs`. The modules in the order in which
//! they stand on each other:
//!
//! - [`time`]: times with a unit, as text.
//! - [`digits`]: numbers as people read them.
//! - [`plan`]: a run in whole numbers.
//! - [`names`]: scheme, damping, precision and orientation by name.
//! - [`method`]: what these make together.
//! - [`numerals`]: how many digits a precision's numbers have.
//! - [`readings`]: what sensors show, in double precision.
//! - [`frequencies`]: how fast a scene can vibrate, and the step that follows.
//! - [`any`]: what a plant of any method can do.
//! - `budget`: how much energy a run can have.
//! - `refusal`: why there is no plant of a scene.
//! - [`plant`](mod@plant): where the names become the kernel's types.
//! - [`judge`]: what a state holds, and whether a run can go on from it.
//! - [`failure`]: where a run failed, and which step works instead.
//! - [`rounding`]: what sums in single precision lose of slow motion.
//! - [`instance`]: a scene as a component of another tool, what goes in and out by name.
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
//!     plant.advance(500).ok()?;
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

pub mod any;
mod budget;
pub mod digits;
pub mod failure;
pub mod frequencies;
pub mod instance;
pub mod judge;
pub mod method;
pub mod names;
pub mod numerals;
pub mod plan;
pub mod plant;
pub mod readings;
mod refusal;
pub mod rounding;
pub mod time;

pub use any::AnyPlant;
pub use failure::FailedRun;
pub use frequencies::Frequencies;
pub use method::{MOST_RHO, Method, MethodError};
pub use names::{DampingName, Named, OrientationName, PrecisionName, SchemeName};
pub use plan::{Plan, PlanError};
pub use plant::{PlantError, plant, plant_of_model};
