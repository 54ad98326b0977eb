//! The names of roots, `audit.WHAT.MODEL.SCHEME.PRECISION`, and which of them there must be.

/// Every scheme that a step is compiled with.
pub const SCHEMES: [&str; 12] = [
    "dbd",
    "dbd-p1",
    "dbd-p2",
    "semi-implicit-euler",
    "leapfrog",
    "pefrl",
    "blanes-moan-s6",
    "rk4",
    "semi-implicit-euler-explicit",
    "leapfrog-explicit",
    "semi-implicit-euler-joint-wise",
    "leapfrog-joint-wise",
];
/// Those of double precision: it is compiled from the same text, and its steps are nearly three times as large.
pub const DOUBLE: [&str; 1] = ["leapfrog"];
/// Models of laws alone.
pub const LAWFUL: [&str; 5] = ["laws-1", "laws-2", "laws-3", "laws-4", "laws-5"];
/// Models that are stepped with all of them.
pub const MODELS: [&str; 2] = ["four-bar", "every-kind"];
/// What is called between steps, with the second of these models.
pub const CALLS: [&str; 10] = [
    "advance",
    "set_input",
    "set_input_real",
    "set_signal",
    "set_state",
    "reset",
    "read",
    "snapshot",
    "restore",
    "hash",
];
/// What a timer calls, with [`NODE`]: it steps the plant and reads it.
pub const STEPPING: [&str; 2] = ["node_step", "delay_ns"];
/// What drivers call, with [`NODE`].
pub const ENDS: [&str; 12] = [
    "duty",
    "bridge_pin",
    "spi_as5047p",
    "spi_ls7366r",
    "spi_mpu6000",
    "spi_words",
    "spi_bus",
    "chip_select",
    "i2c_mpu6000",
    "balance_tick",
    "encoder_pin",
    "switch_pin",
];
/// The plant behind them: model, scheme and precision.
pub const NODE: [&str; 3] = ["cart-pendulum", "leapfrog", "f32"];
/// Both precisions.
pub const PRECISIONS: [&str; 2] = ["f32", "f64"];

/// A root without a planted fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// `step` or one of [`CALLS`], [`STEPPING`] and [`ENDS`].
    pub what: String,
    /// The model's name.
    pub model: String,
    /// The scheme's name, with `-` and another damping than its own.
    pub scheme: String,
    /// `f32`, `f64` or `fixed`.
    pub precision: String,
}

impl Root {
    /// A step.
    pub fn step(model: &str, scheme: &str, precision: &str) -> Self {
        Self::call("step", model, scheme, precision)
    }

    /// A call.
    pub fn call(what: &str, model: &str, scheme: &str, precision: &str) -> Self {
        let [what, model, scheme, precision] =
            [what, model, scheme, precision].map(ToOwned::to_owned);
        Self { what, model, scheme, precision }
    }

    /// Reads a symbol's name.
    pub fn parse(symbol: &str) -> Option<Self> {
        let words: Vec<&str> = symbol.split('.').collect();
        let ["audit", what, model, scheme, precision] = words[..] else { return None };
        Some(Self::call(what, model, scheme, precision))
    }

    /// Its symbol's name.
    pub fn symbol(&self) -> String {
        let Self { what, model, scheme, precision } = self;
        format!("audit.{what}.{model}.{scheme}.{precision}")
    }

    /// What a timer or a driver calls.
    pub fn end(what: &str) -> Self {
        let [model, scheme, precision] = NODE;
        Self::call(what, model, scheme, precision)
    }

    /// Whether it is of single precision throughout: a step, or an end.
    pub fn is_single(&self) -> bool {
        let is_end = ENDS.contains(&self.what.as_str());
        (self.what == "step" || is_end) && matches!(self.precision.as_str(), "f32" | "fixed")
    }
}

/// A planted root's symbol.
pub fn planted(fault: &str) -> String {
    format!("audit.planted.{fault}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_read_as_they_are_written() {
        let root = Root::step("3rrr", "blanes-moan-s6", "f64");
        assert_eq!(Root::parse(&root.symbol()), Some(root.clone()));
        assert!(!root.is_single());
        assert!(Root::step("3rrr", "dbd", "fixed").is_single());
        assert!(Root::step("3rrr", "dbd", "f32").is_single() && Root::end("duty").is_single());
        assert!(!Root::end("node_step").is_single());
        assert_eq!(Root::parse(&planted("panic")), None);
        assert_eq!(Root::parse("audit_roots"), None);
    }
}
