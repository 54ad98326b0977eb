//! `limits`, `friction` and `rotor` of joints: laws about and along their axes.
//!
//! `(table of a joint, its place, key) => the constants of a law`. Angle and travel count from t = 0, where they are 0
//! or `offset`.

use dbd_kernel::laws::Field;

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::joints::JointPlace;
use crate::laws::dissipation;
use crate::text::{Number, Table};

/// A key of a type of joint and the law that it stands for: `("revolute", "limits", "hinge-stop")`.
pub(super) const OF_JOINTS: [(&str, &str, &str); 12] = [
    ("revolute", "limits", "hinge-stop"),
    ("revolute", "friction", "hinge-friction"),
    ("revolute", "rotor", "hinge-drive"),
    ("translational", "limits", "end-stop"),
    ("translational", "friction", "slide-friction"),
    ("translational", "rotor", "slide-drive"),
    ("cylindrical", "turn_limits", "hinge-stop"),
    ("cylindrical", "turn_friction", "hinge-friction"),
    ("cylindrical", "turn_rotor", "hinge-drive"),
    ("cylindrical", "slide_limits", "end-stop"),
    ("cylindrical", "slide_friction", "slide-friction"),
    ("cylindrical", "slide_rotor", "slide-drive"),
];

/// The keys of limits.
pub(crate) const LIMITS: &[&str] =
    &["from", "to", "offset", "stiffness", "dissipation", "restitution", "speed"];

/// The keys of friction.
pub(crate) const FRICTION: &[&str] =
    &["coulomb", "breakaway", "stribeck", "give", "damping", "viscous"];

/// The keys of a rotor that nothing drives.
pub(crate) const ROTOR: &[&str] = &["inertia", "stiffness", "damping", "play"];

/// The keys of a table of this key of a joint, and how it looks.
pub(super) fn keys_of(key: &str) -> (&'static [&'static str], &'static str) {
    match () {
        () if key.ends_with("limits") => (LIMITS, "{ from = …, to = …, stiffness = … }"),
        () if key.ends_with("rotor") => (ROTOR, "{ inertia = …, stiffness = … }"),
        () => (FRICTION, "{ coulomb = …, breakaway = … }"),
    }
}

/// Beyond any angle and travel.
const NONE: f64 = 1e30;

/// A table of `limits`, `friction` or a `rotor` of a joint.
pub(super) struct OfJoint<'j> {
    /// Where the joint is.
    pub(super) place: &'j JointPlace,
    is_limits: bool,
    is_friction: bool,
    /// The constants of its law.
    fields: &'static [Field],
    /// \[1/(kg·m²), 1/kg\] of its two bodies, each free.
    mobility: f64,
}

impl<'j> OfJoint<'j> {
    /// Refuses keys that there are not, and limits that limit nothing.
    pub(super) fn new(
        table: &Table<'_>,
        key: &str,
        (place, fields): (&'j JointPlace, &'static [Field]),
        assembly: &Assembly,
    ) -> Result<Self, SceneError> {
        let is_limits = key.ends_with("limits");
        let (keys, _) = keys_of(key);
        let is_friction = keys == FRICTION;
        table.only(&[keys])?;
        if is_limits {
            check_limits(table)?;
        }
        // What turns is in radians.
        let turns = fields.iter().any(|field| field.kind == "axis");
        let about = turns.then_some(place.axis_w);
        let mobility = assembly.mobility([place.pair.a, place.pair.b], about);
        Ok(Self { place, is_limits, is_friction, fields, mobility })
    }

    /// A number that the law has and the table gives in another way; `None` where it is read as it stands.
    pub(super) fn number(
        &self,
        table: &Table<'_>,
        key: &str,
        unit: &'static str,
    ) -> Option<Result<f64, SceneError>> {
        match key {
            _ if self.is_limits => limit(table, key, unit),
            "breakaway" if self.is_friction && !table.has(key) => {
                Some(table.required("coulomb", Number::not_negative(unit)))
            }
            "damping" if self.is_friction && !table.has(key) => Some(self.damping(table)),
            _ => None,
        }
    }

