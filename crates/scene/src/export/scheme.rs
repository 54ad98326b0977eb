//! The kernel's schemes by name, as source.
//!
//! `(name, Newton iterations, damping) => type, value`. Names are the kernel's own.

use dbd_kernel::damping::Damping;
use dbd_kernel::keep::Storage as _;
use dbd_kernel::real::Constant;
use dbd_kernel::schemes::{
    BlanesMoanS6, Dbd, DbdP1, DbdP2, Explicit, GeneralizedAlpha, GeneralizedAlpha3, JointWise,
    Kicked, Leapfrog, Pefrl, Rk4, Scheme, SemiImplicitEuler,
};

use super::number::SourceNumber as _;
use super::precision::ExportPrecision;
use crate::default_step::Bears;
use crate::nearest::nearest;

/// Maximum number of Newton iterations: more only change the stable step.
pub const MAX_ITERATIONS: u32 = 8;

/// All names, for messages.
const NAMES: [&str; 10] = [
    Dbd::NAME,
    DbdP1::NAME,
    DbdP2::NAME,
    SemiImplicitEuler::NAME,
    Leapfrog::NAME,
    Pefrl::NAME,
    BlanesMoanS6::NAME,
    Rk4::NAME,
    GeneralizedAlpha::NAME,
    GeneralizedAlpha3::NAME,
];

/// A scheme with its parameters, as source.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportScheme {
    name: &'static str,
    damping: Damping,
    stability_limit: f64,
    /// Limit of its matrix, see [`Self::longest`].
    most_vibration: Option<Constant>,
    /// Whether its plants need a model with an elimination order.
    pub(super) has_matrix: bool,
    /// The type's path.
    pub(super) path: String,
    /// The value's expression.
    pub(super) value: String,
}

/// An invalid scheme or parameter.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct SchemeError {
    message: String,
    help: String,
}

impl SchemeError {
    /// The remedy.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.help
    }
}

impl ExportScheme {
    /// A scheme by its name, optionally with Newton iterations and a damping, `sweeps`, `joint-wise` or `explicit`,
    /// for schemes that support them.
    ///
    /// # Errors If the scheme is unknown or does not have the parameter.
    pub fn named(
        name: &str,
        newton: Option<u32>,
        damping: Option<&str>,
    ) -> Result<Self, SchemeError> {
        let refuse = |message: String, help: String| Err(SchemeError { message, help });
        let ways = [Damping::Sweeps, Damping::JointWise, Damping::Explicit, Damping::Implicit];
        let way = damping.and_then(|word| ways.into_iter().find(|way| way.name() == word));
        if let (Some(word), None) = (damping, way) {
            let names = ways.map(Damping::name);
            let help = format!("expected {} or {}", names[..3].join(", "), names[3]);
            return refuse(format!("unknown damping \"{word}\""), help);
        }
        let iterations = newton.unwrap_or(0);
        if iterations > MAX_ITERATIONS {
            let message =
                format!("{iterations} Newton iterations exceed the maximum of {MAX_ITERATIONS}");
            return refuse(message, format!("use at most {MAX_ITERATIONS}; more have no benefit"));
        }
        let wrapper = match way {
            Some(Damping::Explicit) => Some("Explicit"),
            Some(Damping::JointWise) => Some("JointWise"),
            Some(Damping::Sweeps | Damping::Implicit) | None => None,
        };
        let with_newton = |name: &str| format!("{name} {{ newton: {iterations} }}");
        let scheme = match name {
            Dbd::NAME => Self::of(Dbd { newton: iterations }, "Dbd", &with_newton("Dbd")),
            DbdP1::NAME => Self::of(DbdP1 { newton: iterations }, "DbdP1", &with_newton("DbdP1")),
            DbdP2::NAME => Self::of(DbdP2 { newton: iterations }, "DbdP2", &with_newton("DbdP2")),
            SemiImplicitEuler::NAME => match wrapper {
                Some(wrapper) => Self::wrapped(SemiImplicitEuler, "SemiImplicitEuler", wrapper),
                None => Self::plain(SemiImplicitEuler, "SemiImplicitEuler"),
            },
            Leapfrog::NAME => match wrapper {
                Some(wrapper) => Self::wrapped(Leapfrog, "Leapfrog", wrapper),
                None => Self::plain(Leapfrog, "Leapfrog"),
            },
            Pefrl::NAME => Self::plain(Pefrl, "Pefrl"),
            BlanesMoanS6::NAME => Self::plain(BlanesMoanS6, "BlanesMoanS6"),
            Rk4::NAME => Self::plain(Rk4, "Rk4"),
            GeneralizedAlpha::NAME => Self::solved(GeneralizedAlpha::DEFAULT),
            GeneralizedAlpha3::NAME => Self::plain(GeneralizedAlpha3, "GeneralizedAlpha3"),
            _ => {
                let meant = nearest(name, NAMES);
                let meant = meant.map(|name| format!("did you mean {name}? ")).unwrap_or_default();
                let help = format!("{meant}known schemes: {}", NAMES.join(", "));
                return refuse(format!("unknown scheme \"{name}\""), help);
            }
        };
        if newton.is_some() && !scheme.path.contains("Dbd") {
            let message = format!("the scheme {name} has no Newton iterations");
            return refuse(
                message,
                format!("only dbd, dbd-p1 and dbd-p2 have them; remove the option for {name}"),
            );
        }
        match damping {
            Some(word) if word != scheme.damping.name() => refuse(
                format!("the scheme {name} has no {word} damping, only {}", scheme.damping.name()),
                format!(
                    "leapfrog and semi-implicit-euler accept sweeps, joint-wise and explicit; remove it for {name}"
                ),
            ),
            _ => Ok(scheme),
        }
    }

