//! Golden files: what is written, when, and what is not.

use std::fs;
use std::path::{Path, PathBuf};

use crate::shared::{four_bar, plant, record, scene};
use dbd_golden::{
    Bands, Blessing, GoldenError, GoldenFile, Mismatch, Recording, Tolerance, Verdict,
};
use dbd_kernel::{F32, F64, Leapfrog, Plant};

fn check(
    path: &Path,
    recording: &Recording,
    tolerance: &Tolerance<'_>,
    blessing: Blessing,
) -> Result<Verdict, GoldenError> {
    GoldenFile::new(path).open(recording, tolerance, blessing)?.check(recording, tolerance)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The four-bar's run with one number nudged at step 100.
fn nudged() -> Recording {
    let scene = scene("four-bar");
    let mut plant = plant::<F32>(&scene);
    let mut recording = Recording::of_scene(&scene, &plant, 50, &[]).unwrap();
    for step in [0, 50, 100, 150, 200] {
        if step == 100 {
            let mut state = plant.state().clone();
            state.bodies[0].angular_velocity.z += 1e-3;
            plant.set_state(state).unwrap();
        }
        recording.look(&plant).unwrap();
        plant.advance(50).unwrap();
    }
    recording
}

#[test]
fn nothing_is_written_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.golden");
    let missing = check(&path, &four_bar(), &Tolerance::Bits, Blessing::No).unwrap_err();
    assert!(matches!(missing, GoldenError::Missing { .. }));
    let words = format!("{missing:?}");
    assert!(words.contains("a.golden") && words.contains("DBD_BLESS=golden"), "{words}");
    for blessing in [Blessing::Refused, Blessing::Yes] {
        // By another method no file is made: whose would it be?
        let tolerance = match blessing {
            Blessing::Yes => Tolerance::AnyMethod(Bands::all(1.0)),
            _ => Tolerance::Bits,
        };
        assert!(check(&path, &four_bar(), &tolerance, blessing).is_err());
    }
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn a_blessed_file_is_compared_and_a_difference_is_written_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    // Its folder is made with it.
    let path = folder.path().join("golden/a.golden");
    let blessed = check(&path, &four_bar(), &Tolerance::Bits, Blessing::Yes).unwrap();
    assert_eq!(blessed, Verdict::Blessed { path: path.clone(), before: None });
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text, four_bar().text());
    let same = check(&path, &four_bar(), &Tolerance::Bits, Blessing::No).unwrap();
    assert!(matches!(&same, Verdict::Same(summary) if summary.samples == 5), "{same}");

    let refused = check(&path, &nudged(), &Tolerance::Bits, Blessing::No).unwrap_err();
    let new = PathBuf::from(format!("{}.new", path.display()));
    let GoldenError::Different { mismatch, new: written, .. } = &refused else {
        panic!("{refused}")
    };
    assert!(matches!(&**mismatch, Mismatch::Difference(found) if found.step == 100));
    assert_eq!(written.as_ref().unwrap(), &new);
    assert_eq!(fs::read_to_string(&new).unwrap(), nudged().text());
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    let words = refused.to_string();
    for part in ["a.golden: step 100", "crank.wz", "a.golden.new", "DBD_BLESS=golden"] {
        assert!(words.contains(part), "{part}: {words}");
    }

    // Within its bands it is no difference, and what was left of the last one goes.
    let wide = Tolerance::Within(Bands::all(1.0));
    let within = check(&path, &nudged(), &wide, Blessing::No).unwrap();
    assert!(within.to_string().contains("within their bands"), "{within}");
    assert_eq!(names(new.parent().unwrap()), ["a.golden"]);

    // Blessed, it is the golden one, and it is said what changed.
    let blessed = check(&path, &nudged(), &Tolerance::Bits, Blessing::Yes).unwrap();
    let words = blessed.to_string();
    assert!(words.contains("blessed") && words.contains("crank.wz"), "{words}");
    assert_eq!(fs::read_to_string(&path).unwrap(), nudged().text());
    let again = check(&path, &nudged(), &Tolerance::Bits, Blessing::Yes).unwrap();
    assert!(matches!(again, Verdict::Same(_)));
}

#[test]
fn a_build_server_blesses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.golden");
    fs::write(&path, four_bar().text()).unwrap();
    for run in [four_bar(), nudged()] {
        let refused = check(&path, &run, &Tolerance::Bits, Blessing::Refused).unwrap_err();
        assert!(matches!(refused, GoldenError::OnServer { .. }));
        assert!(refused.to_string().contains("CI"), "{refused}");
    }
    assert_eq!(fs::read_to_string(&path).unwrap(), four_bar().text());
    assert_eq!(names(folder.path()), ["a.golden"]);
}

