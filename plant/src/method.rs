//! Methods: a scheme with its parameters, damping, precision and way of storing orientations.
//!
//! `(scheme, newton, damping, precision, orientation) => method`. Where the names become the
//! kernel's types is [`plant`](mod@crate::plant). A further scheme or precision is one variant here
//! and one arm there.

use dbd_kernel::damping::Damping;
use dbd_kernel::real::Constant;
use dbd_kernel::schemes::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, GeneralizedAlpha, JointWise, Leapfrog, Pefrl,
    RhoError, Rk4, Scheme, SemiImplicitEuler,
};
use miette::Diagnostic;
use thiserror::Error;

use crate::names::{DampingName, Named as _, OrientationName, PrecisionName, SchemeName};

/// Newton iterations that may be asked for: more change nothing but the stable step.
pub const MOST_ITERATIONS: u32 = 8;

/// The largest ρ∞ that may be asked for.
pub const MOST_RHO: f64 = GeneralizedAlpha::MOST_RHO;

/// A scheme with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SchemeChoice {
    Dbd(Dbd),
    DbdP1(DbdP1),
    DbdP2(DbdP2),
    SemiImplicitEuler(SemiImplicitEuler),
    ExplicitSemiImplicitEuler(Explicit<SemiImplicitEuler>),
    JointWiseSemiImplicitEuler(JointWise<SemiImplicitEuler>),
    Leapfrog(Leapfrog),
    ExplicitLeapfrog(Explicit<Leapfrog>),
    JointWiseLeapfrog(JointWise<Leapfrog>),
    Pefrl(Pefrl),
    BlanesMoanS6(BlanesMoanS6),
    Rk4(Rk4),
    GeneralizedAlpha(GeneralizedAlpha),
}

/// A scheme with its parameters, in a precision, with a way of storing orientations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    pub(crate) scheme: SchemeChoice,
    precision: PrecisionName,
    orientation: OrientationName,
}

