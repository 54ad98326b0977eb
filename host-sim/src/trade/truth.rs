//! What runs are compared with: poses of high accuracy at the samples' times.
//!
//! `(scene, grid) => poses, uncertainty`.

use dbd_scene::Scene;

use super::grid::Grid;
use super::metric::{Metric, Poses};
use crate::reference::truth::{NoTruth, Opinion, integrate};
use crate::reference::{Mechanism, State};

/// The truth of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Its times.
    pub grid: Grid,
    /// One per time.
    pub poses: Vec<Poses>,
}

impl Truth {
    /// That of a scene.
    ///
    /// # Errors
    /// Where the integrator gives up.
    pub fn of(scene: &Scene, grid: Grid) -> Result<Self, NoTruth> {
        Ok(Self { grid, poses: poses(Opinion::Dop853, scene, grid)? })
    }

    /// \[m\] how far a second opinion is away at most.
    ///
    /// # Errors
    /// Where its integrator gives up.
    pub fn uncertainty(&self, scene: &Scene) -> Result<f64, NoTruth> {
        let metric = Metric::of(scene);
        let other = poses(Opinion::Verner98, scene, self.grid)?;
        let pairs = self.poses.iter().zip(&other);
        Ok(pairs.map(|(a, b)| metric.distance(a, b)).fold(0.0, f64::max))
    }
}

fn poses(opinion: Opinion, scene: &Scene, grid: Grid) -> Result<Vec<Poses>, NoTruth> {
    let (mechanism, start) = Mechanism::of(scene);
    let states: Vec<State> = integrate(opinion, &mechanism, &start, &grid.times())?;
    Ok(states.into_iter().map(|state| state.bodies).collect())
}
