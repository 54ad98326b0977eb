//! A plant behind embedded-hal: what the parts' datasheets say.

mod ends;
mod imu;
mod sensors;
mod shaft;
mod wiring;
