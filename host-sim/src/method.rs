//! Scheme, damping, precision and orientation by name, and the way from the names to the kernel's
//! types.
//!
//! `(scheme, newton, damping, precision, orientation) => method; method, visitor => the visitor's
//! generic function`. A further scheme or precision is one variant and its arms here, nothing elsewhere.

use clap::ValueEnum;
use dbd_kernel::damping::Damping;
use dbd_kernel::euler::{EulerF32, EulerF64, SingleEulerF32, SingleEulerF64};
use dbd_kernel::loose::{Loose32, LooseEuler32, LooseSingleEuler32};
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, F32, F64, Geometry, Leapfrog, Pefrl, Real as _, Rk4,
    Scheme, SemiImplicitEuler,
};
use miette::Diagnostic;
use thiserror::Error;

/// Newton iterations that may be asked for: more change nothing but the stable step.
pub const MOST_ITERATIONS: u32 = 8;

/// The schemes by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SchemeName {
    /// The paper's step: order 1, three evaluations, one more per Newton iteration.
    Dbd,
    /// The same with predicted positions: order 1, two evaluations, dissipates.
    DbdP1,
    /// The same with corrected positions, too: order 1, three evaluations, dissipates.
    DbdP2,
    /// Kick, then drift: order 1, one evaluation, no energy drift.
    SemiImplicitEuler,
    /// Kick–drift–kick: order 2, one evaluation, no energy drift.
    #[default]
    Leapfrog,
    /// Omelyan, Mryglod & Folk: order 4, four evaluations, no energy drift.
    Pefrl,
    /// Blanes & Moan: order 4, six evaluations, no energy drift.
    BlanesMoanS6,
    /// Classical Runge–Kutta: order 4, four evaluations, dissipates.
    Rk4,
}

/// The ways of damping by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DampingName {
    /// Exact pairwise impulses before and after: no limit of the step.
    Sweeps,
    /// Forces at the velocities of each evaluation: limit the step.
    Explicit,
}

/// The precisions by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum PrecisionName {
    /// Double precision.
    #[default]
    F64,
    /// Single precision.
    F32,
    /// Single precision with micromath's square root, sine and cosine: what fast and loose costs.
    #[value(name = "f32-micromath")]
    F32Micromath,
}

/// The ways of storing an orientation by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum OrientationName {
    /// Unit quaternions.
    #[default]
    Quaternion,
    /// The paper's yaw, pitch, roll, with a second sequence near the pole.
    #[value(name = "euler-321")]
    Euler321,
    /// Yaw, pitch, roll alone: loses precision near a pitch of ±90°.
    #[value(name = "euler-321-single")]
    Euler321Single,
}

/// A scheme with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SchemeChoice {
    Dbd(Dbd),
    DbdP1(DbdP1),
    DbdP2(DbdP2),
    SemiImplicitEuler(SemiImplicitEuler),
    ExplicitSemiImplicitEuler(Explicit<SemiImplicitEuler>),
    Leapfrog(Leapfrog),
    ExplicitLeapfrog(Explicit<Leapfrog>),
    Pefrl(Pefrl),
    BlanesMoanS6(BlanesMoanS6),
    Rk4(Rk4),
}

/// A scheme with its parameters, in a precision, with a way of storing orientations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    scheme: SchemeChoice,
    precision: PrecisionName,
    orientation: OrientationName,
}

/// Why there is no such method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error, Diagnostic)]
pub enum MethodError {
    /// Newton iterations for a scheme without any.
    #[error("the scheme {scheme} has no Newton iterations")]
    #[diagnostic(help(
        "--newton goes with --scheme dbd, dbd-p1 or dbd-p2; leave it out for {scheme}"
    ))]
    Newton {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// More than [`MOST_ITERATIONS`].
    #[error("{newton} Newton iterations are more than {MOST_ITERATIONS}")]
    #[diagnostic(help("--newton 0 to --newton {MOST_ITERATIONS}; more of them buy nothing"))]
    Iterations {
        /// How many.
        newton: u32,
    },
    /// A damping that the scheme has not.
    #[error("the scheme {scheme} has no {asked} damping, only {}", other(asked))]
    #[diagnostic(help(
        "leapfrog and semi-implicit-euler have both; leave --damping out for {scheme}"
    ))]
    Damping {
        /// The scheme's name.
        scheme: &'static str,
        /// What was asked for.
        asked: &'static str,
    },
    /// A precision in which no pose is at rest.
    #[error("there is no stability to look at in {precision}: its square root is off by per cents")]
    #[diagnostic(help(
        "no frozen pose is at rest in it, nothing vibrates about one; --precision f64 or f32"
    ))]
    Restless {
        /// The precision's name.
        precision: &'static str,
    },
}

