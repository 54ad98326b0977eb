//! Clearance: a dead band of an element's extension, continuous at its edge.
//!
//! `(extension, clearance c) => effective extension x`: 0 within ±c, reduced by c beyond. A spring's force and energy
//! are those of the effective extension. A damper grows with it, as the contact does: `d·min(1, |x|/c)`, 0 at the edge
//! and complete from twice the clearance on, so that the force is continuous at any speed and dissipation is never
//! negative. (Flores & Ambrósio 2004 review dry clearance joints, whose dampers grow likewise, after Hunt & Crossley
//! 1975; contact here is the joint's own spring.)

use crate::real::{Real, choose};

/// The part of `extension` \[m\] beyond a dead band of ±`clearance` \[m\]; without a clearance all of it.
#[inline(always)]
pub fn beyond<R: Real>(extension: R, clearance: Option<R>) -> R {
    let Some(c) = clearance else { return extension };
    choose!(
        R,
        c.less_than(extension),
        extension - c,
        choose!(R, extension.less_than(-c), extension + c, R::ZERO)
    )
}

/// The active part of a damper \[N·s/m\] at `extension` \[m\]: without a clearance all of it.
#[inline(always)]
pub fn engaged<R: Real>(damping: R, extension: R, clearance: Option<R>) -> R {
    let Some(c) = clearance else { return damping };
    let x = beyond(extension, clearance).abs();
    choose!(R, x.less_than(c), damping * (x / c), damping)
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

    #[test]
    fn a_damper_grows_from_the_edge_on() {
        assert_eq!(engaged(8.0, 0.0, None), 8.0);
        for (extension, damping) in [
            (0.0, 0.0),
            (0.5, 0.0),
            (-0.5, 0.0),
            (0.625, 2.0),
            (-0.75, 4.0),
            (1.0, 8.0),
            (-9.0, 8.0),
        ] {
            assert_eq!(engaged(8.0, extension, Some(0.5)), damping, "{extension}");
        }
        // A clearance that rounds to 0 in a precision leaves the damper complete.
        assert_eq!(engaged(8.0_f32, 0.0, Some(0.0)), 8.0);
    }
}