/// Why there is no such method.
#[derive(Clone, Copy, Debug, PartialEq, Error, Diagnostic)]
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
    /// ρ∞ for a scheme without it.
    #[error("the scheme {scheme} has no rho")]
    #[diagnostic(help("--rho goes with --scheme generalized-alpha; leave it out for {scheme}"))]
    NoRho {
        /// The scheme's name.
        scheme: &'static str,
    },
    /// ρ∞ beyond what it may be.
    #[error("{0}")]
    #[diagnostic(help("--rho 0 damps most, --rho {most} least; 0.5 where nothing is said", most = GeneralizedAlpha::MOST_RHO))]
    Rho(RhoError),
    /// A damping that the scheme has not.
    #[error("the scheme {scheme} has no {asked} damping, only {own}")]
    #[diagnostic(help(
        "leapfrog and semi-implicit-euler have sweeps, joint-wise and explicit; leave --damping out for {scheme}"
    ))]
    Damping {
        /// The scheme's name.
        scheme: &'static str,
        /// What was asked for.
        asked: &'static str,
        /// What it has.
        own: &'static str,
    },
    /// A method for comparison, in a build without the feature `comparison`.
    #[error("{what} is there for comparison only, and not part of this build")]
    #[diagnostic(help(
        "cargo run --release --features comparison -- …; or --precision f64 or f32, --orientation \
         quaternion"
    ))]
    Comparison {
        /// The precision or the way of storing orientations.
        what: &'static str,
    },
    /// A way of storing orientations that a precision has not.
    #[error("{precision} has no orientations as {orientation}")]
    #[diagnostic(help(
        "it stores quaternions of its own: leave --orientation out, or --precision f64 or f32"
    ))]
    Orientation {
        /// The precision's name.
        precision: &'static str,
        /// The way of storing orientations.
        orientation: &'static str,
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
            SchemeName::GeneralizedAlpha => {
                SchemeChoice::GeneralizedAlpha(GeneralizedAlpha::default())
            }
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
            (
                SchemeChoice::Leapfrog(_)
                | SchemeChoice::ExplicitLeapfrog(_)
                | SchemeChoice::JointWiseLeapfrog(_),
                damping,
            ) => match damping {
                DampingName::Sweeps => SchemeChoice::Leapfrog(Leapfrog),
                DampingName::JointWise => SchemeChoice::JointWiseLeapfrog(JointWise(Leapfrog)),
                DampingName::Explicit => SchemeChoice::ExplicitLeapfrog(Explicit(Leapfrog)),
                DampingName::Implicit => self.scheme,
            },
            (
                SchemeChoice::SemiImplicitEuler(_)
                | SchemeChoice::ExplicitSemiImplicitEuler(_)
                | SchemeChoice::JointWiseSemiImplicitEuler(_),
                damping,
            ) => match damping {
                DampingName::Sweeps => SchemeChoice::SemiImplicitEuler(SemiImplicitEuler),
                DampingName::JointWise => {
                    SchemeChoice::JointWiseSemiImplicitEuler(JointWise(SemiImplicitEuler))
                }
                DampingName::Explicit => {
                    SchemeChoice::ExplicitSemiImplicitEuler(Explicit(SemiImplicitEuler))
                }
                DampingName::Implicit => self.scheme,
            },
            (scheme, _) => scheme,
        };
        let method = Self { scheme, ..self };
        let asked = match damping {
            DampingName::Sweeps => Damping::Sweeps,
            DampingName::JointWise => Damping::JointWise,
            DampingName::Explicit => Damping::Explicit,
            DampingName::Implicit => Damping::Implicit,
        };
        if method.damping() == asked {
            Ok(method)
        } else {
            let (scheme, own) = (method.scheme_name(), method.damping().name());
            Err(MethodError::Damping { scheme, asked: asked.name(), own })
        }
    }

    /// The same method with another ρ∞, from 0 to 0.8: what is left per step of a vibration that the step does
    /// not resolve.
    ///
    /// # Errors
    /// [`MethodError::NoRho`] where the scheme has none, [`MethodError::Rho`].
    pub fn with_rho(self, rho: f64) -> Result<Self, MethodError> {
        let SchemeChoice::GeneralizedAlpha(_) = self.scheme else {
            return Err(MethodError::NoRho { scheme: self.scheme_name() });
        };
        let scheme = GeneralizedAlpha::new(rho).map_err(MethodError::Rho)?;
        Ok(Self { scheme: SchemeChoice::GeneralizedAlpha(scheme), ..self })
    }

    /// ρ∞, `None` for a scheme without it.
    #[must_use]
    pub fn rho(&self) -> Option<f64> {
        match self.scheme {
            SchemeChoice::GeneralizedAlpha(scheme) => Some(scheme.rho()),
            _ => None,
        }
    }

    /// The same method with another way of storing orientations.
    #[must_use]
    pub fn with_orientation(self, orientation: OrientationName) -> Self {
        Self { orientation, ..self }
    }

    /// The same method in another precision.
    #[must_use]
    pub fn with_precision(self, precision: PrecisionName) -> Self {
        Self { precision, ..self }
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

    /// How it stores orientations.
    #[must_use]
    pub fn orientation(&self) -> OrientationName {
        self.orientation
    }

    /// Whether this build holds it: compensated sums, micromath and Euler angles take the feature
    /// `comparison`.
    ///
    /// # Errors
    /// [`MethodError::Comparison`] where it does not, [`MethodError::Orientation`] where no build does.
    pub fn check_built(&self) -> Result<(), MethodError> {
        let quaternions = self.orientation == OrientationName::Quaternion;
        let aside =
            matches!(self.precision, PrecisionName::F32Compensated | PrecisionName::F32Micromath);
        let exists = quaternions || self.precision.is_plain();
        if (quaternions && !aside) || (exists && cfg!(all(feature = "comparison", not(test)))) {
            Ok(())
        } else {
            Err(self.not_built())
        }
    }

    /// The refusal of a method that this build does not hold.
    pub(crate) fn not_built(&self) -> MethodError {
        let quaternions = self.orientation == OrientationName::Quaternion;
        let what = match self.precision {
            precision if !precision.is_plain() && !quaternions => {
                let (precision, orientation) = (self.precision.name(), self.orientation.name());
                return MethodError::Orientation { precision, orientation };
            }
            PrecisionName::F32Compensated | PrecisionName::F32Micromath => self.precision.name(),
            _ => self.orientation.name(),
        };
        MethodError::Comparison { what }
    }

    /// What the scheme says of itself.
    fn traits(&self) -> Traits {
        match self.scheme {
            SchemeChoice::Dbd(scheme) => Traits::of(scheme),
            SchemeChoice::DbdP1(scheme) => Traits::of(scheme),
            SchemeChoice::DbdP2(scheme) => Traits::of(scheme),
            SchemeChoice::SemiImplicitEuler(scheme) => Traits::of(scheme),
            SchemeChoice::ExplicitSemiImplicitEuler(scheme) => Traits::of(scheme),
            SchemeChoice::JointWiseSemiImplicitEuler(scheme) => Traits::of(scheme),
            SchemeChoice::Leapfrog(scheme) => Traits::of(scheme),
            SchemeChoice::ExplicitLeapfrog(scheme) => Traits::of(scheme),
            SchemeChoice::JointWiseLeapfrog(scheme) => Traits::of(scheme),
            SchemeChoice::Pefrl(scheme) => Traits::of(scheme),
            SchemeChoice::BlanesMoanS6(scheme) => Traits::of(scheme),
            SchemeChoice::Rk4(scheme) => Traits::of(scheme),
            SchemeChoice::GeneralizedAlpha(scheme) => Traits::of(scheme),
        }
    }

    /// How its dampers act.
    #[must_use]
    pub fn damping(&self) -> Damping {
        self.traits().damping
    }

    /// How its dampers act, where that is not the scheme's own way.
    #[must_use]
    pub fn foreign_damping(&self) -> Option<Damping> {
        let foreign = matches!(
            self.scheme,
            SchemeChoice::ExplicitLeapfrog(_)
                | SchemeChoice::ExplicitSemiImplicitEuler(_)
                | SchemeChoice::JointWiseLeapfrog(_)
                | SchemeChoice::JointWiseSemiImplicitEuler(_)
        );
        foreign.then(|| self.damping())
    }

    /// Largest stable `ω_max·h` of an undamped oscillator.
    #[must_use]
    pub fn stability_limit(&self) -> f64 {
        self.traits().stability_limit
    }

    /// The largest `ω·h` that it bears with the bound of the highest frequency, where its matrix limits it.
    #[must_use]
    pub fn most_vibration(&self) -> Option<f64> {
        let most = self.traits().most_vibration?;
        Some(if self.precision == PrecisionName::F64 {
            most.double
        } else {
            f64::from(most.single)
        })
    }

    /// The scheme's name, e.g. `leapfrog`.
    #[must_use]
    pub fn scheme_name(&self) -> &'static str {
        self.traits().name
    }

    /// The precision's name, e.g. `f64`.
    #[must_use]
    pub fn precision_name(&self) -> &'static str {
        self.precision.name()
    }

    /// How orientations are stored, e.g. `quaternion`.
    #[must_use]
    pub fn orientation_name(&self) -> &'static str {
        self.orientation.name()
    }

    /// \[s\] the step rounded to the precision.
    #[must_use]
    pub fn rounded(&self, step: f64) -> f64 {
        match self.precision {
            PrecisionName::F64 => step,
            _ => f64::from(step as f32),
        }
    }

    /// The order of its error, without dampers and with them.
    #[must_use]
    pub fn orders(&self) -> [u32; 2] {
        self.traits().orders
    }

    /// Force evaluations per step.
    #[must_use]
    pub fn evaluations(&self) -> u32 {
        self.traits().evaluations
    }
}

