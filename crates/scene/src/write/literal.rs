//! TOML literals of numbers, vectors and texts that read back to the same bits.
//!
//! Directions and quaternions are normalised when they are read, which may change their last bits; where it does, a
//! scaled one is written that reads back correctly.

use dbd_kernel::Vec3;

use crate::direction::unit;
use crate::orientation::normalised;

/// Number of lengths tried.
const LENGTHS: u32 = 4096;

/// A number: the shortest text that reads back.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}

/// `[x, y, z]`.
pub(super) fn vector(v: Vec3<f64>) -> String {
    list(&v.to_f64())
}

/// A vector whose unit vector is this one.
pub(super) fn direction(v: Vec3<f64>) -> String {
    let bits = |v: Vec3<f64>| v.to_f64().map(f64::to_bits);
    let fits = |scaled: &[f64]| {
        let scaled = Vec3::new(scaled[0], scaled[1], scaled[2]);
        unit(scaled).is_some_and(|found| bits(found) == bits(v))
    };
    list(&scaled(&v.to_f64(), fits))
}

/// An orientation whose unit quaternion is this one.
pub(super) fn orientation(q: [f64; 4]) -> String {
    let fits = |scaled: &[f64]| {
        let found = normalised([scaled[0], scaled[1], scaled[2], scaled[3]]);
        found.map(f64::to_bits) == q.map(f64::to_bits)
    };
    format!("{{ quaternion = {} }}", list(&scaled(&q, fits)))
}

/// The numbers times the first factor that fits.
fn scaled(numbers: &[f64], fits: impl Fn(&[f64]) -> bool) -> Vec<f64> {
    let times = |i: u32| -> Vec<f64> {
        let factor = 1.0 + f64::from(i) / f64::from(LENGTHS);
        numbers.iter().map(|x| x * factor).collect()
    };
    (0..LENGTHS).map(times).find(|scaled| fits(scaled)).unwrap_or_else(|| numbers.to_vec())
}

fn list(numbers: &[f64]) -> String {
    let numbers: Vec<_> = numbers.iter().map(|x| number(*x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// Reads a decimal TOML number.
pub(super) fn read_number(text: &str) -> Option<f64> {
    text.replace('_', "").parse().ok()
}

/// The quaternion of a written orientation.
pub(super) fn read_orientation(text: &str) -> Option<[f64; 4]> {
    let text = format!("orientation = {text}");
    let source = crate::error::Source::of("orientation", &text);
    let document = crate::text::parse(source).ok()?;
    let root = crate::text::root(source, &document);
    root.optional("orientation", crate::orientation::Orientation).ok()?
}

/// A text in quotes.
pub(super) fn basic_string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted += "\\\"",
            '\\' => quoted += "\\\\",
            '\n' => quoted += "\\n",
            '\t' => quoted += "\\t",
            '\r' => quoted += "\\r",
            c if c.is_control() => quoted += &format!("\\u{:04X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// A key, quoted where necessary.
pub(super) fn key(text: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !text.is_empty() && text.chars().all(bare) { text.to_owned() } else { basic_string(text) }
}
