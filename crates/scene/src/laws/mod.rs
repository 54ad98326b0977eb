//! Laws between bodies that scenes can name, of this project and of a user's program, and a model's list of them.
//!
//! A user's crate registers custom laws with [`laws!`](crate::laws!), a program with [`register`] before it reads
//! scenes.

mod kit;
mod known;
mod linked;
mod list;
mod rows;
mod source;

#[doc(hidden)]
pub use inventory::submit;
pub use kit::{Poses, hold};
pub use known::KnownLaw;
#[doc(hidden)]
pub use linked::LinkedLaw;
pub use list::LawList;
pub(crate) use rows::Listed;
pub use rows::convert_words;
pub(crate) use source::SourceRows;

use std::sync::{PoisonError, RwLock};

use dbd_kernel::laws::{self, Law};

use crate::laws::linked::linked_laws;

static OWN: RwLock<Vec<KnownLaw>> = RwLock::new(Vec::new());

/// Registers a law for all scenes that this program reads from now on; `path` is the path of its Rust type, e.g.
/// `my_laws::Drag`, used in exported source. A law replaces an earlier one of the same name.
pub fn register<L: Law>(path: &str) {
    let law = KnownLaw::of::<L>(path);
    let mut own = OWN.write().unwrap_or_else(PoisonError::into_inner);
    put(&mut own, law);
}

/// A law by its name.
#[must_use]
pub fn known_law(name: &str) -> Option<KnownLaw> {
    known_laws().into_iter().find(|law| law.name == name)
}

/// All laws that scenes can name: those of the project, those of [`laws!`](crate::laws!), those of [`register`].
#[must_use]
pub fn known_laws() -> Vec<KnownLaw> {
    macro_rules! of_kernel {
        ($($law:ident),+ $(,)?) => {
            vec![$(KnownLaw::of::<laws::$law>(concat!("dbd_kernel::laws::", stringify!($law)))),+]
        };
    }
    let mut known = dbd_kernel::each_law!(of_kernel);
    let own = OWN.read().unwrap_or_else(PoisonError::into_inner);
    linked_laws().into_iter().chain(own.iter().cloned()).for_each(|law| put(&mut known, law));
    known
}

/// Adds a law; it replaces one of the same name.
fn put(known: &mut Vec<KnownLaw>, law: KnownLaw) {
    known.retain(|other| other.name != law.name);
    known.push(law);
}

/// The coefficient a \[s/m, s/rad\] at which an impact at `speed` v \[m/s, rad/s\] returns e times that, for
/// `F = k·x·(1 + a·ẋ)` whatever k: `(1 + a·v)·exp(−(1 + a·v)) = (1 − a·e·v)·exp(−(1 − a·e·v))` (Hunt & Crossley, J. Appl.
/// Mech. 42 (1975) 440, with exponent 1).
#[must_use]
pub fn dissipation(restitution: f64, speed: f64) -> f64 {
    let e = restitution;
    // Positive where y = a·v is too large; e·y < 1.
    let excess = |y: f64| libm::log1p(y) - y - (libm::log1p(-e * y) + e * y);
    let (mut least, mut most) = (0.0, 1.0 / e);
    if e == 1.0 {
        return 0.0;
    }
    // Until the bounds are adjacent.
    for _ in 0..200 {
        let middle = 0.5 * (least + most);
        if excess(middle) > 0.0 {
            most = middle;
        } else {
            least = middle;
        }
    }
    least / speed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_replaces_one_of_its_name() {
        let mut known = known_laws();
        let count = known.len();
        put(&mut known, KnownLaw::of::<laws::EndStop>("my_laws::EndStop"));
        assert_eq!(known.len(), count);
        assert_eq!(known.last().map(|law| law.path.as_str()), Some("my_laws::EndStop"));
    }
}
