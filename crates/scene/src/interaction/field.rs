//! Reads the constants of a law from its table.

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::laws::{Field, FieldSource, Ldl, MAX_TERMS, Term};
use dbd_kernel::{Quaternion, Vec3};

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::interaction::common::{Constants, InputName, JointName};
use crate::interaction::of_joints::{OfJoint, limit};
use crate::joints::JointPlace;
use crate::pair::Pair;
use crate::points::{Heading, PlaceOf};
use crate::text::{Kind, Number, Table, Value};

/// The owner of a table.
pub(super) enum Of<'a> {
    /// A separate interaction.
    Itself,
    /// A joint, which defines the geometry.
    Joint(OfJoint<'a>),
    /// A drive or a signal chain at a joint: geometry, input, constants.
    Drive(&'a JointPlace, usize, Constants),
    /// A raw TSDA or a torsion spring: points, axis (world).
    Spring([[f64; 3]; 2], Vec3<f64>),
    /// A TSDA with a free length that an input sets: points, input, constants.
    Winch([[f64; 3]; 2], usize, Constants),
    /// A coupling: terms and constants.
    Coupling(Box<[Option<Term>; MAX_TERMS]>, Constants),
}

impl Of<'_> {
    fn place(&self) -> Option<&JointPlace> {
        match self {
            Of::Itself | Of::Spring(..) | Of::Winch(..) | Of::Coupling(..) => None,
            Of::Joint(of) => Some(of.place),
            Of::Drive(place, ..) => Some(place),
        }
    }
}

/// What constants of laws name.
#[derive(Default)]
pub(super) struct Named {
    /// The names of the inputs.
    pub(super) inputs: Vec<String>,
    /// The joints, each with its group.
    pub(super) joints: Vec<(String, usize)>,
}

/// A table as the source of a law's constants.
pub(super) struct Reading<'a, 't> {
    table: &'a Table<'t>,
    assembly: &'a Assembly,
    pair: &'a Pair,
    of: Of<'a>,
    names: &'a Named,
    refused: Option<SceneError>,
}

impl<'a, 't> Reading<'a, 't> {
    pub(super) fn new(
        table: &'a Table<'t>,
        assembly: &'a Assembly,
        pair: &'a Pair,
        of: Of<'a>,
        names: &'a Named,
    ) -> Self {
        Self { table, assembly, pair, of, names, refused: None }
    }

    /// The error of a constant.
    pub(super) fn into_refused(self) -> Option<SceneError> {
        self.refused
    }

    fn keep<T>(&mut self, read: Result<T, SceneError>) -> Option<T> {
        match read {
            Ok(value) => Some(value),
            Err(error) => {
                self.refused.get_or_insert(error);
                None
            }
        }
    }

    /// The index of an input.
    fn signal(&mut self, field: &Field) -> Option<u32> {
        match &self.of {
            Of::Drive(_, input, constants) | Of::Winch(_, input, constants) => {
                let other = constants.get(field.name).map(|row| row as u32);
                return other.or_else(|| u32::try_from(*input).ok());
            }
            // No input has this index: it is not driven.
            Of::Joint(_) | Of::Spring(..) => return Some(u16::MAX.into()),
            Of::Itself | Of::Coupling(..) => {}
        }
        let read = self.table.required(field.name, InputName(&self.names.inputs));
        self.keep(read)
    }

    /// The group of a joint.
    fn joint(&mut self, field: &Field) -> Option<u32> {
        let row = match self.of.place() {
            Some(place) => place.group,
            None => {
                let read = self.table.required(field.name, JointName(&self.names.joints));
                self.keep(read)?
            }
        };
        u32::try_from(row).ok()
    }

