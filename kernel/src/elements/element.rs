//! The list of laws between two points.
//!
//! A new law needs a file in this folder that implements [`PointLaw`], a variant of [`Law`] and of [`Element`], a file
//! with its loop in [`crate::forces`] and a field of [`crate::energy::Energy`].

use crate::elements::point_bushing::PointBushing;
use crate::elements::point_law::{Deformation, PointLaw, Turning};
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::space::Space;

/// The law that a group's elements follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Law {
    /// Spring triples of TSDAs with free lengths.
    Tsda,
    /// Point bushings: every triple has one point of the second body, not shared.
    PointBushing,
    /// Points on lines: each triple's first point and its elements' direction define a line of the first body, on which
    /// the second body's points are projected.
    PointOnLine,
    /// One revolute joint of bushings.
    Revolute,
    /// One universal joint without a spider.
    Universal,
}

impl Law {
    /// The number of rows of a damped group of `elements` elements among the model's dampers, in a plane or in space:
    /// one per element, and for bushings at least the number of damping modes (see [`crate::damping`]). Coefficients
    /// beyond those of the elements are 0.
    #[must_use]
    pub const fn damper_rows(self, elements: usize, planar: bool) -> usize {
        let levers = match (self, planar, elements) {
            (Law::PointBushing, true, 1) => 2,
            (Law::PointBushing, true, _) => 3,
            (Law::PointBushing, false, 1) => 3,
            (Law::PointBushing, false, _) => 6,
            (Law::Revolute, false, _) => 5,
            _ => 1,
        };
        if levers > elements { levers } else { elements }
    }

    /// Whether a triple of this law may have `arms` points of the second body.
    #[must_use]
    pub const fn takes_arms(self, arms: u8) -> bool {
        match self {
            Law::Tsda => arms >= 1 && arms <= 3,
            Law::PointBushing | Law::Revolute | Law::Universal => arms == 1,
            Law::PointOnLine => arms == 1 || arms == 2,
        }
    }
}

/// One element of any law.
#[derive(Clone, Copy, Debug)]
pub enum Element<'m, S: Space> {
    /// A TSDA with a free length.
    Tsda(&'m Tsda<S::Real>),
    /// A TSDA of zero free length.
    PointBushing(&'m PointBushing<S::Real>),
    /// A point on a line.
    PointOnLine(&'m PointOnLine<S>),
    /// A revolute joint of bushings.
    Revolute(&'m Revolute<S>),
    /// A universal joint without a spider.
    Universal(&'m Universal<S>),
}

/// Calls a method of the law that an element follows.
macro_rules! of_law {
    ($element:expr, $law:ident => $call:expr) => {
        match $element {
            Element::Tsda($law) => $call,
            Element::PointBushing($law) => $call,
            Element::PointOnLine($law) => $call,
            Element::Revolute($law) => $call,
            Element::Universal($law) => $call,
        }
    };
}

impl<S: Space> Element<'_, S> {
    /// See [`PointLaw::extension`].
    #[inline(always)]
    pub fn extension(&self, deformation: &Deformation<S::Vector>) -> S::Real {
        of_law!(self, law => PointLaw::extension(*law, deformation))
    }

    /// \[N/m\] its stiffness; of a revolute joint the radial one.
    #[inline(always)]
    pub fn stiffness(&self) -> S::Real {
        of_law!(self, law => law.stiffness)
    }

    /// See [`PointLaw::energy`].
    #[inline(always)]
    pub fn energy(
        &self,
        deformation: &Deformation<S::Vector>,
        clearance: Option<S::Real>,
    ) -> S::Real {
        of_law!(self, law => PointLaw::energy(*law, deformation, clearance))
    }

    /// See [`PointLaw::tangent`].
    #[inline(always)]
    pub fn tangent(
        &self,
        deformation: &Deformation<S::Vector>,
        arm: S::Vector,
        add: &mut impl FnMut(S::Real, S::Vector),
    ) -> Turning<S::Vector> {
        of_law!(self, law => PointLaw::tangent(*law, deformation, arm, add))
    }
}
