//! Varied quantities and their values.
//!
//! `(path, values) => target, values, values checked first`. A path leads to a value of the scene, as
//! that of `--set` does, or is one of the method's five names.

use std::ops::Range;

use dbd_plant::{
    DampingName, MAX_RHO, Method, MethodError, Named, OrientationName, PrecisionName, SchemeName,
};
use dbd_scene::nearest;

use crate::sweep::value::{Value, dimension};

/// Target of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A value of the scene.
    Scene,
    /// The scheme.
    Scheme,
    /// Its Newton iterations.
    Newton,
    /// Its ρ∞.
    Rho,
    /// How dampers act.
    Damping,
    /// The precision.
    Precision,
    /// How orientations are stored.
    Orientation,
}

/// Selects the scheme's default of Newton iterations, ρ∞ and damping.
pub const OWN: &str = "own";

impl Target {
    /// The names of a method's choices.
    pub const OF_METHOD: [(&'static str, Self); 6] = [
        ("scheme", Self::Scheme),
        ("newton", Self::Newton),
        ("rho", Self::Rho),
        ("damping", Self::Damping),
        ("precision", Self::Precision),
        ("orientation", Self::Orientation),
    ];

    /// The target of a path.
    #[must_use]
    pub fn of(path: &str) -> Self {
        let found = Self::OF_METHOD.iter().find(|(name, _)| *name == path);
        found.map_or(Self::Scene, |(_, target)| *target)
    }

    /// Expected values of a method's choice, and the closest one; `None` if the value is valid.
    #[must_use]
    pub fn misfit(self, cell: &str) -> Option<String> {
        let names: Vec<&str> = match self {
            Self::Scene => return None,
            Self::Newton => {
                let fits = cell == OWN || cell.parse::<u32>().is_ok();
                return (!fits).then(|| format!("a whole number from 0, or \"{OWN}\""));
            }
            Self::Rho => {
                let range = 0.0..=MAX_RHO;
                let fits = cell == OWN || cell.parse().is_ok_and(|rho: f64| range.contains(&rho));
                return (!fits).then(|| format!("a number from 0 to {MAX_RHO}, or \"{OWN}\""));
            }
            Self::Scheme => names::<SchemeName>(&[]),
            Self::Damping => names::<DampingName>(&[OWN]),
            Self::Precision => names::<PrecisionName>(&[]),
            Self::Orientation => names::<OrientationName>(&[]),
        };
        if names.contains(&cell) {
            return None;
        }
        let meant = nearest(cell, names.iter().copied());
        let meant = meant.map(|meant| format!("; did you mean \"{meant}\"?")).unwrap_or_default();
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        Some(format!("one of {}{meant}", quoted.join(", ")))
    }
}

fn names<N: Named>(more: &[&'static str]) -> Vec<&'static str> {
    N::ALL.iter().map(|choice| choice.name()).chain(more.iter().copied()).collect()
}

/// The choices of a method by their names.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Choices<'c>(Vec<(Target, &'c str)>);

impl<'c> Choices<'c> {
    /// With one more choice, which goes before an earlier one.
    pub fn add(&mut self, target: Target, cell: &'c str) {
        self.0.retain(|(other, _)| *other != target);
        self.0.push((target, cell));
    }

    /// The method.
    ///
    /// # Errors
    /// If these are incompatible, or this build does not include them.
    pub fn method(&self) -> Result<Method, MethodError> {
        let of = |wanted| self.0.iter().find(|(target, _)| *target == wanted).map(|found| found.1);
        let scheme = of(Target::Scheme).and_then(SchemeName::of_name).unwrap_or_default();
        let newton = of(Target::Newton).and_then(|cell| cell.parse().ok());
        let precision = of(Target::Precision).and_then(PrecisionName::of_name).unwrap_or_default();
        let orientation = of(Target::Orientation).and_then(OrientationName::of_name);
        let method = Method::new(scheme, newton, precision)?;
        let method = match of(Target::Rho).and_then(|cell| cell.parse().ok()) {
            Some(rho) => method.with_rho(rho)?,
            None => method,
        };
        let method = match of(Target::Damping).and_then(DampingName::of_name) {
            Some(damping) => method.with_damping(damping)?,
            None => method,
        };
        let method = method.with_orientation(orientation.unwrap_or_default());
        method.check_built()?;
        Ok(method)
    }
}

/// Something that varies, or that has one value throughout.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its path.
    pub path: String,
    /// Its position in the file.
    pub place: Range<usize>,
    /// Its target.
    pub target: Target,
    /// Its values; in a sample as many as there are cases.
    pub values: Vec<Value>,
    /// Values checked before any case runs, with their positions.
    pub tried: Vec<(Value, Range<usize>)>,
    /// Whether ratios rather than differences are even.
    pub logarithmic: bool,
}

impl Axis {
    /// The SI unit of its values, where they are quantities and the table has them as numbers.
    #[must_use]
    pub fn unit(&self) -> Option<String> {
        dimension(self.values.iter()).map(|dimension| dimension.to_string())
    }

    /// Whether a plan of steps hangs on it.
    #[must_use]
    pub fn is_time(path: &str) -> bool {
        matches!(path, "step" | "duration" | "every")
    }
}