    /// A direction in the axes of the first body, given like a joint's axis; an axle moves with the second body.
    fn heading(&mut self, field: &Field) -> Option<Vec3<f64>> {
        let (assembly, table, a) = (self.assembly, self.table, self.pair.a);
        if let Some(place) = self.of.place() {
            return Some(assembly.vector_in(a, place.axis_w));
        }
        if let Of::Spring(_, axis) = self.of {
            return Some(assembly.vector_in(a, axis));
        }
        let carrier = if field.kind == "axle" { self.pair.b } else { a };
        let read = table.required(field.name, Heading(assembly)).map(|written| {
            let carried = assembly.carried_direction(carrier, written);
            assembly.resolve_direction(table.value(field.name), written, carried);
            assembly.vector_in(a, carried)
        });
        self.keep(read)
    }
}

fn unit(field: &Field, row: usize) -> &'static str {
    field.units.get(row).copied().unwrap_or("")
}

impl FieldSource for Reading<'_, '_> {
    fn number(&mut self, field: &Field) -> Option<f64> {
        let kind = Number::any(unit(field, 0));
        let read = match &self.of {
            Of::Itself => None,
            Of::Joint(of) => of.number(self.table, field.name, unit(field, 0)),
            // A length is at least 0.
            Of::Spring(..)
                if field.name == "from" && !self.table.has("from") && field.default.is_some() =>
            {
                return field.default;
            }
            Of::Spring(..) => limit(self.table, field.name, unit(field, 0)),
            Of::Drive(.., constants) | Of::Winch(.., constants) | Of::Coupling(_, constants) => {
                return constants.get(field.name).or(field.default);
            }
        };
        if let Some(read) = read {
            return self.keep(read);
        }
        let read = match field.default {
            Some(default) => {
                self.table.optional(field.name, kind).map(|given| given.unwrap_or(default))
            }
            None => self.table.required(field.name, kind),
        };
        self.keep(read)
    }

    fn count(&mut self, field: &Field) -> Option<u32> {
        let table = self.table;
        match field.kind {
            "signal" => return self.signal(field),
            "joint" => return self.joint(field),
            _ => {}
        }
        if let Of::Drive(.., constants) = &self.of {
            return Some(constants.get(field.name).unwrap_or(0.0) as u32);
        }
        let read = table.required(field.name, Number::not_negative("")).and_then(|number| {
            if number.fract() == 0.0 && number <= f64::from(u32::MAX) {
                Ok(number as u32)
            } else {
                let help = format!("`{}` of {} must be a whole number", field.name, table.label());
                Err(table.refuse_value(field.name, "is not a whole number", help))
            }
        });
        self.keep(read)
    }

    fn points(&mut self, field: &Field) -> Option<[[f64; 3]; 2]> {
        let (assembly, pair) = (self.assembly, self.pair);
        if let Some(place) = self.of.place() {
            let point = |body| assembly.point_in(body, place.at_w).to_f64();
            return Some([pair.a, pair.b].map(point));
        }
        if let Of::Spring(points, _) | Of::Winch(points, ..) = self.of {
            return Some(points);
        }
        let read = self.table.required(field.name, TwoPlaces { assembly, pair });
        self.keep(read)
    }

    fn normal(&mut self, field: &Field) -> Option<[f64; 3]> {
        self.heading(field).map(|normal| normal.to_f64())
    }

    fn axis(&mut self, field: &Field) -> Option<([f64; 3], [f64; 4])> {
        let axis = self.heading(field)?;
        let orientation = |body| self.assembly.state(body).map(|state| &state.orientation);
        let [a, b] = [self.pair.a, self.pair.b].map(orientation);
        Some((axis.to_f64(), Quaternion::relative(a, b).conjugate().to_f64()))
    }

    fn table(&mut self, field: &Field, to: &mut [[f64; 2]]) -> Option<usize> {
        let kind = Knots { units: [unit(field, 0), unit(field, 1)], most: to.len() };
        let read = match field.default {
            Some(value) => self
                .table
                .optional(field.name, kind)
                .map(|given| given.unwrap_or_else(|| vec![[0.0, value], [1.0, value]])),
            None => self.table.required(field.name, kind),
        };
        let knots = self.keep(read)?;
        to.iter_mut().zip(&knots).for_each(|(place, knot)| *place = *knot);
        Some(knots.len())
    }

