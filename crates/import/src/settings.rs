//! Settings of a file: units and sequences of angles, source of inertia, gravity.
//!
//! `<compiler>, <option> => settings`; later attributes override earlier ones.

use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::defaults::Attributes;
use crate::element::Element;
use crate::error::Fault;
use crate::omission::{Kind, Omissions};
use crate::place::Place;

/// Source of the inertia of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InertiaSource {
    /// Only `<inertial>`.
    Inertial,
    /// Its geoms, regardless of `<inertial>`.
    Geoms,
    /// `<inertial>`, else its geoms.
    Either,
}

/// Settings of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Settings {
    /// `<mujoco model="…">`.
    pub(crate) model: Option<String>,
    /// Whether angles are degrees.
    pub(crate) degrees: bool,
    /// The axes of three angles in order; upper case: fixed axes.
    pub(crate) sequence: [u8; 3],
    /// Source of inertia.
    pub(crate) inertia: InertiaSource,
    /// Groups of geoms that have mass.
    pub(crate) inertia_groups: [f64; 2],
    /// \[kg, kg·m²\] least mass and principal moment.
    pub(crate) bounds: [f64; 2],
    /// Whether impossible moments become their mean.
    pub(crate) balance: bool,
    /// \[kg\] total mass; not positive: unscaled.
    pub(crate) total_mass: f64,
    /// Whether a range alone makes a limit.
    pub(crate) automatic_limits: bool,
    /// Whether geoms without contacts are dropped before masses are summed.
    pub(crate) discard_visual: bool,
    /// The folder of meshes, relative to that of the model.
    pub(crate) meshes: String,
    /// Whether folders are stripped from file names.
    pub(crate) strips_paths: bool,
    /// \[m/s²\]
    pub(crate) gravity: Vector3<f64>,
    /// \[s\] the file's time step, if its format has one.
    pub(crate) timestep: Option<f64>,
    /// Features disabled by the flags of `<option>`.
    pub(crate) off: Vec<String>,
    /// Position of the last `<compiler>`.
    pub(crate) compiler: Place,
}

/// Reads both sections.
///
/// # Errors
/// If a value is invalid.
pub(crate) fn read(root: &Element, omissions: &mut Omissions) -> Result<Settings, Fault> {
    let mut settings = Settings {
        model: root.text("model").filter(|name| !name.trim().is_empty()).map(str::to_owned),
        degrees: true,
        sequence: *b"xyz",
        inertia: InertiaSource::Either,
        inertia_groups: [f64::NEG_INFINITY, f64::INFINITY],
        bounds: [0.0; 2],
        balance: false,
        total_mass: -1.0,
        automatic_limits: true,
        discard_visual: false,
        meshes: String::new(),
        strips_paths: false,
        gravity: Vector3::new(0.0, 0.0, -9.81),
        timestep: (root.name == "mujoco").then_some(0.002),
        off: Vec::new(),
        compiler: root.place,
    };
    for section in root.sections("compiler") {
        compiler(&mut settings, &Attributes::own(section))?;
    }
    for section in root.sections("option") {
        option(&mut settings, section, omissions)?;
    }
    if settings.is_off("gravity") {
        settings.gravity = Vector3::zeros();
    }
    Ok(settings)
}

