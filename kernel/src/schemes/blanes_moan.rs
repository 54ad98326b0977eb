//! Blanes & Moan's S6 (2002, table 2: symmetric, order four, six stages).
//!
//! Drifts and kicks `a₁ b₁ a₂ b₂ a₃ b₃ a₄ b₃ a₃ b₂ a₂ b₁ a₁` of a step. Fourth order, six evaluations, 4.5 times less
//! phase error than [`crate::schemes::Pefrl`] at equal steps. Stable for `ω_max·h < 3.133`; above it is a window of
//! slow growth up to 3.160, then stability again to 6.3, which a mechanism of many modes cannot use. Conserves the same
//! quantities as Pefrl, and likewise uses the free rotor of fourth order and damper passes before and after: second
//! order with dampers.

use crate::compositions::BLANES_MOAN_S6;
use crate::damping::Damping;
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::schemes::Scheme;
use crate::schemes::compose::compose;
use crate::status::Cause;
use crate::step::Stepper;

/// Seven drifts around six kicks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct BlanesMoanS6;

impl Scheme for BlanesMoanS6 {
    const NAME: &'static str = "blanes-moan-s6";
    const ORDER: u32 = 4;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    const SETTLES: bool = false;
    type Memory<P: Geometry> = ();
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        BLANES_MOAN_S6.kicks.len() as u32
    }

    fn stability_limit(&self) -> f64 {
        3.133
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        compose(stepper, &BLANES_MOAN_S6)
    }
}
