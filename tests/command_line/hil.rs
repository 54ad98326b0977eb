//! `hil`: both ends on this machine, controllers as child processes, and what is refused.

use std::net::TcpListener;
use std::thread;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, call};

fn free_port() -> String {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string()
}

/// Serves a scene, drives it, and how both ended.
fn both(scene: &str, serving: &[&str], driving: &[&str]) -> (Done, Done) {
    let port = free_port();
    let (listen, connect) = (format!("tcp-listen:{port}"), format!("tcp:{port}"));
    let serve = [&["hil", scene, "--serve", "--port", &listen, "--json"], serving].concat();
    thread::scope(|scope| {
        let served = scope.spawn(|| call(&serve));
        let driven = call(&[&["hil", scene, "--port", &connect], driving].concat());
        (served.join().unwrap(), driven)
    })
}

fn json(done: &Done) -> Value {
    serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{} {}", done.out, done.err))
}

#[test]
fn a_controller_in_a_shell_drives_a_plant_whose_bits_are_followed() {
    let folder = Folder::new();
    let trace = folder.path("trace.csv");
    // It pushes against the velocity, the fifth number of a line.
    let csv = r#"sh -c 'read head; while IFS=, read s t x y z v rest; do case $v in -*) echo 1;; *) echo -1;; esac; done'"#;
    let options = ["--duration", "0.2s", "--steps", "2", "--json", "--controller", csv, "--trace"];
    let (served, driven) =
        both("cart-pendulum", &[], &[&options[..], &[trace.to_str().unwrap()]].concat());
    assert_eq!((driven.exit, driven.err.as_str()), (Exit::Done, ""));
    let (plant, report) = (json(&served), json(&driven));
    assert_eq!(
        (&report["steps"], &report["compared"], &report["different"]),
        (&400.into(), &200.into(), &0.into())
    );
    assert_eq!((&plant["hash"], &plant["steps"]), (&report["hash"], &report["steps"]));
    let rows = std::fs::read_to_string(&trace).unwrap();
    let head = "step,time,drive,cart_point.x,cart_point.y,cart_point.z,cart_velocity.x,\
                cart_velocity.y,cart_velocity.z,angle,rate,compared";
    assert_eq!(rows.lines().next(), Some(head));
    assert_eq!(rows.lines().count(), 201);
    for row in rows.lines().skip(2) {
        let values: Vec<&str> = row.split(',').collect();
        let expected = if values[6].starts_with('-') { "1" } else { "-1" };
        assert_eq!((values[2], values[11]), (expected, "equal"), "{row}");
    }
    // The file is not replaced unasked.
    let again = call(&[
        "hil",
        "cart-pendulum",
        "--port",
        "tcp:127.0.0.1:1",
        "--trace",
        trace.to_str().unwrap(),
    ]);
    assert_eq!(again.exit, Exit::Refused);
    assert!(again.err.contains("exists") && again.err.contains("--overwrite"), "{}", again.err);
}

#[test]
fn lines_may_be_json() {
    let answer = r#"sh -c 'while read line; do echo "{\"drive\": 0.5}"; done'"#;
    let options = ["--duration", "0.05s", "--json", "--lines", "json", "--controller", answer];
    let (_, driven) = both("cart-pendulum", &[], &options);
    assert_eq!((driven.exit, driven.err.as_str()), (Exit::Done, ""));
    let (_, constant) = both(
        "cart-pendulum",
        &[],
        &[
            "--duration",
            "0.05s",
            "--json",
            "--controller",
            "sh -c 'while read line; do echo 0.5; done'",
        ],
    );
    // The first line to a controller of CSV is answered, too: it is the names', and one answer ahead changes no constant.
    assert_eq!(json(&driven)["hash"], json(&constant)["hash"]);
}

