//! The built-in scenes, by name.
//!
//! `name => text`.

use std::path::Path;

/// Names and texts, by name.
pub(crate) static SCENES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/scenes.rs"));

/// The meaning of a scene argument.
pub(crate) enum Called {
    /// A file, existing or not.
    File,
    /// A built-in scene: its name and text.
    Shipped(&'static str, &'static str),
    /// An unknown name, with the nearest known one.
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
