//! Laws in a plane: their constants one by one.
//!
//! `scene, plane => laws in the plane, what leaves it`.

use std::collections::VecDeque;
use std::sync::Arc;

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::laws::{
    CoordinateKind, Field, FieldSink, FieldSource, Hinge, Ldl, MAX_TERMS, Term,
};
use dbd_kernel::{BodyIndex, F64, Geometry as _, Quaternion, Vec3};

use crate::laws::LawList;
use crate::planar::{ALIKE, Plane, short};
use crate::reduction::departure::{Leaves, Part};
use crate::reduction::driven::axis_error;
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// Adds the laws.
pub(super) fn read(
    scene: &Scene,
    plane: &Plane,
    near: f64,
    model: &mut SceneModel<F64>,
    leaves: &mut Leaves<'_>,
) {
    let mut sources = Vec::new();
    let mut first = 0;
    for source in scene.model.laws.sources() {
        let mut table = source.empty();
        for (row, bodies) in source.bodies().into_iter().enumerate() {
            let mut flat = Flat { plane, near, bodies, model, known: VecDeque::new(), off: None };
            source.write(row, &mut flat);
            if let Some((key, by)) = flat.off.take() {
                leaves(Part::Law(first + row), key, &by);
            }
            table.add(bodies, &mut flat);
        }
        first += source.bodies().len();
        sources.push(Arc::from(table));
    }
    model.laws = LawList::of(&sources);
}

enum Known {
    Number(f64),
    Count(u32),
    Points([[f64; 3]; 2]),
    Normal([f64; 3]),
    Axis([f64; 3], [f64; 4]),
    Table(Vec<[f64; 2]>),
    Matrix(Box<Ldl<f64>>),
    Terms(Box<[Option<Term>; MAX_TERMS]>),
}

/// Rows of a matrix of six that are in the plane, and the others.
const IN_PLANE: [usize; 3] = [0, 1, 5];
const ACROSS: [usize; 3] = [2, 3, 4];

/// Converts the constants of a row from space to the plane.
struct Flat<'s> {
    plane: &'s Plane,
    /// \[m\] tolerance of coincident points.
    near: f64,
    bodies: [BodyIndex; 2],
    /// The model in the plane, whose bodies are known.
    model: &'s SceneModel<F64>,
    known: VecDeque<Known>,
    /// The first constant that leaves the plane, and by how much.
    off: Option<(&'static str, String)>,
}

impl Flat<'_> {
    fn leaves(&mut self, field: &Field, by: String) {
        self.off.get_or_insert((field.name, by));
    }

    fn points_of(&mut self, field: &Field, points: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        let [a, b] = self.bodies.map(BodyIndex::row);
        let inward = |row, point| self.plane.point_inward(row, Vec3::from_f64(point)).to_f64();
        let [first, second] = [inward(a, points[0]), inward(b, points[1])];
        for z in [first[2], second[2]] {
            if z.abs() > self.near {
                self.leaves(field, format!(" by {} m", short(z)));
            }
        }
        [first, second].map(|[x, y, _]| [x, y, 0.0])
    }

    fn normal_of(&mut self, field: &Field, normal: [f64; 3]) -> [f64; 3] {
        let a = self.bodies[0].row();
        let [x, y, z] = self.plane.of_body_inward(a, Vec3::from_f64(normal)).to_f64();
        if z.abs() > ALIKE {
            let degrees = libm::asin(z.abs().min(1.0)).to_degrees();
            self.leaves(field, format!(": it is tilted by {} degrees", short(degrees)));
        }
        [x, y, 0.0]
    }

    fn axis_of(&mut self, field: &Field, axis: [f64; 3]) -> ([f64; 3], [f64; 4]) {
        let [a, b] = self.bodies;
        let axis = self.plane.of_body_inward(a.row(), Vec3::from_f64(axis));
        if let Some(axis_error) = axis_error(axis) {
            self.leaves(
                field,
                format!(": it is tilted by {} degrees from the normal", short(axis_error)),
            );
        }
        let orientation =
            |body: BodyIndex| self.model.initial.get(body.row()).map(|state| &state.orientation);
        let reference = Quaternion::relative(orientation(a), orientation(b)).conjugate().to_f64();
        ([0.0, 0.0, if axis.z < 0.0 { -1.0 } else { 1.0 }], reference)
    }
}

