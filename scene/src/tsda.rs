//! `[[tsda]]`: one raw TSDA between two points; with the free length 0 a point bushing.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Points};
use crate::error::SceneError;
use crate::pair::Between;
use crate::spring;
use crate::text::{Kind, Number, Numbers, Table, Value};

const KEYS: &[&str] = &["between", "points", "free_length"];

/// Points closer than this share of the free length give the line no direction.
const COINCIDENT: f64 = 1e-9;

/// Reads all raw TSDAs in scene order.
pub(crate) fn read_all(root: &Table<'_>, assembly: &mut Assembly) -> Result<(), SceneError> {
    for table in root.list("tsda")? {
        table.only(&[KEYS, spring::KEYS])?;
        let pair = table.required("between", Between(assembly))?;
        let [a, b] = table.required("points", TwoPoints)?;
        let spring = spring::read(&table, spring::AXIAL)?;
        let free_length = table.required("free_length", Number::not_negative("m"))?;
        let points = Points { centres: &[a], tips: &[b], shared: false };
        let added = if free_length == 0.0 {
            assembly.add_bushing(&pair, points, spring)
        } else {
            let d = assembly.place(pair.b, b) - assembly.place(pair.a, a);
            if libm::sqrt(d.dot(d)) <= COINCIDENT * free_length {
                let help = "two points apart, or `free_length = 0` for a spring that is \
                            isotropic and needs no direction";
                let problem = "coincide, though the TSDA has a free length";
                return Err(table.refuse_value("points", problem, help));
            }
            assembly.add_tsdas(&pair, points, free_length, spring)
        };
        added.map_err(|defect| defect.refuse(&table))?;
    }
    Ok(())
}

/// A point of the first body and one of the second.
struct TwoPoints;

impl Kind for TwoPoints {
    type Output = [Vec3<f64>; 2];

    fn expected(&self) -> String {
        "two points in m, [[x, y, z], [x, y, z]], each in the axes of its body".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<[Vec3<f64>; 2], SceneError> {
        let mut points = [Vec3::ZERO; 2];
        for (point, entry) in points.iter_mut().zip(value.entries(2, &self.expected())?) {
            *point = Vec3::from_f64(Numbers(Number::any("m")).read(&entry)?);
        }
        Ok(points)
    }
}
