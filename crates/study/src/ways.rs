//! All methods for a scene, and the steps tried with each.
//!
//! `scene => methods; method, frequency bound, interval => steps per interval`. New schemes, precisions and
//! orientations of [`dbd_plant::method`] are included automatically.

use crate::reference::State;
use dbd_plant::plant::{check_extents, check_inputs};
use dbd_plant::{DampingName, Method, Named as _, OrientationName, PrecisionName, SchemeName};
use dbd_scene::Scene;

use crate::grid::Grid;
use crate::point::{Machine, Stepper, is_paper};
use crate::reference::fine::is_implemented;

/// A method: of the kernel, or a reference.
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

/// Steps as fractions of the largest stable one: the first is beyond it, the second within the margin, the third is the
/// largest advised one.
const SHARES: [f64; 12] = [1.3, 0.98, 0.8, 0.6, 0.4, 0.28, 0.2, 0.14, 0.1, 0.05, 0.025, 0.0125];

/// The paper's scheme is carried on to these, for all others are compared with it.
const PAPER_SHARES: [f64; 4] = [0.005, 0.002, 0.001, 0.0005];

/// Maximum force evaluations × bodies over the window: 10 s each.
const AFFORDABLE: f64 = 1e8;

/// Maximum for the references, which are slow and for comparison only.
const REFERENCE_SHARES: [f64; 6] = [1.3, 0.8, 0.4, 0.2, 0.1, 0.025];

/// An unconditionally stable solver starts at this multiple of an explicit scheme's stable step.
const IMPLICIT: f64 = 64.0;

/// Fraction of the largest angular velocity below which rates about a second axis do not count.
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

    /// Largest stable `ω_max·h` of an undamped oscillator; infinite without a limit.
    #[must_use]
    pub fn stability_limit(&self) -> f64 {
        match self {
            Self::Kernel(method) => method.stability_limit(),
            Self::LinearlyImplicitEuler => f64::INFINITY,
            Self::NaiveSemiImplicitEuler | Self::NaiveLeapfrog => 2.0,
        }
    }

    /// Steps per interval to try, strictly ascending, for the given number of bodies with the highest frequency
    /// `highest` \[rad/s\]; an explicit method's ladder starts at `largest` \[s\].
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

/// All methods for a scene. The paper's scheme also with a Newton iteration, Euler angles if bodies rotate in space,
/// joint-wise and explicit damping if there are dampers and the scheme supports them. Methods for comparison only if
/// this build includes them; no precision that cannot represent the scene.
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
                // One scheme suffices to show the effect of its square root.
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
    if !is_implemented(scene) {
        return ways;
    }
    ways.extend([Way::NaiveSemiImplicitEuler, Way::NaiveLeapfrog, Way::LinearlyImplicitEuler]);
    ways
}

/// Whether this build includes a method, and its precision represents the scene at rest.
fn holds(scene: &Scene, method: &Method) -> bool {
    method.check_built().is_ok()
        && check_inputs(scene, method).is_ok()
        && check_extents(scene, method, 0.0).is_ok()
}

/// Whether a body rotates about more than one of its axes.
#[must_use]
pub fn in_space(reference_solution: &[State]) -> bool {
    reference_solution.iter().flat_map(|state| &state.bodies).any(|body| {
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