impl FieldSink for Flat<'_> {
    fn number(&mut self, _: &Field, value: f64) {
        self.known.push_back(Known::Number(value));
    }
    fn count(&mut self, _: &Field, value: u32) {
        self.known.push_back(Known::Count(value));
    }
    fn points(&mut self, field: &Field, points: [[f64; 3]; 2]) {
        let flat = self.points_of(field, points);
        self.known.push_back(Known::Points(flat));
    }
    fn normal(&mut self, field: &Field, normal: [f64; 3]) {
        let flat = self.normal_of(field, normal);
        self.known.push_back(Known::Normal(flat));
    }
    fn axis(&mut self, field: &Field, axis: [f64; 3], _: [f64; 4]) {
        let (axis, reference) = self.axis_of(field, axis);
        self.known.push_back(Known::Axis(axis, reference));
    }
    fn table(&mut self, _: &Field, knots: &[[f64; 2]], _: usize) {
        self.known.push_back(Known::Table(knots.to_vec()));
    }
    fn matrix(&mut self, field: &Field, matrix: &Ldl<f64>) {
        let entries = matrix.matrix();
        // Displacements along x and y and the rotation about z are in the plane.
        for (row, column) in IN_PLANE.iter().flat_map(|row| ACROSS.map(|column| (*row, column))) {
            let size = entries[row][row] * entries[column][column];
            let coupling = entries[row][column];
            if coupling * coupling > ALIKE * ALIKE * size {
                self.leaves(field, format!(": its entry [{row}][{column}] is not 0"));
            }
        }
        self.known.push_back(Known::Matrix(Box::new(*matrix)));
    }
    fn terms(&mut self, field: &Field, terms: &[Option<Term>; MAX_TERMS]) {
        let own = self.bodies;
        let flat = terms.map(|term| {
            let Term { bodies, factor, way } = term?;
            self.bodies = bodies;
            let way = match way {
                CoordinateKind::Turn(hinge) => {
                    let (axis, reference) = self.axis_of(field, hinge.axis.to_f64());
                    let axis = Vec3::from_f64(axis);
                    CoordinateKind::Turn(Hinge { axis, reference: Quaternion::from_f64(reference) })
                }
                CoordinateKind::Travel { points, axis } => {
                    let points = points.map(|point| F64::local_to_f64(&point));
                    CoordinateKind::Travel {
                        points: self.points_of(field, points).map(F64::local_from_f64),
                        axis: Vec3::from_f64(self.normal_of(field, axis.to_f64())),
                    }
                }
            };
            Some(Term { bodies, factor, way })
        });
        self.bodies = own;
        self.known.push_back(Known::Terms(Box::new(flat)));
    }
}

impl FieldSource for Flat<'_> {
    fn number(&mut self, _: &Field) -> Option<f64> {
        if let Known::Number(value) = self.known.pop_front()? { Some(value) } else { None }
    }
    fn count(&mut self, _: &Field) -> Option<u32> {
        if let Known::Count(value) = self.known.pop_front()? { Some(value) } else { None }
    }
    fn points(&mut self, _: &Field) -> Option<[[f64; 3]; 2]> {
        if let Known::Points(points) = self.known.pop_front()? { Some(points) } else { None }
    }
    fn normal(&mut self, _: &Field) -> Option<[f64; 3]> {
        if let Known::Normal(normal) = self.known.pop_front()? { Some(normal) } else { None }
    }
    fn axis(&mut self, _: &Field) -> Option<([f64; 3], [f64; 4])> {
        match self.known.pop_front()? {
            Known::Axis(axis, reference) => Some((axis, reference)),
            _ => None,
        }
    }
    fn table(&mut self, _: &Field, to: &mut [[f64; 2]]) -> Option<usize> {
        let Known::Table(knots) = self.known.pop_front()? else { return None };
        to.iter_mut().zip(&knots).for_each(|(place, knot)| *place = *knot);
        Some(knots.len())
    }
    fn matrix(&mut self, _: &Field) -> Option<Ldl<f64>> {
        if let Known::Matrix(matrix) = self.known.pop_front()? { Some(*matrix) } else { None }
    }
    fn terms(&mut self, _: &Field) -> Option<[Option<Term>; MAX_TERMS]> {
        if let Known::Terms(terms) = self.known.pop_front()? { Some(*terms) } else { None }
    }
}
