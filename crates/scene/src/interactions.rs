//! Interactions of a scene: laws, bodies, geometry, and state at t = 0.
//!
//! `scene => interactions`. Geometry and numbers are those which a law writes to a [`FieldSink`].

use dbd_kernel::laws::{
    CoordinateKind, Field, FieldSink, Instant, Laws as _, Ldl, MAX_TERMS, Row, Term,
};
use dbd_kernel::{BodyIndex, F64, Geometry as _, State};

use crate::facts;
use crate::scene::Scene;

/// An interaction of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct InteractionInfo {
    /// Its label in messages: "interaction `stop` (world–bar)".
    pub label: String,
    /// The name of its law.
    pub law: &'static str,
    /// A, which may be the ground, and B.
    pub bodies: [BodyIndex; 2],
    /// The bodies of a coupling other than those of its first joint.
    pub further: Vec<BodyIndex>,
    /// The number of its dampers; some may have a coefficient of 0.
    pub dampers: usize,
    /// \[m\] a point of A and a point of B, each in body axes from the centre of mass; in the world for the ground.
    pub points: Option<[[f64; 3]; 2]>,
    /// \[1\] unit normal of a plane through the first point, in the axes of A.
    pub normal: Option<[f64; 3]>,
    /// \[1\] unit axis, in the axes of A.
    pub axis: Option<[f64; 3]>,
    /// The numbers of its law by name, as given; units as in [`KnownLaw::fields`](crate::laws::KnownLaw::fields).
    pub numbers: Vec<(&'static str, f64)>,
    /// The terms of a coupling.
    pub terms: Vec<Term>,
}

impl InteractionInfo {
    /// A number of its law, 0 where it has none of this name.
    #[must_use]
    pub fn number(&self, name: &str) -> f64 {
        self.numbers.iter().find(|(of, _)| *of == name).map_or(0.0, |(_, number)| *number)
    }

    /// Its name in the scene, if any.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        let (_, rest) = self.label.split_once(" `")?;
        rest.rsplit_once("` (").map(|(name, _)| name)
    }
}

/// State of an interaction at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AtStart {
    /// Its quantity `depth` with its unit, if any.
    pub(crate) depth: Option<(f64, &'static str)>,
    /// \[N\] magnitude of its force.
    pub(crate) force: f64,
    /// \[N·m\] magnitude of its torque on B.
    pub(crate) torque: f64,
}

/// The interactions in the order of the model's rows of laws.
#[must_use]
pub fn interactions(scene: &Scene) -> Vec<InteractionInfo> {
    let mut found = Vec::new();
    for (source, dampers) in scene.model.laws.tables_with_dampers() {
        for (row, bodies) in source.bodies().into_iter().enumerate() {
            let label = scene.law_names.get(found.len()).cloned().unwrap_or_default();
            let mut shape = Shape::default();
            source.write(row, &mut shape);
            let Shape { points, normal, axis, mut further, numbers, terms } = shape;
            further.retain(|body| !bodies.contains(body));
            let law = source.name();
            found.push(InteractionInfo {
                label,
                law,
                bodies,
                further,
                dampers,
                points,
                normal,
                axis,
                numbers,
                terms,
            });
        }
    }
    found
}

/// State of each interaction at t = 0.
pub(crate) fn interactions_at_start(scene: &Scene) -> Vec<AtStart> {
    let (frames, bodies) = (facts::frames(scene), &scene.model.initial);
    let signals = State::initial(&scene.model).signals;
    let instant = Instant { frames: &frames, bodies, signals: &signals };
    let laws = &scene.model.laws;
    let mut found = Vec::new();
    laws.look_at_all(&laws.states(), &mut |_, law| found.push(at_start(law, instant)));
    found
}

fn at_start(law: &mut dyn Row<F64>, instant: Instant<'_, F64>) -> AtStart {
    let mut start = AtStart { depth: None, force: 0.0, torque: 0.0 };
    let Some(seen) = law.seen(instant) else { return start };
    let quantities = law.quantities().iter().enumerate();
    start.depth = quantities
        .filter(|(_, quantity)| quantity.name == "depth")
        .map(|(place, quantity)| (law.read(place, &seen), quantity.unit))
        .next();
    if let Some(force_pair) = law.force_pair(&seen) {
        let length = |v: dbd_kernel::Vec3<f64>| libm::sqrt(v.dot(v));
        (start.force, start.torque) = (length(force_pair.force), length(force_pair.torque_b));
    }
    start
}

/// Collects the geometry and the numbers of a row.
#[derive(Default)]
struct Shape {
    points: Option<[[f64; 3]; 2]>,
    normal: Option<[f64; 3]>,
    axis: Option<[f64; 3]>,
    further: Vec<BodyIndex>,
    numbers: Vec<(&'static str, f64)>,
    terms: Vec<Term>,
}

impl FieldSink for Shape {
    fn number(&mut self, field: &Field, value: f64) {
        self.numbers.push((field.name, value));
    }
    fn count(&mut self, _: &Field, _: u32) {}
    fn points(&mut self, _: &Field, points: [[f64; 3]; 2]) {
        self.points.get_or_insert(points);
    }
    fn normal(&mut self, _: &Field, normal: [f64; 3]) {
        self.normal.get_or_insert(normal);
    }
    fn axis(&mut self, _: &Field, axis: [f64; 3], _: [f64; 4]) {
        self.axis.get_or_insert(axis);
    }
    fn table(&mut self, _: &Field, _: &[[f64; 2]], _: usize) {}
    fn matrix(&mut self, _: &Field, _: &Ldl<f64>) {}
    // It is drawn at its first joint.
    fn terms(&mut self, field: &Field, terms: &[Option<Term>; MAX_TERMS]) {
        self.terms = terms.iter().flatten().copied().collect();
        for body in terms.iter().flatten().flat_map(|term| term.bodies) {
            if !body.is_world() && !self.further.contains(&body) {
                self.further.push(body);
            }
        }
        match &terms[0] {
            Some(Term { way: CoordinateKind::Turn(hinge), .. }) => {
                self.axis(field, hinge.axis.to_f64(), hinge.reference.to_f64());
            }
            Some(Term { way: CoordinateKind::Travel { points, axis }, .. }) => {
                self.points(field, points.map(|point| F64::local_to_f64(&point)));
                self.normal(field, axis.to_f64());
            }
            None => {}
        }
    }
}
