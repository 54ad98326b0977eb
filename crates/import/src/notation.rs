//! Numbers and texts as TOML has them.
//!
//! `value => text`.

use dbd_scene::is_name;
use nalgebra::Vector3;

/// Coordinates below this share of the mechanism's size are rounding.
const ROUNDING: f64 = 1e-15;

/// A name is at most so many bytes long.
const LONGEST: usize = 200;

/// Bytes of a name that are left for what tells it from others.
const ROOM: usize = 20;

/// A text on one line without marks that no comment and no name can hold.
pub(crate) fn line(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

/// A text in quotes, no longer than a name may be.
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

/// A name that a scene takes: the one wanted, without what nobody sees of it and what a spreadsheet takes for the
/// beginning of a formula.
pub(crate) fn fitting(wanted: &str) -> String {
    if is_name(wanted) {
        return wanted.to_owned();
    }
    // Behind another letter: the first one has further rules.
    let is_seen = |letter: &char| is_name(&format!("a{letter}"));
    let mut name: String = wanted.chars().filter(is_seen).collect();
    while name.len() > LONGEST - ROOM {
        name.pop();
    }
    let name = name.trim().trim_start_matches(['=', '+', '-', '@']).trim_start();
    if is_name(name) { name.to_owned() } else { "unnamed".to_owned() }
}

/// A number as TOML has it.
pub(crate) fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// 0 instead of what only rounding has left of a coordinate.
pub(crate) fn snapped(value: f64, size: f64) -> f64 {
    if value.abs() < ROUNDING * size { 0.0 } else { value }
}

/// Three numbers as TOML has them.
pub(crate) fn vector(vector: Vector3<f64>, size: f64) -> String {
    let parts = [vector.x, vector.y, vector.z].map(|part| number(snapped(part, size)));
    format!("[{}]", parts.join(", "))
}
