//! The default step of a scene without one, the same for runs, sweeps, studies, FMUs, Python, exported source, build
//! scripts and new projects.
//!
//! `(highest frequency, largest angular velocity, limits of a method, duration) => limit`, which
//! [`Span::round_step`](crate::fitting::Span::round_step) rounds to a step.

use dbd_kernel::State;
use dbd_kernel::elements::source::SourceLaw;

use crate::runtime::SceneModel;

/// Number of steps of a run without vibration.
const STEPS_WITHOUT_SPRINGS: f64 = 1000.0;

/// Default step over the longest accepted step: frequencies may rise during motion.
const MARGIN: f64 = 0.5;

/// \[rad\] largest rotation of a body in a step: beyond it the splitting of the free rotor loses energy and accuracy.
pub const LARGEST_TURN: f64 = 0.1;

/// Number of default steps in the shortest period of a sine or a periodic table.
pub const STEPS_PER_PERIOD: f64 = 40.0;

/// \[s\] The shortest period of a sine or a periodic table of a model; infinite without one.
#[must_use]
pub fn shortest_period(model: &SceneModel<dbd_kernel::F64>) -> f64 {
    let period = |law: &SourceLaw<dbd_kernel::F64>| match *law {
        SourceLaw::Sine { period, .. } | SourceLaw::Periodic { period } => period,
        SourceLaw::Over { .. } => f64::INFINITY,
    };
    model.sources.iter().map(|source| period(&source.law)).fold(f64::INFINITY, f64::min)
}

/// Limits of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bears {
    /// \[1\] the largest ω·h at which it is stable; infinite if unconditionally stable.
    pub stability: f64,
    /// \[1\] the largest ω·h that its matrix resolves in its precision, if it has one.
    pub vibration: Option<f64>,
}

/// \[rad/s\] The largest angular velocity of a body at t = 0, and that body.
#[must_use]
pub fn fastest_spin(state: &State<SceneModel<dbd_kernel::F64>>) -> (f64, usize) {
    let (mut spin, mut fastest) = (0.0, 0);
    for (row, body) in state.bodies.iter().enumerate() {
        let rate = body.angular_velocity;
        let rate = rate.dot(rate).sqrt();
        if rate > spin {
            (spin, fastest) = (rate, row);
        }
    }
    (spin, fastest)
}

/// \[s\] The longest default step: half the stability limit of leapfrog for the angular frequency `bound` \[rad/s\];
/// for unconditionally stable methods a thousandth of the duration \[s\] or half of what the matrix resolves. No body
/// rotates by more than [`LARGEST_TURN`] in it; `spin` \[rad/s\] is the largest angular velocity.
#[must_use]
pub fn longest(bound: f64, spin: f64, bears: Bears, duration: f64) -> f64 {
    let free = duration / STEPS_WITHOUT_SPRINGS;
    let vibration = match bears.vibration {
        _ if bound <= 0.0 => free,
        _ if bears.stability.is_finite() => 1.0 / bound,
        Some(most) => free.min(MARGIN * most / bound),
        None => free,
    };
    if spin > 0.0 { vibration.min(LARGEST_TURN / spin) } else { vibration }
}
