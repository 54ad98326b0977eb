//! Clearance: a dead band of an element's extension, continuous at its edge.
//!
//! `(extension, clearance c) => effective extension`: 0 within ±c, less c beyond. A spring acts
//! on the effective extension, its energy is that of it; its damper acts while it is engaged.
//! (Flores & Ambrósio 2004 review dry clearance joints; contact here is the joint's own spring.)

use crate::real::Real;

/// What remains of `extension` \[m\] beyond a dead band of ±`clearance` \[m\]; without one all of it.
#[inline(always)]
pub fn beyond<R: Real>(extension: R, clearance: Option<R>) -> R {
    match clearance {
        None => extension,
        Some(c) if extension > c => extension - c,
        Some(c) if extension < -c => extension + c,
        Some(_) => R::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_is_dead_and_its_edge_continuous() {
        assert_eq!(beyond(0.3, None), 0.3);
        for extension in [-0.1, 0.0, 0.05, 0.1] {
            assert_eq!(beyond(extension, Some(0.1)), 0.0);
        }
        assert!((beyond(0.1 + 1e-9, Some(0.1)) - 1e-9_f64).abs() < 1e-16);
        assert!((beyond(-0.1 - 1e-9, Some(0.1)) + 1e-9_f64).abs() < 1e-16);
    }
}
