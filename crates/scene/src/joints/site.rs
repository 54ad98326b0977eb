//! Position of a joint on its two bodies.
//!
//! `table => position and axes of each half, world, at the given poses => position of the joint`. The data of a half
//! move with its body.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Resolved};
use crate::between::Between;
use crate::closure::{Closure, Opening, Place, Pose, Turn, length};
use crate::direction::{least_aligned, normals};
use crate::error::SceneError;
use crate::joints::kind::{Joint, JointType, Realisation};
use crate::joints::universal::Axes;
use crate::orientation::of_axes;
use crate::pair::Pair;
use crate::points::{Heading, Place as NamedPlace};
use crate::spring::Spring;
use crate::text::{Kind, Table, Value};

/// \[m, rad\] largest gap of a joint without [assemble]: the scene gives at least 9 digits.
const CLOSED: f64 = 1e-9;

/// A joint's halves, world, at the given poses.
pub(super) struct Site {
    pub(super) pair: Pair,
    asks: (Place, Turn),
    at: [Vec3<f64>; 2],
    axes: [Vec3<f64>; 2],
    references: Option<[Vec3<f64>; 2]>,
    /// Whether the halves give different values where they must agree.
    is_double: bool,
}

impl Site {
    /// Reads the bodies, `at` and the axes of a type of joint.
    pub(super) fn read(
        table: &Table<'_>,
        kind: &JointType,
        assembly: &Assembly,
    ) -> Result<Self, SceneError> {
        let pair = table.required("between", Between(assembly))?;
        let half = |body| PlaceOfHalf { assembly, body };
        let at = table.required("at", Halves([half(pair.a), half(pair.b)]))?;
        let axes = match () {
            () if kind.keys.contains(&"axes") => table.required("axes", Axes(assembly))?,
            () if kind.keys.contains(&"axis") => {
                table.required("axis", Halves([Heading(assembly); 2]))?
            }
            () => [Vec3::new(0.0, 0.0, 1.0); 2],
        };
        let references = table.optional("reference", Halves([Heading(assembly); 2]))?;
        let differ = |[a, b]: [Vec3<f64>; 2]| a != b;
        let is_double = differ(at)
            || (kind.keys.contains(&"axis") && differ(axes))
            || references.is_some_and(differ);
        Ok(Self { pair, asks: kind.asks, at, axes, references, is_double })
    }

    /// The closure of the joint.
    pub(super) fn closure(&self, assembly: &Assembly) -> Closure {
        let ends = [self.pair.a, self.pair.b];
        let references = self.references.unwrap_or_else(|| self.default_references());
        let triads = [0, 1].map(|end| {
            let (axis, reference) = (self.axes[end], references[end]);
            // A reference along the axis is rejected when the joint is expanded.
            let across = normals(axis, reference).or_else(|| normals(axis, least_aligned(axis)));
            let [e1, e2] = across.unwrap_or([axis; 2]);
            let triad = [e1, e2, axis].map(|e| assembly.vector_in(ends[end], e));
            dbd_kernel::Quaternion::from_f64(of_axes(triad))
        });
        let points = [0, 1].map(|end| assembly.point_in(ends[end], self.at[end]));
        Closure { ends, place: self.asks.0, turn: self.asks.1, points, triads }
    }

    /// For the first half the world axis least aligned; for the second the same rotated by the shortest rotation from
    /// axis to axis.
    fn default_references(&self) -> [Vec3<f64>; 2] {
        let [n, m] = self.axes;
        let first = least_aligned(n);
        let cosine = n.dot(m);
        if n == m || cosine < -1.0 + 1e-12 {
            return [first; 2];
        }
        // Rodrigues formula for the rotation n × m.
        let turn = n.cross(m);
        let second = first * cosine + turn.cross(first) + turn * (turn.dot(first) / (1.0 + cosine));
        [first, second]
    }

    /// The joint at the present poses of its bodies; it is open if it has not been closed.
    pub(super) fn joint(
        self,
        table: &Table<'_>,
        name: String,
        spring: Spring,
        assembly: &Assembly,
    ) -> Result<Joint, SceneError> {
        let Pair { a, b, .. } = self.pair;
        if self.is_double && !assembly.is_assembled() {
            self.refuse_open(table, assembly)?;
        }
        let [p, q] = [assembly.carried_point(a, self.at[0]), assembly.carried_point(b, self.at[1])];
        let second = if self.asks.1 == Turn::Across { b } else { a };
        let axes = [
            assembly.carried_direction(a, self.axes[0]),
            assembly.carried_direction(second, self.axes[usize::from(second == b)]),
        ];
        // A sliding joint is at the position of the second body, to which its points belong.
        let at_w =
            if self.asks.0 == Place::Line && p != q { p + axes[0] * axes[0].dot(q - p) } else { p };
        let reference = self.references.map(|[first, _]| assembly.carried_direction(a, first));
        self.resolve(table, assembly, at_w, axes, reference);
        let realisation = Realisation::default();
        Ok(Joint { name, pair: self.pair, at_w, axes, reference, spring, realisation })
    }

