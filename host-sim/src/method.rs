//! Scheme and precision by name, and the way from the names to the kernel's types.
//!
//! `(scheme, newton, precision) => method; method, visitor => the visitor's generic function`.
//! A further scheme or precision is one variant and one arm here, nothing elsewhere.

use clap::ValueEnum;
use dbd_kernel::{Dbd, F32, F64, Geometry, Leapfrog, Real as _, Scheme};
use miette::Diagnostic;
use thiserror::Error;

/// The schemes by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SchemeName {
    /// The paper's step: first order, three evaluations, one more per Newton iteration.
    Dbd,
    /// Kick–drift–kick: second order, one evaluation, no energy drift.
    #[default]
    Leapfrog,
}

/// The precisions by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum PrecisionName {
    /// Double precision.
    #[default]
    F64,
    /// Single precision.
    F32,
}

/// A scheme with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SchemeChoice {
    Dbd(Dbd),
    Leapfrog(Leapfrog),
}

/// A scheme with its parameters, in a precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    scheme: SchemeChoice,
    precision: PrecisionName,
}

/// Why there is no such method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error, Diagnostic)]
pub enum MethodError {
    /// Newton iterations for a scheme without any.
    #[error("the scheme {scheme} has no Newton iterations")]
    #[diagnostic(help("--newton goes with --scheme dbd; leave it out for {scheme}"))]
    Newton {
        /// The scheme's name.
        scheme: &'static str,
    },
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
    /// schemes that have them.
    ///
    /// # Errors
    /// [`MethodError::Newton`] where the scheme has none.
    pub fn new(
        scheme: SchemeName,
        newton: Option<u32>,
        precision: PrecisionName,
    ) -> Result<Self, MethodError> {
        let scheme = match (scheme, newton) {
            (SchemeName::Dbd, newton) => SchemeChoice::Dbd(Dbd { newton: newton.unwrap_or(0) }),
            (SchemeName::Leapfrog, None) => SchemeChoice::Leapfrog(Leapfrog),
            (SchemeName::Leapfrog, Some(_)) => {
                return Err(MethodError::Newton { scheme: Leapfrog::NAME });
            }
        };
        Ok(Self { scheme, precision })
    }

    /// Newton iterations per step, `None` for a scheme without any.
    #[must_use]
    pub fn newton(&self) -> Option<u32> {
        match self.scheme {
            SchemeChoice::Dbd(dbd) => Some(dbd.newton),
            SchemeChoice::Leapfrog(_) => None,
        }
    }

    /// Calls the visitor with the kernel's types.
    pub fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
        match self.precision {
            PrecisionName::F64 => self.visit_in::<F64, V>(visitor),
            PrecisionName::F32 => self.visit_in::<F32, V>(visitor),
        }
    }

    fn visit_in<P: Geometry, V: MethodVisitor>(&self, visitor: V) -> V::Output {
        match self.scheme {
            SchemeChoice::Dbd(scheme) => visitor.visit::<P, _>(scheme),
            SchemeChoice::Leapfrog(scheme) => visitor.visit::<P, _>(scheme),
        }
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
                assert_eq!(precision.as_deref(), Some(method.precision_name()));
            }
        }
    }

    #[test]
    fn newton_iterations_belong_to_dbd() {
        let method = Method::new(SchemeName::Dbd, Some(2), PrecisionName::F64).unwrap();
        assert_eq!((method.newton(), method.evaluations()), (Some(2), 5));
        let refused = Method::new(SchemeName::Leapfrog, Some(0), PrecisionName::F64);
        assert_eq!(refused, Err(MethodError::Newton { scheme: "leapfrog" }));
    }
}
