//! Why `cargo xtask bench` refuses.

use crate::chain;
use dbd_plant::PlantError;
use dbd_scene::SceneError;
use miette::Diagnostic;
use thiserror::Error;

use host_sim::terminal::LoadError;

/// Why nothing was measured.
#[derive(Debug, Error, Diagnostic)]
pub enum BenchError {
    /// A scene could not be loaded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Load(#[from] LoadError),
    /// A scene cannot be stepped.
    #[error("{name}: {why}")]
    #[diagnostic(help("a scene that host-sim run can run"))]
    Plant {
        /// The scene.
        name: String,
        /// Why.
        why: PlantError,
    },
    /// The scene of a net is refused.
    #[error(transparent)]
    #[diagnostic(help("--nets takes numbers of bodies along a side, e.g. 10,32"))]
    Net(#[from] SceneError),
    /// A chain is refused.
    #[error(transparent)]
    #[diagnostic(help("--chains takes numbers of links, e.g. 10,100,1000"))]
    Chain(#[from] chain::ChainError),
}