    /// The same scheme with another ρ∞, for generalized-alpha.
    ///
    /// # Errors If the scheme has no ρ∞ or the value is out of range.
    pub fn with_rho(self, rho: f64) -> Result<Self, SchemeError> {
        let refuse = |message: String, help: &str| Err(SchemeError { message, help: help.into() });
        if self.name != GeneralizedAlpha::NAME {
            return refuse(
                format!("the scheme {} has no rho", self.name),
                "only generalized-alpha has it",
            );
        }
        match GeneralizedAlpha::new(rho) {
            Ok(scheme) => Ok(Self::solved(scheme)),
            Err(error) => refuse(error.to_string(), "the default is 0.5"),
        }
    }

    fn solved(scheme: GeneralizedAlpha) -> Self {
        let path = "GeneralizedAlpha";
        let scheme_of = Self::of(scheme, path, "GeneralizedAlpha::DEFAULT");
        if scheme == GeneralizedAlpha::DEFAULT {
            return scheme_of;
        }
        let rho = scheme.rho().number();
        let new = format!("{}::new({rho})", scheme_of.path);
        let value = format!("match {new} {{ Ok(scheme) => scheme, Err(_) => panic!() }}");
        Self { value, ..scheme_of }
    }

    fn plain<S: Scheme>(scheme: S, name: &str) -> Self {
        Self::of(scheme, name, name)
    }

    /// A scheme in one of the kernel's wrappers that change its damping.
    fn wrapped<S: Kicked>(scheme: S, name: &str, wrapper: &str) -> Self {
        let path = "dbd_kernel::";
        let ty = format!("{wrapper}<{path}{name}>");
        let value = format!("{wrapper}({path}{name})");
        if wrapper == "Explicit" {
            Self::of(Explicit(scheme), &ty, &value)
        } else {
            Self::of(JointWise(scheme), &ty, &value)
        }
    }

