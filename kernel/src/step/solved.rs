//! The operations of a scheme with a matrix.
//!
//! `(wrenches at a pose, weights) => solution in place of the wrenches`.

use crate::forces::pushed;
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::pose::{Places, place_bodies};
use crate::schedule::ground_jumps;
use crate::solve::{MatrixWeights, System, assemble};
use crate::status::Cause;
use crate::step::Workspace;

impl<P: Geometry, T: Terms<P>> Workspace<'_, '_, P, T> {
    /// Whether there may be external forces: loads and inputs.
    #[inline(always)]
    pub(crate) fn is_pushed(&self) -> bool {
        (T::LOADS && !self.model.loads.is_empty()) || (T::INPUTS && !self.model.inputs.is_empty())
    }

    /// Whether the ground jumps at the start of this step or within it.
    #[inline(always)]
    pub(crate) fn ground_jumps(&self) -> bool {
        let Self { model, knots, step, h, .. } = self;
        T::INPUTS && ground_jumps(model.inputs, model.knots, knots, (*step, *h))
    }

    /// Updates the frames to the present pose.
    #[inline(always)]
    pub(crate) fn place_all(&mut self) {
        place_bodies(self.bodies, self.frames);
    }

    /// The forces of loads and inputs, in place of the wrenches; the frames are those of the pose.
    #[inline(always)]
    pub(crate) fn push(&mut self) {
        self.cache.fresh = false;
        let places = Places { frames: &*self.frames, signals: &*self.signals };
        pushed::<P, T>(&self.model, self.windows, self.step, places, self.wrenches);
    }

    /// Solves `(μ·M + χ·C + κ·K)·x = wrenches` at the pose of the frames, torques and x in world
    /// axes, in place of the wrenches; `half` where the weights are those of half a step.
    ///
    /// # Errors
    /// [`Cause::Pivot`] names the body at which the matrix is not positive definite.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        matrix_weights: MatrixWeights<P::Real>,
        half: bool,
    ) -> Result<(), Cause> {
        let plan = self.plan;
        let mut system = System { plan, diagonal: self.blocks, pairs: self.pair_blocks };
        let places = Places { frames: &*self.frames, signals: &*self.signals };
        let known =
            (matrix_weights, if half { self.half_lumped_joints } else { self.lumped_joints });
        assemble(&self.model, places, self.bodies, known, self.law_states, &mut system);
        // Models in flash are mechanisms: they do without the second form.
        let factored = if T::ALL { system.factor::<true>() } else { system.factor::<false>() };
        factored.map_err(|body| Cause::Pivot { body })?;
        self.solve_again();
        Ok(())
    }

    /// Solves again with the matrix of the last [`Self::solve`].
    #[inline(always)]
    pub(crate) fn solve_again(&mut self) {
        let plan = self.plan;
        let system = System { plan, diagonal: self.blocks, pairs: self.pair_blocks };
        if T::ALL {
            system.substitute::<true>(self.wrenches);
        } else {
            system.substitute::<false>(self.wrenches);
        }
    }
}
