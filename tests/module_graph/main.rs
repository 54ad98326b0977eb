//! The modules of each crate lie on floors: what its documentation lists later uses what it lists
//! earlier, never the other way round, and no folder holds a circle.

mod picture;
mod rules;
mod sources;

use std::path::Path;

use dbd_tests::results::path;
use rules::{breaches, floors};
use sources::Sources;

/// The crates that are held to it.
const CRATES: &[&str] = &[
    "kernel",
    "crates/scene",
    "crates/node",
    "crates/plant",
    "crates/play",
    "crates/study",
    "crates/ensemble",
    "crates/fmu",
    "crates/report",
    "crates/golden",
    "crates/import",
    "crates/link",
    "host-sim",
    "python",
    "firmware/qemu",
    "firmware/stm32f405",
    "tests/bench",
    "tests/fuzz",
    "xtask",
];

fn sources(name: &str) -> Sources {
    Sources::of_crate(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name))
}

#[test]
fn modules_use_only_what_is_listed_before_them() {
    let mut all = String::new();
    for name in CRATES {
        for breach in breaches(&sources(name)) {
            all += &format!("{name}: {breach}\n");
        }
    }
    assert!(all.is_empty(), "\n{all}");
}

/// A library of the workspace cannot be left out.
#[test]
fn every_library_is_held_to_it() {
    for name in picture::crates(&path(".")).keys() {
        assert!(
            CRATES.contains(&name.as_str()),
            "add {name} to CRATES in tests/module_graph/main.rs"
        );
    }
}

/// The picture of `docs/architecture.md`, drawn from the sources; `DBD_BLESS=1` writes it.
#[test]
fn the_picture_shows_the_house_as_it_is() {
    let crates = picture::crates(&path("."));
    let listed = crates.keys().map(|name| (name.clone(), floors(&sources(name))));
    let drawn = picture::svg(&crates, &listed.collect());
    let command = "cargo test -p dbd-tests --test module_graph";
    dbd_tests::page::file("docs/architecture.svg", &drawn, command);
}

/// The breaches of a crate of these files below `src`.
fn planted(files: &[(&str, &str)]) -> Vec<String> {
    let text = |path: &str| {
        files.iter().find(|(name, _)| *name == path).map(|(_, text)| (*text).to_owned())
    };
    breaches(&Sources::read(&text))
}

const LIST: &str = "//! - [`ground`], `walls`: what bears.\n//! - [`roof`]: what\n//!   is borne.\n\
                    mod ground;\nmod walls;\npub mod roof;\npub use roof::Tile;\n";

#[test]
fn a_crate_on_floors_is_accepted() {
    let roof = "use crate::{ground::Stone, walls::{self, Brick as B}};\npub use self::tile::Tile;\n\
                mod tile;\nfn f() { walls::build() }";
    let none = planted(&[
        ("lib.rs", LIST),
        // Comments, strings, visibility and tests are no arrows.
        (
            "ground.rs",
            "//! Like [`crate::roof`].\n// use crate::roof::Tile;\n\
             pub(in crate::ground) const A: &str = \"crate::roof::Tile\";\n\
             #[cfg(test)]\nmod tests { use crate::roof::Tile; }\n\
             #[cfg(test)]\nuse crate::walls;",
        ),
        ("walls.rs", "use crate::ground;"),
        ("roof/mod.rs", roof),
        ("roof/tile.rs", "use crate::walls::Brick;"),
    ]);
    assert_eq!(none, [""; 0]);
}

#[test]
fn a_circle_is_found() {
    let found = planted(&[
        ("lib.rs", LIST),
        ("ground.rs", "macro_rules! m { () => { $crate::walls::Brick::new() } }"),
        ("walls.rs", "fn f(stone: &crate::ground::Stone) {}"),
        ("roof.rs", ""),
    ]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("ground.rs uses crate::walls::Brick::new"), "{found:?}");
    let found = planted(&[
        ("lib.rs", LIST),
        ("ground.rs", ""),
        ("walls.rs", ""),
        ("roof/mod.rs", "mod tile;\nmod beam;\nmod nail;\npub use self::nail::Nail;"),
        ("roof/tile.rs", "fn f() { use super::{beam::{\nBeam,\n}}; }"),
        ("roof/beam.rs", "use super::Nail;"),
        ("roof/nail.rs", ""),
    ]);
    assert!(found.is_empty(), "{found:?}");
    let found = planted(&[
        ("lib.rs", LIST),
        ("ground.rs", ""),
        ("walls.rs", ""),
        ("roof/mod.rs", "mod tile;\nmod beam;\nmod nail;\npub use {nail::Nail, tile::Tile};"),
        ("roof/tile.rs", "fn f() { use super::{beam::{\nBeam,\n}}; }"),
        ("roof/beam.rs", "use super::Nail;"),
        ("roof/nail.rs", "use crate::Tile;"),
    ]);
    assert_eq!(found, ["circle within roof: beam → nail → tile → beam"]);
}

