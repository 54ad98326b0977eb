//! The PC's half: ports, plants of any method, controllers, and what both ends do there.
//!
//! `(scene, port, controller) => trace, report`. [`drive()`] is the controller's end with a model beside it that steps
//! as the plant does and is compared frame by frame; [`serve()`] is the plant's end.
//!
//! - [`port`]: addresses and open ports. [`disturbance`]: a line that damages frames, for tests.
//! - [`connection`]: a port that is opened again when it closes.
//! - [`plant`]: a scene's plant as a device. [`follower`]: the model beside a remote plant.
//! - [`controller`]: what sets the inputs: constants, noise, a child process.
//! - [`report`]: what a run counted. [`mod@drive`], [`mod@serve`]: the two ends.

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