impl Default for Method {
    /// Leapfrog in double precision.
    fn default() -> Self {
        let scheme = SchemeChoice::Leapfrog(Leapfrog);
        let (precision, orientation) = (PrecisionName::default(), OrientationName::default());
        Self { scheme, precision, orientation }
    }
}

/// What a scheme says of itself.
struct Traits {
    name: &'static str,
    damping: Damping,
    orders: [u32; 2],
    stability_limit: f64,
    most_vibration: Option<Constant>,
    evaluations: u32,
}

impl Traits {
    fn of<S: Scheme>(scheme: S) -> Self {
        Self {
            name: S::NAME,
            damping: S::DAMPING,
            orders: [S::ORDER, S::ORDER_DAMPED],
            most_vibration: S::MOST_VIBRATION,
            stability_limit: scheme.stability_limit(),
            evaluations: scheme.evaluations(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_those_of_the_kernel() {
        for scheme in SchemeName::ALL {
            let method = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            assert_eq!(method.scheme_name(), scheme.name());
            assert_eq!(SchemeName::of_name(scheme.name()), Some(*scheme));
        }
        assert_eq!(SchemeName::of_name("euler"), None);
        assert_eq!(
            Method::default(),
            Method::new(SchemeName::default(), None, PrecisionName::F64).unwrap()
        );
        assert_eq!(
            DampingName::Explicit.summary(),
            "Forces at the velocities of each evaluation: limit the step"
        );
    }

    #[test]
    fn what_is_for_comparison_is_refused_with_its_remedy_where_it_is_not_built() {
        let built = cfg!(all(feature = "comparison", not(test)));
        for precision in PrecisionName::ALL {
            for orientation in OrientationName::ALL {
                let method = Method::new(SchemeName::Rk4, None, *precision).unwrap();
                let method = method.with_orientation(*orientation);
                let quaternions = *orientation == OrientationName::Quaternion;
                let aside = [PrecisionName::F32Compensated, PrecisionName::F32Micromath]
                    .contains(precision);
                let exists = quaternions || precision.is_plain();
                let held = if built { exists } else { quaternions && !aside };
                assert_eq!(method.check_built().is_ok(), held, "{method:?}");
                let refused = matches!(method.check_built(), Err(MethodError::Orientation { .. }));
                assert_eq!(refused, !exists, "{method:?}");
            }
        }
        let help = MethodError::Comparison { what: "euler-321" }.help().unwrap().to_string();
        assert!(help.contains("--features comparison"), "{help}");
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
        for scheme in SchemeName::ALL {
            let method = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            if method.newton().is_none() {
                let refused = Method::new(*scheme, Some(0), PrecisionName::F64);
                assert_eq!(refused, Err(MethodError::Newton { scheme: method.scheme_name() }));
            }
        }
    }

    #[test]
    fn a_scheme_has_its_own_damping_and_two_have_all_but_implicit() {
        let several = ["semi-implicit-euler", "leapfrog"];
        for scheme in SchemeName::ALL {
            let own = Method::new(*scheme, None, PrecisionName::F64).unwrap();
            for damping in DampingName::ALL {
                let name = damping.name();
                match own.with_damping(*damping) {
                    Ok(method) => {
                        assert_eq!(method.damping().name(), name);
                        assert_eq!(method.scheme_name(), own.scheme_name());
                        assert!(method == own || several.contains(&own.scheme_name()));
                    }
                    Err(refused) => {
                        let implicit = *damping == DampingName::Implicit;
                        assert!(implicit || !several.contains(&own.scheme_name()));
                        let text = refused.to_string();
                        assert!(text.contains(name) && text.contains(own.damping().name()));
                    }
                }
            }
        }
    }
}
