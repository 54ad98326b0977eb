//! Numbers as their bit patterns, so that the compiler reads the bits that the assembly computed.

use dbd_kernel::Real;
use dbd_kernel::geometry::Named;

/// A number that can be written as source, and the precision made of it.
pub trait SourceNumber: Real + Named {
    /// The precision's type in the kernel.
    const TYPE: &'static str;
    /// The number's expression.
    fn number(self) -> String;
}

impl SourceNumber for f64 {
    const TYPE: &'static str = "F64";
    fn number(self) -> String {
        format!("f64::from_bits({:#018x})", self.to_bits())
    }
}

impl SourceNumber for f32 {
    const TYPE: &'static str = "F32";
    fn number(self) -> String {
        format!("f32::from_bits({:#010x})", self.to_bits())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_their_bits() {
        assert_eq!(1.0_f32.number(), "f32::from_bits(0x3f800000)");
        assert_eq!((-2.5_f64).number(), "f64::from_bits(0xc004000000000000)");
    }
}
