//! A body's orientation in one of three forms: axis and angle, quaternion, Euler angles.
//!
//! `table => unit quaternion` (scalar first, body → world). Trigonometry is libm's. The norm is summed as
//! `((w² + x²) + y²) + z²`.

use dbd_kernel::{Quaternion, Vec3};

use crate::error::SceneError;
use crate::text::{Direction, Kind, Number, Numbers, Table, Value};

/// The keys of all forms.
pub(crate) const KEYS: &[&str] = &["axis", "angle", "quaternion", "euler_321"];

/// `{ axis, angle }`, `{ quaternion }` or `{ euler_321 }`.
#[derive(Clone, Copy)]
pub(crate) struct Orientation;

impl Kind for Orientation {
    type Output = [f64; 4];

    fn expected(&self) -> String {
        "one of { axis = [x, y, z], angle = rad }, { quaternion = [w, x, y, z] } and \
         { euler_321 = [yaw, pitch, roll] }"
            .into()
    }

    fn read(&self, value: &Value<'_>) -> Result<[f64; 4], SceneError> {
        let table = value.table(&self.expected())?;
        table.only(&[KEYS])?;
        let forms: Vec<&str> = ["axis", "quaternion", "euler_321"]
            .into_iter()
            .filter(|key| table.has(key) || (*key == "axis" && table.has("angle")))
            .collect();
        match forms[..] {
            ["axis"] => axis_angle(&table),
            ["quaternion"] => quaternion(&table),
            ["euler_321"] => euler_321(&table),
            [] => Err(value.refuse("is empty", &self.expected())),
            _ => Err(value.refuse("has more than one form", &self.expected())),
        }
    }
}

fn axis_angle(table: &Table<'_>) -> Result<[f64; 4], SceneError> {
    let axis = table.required("axis", Direction)?;
    let angle = table.required("angle", Number::any("rad"))?;
    Ok(about(axis.to_f64(), angle).to_f64())
}

fn quaternion(table: &Table<'_>) -> Result<[f64; 4], SceneError> {
    let kind = Numbers(Number::any(""));
    let q = table.required("quaternion", kind)?;
    let square = norm_squared(q);
    if !(1e-280..=1e280).contains(&square) {
        let help = "expected four numbers, scalar first, not all 0; they are normalised";
        return Err(table.refuse_value("quaternion", "cannot be normalised", help));
    }
    Ok(normalised(q))
}

fn euler_321(table: &Table<'_>) -> Result<[f64; 4], SceneError> {
    let [yaw, pitch, roll] = table.required("euler_321", Numbers(Number::any("rad")))?;
    let yaw = about([0.0, 0.0, 1.0], yaw);
    let pitch = about([0.0, 1.0, 0.0], pitch);
    let roll = about([1.0, 0.0, 0.0], roll);
    Ok(normalised(yaw.product(pitch).product(roll).to_f64()))
}

/// The rotation from the world's axes to these right-handed unit vectors. The largest component is computed by the
/// square root (Shepperd 1978).
pub(crate) fn of_axes([x, y, z]: [Vec3<f64>; 3]) -> [f64; 4] {
    let trace = x.x + y.y + z.z;
    let largest = trace.max(x.x).max(y.y).max(z.z);
    let q = if largest == trace {
        [1.0 + trace, y.z - z.y, z.x - x.z, x.y - y.x]
    } else if largest == x.x {
        [y.z - z.y, 1.0 + x.x - y.y - z.z, x.y + y.x, x.z + z.x]
    } else if largest == y.y {
        [z.x - x.z, x.y + y.x, 1.0 + y.y - x.x - z.z, y.z + z.y]
    } else {
        [x.y - y.x, x.z + z.x, y.z + z.y, 1.0 + z.z - x.x - y.y]
    };
    normalised(q)
}

/// The rotation by an angle about a unit axis.
pub(crate) fn about(axis: [f64; 3], angle: f64) -> Quaternion<f64> {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let [x, y, z] = axis;
    Quaternion::from_f64(normalised([cosine, sine * x, sine * y, sine * z]))
}

/// A unit quaternion whose bits do not change when it is normalised again.
pub(crate) fn settled(q: [f64; 4]) -> [f64; 4] {
    // Nearly always the second pass changes nothing.
    const MAX: usize = 8;
    let mut unit = normalised(q);
    for _ in 0..MAX {
        let next = normalised(unit);
        if next == unit {
            break;
        }
        unit = next;
    }
    unit
}

fn norm_squared([w, x, y, z]: [f64; 4]) -> f64 {
    w * w + x * x + y * y + z * z
}

/// A normalised quaternion.
pub(crate) fn normalised(q: [f64; 4]) -> [f64; 4] {
    let norm = libm::sqrt(norm_squared(q));
    q.map(|c| c / norm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dbd_kernel::Vec3;

    #[test]
    fn yaw_pitch_and_roll_turn_about_z_then_the_new_y_then_the_new_x() {
        let quarter = core::f64::consts::FRAC_PI_2;
        let q = about([0.0, 0.0, 1.0], quarter).product(about([0.0, 1.0, 0.0], quarter));
        // Yaw takes x to y; pitch about the new y (−x) then takes it down to −z.
        let x = q.rotation().to_world(Vec3::new(1.0, 0.0, 0.0)).to_f64();
        for (component, expected) in x.into_iter().zip([0.0, 0.0, -1.0]) {
            assert!((component - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn the_three_forms_agree() {
        let quarter = core::f64::consts::FRAC_PI_2;
        let of = |form: &str| {
            let text = format!(
                "name = \"o\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\n\
                 inertia = [1, 1, 1]\nposition = [0, 0, 0]\norientation = {form}"
            );
            crate::Scene::parse(&text, "o").unwrap().model.initial[0].orientation.to_f64()
        };
        let expected = of("{ quaternion = [5, 0, 0, 5] }");
        for form in [
            format!("{{ axis = [0, 0, 0.1], angle = {quarter:?} }}"),
            format!("{{ euler_321 = [{quarter:?}, 0, 0] }}"),
        ] {
            for (p, q) in of(&form).into_iter().zip(expected) {
                assert!((p - q).abs() < 1e-15, "{form}");
            }
        }
    }

    #[test]
    fn the_axes_of_a_turn_give_the_turn_back() {
        for q in [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [0.1, -0.9, 0.3, 0.2],
            [0.1, 0.2, 0.9, -0.3],
            [-0.1, 0.2, 0.3, 0.9],
            [0.9, 0.2, -0.3, 0.1],
        ] {
            let expected = Quaternion::from_f64(normalised(q));
            let found = of_axes(Vec3::axes().map(|axis| expected.rotation().to_world(axis)));
            let found = Quaternion::<f64>::from_f64(found).product(expected.conjugate());
            assert!((found.w.abs() - 1.0).abs() < 1e-15, "{q:?}");
        }
    }

    #[test]
    fn a_unit_quaternion_keeps_its_bits() {
        for q in [[1.0, 0.0, 0.0, 0.0], [0.5, -0.5, 0.5, 0.5], [0.6, 0.0, 0.8, 0.0]] {
            assert_eq!(normalised(q), q);
        }
    }
}
