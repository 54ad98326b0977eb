//! Geometry of a mechanism at the initial pose, and a picture of it.
//!
//! `scene => mechanism => SVG`. The modules in dependency order:
//!
//! - [`mechanism`]: bodies as outlines between the points of their joints and elements, joints with
//!   their axes, springs, ground, loads; in the axes of their bodies, so that it can be moved.
//! - [`view`]: view directions and scale.
//! - `style`: colours, light and dark.
//! - `ink`: SVG elements as text.
//! - `paths`: lines of symbols: springs, hatching, arrows.
//! - `symbols`: joints, springs, ground, forces in a view.
//! - `faces`: outlines of bars, plates and solids in a view.
//! - `bodies`: bodies in a view.
//! - `names`: labels within the available space.
//! - `drawing`: one view, far parts first.
//! - `legend`: meaning of the symbols.
//! - `sheet`: the views on one sheet.
//! - `motion`: the large view at several poses, one after the other.

mod bodies;
mod drawing;
mod faces;
mod ink;
mod legend;
pub mod mechanism;
mod motion;
mod names;
mod paths;
mod sheet;
mod style;
mod symbols;
pub mod view;

pub use mechanism::Mechanism;
pub use motion::{Pose, motion};
pub use sheet::{Paper, svg};
