//! Scheme, damping, precision and orientation by name.
//!
//! `name => choice; choice => name, what it is`. The documentation of a choice is what users read of
//! it, too.

/// A choice by name.
pub trait Named: Copy + PartialEq + 'static {
    /// All of them, in the order in which they are listed.
    const ALL: &'static [Self];

    /// What users call it, also in summaries and tables.
    fn name(self) -> &'static str;

    /// What it is, in one sentence without a full stop.
    fn summary(self) -> &'static str;

    /// The choice of a name; `None` where nothing is called so.
    #[must_use]
    fn of_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|choice| choice.name() == name)
    }
}

/// An enumeration whose variants have names, and whose documentation users read, too.
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
    /// The schemes by name; leapfrog where nothing is said.
    #[derive(Default)]
    SchemeName {
        /// The paper's step: order 1, three evaluations, one more per Newton iteration.
        Dbd = "dbd",
        /// The same with predicted positions: order 1, two evaluations, dissipates.
        DbdP1 = "dbd-p1",
        /// The same with corrected positions, too: order 1, three evaluations, dissipates.
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
        /// One linear solve: order 2, any stiffness, damps what the step does not resolve.
        GeneralizedAlpha = "generalized-alpha",
        /// The same extrapolated: order 3, three linear solves, any stiffness.
        GeneralizedAlpha3 = "generalized-alpha-3",
    }
}

named! {
    /// The ways of damping by name.
    DampingName {
        /// Pairwise impulses that know of the kick before them: no limit of the step.
        Sweeps = "sweeps",
        /// As sweeps at about half their cost, a joint's dampers as they stand at the start.
        JointWise = "joint-wise",
        /// Forces at the velocities of each evaluation: limit the step.
        Explicit = "explicit",
        /// Part of the linear solve of generalized-alpha: no limit of the step.
        Implicit = "implicit",
    }
}

named! {
    /// The precisions by name; double where nothing is said.
    #[derive(Default)]
    PrecisionName {
        /// Double precision.
        #[default]
        F64 = "f64",
        /// Single precision.
        F32 = "f32",
        /// Single precision with positions and orientations in fixed point: nearly what double has.
        Fixed = "fixed",
        /// Single precision with micromath's square root: what fast and loose costs.
        F32Micromath = "f32-micromath",
    }
}

named! {
    /// The ways of storing an orientation by name; quaternions where nothing is said.
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
    /// Whether what it stores of a body is one number per component, as columns of a trace show it.
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
        let summary = "Forces at the velocities of each evaluation: limit the step";
        assert_eq!(DampingName::Explicit.summary(), summary);
    }
}
