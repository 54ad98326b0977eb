//! Pictures of mechanisms in the pages: what `host-sim check SCENE --svg` writes.

use dbd_picture::Paper;
use dbd_tests::scene;
use host_sim::commands::picture::picture;

/// Those that pages show.
const SHOWN: [&str; 2] = ["3ruu", "double-wishbone"];

#[test]
fn pictures_of_the_pages_show_the_scenes() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/pictures");
    for name in SHOWN {
        let (file, drawn) = (format!("{folder}/{name}.svg"), picture(&scene(name), Paper::File));
        if std::env::var_os("DBD_BLESS").is_some_and(|value| value == "1") {
            std::fs::write(&file, &drawn).unwrap();
        }
        let present = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(present == drawn, "{file}: DBD_BLESS=1 cargo test -p dbd-tests --test pages");
    }
}