fn other(damping: &str) -> &'static str {
    if damping == Damping::Sweeps.name() {
        Damping::Explicit.name()
    } else {
        Damping::Sweeps.name()
    }
}

/// A function over scheme and precision.
pub trait MethodVisitor {
    /// What it returns.
    type Output;
    /// The function.
    fn visit<P: Geometry, S: Scheme>(self, scheme: S) -> Self::Output;
}

impl Method {
    /// A method from names and parameters; `newton` is the number of Newton iterations, for the
    /// schemes that have them. The damping is the scheme's own, orientations are quaternions.
    ///
    /// # Errors
    /// [`MethodError::Newton`] where the scheme has none, [`MethodError::Iterations`].
    pub fn new(
        scheme: SchemeName,
        newton: Option<u32>,
        precision: PrecisionName,
    ) -> Result<Self, MethodError> {
        let iterations = newton.unwrap_or(0);
        let scheme = match scheme {
            SchemeName::Dbd => SchemeChoice::Dbd(Dbd { newton: iterations }),
            SchemeName::DbdP1 => SchemeChoice::DbdP1(DbdP1 { newton: iterations }),
            SchemeName::DbdP2 => SchemeChoice::DbdP2(DbdP2 { newton: iterations }),
            SchemeName::SemiImplicitEuler => SchemeChoice::SemiImplicitEuler(SemiImplicitEuler),
            SchemeName::Leapfrog => SchemeChoice::Leapfrog(Leapfrog),
            SchemeName::Pefrl => SchemeChoice::Pefrl(Pefrl),
            SchemeName::BlanesMoanS6 => SchemeChoice::BlanesMoanS6(BlanesMoanS6),
            SchemeName::Rk4 => SchemeChoice::Rk4(Rk4),
        };
        let method = Self { scheme, precision, orientation: OrientationName::default() };
        if newton.is_some() && method.newton().is_none() {
            return Err(MethodError::Newton { scheme: method.scheme_name() });
        }
        if iterations > MOST_ITERATIONS {
            return Err(MethodError::Iterations { newton: iterations });
        }
        Ok(method)
    }

    /// The same method with another damping.
    ///
    /// # Errors
    /// [`MethodError::Damping`] where the scheme has no such one.
    pub fn with_damping(self, damping: DampingName) -> Result<Self, MethodError> {
        let scheme = match (self.scheme, damping) {
            (SchemeChoice::Leapfrog(_) | SchemeChoice::ExplicitLeapfrog(_), damping) => {
                match damping {
                    DampingName::Sweeps => SchemeChoice::Leapfrog(Leapfrog),
                    DampingName::Explicit => SchemeChoice::ExplicitLeapfrog(Explicit(Leapfrog)),
                }
            }
            (
                SchemeChoice::SemiImplicitEuler(_) | SchemeChoice::ExplicitSemiImplicitEuler(_),
                damping,
            ) => match damping {
                DampingName::Sweeps => SchemeChoice::SemiImplicitEuler(SemiImplicitEuler),
                DampingName::Explicit => {
                    SchemeChoice::ExplicitSemiImplicitEuler(Explicit(SemiImplicitEuler))
                }
            },
            (scheme, _) => scheme,
        };
        let method = Self { scheme, ..self };
        let asked = match damping {
            DampingName::Sweeps => Damping::Sweeps,
            DampingName::Explicit => Damping::Explicit,
        };
        if method.damping() == asked {
            Ok(method)
        } else {
            Err(MethodError::Damping { scheme: method.scheme_name(), asked: asked.name() })
        }
    }

