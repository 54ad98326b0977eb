//! What distinguishes the floating-point numbers: names, sums of damper passes, lanes.

use crate::pass_sum::PassSum;
use crate::real::Real;
use crate::space::Space;
use crate::vector::Vec3;

/// The difference between the floating-point precisions.
pub trait Named: Sized {
    /// The name users give: `f64`, `f32`.
    const NAME: &'static str;
    /// [`crate::Geometry::PassSum`] of a space of this number.
    type PassSum<S: Space>: PassSum<S>;
    /// The number of several lanes in which alike joints of one model are computed together; `Self` without lanes.
    type Abreast: Real + Named;

    /// A number per lane.
    fn abreast(of: impl Fn(usize) -> Self) -> Self::Abreast;
    /// The number in a lane.
    fn lane(of: Self::Abreast, lane: usize) -> Self;
}

impl<R: Real + Named> Vec3<R> {
    /// A vector per lane.
    #[inline(always)]
    pub(crate) fn abreast(of: impl Fn(usize) -> Self) -> Vec3<R::Abreast> {
        Vec3::new(
            R::abreast(|lane| of(lane).x),
            R::abreast(|lane| of(lane).y),
            R::abreast(|lane| of(lane).z),
        )
    }

    /// The vector in a lane.
    #[inline(always)]
    pub(crate) fn lane(of: Vec3<R::Abreast>, lane: usize) -> Self {
        Self::new(R::lane(of.x, lane), R::lane(of.y, lane), R::lane(of.z, lane))
    }
}

/// [`Named::Abreast`] of a number without lanes, within its implementation.
#[macro_export]
macro_rules! one_abreast {
    () => {
        type Abreast = Self;

        #[inline(always)]
        fn abreast(of: impl Fn(usize) -> Self) -> Self {
            of(0)
        }
        #[inline(always)]
        fn lane(of: Self, _: usize) -> Self {
            of
        }
    };
}
pub use one_abreast;
