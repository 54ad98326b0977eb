//! `[[coupling]]`: a spring that acts on a weighted sum of joint coordinates.
//!
//! `(table, joints) => terms and constants of the law`. The sum has the unit of its first coordinate.

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::laws::{CoordinateKind, MAX_TERMS, Quantity, Term};
use dbd_kernel::{Quaternion, Vec3};

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::interaction::common::Constants;
use crate::joints::JointPlace;
use crate::known::freedom;
use crate::pair::Pair;
use crate::target::Elements;
use crate::text::{Choice, Kind, Number, Table, Value};

/// The keys of a coupling.
pub(crate) const KEYS: &[&str] = &["name", "of", "offset", "stiffness", "damping", "play", "acts"];

/// The keys of a term.
pub(crate) const TERM: &[&str] = &["joint", "freedom", "factor"];

/// Quantities of a coupling of translations.
const OF_TRAVELS: &[Quantity] =
    &[Quantity { name: "load", unit: "N" }, Quantity { name: "stretch", unit: "m" }];

/// A coupling as read.
pub(super) struct Coupled<'j> {
    /// The bodies of its first joint.
    pub(super) pair: &'j Pair,
    /// The names of its joints.
    pub(super) joints: Vec<&'j str>,
    pub(super) terms: [Option<Term>; MAX_TERMS],
    pub(super) constants: Constants,
    /// Its quantities if they differ from those of the law.
    pub(super) quantities: Option<&'static [Quantity]>,
}

impl<'j> Coupled<'j> {
    pub(super) fn read(
        table: &Table<'_>,
        (places, elements): (&'j [JointPlace], &Elements),
        assembly: &Assembly,
    ) -> Result<Self, SceneError> {
        table.only(&[KEYS])?;
        let read: Vec<Read<'j>> = table.required("of", Of { places, elements })?;
        let turns = read[0].turns;
        let [unit, stiffness, damping] =
            if turns { ["rad", "N·m/rad", "N·m·s/rad"] } else { ["m", "N/m", "N·s/m"] };
        let mut constants = Constants::default();
        constants.add("stiffness", table.required("stiffness", Number::positive(stiffness))?);
        for (key, kind) in [
            ("damping", Number::not_negative(damping)),
            ("offset", Number::any(unit)),
            ("play", Number::not_negative(unit)),
        ] {
            if let Some(number) = table.optional(key, kind)? {
                constants.add(key, number);
            }
        }
        sides(table, &mut constants)?;
        let mut terms = [None; MAX_TERMS];
        for (term, read) in terms.iter_mut().zip(&read) {
            *term = Some(read.term(assembly));
        }
        Ok(Self {
            pair: &read[0].place.pair,
            joints: read.iter().map(|read| read.place.name.as_str()).collect(),
            terms,
            constants,
            quantities: (!turns).then_some(OF_TRAVELS),
        })
    }
}

/// Reads `acts`, the side on which a spring has tension.
pub(super) fn sides(table: &Table<'_>, constants: &mut Constants) -> Result<(), SceneError> {
    match table.optional("acts", Choice(&["tension", "compression"]))? {
        Some(0) => constants.add("pushes", 0.0),
        Some(_) => constants.add("pulls", 0.0),
        None => {}
    }
    Ok(())
}

/// A term as read.
struct Read<'j> {
    place: &'j JointPlace,
    turns: bool,
    factor: f64,
}

impl Read<'_> {
    fn term(&self, assembly: &Assembly) -> Term {
        let Self { place, turns, factor } = *self;
        let bodies = [place.pair.a, place.pair.b];
        let [a, b] = bodies;
        let axis: Vec3<f64> = assembly.vector_in(a, place.axis_w);
        let way = if turns {
            let orientation = |body| assembly.state(body).map(|state| &state.orientation);
            let reference = Quaternion::relative(orientation(a), orientation(b)).conjugate();
            CoordinateKind::Turn(dbd_kernel::laws::Hinge { axis, reference })
        } else {
            CoordinateKind::Travel {
                points: bodies.map(|body| assembly.point_in(body, place.at_w)),
                axis,
            }
        };
        Term { bodies, factor, way }
    }
}

/// The coordinates of a coupling.
struct Of<'j, 'e> {
    places: &'j [JointPlace],
    elements: &'e Elements,
}

impl<'j> Kind for Of<'j, '_> {
    type Output = Vec<Read<'j>>;

    fn expected(&self) -> String {
        "one to three joints, [{ joint = \"…\" }, { joint = \"…\", factor = … }]".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let entries = value.array(|| self.expected())?;
        if !(1..=MAX_TERMS).contains(&entries.len()) {
            let problem = format!("has {} coordinates", entries.len());
            return Err(value.refuse(&problem, &self.expected()));
        }
        let mut read: Vec<Read<'j>> = Vec::new();
        for entry in &entries {
            let table = entry.table("{ joint = \"…\", factor = … }")?;
            table.only(&[TERM])?;
            let (place, turns) =
                freedom(&table, "joint", (self.places, self.elements), "a coupling")?;
            let known = |read: &&Read<'_>| read.place.name == place.name && read.turns == turns;
            if read.iter().find(known).is_some() {
                let problem = format!("names `{}` a second time", place.name);
                let help = "name each coordinate once, with the sum of its factors";
                return Err(table.refuse_value("joint", &problem, help));
            }
            let unit = match read.first().map(|first| first.turns) {
                Some(true) if !turns => "rad/m",
                Some(false) if turns => "m/rad",
                _ => "",
            };
            let kind = Number::any(unit);
            let factor = match read.is_empty() {
                true => table.optional("factor", kind)?.unwrap_or(1.0),
                false => table.required("factor", kind)?,
            };
            if factor == 0.0 {
                let help =
                    "give the factor of the coordinate in the sum, for example -3 for a 3 : 1 gear";
                return Err(table.refuse_value("factor", "is 0", help));
            }
            read.push(Read { place, turns, factor });
        }
        Ok(read)
    }
}
