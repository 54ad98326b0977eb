//! A plant that is stepped, changed, grabbed and wound back.
//!
//! `(scene's text, settings, changes) => session; (steps, inputs, hand) => frames`. Steps are those of `host-sim run`: so
//! long as nobody lays a hand on the plant, its state has the same hash at the same step.

mod asked;
mod change;
mod frame;
mod hand;
mod kept;
mod live;
mod marks;
mod opened;
mod replay;

pub use asked::{Change, Grab, Set};
pub use frame::{Layout, STATUS};
pub use live::{MAX_TEXT, Session};
pub use opened::Opened;
