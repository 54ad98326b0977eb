//! Numbers and strings in TOML notation.
//!
//! `value => text`.

use dbd_scene::is_name;
use nalgebra::Vector3;

/// Coordinates below this fraction of the mechanism's size are rounding errors.
const ROUNDING: f64 = 1e-15;

/// Maximum length of a name in bytes.
const LONGEST: usize = 200;

/// Bytes of a name reserved for a distinguishing suffix.
const ROOM: usize = 20;

/// A text on one line without characters invalid in comments and names.
pub(crate) fn line(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

/// A quoted string, truncated to the length of a name.
pub(crate) fn text(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in line(text).chars() {
        if quoted.len() + letter.len_utf8() > LONGEST {
            break;
        }
        if matches!(letter, '"' | '\\') {
            quoted.push('\\');
        }
        quoted.push(letter);
    }
    quoted.push('"');
    quoted
}

/// A valid name: the desired one without invisible characters and without characters that start a formula in
/// spreadsheets.
pub(crate) fn fitting(wanted: &str) -> String {
    if is_name(wanted) {
        return wanted.to_owned();
    }
    // After another letter, because the first one has further rules.
    let is_seen = |letter: &char| is_name(&format!("a{letter}"));
    let mut name: String = wanted.chars().filter(is_seen).collect();
    while name.len() > LONGEST - ROOM {
        name.pop();
    }
    let name = name.trim().trim_start_matches(['=', '+', '-', '@']).trim_start();
    if is_name(name) { name.to_owned() } else { "unnamed".to_owned() }
}

/// A number in TOML notation.
pub(crate) fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// Replaces a coordinate that is only a rounding error by 0.
pub(crate) fn snapped(value: f64, size: f64) -> f64 {
    if value.abs() < ROUNDING * size { 0.0 } else { value }
}

/// Three numbers in TOML notation.
pub(crate) fn vector(vector: Vector3<f64>, size: f64) -> String {
    let parts = [vector.x, vector.y, vector.z].map(|part| number(snapped(part, size)));
    format!("[{}]", parts.join(", "))
}
