//! Square nets of point masses, stepped with a matrix.
//!
//! `(bodies along a side, rounds) => time per body and step`. Elimination fills the matrix of a net: its
//! cost grows faster than its bodies.

use std::fmt::Write as _;

use dbd_plant::{Method, PrecisionName, SchemeName, plant_of_model};
use dbd_scene::Scene;
use dbd_study::timing::elapsed;
use serde::Serialize;

use super::error::BenchError;
use super::turns::Figure;
use super::ways::advance;

/// Bodies × steps of a round, where nobody says how many steps.
const WORK: u64 = 10_000;

/// \[s\] the step of a net.
const STEP: f64 = 1e-3;

/// A net.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Net {
    /// Bodies.
    pub bodies: u64,
    /// \[s\] a step of `generalized-alpha` in double precision, over the bodies.
    pub body_step_s: Option<Figure>,
}

/// A net whose first and last rows hang from the ground.
fn text(side: usize) -> String {
    let mut text =
        format!("name = \"net\"\ngravity = [0, 0, -9.81]\nduration = 1\nstep = {STEP}\n");
    let mut tie = String::new();
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let place = [0.1 * x as f64, 0.1 * y as f64, 0.0];
        let _ = write!(
            text,
            "[[body]]\nname = \"{x}-{y}\"\nmass = 0.1\ninertia = [1e-5, 1e-5, 1e-5]\n\
             position = {place:?}\n"
        );
        let before = [x.checked_sub(1).map(|x| (x, y)), y.checked_sub(1).map(|y| (x, y))];
        let mut tied: Vec<(String, [f64; 3])> =
            before.into_iter().flatten().map(|(x, y)| (format!("{x}-{y}"), [0.0; 3])).collect();
        if y == 0 || y + 1 == side {
            let beside = if y == 0 { -0.1 } else { 0.1 };
            tied.push(("world".to_owned(), [place[0], place[1] + beside, 0.0]));
        }
        for (other, point) in tied {
            let _ = write!(
                tie,
                "[[tsda]]\nbetween = [\"{other}\", \"{x}-{y}\"]\npoints = [{point:?}, [0, 0, 0]]\n\
                 stiffness = 1e4\nfree_length = 0.1\n"
            );
        }
    }
    text + &tie
}

/// Nets of so many bodies along a side, each measured in so many rounds.
///
/// # Errors
/// [`BenchError`] where the kernel cannot step a net.
pub fn measured(
    sides: &[usize],
    rounds: usize,
    steps: Option<u64>,
) -> Result<Vec<Net>, BenchError> {
    let method = Method::new(SchemeName::GeneralizedAlpha, None, PrecisionName::F64);
    let why = |why| BenchError::Plant { name: "a net".to_owned(), why };
    let method = method.map_err(|refused| why(refused.into()))?;
    let mut nets = Vec::new();
    for side in sides {
        let model = Scene::parse(&text(*side), "net.toml")?.model;
        let bodies = model.bodies.len() as u64;
        let mut plant = plant_of_model(&model, &method, STEP).map_err(why)?;
        let steps = steps.unwrap_or(WORK.div_ceil(bodies));
        let time = |_| elapsed(|| advance(plant.as_mut(), steps)) / (steps * bodies) as f64;
        let body_step_s = Figure::of((0..rounds).map(time).collect());
        nets.push(Net { bodies, body_step_s });
    }
    Ok(nets)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_net_hangs_by_two_sides() {
        let model = Scene::parse(&text(3), "net.toml").unwrap().model.planned();
        assert_eq!((model.bodies.len(), model.tsdas.len()), (9, 12 + 6));
        assert!(model.plan.decoupled.iter().all(|decoupled| *decoupled));
        let nets = measured(&[2, 3], 3, Some(1)).unwrap();
        assert_eq!(nets.iter().map(|net| net.bodies).collect::<Vec<_>>(), [4, 9]);
    }
}
