//! A number that counts what is done with it.
//!
//! `arithmetic => the same arithmetic, operations`. A [`Counted`] has the bits of the number in it. Operations
//! are counted per thread.

use std::cell::Cell;
use std::cmp::Ordering;
use std::hint::black_box;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dbd_kernel::lanes::{Named, one_abreast};
use dbd_kernel::real::{Constant, Real};
use dbd_kernel::space::Space;
use dbd_kernel::words::{Word, WordSource};

/// How often each operation was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums and differences.
    pub add: u64,
    /// Products.
    pub multiply: u64,
    /// Quotients.
    pub divide: u64,
    /// Square roots.
    pub root: u64,
    /// Comparisons of two numbers, which are no floating-point operations here.
    pub compare: u64,
    /// Changes of sign, likewise.
    pub negate: u64,
}

impl Operations {
    /// Floating-point operations: sums, products, quotients and roots, each as one.
    #[must_use]
    pub fn flops(&self) -> u64 {
        self.add + self.multiply + self.divide + self.root
    }

    /// The operations that work does on this thread.
    pub fn of<T>(work: impl FnOnce() -> T) -> Self {
        DONE.set(Self::NONE);
        black_box(work());
        DONE.get()
    }

    const NONE: Self = Self { add: 0, multiply: 0, divide: 0, root: 0, compare: 0, negate: 0 };
}

thread_local! {
    static DONE: Cell<Operations> = const { Cell::new(Operations::NONE) };
}

fn count(one: impl FnOnce(&mut Operations)) {
    let mut done = DONE.get();
    one(&mut done);
    DONE.set(done);
}

/// A number `R` that counts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counted<R>(pub R);

impl<R: Real> PartialEq for Counted<R> {
    fn eq(&self, other: &Self) -> bool {
        count(|done| done.compare += 1);
        self.0 == other.0
    }
}

impl<R: Real> PartialOrd for Counted<R> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        count(|done| done.compare += 1);
        self.0.partial_cmp(&other.0)
    }
}

/// An operator that counts as one operation.
macro_rules! operator {
    ($trait:ident, $method:ident, $operation:ident) => {
        impl<R: Real> $trait for Counted<R> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                count(|done| done.$operation += 1);
                Self(self.0.$method(other.0))
            }
        }
    };
}

operator!(Add, add, add);
operator!(Sub, sub, add);
operator!(Mul, mul, multiply);
operator!(Div, div, divide);

impl<R: Real> Neg for Counted<R> {
    type Output = Self;

    fn neg(self) -> Self {
        count(|done| done.negate += 1);
        Self(-self.0)
    }
}

/// Coefficients of a precision as numbers that count.
macro_rules! coefficients {
    ($R:ty, $table:ident) => {{
        const TABLE: &[$R] = <$R as Real>::$table;
        const COUNTED: [Counted<$R>; TABLE.len()] = {
            let (mut counted, mut i) = ([Counted(0.0); TABLE.len()], 0);
            while i < TABLE.len() {
                counted[i] = Counted(TABLE[i]);
                i += 1;
            }
            counted
        };
        &COUNTED
    }};
}

/// The arithmetic of a precision, counted.
macro_rules! real {
    ($R:ty) => {
        impl Real for Counted<$R> {
            dbd_kernel::one_lane!();

            const ZERO: Self = Self(<$R as Real>::ZERO);
            const ONE: Self = Self(<$R as Real>::ONE);
            const HALF: Self = Self(<$R as Real>::HALF);
            const TWO: Self = Self(<$R as Real>::TWO);
            const PI: Self = Self(<$R as Real>::PI);
            const FRAC_PI_2: Self = Self(<$R as Real>::FRAC_PI_2);
            const FRAC_PI_4: Self = Self(<$R as Real>::FRAC_PI_4);
            const TAN_PI_8: Self = Self(<$R as Real>::TAN_PI_8);
            const ATAN: &'static [Self] = coefficients!($R, ATAN);
            const COS: &'static [Self] = coefficients!($R, COS);
            const SINC: &'static [Self] = coefficients!($R, SINC);

            fn from_f64(value: f64) -> Self {
                Self(<$R as Real>::from_f64(value))
            }
            fn constant(value: Constant) -> Self {
                Self(<$R as Real>::constant(value))
            }
            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }
            fn from_u64(value: u64) -> Self {
                Self(<$R as Real>::from_u64(value))
            }
            fn from_i32(value: i32) -> Self {
                Self(<$R as Real>::from_i32(value))
            }
            fn sqrt(self) -> Self {
                count(|done| done.root += 1);
                Self(Real::sqrt(self.0))
            }
            fn is_finite(self) -> bool {
                Real::is_finite(self.0)
            }
            fn word(self) -> Word {
                self.0.word()
            }
            fn from_words(source: &mut impl WordSource) -> Self {
                Self(<$R as Real>::from_words(source))
            }
        }
    };
}

real!(f64);
real!(f32);

impl<R: Named> Named for Counted<R>
where
    Self: Real,
{
    one_abreast!();
    type PassSum<S: Space> = R::PassSum<S>;
    const NAME: &'static str = R::NAME;
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{Quaternion, Vec3};

    use super::*;

    type C = Counted<f64>;

    fn vector() -> Vec3<C> {
        Vec3::new(Counted(1.0), Counted(-2.0), Counted(0.5))
    }

    /// Additions, products, quotients, roots.
    fn done<T>(work: impl FnOnce() -> T) -> [u64; 4] {
        let Operations { add, multiply, divide, root, .. } = Operations::of(work);
        [add, multiply, divide, root]
    }

    #[test]
    fn vectors_take_what_a_hand_counts() {
        let (u, v) = (vector(), vector());
        assert_eq!(done(|| u + v), [3, 0, 0, 0]);
        assert_eq!(done(|| u.dot(v)), [2, 3, 0, 0]);
        assert_eq!(done(|| u.cross(v)), [3, 6, 0, 0]);
        assert_eq!(done(|| u.dot(u).sqrt().reciprocal_or_zero()), [2, 3, 1, 1]);
        // Two quaternions: 16 products, 12 sums.
        let q = Quaternion::new(Counted(1.0), Counted(0.0), Counted(0.0), Counted(0.0));
        assert_eq!(done(|| q.product(q)), [12, 16, 0, 0]);
    }

    #[test]
    fn what_is_no_operation_is_counted_apart() {
        let operations = Operations::of(|| {
            let x = -Counted(3.0_f32);
            assert!(x < Counted(0.0) && x != Counted(1.0));
            assert_eq!(x.abs().0, 3.0);
        });
        let Operations { compare, negate, .. } = operations;
        assert_eq!((operations.flops(), compare, negate), (0, 3, 2));
        assert_eq!(Operations::of(|| ()), Operations::default());
    }

    #[test]
    fn it_has_the_bits_of_what_is_in_it() {
        for (counted, plain) in C::ATAN.iter().zip(<f64 as Real>::ATAN) {
            assert_eq!(counted.0, *plain);
        }
        let x = 0.3_f32;
        let sum = Counted(x).polynomial(Counted::<f32>::SINC).0;
        assert_eq!(sum.to_bits(), x.polynomial(<f32 as Real>::SINC).to_bits());
    }
}
