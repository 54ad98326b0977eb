//! Consent to a new golden file: given in the environment, never on a build server.
//!
//! `DBD_BLESS, CI => whether files are written`. The same variable blesses other golden data, with another value: a
//! command that writes tables does not also write trajectories.

use std::string::String;

/// The variable that gives consent, and its value.
pub const VARIABLE: &str = "DBD_BLESS";
/// Its value.
pub const WORD: &str = "golden";
/// The variable by which build servers identify themselves.
const SERVER: &str = "CI";

/// Whether golden files are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Blessing {
    /// They are compared.
    #[default]
    No,
    /// They are written.
    Yes,
    /// Writing was requested on a build server.
    Refused,
}

impl Blessing {
    /// From the environment: `DBD_BLESS=golden`; refused if `CI` is set and neither empty nor `0` nor `false`.
    #[must_use]
    pub fn from_environment() -> Self {
        Self::from_variables(|name| {
            std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
        })
    }

    /// From variables of any source.
    pub fn from_variables(variable: impl Fn(&str) -> Option<String>) -> Self {
        if variable(VARIABLE).is_none_or(|value| value != WORD) {
            return Self::No;
        }
        let server = variable(SERVER).unwrap_or_default();
        let none = ["", "0"].contains(&server.as_str()) || server.eq_ignore_ascii_case("false");
        if none { Self::Yes } else { Self::Refused }
    }
}

#[cfg(test)]
mod tests {
    use std::borrow::ToOwned as _;

    use super::*;

    #[test]
    fn consent_is_one_word_and_none_on_a_server() {
        let of = |bless: Option<&str>, server: Option<&str>| {
            Blessing::from_variables(|name| match name {
                "DBD_BLESS" => bless.map(str::to_owned),
                "CI" => server.map(str::to_owned),
                _ => None,
            })
        };
        for other in [None, Some(""), Some("1"), Some("bits"), Some("Golden")] {
            assert_eq!(of(other, None), Blessing::No);
            assert_eq!(of(other, Some("true")), Blessing::No);
        }
        for none in [None, Some(""), Some("0"), Some("false"), Some("False")] {
            assert_eq!(of(Some("golden"), none), Blessing::Yes);
        }
        for server in ["true", "1", "yes", "TRUE", " "] {
            assert_eq!(of(Some("golden"), Some(server)), Blessing::Refused);
        }
    }
}
