//! The animations that `run --gltf` writes, judged by Khronos's glTF validator.
//!
//! The validator is a script, so the browser that looks at reports runs it.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

use crate::chromium::Browser;

/// The validator, see the folder's README.
const VALIDATOR: &str = include_str!("../gltf_validator/gltf_validator.dart.js");

/// What the validator says of files: no errors, no warnings; of one with a planted fault it says which.
pub fn animations(browser: &mut Browser, files: &[&Path]) {
    browser.run(&format!("var exports = {{}};\n{VALIDATOR};\ntrue"));
    for file in files {
        let report = validated(browser, &std::fs::read(file).unwrap());
        let issues = &report["issues"];
        let counts = (&issues["numErrors"], &issues["numWarnings"]);
        assert_eq!(counts, (&0.into(), &0.into()), "{}: {issues:#}", file.display());
        assert_eq!(report["info"]["version"], "2.0");
    }
    // The largest number that an accessor states is not the largest that it has.
    let mut planted = std::fs::read(files[0]).unwrap();
    let stated = b"\"max\":[";
    let at = planted.windows(stated.len()).position(|word| word == stated).unwrap() + stated.len();
    let digit = planted[at..].iter_mut().find(|byte| byte.is_ascii_digit()).unwrap();
    *digit = if *digit == b'7' { b'8' } else { b'7' };
    let report = validated(browser, &planted);
    let mut messages = report["issues"]["messages"].as_array().unwrap().iter();
    let found = messages.any(|message| message["code"] == "ACCESSOR_MAX_MISMATCH");
    assert!(found, "{report:#}");
}

fn validated(browser: &mut Browser, file: &[u8]) -> Value {
    let text = STANDARD.encode(file);
    browser.run(&format!(
        "exports.validateBytes(Uint8Array.from(atob('{text}'), (c) => c.charCodeAt(0)), {{}})"
    ))
}