    /// Half of what would be critical for the elastic part of the motion, the two bodies free: `√(k·μ)`, k the stiffness
    /// `breakaway`/`give`.
    fn damping(&self, table: &Table<'_>) -> Result<f64, SceneError> {
        let given = |key: &str| {
            let field = self.fields.iter().find(|field| field.name == key);
            let unit = field.and_then(|field| field.units.first()).copied().unwrap_or_default();
            let given = table.optional(key, Number::any(unit))?;
            Ok(given.or(field.and_then(|field| field.default)))
        };
        let limit = match given("breakaway")? {
            Some(limit) => Some(limit),
            None => given("coulomb")?,
        };
        let square = limit.zip(given("give")?).map(|(limit, give)| limit / (give * self.mobility));
        Ok(square.filter(|square| *square > 0.0 && square.is_finite()).map_or(0.0, libm::sqrt))
    }
}

/// A number of a law of limits that their table gives in another way.
pub(super) fn limit(
    table: &Table<'_>,
    key: &str,
    unit: &'static str,
) -> Option<Result<f64, SceneError>> {
    let from_zero = |none: f64| {
        let offset = table.optional("offset", Number::any(unit))?.unwrap_or(0.0);
        Ok(table.optional(key, Number::any(unit))?.map_or(none, |end| end - offset))
    };
    match key {
        "from" => Some(from_zero(-NONE)),
        "to" => Some(from_zero(NONE)),
        "dissipation" => restituted(table, unit).transpose(),
        _ => None,
    }
}

/// Refuses limits that limit nothing.
pub(super) fn check_limits(table: &Table<'_>) -> Result<(), SceneError> {
    if table.has("from") || table.has("to") {
        return Ok(());
    }
    Err(table.refuse("limits nothing", "`from`, `to` or both"))
}

/// `restitution` and `speed` as the coefficient of Hunt and Crossley.
fn restituted(table: &Table<'_>, unit: &'static str) -> Result<Option<f64>, SceneError> {
    let Some(restitution) = table.optional("restitution", Number::any(""))? else {
        return match table.has("speed") {
            true => {
                Err(table.refuse_key("speed", "has no `restitution`", "both, or `dissipation`"))
            }
            false => Ok(None),
        };
    };
    if table.has("dissipation") {
        let help = "either says how much an impact loses";
        return Err(table.refuse_key("dissipation", "stands beside `restitution`", help));
    }
    if !(restitution > 0.0 && restitution <= 1.0) {
        let help = "speed after an impact over speed before it, in (0, 1]";
        return Err(table.refuse_value("restitution", "is no ratio of speeds", help));
    }
    let speed = if unit == "s/rad" { "rad/s" } else { "m/s" };
    Ok(Some(dissipation(restitution, table.required("speed", Number::positive(speed))?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rebounds of the law by its own integration: 0.7119501796 at a·v = 0.6.
    #[test]
    fn restitution_is_that_of_the_law() {
        assert!((dissipation(0.711_950_179_6, 1.0) - 0.6).abs() < 1e-9);
        assert!((dissipation(0.711_950_179_6, 2.0) - 0.3).abs() < 1e-9);
        assert_eq!(dissipation(1.0, 1.0), 0.0);
        for e in [0.999_999, 0.9, 0.5, 0.1, 1e-3] {
            let (h, k, a) = (1e-5, 1.0, dissipation(e, 1.0));
            // Forces alone, small steps: v' = −k·x·(1 + a·v).
            let (mut x, mut v) = (0.0_f64, 1.0_f64);
            while x >= 0.0 {
                let force = |x: f64, v: f64| -(k * x * (1.0 + a * v)).max(0.0);
                let (middle, rate) = (x + 0.5 * h * v, v + 0.5 * h * force(x, v));
                (x, v) = (x + h * rate, v + h * force(middle, rate));
                if v < 0.0 && x < 1e-9 {
                    break;
                }
            }
            assert!((v + e).abs() < 2e-3, "{e}: {v} with {a}");
        }
    }
}