/// A run by another method is compared with the golden one of its owner, and never takes its place.
#[test]
fn another_method_does_not_replace_the_golden_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.golden");
    fs::write(&path, four_bar().text()).unwrap();
    let double = record(&mut plant::<F64>(&scene("four-bar")));
    let any = |band| Tolerance::AnyMethod(Bands::all(band));
    assert!(matches!(check(&path, &double, &any(1.0), Blessing::Yes), Ok(Verdict::Same(_))));
    let refused = check(&path, &double, &any(1e-12), Blessing::Yes);
    assert!(matches!(refused, Err(GoldenError::Different { .. })));
    assert_eq!(names(folder.path()), ["a.golden", "a.golden.leapfrog-f64.new"]);
    assert_eq!(fs::read_to_string(&path).unwrap(), four_bar().text());
    assert!(check(&path, &double, &any(1.0), Blessing::No).is_ok());
    assert_eq!(names(folder.path()), ["a.golden"]);
    // Bit for bit it is not compared at all, and nothing is left of that.
    let refused = check(&path, &double, &Tolerance::Bits, Blessing::No).unwrap_err();
    let GoldenError::Unlike { mismatch, .. } = refused else { panic!("{refused}") };
    assert!(matches!(*mismatch, Mismatch::Precision { .. }), "{mismatch}");
    assert_eq!(names(folder.path()), ["a.golden"]);
}

#[test]
fn a_file_that_is_none_of_ours_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    for content in [b"name = \"a\"\n".as_slice(), b"", b"\xff\xfe"] {
        fs::write(&path, content).unwrap();
        for blessing in [Blessing::No, Blessing::Yes] {
            let refused = check(&path, &four_bar(), &Tolerance::Bits, blessing).unwrap_err();
            assert!(matches!(refused, GoldenError::Unlike { .. }), "{refused}");
            assert!(refused.to_string().contains("line 1: "), "{refused}");
        }
        assert_eq!(fs::read(&path).unwrap(), content);
    }
    // A damaged one of ours is, and one of another step or version.
    let finer = Plant::new(Box::new(scene("four-bar").model.convert::<F32>()), Leapfrog, 1e-5);
    let others = [
        four_bar().text().replacen("0.", "1.", 1),
        four_bar().text().replacen("golden 1", "golden 2", 1),
        record(&mut finer.unwrap()).text(),
    ];
    for (other, what) in others.iter().zip(["line 13", "version 2", "step"]) {
        fs::write(&path, other).unwrap();
        assert!(check(&path, &four_bar(), &Tolerance::Bits, Blessing::No).is_err());
        let blessed = check(&path, &four_bar(), &Tolerance::Bits, Blessing::Yes).unwrap();
        assert!(blessed.to_string().contains(what), "{blessed}");
        assert_eq!(fs::read_to_string(&path).unwrap(), four_bar().text());
    }
}

/// What cannot be read or written is said with its reason; the difference is said all the same.
#[test]
fn what_cannot_be_read_or_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let refused = check(folder.path(), &four_bar(), &Tolerance::Bits, Blessing::No).unwrap_err();
    assert!(matches!(refused, GoldenError::Unreadable { .. }), "{refused}");
    let path = folder.path().join("a.golden");
    fs::write(&path, four_bar().text()).unwrap();
    // A folder is where the new file would be.
    fs::create_dir_all(folder.path().join("a.golden.new/full")).unwrap();
    let refused = check(&path, &nudged(), &Tolerance::Bits, Blessing::No).unwrap_err();
    assert!(matches!(&refused, GoldenError::Different { new: Err(_), .. }), "{refused}");
    assert!(refused.to_string().contains("cannot be written"), "{refused}");
    let below = path.join("b.golden");
    let refused = check(&below, &four_bar(), &Tolerance::Bits, Blessing::Yes).unwrap_err();
    assert!(
        matches!(refused, GoldenError::Unwritable { .. } | GoldenError::Unreadable { .. }),
        "{refused}"
    );
}

#[test]
#[should_panic(expected = "cannot read Cargo.toml/none.golden: ")]
fn an_assertion_fails_with_the_message() {
    GoldenFile::new("Cargo.toml/none.golden").assert(&four_bar(), &Tolerance::Bits);
}