fn compiler(settings: &mut Settings, given: &Attributes<'_>) -> Result<(), Fault> {
    settings.compiler = given.element.place;
    if let Some(angle) = given.word("angle", &["radian", "degree"])? {
        settings.degrees = angle == 1;
    }
    if given.word("coordinate", &["local", "global"])? == Some(1) {
        let help = "use coordinate=\"local\"; MuJoCo before 2.3.4 converts such a file";
        return Err(Fault::at(given.place("coordinate"), "`coordinate` is \"global\"", help));
    }
    if let Some(sequence) = given.get("eulerseq") {
        let bytes: Option<[u8; 3]> = sequence.value.as_bytes().try_into().ok();
        let known = bytes.filter(|bytes| bytes.iter().all(|axis| b"xyzXYZ".contains(axis)));
        let Some(bytes) = known else {
            let message = format!("`eulerseq` is \"{}\"", sequence.value);
            let help = "expected three of x, y, z (rotating axes) and X, Y, Z (fixed axes)";
            return Err(Fault::at(sequence.place, message, help));
        };
        settings.sequence = bytes;
    }
    if let Some(source) = given.word("inertiafromgeom", &["false", "true", "auto"])? {
        let sources = [InertiaSource::Inertial, InertiaSource::Geoms, InertiaSource::Either];
        settings.inertia = sources[source];
    }
    if let Some(range) = given.numbers("inertiagrouprange", 2, 2)? {
        settings.inertia_groups = [range[0], range[1]];
    }
    settings.bounds[0] = given.magnitude("boundmass", settings.bounds[0])?;
    settings.bounds[1] = given.magnitude("boundinertia", settings.bounds[1])?;
    settings.balance = given.flag("balanceinertia", settings.balance)?;
    settings.total_mass = given.number("settotalmass")?.unwrap_or(settings.total_mass);
    settings.automatic_limits = given.flag("autolimits", settings.automatic_limits)?;
    settings.discard_visual = given.flag("discardvisual", settings.discard_visual)?;
    settings.strips_paths = given.flag("strippath", settings.strips_paths)?;
    if let Some(folder) = given.text("meshdir").or(given.text("assetdir")) {
        settings.meshes = folder.to_owned();
    }
    Ok(())
}

fn option(
    settings: &mut Settings,
    section: &Element,
    omissions: &mut Omissions,
) -> Result<(), Fault> {
    let given = Attributes::own(section);
    settings.gravity = given.vector("gravity")?.unwrap_or(settings.gravity);
    let known = settings.timestep.unwrap_or(0.002);
    settings.timestep = Some(given.magnitude("timestep", known)?);
    for (name, unit) in [("density", "kg/m³"), ("viscosity", "Pa·s")] {
        let value = given.magnitude(name, 0.0)?;
        if value > 0.0 {
            let what = format!("{name} {value} {unit} of the medium");
            omissions.add(Kind::Fluid, given.place(name), what);
        }
    }
    let wind = given.vector("wind")?.unwrap_or_default();
    if wind != Vector3::zeros() {
        let what = format!("wind {} {} {} m/s", wind.x, wind.y, wind.z);
        omissions.add(Kind::Fluid, given.place("wind"), what);
    }
    for flag in section.children.iter().filter(|child| child.name == "flag") {
        for attribute in &flag.attributes {
            settings.off.retain(|name| *name != attribute.name);
            match attribute.value.as_str() {
                "disable" => settings.off.push(attribute.name.clone()),
                "enable" => {}
                other => {
                    let message = format!("`{}` is \"{other}\"", attribute.name);
                    let help = "expected \"enable\" or \"disable\"";
                    return Err(Fault::at(attribute.place, message, help));
                }
            }
        }
    }
    Ok(())
}

impl Settings {
    /// Whether a flag of `<option>` disables a feature.
    pub(crate) fn is_off(&self, flag: &str) -> bool {
        let on_its_own = self.off.iter().any(|name| name == flag);
        let by_another = match flag {
            "contact" | "limit" | "equality" | "frictionloss" => Some("constraint"),
            "spring" | "damper" => Some("passive"),
            _ => None,
        };
        on_its_own || by_another.is_some_and(|other| self.off.iter().any(|name| name == other))
    }

    /// The path of a mesh file, relative to the folder of the model.
    pub(crate) fn mesh_path(&self, file: &str) -> PathBuf {
        // MuJoCo accepts either slash on every system.
        let file = file.replace('\\', "/");
        let name = if self.strips_paths { file.rsplit('/').next().unwrap_or(&file) } else { &file };
        Path::new(&self.meshes.replace('\\', "/")).join(name)
    }

