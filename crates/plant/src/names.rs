//! Scheme, damping, precision and orientation by name.
//!
//! `name => choice; choice => name, summary`. The documentation of a choice is also its summary for users.

/// A choice by name.
pub trait Named: Copy + PartialEq + 'static {
    /// All of them, in the order in which they are listed.
    const ALL: &'static [Self];

    /// Its name for users, also in summaries and tables.
    fn name(self) -> &'static str;

    /// Summary in one sentence without a full stop.
    fn summary(self) -> &'static str;

    /// The choice of a name; `None` if unknown.
    #[must_use]
    fn of_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|choice| choice.name() == name)
    }
}

/// An enumeration with named variants whose documentation is shown to users.
macro_rules! named {
    (
        $(#[$outer:meta])*
        $choice:ident {
            $(#[doc = $summary:literal] $(#[$default:meta])? $variant:ident = $name:literal,)*
        }
    ) => {
        $(#[$outer])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $choice {
            $(#[doc = $summary] $(#[$default])? $variant,)*
        }

        impl Named for $choice {
            const ALL: &'static [Self] = &[$(Self::$variant,)*];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            fn summary(self) -> &'static str {
                let text = match self {
                    $(Self::$variant => $summary,)*
                };
                text.trim().trim_end_matches('.')
            }
        }
    };
}

named! {
    /// Schemes by name; the default is leapfrog.
    #[derive(Default)]
    SchemeName {
        /// The paper's scheme: order 1, three evaluations, one more per Newton iteration.
        Dbd = "dbd",
        /// dbd with predicted positions: order 1, two evaluations, dissipates.
        DbdP1 = "dbd-p1",
        /// dbd with predicted and corrected positions: order 1, three evaluations, dissipates.
        DbdP2 = "dbd-p2",
        /// Kick, then drift: order 1, one evaluation, no energy drift.
        SemiImplicitEuler = "semi-implicit-euler",
        /// Kick–drift–kick: order 2, one evaluation, no energy drift.
        #[default]
        Leapfrog = "leapfrog",
        /// Omelyan, Mryglod & Folk: order 4, four evaluations, no energy drift.
        Pefrl = "pefrl",
        /// Blanes & Moan: order 4, six evaluations, no energy drift.
        BlanesMoanS6 = "blanes-moan-s6",
        /// Classical Runge–Kutta: order 4, four evaluations, dissipates.
        Rk4 = "rk4",
        /// One linear solve: order 2, any stiffness, damps frequencies that the step does not resolve.
        GeneralizedAlpha = "generalized-alpha",
        /// generalized-alpha extrapolated: order 3, three linear solves, any stiffness.
        GeneralizedAlpha3 = "generalized-alpha-3",
    }
}

named! {
    /// Damping modes by name.
    DampingName {
        /// Pairwise implicit impulses that include the preceding force impulse: no step limit.
        Sweeps = "sweeps",
        /// Like sweeps at about half the cost, with each joint's dampers as at the start of the step.
        JointWise = "joint-wise",
        /// Damper forces at the velocities of each evaluation: limits the step.
        Explicit = "explicit",
        /// Part of the linear solve of generalized-alpha: no step limit.
        Implicit = "implicit",
    }
}

named! {
    /// Precisions by name; the default is double.
    #[derive(Default)]
    PrecisionName {
        /// Double precision.
        #[default]
        F64 = "f64",
        /// Single precision.
        F32 = "f32",
        /// Single precision with positions and orientations in fixed point: accuracy close to double.
        Fixed = "fixed",
        /// Single precision with micromath's approximate square root, for comparison.
        F32Micromath = "f32-micromath",
    }
}

named! {
    /// Orientation representations by name; the default is quaternions.
    #[derive(Default)]
    OrientationName {
        /// Unit quaternions.
        #[default]
        Quaternion = "quaternion",
        /// The paper's yaw, pitch, roll, with a second sequence near the pole.
        Euler321 = "euler-321",
    }
}

impl PrecisionName {
    /// Whether it stores one number per component of a body, as in the columns of a trace.
    #[must_use]
    pub fn is_plain(self) -> bool {
        self != Self::Fixed
    }

    /// Whether orientations can be stored as Euler angles, too.
    #[must_use]
    pub fn has_angles(self) -> bool {
        matches!(self, Self::F64 | Self::F32)
    }

    /// Whether sums on a state are rounded to single precision.
    #[must_use]
    pub fn is_single(self) -> bool {
        matches!(self, Self::F32 | Self::F32Micromath)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_is_found_by_its_name_and_described_in_a_sentence() {
        for scheme in SchemeName::ALL {
            assert_eq!(SchemeName::of_name(scheme.name()), Some(*scheme));
        }
        assert_eq!(SchemeName::of_name("euler"), None);
        let summary = "Damper forces at the velocities of each evaluation: limits the step";
        assert_eq!(DampingName::Explicit.summary(), summary);
    }
}
