//! A law that scenes can name.

use dbd_kernel::laws::{self, Field, Law};

use crate::laws::source::{Source, SourceRows};

/// A law that scenes can name.
#[derive(Clone, Debug)]
pub struct KnownLaw {
    /// The name in scenes.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// Its constants.
    pub fields: &'static [Field],
    /// What it shows.
    pub quantities: &'static [laws::Quantity],
    /// The path of its type in Rust, as exported source has it.
    pub path: String,
    /// The name and the folder of the package that declares it.
    pub package: [&'static str; 2],
    pub(crate) table: fn(String) -> Box<dyn SourceRows>,
}

impl KnownLaw {
    /// Whether it is a law between two bodies, as a table `interaction` has it.
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
