//! Precisions of const models.

use dbd_kernel::{F32, F64, Fixed, Geometry as _};

use super::number::SourceGeometry as _;

/// Precisions that const models are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportPrecision {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
    /// Fixed-point geometry with forces in single precision.
    Fixed,
}

impl ExportPrecision {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::F64, Self::F32, Self::Fixed];

    /// `f64`, `f32` …
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => F64::NAME,
            Self::F32 => F32::NAME,
            Self::Fixed => Fixed::NAME,
        }
    }

    /// Suffix of types: `FourBarF32`.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::F64 => F64::SUFFIX,
            Self::F32 => F32::SUFFIX,
            Self::Fixed => Fixed::SUFFIX,
        }
    }

    /// Whether planar scenes support it.
    #[must_use]
    pub fn has_planes(self) -> bool {
        matches!(self, Self::F64 | Self::F32)
    }
}
