//! Displacements between points relative to free lengths, and spring triples relative to their reference position.
//!
//! The input of a TSDA's law from a geometry: a displacement and, where it is more precise, the difference of its
//! square to that of the free length. A precision with reference data for triples gives the offset of their centre.

use crate::space::Linear;

/// The displacement from one point to another, and its length relative to a free one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elongation<V: Linear> {
    /// \[m\] world axes.
    pub way: V,
    /// \[m²\] the square minus that of the free length, `None` where the displacement is as precise.
    pub more: Option<V::Real>,
}

/// A TSDA of a triple in its reference state, in the axes of its second body. With o the offset of the triple's centre
/// and w the reference displacement, L² − L0² is (w² − L0²) − o·(2w − o): it has the precision of o.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AtRest<V: Linear> {
    /// \[m\] from the reference position of the triple's centre to the point of B.
    pub way: V,
    /// \[m²\] its square.
    pub square: V::Real,
    /// \[m²\] the square minus that of the free length.
    pub more: V::Real,
}

impl<V: Linear> AtRest<V> {
    /// The displacement for a centre `off` \[m\] from its reference position.
    #[inline(always)]
    pub(crate) fn elongation(&self, off: V) -> Elongation<V> {
        let way = self.way - off;
        // |a − b|² − |a|² = −b·(a + (a − b)).
        Elongation { way, more: Some(self.more - off.dot(self.way + way)) }
    }
}

/// The position of a triple's centre relative to its reference position in B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beside<V: Linear> {
    /// \[m\] its offset, world axes.
    pub off: V,
    /// \[m\] its lever arm from the centre of mass of A, world axes.
    pub arm_a: V,
    /// \[m\] its lever arm from the centre of mass of B.
    pub arm_b: V,
}

/// The position of a further triple's centre relative to the first one's, between the same bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beyond<V: Linear> {
    /// \[m\] the difference of their offsets, world axes.
    pub off: V,
    /// \[m\] the displacement between them in A, world axes.
    pub way: V,
}
