//! What small models of the kernel do, subject by subject: short runs of every element, scheme and precision.
//!
//! It is compiled without optimisation, which takes longer than the runs. What runs long stands in `tests/`.

mod analytic;
mod clearance;
mod conservation;
mod contact;
mod extremes;
mod guards;
mod inputs;
mod joint_torque;
mod laws;
mod model_spec;
mod orientation;
mod overdamped;
mod own_scheme;
mod owners;
mod planar;
mod readouts;
mod reference_forces;
mod snapshot;
mod sources;
mod status;
mod tables;
