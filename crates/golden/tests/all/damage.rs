//! Whatever happens to a golden file is found, and named with its line.

use dbd_golden::{Damage, Golden, Mismatch, Tolerance};
use proptest::prelude::*;
use std::sync::LazyLock;

static TEXT: LazyLock<String> = LazyLock::new(|| crate::shared::four_bar().text());

fn damage(text: &str) -> (usize, Damage) {
    match Golden::read(text) {
        Err(Mismatch::Damaged { line, damage }) => (line, damage),
        other => panic!("{other:?}"),
    }
}

fn lines() -> Vec<&'static str> {
    TEXT.lines().collect()
}

#[test]
fn a_whole_file_is_read_whatever_its_line_breaks() {
    assert_eq!(Golden::read(&TEXT).unwrap().samples(), 5);
    assert_eq!(Golden::read(&TEXT.replace('\n', "\r\n")).unwrap().samples(), 5);
    assert_eq!(Golden::read(TEXT.trim_end()).unwrap().samples(), 5);
    let recording = crate::shared::four_bar();
    assert!(recording.compare(&TEXT.replace('\n', "\r\n"), &Tolerance::Bits).is_ok());
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let all = lines();
    assert_eq!((all.len(), all[12].starts_with("0\t")), (18, true), "{}", all[12]);
    let edited = |line: usize, with: &dyn Fn(&str) -> String| {
        let mut all: Vec<String> = lines().into_iter().map(str::to_owned).collect();
        all[line - 1] = with(&all[line - 1]);
        all.join("\n") + "\n"
    };
    let without = |line: usize| edited(line, &|_| "\u{1}".into()).replace("\u{1}\n", "");
    assert_eq!(damage(""), (1, Damage::Foreign));
    assert_eq!(damage("name = \"four-bar\"\n"), (1, Damage::Foreign));
    let scheme = (4, Damage::Head("# scheme: "));
    assert_eq!(damage(&edited(4, &|_| "# scheme: leapfrog".into())), scheme);
    assert_eq!(damage(&without(4)), scheme);
    // A head that still reads is found by the first row's hash.
    let other = edited(7, &|line| line.replace("2e-5", "3e-5"));
    assert_eq!(damage(&other), (13, Damage::Chain { from: 1 }));
    // An edited, a deleted, a doubled, a cut row; a number that is none.
    let dot = edited(15, &|line| line.replacen("0.", "1.", 1));
    assert_eq!(damage(&dot), (15, Damage::Chain { from: 15 }));
    assert_eq!(damage(&without(15)), (15, Damage::Chain { from: 15 }));
    assert_eq!(damage(&edited(15, &|line| format!("{line}\n{line}"))).0, 16);
    let cut = edited(16, &|line| line.rsplit_once('\t').unwrap().0.into());
    assert_eq!(damage(&cut), (16, Damage::Fields { found: 43, columns: 44 }));
    let wrong = edited(14, &|line| line.replacen("0.", "O.", 1));
    assert_eq!(damage(&wrong), (14, Damage::Number(3)));
    // The end.
    let mut short: Vec<&str> = lines();
    short.pop();
    assert_eq!(damage(&short.join("\n")), (18, Damage::Cut));
    short.pop();
    assert_eq!(damage(&(short.join("\n") + "\n" + all[17])), (17, Damage::Count));
    assert_eq!(damage(&format!("{}\n", &*TEXT)), (19, Damage::Rest));
    let bytes = [TEXT.as_bytes(), b"\xff"].concat();
    let Err(Mismatch::Damaged { line, damage }) = Golden::of_bytes(&bytes) else { panic!() };
    assert_eq!((line, damage), (19, Damage::Text));
    // Another version is none of this crate's business.
    let next = TEXT.replacen("golden 1", "golden 2", 1);
    let refused = Golden::read(&next).unwrap_err();
    assert_eq!(refused, Mismatch::Version { golden: "2", present: 1 });
}

/// A head that was changed by a hand that also mends the hashes is one of another run.
#[test]
fn rows_in_disorder_are_found() {
    let all = lines();
    let swapped = [&all[..13], &[all[14], all[13]], &all[15..]].concat().join("\n");
    assert_eq!(damage(&swapped), (14, Damage::Chain { from: 14 }));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// All but a line break at the end that became one of another system.
    #[test]
    fn any_edited_byte_is_found(place in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let mut bytes = TEXT.clone().into_bytes();
        let place = place.index(bytes.len());
        prop_assume!(bytes[place] != byte);
        bytes[place] = byte;
        let harmless = place + 1 == bytes.len() && byte == b'\r';
        prop_assert_eq!(Golden::of_bytes(&bytes).is_ok(), harmless, "{} {}", place, byte);
    }

    #[test]
    fn any_lost_or_added_byte_is_found(
        place in any::<prop::sample::Index>(),
        byte in any::<u8>(),
        added in any::<bool>(),
    ) {
        let mut bytes = TEXT.clone().into_bytes();
        let place = place.index(bytes.len());
        let harmless = if added {
            let same = bytes[place];
            bytes.insert(place, byte);
            byte == b'\r' && same == b'\n'
        } else {
            bytes.remove(place);
            place == bytes.len()
        };
        prop_assert_eq!(Golden::of_bytes(&bytes).is_ok(), harmless, "{} {}", place, byte);
    }

    /// A file that ends anywhere.
    #[test]
    fn any_cut_is_found(place in any::<prop::sample::Index>()) {
        let end = place.index(TEXT.len() - 1);
        prop_assert!(Golden::of_bytes(&TEXT.as_bytes()[..end]).is_err(), "{}", end);
    }
}
