//! `winding` of a drive: of one current, or of two in rotor axes.
//!
//! `table => constants at the motor's shaft`.

use crate::error::SceneError;
use crate::interaction::common::{Constants, Mode};
use crate::text::{Kind, Number, Table, Value};

/// The keys of a winding of one current.
pub(crate) const WINDING: &[&str] = &["resistance", "inductance", "constant", "most_current"];

/// The further keys of a winding in rotor axes.
pub(crate) const AXES: &[&str] = &["inductance_d", "inductance_q", "flux", "pole_pairs"];

/// The keys of both.
const BOTH: &[&str] = &["resistance", "most_current"];

/// Whether the winding of a drive is one in rotor axes.
pub(super) fn has_axes(drive: &Table<'_>) -> Result<bool, SceneError> {
    let Some(value) = drive.value("winding") else { return Ok(false) };
    let table = value.table(&Winding(Mode::Voltage).expected())?;
    Ok(AXES.iter().any(|key| table.has(key)))
}

/// Rejects constants that have no effect on a current that an input gives.
fn only_in_voltage(table: &Table<'_>, mode: Mode, keys: &[&str]) -> Result<(), SceneError> {
    let given = keys.iter().find(|key| mode == Mode::Current && table.has(key));
    given.map_or(Ok(()), |key| {
        let help = "remove it: only in the mode \"voltage\" does the current depend on it";
        Err(table.refuse_key(key, "has no effect in the mode \"current\"", help))
    })
}

/// The winding of a motor, at its shaft.
pub(super) struct OfWinding {
    /// \[Ω\]
    pub(super) resistance: f64,
    /// \[H\]
    pub(super) inductance: f64,
    /// \[N·m/A, V·s\]
    pub(super) constant: f64,
    /// \[A\]
    pub(super) most_current: Option<f64>,
}

pub(super) struct Winding(pub(super) Mode);

impl Kind for Winding {
    type Output = OfWinding;

    fn expected(&self) -> String {
        "{ resistance = …, inductance = …, constant = … } in ohm, H and N·m/A".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<OfWinding, SceneError> {
        let table = value.table(&self.expected())?;
        table.only(&[WINDING])?;
        let constant = table.required("constant", Number::any("N·m/A"))?;
        if constant == 0.0 {
            let help = "give the torque at the motor's shaft per current in N·m/A";
            return Err(table.refuse_value("constant", "is 0", help));
        }
        let most_current = table.optional("most_current", Number::positive("A"))?;
        only_in_voltage(&table, self.0, &["resistance", "inductance"])?;
        if self.0 == Mode::Current {
            return Ok(OfWinding { resistance: 0.0, inductance: 0.0, constant, most_current });
        }
        Ok(OfWinding {
            resistance: table.required("resistance", Number::positive("ohm"))?,
            inductance: table.optional("inductance", Number::not_negative("H"))?.unwrap_or(0.0),
            constant,
            most_current,
        })
    }
}

/// A winding in rotor axes, at the motor's shaft.
pub(super) struct OfAxes {
    /// \[Ω\] of a phase; 0 in the mode "current".
    resistance: f64,
    /// \[H\] d, q.
    inductances: [f64; 2],
    /// \[V·s\]
    flux: f64,
    pole_pairs: f64,
    /// \[A\]
    most_current: Option<f64>,
}

impl OfAxes {
    /// Adds its constants at the output of a gear.
    pub(super) fn add_to(&self, ratio: f64, constants: &mut Constants) {
        let [d, q] = self.inductances;
        constants.add("resistance", self.resistance);
        constants.add("inductance_d", d);
        constants.add("inductance_q", q);
        constants.add("flux", self.flux);
        constants.add("poles", self.pole_pairs * ratio);
        if let Some(most) = self.most_current {
            constants.add("most_current", most);
        }
    }
}

/// A winding in rotor axes.
pub(super) struct AxesWinding(pub(super) Mode);

impl Kind for AxesWinding {
    type Output = OfAxes;

    fn expected(&self) -> String {
        "{ resistance = …, inductance_d = …, inductance_q = …, flux = …, pole_pairs = … } in ohm, H and V·s"
            .into()
    }

    fn read(&self, value: &Value<'_>) -> Result<OfAxes, SceneError> {
        let table = value.table(&self.expected())?;
        table.only(&[BOTH, AXES])?;
        let pole_pairs = table.required("pole_pairs", Number::any(""))?;
        if pole_pairs < 1.0 || pole_pairs != libm::floor(pole_pairs) {
            let help = "give the number of pole pairs: half the number of the rotor's poles";
            return Err(table.refuse_value("pole_pairs", "is not a whole number ≥ 1", help));
        }
        let flux = table.required("flux", Number::not_negative("V·s"))?;
        let most_current = table.optional("most_current", Number::positive("A"))?;
        only_in_voltage(&table, self.0, &["resistance"])?;
        let keys = ["inductance_d", "inductance_q"];
        let is_fed = self.0 == Mode::Current;
        // Only their difference has an effect on the effort of a current.
        let inductances = match is_fed && !keys.iter().any(|key| table.has(key)) {
            true => [1.0; 2],
            false => {
                let [d, q] = keys.map(|key| table.required(key, Number::positive("H")));
                [d?, q?]
            }
        };
        let resistance = match is_fed {
            true => 0.0,
            false => table.required("resistance", Number::positive("ohm"))?,
        };
        if flux == 0.0 && inductances[0] == inductances[1] {
            let help = "give the flux linkage of the magnets, or different inductances";
            return Err(table.refuse_value("flux", "is 0 with equal inductances", help));
        }
        Ok(OfAxes { resistance, inductances, flux, pole_pairs, most_current })
    }
}
