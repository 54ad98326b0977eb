//! Export of scenes as ROS's URDF.
//!
//! `scene => links and ideal joints of a tree => XML`. Joints are ideal in a URDF. Elements without a counterpart become
//! a [`LeftOut`] and are refused unless their [`Lack`] is ignored. The modules in dependency order:
//!
//! - `lack`: elements without a counterpart, by kind.
//! - `tree`: the links, and the joints that hold them.
//! - `coordinates`: what acts on the coordinates of joints.
//! - `text`: the file.

mod coordinates;
mod lack;
mod text;
mod tree;

use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

pub use lack::{Lack, LeftOut, table};
pub use text::HEAD;

/// A file made from a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// Its text, URDF.
    pub text: String,
    /// Elements left out.
    pub left_out: Vec<LeftOut>,
    /// Notes for the user.
    pub notes: Vec<String>,
}

/// A scene has elements without a counterpart in a URDF.
#[derive(Clone, Debug, PartialEq, Eq, Error, Diagnostic)]
#[error("a URDF cannot hold {} of the scene `{scene}`\n{}", of(items), table(items).trim_end())]
#[diagnostic(help("use {} to leave them out", lack::options(items)))]
pub struct ExportError {
    /// Its name.
    pub scene: String,
    /// Those elements.
    pub items: Vec<LeftOut>,
}

fn of(items: &[LeftOut]) -> String {
    format!("{} element{}", items.len(), if items.len() == 1 { "" } else { "s" })
}

/// Writes a scene as URDF; its coordinates are 0 at [`Scene::assembled_states`].
///
/// # Errors
/// [`ExportError`] if an element has no counterpart and its kind is not ignored.
pub fn urdf(scene: &Scene, ignored: &[Lack]) -> Result<Exported, ExportError> {
    let tree = tree::Tree::of(scene);
    let (coordinates, left_out) = coordinates::Coordinates::of(scene, &tree);
    let refused = left_out.iter().filter(|item| !ignored.contains(&item.kind));
    let items: Vec<LeftOut> = refused.cloned().collect();
    if !items.is_empty() {
        return Err(ExportError { scene: scene.name.clone(), items });
    }
    let text = text::write(scene, &tree, &coordinates);
    Ok(Exported { text, left_out, notes: notes(scene) })
}

/// What the file does not state although nothing is wrong with it.
fn notes(scene: &Scene) -> Vec<String> {
    let mut notes = Vec::new();
    let states = || scene.model.initial.iter().zip(scene.assembled_states());
    let moves = |v: [f64; 3]| v != [0.0; 3];
    if states()
        .any(|(state, _)| moves(state.velocity.to_f64()) || moves(state.angular_velocity.to_f64()))
    {
        notes.push("velocities at t = 0 are left out: a URDF has no state".into());
    }
    if states().any(|(state, zero)| {
        (state.position, state.orientation) != (zero.position, zero.orientation)
    }) {
        notes.push("the pose at t = 0 is left out: coordinates of the URDF are 0 where the joints are assembled".into());
    }
    notes
}