    /// Values of the long form: one position and one direction each, at the present poses.
    fn resolve(
        &self,
        table: &Table<'_>,
        assembly: &Assembly,
        at_w: Vec3<f64>,
        axes: [Vec3<f64>; 2],
        reference: Option<Vec3<f64>>,
    ) {
        let has_moved = [self.pair.a, self.pair.b].iter().any(|end| assembly.has_moved(end.row()));
        if !(has_moved || self.is_double) {
            return;
        }
        let resolve = |key, resolved| {
            if let Some(value) = table.value(key) {
                assembly.resolve(&value, resolved);
            }
        };
        resolve("at", Resolved::Point(at_w));
        resolve("axis", Resolved::Direction(axes[0]));
        resolve("axes", Resolved::Directions(axes));
        if let Some(reference) = reference {
            resolve("reference", Resolved::Direction(reference));
        }
    }

    fn refuse_open(&self, table: &Table<'_>, assembly: &Assembly) -> Result<(), SceneError> {
        let poses: Vec<_> = poses(assembly);
        let opening = self.closure(assembly).opening(&poses);
        if opening.distance <= CLOSED && opening.angle <= CLOSED {
            return Ok(());
        }
        let problem = format!("is open by {} at the given poses", shown(opening));
        let help = "add a table [assemble], which moves the bodies until all joints are closed, or \
                    give poses at which the halves meet";
        Err(table.refuse(&problem, help))
    }
}

/// The poses of all bodies.
pub(super) fn poses(assembly: &Assembly) -> Vec<Pose> {
    assembly.states().iter().map(|state| Pose::new(state.position, state.orientation)).collect()
}

/// `0.0012 m and 0.3 rad`.
pub(super) fn shown(Opening { distance, angle }: Opening) -> String {
    let short = |value: f64| {
        let text = format!("{value:.2e}");
        text.parse::<f64>().map_or(text, |rounded| match rounded {
            r if r == 0.0 || (1e-3..1e4).contains(&r) => format!("{r}"),
            r => format!("{r:e}"),
        })
    };
    match (distance > 0.0, angle > 0.0) {
        (true, true) => format!("{} m and {} rad", short(distance), short(angle)),
        (false, true) => format!("{} rad", short(angle)),
        _ => format!("{} m", short(distance)),
    }
}

/// A common value of both halves of a joint, or `{ first, second }`.
#[derive(Clone, Copy)]
struct Halves<K>([K; 2]);

impl<K: Kind> Kind for Halves<K> {
    type Output = [K::Output; 2];

    fn expected(&self) -> String {
        let one = self.0[0].expected();
        format!("{one}, or {{ first = …, second = … }} with one for each body")
    }

    fn read(&self, value: &Value<'_>) -> Result<[K::Output; 2], SceneError> {
        let Self([first, second]) = self;
        if !(value.get().is_array() || value.get().is_str() || value.get().is_table()) {
            return Err(value.wrong_type(&self.expected()));
        }
        if !is_halves(value) {
            return Ok([first.read(value)?, second.read(value)?]);
        }
        let table = value.table(&self.expected())?;
        table.only(&[HALVES])?;
        let half = |key: &str, kind: &K| match table.value(key) {
            Some(value) => kind.read(&value),
            None => Err(table.missing(key, &kind.expected())),
        };
        Ok([half("first", first)?, half("second", second)?])
    }
}

/// The keys of a value given for each body.
pub(super) const HALVES: &[&str] = &["first", "second"];

/// Position of a half of a joint, world at the given poses: for a named end of the body the position of that end.
#[derive(Clone, Copy)]
struct PlaceOfHalf<'a> {
    assembly: &'a Assembly,
    body: dbd_kernel::BodyIndex,
}

impl Kind for PlaceOfHalf<'_> {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        NamedPlace(self.assembly).expected()
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        /// \[m\] an end this near to its point coincides with it.
        const THERE: f64 = 1e-12;
        let point = NamedPlace(self.assembly).read(value)?;
        let end = value.get().as_str().and_then(|name| self.assembly.end(self.body, name));
        let Some(end) = end else { return Ok(point) };
        let end = self.assembly.given_place(self.body, end);
        let is_there = length(end - point) <= THERE * (1.0 + length(point));
        Ok(if is_there { point } else { end })
    }
}

fn is_halves(value: &Value<'_>) -> bool {
    let has = |key| value.get().get(key).is_some();
    value.get().is_table() && (has("first") || has("second"))
}
