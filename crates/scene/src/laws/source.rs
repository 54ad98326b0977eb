//! The rows of a law as given in a scene, in double precision, and their conversion to other precisions.

use std::any::{Any, TypeId};
use std::sync::Arc;

use dbd_kernel::laws::{self, Constants, FieldSink, FieldSource, Law};
use dbd_kernel::words::Word;
use dbd_kernel::{BodyIndex, F32, F64, Fixed, Geometry, Planar32, Planar64};

use crate::laws::rows::{Listed, Of, Rows};

/// The rows of a law in double precision, as given in a scene.
pub(crate) trait SourceRows: Send + Sync {
    fn name(&self) -> &'static str;
    /// The path of its Rust type.
    fn path(&self) -> &str;
    fn bodies(&self) -> Vec<[BodyIndex; 2]>;
    /// All constants.
    fn words(&self) -> Vec<Word>;
    /// One more row; `None` where the source has refused a constant.
    fn add(&mut self, bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<()>;
    /// The error of the last row: field, problem, remedy.
    fn wrong(&self) -> Option<laws::Wrong>;
    /// A table of the same law without rows.
    fn empty(&self) -> Box<dyn SourceRows>;
    /// A row's constants.
    fn write(&self, row: usize, sink: &mut dyn FieldSink);
    /// `Arc<dyn Rows<P>>` for the precision of this type.
    fn in_precision(&self, precision: TypeId) -> Option<Box<dyn Any>>;
}

/// The rows of `L`.
pub(crate) struct Source<L> {
    rows: Vec<L>,
    path: String,
}

impl<L: Law> Source<L> {
    pub(crate) fn new(path: String) -> Self {
        Self { rows: Vec::new(), path }
    }

    fn rows_in<P: Geometry>(&self) -> Box<dyn Any> {
        let rows: Arc<dyn Rows<P>> = Arc::new(Of(self.rows.iter().map(L::rounded::<P>).collect()));
        Box::new(rows)
    }
}

impl<L: Law> SourceRows for Source<L> {
    fn name(&self) -> &'static str {
        <L as Constants<F64>>::NAME
    }
    fn path(&self) -> &str {
        &self.path
    }
    fn bodies(&self) -> Vec<[BodyIndex; 2]> {
        self.rows.iter().map(Constants::bodies).collect()
    }
    fn words(&self) -> Vec<Word> {
        let mut list = Listed::default();
        self.rows.iter().for_each(|row| Constants::visit(row, &mut list));
        list.0
    }
    fn add(&mut self, bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<()> {
        self.rows.push(L::read_from(bodies, source)?);
        Some(())
    }
    fn wrong(&self) -> Option<laws::Wrong> {
        self.rows.last()?.check().err()
    }
    fn empty(&self) -> Box<dyn SourceRows> {
        Box::new(Self::new(self.path.clone()))
    }
    fn write(&self, row: usize, sink: &mut dyn FieldSink) {
        if let Some(row) = self.rows.get(row) {
            row.write_to(sink);
        }
    }
    fn in_precision(&self, precision: TypeId) -> Option<Box<dyn Any>> {
        let is = |id: TypeId| precision == id;
        match () {
            () if is(TypeId::of::<F64>()) => Some(self.rows_in::<F64>()),
            () if is(TypeId::of::<F32>()) => Some(self.rows_in::<F32>()),
            () if is(TypeId::of::<Fixed>()) => Some(self.rows_in::<Fixed>()),
            () if is(TypeId::of::<Planar64>()) => Some(self.rows_in::<Planar64>()),
            () if is(TypeId::of::<Planar32>()) => Some(self.rows_in::<Planar32>()),
            () => None,
        }
    }
}
