//! Texts of scenes, changed: tables, lines, keys, numbers, names, bytes.
//!
//! `(valid text, others, random source) => text`. One to four changes of a valid scene leave most of
//! it right, so that what comes after the first check is reached as well.

use std::ops::Range;

use fastrand::Rng;

use crate::edges::change_key;

/// What stands in scenes, and what stands in none.
const WORDS: &[&str] = &[
    "name",
    "description",
    "gravity",
    "duration",
    "step",
    "every",
    "[[body]]",
    "[[joint]]",
    "[[tsda]]",
    "[[point_on_line]]",
    "[[torsion_spring]]",
    "[assemble]",
    "fixed",
    "rates",
    "first",
    "second",
    "slide",
    "turn",
    "[[load]]",
    "[[input]]",
    "[[readout]]",
    "mass",
    "inertia",
    "position",
    "orientation",
    "velocity",
    "angular_velocity",
    "axis",
    "angle",
    "quaternion",
    "euler_321",
    "stiffness",
    "damping",
    "damping_ratio",
    "frequency",
    "clearance",
    "type",
    "between",
    "at",
    "span",
    "ring",
    "reference",
    "arm",
    "axes",
    "spider",
    "offset",
    "gauge",
    "offsets",
    "points",
    "[points]",
    "[defaults.joint]",
    "[defaults.link]",
    "link",
    "to",
    "along",
    "centre",
    "shape",
    "section",
    "diameter",
    "wall",
    "density",
    "distance",
    "distances",
    "direction",
    "toward",
    "side",
    "share",
    "normal",
    "left",
    "free_length",
    "line_point",
    "line_direction",
    "point",
    "preload",
    "body",
    "force",
    "torque",
    "frame",
    "from",
    "until",
    "value",
    "table",
    "interpolate",
    "periodic",
    "jump",
    "over",
    "sine",
    "amplitude",
    "phase",
    "target",
    "about",
    "load",
    "deflection",
    "\"world\"",
    "\"body\"",
    "\"spherical\"",
    "\"revolute\"",
    "\"universal\"",
    "\"cylindrical\"",
    "\"translational\"",
    "\"fixed\"",
    "\"linear\"",
    "\"held\"",
    "\"outward\"",
    "\"joint_torque\"",
    "\"joint_force\"",
    "\"joint_travel\"",
    "\"actuator\"",
    "\"anchor\"",
    "\"joint_angle\"",
    "\"imu\"",
    "[[geometry]]",
    "shape",
    "colour",
    "radius",
    "\"cylinder\"",
    "\"link\"",
    "\"#12ab9f\"",
    "\"first\"",
    "\"20us\"",
    "\"1e999s\"",
    "[parameters]",
    "\"2 * (L + 5 mm) / k\"",
    "\"9 kN/mm\"",
    "\"-30 deg\"",
    "\"(((",
    ")",
    "*",
    "/",
    "^",
    "²",
    "mm",
    "rad",
    "\"\"",
    "true",
    "false",
    "[]",
    "{}",
    "[[",
    "]]",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    ".",
    "\"",
    "\"\"\"",
    "'",
    "'''",
    "#",
    "\n",
    "\r\n",
    "\t",
    "\0",
    "\\u",
    "\\uD800",
    "\u{202e}",
    "\u{feff}",
    "é",
    "𝄞",
    "1979-05-27T07:32:00Z",
    "0x7fffffffffffffff",
    "9223372036854775808",
    "inf",
    "nan",
    "-",
    "+",
    "_",
    "e",
];

/// Numbers as texts: those at which arithmetic or reading turns.
const NUMBERS: &[&str] = &[
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "0.5",
    "1e-3",
    "1e3",
    "1e-9",
    "1e9",
    "1e-20",
    "1e20",
    "1e-150",
    "1e150",
    "1.1e150",
    "1e-151",
    "1e-160",
    "1e155",
    "1e-300",
    "1e300",
    "1e308",
    "1.7976931348623157e308",
    "-1.7976931348623157e308",
    "5e-324",
    "1e-324",
    "1e-400",
    "1e400",
    "2.2250738585072014e-308",
    "3.4028235e38",
    "3.5e38",
    "1e-45",
    "1e-38",
    "65535",
    "65536",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "1e19",
    "3.141592653589793",
    "6.283185307179586",
    "0.1",
    "0.30000000000000004",
    "1e-7",
    "inf",
    "nan",
    "-inf",
    "0x10",
    "1_000",
    "1e",
    ".5",
    "5.",
    "00",
];

/// A changed scene: `base` with up to four changes, some of them pieces of `other`.
pub fn changed(base: &str, other: &str, random: &mut Rng) -> Vec<u8> {
    let mut text = base.as_bytes().to_vec();
    for _ in 0..1 + random.usize(..5) / 2 {
        change(&mut text, other.as_bytes(), random);
    }
    text
}

/// Text of words and bytes without a scene behind it.
pub fn soup(random: &mut Rng) -> Vec<u8> {
    let mut text = Vec::new();
    for _ in 0..random.usize(..40) {
        match random.u8(..8) {
            0..=3 => text.extend_from_slice(WORDS[random.usize(..WORDS.len())].as_bytes()),
            4 => text.extend_from_slice(NUMBERS[random.usize(..NUMBERS.len())].as_bytes()),
            5 => text.extend_from_slice(b" = "),
            6 => text.push(b'\n'),
            _ => text.push(random.u8(..)),
        }
    }
    text
}