    /// \[rad\] an angle of the file.
    pub(crate) fn angle(&self, angle: f64) -> f64 {
        if self.degrees { angle.to_radians() } else { angle }
    }

    /// The pose given by `pos` and one of the orientation attributes.
    pub(crate) fn pose(&self, given: &Attributes<'_>) -> Result<Isometry3<f64>, Fault> {
        let position = given.vector("pos")?.unwrap_or_default();
        let turn = self.orientation(given)?.unwrap_or_else(UnitQuaternion::identity);
        Ok(Isometry3::from_parts(Translation3::from(position), turn))
    }

    /// The orientation; `None` if not given.
    pub(crate) fn orientation(
        &self,
        given: &Attributes<'_>,
    ) -> Result<Option<UnitQuaternion<f64>>, Fault> {
        const WAYS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];
        // An orientation of the element overrides one of its class.
        let is_given =
            |way: &&str| given.element.text(way).is_some_and(|text| !text.trim().is_empty());
        let own = WAYS.into_iter().filter(is_given);
        let ways: Vec<&str> = own.collect();
        if let [_, second, ..] = ways[..] {
            let message = "the orientation is given twice";
            let help = format!("give one of {}", WAYS.join(", "));
            return Err(Fault::at(given.place(second), message, help));
        }
        let way = ways.first().copied().or(WAYS.into_iter().find(|way| given.get(way).is_some()));
        let Some(way) = way else { return Ok(None) };
        let count = [4, 4, 3, 6, 3][WAYS.iter().position(|one| *one == way).unwrap_or(0)];
        let Some(values) = given.numbers(way, count, count)? else { return Ok(None) };
        let place = given.get(way).map_or(given.element.place, |attribute| attribute.place);
        let unit = |vector: Vector3<f64>| {
            Unit::try_new(vector, 1e-150).ok_or_else(|| {
                Fault::at(
                    place,
                    format!("`{way}` has zero length"),
                    "expected a vector of nonzero length",
                )
            })
        };
        let vector = |from: usize| Vector3::new(values[from], values[from + 1], values[from + 2]);
        Ok(Some(match way {
            "quat" => {
                let [w, x, y, z] = [values[0], values[1], values[2], values[3]];
                quaternion([w, x, y, z]).ok_or_else(|| {
                    Fault::at(place, "`quat` is 0", "expected w x y z of nonzero length")
                })?
            }
            "axisangle" => {
                UnitQuaternion::from_axis_angle(&unit(vector(0))?, self.angle(values[3]))
            }
            "euler" => self.turned(&vector(0)),
            "xyaxes" => {
                let x = unit(vector(0))?;
                let y = vector(3);
                let y = unit(y - x.into_inner() * x.dot(&y))?;
                let z = x.cross(&y);
                let columns = [x.into_inner(), y.into_inner(), z];
                let basis = nalgebra::Matrix3::from_columns(&columns);
                UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(basis))
            }
            _ => along(&unit(vector(0))?),
        }))
    }

    /// The rotation by three angles in the file's sequence.
    fn turned(&self, angles: &Vector3<f64>) -> UnitQuaternion<f64> {
        let mut turn = UnitQuaternion::identity();
        for (axis, angle) in self.sequence.iter().zip(angles.iter()) {
            let about = match axis.to_ascii_lowercase() {
                b'x' => Vector3::x_axis(),
                b'y' => Vector3::y_axis(),
                _ => Vector3::z_axis(),
            };
            let one = UnitQuaternion::from_axis_angle(&about, self.angle(*angle));
            turn = if axis.is_ascii_lowercase() { turn * one } else { one * turn };
        }
        turn
    }
}

/// A quaternion of nonzero length, w first.
pub(crate) fn quaternion([w, x, y, z]: [f64; 4]) -> Option<UnitQuaternion<f64>> {
    let quaternion = nalgebra::Quaternion::new(w, x, y, z);
    UnitQuaternion::try_new(quaternion, 1e-150)
}

/// The smallest rotation that aligns z with a direction.
pub(crate) fn along(direction: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), direction).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    })
}
