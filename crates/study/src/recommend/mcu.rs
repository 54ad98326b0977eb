//! Microcontrollers: instructions and time of a step.
//!
//! `(instructions of a Cortex-M4F, precision) => instructions, seconds`. Instructions are counted in an emulator;
//! cycles per instruction are estimates from the cores' manuals, and no silicon was measured.

use dbd_plant::PrecisionName;

/// A class of microcontrollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mcu {
    /// As on the command line: `cortex-m4f`.
    pub name: &'static str,
    /// \[Hz\] a usual clock.
    pub clock: f64,
    /// \[1\] Cycles per instruction, an estimate.
    pub cycles: f64,
    /// \[1\] Instructions of a step over those of a Cortex-M4F, in `f32`, `fixed`, `f64`: the geometric means of three
    /// scenes (four-bar, hexagon, 3rrr by leapfrog in projects of `host-sim new firmware`), each counted in QEMU by
    /// `cargo cost` from the same source compiled for the core; the three are within 7 % of each other.
    pub factors: [f64; 3],
    /// Basis of the factors.
    pub basis: &'static str,
}

/// All of them.
pub const MCUS: [Mcu; 6] = [
    Mcu {
        name: "cortex-m0plus",
        clock: 64e6,
        cycles: 1.4,
        factors: [56.5, 38.3, 2.57],
        basis: "counted: thumbv6m, all real numbers by software",
    },
    Mcu {
        name: "cortex-m4f",
        clock: 168e6,
        cycles: 1.5,
        factors: [1.0; 3],
        basis: "counted: single precision in hardware, double by software",
    },
    Mcu {
        name: "cortex-m7",
        clock: 480e6,
        cycles: 1.0,
        factors: [1.0; 3],
        basis: "counts of Cortex-M4F: the same instructions where the FPU is of single precision",
    },
    Mcu {
        name: "cortex-m7-double",
        clock: 480e6,
        cycles: 1.0,
        factors: [1.0, 1.0, 0.0400],
        basis: "counted: single and double precision in hardware",
    },
    Mcu {
        name: "cortex-m33",
        clock: 160e6,
        cycles: 1.4,
        factors: [1.0; 3],
        basis: "counts of Cortex-M4F: Armv8-M runs the same instructions",
    },
    Mcu {
        name: "rv32imafc",
        clock: 144e6,
        cycles: 1.4,
        factors: [1.0; 3],
        basis: "counted: single precision in hardware, double by software",
    },
];

impl Mcu {
    /// One by its name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<&'static Self> {
        MCUS.iter().find(|mcu| mcu.name == name)
    }

    /// Instructions of a step in a precision, given those on a Cortex-M4F; `None` for one that firmware does not
    /// support.
    #[must_use]
    pub fn instructions(&self, precision: PrecisionName, on_m4f: f64) -> Option<f64> {
        let [single, fixed, double] = self.factors;
        match precision {
            PrecisionName::F32 => Some(single * on_m4f),
            PrecisionName::Fixed => Some(fixed * on_m4f),
            PrecisionName::F64 => Some(double * on_m4f),
            _ => None,
        }
    }
}
