//! Stiffness and damping, the keys that joints, raw TSDAs and torsion springs share.
//!
//! `clearance` is available where the element lists it among its keys.
//!
//! `stiffness = k` or `{ load, deflection }` with `k = load/deflection`; `damping = c`, or
//! `damping_ratio = ζ` with `frequency = f`: `c = (2·ζ·k)/(2π·f)`.

use crate::error::SceneError;
use crate::text::{Kind, Number, Table, Value};

/// The keys of a spring.
pub(crate) const KEYS: &[&str] = &["stiffness", "damping", "damping_ratio", "frequency"];

/// The keys of a stiffness given by load and deflection.
pub(crate) const BY_LOAD: &[&str] = &["load", "deflection"];

/// A spring and its damper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// \[N/m\] or \[N·m/rad\] stiffness, ≥ 0.
    pub(crate) stiffness: f64,
    /// \[N·s/m\] or \[N·m·s/rad\] damping, ≥ 0.
    pub(crate) damping: f64,
    /// \[m\] extension within which it does not act, ≥ 0.
    pub(crate) clearance: f64,
}

/// The units of a spring.
#[derive(Clone, Copy)]
pub(crate) struct Units {
    stiffness: &'static str,
    damping: &'static str,
    load: &'static str,
    deflection: &'static str,
}

/// A spring along a line.
pub(crate) const AXIAL: Units =
    Units { stiffness: "N/m", damping: "N·s/m", load: "N", deflection: "m" };

/// A spring about an axis.
pub(crate) const TORSIONAL: Units =
    Units { stiffness: "N·m/rad", damping: "N·m·s/rad", load: "N·m", deflection: "rad" };

/// Reads the keys of a spring.
pub(crate) fn read(table: &Table<'_>, units: Units) -> Result<Spring, SceneError> {
    let stiffness = table.required("stiffness", Stiffness(units))?;
    let damping = table.optional("damping", Number::not_negative(units.damping))?;
    let ratio = table.optional("damping_ratio", Number::not_negative(""))?;
    let frequency = table.optional("frequency", Number::positive("Hz"))?;
    let damping = match (damping, ratio, frequency) {
        (None, None, None) => 0.0,
        (Some(damping), None, None) => damping,
        (None, Some(ratio), Some(frequency)) => {
            (2.0 * ratio * stiffness) / (core::f64::consts::TAU * frequency)
        }
        (Some(_), Some(_), _) => {
            let help = "give either `damping` or `damping_ratio` with `frequency`";
            return Err(table.refuse_key("damping_ratio", "contradicts `damping`", help));
        }
        (None, Some(_), None) => {
            let help = "add `frequency`, the frequency in Hz at which the ratio applies";
            return Err(table.refuse_key("damping_ratio", "needs `frequency`", help));
        }
        (_, None, Some(_)) => {
            let help = "add `damping_ratio`, or omit `frequency`; `damping` needs none";
            return Err(table.refuse_key("frequency", "needs `damping_ratio`", help));
        }
    };
    if !damping.is_finite() {
        let help = "use a larger `frequency` or a smaller `damping_ratio`";
        return Err(table.refuse_key("damping_ratio", "gives an infinite damping", help));
    }
    let clearance = table.optional("clearance", Number::not_negative("m"))?.unwrap_or(0.0);
    Ok(Spring { stiffness, damping, clearance })
}

struct Stiffness(Units);

impl Kind for Stiffness {
    type Output = f64;

    fn expected(&self) -> String {
        let Units { stiffness, load, deflection, .. } = self.0;
        format!(
            "a finite number ≥ 0 in {stiffness}, or {{ load = {load}, deflection = {deflection} }}"
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<f64, SceneError> {
        if !value.get().is_table() {
            if !(value.get().is_float() || value.get().is_integer() || value.get().is_str()) {
                return Err(value.wrong_type(&self.expected()));
            }
            return Number::not_negative(self.0.stiffness).read(value);
        }
        let table = value.table(&self.expected())?;
        table.only(&[BY_LOAD])?;
        let load = table.required("load", Number::positive(self.0.load))?;
        let deflection = table.required("deflection", Number::positive(self.0.deflection))?;
        let stiffness = load / deflection;
        if !stiffness.is_finite() {
            return Err(value.refuse("is infinite", &self.expected()));
        }
        Ok(stiffness)
    }
}

#[cfg(test)]
mod tests {
    use crate::example;

    fn tsda(keys: &str) -> (f64, f64) {
        let scene = example::with(&format!(
            "[[tsda]]\nbetween = [\"arm\", \"hand\"]\npoints = [[0, 0, 0], [1, 0, 0]]\n\
             free_length = 0.1\n{keys}"
        ));
        (scene.model.tsdas[0].stiffness, scene.model.dampers.first().copied().unwrap_or(0.0))
    }

    #[test]
    fn stiffness_and_damping_have_two_forms_each() {
        assert_eq!(tsda("stiffness = 5e6"), (5e6, 0.0));
        assert_eq!(tsda("stiffness = 0\ndamping = 7"), (0.0, 7.0));
        let (stiffness, damping) = tsda(
            "stiffness = { load = 500, deflection = 1e-4 }\ndamping_ratio = 1\nfrequency = 550",
        );
        assert_eq!(stiffness, 500.0 / 1e-4);
        // c = 2ζk/ω at ω = 2π·550 rad/s.
        assert!((damping - 2.0 * 5e6 / 3_455.751_918_948_772).abs() < 1e-9);
        assert_eq!(tsda("stiffness = 1\ndamping_ratio = 0\nfrequency = 1"), (1.0, 0.0));
    }
}
