//! `inertia`: principal moments, or a tensor that is diagonalised.
//!
//! `value => moments, orientation of the principal axes in the given axes`.

mod principal;
mod sections;
mod shapes;

use crate::error::SceneError;
use crate::orientation::of_axes;
use crate::text::{Kind, Number, Numbers, Value};

pub(crate) use sections::{KEYS, NAMES, Section, section, sizes};

/// Relative slack of the triangle inequality: an inertia computed for a thin plate meets it with equality up to
/// rounding.
const TRIANGLE_SLACK: f64 = 1e-9;

/// Two mirrored off-diagonal entries are equal if they differ by less than this fraction of the moments.
const SYMMETRIC: f64 = 1e-9;

/// A moment below this fraction of the largest is 0 up to rounding.
const LEAST: f64 = 1e-14;

/// Moments about principal axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inertia {
    /// \[kg·m²\] about the centre of mass.
    pub(crate) moments: [f64; 3],
    /// The rotation from the principal axes to the given ones, scalar first; `None` if they are the same.
    pub(crate) turn: Option<[f64; 4]>,
}

/// `[Ix, Iy, Iz]`.
#[derive(Clone, Copy)]
pub(crate) struct PrincipalInertia;

impl Kind for PrincipalInertia {
    type Output = [f64; 3];

    fn expected(&self) -> String {
        Numbers::<3>(Number::positive("kg·m²")).expected()
    }

    fn read(&self, value: &Value<'_>) -> Result<[f64; 3], SceneError> {
        let moments = Numbers(Number::positive("kg·m²")).read(value)?;
        refuse_impossible(value, moments, "")?;
        Ok(moments)
    }
}

/// `[Ix, Iy, Iz]` or a tensor of three rows.
#[derive(Clone, Copy)]
pub(crate) struct AnyInertia;

impl Kind for AnyInertia {
    type Output = Inertia;

    fn expected(&self) -> String {
        format!(
            "{}, or a symmetric tensor [[Ixx, Ixy, Ixz], [Ixy, Iyy, Iyz], [Ixz, Iyz, Izz]]",
            PrincipalInertia.expected()
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<Inertia, SceneError> {
        let is_tensor = value
            .get()
            .as_array()
            .is_some_and(|rows| rows.iter().any(|row| row.get_ref().is_array()));
        if is_tensor {
            return tensor(value, &self.expected());
        }
        if !value.get().is_array() {
            return Err(value.wrong_type(&self.expected()));
        }
        Ok(Inertia { moments: PrincipalInertia.read(value)?, turn: None })
    }
}

/// Reads a tensor and diagonalises it.
fn tensor(value: &Value<'_>, expected: &str) -> Result<Inertia, SceneError> {
    let mut rows = [[0.0; 3]; 3];
    for (i, (row, entry)) in
        rows.iter_mut().zip(value.entries(3, || expected.to_owned())?).enumerate()
    {
        *row = Numbers(Number::any("kg·m²")).read(&entry)?;
        let moment = entry.entries(3, || expected.to_owned())?;
        Number::positive("kg·m²").read(&moment[i])?;
    }
    const NAMES: [&str; 3] = ["x", "y", "z"];
    for (p, q) in [(0, 1), (0, 2), (1, 2)] {
        let scale = libm::sqrt(rows[p][p]) * libm::sqrt(rows[q][q]);
        let (a, b) = (rows[p][q], rows[q][p]);
        if (a - b).abs() > SYMMETRIC * scale {
            let (x, y) = (NAMES[p], NAMES[q]);
            let problem = format!("is not symmetric: I{x}{y} = {a:?}, I{y}{x} = {b:?}");
            let help = "give a symmetric tensor; its off-diagonal entries are the negative products of \
                        inertia, Ixy = −∫x·y dm";
            return Err(value.refuse_with(&problem, help));
        }
        let mean = if a == b { a } else { 0.5 * (a + b) };
        (rows[p][q], rows[q][p]) = (mean, mean);
    }
    let found = principal::principal(rows);
    let [x, y, z] = found.moments;
    let (least, greatest) = (x.min(y).min(z), x.max(y).max(z));
    // Also NaN, if squares overflow.
    if !(least > LEAST * greatest && greatest.is_finite()) {
        let problem = format!("has the principal moments {x:?}, {y:?} and {z:?}, not all above 0");
        let help = "give three moments > 0 and small enough products of inertia: Ixy² < Ixx·Iyy and \
                    likewise for the others";
        return Err(value.refuse_with(&problem, help));
    }
    if found.is_turned {
        refuse_impossible(value, found.moments, " about its principal axes")?;
    } else {
        refuse_impossible(value, found.moments, "")?;
    }
    let turn = found.is_turned.then(|| of_axes(found.axes));
    Ok(Inertia { moments: found.moments, turn })
}

/// Rejects an inertia that no mass distribution has: one moment above the sum of the others.
fn refuse_impossible(value: &Value<'_>, inertia: [f64; 3], about: &str) -> Result<(), SceneError> {
    let [x, y, z] = inertia;
    for (name, one, others, sum) in
        [("Ix", x, "Iy + Iz", y + z), ("Iy", y, "Ix + Iz", x + z), ("Iz", z, "Ix + Iy", x + y)]
    {
        if one > sum * (1.0 + TRIANGLE_SLACK) {
            let problem =
                format!("violates the triangle inequality{about}: {name} = {one:?} > {sum:?}");
            let help = format!(
                "give principal moments of a rigid body about its centre of mass: {name} ≤ {others}, \
                 and likewise for the others"
            );
            return Err(value.refuse_with(&problem, help));
        }
    }
    Ok(())
}
