//! Recorded plants and their state at a sample.
//!
//! `plant => identity; plant => step, hash, numbers of each body`. Implemented for the kernel's plant with any storage
//! of its model; for plants by name with the feature `std`.

use core::ops::Deref;

use dbd_kernel::fingerprint::model_hash;
use dbd_kernel::words::{Word, WordVisitor, Words};
use dbd_kernel::{BodyState, Geometry, ModelOwner, Plant, Real, Scheme};

use crate::head::{Identity, NumberFormat, PrecisionTag, SchemeTag};
use crate::number::Digits;

/// The numbers of a body: position \[m\] (x, y, z), unit quaternion body → world (w, x, y, z), velocity
/// \[m/s\] of the centre of mass in the world, angular velocity \[rad/s\] in body axes.
pub type BodyNumbers = [f64; 13];

/// A state at a sample.
pub trait Moment {
    /// Steps done since t = 0.
    fn steps_done(&self) -> u64;
    /// FNV-1a 64 over the state's stored words.
    fn state_hash(&self) -> u64;
    /// The numbers of a body, widened exactly; `None` beyond the last.
    fn body_numbers(&self, row: usize) -> Option<BodyNumbers>;
    /// The revolution count of a torsion spring; `None` beyond the last.
    fn turn_count(&self, spring: usize) -> Option<i32>;
}

/// A plant that can be recorded.
pub trait Subject: Moment {
    /// Its identity, which determines its bits.
    fn identity(&self) -> Identity<'static>;
}

impl<H, S> Moment for Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    fn steps_done(&self) -> u64 {
        self.state().step
    }

    fn state_hash(&self) -> u64 {
        Plant::hash(self)
    }

    fn body_numbers(&self, row: usize) -> Option<BodyNumbers> {
        self.state().bodies.as_ref().get(row).map(numbers)
    }

    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.state().turns.as_ref().get(spring).copied()
    }
}

impl<H, S> Subject for Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    fn identity(&self) -> Identity<'static> {
        type Of<H> = <<H as Deref>::Target as ModelOwner>::Precision;
        Identity {
            scheme: SchemeTag {
                name: S::NAME,
                damping: S::DAMPING.name(),
                evaluations: self.scheme().evaluations(),
            },
            precision: PrecisionTag { name: Of::<H>::NAME, orientation: Of::<H>::ORIENTATION },
            number_format: number_format::<Of<H>>(),
            step_size: self.step_size(),
            model: model_hash(self.model()),
            bodies: self.state().bodies.as_ref().len(),
            turns: self.state().turns.as_ref().len(),
        }
    }
}

/// A body's numbers in the order of a row.
pub(crate) fn numbers<P: Geometry>(body: &BodyState<P>) -> BodyNumbers {
    let ([x, y, z], [qw, qx, qy, qz], [vx, vy, vz], [wx, wy, wz]) = body.to_f64();
    [x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz]
}

/// Number of digits of the numbers of a precision.
fn number_format<P: Geometry>() -> NumberFormat {
    NumberFormat {
        position: digits(&P::Position::default(), 3),
        orientation: digits(&P::Orientation::default(), 4),
        velocity: digits(&P::Velocity::default(), 3),
        value: match P::Real::ZERO.word() {
            Word::F32(_) => Digits::Single,
            _ => Digits::Double,
        },
    }
}

/// Single if the quantity is stored as f32 words, one per component.
fn digits(stored: &impl Words, components: usize) -> Digits {
    struct Singles(usize, usize);
    impl WordVisitor for Singles {
        fn word(&mut self, word: Word) {
            match word {
                Word::F32(_) => self.0 += 1,
                _ => self.1 += 1,
            }
        }
    }
    let mut count = Singles(0, 0);
    stored.visit(&mut count);
    if count.0 == components && count.1 == 0 { Digits::Single } else { Digits::Double }
}
