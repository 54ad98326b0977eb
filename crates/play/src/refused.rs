//! Why a request is refused, in the words of the command line.
//!
//! `error of a scene, a method or a plant => message, help, line, column`.

use dbd_plant::instance::InstanceError;
use miette::Diagnostic;
use serde::Serialize;

/// Problem and remedy.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Refused {
    /// Problem.
    pub message: String,
    /// Remedy.
    pub help: Option<String>,
    /// Where in the scene's text, from 1.
    pub line: Option<usize>,
    /// Likewise, in characters.
    pub column: Option<usize>,
}

impl Refused {
    /// An error without a position in a text.
    #[must_use]
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), line: None, column: None }
    }
}

impl From<InstanceError> for Refused {
    fn from(error: InstanceError) -> Self {
        match error {
            InstanceError::Scene(error) => Self {
                message: error.message(),
                help: Some(error.help().to_owned()),
                line: error.line(),
                column: error.column(),
            },
            other => Self {
                help: other.help().map(|help| help.to_string()),
                message: other.to_string(),
                line: None,
                column: None,
            },
        }
    }
}
