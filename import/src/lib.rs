//! MuJoCo's MJCF becomes a scene.
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
//! - `settings`: what the file says of itself: units, sequences, gravity.
//! - `mass`: mass, centre and inertia, of shapes, too.
//! - `body`: one body, its joints, geoms and sites.
//! - `geom`: geoms beside their mass: what touches, what can be seen.
//! - `lacks`: what a joint has that a scene has no counterpart for.
//! - `tree`: all of them, in their frames.
//! - `contact`: which geoms can touch.
//! - `pose`: joint coordinates become poses.
//! - [`options`]: what is stated rather than read.
//! - `part`: bodies without joints become one with their parents.
//! - `mechanism`: joints, springs, inputs, read-outs between parts.
//! - `joints`, `loops`, `signals`: what brings them in, from the tree, equalities, actuators and sensors.
//! - `write`: the scene's text.
//! - `assembled`: springs of a mechanism whose loops are open at the file's pose.

pub mod error;
pub mod omission;
pub mod options;
pub mod place;

mod assembled;
mod body;
mod contact;
mod defaults;
mod element;
mod file;
mod geom;
mod joints;
mod lacks;
mod loops;
mod mass;
mod mechanism;
mod notation;
mod part;
mod pose;
mod schema;
mod settings;
mod signals;
mod tree;
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

/// Makes a scene of an MJCF file and of what it includes.
///
/// # Errors
/// [`ImportError`]: where a file cannot be read or is no MJCF, where a body cannot be in a scene, and
/// where something has no counterpart and its kind is not ignored.
pub fn import(file: &Path, options: &Options) -> Result<Imported, ImportError> {
    let name = file.display().to_string();
    let unreadable = |reason| ImportError::Unreadable { file: name.clone(), reason };
    let text = dbd_scene::file::read_text(file).map_err(unreadable)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    import_text(&text, &name, folder, options)
}

/// Makes a scene of the text of an MJCF file; `name` is what messages call it, files that it includes
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
    let root = std::mem::take(&mut document.root);
    let mut omissions = Omissions::default();
    let made = (|| -> Result<(String, Vec<String>), Fault> {
        schema::check(&root, &mut omissions)?;
        let settings = settings::read(&root, &mut omissions)?;
        let defaults = defaults::Defaults::read(&root)?;
        let tree = tree::read(&root, &settings, &defaults, &mut omissions)?;
        contact::find(&root, &tree, &settings, &mut omissions)?;
        let pose = pose::Pose::of(&tree, &root, options.keyframe.as_deref())?;
        let parts = part::Parts::of(&tree, &settings, options.weld)?;
        let mut mechanism = mechanism::Mechanism::new(&tree, &parts, &pose, options);
        joints::add(&mut mechanism, &settings, &mut omissions);
        loops::add(&mut mechanism, &root, &settings, &mut omissions)?;
        signals::add(&mut mechanism, &root, &settings, &defaults, &mut omissions)?;
        let head = write::Head { settings: &settings, texts: &document.texts };
        let mut scene = write::scene(&mechanism, &head, omissions.list(), name);
        if assembled::settle(&mut mechanism, &scene) {
            scene = write::scene(&mechanism, &head, omissions.list(), name);
        }
        Ok((scene, mechanism.notes))
    })();
    let omitted = omissions.named(&document.texts);
    let (scene, notes) = made.map_err(|fault| fault.refuse(&document.texts))?;
    let refused: Vec<Omission> =
        omitted.iter().filter(|o| !options.ignored.contains(&o.kind)).cloned().collect();
    if !refused.is_empty() {
        return Err(ImportError::Omitted { file: name.to_owned(), omissions: refused });
    }
    Ok(Imported { scene, omitted, notes })
}
