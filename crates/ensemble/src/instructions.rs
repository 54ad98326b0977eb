//! Instruction sets of a machine.
//!
//! `machine => instruction set`.

/// An instruction set, which determines the number of instances in lockstep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// The baseline of every machine of its architecture: 2 instances in double precision, 4 in single.
    Baseline,
    /// AVX2 of x86-64: 4 and 8.
    Avx2,
    /// AVX-512 F and DQ of x86-64: 8 and 16.
    Avx512,
}

impl InstructionSet {
    /// All of them, the fewest lanes first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// Whether this machine supports it.
    #[must_use]
    pub fn is_there(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                std::is_x86_feature_detected!("avx512f")
                    && std::is_x86_feature_detected!("avx512dq")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The one with the most lanes that this machine supports.
    #[must_use]
    pub fn best() -> Self {
        Self::ALL.into_iter().rev().find(|set| set.is_there()).unwrap_or(Self::Baseline)
    }

    /// The user-visible name: `baseline`, `avx2`, `avx512`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}
