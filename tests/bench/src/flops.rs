//! The floating-point operations of a step.
//!
//! `(model, scheme, step) => operations per step`: the kernel itself runs on numbers that count. This is what
//! it does, not the least that could be done.

use dbd_kernel::geometry::Float;
use dbd_kernel::lanes::Named;
use dbd_kernel::{F64, Plant, Real, Scheme};
use dbd_scene::SceneModel;

use crate::counted::{Counted, Operations};

/// Steps over which the mean is taken: of a step that begins at rest some turns are left out.
const STEPS: u64 = 16;

/// Steps that are taken before.
const BEFORE: u64 = 16;

/// Floating-point operations per step of a model from t = 0 on, mean of `STEPS` after as many others;
/// `None` where
/// the step `step` \[s\] is none in this precision, or a run with it fails at once.
#[must_use]
pub fn per_step<R, S>(model: &SceneModel<F64>, scheme: S, step: f64) -> Option<f64>
where
    R: 'static,
    Counted<R>: Real + Named,
    S: Scheme,
{
    let model: SceneModel<Float<Counted<R>>> = model.convert();
    let mut plant = Plant::new(&model, scheme, step).ok()?;
    plant.advance(BEFORE).ok()?;
    let done = Operations::of(|| plant.advance(STEPS));
    let flops = done.flops() as f64 / STEPS as f64;
    plant.status().is_ok().then_some(flops)
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{Leapfrog, Tsda, Vec3};

    use super::*;
    use crate::chain::{Joints, STEP, model};

    #[test]
    fn a_spring_takes_what_a_hand_counts() {
        let number = Counted(1.5_f64);
        let spring = Tsda { stiffness: number, free_length: number };
        let displacement = Vec3::new(number, number, number);
        let operations = Operations::of(|| spring.force(displacement, None));
        let Operations { add, multiply, divide, root, .. } = operations;
        // Length: 3 products, 3 sums (one lest it be 0), a root; tension: a difference, a product; its share along the displacement: a
        // quotient, a product; the force: 3 products.
        assert_eq!((add, multiply, divide, root), (4, 8, 1, 1));
    }

    fn of_chain<R: 'static>(links: usize) -> f64
    where
        Counted<R>: Real + Named,
    {
        per_step::<R, _>(&model(links, Joints::Revolute).unwrap(), Leapfrog, STEP).unwrap()
    }

    #[test]
    fn every_link_of_a_chain_takes_as_many_operations() {
        let per_link = of_chain::<f64>(4) - of_chain::<f64>(3);
        assert_eq!(of_chain::<f64>(100) - of_chain::<f64>(50), 50.0 * per_link);
        // Six springs at least; the polynomials of single precision are shorter.
        assert!(per_link > 6.0 * 13.0 && of_chain::<f32>(100) < of_chain::<f64>(100));
    }

    #[test]
    fn what_does_not_step_has_no_operations() {
        let chain = model(3, Joints::Revolute).unwrap();
        assert_eq!(per_step::<f64, _>(&chain, Leapfrog, 0.0), None);
        assert_eq!(per_step::<f64, _>(&chain, Leapfrog, 1.0), None);
    }
}
