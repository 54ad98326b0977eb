//! The PC side: ports, plants with any method, controllers, and both ends.
//!
//! `(scene, port, controller) => trace, report`. [`drive()`] is the controller's end with a local model that takes the
//! plant's steps and is compared frame by frame; [`serve()`] is the plant's end.
//!
//! A test that drives a plant at a port and requires equal bits:
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use dbd_link::host::{Connection, Controller, DriveOptions, Follower, HostPlant, Report, drive};
//! use dbd_link::message::Settings;
//! use dbd_plant::{Method, PrecisionName, SchemeName};
//! use dbd_scene::Scene;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = Scene::load("scenes/cart-pendulum.toml")?;
//! let method = Method::new(SchemeName::Leapfrog, None, PrecisionName::F32)?;
//! let plant = dbd_plant::plant(&scene, &method, 500e-6)?;
//! let mut model = Follower::new(HostPlant::new(&scene, plant)?);
//! let mut line = Connection::new("/dev/ttyACM0@921600".parse()?, Duration::from_millis(200), None);
//! let mut controller = Controller::Function(Box::new(|seen| vec![-8.0 * seen.sensors[3]]));
//! let options = DriveOptions {
//!     settings: Settings { steps: 2, ..Settings::default() },
//!     until: 20_000,
//!     patience: Duration::from_secs(10),
//!     silence: None,
//!     session: 1,
//! };
//! let mut report = Report::default();
//! drive(&mut line, &mut model, &mut controller, &options, &mut report, &mut |_| Ok(()))?;
//! assert!(report.is_equal(), "{:?}", report.first_difference);
//! # Ok(())
//! # }
//! ```
//!
//! - [`port`]: addresses and open ports. [`disturbance`]: a line that damages frames, for tests.
//! - [`connection`]: a port that is reopened when it closes.
//! - [`plant`]: a scene's plant as a device. [`follower`]: the local model of a remote plant.
//! - [`controller`]: controllers: constants, noise, a child process.
//! - [`report`]: statistics of a run. [`mod@drive`], [`mod@serve`]: the two ends.

pub mod connection;
pub mod controller;
pub mod disturbance;
pub mod drive;
pub mod follower;
pub mod plant;
pub mod port;
pub mod report;
pub mod serve;

pub use connection::Connection;
pub use controller::{Controller, ControllerError, Shown};
pub use disturbance::Disturbance;
pub use drive::{DriveError, DriveOptions, Sample, drive};
pub use follower::{Difference, Follower};
pub use plant::{HostPlant, TooMany};
pub use port::{Address, PortError};
pub use report::{Latency, Report};
pub use serve::{ServeError, ServeOptions, Served, serve};