/// Planar, fixed point, joint-wise damping, generalized-alpha, tables that drive inputs, laws that remember.
#[test]
fn every_method_is_followed() {
    let laws = concat!(env!("CARGO_MANIFEST_DIR"), "/fuzz/corpus/scene/contact.toml");
    for (scene, options) in [
        ("four-bar", &["--precision", "f64", "--planar", "--scheme", "dbd"][..]),
        ("four-bar", &["--precision", "fixed"]),
        ("double-wishbone", &["--damping", "joint-wise"]),
        ("four-bar", &["--scheme", "generalized-alpha", "--step", "1ms", "--precision", "f64"]),
        ("delta-pick-and-place", &[]),
        ("delta-pick-and-place", &["--without-tables"]),
        (laws, &["--step", "50us"]),
    ] {
        let driving =
            [options, &["--json", "--duration", "0.02s", "--controller", "noise"]].concat();
        let (served, driven) = both(scene, options, &driving);
        assert_eq!((driven.exit, driven.err.as_str()), (Exit::Done, ""), "{scene} {options:?}");
        let report = json(&driven);
        assert_eq!((&report["different"], &report["unknown"]), (&0.into(), &0.into()));
        assert_eq!(json(&served)["hash"], report["hash"], "{scene} {options:?}");
    }
}

#[test]
fn what_is_wrong_is_named() {
    let refused = |arguments: &[&str], words: &str| {
        let done = call(&[&["hil"], arguments].concat());
        assert_eq!(done.exit, Exit::Refused, "{arguments:?} {}", done.err);
        assert!(done.err.contains(words), "{arguments:?} {}", done.err);
    };
    refused(&["four-bar"], "--port");
    refused(&["four-bar", "--port", "tcp:nowhere"], "HOST:PORT");
    refused(&["four-bar", "--port", "carrier-pigeon"], "is not a port");
    refused(
        &["four-bar", "--port", "tcp:127.0.0.1:1", "--disturb", "lose=1%"],
        "is not a disturbance",
    );
    refused(&["four-bar", "--port", "tcp:127.0.0.1:1", "--silence", "60s"], "STEP:TIME");
    refused(&["four-bar", "--port", "tcp:127.0.0.1:1", "--steps", "0"], "0 is not in 1..");
    refused(&["four-bar", "--port", "tcp:127.0.0.1:1", "--period", "1ms"], "--serve");
    refused(
        &["four-bar", "--port", "tcp:127.0.0.1:1", "--controller", "no-such-program"],
        "cannot start",
    );
    refused(&["four-bar", "--port", "tcp:127.0.0.1:1", "--step", "0s"], "step");
    let failed = |arguments: &[&str], words: &str| {
        let done = call(&[&["hil"], arguments].concat());
        assert_eq!(done.exit, Exit::Failed, "{arguments:?} {}", done.err);
        assert!(done.err.contains(words), "{arguments:?} {}", done.err);
    };
    let nobody = format!("tcp:{}", free_port());
    failed(&["four-bar", "--port", &nobody, "--patience", "100ms"], "cannot open");
    failed(&["four-bar", "--port", "/dev/no-such-tty", "--patience", "100ms"], "cannot open");
}

#[test]
fn another_model_is_refused_with_what_differs() {
    for (option, words) in [
        (&["--set", "body.cart.mass=0.95"][..], "model (constants or initial state)"),
        (&["--precision", "f64"], "precision differs"),
        (&["--step", "250us"], "step differs"),
        (&["--scheme", "semi-implicit-euler"], "scheme or damping differs"),
    ] {
        let driving = [option, &["--patience", "500ms", "--answer", "50ms"]].concat();
        let (_, driven) = both("cart-pendulum", &["--patience", "700ms"], &driving);
        assert_eq!(driven.exit, Exit::Failed, "{}", driven.err);
        assert!(driven.err.contains(words), "{}", driven.err);
        assert!(driven.err.contains("the plant has cart-pendulum"), "{}", driven.err);
    }
}

#[test]
fn a_controller_that_fails_ends_the_run() {
    for (controller, words) in [
        ("sh -c 'exit 7'", "exit status: 7"),
        ("sh -c 'while read line; do echo x; done'", "answered `x`"),
        ("sh -c 'while read line; do echo 1,2; done'", "2 numbers given for the inputs drive"),
    ] {
        let (_, driven) =
            both("cart-pendulum", &["--patience", "500ms"], &["--controller", controller]);
        assert_eq!(driven.exit, Exit::Failed, "{}", driven.err);
        assert!(driven.err.contains(words), "{}", driven.err);
    }
}