    fn matrix(&mut self, field: &Field) -> Option<Ldl<f64>> {
        let units = [0, 1, 2, 3].map(|row| unit(field, row));
        let read = self.table.required(field.name, Definite { units });
        self.keep(read)
    }

    fn terms(&mut self, _: &Field) -> Option<[Option<Term>; MAX_TERMS]> {
        if let Of::Coupling(terms, _) = &self.of { Some(**terms) } else { None }
    }
}

/// A point of the first body and one of the second, each in its body's axes.
pub(super) struct TwoPlaces<'a> {
    pub(super) assembly: &'a Assembly,
    pub(super) pair: &'a Pair,
}

impl Kind for TwoPlaces<'_> {
    type Output = [[f64; 3]; 2];

    fn expected(&self) -> String {
        "two points in m, [[x, y, z], [x, y, z]], each in the axes of its body, or names of points"
            .into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let Self { assembly, pair } = *self;
        let mut points = [[0.0; 3]; 2];
        let entries = value.entries(2, || self.expected())?;
        for ((point, entry), body) in points.iter_mut().zip(entries).zip([pair.a, pair.b]) {
            *point = PlaceOf { assembly, body }.read(&entry)?.to_f64();
        }
        Ok(points)
    }
}

/// Knots with ascending x.
struct Knots {
    units: [&'static str; 2],
    most: usize,
}

impl Kind for Knots {
    type Output = Vec<[f64; 2]>;

    fn expected(&self) -> String {
        let [x, y] = self.units.map(|unit| if unit.is_empty() { "1" } else { unit });
        format!("2 to {} knots [x in {x}, y in {y}] with ascending x", self.most)
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let entries = value.array(|| self.expected())?;
        if entries.len() < 2 || entries.len() > self.most {
            let problem = format!("has {} knots", entries.len());
            return Err(value.refuse(&problem, &self.expected()));
        }
        let mut knots: Vec<[f64; 2]> = Vec::new();
        for entry in entries {
            let [x, y] = [0, 1].map(|row| Number::any(self.units[row]));
            let pair = entry.entries(2, || self.expected())?;
            let knot = [x.read(&pair[0])?, y.read(&pair[1])?];
            if knots.last().is_some_and(|last| last[0] >= knot[0]) {
                return Err(
                    entry.refuse("has an x not above that of the knot before", &self.expected())
                );
            }
            knots.push(knot);
        }
        Ok(knots)
    }
}

/// A symmetric positive semi-definite matrix of six rows.
struct Definite {
    /// The units of its four blocks, row by row.
    units: [&'static str; 4],
}

impl Kind for Definite {
    type Output = Ldl<f64>;

    fn expected(&self) -> String {
        let [a, b, c, d] = self.units;
        format!(
            "a symmetric positive semi-definite matrix of 6 rows of 6 numbers in {a}, {b}; {c}, {d}"
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<Ldl<f64>, SceneError> {
        let rows = value.entries(6, || self.expected())?;
        let mut matrix = [[0.0; 6]; 6];
        for (i, (row, to)) in rows.iter().zip(&mut matrix).enumerate() {
            for (j, (entry, to)) in row.entries(6, || self.expected())?.iter().zip(to).enumerate() {
                *to = Number::any(self.units[2 * (i / 3) + j / 3]).read(entry)?;
            }
        }
        if let Some([row, column]) = Ldl::asymmetry(&matrix) {
            let problem = format!(
                "is not symmetric: its entry [{row}][{column}] differs from [{column}][{row}]"
            );
            return Err(rows[row].refuse(&problem, &self.expected()));
        }
        Ldl::of(&matrix)
            .ok_or_else(|| value.refuse("is not positive semi-definite", &self.expected()))
    }
}
