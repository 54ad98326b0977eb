//! Name patterns: `*` matches any letters, `?` one.

/// Whether a name matches a pattern, in time proportional to the product of their lengths.
#[must_use]
pub fn is_of(pattern: &str, name: &str) -> bool {
    let [pattern, name] = [pattern, name].map(|text| text.chars().collect::<Vec<_>>());
    let (mut at, mut from) = (0, 0);
    // The last `*`, and the letters that it matched.
    let mut triple: Option<(usize, usize)> = None;
    while from < name.len() {
        if at < pattern.len() && pattern[at] == '*' {
            triple = Some((at, from));
            at += 1;
        } else if at < pattern.len() && (pattern[at] == '?' || pattern[at] == name[from]) {
            (at, from) = (at + 1, from + 1);
        } else if let Some((place, taken)) = triple {
            // Match one more letter.
            triple = Some((place, taken + 1));
            (at, from) = (place + 1, taken + 1);
        } else {
            return false;
        }
    }
    pattern[at..].iter().all(|letter| *letter == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_and_question_marks_stand_for_letters() {
        for (pattern, name, meant) in [
            ("*", "", true),
            ("leg*", "leg 1", true),
            ("leg*", "a leg", false),
            ("*leg*", "a leg 1", true),
            ("l?g", "läg", true),
            ("l?g", "lg", false),
            ("*.?", "crank.vx", false),
            ("*a*b*", "xxaxxbxx", true),
            ("a*b*c", "aXbXbc", true),
            ("*a*b", "abab", true),
            ("*a*b", "aba", false),
            ("a", "ab", false),
            ("", "a", false),
        ] {
            assert_eq!(is_of(pattern, name), meant, "{pattern} {name}");
        }
        assert!(!is_of(&"*a".repeat(2_000), &"a".repeat(1_000)));
    }
}