    /// The same method with another way of storing orientations.
    #[must_use]
    pub fn with_orientation(self, orientation: OrientationName) -> Self {
        Self { orientation, ..self }
    }

    /// Its precision.
    #[must_use]
    pub fn precision(&self) -> PrecisionName {
        self.precision
    }

    /// Newton iterations per step, `None` for a scheme without any.
    #[must_use]
    pub fn newton(&self) -> Option<u32> {
        match self.scheme {
            SchemeChoice::Dbd(dbd) => Some(dbd.newton),
            SchemeChoice::DbdP1(dbd) => Some(dbd.newton),
            SchemeChoice::DbdP2(dbd) => Some(dbd.newton),
            _ => None,
        }
    }

    /// Calls the visitor with the kernel's types.
    pub fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
        use OrientationName::{Euler321, Euler321Single, Quaternion};
        match (self.precision, self.orientation) {
            (PrecisionName::F64, Quaternion) => self.visit_in::<F64, V>(visitor),
            (PrecisionName::F32, Quaternion) => self.visit_in::<F32, V>(visitor),
            (PrecisionName::F64, Euler321) => self.visit_in::<EulerF64, V>(visitor),
            (PrecisionName::F32, Euler321) => self.visit_in::<EulerF32, V>(visitor),
            (PrecisionName::F64, Euler321Single) => self.visit_in::<SingleEulerF64, V>(visitor),
            (PrecisionName::F32, Euler321Single) => self.visit_in::<SingleEulerF32, V>(visitor),
            (PrecisionName::F32Micromath, Quaternion) => self.visit_in::<Loose32, V>(visitor),
            (PrecisionName::F32Micromath, Euler321) => self.visit_in::<LooseEuler32, V>(visitor),
            (PrecisionName::F32Micromath, Euler321Single) => {
                self.visit_in::<LooseSingleEuler32, V>(visitor)
            }
        }
    }

    fn visit_in<P: Geometry, V: MethodVisitor>(&self, visitor: V) -> V::Output {
        match self.scheme {
            SchemeChoice::Dbd(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::DbdP1(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::DbdP2(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::SemiImplicitEuler(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::ExplicitSemiImplicitEuler(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::Leapfrog(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::ExplicitLeapfrog(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::Pefrl(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::BlanesMoanS6(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::Rk4(scheme) => visitor.visit::<P, _>(scheme),
        }
    }

    /// How its dampers act.
    #[must_use]
    pub fn damping(&self) -> Damping {
        struct Name;
        impl MethodVisitor for Name {
            type Output = Damping;
            fn visit<P: Geometry, S: Scheme>(self, _: S) -> Damping {
                S::DAMPING
            }
        }
        self.visit(Name)
    }

    /// How its dampers act, where that is not the scheme's own way.
    #[must_use]
    pub fn foreign_damping(&self) -> Option<Damping> {
        let foreign = matches!(
            self.scheme,
            SchemeChoice::ExplicitLeapfrog(_) | SchemeChoice::ExplicitSemiImplicitEuler(_)
        );
        foreign.then(|| self.damping())
    }

    /// Largest stable `ω_max·h` of an undamped oscillator.
    #[must_use]
    pub fn stability_limit(&self) -> f64 {
        struct Limit;
        impl MethodVisitor for Limit {
            type Output = f64;
            fn visit<P: Geometry, S: Scheme>(self, scheme: S) -> f64 {
                scheme.stability_limit()
            }
        }
        self.visit(Limit)
    }

    /// The scheme's name, e.g. `leapfrog`.
    #[must_use]
    pub fn scheme_name(&self) -> &'static str {
        struct Name;
        impl MethodVisitor for Name {
            type Output = &'static str;
            fn visit<P: Geometry, S: Scheme>(self, _: S) -> &'static str {
                S::NAME
            }
        }
        self.visit(Name)
    }

    /// The precision's name, e.g. `f64`.
    #[must_use]
    pub fn precision_name(&self) -> &'static str {
        struct Name;
        impl MethodVisitor for Name {
            type Output = &'static str;
            fn visit<P: Geometry, S: Scheme>(self, _: S) -> &'static str {
                P::NAME
            }
        }
        self.visit(Name)
    }

    /// How orientations are stored, e.g. `quaternion`.
    #[must_use]
    pub fn orientation_name(&self) -> &'static str {
        struct Name;
        impl MethodVisitor for Name {
            type Output = &'static str;
            fn visit<P: Geometry, S: Scheme>(self, _: S) -> &'static str {
                P::ORIENTATION
            }
        }
        self.visit(Name)
    }

    /// \[s\] the step rounded to the precision.
    #[must_use]
    pub fn rounded(&self, step: f64) -> f64 {
        struct Rounded(f64);
        impl MethodVisitor for Rounded {
            type Output = f64;
            fn visit<P: Geometry, S: Scheme>(self, _: S) -> f64 {
                P::Real::from_f64(self.0).to_f64()
            }
        }
        self.visit(Rounded(step))
    }

    /// Force evaluations per step.
    #[must_use]
    pub fn evaluations(&self) -> u32 {
        struct Evaluations;
        impl MethodVisitor for Evaluations {
            type Output = u32;
            fn visit<P: Geometry, S: Scheme>(self, scheme: S) -> u32 {
                scheme.evaluations()
            }
        }
        self.visit(Evaluations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_of_the_command_line_are_those_of_the_kernel() {
        for scheme in SchemeName::value_variants() {
            for precision in PrecisionName::value_variants() {
                let method = Method::new(*scheme, None, *precision).unwrap();
                let name = |value: Option<clap::builder::PossibleValue>| {
                    value.map(|value| value.get_name().to_owned())
                };
                assert_eq!(name(scheme.to_possible_value()).as_deref(), Some(method.scheme_name()));
                let precision = name(precision.to_possible_value());
                for orientation in OrientationName::value_variants() {
                    let method = method.with_orientation(*orientation);
                    let orientation = name(orientation.to_possible_value());
                    assert_eq!(precision.as_deref(), Some(method.precision_name()));
                    assert_eq!(orientation.as_deref(), Some(method.orientation_name()));
                }
            }
        }
    }

    #[test]
    fn newton_iterations_belong_to_the_dbd_schemes() {
        for (scheme, evaluations) in
            [(SchemeName::Dbd, 5), (SchemeName::DbdP1, 4), (SchemeName::DbdP2, 5)]
        {
            let method = Method::new(scheme, Some(2), PrecisionName::F64).unwrap();
            assert_eq!((method.newton(), method.evaluations()), (Some(2), evaluations));
            assert!(Method::new(scheme, Some(8), PrecisionName::F64).is_ok());
            let refused = Method::new(scheme, Some(9), PrecisionName::F64);
            assert_eq!(refused, Err(MethodError::Iterations { newton: 9 }));
        }
        for scheme in SchemeName::value_variants() {
            let method = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            if method.newton().is_none() {
                let refused = Method::new(*scheme, Some(0), PrecisionName::F64);
                assert_eq!(refused, Err(MethodError::Newton { scheme: method.scheme_name() }));
            }
        }
    }

    #[test]
    fn a_scheme_has_its_own_damping_and_two_have_both() {
        let both = ["semi-implicit-euler", "leapfrog"];
        for scheme in SchemeName::value_variants() {
            let own = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            for damping in DampingName::value_variants() {
                let name = damping.to_possible_value().unwrap().get_name().to_owned();
                match own.with_damping(*damping) {
                    Ok(method) => {
                        assert_eq!(method.damping().name(), name);
                        assert_eq!(method.scheme_name(), own.scheme_name());
                        assert!(method == own || both.contains(&own.scheme_name()));
                    }
                    Err(refused) => {
                        assert!(!both.contains(&own.scheme_name()));
                        let text = refused.to_string();
                        assert!(text.contains(&name) && text.contains(own.damping().name()));
                    }
                }
            }
        }
    }
}
