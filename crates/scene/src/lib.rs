//! Scenes: a TOML file becomes a checked, assembled model.
//!
//! `text → tables with spans → checked elements → assembled model`. Every error gives file, line, column, problem and
//! remedy. The assembly evaluates sums and roots in a fixed order and uses libm for trigonometry, so a scene gives the
//! same bits on every host.
//!
//! A [`Scene`] is data. Facts, warnings and the planar form are functions of `&Scene`. The modules, each of which uses
//! only those before it:
//!
//! - `precise`, `nearest`, `shortened`, [`fitting`], [`mod@file`]: double-double arithmetic, similar names, shortened
//!   texts and numbers, files.
//! - [`quantity`], [`mod@time`], `written`, `error`, `direction`, `text`, `names`, `target`, `free_length`, `file_lines`, `origin`,
//!   [`parameters`]: values with units; the tables of a file with their positions and errors; names and `[parameters]`.
//! - `drive`, `hinge`, `pair`, `spring`, `raw_groups`, `solid`, `derived`, `columns`: the contents of tables, as data.
//! - [`mod@laws`], `elimination`, `runtime`, [`default_step`]: laws between bodies, and a model whose sizes are known at
//!   run time.
//! - `orientation`, `inertia`, `parts`, `closure`: attitudes, moments of inertia, and the pose that closes joints.
//! - `assembly`, `between`, `points`, `links`, `body`: the model under construction, with its bodies and points.
//! - `joints`, `tsda`, `point_on_line`, `torsion_spring`, `load`, `geometry`: elements with one table each.
//! - `known`, `interaction`, `input`, `readout`, `over`: elements that refer to others.
//! - `defaults`: default keys per kind of table.
//! - [`planar`], `scene`: the scene.
//! - `facts`, `interactions`, `lint`, `extents`, `fault`, [`single`], [`reduction`]: facts and warnings about it, the
//!   range of a precision, its planar form.
//! - `start`, `settle`, `write`, `read`, [`mod@vocabulary`]: reading and writing its text.
//! - [`export`], [`mod@build`]: Rust source of a model.

mod assembly;
mod between;
mod body;
pub mod build;
mod closure;
mod columns;
pub mod default_step;
mod defaults;
mod derived;
mod direction;
mod drive;
mod elimination;
mod error;
pub mod export;
mod extents;
mod facts;
mod fault;
pub mod file;
mod file_lines;
pub mod fitting;
mod free_length;
mod geometry;
mod hinge;
mod inertia;
mod input;
mod interaction;
mod interactions;
mod joints;
mod known;
pub mod laws;
mod links;
mod lint;
mod load;
mod names;
mod nearest;
mod orientation;
mod origin;
mod over;
mod pair;
pub mod parameters;
mod parts;
pub mod planar;
mod point_on_line;
mod points;
mod precise;
pub mod quantity;
mod raw_groups;
mod read;
mod readout;
pub mod reduction;
mod runtime;
mod scene;
mod settle;
mod shortened;
pub mod single;
mod solid;
mod spring;
mod start;
mod target;
mod text;
pub mod time;
mod torsion_spring;
mod tsda;
pub mod vocabulary;
mod write;
mod written;

pub use build::{Build, build};
pub use columns::{BODY_COLUMNS, ENERGY_COLUMNS, TIME_COLUMN, TraceColumns, UnlikeColumn};
pub use derived::DerivedBody;
pub use elimination::{Eliminated, Elimination};
pub use error::{Refusal, SceneError};
pub use extents::{Misfit, UnfitInput, check_extents, check_inputs};
pub use facts::{
    ElementDamping, ElementFrequency, Facts, Island, JointElement, JointFacts, element_dampings,
    element_frequencies, facts, joint_dampings, joint_elements, with_stiffer_joints,
};
pub use fault::fault;
pub use geometry::GeometryInfo;
pub use hinge::Hinge;
pub use input::InputInfo;
pub use interactions::{InteractionInfo, interactions};
pub use joints::{Assembled, JointInfo, Moved, OpenJoint, Realisation};
pub use lint::{OneSided, Severity, Warning, one_sided_springs, warnings, warnings_with};
pub use nearest::nearest;
pub use origin::Setting;
pub use planar::Planar;
pub use read::SceneText;
pub use readout::ReadoutInfo;
pub use reduction::reduced;
pub use runtime::{SceneModel, rounded, widen};
pub use scene::{Scene, Settled, UnknownName};
pub use settle::{Restless, relaxed, relaxed_state};
pub use shortened::shortened;
pub use solid::Solid;
pub use text::is_name;

/// The page's programs compile.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod page {}

#[cfg(test)]
mod example {
    use super::Scene;

    /// A scene with two bodies, `arm` rotated and off the origin and `hand` rotating, and with these elements.
    pub(crate) fn with(elements: &str) -> Scene {
        let text = format!(
            r#"
            name = "two bodies"
            duration = 1
            [[body]]
            name = "arm"
            mass = 2
            inertia = [0.3, 0.2, 0.4]
            position = [0.5, -1, 0.25]
            orientation = {{ axis = [1, 2, -2], angle = 0.7 }}
            [[body]]
            name = "hand"
            mass = 1
            inertia = [0.1, 0.1, 0.1]
            position = [1, 0, 0]
            orientation = {{ euler_321 = [0.3, -0.2, 1.1] }}
            angular_velocity = [0, 0, 3]
            {elements}
            "#
        );
        Scene::parse(&text, "example.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
    }
}

#[cfg(test)]
mod tests;
