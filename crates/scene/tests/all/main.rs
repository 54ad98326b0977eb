//! Scenes: what is read, derived, written, refused and warned of.

mod assemble;
mod authoring;
mod couplings;
mod driven;
mod drives;
mod equations;
mod four_bar;
mod freedoms;
mod geometry;
mod injected;
mod limits;
mod long_form;
mod long_texts;
mod parameters;
mod planar;
mod properties;
mod quantities;
mod raw_groups;
mod realisations;

mod warnings;
mod winches;
