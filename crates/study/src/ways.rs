//! All ways of stepping a scene, and the steps that each is tried with.
//!
//! `scene => ways; way, frequency bound, interval => steps per interval`. A further scheme,
//! precision or orientation of [`dbd_plant::method`] joins by itself.

use crate::reference::State;
use dbd_plant::plant::{check_extents, check_inputs};
use dbd_plant::{DampingName, Method, Named as _, OrientationName, PrecisionName, SchemeName};
use dbd_scene::Scene;

use crate::grid::Grid;
use crate::point::{Machine, Stepper, is_paper};

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

/// Steps as shares of the largest stable one: the first is beyond, the second within what is left
/// as a margin, the third is the largest to advise.
const SHARES: [f64; 12] = [1.3, 0.98, 0.8, 0.6, 0.4, 0.28, 0.2, 0.14, 0.1, 0.05, 0.025, 0.0125];

/// The paper's scheme is carried on to these, for all others are compared with it.
const PAPER_SHARES: [f64; 4] = [0.005, 0.002, 0.001, 0.0005];

/// Of those, what takes more force evaluations × bodies over the window is left out: 10 s each.
const AFFORDABLE: f64 = 1e8;

/// The references take fewer: they are slow, and there to compare.
const REFERENCE_SHARES: [f64; 6] = [1.3, 0.8, 0.4, 0.2, 0.1, 0.025];

/// A solver without limit is tried from this many times a step that an explicit one bears.
const IMPLICIT: f64 = 64.0;

/// \[rad/s\], as a share of the largest: rates about a second axis below this do not count.
const SPATIAL: f64 = 1e-6;

impl Way {
    /// Who steps.
    #[must_use]
    pub fn stepper(&self) -> Stepper {
        let reference = |scheme: &str| Stepper {
            scheme: scheme.into(),
            newton: None,
            damping: None,
            precision: PrecisionName::default().name().into(),
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

    /// The kernel's method; `None` for a reference.
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        if let Self::Kernel(method) = self { Some(*method) } else { None }
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

    /// Steps per interval to try, ascending, no two alike, for so many bodies whose highest
    /// frequency is `highest` \[rad/s\]; `largest` \[s\] is where an explicit way's ladder begins.
    #[must_use]
    pub fn ladder(&self, highest: f64, largest: f64, grid: &Grid, bodies: usize) -> Vec<u64> {
        let shares =
            if matches!(self, Self::Kernel(_)) { &SHARES[..] } else { &REFERENCE_SHARES[..] };
        let largest = match largest {
            largest if largest > 0.0 && largest.is_finite() => largest,
            _ if highest > 0.0 => self.stability_limit().min(2.0 * IMPLICIT) / highest,
            // Where nothing vibrates, an interval is taken in a few steps and more.
            _ => grid.interval,
        };
        let mut ladder: Vec<u64> = shares.iter().map(|share| grid.steps(share * largest)).collect();
        if is_paper(&self.stepper(), Machine::Host) {
            let work = f64::from(self.evaluations() * grid.samples) * bodies as f64;
            let further = PAPER_SHARES.iter().map(|share| grid.steps(share * largest));
            ladder.extend(further.filter(|steps| *steps as f64 * work <= AFFORDABLE));
        }
        ladder.dedup();
        ladder
    }
}

/// All ways of stepping a scene. The paper's scheme also with a Newton iteration, Euler angles
/// where bodies turn in space, joint-wise and explicit damping where there are dampers and the scheme has them
/// beside sweeps. What is there for comparison only where this build holds it, no precision that cannot hold
/// the scene.
#[must_use]
pub fn ways(scene: &Scene, in_space: bool) -> Vec<Way> {
    let mut ways = Vec::new();
    let mut add = |method: Method| {
        if holds(scene, &method) && !ways.contains(&Way::Kernel(method)) {
            ways.push(Way::Kernel(method));
        }
    };
    for precision in PrecisionName::ALL {
        for scheme in SchemeName::ALL {
            let Ok(method) = Method::new(*scheme, None, *precision) else { continue };
            if *precision == PrecisionName::F32Micromath {
                // One scheme shows what its square root costs.
                if *scheme == SchemeName::Leapfrog {
                    add(method);
                }
                continue;
            }
            add(method);
            if let Ok(iterated) = Method::new(*scheme, Some(1), *precision)
                && *scheme == SchemeName::Dbd
            {
                add(iterated);
            }
            if !scene.model.dampers.is_empty() {
                let others = DampingName::ALL.iter().map(|damping| method.with_damping(*damping));
                others.flatten().for_each(&mut add);
            }
            if in_space {
                for orientation in OrientationName::ALL {
                    add(method.with_orientation(*orientation));
                }
            }
        }
    }
    // The references know no laws of interactions.
    if !dbd_scene::interactions(scene).is_empty() {
        return ways;
    }
    ways.extend([Way::NaiveSemiImplicitEuler, Way::NaiveLeapfrog, Way::LinearlyImplicitEuler]);
    ways
}

/// Whether this build holds a method, and its precision the scene at rest.
fn holds(scene: &Scene, method: &Method) -> bool {
    method.check_built().is_ok()
        && check_inputs(scene, method).is_ok()
        && check_extents(scene, method, 0.0).is_ok()
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

    /// A millisecond per interval, fifty of them.
    fn grid() -> Grid {
        Grid::new(1e-3, 0.05)
    }

    #[test]
    fn ladders_ascend_and_begin_beyond_the_bounds_limit() {
        let method = Method::new(SchemeName::Leapfrog, None, PrecisionName::F64).unwrap();
        let ladder = Way::Kernel(method).ladder(1e4, 2e-4, &grid(), 3);
        // 2/1e4 s is the limit of leapfrog: five steps per millisecond.
        assert_eq!((ladder[0], ladder[1], *ladder.last().unwrap()), (4, 6, 400));
        assert!(ladder.windows(2).all(|pair| pair[0] < pair[1]));
        let still = Way::Kernel(method).ladder(0.0, f64::INFINITY, &grid(), 3);
        assert_eq!((still[0], *still.last().unwrap()), (1, 80));
        assert_eq!(Way::LinearlyImplicitEuler.ladder(1e4, f64::INFINITY, &grid(), 3)[0], 1);
        // Where no step was found stable, the steps of the linear limit are tried.
        assert_eq!(Way::Kernel(method).ladder(1e4, 0.0, &grid(), 3), ladder);
    }

    #[test]
    fn the_papers_ladder_goes_on_while_it_can_be_paid() {
        let paper = Way::Kernel(Method::new(SchemeName::Dbd, None, PrecisionName::F64).unwrap());
        let single = Way::Kernel(Method::new(SchemeName::Dbd, None, PrecisionName::F32).unwrap());
        let usual = single.ladder(1e4, 2e-4, &grid(), 3);
        let further = paper.ladder(1e4, 2e-4, &grid(), 3);
        assert_eq!(further[..usual.len()], usual);
        assert_eq!(further.len(), usual.len() + PAPER_SHARES.len());
        assert_eq!(paper.ladder(1e4, 2e-4, &grid(), 100_000), usual);
    }
}
