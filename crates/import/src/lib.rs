//! MuJoCo's MJCF and ROS's URDF become scenes.
//!
//! `FILE.xml => bodies, joints, springs of a mechanism => TOML with where each part came from`. What the
//! method has no counterpart for is a [`Omission`] with its line and its size, and refused unless its
//! [`Kind`] is ignored. The modules in the order in which they stand on each other, each on those
//! before it alone:
//!
//! - [`mod@place`]: texts and places in them.
//! - `notation`: numbers and texts as TOML has them.
//! - [`omission`]: what has no counterpart, by kinds.
//! - [`error`]: what is refused, and where.
//! - `file`: files that a model names.
//! - `element`: elements of XML, files that include each other as one.
//! - `schema`: names of elements and attributes.
//! - `defaults`: classes of attributes, and attributes as numbers.
//! - `urdf`: URDF as elements of MJCF.
//! - `settings`: what the file says of itself: units, sequences, gravity.
//! - `mass`: mass, centre and inertia, of shapes, too.
//! - `bulk`, `mesh`: what meshes hold.
//! - `body`: one body, its joints, geoms and sites.
//! - `geom`: geoms beside their mass: what touches, what can be seen.
//! - `lacks`: what a joint has that a scene has no counterpart for.
//! - `weigh`: masses of bodies.
//! - `tree`: all of them, in their frames.
//! - `pose`: joint coordinates become poses.
//! - [`options`]: what is stated rather than read.
//! - `chain`: several joints of one body, and which joints of a scene say them.
//! - `carrier`: bodies between joints, and their mass.
//! - `part`: bodies without joints become one with their parents.
//! - `coordinate`: what springs and inputs act on.
//! - `mechanism`: joints, springs, inputs, read-outs between parts.
//! - `elements`: springs and inputs along coordinates.
//! - `inertia`: what joints have to move.
//! - `servo`: actuators that are linear laws.
//! - `contact`: which geoms can touch, and contacts of solids with planes.
//! - `couplings`: equalities between joints and fixed tendons.
//! - `joints`, `loops`, `tendons`, `actuators`, `signals`: what brings them in.
//! - `write`: the scene's text.
//! - `assembled`: springs of a mechanism whose loops are open at the file's pose.
//! - `model`: all of it, from a file's elements to the scene.

pub mod error;
pub mod omission;
pub mod options;
pub mod place;

mod actuators;
mod assembled;
mod body;
mod bulk;
mod carrier;
mod chain;
mod contact;
mod coordinate;
mod couplings;
mod defaults;
mod element;
mod elements;
mod file;
mod geom;
mod inertia;
mod joints;
mod lacks;
mod loops;
mod mass;
mod mechanism;
mod mesh;
mod model;
mod notation;
mod part;
mod pose;
mod schema;
mod servo;
mod settings;
mod signals;
mod tendons;
mod tree;
mod urdf;
mod weigh;
mod write;

use std::path::Path;

pub use error::{ImportError, Refusal};
pub use omission::{Kind, Omission};
pub use options::{Options, TOLERANCE, Weld};

use crate::element::Document;
use crate::error::Fault;
use crate::omission::Omissions;

/// A scene that was made of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Its text, TOML.
    pub scene: String,
    /// What was left out of it, in the order of the file.
    pub omitted: Vec<Omission>,
    /// What is good to know.
    pub notes: Vec<String>,
}

/// Makes a scene of an MJCF file and of what it includes, or of a URDF file.
///
/// # Errors
/// [`ImportError`]: where a file cannot be read or is neither, where a body cannot be in a scene, and
/// where something has no counterpart and its kind is not ignored.
pub fn import(file: &Path, options: &Options) -> Result<Imported, ImportError> {
    let name = file.display().to_string();
    let unreadable = |reason| ImportError::Unreadable { file: name.clone(), reason };
    let text = dbd_scene::file::read_text(file).map_err(unreadable)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    import_text(&text, &name, folder, options)
}

/// Makes a scene of the text of an MJCF or URDF file; `name` is what messages call it, files that it includes
/// lie below `folder`.
///
/// # Errors
/// As [`import`].
pub fn import_text(
    text: &str,
    name: &str,
    folder: &Path,
    options: &Options,
) -> Result<Imported, ImportError> {
    let mut document = Document::read(text, name, folder)?;
    let mut root = std::mem::take(&mut document.root);
    let mut found = Omissions::default();
    let refused = |fault: Fault| fault.refuse(&document.texts);
    if root.name == "robot" {
        root = urdf::mujoco(&root, &mut found).map_err(refused)?;
    }
    let made = model::Model::read(&root, folder, found)
        .and_then(|model| model.scene(&document.texts, name, options));
    let (made, omissions) = made.map_err(refused)?;
    let omitted = omissions.named(&document.texts);
    let refused: Vec<Omission> =
        omitted.iter().filter(|o| !options.ignored.contains(&o.kind)).cloned().collect();
    if !refused.is_empty() {
        return Err(ImportError::Omitted { file: name.to_owned(), omissions: refused });
    }
    Ok(Imported { scene: made.0, omitted, notes: made.1 })
}
