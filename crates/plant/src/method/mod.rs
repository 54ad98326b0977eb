//! Methods: a scheme with its parameters, damping, precision and orientation representation.
//!
//! `(scheme, newton, damping, precision, orientation) => method`. [`plant`](mod@crate::plant) maps them to the kernel's
//! types. A new scheme or precision is one variant here and one match arm there.

mod error;

pub use error::MethodError;

use dbd_kernel::damping::Damping;
use dbd_kernel::laws::Need;
use dbd_kernel::real::Constant;
use dbd_kernel::schemes::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, GeneralizedAlpha, GeneralizedAlpha3, JointWise,
    Leapfrog, Pefrl, Rk4, Scheme, SemiImplicitEuler,
};

use crate::names::{DampingName, Named as _, OrientationName, PrecisionName, SchemeName};

/// Maximum number of Newton iterations: more only change the stable step.
pub const MAX_ITERATIONS: u32 = 8;

/// The largest valid ρ∞.
pub const MAX_RHO: f64 = GeneralizedAlpha::MAX_RHO;

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
    GeneralizedAlpha3(GeneralizedAlpha3),
}

/// A scheme with its parameters, in a precision, with an orientation representation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    pub(crate) scheme: SchemeChoice,
    precision: PrecisionName,
    orientation: OrientationName,
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
            SchemeName::GeneralizedAlpha3 => SchemeChoice::GeneralizedAlpha3(GeneralizedAlpha3),
        };
        let method = Self { scheme, precision, orientation: OrientationName::default() };
        if newton.is_some() && method.newton().is_none() {
            return Err(MethodError::Newton { scheme: method.scheme_name() });
        }
        if iterations > MAX_ITERATIONS {
            return Err(MethodError::Iterations { newton: iterations });
        }
        Ok(method)
    }

    /// The same method with another damping.
    ///
    /// # Errors
    /// [`MethodError::Damping`] if the scheme does not support it.
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

    /// The same method with another ρ∞, from 0 to 0.8: the amplitude factor per step of an unresolved vibration.
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

    /// The same method with another orientation representation.
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

    /// Whether SIMD lanes step it: leapfrog in double or single precision.
    #[must_use]
    pub fn in_lanes(&self) -> bool {
        let compiled = [PrecisionName::F64, PrecisionName::F32];
        compiled.iter().any(|precision| *self == Self::default().with_precision(*precision))
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

    /// Its orientation representation.
    #[must_use]
    pub fn orientation(&self) -> OrientationName {
        self.orientation
    }

    /// Whether this build includes it: micromath and Euler angles require the feature `comparison`.
    ///
    /// # Errors
    /// [`MethodError::Comparison`] where it does not, [`MethodError::Orientation`] where no build does.
    pub fn check_built(&self) -> Result<(), MethodError> {
        let quaternions = self.orientation == OrientationName::Quaternion;
        let aside = self.precision == PrecisionName::F32Micromath;
        let exists = quaternions || self.precision.has_angles();
        if (quaternions && !aside) || (exists && cfg!(feature = "comparison")) {
            Ok(())
        } else {
            Err(self.not_built())
        }
    }

    /// Whether its precision supports interactions: those for comparison only do not.
    pub(crate) fn has_laws(&self) -> bool {
        let quaternions = self.orientation == OrientationName::Quaternion;
        quaternions && self.precision != PrecisionName::F32Micromath
    }

    /// [`Scheme::bears`].
    pub(crate) fn bears(&self, need: Need) -> bool {
        (self.traits().bears)(need)
    }

    /// Whether its scheme moves driven bodies.
    pub(crate) fn drives(&self) -> bool {
        self.traits().drives
    }

    /// The error of a method that this build does not include.
    pub(crate) fn not_built(&self) -> MethodError {
        let quaternions = self.orientation == OrientationName::Quaternion;
        let what = match self.precision {
            precision if !precision.has_angles() && !quaternions => {
                let (precision, orientation) = (self.precision.name(), self.orientation.name());
                return MethodError::Orientation { precision, orientation };
            }
            PrecisionName::F32Micromath => self.precision.name(),
            _ => self.orientation.name(),
        };
        MethodError::Comparison { what }
    }

    /// Properties of the scheme.
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
            SchemeChoice::GeneralizedAlpha3(scheme) => Traits::of(scheme),
        }
    }

    /// Its damping mode.
    #[must_use]
    pub fn damping(&self) -> Damping {
        self.traits().damping
    }

    /// Its damping mode, if it is not the scheme's default.
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

    /// The largest `ω·h` for the bound of the highest frequency, if its matrix limits it.
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

    /// The orientation representation, e.g. `quaternion`.
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

/// Properties of a scheme.
struct Traits {
    name: &'static str,
    damping: Damping,
    orders: [u32; 2],
    stability_limit: f64,
    most_vibration: Option<Constant>,
    bears: fn(Need) -> bool,
    drives: bool,
    evaluations: u32,
}

impl Traits {
    fn of<S: Scheme>(scheme: S) -> Self {
        Self {
            name: S::NAME,
            damping: S::DAMPING,
            orders: [S::ORDER, S::ORDER_DAMPED],
            most_vibration: S::MAX_VIBRATION,
            bears: S::bears,
            drives: S::DRIVES,
            stability_limit: scheme.stability_limit(),
            evaluations: scheme.evaluations(),
        }
    }
}

#[cfg(test)]
mod tests;
