//! Indices of a model's parts: small, `Copy`; some have a value for the world or for "none".

/// The index of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct InputIndex(pub u16);

/// The index of a torsion spring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct TorsionIndex(pub u16);

impl TorsionIndex {
    /// The index into slices of torsion springs.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> usize {
        self.0 as usize
    }
}

/// The index of a group: the elements of a joint between two bodies, or a single element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct GroupIndex(pub u16);

impl GroupIndex {
    /// The index into slices of groups.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> usize {
        self.0 as usize
    }
}

/// The index of a law's row, over all tables of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct LawIndex(pub u16);

/// The index of a body, or the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct BodyIndex(pub u16);

impl BodyIndex {
    /// The world: immovable, its points are the ground's.
    pub const WORLD: Self = Self(u16::MAX);

    /// Indices from here on are the ground's; it is also the largest number of bodies.
    pub const FIRST_ANCHOR: u16 = 0xff00;

    /// The ground moved by input `input`, an [`crate::elements::input::InputKind::Anchor`].
    ///
    /// # Panics
    /// Where the input's index is above 254.
    #[must_use]
    pub const fn anchor(input: InputIndex) -> Self {
        assert!(
            input.0 < u16::MAX - Self::FIRST_ANCHOR,
            "the input's index is too large for an anchor"
        );
        Self(Self::FIRST_ANCHOR + input.0)
    }

    /// The input that moves this part of the ground, if one does.
    #[inline(always)]
    #[must_use]
    pub const fn anchor_row(self) -> Option<usize> {
        if self.0 >= Self::FIRST_ANCHOR && self.0 != u16::MAX {
            Some((self.0 - Self::FIRST_ANCHOR) as usize)
        } else {
            None
        }
    }

    /// Whether this is the world, moved by an input or not: it is not moved by forces.
    #[must_use]
    pub const fn is_world(self) -> bool {
        self.0 >= Self::FIRST_ANCHOR
    }

    /// The index into slices of bodies; the world's is beyond the end.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> usize {
        self.0 as usize
    }
}

/// The index of the first damping coefficient of a group or spring, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct DamperIndex(pub u16);

impl DamperIndex {
    /// Undamped.
    pub const NONE: Self = Self(u16::MAX);

    /// The index into the dampers, `None` where undamped.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> Option<usize> {
        if self.0 == u16::MAX { None } else { Some(self.0 as usize) }
    }
}

/// The index of a group's clearance, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct ClearanceIndex(pub u16);

impl ClearanceIndex {
    /// Without clearance.
    pub const NONE: Self = Self(u16::MAX);

    /// The index into the clearances, `None` without one.
    #[inline(always)]
    #[must_use]
    pub const fn row(self) -> Option<usize> {
        if self.0 == u16::MAX { None } else { Some(self.0 as usize) }
    }
}
