//! Why a recorded run cannot be read: file, line and column, problem, remedy.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

/// Why a recorded run cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{}: {problem}", file.display(), Place(*line, *column))]
pub struct Unreadable {
    /// The file or folder.
    pub file: PathBuf,
    /// Its line, from 1; `None` for the whole file.
    pub line: Option<u64>,
    /// The column of the line, in characters from 1.
    pub column: Option<u64>,
    /// The problem.
    pub problem: String,
    /// The remedy.
    pub remedy: Option<String>,
}

/// `:LINE:COLUMN`, as far as they are known.
struct Place(Option<u64>, Option<u64>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(line, column) = self;
        line.map_or(Ok(()), |line| write!(f, ":{line}"))?;
        column.map_or(Ok(()), |column| write!(f, ":{column}"))
    }
}

impl Diagnostic for Unreadable {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.remedy.as_ref().map(|remedy| Box::new(remedy) as Box<dyn fmt::Display>)
    }
}

impl Unreadable {
    /// An error of a whole file.
    #[must_use]
    pub fn new(file: &Path, problem: impl Into<String>) -> Self {
        let (line, column, remedy) = (None, None, None);
        Self { file: file.to_owned(), line, column, problem: problem.into(), remedy }
    }

    /// The system cannot read it.
    #[must_use]
    pub fn system(file: &Path, reason: &io::Error) -> Self {
        Self::new(file, format!("cannot be read: {reason}"))
    }

    /// The same with its line, from 1.
    #[must_use]
    pub fn at_line(self, line: u64) -> Self {
        Self { line: Some(line), ..self }
    }

    /// The same with the position in its line, in characters from 1.
    #[must_use]
    pub fn at_column(self, column: usize) -> Self {
        Self { column: Some(column as u64), ..self }
    }

    /// The same with a remedy.
    #[must_use]
    pub fn with_remedy(self, remedy: impl Into<String>) -> Self {
        Self { remedy: Some(remedy.into()), ..self }
    }
}
