//! A model's laws as Rust expressions.
//!
//! `(laws, precision) => type of the list, its rows`. Every number is its bit pattern.

use dbd_kernel::laws::{Field, FieldSink};
use dbd_kernel::space::{Linear as _, Space, Turn as _};
use dbd_kernel::{BodyIndex, Geometry, Real as _};

use super::number::{SourceGeometry, SourceNumber as _};
use super::rows::index;
use crate::laws::LawList;

/// The type of the list: `([dbd_kernel::laws::EndStop<F32>; 1],)`.
pub(super) fn types<P: SourceGeometry>(laws: &LawList<P>) -> String {
    let table = |source: &std::sync::Arc<dyn crate::laws::SourceRows>| {
        format!("[{}<{}>; {}],", source.path(), P::name(), source.bodies().len())
    };
    format!("({})", laws.sources().iter().map(table).collect::<Vec<_>>().join(" "))
}

/// The list.
pub(super) fn rows<P: SourceGeometry>(laws: &LawList<P>) -> String {
    let mut text = String::from("(");
    for source in laws.sources() {
        text += "[\n";
        for (row, bodies) in source.bodies().into_iter().enumerate() {
            let [a, b] = bodies.map(|body: BodyIndex| index(body));
            let mut fields = Fields::<P> { text: String::new(), precision: Default::default() };
            source.write(row, &mut fields);
            text +=
                &format!("        {} {{ bodies: [{a}, {b}], {} }},\n", source.path(), fields.text);
        }
        text += "    ],";
    }
    text + ")"
}

struct Fields<P> {
    text: String,
    precision: std::marker::PhantomData<P>,
}

impl<P: SourceGeometry> Fields<P> {
    fn push(&mut self, field: &Field, value: &str) {
        if !self.text.is_empty() {
            self.text += ", ";
        }
        self.text += &format!("{}: {value}", field.name);
    }
}

fn number<P: SourceGeometry>(value: f64) -> String {
    P::Real::from_f64(value).number()
}

impl<P: SourceGeometry> FieldSink for Fields<P> {
    fn number(&mut self, field: &Field, value: f64) {
        self.push(field, &number::<P>(value));
    }
    fn count(&mut self, field: &Field, value: u32) {
        let text = match field.kind {
            "signal" => format!("dbd_kernel::index::InputIndex({value})"),
            _ => value.to_string(),
        };
        self.push(field, &text);
    }
    fn points(&mut self, field: &Field, points: [[f64; 3]; 2]) {
        let [a, b] = points.map(|point| P::local(&P::local_from_f64(point)));
        self.push(field, &format!("[{a}, {b}]"));
    }
    fn normal(&mut self, field: &Field, normal: [f64; 3]) {
        self.push(field, &P::vector(&P::Vector::from_f64(normal)));
    }
    fn axis(&mut self, field: &Field, axis: [f64; 3], reference: [f64; 4]) {
        let axis = P::moment(&<P as Geometry>::Moment::from_f64(axis));
        let reference = P::turn(&<P::Space as Space>::Turn::from_f64(reference));
        let hinge = format!("dbd_kernel::laws::Hinge {{ axis: {axis}, reference: {reference} }}");
        self.push(field, &hinge);
    }
    fn table(&mut self, field: &Field, knots: &[[f64; 2]], capacity: usize) {
        let none = [[0.0; 2]];
        let all = knots.iter().chain(none.iter().cycle().take(capacity - knots.len()));
        let all = all.map(|[x, y]| format!("[{}, {}]", number::<P>(*x), number::<P>(*y)));
        let all = all.collect::<Vec<_>>().join(", ");
        let count = knots.len();
        self.push(field, &format!("dbd_kernel::laws::Curve {{ knots: [{all}], count: {count} }}"));
    }
}
