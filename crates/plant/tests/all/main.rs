//! Plants by name: their bits, where runs end, components of other tools.

mod failure;
mod instance;
mod judged;
#[cfg(feature = "lanes")]
mod lockstep;
mod planar;
mod plant;
mod raw_groups;
