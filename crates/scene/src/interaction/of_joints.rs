//! `limits`, `friction` and `rotor` of joints: laws about and along their axes.
//!
//! `(table of a joint, its place, key) => the constants of a law`. Angles and travels are relative to t = 0, where
//! they are 0 or `offset`.

use dbd_kernel::laws::Field;

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::joints::JointPlace;
use crate::laws::dissipation;
use crate::text::{Number, Table};

/// Joint type, key and its law: `("revolute", "limits", "hinge-stop")`.
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
    &["from", "to", "offset", "stiffness", "soft", "dissipation", "restitution", "speed"];

/// The keys of friction.
pub(crate) const FRICTION: &[&str] =
    &["coulomb", "breakaway", "stribeck", "give", "damping", "viscous", "load"];

/// The keys of the load of friction.
pub(crate) const LOAD: &[&str] = &["mu", "radius", "force"];

/// The keys of a rotor without a drive.
pub(crate) const ROTOR: &[&str] = &["inertia", "stiffness", "damping", "play"];

/// The keys of the table of a joint key, and an example.
pub(super) fn keys_of(key: &str) -> (&'static [&'static str], &'static str) {
    match () {
        () if key.ends_with("limits") => (LIMITS, "{ from = …, to = …, stiffness = … }"),
        () if key.ends_with("rotor") => (ROTOR, "{ inertia = …, stiffness = … }"),
        () => (FRICTION, "{ coulomb = …, breakaway = … }"),
    }
}

/// Larger than any angle or travel.
const NONE: f64 = 1e30;

/// A table of `limits`, `friction` or a `rotor` of a joint.
pub(super) struct OfJoint<'j> {
    /// Geometry of the joint.
    pub(super) place: &'j JointPlace,
    is_limits: bool,
    is_friction: bool,
    /// The constants of its law.
    fields: &'static [Field],
    /// \[1/(kg·m²), 1/kg\] inverse reduced inertia of its two free bodies.
    mobility: f64,
}

impl<'j> OfJoint<'j> {
    /// Rejects unknown keys and limits without `from` and `to`.
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
        // Rotations are in radians.
        let turns = fields.iter().any(|field| field.kind == "axis");
        let about = turns.then_some(place.axis_w);
        let mobility = assembly.mobility([place.pair.a, place.pair.b], about);
        Ok(Self { place, is_limits, is_friction, fields, mobility })
    }

    /// A constant of the law that the table specifies differently; `None` if it is read directly.
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
            "mu" | "radius" | "force" if self.is_friction => Some(self.of_load(table, key)),
            _ => None,
        }
    }

    /// A constant of the load of friction.
    fn of_load(&self, table: &Table<'_>, key: &str) -> Result<f64, SceneError> {
        let Some(field) = self.fields.iter().find(|field| field.name == key) else {
            return Ok(1.0);
        };
        let is_turn = self.fields.iter().any(|field| field.name == "radius");
        let expected = if is_turn { "{ mu = …, radius = … }" } else { "{ mu = … }" };
        let Some(value) = table.value("load") else { return Err(table.missing("load", expected)) };
        let load = value.table(expected)?;
        let known = |key: &&&str| is_turn || **key != "radius";
        load.only(&[&LOAD.iter().filter(known).copied().collect::<Vec<_>>()])?;
        let number = Number::not_negative(field.units.first().copied().unwrap_or_default());
        match field.default {
            Some(default) => Ok(load.optional(key, number)?.unwrap_or(default)),
            None => load.required(key, number),
        }
    }

    /// Half the critical damping of the elastic motion of the two free bodies: `√(k·μ)`, with the stiffness k =
    /// `breakaway`/`give`, with the friction of the load `force` in addition.
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
        let limit = match limit.filter(|_| table.has("load")) {
            Some(limit) => {
                let [mu, radius, force] =
                    ["mu", "radius", "force"].map(|key| self.of_load(table, key));
                Some(limit + mu? * radius? * force?)
            }
            None => limit,
        };
        let square = limit.zip(given("give")?).map(|(limit, give)| limit / (give * self.mobility));
        Ok(square.filter(|square| *square > 0.0 && square.is_finite()).map_or(0.0, libm::sqrt))
    }
}

