//! Import of MuJoCo's MJCF and ROS's URDF as scenes, and export of scenes as URDF.
//!
//! `FILE.xml => bodies, joints, springs of a mechanism => TOML with the origin of each part`. Items without a
//! counterpart become an [`Omission`] with line and magnitude, and are refused unless their [`Kind`] is ignored. The
//! modules in dependency order, each using only those before it:
//!
//! - [`mod@place`]: texts and positions in them.
//! - `notation`: numbers and strings in TOML notation.
//! - [`omission`]: items without a counterpart, by kind.
//! - [`error`]: import errors with their positions.
//! - `file`: files referenced by a model.
//! - `element`: XML elements, with included files merged.
//! - `schema`: names of elements and attributes.
//! - `defaults`: classes of attributes, and attributes as numbers.
//! - `urdf`: URDF as elements of MJCF.
//! - `settings`: settings of the file: units, sequences, gravity.
//! - `mass`: mass, centre and inertia, also of shapes.
//! - `bulk`, `mesh`: mass properties of meshes.
//! - `body`: one body with its joints, geoms and sites.
//! - `geom`: geoms apart from their mass: contact surfaces and visible shapes.
//! - `lacks`: properties of joints without a counterpart.
//! - `weigh`: masses of bodies.
//! - `tree`: all bodies in their frames.
//! - `pose`: joint coordinates to poses.
//! - [`options`]: parameters that the file does not contain.
//! - `chain`: several joints of one body, and the equivalent joints of a scene.
//! - `carrier`: bodies between joints, and their mass.
//! - `part`: merges bodies without joints with their parents.
//! - `coordinate`: coordinates on which springs and inputs act.
//! - `mechanism`: joints, springs, inputs, read-outs between parts.
//! - `interaction`: keys of stops and bushings.
//! - `elements`: springs and inputs along coordinates.
//! - `inertia`: inertia driven by joints.
//! - `servo`: actuators that are linear laws.
//! - `contact`: pairs of geoms that can touch, and contacts of solids with planes.
//! - `couplings`: equalities between joints and fixed tendons.
//! - `joints`, `loops`, `tendons`, `actuators`, `signals`: conversion to the mechanism.
//! - `write`: the scene's text.
//! - `assembled`: springs of a mechanism whose loops are open at the file's pose.
//! - `model`: the whole conversion, from a file's elements to the scene.
//! - [`export`]: a scene as URDF.

pub mod error;
pub mod export;
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
mod interaction;
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

/// A scene made from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Its text, TOML.
    pub scene: String,
    /// Omitted items in file order.
    pub omitted: Vec<Omission>,
    /// Notes for the user.
    pub notes: Vec<String>,
}

/// Makes a scene from an MJCF file and its included files, or from a URDF file.
///
/// # Errors
/// [`ImportError`] if a file cannot be read or is neither, if a body is not valid in a scene, or if an item has no
/// counterpart and its kind is not ignored.
pub fn import(file: &Path, options: &Options) -> Result<Imported, ImportError> {
    let name = file.display().to_string();
    let unreadable = |reason| ImportError::Unreadable { file: name.clone(), reason };
    let text = dbd_scene::file::read_text(file).map_err(unreadable)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    import_text(&text, &name, folder, options)
}

/// Makes a scene from the text of an MJCF or URDF file; messages refer to it as `name`, and included files are below
/// `folder`.
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
