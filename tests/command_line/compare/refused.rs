//! Traces that are damaged, of other runs or of earlier versions.

use std::fs;
use std::path::{Path, PathBuf};

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::compare::Bench;
use crate::{Folder, call};

/// Every way in which a trace may be damaged, planted one by one.
#[test]
fn what_is_damaged_is_refused_with_its_place() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--set", "description=it swings"]));
    let [trace, summary] = ["trace.csv", "summary.json"].map(|name| PathBuf::from(&b).join(name));
    let (text, keys) = (fs::read_to_string(&trace).unwrap(), fs::read_to_string(&summary).unwrap());
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
    fs::remove_dir_all(bench.folder.path("reports")).unwrap();
    let refused = |bytes: &[u8], keys: &str, parts: &[&str]| {
        fs::write(&trace, bytes).unwrap();
        fs::write(&summary, keys).unwrap();
        for (one, two) in [(&a, &b), (&b, &a)] {
            let done = bench.compare(one, two, &[]);
            assert_eq!(done.exit, Exit::Refused, "{parts:?}: {}", done.out);
            for part in parts {
                assert!(done.err.contains(part), "{part}: {}", done.err);
            }
            assert_eq!(done.out, "");
            assert!(!bench.folder.path("reports").exists());
        }
    };
    let lines: Vec<&str> = text.lines().collect();
    let without = |row: usize| {
        let kept = lines
            .iter()
            .enumerate()
            .filter(|(of, _)| *of != row)
            .map(|(_, line)| format!("{line}\n"));
        kept.collect::<String>()
    };
    // Line 1 has the names, line 2 is t = 0.
    let with = |row: usize, column: usize, value: &str| {
        let edited = lines.iter().enumerate().map(|(of, line)| {
            let fields = line.split(',').enumerate();
            let fields: Vec<&str> = fields
                .map(|(at, field)| if (of, at) == (row, column) { value } else { field })
                .collect();
            fields.join(",") + "\n"
        });
        edited.collect::<String>()
    };
    let cut = |bytes: usize| text.as_bytes()[..bytes].to_vec();
    let middle = text.len() - lines[21].len() / 2 - 1;
    let ends = "trace.csv:21: the trace ends after 20 of 21 rows, at t = 0.19s";
    refused(
        &cut(middle),
        &keys,
        &["trace.csv:22: the file ends within this line", "run the scene again"],
    );
    refused(&cut(text.len() - 1), &keys, &["trace.csv:22: the file ends within this line"]);
    refused(without(21).as_bytes(), &keys, &[ends, "summary.json states a run to 0.2s"]);
    refused(
        without(9).as_bytes(),
        &keys,
        &["trace.csv:10: rows are missing before this one, t = 90ms: they come every 10ms"],
    );
    refused(without(1).as_bytes(), &keys, &["trace.csv:2: the first row is at t = 10ms, not at 0"]);
    refused(
        without(0).as_bytes(),
        &keys,
        &["trace.csv:1:1: column 1: found `0.0`, expected `time`"],
    );
    let twice = text.clone() + lines[21] + "\n";
    refused(twice.as_bytes(), &keys, &["trace.csv:23: the time 0.2s is not after"]);
    refused(b"", &keys, &["trace.csv: is empty"]);
    refused(cut(lines[0].len() + 1).as_slice(), &keys, &["trace.csv:1: the trace has no rows"]);
    // Numbers.
    refused(
        with(4, 3, "0.25").as_bytes(),
        &keys,
        &["trace.csv: the text is not the one that was written", "trace_hash"],
    );
    refused(
        with(21, 3, "0.25").as_bytes(),
        &keys,
        &["trace.csv:22: the last row does not match `state_hash`"],
    );
    let place = |row: usize, column: usize| {
        let before: usize = lines[row].split(',').take(column).map(|field| field.len() + 1).sum();
        format!("trace.csv:{}:{}: ", row + 1, before + 1)
    };
    for (value, part) in [
        ("nan", "column `bob.y`: `nan` is not a number as written in a trace"),
        ("NaN", "column `bob.y`: `NaN` is not finite, as it must be in every row"),
        ("-1.#IND", "column `bob.y`: `-1.#IND` is not a number as written in a trace"),
        ("#REF!", "column `bob.y`: `#REF!` is not a number as written in a trace"),
        ("", "column `bob.y`: `` is not a number as written in a trace"),
        (" 1.0", "column `bob.y`: ` 1.0` is not a number as written in a trace"),
        ("1e400", "column `bob.y`: `1e400` is not a number as written in a trace"),
    ] {
        refused(with(6, 2, value).as_bytes(), &keys, &[&(place(6, 2) + part)]);
    }
    refused(
        with(6, 2, "0,8").as_bytes(),
        &keys,
        &["trace.csv:7:", "the line has 22 columns, not 21"],
    );
    refused(
        with(6, 0, "0.0501").as_bytes(),
        &keys,
        &["trace.csv:7:1: the time 0.0501 s is not a multiple of the step"],
    );
    refused(with(6, 0, "0.051").as_bytes(), &keys, &["trace.csv:7: rows are missing"]);
    // Columns.
    refused(
        with(0, 3, "bob.q").as_bytes(),
        &keys,
        &["trace.csv:1:18: column 4: found `bob.q`, expected `bob.z`"],
    );
    let columns = |to: usize| lines[0].split(',').take(to).collect::<Vec<_>>().join(",");
    let shorter = text.replacen(lines[0], &columns(20), 1);
    refused(
        shorter.as_bytes(),
        &keys,
        &["trace.csv:1: the read-outs are tip.x, tip.y, tip.z, those of"],
    );
    let shorter = text.replacen(lines[0], &columns(16), 1);
    refused(shorter.as_bytes(), &keys, &["trace.csv:1:", "`energy.total` is missing"]);
    // Other encodings and separators.
    let semicolons = text.lines().map(|line| line.replace(',', ";") + "\n").collect::<String>();
    refused(
        semicolons.as_bytes(),
        &keys,
        &["trace.csv:1:1: column 1: ", "separated by commas, not semicolons"],
    );
    let wide: Vec<u8> =
        [0xfffe].into_iter().chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect();
    refused(&wide, &keys, &["trace.csv:1:1: the file is UTF-16"]);
    refused(
        &[b"\xef\xbb\xbf", text.as_bytes()].concat(),
        &keys,
        &["trace.csv:1:1: the file begins with a byte order mark"],
    );
    let latin = [&text.as_bytes()[..10], b"\xe9", &text.as_bytes()[10..]].concat();
    refused(&latin, &keys, &["trace.csv:1:11: the byte 0xe9 is not UTF-8"]);
    refused(&[0x1f, 0x8b, 8, 0], &keys, &["trace.csv:1:1: the file is compressed (gzip)"]);
    let endless = text.replacen(lines[7], &"1".repeat(2_000_000), 1);
    refused(endless.as_bytes(), &keys, &["trace.csv:8: the line is longer than 672 bytes"]);
    // Another version, another run, no summary of a run.
    let later = keys.replacen('{', "{ \"trace_format\": 2, \"version\": \"9.0.0\",", 1);
    let later = later.replace(",\n  \"trace_format\": 1", "").replace(&version(&keys), "");
    refused(
        text.as_bytes(),
        &later,
        &["summary.json: its trace is of format 2, written by host-sim 9.0.0", "reads format 1"],
    );
    let other = fs::read_to_string(
        Path::new(&bench.run("c", &["--duration", "0.1s", "--set", "description=it swings"]))
            .join("summary.json"),
    );
    refused(text.as_bytes(), &other.unwrap(), &["the trace has 21 rows, to t = 0.2s, more than"]);
    refused(
        text.as_bytes(),
        "{\n \"scene\": 1",
        &["summary.json:2:11: is not a summary of a run: invalid type"],
    );
    refused(
        text.as_bytes(),
        "{}",
        &["summary.json:1:2: is not a summary of a run: missing field `scene`"],
    );
    refused(text.as_bytes(), &keys.replace("\"f64\"", "\"f16\""), &["unknown precision `f16`"]);
    refused(
        text.as_bytes(),
        &keys.replace("\"step\": 0.001", "\"step\": 0.0"),
        &["`step` is 0, which is not a valid step"],
    );
    // A file is missing.
    fs::write(&summary, &keys).unwrap();
    fs::remove_file(&trace).unwrap();
    let done = bench.compare(&a, &b, &[]);
    assert!(
        done.exit == Exit::Refused && done.err.contains("trace.csv is missing next to it"),
        "{}",
        done.err
    );
    fs::write(&trace, &text).unwrap();
    fs::remove_file(&summary).unwrap();
    for named in [&b, &format!("{b}/trace.csv")] {
        let done = bench.compare(&a, named, &[]);
        assert!(
            done.exit == Exit::Refused && done.err.contains("summary.json is missing next to it"),
            "{}",
            done.err
        );
    }
    for (named, part) in [
        (bench.folder.path("nowhere"), "no such file or folder"),
        (bench.folder.path("."), "contains no run: trace.csv and summary.json are missing"),
        (PathBuf::from(&bench.scene), "contains neither a run nor a golden file"),
    ] {
        let done = bench.compare(&a, named.to_str().unwrap(), &[]);
        assert!(done.exit == Exit::Refused && done.err.contains(part), "{part}: {}", done.err);
    }
    // Line ends of another system are no edit.
    fs::write(&summary, &keys).unwrap();
    fs::write(&trace, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
}

