//! Microcontrollers: instructions and time of a step.
//!
//! `(instructions of a Cortex-M4F, precision) => instructions, seconds`. Instructions are counted in an emulator
//! (`cargo xtask cost --cores`); cycles per instruction are estimates from the cores' manuals, and no silicon was
//! measured.

use dbd_plant::{Named as _, PrecisionName};
use serde::Deserialize;

/// The counts of all cores as shipped.
const TABLE: &str = include_str!("../../cores.csv");
/// The class that the other counts are relative to.
const COUNTED: &str = "cortex-m4f";

/// The columns that are read.
#[derive(Deserialize)]
struct Row {
    scene: String,
    mcu: String,
    precision: String,
    instructions_mean: f64,
}

/// A class of microcontrollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mcu {
    /// As on the command line: `cortex-m4f`.
    pub name: &'static str,
    /// \[Hz\] a usual clock.
    pub clock: f64,
    /// \[1\] Cycles per instruction, an estimate.
    pub cycles: f64,
    /// Basis of the factors.
    pub basis: &'static str,
}

/// All of them.
pub const MCUS: [Mcu; 6] = [
    Mcu {
        name: "cortex-m0plus",
        clock: 64e6,
        cycles: 1.4,
        basis: "counted: thumbv6m, all real numbers by software",
    },
    Mcu {
        name: "cortex-m4f",
        clock: 168e6,
        cycles: 1.5,
        basis: "counted: single precision in hardware, double by software",
    },
    Mcu {
        name: "cortex-m7",
        clock: 480e6,
        cycles: 1.0,
        basis: "counts of Cortex-M4F: single precision in hardware",
    },
    Mcu {
        name: "cortex-m7-double",
        clock: 480e6,
        cycles: 1.0,
        basis: "counted: single and double precision in hardware",
    },
    Mcu {
        name: "cortex-m33",
        clock: 160e6,
        cycles: 1.4,
        basis: "counted: single precision in hardware, double by software",
    },
    Mcu {
        name: "rv32imafc",
        clock: 144e6,
        cycles: 1.4,
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
        self.factor(precision).map(|factor| factor * on_m4f)
    }

    /// \[1\] Instructions of a step over those of a Cortex-M4F, the geometric mean of the counted scenes; `None` for a
    /// precision that firmware does not support. Classes without counts run the instructions of a Cortex-M4F.
    #[must_use]
    pub fn factor(&self, precision: PrecisionName) -> Option<f64> {
        if precision == PrecisionName::F32Micromath {
            return None;
        }
        let ratios = ratios(self.name, precision.name());
        let logarithms: f64 = ratios.iter().map(|ratio| libm::log(*ratio)).sum();
        Some(libm::exp(logarithms / ratios.len().max(1) as f64))
    }
}

/// Instructions of each counted scene over those on a Cortex-M4F.
///
/// # Panics
/// Never: a test reads the table.
fn ratios(mcu: &str, precision: &str) -> Vec<f64> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(TABLE.as_bytes());
    let rows: Vec<Row> = reader.deserialize().collect::<Result<_, _>>().expect("a test reads it");
    let of = |mcu: &str| {
        let with = |row: &&Row| row.mcu == mcu && row.precision == precision;
        rows.iter().filter(with).collect::<Vec<_>>()
    };
    let counted = of(COUNTED);
    let ratio = |row: &&Row| {
        let other = counted.iter().find(|other| other.scene == row.scene)?;
        Some(row.instructions_mean / other.instructions_mean)
    };
    of(mcu).iter().filter_map(ratio).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One factor stands for all scenes.
    #[test]
    fn scenes_are_alike_on_every_core() {
        for mcu in MCUS {
            for precision in [PrecisionName::F32, PrecisionName::Fixed, PrecisionName::F64] {
                let factor = mcu.factor(precision).unwrap();
                let ratios = ratios(mcu.name, precision.name());
                assert!(ratios.len() >= 4 || mcu.name == "cortex-m7" && factor == 1.0);
                for ratio in ratios {
                    let off = ratio / factor - 1.0;
                    assert!(off.abs() < 0.2, "{} {precision:?} {off:+.2}", mcu.name);
                }
            }
            assert_eq!(mcu.factor(PrecisionName::F32Micromath), None);
        }
    }
}
