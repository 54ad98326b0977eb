//! Checks that a scene is within the range of a precision.
//!
//! `(scene, precision, step) => the first part that does not fit, by its name, with the numbers`.

use dbd_kernel::extents::{Excess, Part, first_excess};
use dbd_kernel::{BodyIndex, Geometry, GroupIndex};

use crate::scene::Scene;
use crate::time::display;

/// A part of a model out of the range of a precision.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what}, but {precision} represents at most {limit} m")]
pub struct Misfit {
    /// Description with its value: ``the body `cart` lies 30 m from the origin``.
    pub what: String,
    /// \[m\] the limit.
    pub limit: f64,
    /// The precision's name.
    pub precision: &'static str,
    /// The remedy.
    pub remedy: &'static str,
}

/// Remedy for the distance of a body or a point of the ground.
const NEARER: &str = "move the origin nearer to the mechanism, or use --precision f64";
/// Remedy for the distance of a point from the centre of mass.
const SHORTER: &str = "move the centre of mass nearer to the point, or use --precision f64";
/// Remedy for the motion of a body in a step.
const FINER: &str = "use a shorter step or --precision f64";
/// Remedy for the motion of the ground.
const LESS: &str =
    "use a smaller displacement from an anchor moved by the remainder, or --precision f64";

impl Misfit {
    /// The error for a model without names.
    #[must_use]
    pub fn unnamed<P: Geometry>(excess: &Excess, step: f64) -> Self {
        let body = |body: BodyIndex| format!("body {}", body.0);
        let group = |group: GroupIndex| format!("group {}", group.0);
        Self::of::<P>(excess, step, body, group, |input| format!("input {input}"))
    }

    fn of<P: Geometry>(
        excess: &Excess,
        step: f64,
        body: impl Fn(BodyIndex) -> String,
        group: impl Fn(GroupIndex) -> String,
        input: impl Fn(u16) -> String,
    ) -> Self {
        let value = excess.value;
        let (what, remedy) = match excess.part {
            Part::Body(of) => {
                (format!("{} lies {value} m from the origin along an axis", body(of)), NEARER)
            }
            Part::Point { body: of, group: Some(row) } => (
                format!(
                    "a point of {} lies {value} m from the centre of mass of {}",
                    group(row),
                    body(of)
                ),
                SHORTER,
            ),
            Part::Point { body: of, group: None } => {
                (format!("a force acts {value} m from the centre of mass of {}", body(of)), SHORTER)
            }
            Part::Ground { group: row } => (
                format!(
                    "a point of {} on the ground lies {value} m from the origin along an axis",
                    group(row)
                ),
                NEARER,
            ),
            Part::Drift(of) => {
                (format!("{} moves {value} m in a step of {}", body(of), display(step)), FINER)
            }
            Part::Signal(of) => (format!("{} moves the ground by {value} m", input(of.0)), LESS),
        };
        Self { what, limit: excess.limit, precision: P::NAME, remedy }
    }
}

/// An input with a value or table out of the range of a precision.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the input `{input}` (line {line}) has a value, a slope or a time out of the range of {precision}"
)]
pub struct UnfitInput {
    /// The input.
    pub input: String,
    /// The line on which it begins.
    pub line: usize,
    /// The precision's name.
    pub precision: &'static str,
}

/// Checks that bodies, points and displacements of the ground are within the range of a precision, with steps of
/// `step` \[s\], in space.
///
/// # Errors The first part out of range.
pub fn check_extents<P: Geometry>(scene: &Scene, step: f64) -> Result<(), Misfit> {
    let view = dbd_kernel::model::ModelOwner::view(&scene.model);
    let excess = first_excess::<P, _, _>(&view, &scene.model.initial, step);
    let Some(excess) = excess else { return Ok(()) };
    let named = |kind: &str, name: Option<&String>, row: u16| match name {
        Some(name) => format!("the {kind} `{name}`"),
        None => format!("{kind} {row}"),
    };
    let body = |body: BodyIndex| named("body", scene.body_names.get(body.row()), body.0);
    let group = |group: GroupIndex| match joint_of(scene, group.row()) {
        Some(joint) => format!("the joint `{joint}`"),
        None => {
            raw_of(scene, group.row()).map_or_else(|| format!("group {}", group.0), str::to_owned)
        }
    };
    let input =
        |row: u16| named("input", scene.inputs.get(usize::from(row)).map(|input| &input.name), row);
    Err(Misfit::of::<P>(&excess, step, body, group, input))
}

/// Checks that the values of inputs are within the range of a precision.
///
/// # Errors The first input out of range.
pub fn check_inputs<P: Geometry>(scene: &Scene) -> Result<(), UnfitInput> {
    let Some(index) = scene.model.convert::<P>().unfit_input() else { return Ok(()) };
    let row = usize::from(index.0);
    let input = scene.inputs.get(row).map_or_else(String::new, |input| input.name.clone());
    let line = scene.file_lines.inputs.get(row).copied().unwrap_or_default();
    Err(UnfitInput { input, line, precision: P::NAME })
}

fn joint_of(scene: &Scene, group: usize) -> Option<&str> {
    let joint = scene.joints.iter().find(|joint| joint.groups.contains(&group))?;
    Some(&joint.name)
}

/// The label of the raw element of a group in messages.
fn raw_of(scene: &Scene, group: usize) -> Option<&str> {
    let first = scene.joints.iter().map(|joint| joint.groups.end).max().unwrap_or(0);
    scene.raw_names().get(group.checked_sub(first)?).map(String::as_str)
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{F32, Fixed};

    use super::*;

    fn scene(body: &str, ground: &str, point: &str, velocity: &str) -> Scene {
        let text = format!(
            "name = \"far\"\nduration = 1\n\
             [[body]]\nname = \"cart\"\nmass = 1\ninertia = [1, 1, 1]\nposition = {body}\nvelocity = {velocity}\n\
             [[tsda]]\nname = \"spring\"\nbetween = [\"world\", \"cart\"]\npoints = [{ground}, {point}]\n\
             stiffness = 10\nfree_length = 0\n\
             [[input]]\nname = \"road\"\ntype = \"anchor\"\ntarget = \"spring\"\naxis = [1, 0, 0]\nvalue = 8\n"
        );
        Scene::parse(&text, "far.toml").unwrap_or_else(|error| panic!("{error:?}"))
    }

    #[test]
    fn what_does_not_fit_is_named_with_the_numbers() {
        let near = "[0, 0, 0]";
        for (far, said) in [
            (
                scene("[0, 30, 0]", near, near, near),
                "the body `cart` lies 30 m from the origin along an axis, but fixed represents at most 24 m",
            ),
            (
                scene(near, "[0, 0, -25]", near, near),
                "lies 25 m from the origin along an axis, but fixed represents at most 24 m",
            ),
            (
                scene(near, near, "[6, 0, 8]", near),
                "lies 10 m from the centre of mass of the body `cart`, but fixed represents at most 7 m",
            ),
            (
                scene(near, near, near, "[0, 0, 500]"),
                "the body `cart` moves 0.5 m in a step of 1ms, but fixed represents at most 0.125 m",
            ),
            (
                scene(near, near, near, near),
                "the input `road` moves the ground by 8 m, but fixed represents at most 7 m",
            ),
        ] {
            let found = check_extents::<Fixed>(&far, 1e-3).unwrap_err().to_string();
            assert!(found.contains(said), "{found}");
            assert_eq!(check_extents::<F32>(&far, 1e-3), Ok(()));
        }
    }
}
