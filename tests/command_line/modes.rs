//! `run --modes`: frequencies in the summary and on the terminal, shapes in the page, words where they mislead.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;

use host_sim::terminal::Exit;

use crate::{Folder, PENDULUM};

#[test]
fn the_lowest_modes_are_in_summary_table_and_page() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    // More than there are is all of them: along the spring, and five that nothing holds.
    let summary = folder.summary(&scene, &["--modes", "9"]);
    let modes: Vec<f64> = serde_json::from_value(summary["modes"].clone()).unwrap();
    assert_eq!(modes[..5], [0.0; 5]);
    assert!((modes[5] / ((2e3_f64 / 0.5).sqrt() / TAU) - 1.0).abs() < 1e-6, "{modes:?}");
    assert_eq!(modes.len(), 6);
    let warnings = summary["warnings"].to_string();
    assert!(warnings.contains("`bob` is unsupported and accelerates"), "{warnings}");
    let page = fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert_eq!(page.matches("{\"frequency\":0.0,\"shape\":").count(), 5);
    assert!(page.contains("--modes 6") && page.contains("{\"frequency\":10.06"));
    // So many as were asked for.
    let done = folder.run(&scene, &["--modes", "2"]);
    assert!(done.out.contains("lowest modes") && done.out.contains("2 × 0 Hz"), "{}", done.out);
    let plain = folder.summary(&scene, &[]);
    assert!(plain.get("modes").is_none() && plain["warnings"] == serde_json::json!([]));
    let page = fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert!(!page.contains("\"frequency\":"));
}

#[test]
fn too_many_bodies_and_no_modes_are_refused_before_anything_is_written() {
    let folder = Folder::new();
    let mut text = "name = \"many\"\ngravity = [0, 0, 0]\nduration = 0.01\n".to_owned();
    for row in 0..201 {
        let _ = writeln!(
            text,
            "[[body]]\nname = \"b{row}\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [{row}, 0, 0]"
        );
    }
    let done = folder.run(&folder.scene(&text), &["--modes", "3"]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("201 bodies") && done.err.contains("200"), "{}", done.err);
    for wrong in ["0", "-1", "1e9", "x"] {
        let done = folder.run(&folder.scene(PENDULUM), &["--modes", wrong]);
        assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""), "{wrong}");
        assert!(done.err.contains("--modes"), "{}", done.err);
    }
    assert!(!folder.path("out").exists());
}
