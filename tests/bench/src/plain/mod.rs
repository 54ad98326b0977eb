//! Leapfrog over the same elements, written plainly: one loop over one flat list, in double precision.
//!
//! `(model, step) => bodies, after so many steps`. Arrays of numbers and the standard library's functions, no
//! generic code and no library: what one writes who wants it fast and knows nothing more. Each element places
//! both its points; a rotation matrix is made once per body and pose. What it does not have, it refuses.

mod body;
mod elements;
mod read;
mod run;

pub use body::Body;
pub use elements::{Deformation, End, Spring, Torsion};
pub use read::Lacks;
pub use run::Plain;