/// The key of the version with its comma, as a summary has it; nothing where it has none.
fn version(keys: &str) -> String {
    let line = keys.lines().find(|line| line.trim_start().starts_with("\"version\""));
    line.map(|line| format!("\n{line}")).unwrap_or_default()
}

/// Of earlier versions there is no hash of the trace: read, and said.
#[test]
fn a_summary_of_an_earlier_version_is_read() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &[]));
    let summary = PathBuf::from(&b).join("summary.json");
    let keys: Value = serde_json::from_str(&fs::read_to_string(&summary).unwrap()).unwrap();
    let Value::Object(mut keys) = keys else { panic!() };
    keys.retain(|key, _| {
        !["trace_hash", "version", "trace_format", "samples", "turns"].contains(&key.as_str())
    });
    fs::write(&summary, Value::Object(keys).to_string()).unwrap();
    let (json, exit) = bench.json(&a, &b, &[]);
    assert_eq!((exit, &json["verdict"]), (Exit::Done, &"equal".into()));
    assert!(json["notes"][0].as_str().unwrap().contains("without a hash of its trace"), "{json}");
    let trace = PathBuf::from(&b).join("trace.csv");
    let text = fs::read_to_string(&trace).unwrap();
    let shorter: String = text.lines().take(15).map(|line| format!("{line}\n")).collect();
    fs::write(&trace, shorter).unwrap();
    let done = bench.compare(&a, &b, &[]);
    assert!(done.exit == Exit::Refused && done.err.contains("rows are missing"), "{}", done.err);
}

/// Turn counts are in the hash and in no column; a read-out may be without a number.
#[test]
fn turned_springs_and_undefined_readouts_are_read_back() {
    let folder = Folder::new();
    let [a, b] = ["a", "b"].map(|name| {
        let out = folder.path(name);
        let line = [
            "run",
            "crank-slider",
            "--quiet",
            "--duration",
            "0.5s",
            "--step",
            "50us",
            "--out",
            out.to_str().unwrap(),
        ];
        let done = call(&line);
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        out.join("crank-slider").to_str().unwrap().to_owned()
    });
    let out = folder.path("reports");
    let done = call(&["compare", &a, &b, "--out", out.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Done, "{} {}", done.out, done.err);
}
