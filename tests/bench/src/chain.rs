//! Chains of any number of links, for how costs grow.
//!
//! `links, joints => model in double precision, or the text of its scene`. Links of half a metre lie folded on each other,
//! joined one to the next, the first to the ground; they turn and fall. However many there are, none is far from the
//! origin, where single precision would be coarse, and each joint is loaded alike. A link's numbers repeat every
//! second link exactly, so that a long chain is made of a short one's parts.

use std::fmt::Write as _;

use dbd_kernel::{BodyIndex, F64};
use dbd_scene::{Scene, SceneError, SceneModel};
use thiserror::Error;

/// \[s\] the step of a chain: a twentieth of what it bears.
pub const STEP: f64 = 1e-5;

/// The most links: the kernel counts a model's elements in 16 bits, of which a revolute has six.
pub const MAX: usize = u16::MAX as usize / 6;

/// What joins the links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Six TSDAs each.
    Revolute,
    /// Three TSDAs each.
    Spherical,
}

impl Joints {
    /// The joint's type, and what it is besides.
    fn keys(self) -> [&'static str; 2] {
        match self {
            Self::Revolute => ["revolute", "axis = [0, 0, 1]\nspan = 0.125\nring = 0.0625"],
            Self::Spherical => ["spherical", "arm = 0.0625"],
        }
    }
}

/// Links that are read from a scene; longer chains repeat the last two.
const READ: usize = 4;

/// Why there is no chain.
#[derive(Debug, Error)]
pub enum ChainError {
    /// No links, or too many.
    #[error("a chain has 1 to {MAX} links, not {0}")]
    Links(usize),
    /// The scene of a short chain is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The text of the scene of a chain.
#[must_use]
pub fn text(links: usize, joints: Joints) -> String {
    let [kind, keys] = joints.keys();
    let mut text = format!(
        "name = \"chain-{links}\"\ngravity = [0, -9.81, 0]\nduration = 1\nstep = {STEP}\n\
         [defaults.{kind}]\n{keys}\nstiffness = 1e6\n"
    );
    // All turn alike about the pivot.
    for link in 1..=links {
        let _ = write!(
            text,
            "[[body]]\nname = \"link{link}\"\nmass = 1\ninertia = [0.01, 0.02, 0.025]\n\
             position = [0.25, 0, 0]\nvelocity = [0, -0.25, 0]\nangular_velocity = [0, 0, -1]\n"
        );
    }
    for link in 1..=links {
        let before = if link == 1 { "world".to_owned() } else { format!("link{}", link - 1) };
        let at = if link % 2 == 1 { 0.0 } else { 0.5 };
        let _ = write!(
            text,
            "[[joint]]\nname = \"joint{link}\"\ntype = \"{kind}\"\n\
             between = [\"{before}\", \"link{link}\"]\nat = [{at}, 0, 0]\n"
        );
    }
    text
}

/// The model of a chain: that of [`text`], without reading all of it.
///
/// # Errors
/// [`ChainError::Links`] where a chain has none or too many of them.
pub fn model(links: usize, joints: Joints) -> Result<SceneModel<F64>, ChainError> {
    if !(1..=MAX).contains(&links) {
        return Err(ChainError::Links(links));
    }
    let mut model = Scene::parse(&text(links.min(READ), joints), "chain.toml")?.model;
    for link in READ..links {
        model.bodies.extend_from_within(link - 2..link - 1);
        model.initial.extend_from_within(link - 2..link - 1);
        let alike = model.groups[link - 2];
        let mut group = alike;
        (group.a, group.b) = (BodyIndex(link as u16 - 1), BodyIndex(link as u16));
        (group.point, group.element) = (model.points.len() as u16, model.tsdas.len() as u16);
        let (point, element) = (usize::from(alike.point), usize::from(alike.element));
        model.points.extend_from_within(point..point + alike.points());
        model.tsdas.extend_from_within(element..element + alike.elements());
        model.groups.push(group);
    }
    Ok(model)
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{Leapfrog, Plant};

    use super::*;

    #[test]
    fn a_long_chain_is_the_one_that_its_scene_makes() {
        for (joints, tsdas) in [(Joints::Revolute, 6), (Joints::Spherical, 3)] {
            for links in [1, 2, 3, 4, 5, 12] {
                let read = Scene::parse(&text(links, joints), "chain.toml").unwrap().model;
                assert_eq!(model(links, joints).unwrap(), read, "{links} links");
                assert_eq!((read.bodies.len(), read.tsda_count()), (links, tsdas * links));
            }
        }
    }

    #[test]
    fn a_chain_has_at_least_a_link_and_at_most_what_is_counted() {
        assert!(model(0, Joints::Revolute).is_err() && model(MAX + 1, Joints::Revolute).is_err());
        let longest = model(MAX, Joints::Revolute).unwrap();
        assert_eq!(longest.groups.last().map(|group| group.element), Some(65_526));
    }

    /// It moves, all of it, and neither flies apart nor rests.
    #[test]
    fn a_chain_moves_within_bounds() {
        for joints in [Joints::Revolute, Joints::Spherical] {
            let model = Box::new(model(100, joints).unwrap());
            let mut plant = Plant::new(model, Leapfrog, STEP).unwrap();
            plant.advance(5_000).unwrap();
            for body in &plant.state().bodies {
                let [x, y, z] = body.position.to_f64();
                assert!(x.abs() < 1.0 && y < 0.0 && y > -1.0 && z.abs() < 1e-6, "{x} {y} {z}");
                assert!(body.angular_velocity.z.abs() > 0.1, "{body:?}");
            }
        }
    }
}