    fn of<S: Scheme>(scheme: S, path: &str, value: &str) -> Self {
        let within = |text: &str| format!("dbd_kernel::{text}");
        Self {
            name: S::NAME,
            damping: S::DAMPING,
            stability_limit: scheme.stability_limit(),
            most_vibration: S::MAX_VIBRATION,
            has_matrix: S::Storage::MATRIX,
            path: within(path),
            value: within(value),
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// \[s\] the longest step that its matrix allows in a precision; `highest` \[rad/s\] is the bound of the highest
    /// frequency; infinite without a matrix.
    #[must_use]
    pub fn longest(&self, precision: ExportPrecision, highest: f64) -> f64 {
        self.most_vibration(precision).map_or(f64::INFINITY, |most| most / highest)
    }

    fn most_vibration(&self, precision: ExportPrecision) -> Option<f64> {
        let Constant { double, single } = self.most_vibration?;
        Some(if precision == ExportPrecision::F64 { double } else { f64::from(single) })
    }

    /// Its limits in a precision.
    pub(crate) fn bears(&self, precision: ExportPrecision) -> Bears {
        Bears { stability: self.stability_limit, vibration: self.most_vibration(precision) }
    }

    /// Largest stable `ω_max·h` of an undamped oscillator.
    #[must_use]
    pub fn stability_limit(&self) -> f64 {
        self.stability_limit
    }
}

impl Default for ExportScheme {
    /// Leapfrog.
    fn default() -> Self {
        Self::plain(Leapfrog, "Leapfrog")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(name: &str, newton: Option<u32>, damping: Option<&str>) -> String {
        let error = ExportScheme::named(name, newton, damping).unwrap_err();
        format!("{error} ({})", error.help())
    }

    #[test]
    fn schemes_are_written_with_their_parameters() {
        let value = |name, newton, damping| {
            let scheme = ExportScheme::named(name, newton, damping).unwrap();
            (scheme.path, scheme.value)
        };
        let of = |path: &str, value: &str| (path.to_owned(), value.to_owned());
        assert_eq!(
            value("dbd", Some(2), None),
            of("dbd_kernel::Dbd", "dbd_kernel::Dbd { newton: 2 }")
        );
        assert_eq!(
            value("leapfrog", None, Some("explicit")),
            of(
                "dbd_kernel::Explicit<dbd_kernel::Leapfrog>",
                "dbd_kernel::Explicit(dbd_kernel::Leapfrog)"
            )
        );
        assert_eq!(
            value("semi-implicit-euler", None, Some("joint-wise")),
            of(
                "dbd_kernel::JointWise<dbd_kernel::SemiImplicitEuler>",
                "dbd_kernel::JointWise(dbd_kernel::SemiImplicitEuler)"
            )
        );
        for name in NAMES {
            assert_eq!(ExportScheme::named(name, None, None).unwrap().name(), name);
        }
        assert_eq!(ExportScheme::default(), ExportScheme::named("leapfrog", None, None).unwrap());
    }

    /// The value of a scheme with another ρ∞, or the error.
    fn value_of(scheme: Result<ExportScheme, SchemeError>, rho: f64) -> Result<String, String> {
        let scheme = scheme.and_then(|scheme| scheme.with_rho(rho));
        scheme.map(|scheme| scheme.value).map_err(|error| error.to_string())
    }

    #[test]
    fn what_there_is_not_is_refused_with_what_there_is() {
        let unknown = refused("leap-frog", None, None);
        assert!(unknown.contains("did you mean leapfrog?") && unknown.contains("blanes-moan-s6"));
        assert!(refused("rk4", Some(0), None).contains("no Newton iterations"));
        assert!(refused("dbd", Some(9), None).contains("at most 8"));
        assert!(refused("dbd", None, Some("sweeps")).contains("no sweeps damping"));
        let none = refused("dbd", None, Some("none"));
        assert!(none.contains("sweeps, joint-wise, explicit or implicit"), "{none}");
        assert!(refused("leapfrog", None, Some("implicit")).contains("no implicit damping"));
        let solved =
            |rho| value_of(ExportScheme::named("generalized-alpha", None, Some("implicit")), rho);
        let new = format!("match dbd_kernel::GeneralizedAlpha::new({})", 0.2.number());
        assert!(solved(0.2).unwrap().starts_with(&new));
        let own = "dbd_kernel::GeneralizedAlpha::DEFAULT";
        assert_eq!(solved(0.5).unwrap(), own);
        assert!(solved(0.9).unwrap_err().contains("from 0 to 0.8"));
        assert!(
            value_of(ExportScheme::named("rk4", None, None), 0.5).unwrap_err().contains("no rho")
        );
    }
}
