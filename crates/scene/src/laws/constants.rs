//! The constants of one row of a law, for programs that translate scenes.

use dbd_kernel::BodyIndex;
use dbd_kernel::laws::{Field, FieldSink, Ldl, MAX_TERMS, Term};

use crate::laws::SourceRows;

/// The constants of one row of a law, in double precision; points, tables and matrices are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct RowConstants {
    /// The name of the law.
    pub law: &'static str,
    /// A and B.
    pub bodies: [BodyIndex; 2],
    /// Its numbers by name; units as in [`KnownLaw::fields`](crate::laws::KnownLaw::fields).
    pub numbers: Vec<(&'static str, f64)>,
    /// \[1\] its unit axis or direction, A's axes.
    pub axis: Option<[f64; 3]>,
    /// Terms of a sum of joint coordinates.
    pub terms: Vec<Term>,
}

impl RowConstants {
    pub(super) fn of(source: &dyn SourceRows, row: usize) -> Option<Self> {
        let bodies = *source.bodies().get(row)?;
        let mut found =
            Self { law: source.name(), bodies, numbers: Vec::new(), axis: None, terms: Vec::new() };
        source.write(row, &mut found);
        Some(found)
    }

    /// A number by its name.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.numbers.iter().find(|(of, _)| *of == name).map(|(_, number)| *number)
    }
}

impl FieldSink for RowConstants {
    fn number(&mut self, field: &Field, value: f64) {
        self.numbers.push((field.name, value));
    }
    fn count(&mut self, field: &Field, value: u32) {
        self.numbers.push((field.name, f64::from(value)));
    }
    fn points(&mut self, _: &Field, _: [[f64; 3]; 2]) {}
    fn normal(&mut self, _: &Field, normal: [f64; 3]) {
        self.axis = Some(normal);
    }
    fn axis(&mut self, _: &Field, axis: [f64; 3], _: [f64; 4]) {
        self.axis = Some(axis);
    }
    fn table(&mut self, _: &Field, _: &[[f64; 2]], _: usize) {}
    fn matrix(&mut self, _: &Field, _: &Ldl<f64>) {}
    fn terms(&mut self, _: &Field, terms: &[Option<Term>; MAX_TERMS]) {
        self.terms = terms.iter().flatten().copied().collect();
    }
}

#[cfg(test)]
mod tests {
    use crate::example;

    /// Limits, friction and a coupling give the numbers of the scene.
    #[test]
    fn a_row_gives_the_numbers_of_its_table() {
        let scene = example::with(
            "[[joint]]\nname = \"t\"\ntype = \"translational\"\nbetween = [\"world\", \"hand\"]\n\
             at = [1, 2, 3]\naxis = [5, 0, 0]\nreference = [1, 1, 0]\nstiffness = 1e5\nspan = 4\n\
             gauge = 2\noffset = 0.5\nlimits = { from = -1, to = 2, stiffness = 1e4 }\n\
             [[coupling]]\nof = [{ joint = \"t\", factor = 3 }]\nstiffness = 7\n",
        );
        let laws = &scene.model.laws;
        let stop = laws.constants(0).unwrap();
        assert_eq!(
            (stop.law, stop.number("from"), stop.number("to")),
            ("end-stop", Some(-1.0), Some(2.0))
        );
        assert_eq!((stop.axis, stop.number("none")), (Some([1.0, 0.0, 0.0]), None));
        assert_eq!(scene.table_of_interaction(0), Some(("joint", 0)));
        let coupling = laws.constants(1).unwrap();
        assert_eq!((coupling.law, coupling.number("stiffness")), ("coupling", Some(7.0)));
        assert_eq!(coupling.terms.iter().map(|term| term.factor).collect::<Vec<_>>(), [3.0]);
        assert_eq!((laws.constants(2), scene.table_of_interaction(2)), (None, None));
    }
}