/// One change.
fn change(text: &mut Vec<u8>, other: &[u8], random: &mut Rng) {
    match random.u8(..24) {
        0 | 1 => change_key(text, random),
        20.. | 2..=5 => change_number(text, random),
        6 | 7 => swap_words(text, random),
        8 => replace(text, word(text, random), pick(WORDS, random)),
        9 => {
            let line = line(text, random);
            text.drain(line);
        }
        10 => copy(text, None, line, random),
        11 => copy(text, Some(other), line, random),
        12 => {
            let table = table(text, random);
            text.drain(table);
        }
        13 => copy(text, None, table, random),
        14 => copy(text, Some(other), table, random),
        15 => {
            let at = random.usize(..=text.len());
            text.splice(at..at, pick(WORDS, random));
        }
        16 => {
            let at = random.usize(..=text.len());
            let end = text.len().min(at + random.usize(..8));
            text.drain(at..end);
        }
        17 => {
            if let Some(byte) = text.get_mut(random.usize(..=other.len().max(1))) {
                *byte ^= 1 << random.u8(..8);
            }
        }
        18 => repeat(text, random),
        _ => {
            let at = random.usize(..=text.len());
            text.splice(at..at, [random.u8(..)]);
        }
    }
}

/// One piece many times over: what nests, what is long, what is too many.
fn repeat(text: &mut Vec<u8>, random: &mut Rng) {
    let most = if random.u8(..64) == 0 { 13 } else { 7 };
    let times: usize = 1 << random.u32(..most);
    let piece = match random.u8(..4) {
        0 => pick(WORDS, random),
        1 => text[word(text, random)].to_vec(),
        2 => text[line(text, random)].to_vec(),
        _ => vec![random.u8(..)],
    };
    let at = random.usize(..=text.len());
    text.splice(at..at, piece.repeat(times.min(40_000 / piece.len().max(1))));
}

fn pick(list: &[&str], random: &mut Rng) -> Vec<u8> {
    list[random.usize(..list.len())].as_bytes().to_vec()
}

fn replace(text: &mut Vec<u8>, range: Range<usize>, with: Vec<u8>) {
    text.splice(range, with);
}

/// Another number in place of one, or the same with another digit or exponent.
fn change_number(text: &mut Vec<u8>, random: &mut Rng) {
    let is_part = |byte: u8| byte.is_ascii_digit() || b".+-eE_".contains(&byte);
    let start = random.usize(..=text.len());
    let Some(first) = text[start..].iter().position(u8::is_ascii_digit) else { return };
    let (mut from, mut to) = (start + first, start + first + 1);
    while from > 0 && is_part(text[from - 1]) {
        from -= 1;
    }
    while to < text.len() && is_part(text[to]) {
        to += 1;
    }
    match random.u8(..6) {
        0 | 1 => {
            let at = random.usize(from..to);
            text[at] = b"0123456789123456789.e-"[random.usize(..22)];
        }
        2 => {
            let exponent = random.i32(-330..330) / if random.bool() { 1 } else { 30 };
            text.splice(to..to, format!("e{exponent}").into_bytes());
        }
        _ => replace(text, from..to, pick(NUMBERS, random)),
    }
}

/// A word of the text in place of another: names for names, keys for keys.
fn swap_words(text: &mut Vec<u8>, random: &mut Rng) {
    let with = text[word(text, random)].to_vec();
    let at = word(text, random);
    replace(text, at, with);
}

/// A word or a number: what lies between two characters that are part of none.
fn word(text: &[u8], random: &mut Rng) -> Range<usize> {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || b"_.-\"".contains(&byte);
    let start = random.usize(..=text.len());
    let from = start + text[start..].iter().position(|b| is_part(*b)).unwrap_or(0);
    let length = text[from..].iter().position(|b| !is_part(*b)).unwrap_or(text.len() - from);
    from..from + length
}

fn line(text: &[u8], random: &mut Rng) -> Range<usize> {
    between(text, b"\n", random)
}

fn table(text: &[u8], random: &mut Rng) -> Range<usize> {
    between(text, b"\n[[", random)
}

/// From one mark's first byte's end to the next one's.
fn between(text: &[u8], mark: &[u8], random: &mut Rng) -> Range<usize> {
    let start = random.usize(..=text.len());
    let is_mark = |at: &usize| text[*at..].starts_with(mark);
    let from = (0..start).rev().find(is_mark).map_or(0, |at| at + 1);
    let to = (start..text.len()).find(is_mark).map_or(text.len(), |at| at + 1);
    from..to.max(from)
}

/// A piece of a text put in before another piece of this one.
fn copy(
    text: &mut Vec<u8>,
    source: Option<&[u8]>,
    piece: fn(&[u8], &mut Rng) -> Range<usize>,
    random: &mut Rng,
) {
    let source = source.unwrap_or(text);
    let copied = source[piece(source, random)].to_vec();
    let at = piece(text, random).start;
    text.splice(at..at, copied);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same seed gives the same texts: a block of inputs can be made again.
    #[test]
    fn changes_are_a_function_of_the_seed() {
        let texts = || -> Vec<Vec<u8>> {
            let mut random = Rng::with_seed(3);
            let base = "name = \"a\"\n[[body]]\nmass = 1\n";
            (0..500).map(|_| changed(base, "[[load]]\nforce = [1, 2, 3]", &mut random)).collect()
        };
        assert_eq!(texts(), texts());
        assert!(texts().iter().any(|text| text.ends_with(b"mass = 1\n")));
    }

    #[test]
    fn an_empty_text_can_be_changed() {
        let mut random = Rng::with_seed(1);
        for _ in 0..2000 {
            changed("", "", &mut random);
        }
    }
}
