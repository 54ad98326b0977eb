//! Nothing, the least and the largest in place of all numbers of a key.
//!
//! `text => text`. A size that is 0 everywhere may leave a list without an entry, a divisor without a value: one
//! number among many seldom does.

use fastrand::Rng;

/// Nothing, the least and the largest, as a scene's file and a command line have them.
pub const EDGES: [&str; 6] = [
    "0",
    "-0.0",
    "5e-324",
    "1.7976931348623157e308",
    "-1.7976931348623157e308",
    "2.2250738585072014e-308",
];

/// Changes by path for a command line: all of a kind at once.
pub const CHANGES: &[&str] = &[
    "joint.*.stiffness=0",
    "joint.*.damping=0",
    "tsda.*.stiffness=-0.0",
    "joint.*.stiffness=5e-324",
    "joint.*.stiffness=1.7976931348623157e308",
    "body.*.mass=5e-324",
    "body.*.mass=1.7976931348623157e308",
    "duration=5e-324",
    "body.*.position=[0, 0, 0]",
    "joint.*.span=5e-324",
    "joint.*.at=[1.7976931348623157e308, 0, -0.0]",
    "gravity=[0, -0.0, 5e-324]",
    "planar=true",
];

/// Sets the numbers on all lines of one key to one edge.
pub fn change_key(text: &mut Vec<u8>, random: &mut Rng) {
    let whole = String::from_utf8_lossy(text).into_owned();
    let keys: Vec<&str> =
        whole.lines().filter_map(|line| line.split_once('=')).map(|(key, _)| key.trim()).collect();
    if keys.is_empty() {
        return;
    }
    let (key, edge) = (keys[random.usize(..keys.len())], EDGES[random.usize(..EDGES.len())]);
    let changed = |line: &str| match line.split_once('=') {
        Some((own, value)) if own.trim() == key => format!("{own}={}", with_numbers(value, edge)),
        _ => line.to_owned(),
    };
    let lines: Vec<String> = whole.lines().map(changed).collect();
    *text = (lines.join("\n") + "\n").into_bytes();
}

/// A value with `edge` for each of its numbers; texts in quotes stay.
fn with_numbers(value: &str, edge: &str) -> String {
    let (mut out, mut quoted, mut within) = (String::new(), false, false);
    for letter in value.chars() {
        quoted ^= letter == '"';
        let part = !quoted
            && (letter.is_ascii_digit()
                || ".+-".contains(letter)
                || within && "eE_".contains(letter));
        if part && !within {
            out += edge;
        }
        if !part {
            out.push(letter);
        }
        within = part;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_of_a_key_become_one_edge() {
        assert_eq!(with_numbers(" [0.1, -2e-3, \"3 mm\"] # 4", "0"), " [0, 0, \"3 mm\"] # 0");
        let mut text = b"a = 1\nb = [2, 3]\na = 4e5\n".to_vec();
        let mut random = Rng::with_seed(1);
        while text.starts_with(b"a = 1\n") {
            change_key(&mut text, &mut random);
        }
        let text = String::from_utf8(text).unwrap();
        let of_a: Vec<&str> = text.lines().filter(|line| line.starts_with("a")).collect();
        assert!(of_a.len() == 2 && of_a[0] == of_a[1] && of_a[0].len() > 4, "{text}");
    }
}
