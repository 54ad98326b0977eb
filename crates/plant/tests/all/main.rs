//! Plants by name: their bits, where runs end, components of other tools.

mod failure;
mod instance;
mod judged;
mod planar;
mod plant;