#[test]
fn an_upward_arrow_is_found() {
    for line in [
        "use crate::roof::Tile;",
        "use crate::Tile;",
        "use super::roof;",
        "use crate::{\n    ground::Stone,\n    roof::{Tile, Ridge},\n};",
        "const A: usize = crate::roof::SIZE;",
        "impl Wall { fn f() { println!(\"{}\", crate::roof::SIZE); } }",
    ] {
        let found = planted(&[
            ("lib.rs", LIST),
            ("ground.rs", ""),
            ("walls.rs", line),
            ("roof.rs", "pub struct Tile;"),
        ]);
        let upward = |breach: &String| breach.contains("`roof` stands after `walls` in the list");
        assert!(!found.is_empty() && found.iter().all(upward), "{line}: {found:?}");
    }
    let found = planted(&[
        ("lib.rs", &format!("{LIST}pub struct House;")),
        ("ground.rs", "use crate::House;"),
        ("walls.rs", ""),
        ("roof.rs", ""),
    ]);
    assert!(found.len() == 1 && found[0].contains("lib.rs defines"), "{found:?}");
}

/// A macro that is exported is known at the root and belongs to the module that has it; a program has no `lib.rs`.
#[test]
fn an_exported_macro_belongs_to_its_module() {
    for root in ["lib.rs", "main.rs"] {
        let found = |of_macro: &str, user: &str| {
            let exported = "#[macro_export]\nmacro_rules! tile { () => {}; }";
            let text = |file: &str| if file == of_macro { exported } else { "" };
            let text = |file: &str| if file == user { "use crate::tile;" } else { text(file) };
            let files = ["ground.rs", "walls.rs", "roof.rs"].map(|file| (file, text(file)));
            planted(&[&[(root, LIST)], &files[..]].concat())
        };
        assert_eq!(found("ground.rs", "walls.rs"), [""; 0]);
        let upward = found("roof.rs", "walls.rs");
        assert!(
            upward.len() == 1 && upward[0].contains("`roof` stands after `walls`"),
            "{upward:?}"
        );
    }
}

#[test]
fn a_module_that_is_not_in_the_list_is_found() {
    let files = [("ground.rs", ""), ("walls.rs", ""), ("roof.rs", ""), ("cellar.rs", "")];
    let with = |lib: &str| planted(&[&[("lib.rs", lib)], &files[..]].concat());
    assert_eq!(with(&format!("{LIST}mod cellar;")), ["`cellar` is missing in the list of lib.rs"]);
    let twice = LIST.replace("[`roof`]", "[`roof`], [`walls`]");
    assert_eq!(with(&twice), ["`walls` is 2 times in the list of lib.rs"]);
    let stranger = LIST.replace("[`roof`]", "[`roof`], [`attic`], [`Tile`]");
    let expected = ["`attic` is in the list of lib.rs and no module of the crate"];
    assert_eq!(with(&stranger), expected);
}

/// The files and folders that a page names in code marks.
fn named(page: &str) -> Vec<&str> {
    let marked = page.split('`').skip(1).step_by(2);
    let file = |name: &&str| {
        let plain = name.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
        let end = name.rsplit('/').next().unwrap_or_default();
        plain && name.contains('/') && (end.is_empty() || end.contains('.'))
    };
    marked.filter(file).collect()
}

#[test]
fn every_file_that_the_page_names_exists() {
    for page in ["docs/architecture.md", "docs/board.md", "CONTRIBUTING.md"] {
        let text = std::fs::read_to_string(path(page)).unwrap();
        let missing: Vec<_> =
            named(&text).into_iter().filter(|name| !path(name).exists()).collect();
        assert!(missing.is_empty(), "{page} names {missing:?}");
    }
    let text = "`a/b.rs` `cargo test` `c/` and `x/y z.rs`, `a => b`, `OUT/SCENE`";
    assert_eq!(named(text), ["a/b.rs", "c/"]);
}

/// Nothing is passed twice on the way of a value.
#[test]
fn no_walk_comes_back_to_a_file() {
    let text = std::fs::read_to_string(path("docs/architecture.md")).unwrap();
    let walks: Vec<_> =
        text.split("\n### One ").skip(1).map(|walk| walk.split("\n## ").next().unwrap()).collect();
    assert_eq!(walks.len(), 3);
    for walk in walks {
        let files = named(walk);
        assert!(files.len() > 3, "{files:?}");
        for (i, file) in files.iter().enumerate() {
            assert!(!files[..i].contains(file), "{file} is passed twice");
        }
    }
}
