//! A law that scenes can name.

use dbd_kernel::laws::{self, Field, Law};

use crate::laws::source::{Source, SourceRows};

/// A law that scenes can name.
#[derive(Clone, Debug)]
pub struct KnownLaw {
    /// The name in scenes.
    pub name: &'static str,
    /// One-line description.
    pub about: &'static str,
    /// Its constants.
    pub fields: &'static [Field],
    /// The quantities that it reports.
    pub quantities: &'static [laws::Quantity],
    /// The path of its Rust type, used in exported source.
    pub path: String,
    /// Name and folder of the package that declares it.
    pub package: [&'static str; 2],
    pub(crate) table: fn(String) -> Box<dyn SourceRows>,
}

impl KnownLaw {
    /// Whether it is a law between two bodies, for a table `interaction`.
    #[must_use]
    pub fn is_between(&self) -> bool {
        self.fields.iter().all(|field| field.kind != "terms")
    }

    pub(crate) fn of<L: Law>(path: &str) -> Self {
        Self {
            name: <L as laws::Constants<dbd_kernel::F64>>::NAME,
            about: L::ABOUT,
            fields: L::FIELDS,
            quantities: <L as laws::Interaction<dbd_kernel::F64>>::QUANTITIES,
            path: path.to_owned(),
            package: L::PACKAGE,
            table: |path| Box::new(Source::<L>::new(path)),
        }
    }
}