/// The laws of friction, each with that with a load.
const LOADED: [(&str, &str); 2] =
    [("hinge-friction", "hinge-friction-load"), ("slide-friction", "slide-friction-load")];

/// The law of friction: that with a load with `load`.
pub(super) fn loaded(table: &Table<'_>, law: &'static str) -> &'static str {
    let with_load = LOADED.iter().find(|(free, _)| *free == law).filter(|_| table.has("load"));
    with_load.map_or(law, |(_, with_load)| with_load)
}

/// A constant of a law of limits that the table specifies differently.
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

/// The laws of stops, each with its soft one and the unit of a depth.
const SOFTENED: [(&str, &str, &str); 3] = [
    ("end-stop", "soft-end-stop", "m"),
    ("hinge-stop", "soft-hinge-stop", "rad"),
    ("distance-stop", "soft-distance-stop", "m"),
];

/// The soft law of a stop.
pub(super) fn softened(law: &str) -> Option<&'static str> {
    SOFTENED.iter().find(|(hard, ..)| *hard == law).map(|(_, soft, _)| *soft)
}

/// The law of limits: that of a soft stop with `soft` above 0; of friction that with a load.
pub(super) fn law_of(table: &Table<'_>, law: &'static str) -> Result<&'static str, SceneError> {
    let Some((_, soft, unit)) = SOFTENED.iter().find(|(hard, ..)| *hard == law) else {
        return Ok(loaded(table, law));
    };
    let depth = table.optional("soft", Number::not_negative(unit))?.unwrap_or(0.0);
    Ok(if depth > 0.0 { soft } else { law })
}

/// Rejects limits without `from` and `to`.
pub(super) fn check_limits(table: &Table<'_>) -> Result<(), SceneError> {
    if table.has("from") || table.has("to") {
        return Ok(());
    }
    Err(table.refuse("limits nothing", "give `from`, `to` or both"))
}

/// `restitution` and `speed` as the coefficient of Hunt and Crossley.
fn restituted(table: &Table<'_>, unit: &'static str) -> Result<Option<f64>, SceneError> {
    let Some(restitution) = table.optional("restitution", Number::any(""))? else {
        return match table.has("speed") {
            true => Err(table.refuse_key(
                "speed",
                "requires `restitution`",
                "give both, or `dissipation`",
            )),
            false => Ok(None),
        };
    };
    if table.has("dissipation") {
        let help = "give only one: each determines the energy loss of an impact";
        return Err(table.refuse_key("dissipation", "contradicts `restitution`", help));
    }
    if !(restitution > 0.0 && restitution <= 1.0) {
        let help = "give the speed after an impact over the speed before it, in (0, 1]";
        return Err(table.refuse_value(
            "restitution",
            "is not a valid coefficient of restitution",
            help,
        ));
    }
    let speed = if unit == "s/rad" { "rad/s" } else { "m/s" };
    Ok(Some(dissipation(restitution, table.required("speed", Number::positive(speed))?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference from separate integration of the law: restitution 0.7119501796 at a·v = 0.6.
    #[test]
    fn restitution_is_that_of_the_law() {
        assert!((dissipation(0.711_950_179_6, 1.0) - 0.6).abs() < 1e-9);
        assert!((dissipation(0.711_950_179_6, 2.0) - 0.3).abs() < 1e-9);
        assert_eq!(dissipation(1.0, 1.0), 0.0);
        for e in [0.999_999, 0.9, 0.5, 0.1, 1e-3] {
            let (h, k, a) = (1e-5, 1.0, dissipation(e, 1.0));
            // Integrates the law alone with small steps: v' = −k·x·(1 + a·v).
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
