//! Solids shown in pictures.

/// A solid, in the axes of its body from its centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A block.
    Box {
        /// \[m\] its middle.
        at: [f64; 3],
        /// Unit quaternion, scalar first: from the block's axes to the body's.
        turn: [f64; 4],
        /// \[m\] half of each side, > 0.
        half: [f64; 3],
    },
    /// A cylinder with flat ends.
    Cylinder {
        /// \[m\] the distinct centres of its two ends.
        ends: [[f64; 3]; 2],
        /// \[m\], > 0.
        radius: f64,
    },
    /// A rod with round ends.
    Link {
        /// \[m\] the distinct centres of its two ends.
        ends: [[f64; 3]; 2],
        /// \[m\], > 0.
        radius: f64,
    },
    /// A ball.
    Sphere {
        /// \[m\] its centre.
        at: [f64; 3],
        /// \[m\], > 0.
        radius: f64,
    },
}
