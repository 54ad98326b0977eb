//! What a law between two points owns, and the list of such laws.
//!
//! A law acts along the way from a point of A to a point of B. Each owns its energy, the directions
//! in which its damper acts and its share of the frequency bound; [`crate::forces`] holds the walk
//! that places its points. A new law is a file beside this one, a variant of [`Law`] and of
//! [`Element`], and a field of [`crate::energy::Energy`].

use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::tsda::Tsda;
use crate::real::Real;
use crate::vector::Vec3;

/// The law that a group's elements follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Law {
    /// Stars of TSDAs with free lengths.
    Tsda,
    /// One point bushing.
    PointBushing,
    /// Stars on lines: each star's first point and its elements' direction define a line of the
    /// first body, on which the second body's points are projected.
    PointOnLine,
}

impl Law {
    /// Whether a star of this law may have `arms` points of the second body.
    #[must_use]
    pub const fn takes_arms(self, arms: u8) -> bool {
        match self {
            Law::Tsda => arms == 1 || arms == 3,
            Law::PointBushing => arms == 1,
            Law::PointOnLine => arms == 1 || arms == 2,
        }
    }
}

/// An element at a pose, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<R> {
    /// \[m\] from its first point to its second; on a line from the foot to the point.
    pub displacement: Vec3<R>,
    /// The direction of its line; 0 where the law knows no line.
    pub direction: Vec3<R>,
}

/// What energies, sweeps, read-outs and frequencies ask of a law.
pub trait PointLaw<R: Real> {
    /// \[m\] how far the element is from its free length.
    fn extension(&self, displacement: Vec3<R>) -> R;

    /// \[J\] stored energy, beyond a clearance \[m\] if there is one.
    fn energy(&self, displacement: Vec3<R>, clearance: Option<R>) -> R;

    /// The directions in which its damper acts, and how many of them there are.
    fn damped(&self, stretch: &Stretch<R>) -> ([Vec3<R>; 3], usize);

    /// Its tangent as springs, `add(κ \[N/m\], direction)`, which act on a body at the end of `arm`
    /// \[m\]; returns \[N·m\] what its force does to a turn of the body, in any direction at most.
    fn tangent(&self, stretch: &Stretch<R>, arm: Vec3<R>, add: &mut impl FnMut(R, Vec3<R>)) -> R;
}

/// One element of any law.
#[derive(Clone, Copy, Debug)]
pub enum Element<'m, R> {
    /// A TSDA with a free length.
    Tsda(&'m Tsda<R>),
    /// A TSDA of no free length.
    PointBushing(&'m PointBushing<R>),
    /// A point held to a line.
    PointOnLine(&'m PointOnLine<R>),
}

/// Calls a method of the law that an element follows.
macro_rules! of_law {
    ($element:expr, $law:ident => $call:expr) => {
        match $element {
            Element::Tsda($law) => $call,
            Element::PointBushing($law) => $call,
            Element::PointOnLine($law) => $call,
        }
    };
}

impl<R: Real> PointLaw<R> for Element<'_, R> {
    #[inline(always)]
    fn extension(&self, displacement: Vec3<R>) -> R {
        of_law!(self, law => PointLaw::extension(*law, displacement))
    }

    #[inline(always)]
    fn energy(&self, displacement: Vec3<R>, clearance: Option<R>) -> R {
        of_law!(self, law => PointLaw::energy(*law, displacement, clearance))
    }

    #[inline(always)]
    fn damped(&self, stretch: &Stretch<R>) -> ([Vec3<R>; 3], usize) {
        of_law!(self, law => law.damped(stretch))
    }

    #[inline(always)]
    fn tangent(&self, stretch: &Stretch<R>, arm: Vec3<R>, add: &mut impl FnMut(R, Vec3<R>)) -> R {
        of_law!(self, law => law.tangent(stretch, arm, add))
    }
}

/// The tangent that a tension \[N\] adds to whatever it pulls along `displacement`: |T|/L along both
/// normals; returns |T|·|arm|.
#[inline(always)]
pub(crate) fn taut<R: Real>(
    tension: R,
    displacement: Vec3<R>,
    arm: Vec3<R>,
    add: &mut impl FnMut(R, Vec3<R>),
) -> R {
    let inverse = displacement.dot(displacement).sqrt().reciprocal_or_zero();
    for n in (displacement * inverse).normals() {
        add(tension * inverse, n);
    }
    tension * arm.dot(arm).sqrt()
}
