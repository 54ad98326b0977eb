//! Suggestions for misspelled names.

/// Longest word that is compared.
const LONGEST: usize = 300;

/// The candidate closest to a misspelled word; `None` where none is close. Ties give the first.
#[must_use]
pub fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let mut best = None;
    let letters = word.chars().count();
    for candidate in candidates {
        let candidate_letters = candidate.chars().count();
        // A third of the letters: one or two typing errors, not a different word.
        let limit = (letters.max(candidate_letters) / 3).max(1);
        // Skip words of very different length: the distance costs time and memory of the product of both lengths.
        if letters.max(candidate_letters) > LONGEST || letters.abs_diff(candidate_letters) > limit {
            continue;
        }
        let distance = distance(word, candidate);
        if distance <= limit && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Insertions, deletions and replacements of letters and swaps of neighbours (optimal string
/// alignment), case ignored.
fn distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.to_lowercase().chars().collect();
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for (i, x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, y) in b.iter().enumerate() {
            let replaced = rows[i][j] + usize::from(x != y);
            let mut least = replaced.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_are_found_and_other_words_are_not() {
        let keys = ["mass", "inertia", "position", "angular_velocity"];
        assert_eq!(nearest("mas", keys), Some("mass"));
        assert_eq!(nearest("Inertia", keys), Some("inertia"));
        assert_eq!(nearest("angular-velocty", keys), Some("angular_velocity"));
        assert_eq!(nearest("mssa", ["mass"]), None);
        assert_eq!(nearest("msas", ["mass"]), Some("mass"));
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest("", keys), None);
        // 400,000 letters squared exceed any machine's memory.
        let endless = "m".repeat(400_000);
        assert_eq!(nearest(&endless, [endless.as_str(), "mass"]), None);
    }
}
