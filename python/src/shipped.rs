//! The scenes that ship, by name.
//!
//! `name => text`.

use std::path::Path;

/// Names and texts, by name.
pub(crate) static SCENES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/scenes.rs"));

/// What a path that leads to no file may mean.
pub(crate) enum Called {
    /// A file, there or not.
    File,
    /// A scene that ships: its name and text.
    Shipped(&'static str, &'static str),
    /// A name of none; the nearest one, where any is near.
    Unknown(Option<&'static str>),
}

/// Looks for a file first, then for a scene of that name.
pub(crate) fn called(path: &Path) -> Called {
    let name = path.to_str().filter(|name| !name.contains(['/', '\\', '.']) && !path.exists());
    let Some(name) = name else { return Called::File };
    match SCENES.iter().find(|(known, _)| *known == name) {
        Some((name, text)) => Called::Shipped(name, text),
        None => Called::Unknown(dbd_scene::nearest(name, SCENES.iter().map(|(known, _)| *known))),
    }
}
