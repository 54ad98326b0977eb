//! `fmu`: what is written, and what is refused. That importers take it is for `crates/fmu/importers`.

use std::fs;

use host_sim::terminal::Exit;

use crate::{Folder, call};

/// A file that begins as a library for Linux does and says what ours say.
pub fn library() -> Vec<u8> {
    let mut bytes = b"\x7fELF".to_vec();
    bytes.resize(64, 0);
    bytes[18] = 62;
    bytes.extend(concat!("dbd-fmu reads resources of ", env!("CARGO_PKG_VERSION")).bytes());
    bytes
}

#[test]
fn an_fmu_is_written_whole_and_the_same_each_time() {
    let folder = Folder::new();
    let (file, given) = (folder.path("cart.fmu"), folder.path("library.so"));
    let [file, given] = [&file, &given].map(|path| path.to_str().unwrap());
    fs::write(given, library()).unwrap();
    let options = ["--library", given, "--out", file, "--set", "body.cart.mass=1.2"];
    let mut sizes = Vec::new();
    for (version, place) in [("2", "binaries/linux64/"), ("3", "binaries/x86_64-linux/")] {
        let fmu = || call(&[&["fmu", "cart-pendulum", "--fmi", version][..], &options].concat());
        let done = fmu();
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        assert!(
            done.out.contains("cart.fmu: FMI ") && done.out.contains("step 500us, inputs: 1"),
            "{}",
            done.out
        );
        let bytes = fs::read(file).unwrap();
        let holds = |text: &str| bytes.windows(text.len()).any(|part| part == text.as_bytes());
        for name in ["modelDescription.xml", "resources/scene.toml", "documentation/index.html"] {
            assert!(holds(name), "{name}");
        }
        assert!(holds(&format!("{place}dbd_fmu.so")));
        fmu();
        assert!(fs::read(file).unwrap() == bytes);
        sizes.push(bytes.len());
    }
    assert_ne!(sizes[0], sizes[1]);
}

#[test]
fn nothing_is_written_where_something_is_wrong() {
    let folder = Folder::new();
    let (file, given) = (folder.path("cart.fmu"), folder.path("library.so"));
    let [file_text, given_text] = [&file, &given].map(|path| path.to_str().unwrap());
    let call_with = |more: &[&str]| {
        call(
            &[&["fmu", "cart-pendulum", "--out", file_text, "--library", given_text][..], more]
                .concat(),
        )
    };
    let refused = |more: &[&str], words: &str| {
        let done = call_with(more);
        assert_eq!(done.exit, Exit::Refused, "{}", done.err);
        assert!(done.err.contains(words), "{}", done.err);
        assert!(!file.exists());
    };
    refused(&[], "cargo build --release -p dbd-fmu");
    fs::write(&given, b"\x7fELF and something else").unwrap();
    refused(&[], "is not a library of dbd-fmu");
    let mut other = library();
    other.truncate(70);
    fs::write(&given, other).unwrap();
    refused(&[], "does not read the resources");
    fs::write(&given, library()).unwrap();
    refused(&["--fmi", "1"], "possible values: 2, 3");
    refused(&["--set", "body.cart.mass=-1"], "body.cart.mass=-1");
    refused(&["--newton", "2"], "has no Newton iterations");
    refused(&["--step", "0s"], "step");
    fs::write(&file, "a letter").unwrap();
    let done = call_with(&[]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("is not an FMU"), "{}", done.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), "a letter");
    let nowhere = folder.path("none/cart.fmu");
    let done =
        call(&["fmu", "four-bar", "--library", given_text, "--out", nowhere.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Failed);
}
