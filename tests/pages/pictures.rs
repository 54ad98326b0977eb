//! Pictures of mechanisms in the pages: what `host-sim check SCENE --svg` writes.

use dbd_report::picture::Paper;
use dbd_tests::page::file;
use dbd_tests::scene;
use host_sim::commands::picture::picture;

/// Those that pages show.
const SHOWN: [&str; 2] = ["3ruu", "double-wishbone"];

#[test]
fn pictures_of_the_pages_show_the_scenes() {
    for name in SHOWN {
        let drawn = picture(&scene(name), Paper::File);
        file(&format!("docs/pictures/{name}.svg"), &drawn, "cargo test -p dbd-tests --test pages");
    }
}
