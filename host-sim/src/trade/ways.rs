//! All ways of stepping a scene, and the steps that each is tried with.
//!
//! `scene => ways; way, frequency bound, interval => steps per interval`. A further scheme,
//! precision or orientation of [`crate::method`] joins by itself.

use clap::ValueEnum as _;
use dbd_scene::Scene;

use crate::method::{DampingName, Method, OrientationName, PrecisionName, SchemeName};
use crate::reference::State;
use crate::trade::point::Stepper;

/// A way of stepping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// The kernel.
    Kernel(Method),
    /// Semi-implicit Euler in plain std Rust.
    NaiveSemiImplicitEuler,
    /// Leapfrog in plain std Rust.
    NaiveLeapfrog,
    /// Linearly implicit Euler with a sparse solve in plain std Rust.
    LinearlyImplicitEuler,
}

/// Steps as shares of the largest that an undamped oscillator of the highest frequency bears: the
/// first is beyond.
const SHARES: [f64; 12] = [1.3, 0.98, 0.8, 0.6, 0.4, 0.28, 0.2, 0.14, 0.1, 0.05, 0.025, 0.0125];

/// The references take fewer: they are slow, and there to compare.
const REFERENCE_SHARES: [f64; 6] = [1.3, 0.8, 0.4, 0.2, 0.1, 0.025];

/// A solver without limit is tried from this many times a step that an explicit one bears.
const IMPLICIT: f64 = 64.0;

/// \[rad/s\], as a share of the largest: rates about a second axis below this are none.
const SPATIAL: f64 = 1e-6;

impl Way {
    /// Who steps.
    #[must_use]
    pub fn stepper(&self) -> Stepper {
        let reference = |scheme: &str| Stepper {
            scheme: scheme.into(),
            newton: None,
            damping: None,
            precision: PrecisionName::default()
                .to_possible_value()
                .map_or_else(String::new, |value| value.get_name().to_owned()),
            orientation: "quaternion".into(),
            kernel: false,
        };
        match self {
            Self::Kernel(method) => Stepper {
                scheme: method.scheme_name().into(),
                newton: method.newton(),
                damping: method.foreign_damping().map(|damping| damping.name().to_owned()),
                precision: method.precision_name().into(),
                orientation: method.orientation_name().into(),
                kernel: true,
            },
            Self::NaiveSemiImplicitEuler => reference("std semi-implicit-euler"),
            Self::NaiveLeapfrog => reference("std leapfrog"),
            Self::LinearlyImplicitEuler => reference("std linearly-implicit-euler"),
        }
    }

    /// Force evaluations per step.
    #[must_use]
    pub fn evaluations(&self) -> u32 {
        match self {
            Self::Kernel(method) => method.evaluations(),
            _ => 1,
        }
    }

    /// Largest stable `ω_max·h` of an undamped oscillator; infinite where there is none.
    #[must_use]
    pub fn stability_limit(&self) -> f64 {
        match self {
            Self::Kernel(method) => method.stability_limit(),
            Self::LinearlyImplicitEuler => f64::INFINITY,
            Self::NaiveSemiImplicitEuler | Self::NaiveLeapfrog => 2.0,
        }
    }

    /// Steps per `interval` \[s\] to try, ascending, no two alike, where the highest frequency is
    /// `highest` \[rad/s\].
    #[must_use]
    pub fn ladder(&self, highest: f64, interval: f64) -> Vec<u64> {
        let shares =
            if matches!(self, Self::Kernel(_)) { &SHARES[..] } else { &REFERENCE_SHARES[..] };
        let limit = match self.stability_limit() {
            limit if limit.is_finite() => limit,
            _ => 2.0 * IMPLICIT,
        };
        // Where nothing vibrates, an interval is taken in a few steps and more.
        let largest = if highest > 0.0 { limit / highest } else { interval };
        let mut ladder: Vec<u64> = shares
            .iter()
            .map(|share| (interval / (share * largest)).ceil().max(1.0) as u64)
            .collect();
        ladder.dedup();
        ladder
    }
}

/// All ways of stepping a scene. The paper's scheme also with a Newton iteration, Euler angles
/// where bodies turn in space, explicit damping where there are dampers and the scheme has it beside
/// sweeps.
#[must_use]
pub fn ways(scene: &Scene, in_space: bool) -> Vec<Way> {
    let mut ways = Vec::new();
    let mut add = |method: Method| {
        if !ways.contains(&Way::Kernel(method)) {
            ways.push(Way::Kernel(method));
        }
    };
    for precision in PrecisionName::value_variants() {
        for scheme in SchemeName::value_variants() {
            let Ok(method) = Method::new(*scheme, None, *precision) else { continue };
            if *precision == PrecisionName::F32Micromath {
                // One scheme shows what its functions cost; angles need its trigonometry.
                if *scheme == SchemeName::Leapfrog {
                    add(method);
                    add(method.with_orientation(OrientationName::Euler321));
                }
                continue;
            }
            add(method);
            if let Ok(iterated) = Method::new(*scheme, Some(1), *precision)
                && *scheme == SchemeName::Dbd
            {
                add(iterated);
            }
            if !scene.model.dampers.is_empty()
                && let Ok(explicit) = method.with_damping(DampingName::Explicit)
            {
                add(explicit);
            }
            if in_space {
                for orientation in OrientationName::value_variants() {
                    add(method.with_orientation(*orientation));
                }
            }
        }
    }
    ways.extend([Way::NaiveSemiImplicitEuler, Way::NaiveLeapfrog, Way::LinearlyImplicitEuler]);
    ways
}

/// Whether a body turns about more than one of its axes.
#[must_use]
pub fn in_space(truth: &[State]) -> bool {
    truth.iter().flat_map(|state| &state.bodies).any(|body| {
        let mut rates = [body.rate.x, body.rate.y, body.rate.z].map(f64::abs);
        rates.sort_by(f64::total_cmp);
        rates[1] > SPATIAL * rates[2] && rates[1] > SPATIAL
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ladders_ascend_and_begin_beyond_the_bounds_limit() {
        let method = Method::new(SchemeName::Leapfrog, None, PrecisionName::F64).unwrap();
        let ladder = Way::Kernel(method).ladder(1e4, 1e-3);
        // 2/1e4 s is the limit of leapfrog: five steps per millisecond.
        assert_eq!((ladder[0], ladder[1], *ladder.last().unwrap()), (4, 6, 400));
        assert!(ladder.windows(2).all(|pair| pair[0] < pair[1]));
        let still = Way::Kernel(method).ladder(0.0, 1e-3);
        assert_eq!((still[0], *still.last().unwrap()), (1, 80));
        assert_eq!(Way::LinearlyImplicitEuler.ladder(1e4, 1e-3)[0], 1);
    }
}
