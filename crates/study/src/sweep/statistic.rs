//! Figures of a column of a trace over the samples of a run.
//!
//! `name => figure`. They are computed where the samples are.

/// A figure of a column over the samples of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The least value.
    Min,
    /// The largest value.
    Max,
    /// The root of the mean square.
    Rms,
    /// The value of the last sample.
    Final,
    /// \[s\] the time of the first sample with the largest value.
    TimeOfMax,
}

impl Statistic {
    /// All of them, in the order of the rows.
    pub const ALL: [Self; 5] = [Self::Min, Self::Max, Self::Rms, Self::Final, Self::TimeOfMax];

    /// Its name for users.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Min => "min",
            Self::Max => "max",
            Self::Rms => "rms",
            Self::Final => "final",
            Self::TimeOfMax => "time_of_max",
        }
    }
}
