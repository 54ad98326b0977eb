//! A model's laws as Rust expressions.
//!
//! `(laws, precision) => type of the list, its rows`. Every number is its bit pattern.

use dbd_kernel::laws::{CoordinateKind, Field, FieldSink, Ldl, MAX_TERMS, Term};
use dbd_kernel::space::{Linear as _, Space, Turn as _};
use dbd_kernel::{BodyIndex, F64, Geometry, Real as _};

use super::number::{SourceGeometry, SourceNumber as _};
use super::rows::index;
use crate::laws::LawList;

/// The most tables of a tuple that is a list of laws, see [`dbd_kernel::laws::Laws`].
const MOST_TABLES: usize = 8;

/// A list of laws: a tuple of tables, and the rest in a tuple in its last place where there are more.
fn tuple(tables: &[String]) -> String {
    match tables.split_at_checked(MOST_TABLES - 1) {
        Some((first, rest)) if rest.len() > 1 => format!("({} {})", first.join(" "), tuple(rest)),
        _ => format!("({})", tables.join(" ")),
    }
}

/// The type of the list: `([dbd_kernel::laws::EndStop<F32>; 1],)`.
pub(super) fn types<P: SourceGeometry>(laws: &LawList<P>) -> String {
    let table = |source: &std::sync::Arc<dyn crate::laws::SourceRows>| {
        format!("[{}<{}>; {}],", source.path(), P::name(), source.bodies().len())
    };
    tuple(&laws.sources().iter().map(table).collect::<Vec<_>>())
}

/// The list.
pub(super) fn rows<P: SourceGeometry>(laws: &LawList<P>) -> String {
    let table = |source: &std::sync::Arc<dyn crate::laws::SourceRows>| {
        let mut text = String::from("[\n");
        for (row, bodies) in source.bodies().into_iter().enumerate() {
            let [a, b] = bodies.map(|body: BodyIndex| index(body));
            let mut fields = Fields::<P> { text: String::new(), precision: Default::default() };
            source.write(row, &mut fields);
            text +=
                &format!("        {} {{ bodies: [{a}, {b}], {} }},\n", source.path(), fields.text);
        }
        text + "    ],"
    };
    tuple(&laws.sources().iter().map(table).collect::<Vec<_>>())
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

fn vector<P: SourceGeometry>(v: [f64; 3]) -> String {
    P::vector(&P::Vector::from_f64(v))
}

fn locals<P: SourceGeometry>(points: [[f64; 3]; 2]) -> String {
    let [a, b] = points.map(|point| P::local(&P::local_from_f64(point)));
    format!("[{a}, {b}]")
}

fn hinge<P: SourceGeometry>(axis: [f64; 3], reference: [f64; 4]) -> String {
    let axis = P::moment(&<P as Geometry>::Moment::from_f64(axis));
    let reference = P::turn(&<P::Space as Space>::Turn::from_f64(reference));
    format!("dbd_kernel::generated::Hinge {{ axis: {axis}, reference: {reference} }}")
}

impl<P: SourceGeometry> FieldSink for Fields<P> {
    fn number(&mut self, field: &Field, value: f64) {
        self.push(field, &number::<P>(value));
    }
    fn count(&mut self, field: &Field, value: u32) {
        let text = match field.kind {
            "signal" => format!("dbd_kernel::generated::InputIndex({value})"),
            "joint" => format!("dbd_kernel::generated::GroupIndex({value})"),
            _ => value.to_string(),
        };
        self.push(field, &text);
    }
    fn points(&mut self, field: &Field, points: [[f64; 3]; 2]) {
        self.push(field, &locals::<P>(points));
    }
    fn normal(&mut self, field: &Field, normal: [f64; 3]) {
        self.push(field, &vector::<P>(normal));
    }
    fn axis(&mut self, field: &Field, axis: [f64; 3], reference: [f64; 4]) {
        self.push(field, &hinge::<P>(axis, reference));
    }
    fn table(&mut self, field: &Field, knots: &[[f64; 2]], capacity: usize) {
        let none = [[0.0; 2]];
        let all = knots.iter().chain(none.iter().cycle().take(capacity - knots.len()));
        let all = all.map(|[x, y]| format!("[{}, {}]", number::<P>(*x), number::<P>(*y)));
        let all = all.collect::<Vec<_>>().join(", ");
        let count = knots.len();
        self.push(
            field,
            &format!("dbd_kernel::generated::Curve {{ knots: [{all}], count: {count} }}"),
        );
    }
    fn matrix(&mut self, field: &Field, Ldl { diagonal, below }: &Ldl<f64>) {
        let list = |all: &[f64]| {
            all.iter().map(|value| number::<P>(*value)).collect::<Vec<_>>().join(", ")
        };
        let (diagonal, below) = (list(diagonal), list(below));
        let text =
            format!("dbd_kernel::generated::Ldl {{ diagonal: [{diagonal}], below: [{below}] }}");
        self.push(field, &text);
    }
    fn terms(&mut self, field: &Field, terms: &[Option<Term>; MAX_TERMS]) {
        let term = |term: &Option<Term>| {
            let Some(Term { bodies, factor, way }) = term else { return "None".to_owned() };
            let [a, b] = bodies.map(index);
            let way = match way {
                CoordinateKind::Turn(axis) => {
                    format!("Turn({})", hinge::<P>(axis.axis.to_f64(), axis.reference.to_f64()))
                }
                CoordinateKind::Travel { points, axis } => {
                    let points = locals::<P>(points.map(|point| F64::local_to_f64(&point)));
                    format!("Travel {{ points: {points}, axis: {} }}", vector::<P>(axis.to_f64()))
                }
            };
            let factor = number::<P>(*factor);
            format!(
                "Some(dbd_kernel::generated::Term {{ bodies: [{a}, {b}], factor: {factor}, \
                 way: dbd_kernel::generated::CoordinateKind::{way} }})"
            )
        };
        self.push(field, &format!("[{}]", terms.each_ref().map(term).join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::tuple;

    /// Eight tables are one tuple, of nine the last two are a tuple in the eighth place.
    #[test]
    fn more_than_eight_laws_are_nested() {
        let tables = |count: usize| vec!["t,".to_owned(); count];
        assert_eq!(tuple(&[]), "()");
        assert_eq!(tuple(&tables(8)), "(t, t, t, t, t, t, t, t,)");
        assert_eq!(tuple(&tables(9)), "(t, t, t, t, t, t, t, (t, t,))");
        assert!(tuple(&tables(16)).ends_with("(t, t, t, t, t, t, t, (t, t,)))"));
    }
}
