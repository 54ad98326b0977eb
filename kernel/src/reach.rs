//! Ways between points beside free lengths, and what a star of TSDAs is beside its rest.
//!
//! What a geometry tells the law of a TSDA: a way and, where that knows no better, by how much its square is more
//! than that of the free length. A precision that keeps stars at rest tells how far their centre is from there.

use crate::space::Linear;

/// The way from one point to another, and what is known of its length beside a free one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach<V: Linear> {
    /// \[m\] world axes.
    pub way: V,
    /// \[m²\] by how much its square is more than that of the free length, `None` where the way tells as well.
    pub more: Option<V::Real>,
}

/// A TSDA of a star at rest, in the axes of its second body. With o what the star's centre is off and w the way at
/// rest, L² − L0² is (w² − L0²) − o·(2w − o): its digits are those of o.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AtRest<V: Linear> {
    /// \[m\] from where the star's centre rests to the point of B.
    pub way: V,
    /// \[m²\] its square.
    pub square: V::Real,
    /// \[m²\] by how much that is more than the square of the free length.
    pub more: V::Real,
}

impl<V: Linear> AtRest<V> {
    /// The reach when the centre is `off` \[m\] from where it rests.
    #[inline(always)]
    pub(crate) fn reach(&self, off: V) -> Reach<V> {
        let way = self.way - off;
        // |a − b|² − |a|² = −b·(a + (a − b)).
        Reach { way, more: Some(self.more - off.dot(self.way + way)) }
    }
}

/// Where the centre of a star is beside where it rests in B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beside<V: Linear> {
    /// \[m\] how far it is off, world axes.
    pub off: V,
    /// \[m\] its arm from the centre of mass of A, world axes.
    pub arm_a: V,
    /// \[m\] its arm from the centre of mass of B.
    pub arm_b: V,
}

/// What the centre of a further star is beyond that of the first, which belongs to the same bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beyond<V: Linear> {
    /// \[m\] by how much more it is off, world axes.
    pub off: V,
    /// \[m\] the way there in A, world axes.
    pub way: V,
}
