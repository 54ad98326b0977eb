//! Checks a model against the range of the fixed-point precision.
//!
//! `(model, initial states, step) => the first part beyond a limit`. Floating-point precisions have no limits.

use crate::body::BodyState;
use crate::elements::input::InputKind;
use crate::geometry::{Geometry, Limits};
use crate::index::{BodyIndex, GroupIndex, InputIndex};
use crate::model::{Group, ModelRef, Terms};
use crate::real::Real as _;

/// A part of a model beyond the range of a precision.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Excess {
    /// The part.
    pub part: Part,
    /// \[m\] its distance or displacement.
    pub value: f64,
    /// \[m\] the largest allowed value.
    pub limit: f64,
}

/// The parts with a limited range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Part {
    /// The centre of mass of this body, from the origin, along an axis.
    Body(BodyIndex),
    /// A point of this body, from its centre of mass.
    Point {
        /// The body.
        body: BodyIndex,
        /// The point's group; none for the point of an input.
        group: Option<GroupIndex>,
    },
    /// A point of the ground, from the origin, along an axis.
    Ground {
        /// The point's group.
        group: GroupIndex,
    },
    /// This body in one step, at its initial velocity.
    Drift(BodyIndex),
    /// The ground that this input moves.
    Signal(InputIndex),
}

impl core::fmt::Display for Excess {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { part, value, limit } = self;
        match part {
            Part::Body(body) => write!(f, "body {} is {value} m from the origin", body.0)?,
            Part::Point { body, .. } => {
                write!(f, "a point of body {} is {value} m from its centre of mass", body.0)?;
            }
            Part::Ground { .. } => write!(f, "a point of the ground is {value} m from the origin")?,
            Part::Drift(body) => write!(f, "body {} moves {value} m in a step", body.0)?,
            Part::Signal(input) => write!(f, "input {} moves the ground by {value} m", input.0)?,
        }
        write!(f, ", beyond the fixed-point limit of {limit} m")
    }
}

/// The first part of a model, with steps of `step` \[s\], beyond the range of the precision `P`: bodies, then groups,
/// then inputs. The values are those of the model in its own precision `Q`.
pub fn first_excess<P: Geometry, Q: Geometry, T: Terms<Q>>(
    model: &ModelRef<'_, Q, T>,
    initial: &[BodyState<Q>],
    step: f64,
) -> Option<Excess> {
    let limits = P::LIMITS?;
    let Limits { extent, elongation, drift, shift } = limits;
    for (row, state) in initial.iter().enumerate() {
        let body = BodyIndex(row as u16);
        let away = farthest(Q::position_to_f64(&state.position));
        if let Some(excess) = beyond(Part::Body(body), away, extent) {
            return Some(excess);
        }
        let moved = length(Q::velocity_to_f64(&state.velocity)) * step;
        if let Some(excess) = beyond(Part::Drift(body), moved, drift) {
            return Some(excess);
        }
    }
    for (row, group) in model.groups.iter().enumerate() {
        let first = group.point as usize;
        let points = model.points.get(first..first + group.points()).unwrap_or(&[]);
        for (i, point) in points.iter().enumerate() {
            let excess = out_of_reach::<Q>(&limits, group, GroupIndex(row as u16), i, point);
            if excess.is_some() {
                return excess;
            }
        }
    }
    for (row, input) in model.inputs.iter().enumerate() {
        let part = Part::Signal(InputIndex(row as u16));
        match &input.kind {
            InputKind::Force { body, point, .. } => {
                let part = Part::Point { body: *body, group: None };
                let excess = beyond(part, length(Q::local_to_f64(point)), elongation);
                if excess.is_some() {
                    return excess;
                }
            }
            InputKind::Anchor { .. } => {
                let first = input.knot as usize;
                let knots = model.knots.get(first..first + input.knots as usize).unwrap_or(&[]);
                let values = knots.iter().map(|knot| knot.value).chain([input.value]);
                let values = values.map(|value| value.to_f64().abs());
                let of_input = model.sources.iter().filter(|s| s.input.0 as usize == row);
                let sources = of_input.map(|source| source.most(model.knots)[0]);
                let most = values.chain(sources).fold(0.0, f64::max);
                let excess = beyond(part, most, shift);
                if excess.is_some() {
                    return excess;
                }
            }
            _ => {}
        }
    }
    None
}

/// Point `i` of a group if it is beyond its limit.
fn out_of_reach<Q: Geometry>(
    limits: &Limits,
    group: &Group,
    row: GroupIndex,
    i: usize,
    point: &Q::Local,
) -> Option<Excess> {
    let point = Q::local_to_f64(point);
    let body = if i < group.triples as usize { group.a } else { group.b };
    if body.is_world() {
        beyond(Part::Ground { group: row }, farthest(point), limits.extent)
    } else {
        beyond(Part::Point { body, group: Some(row) }, length(point), limits.elongation)
    }
}

fn beyond(part: Part, value: f64, limit: f64) -> Option<Excess> {
    // NaN is beyond every limit.
    if value <= limit { None } else { Some(Excess { part, value, limit }) }
}

/// The largest coordinate's magnitude.
fn farthest(v: [f64; 3]) -> f64 {
    let [x, y, z] = v.map(f64::abs);
    if x.is_nan() || y.is_nan() || z.is_nan() { f64::NAN } else { x.max(y).max(z) }
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    libm::sqrt(x * x + y * y + z * z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::Fixed;
    use crate::geometry::F64;
    use crate::model::ModelOwner as _;
    use crate::model_spec::{ModelSpec, Spring, Start};

    const SPRING: Spring = Spring { stiffness: 1.0, damping: 0.0, free_length: 1.0 };

    /// The excess of a mass at `at` \[m\] with a point and one of the ground.
    fn excess(at: [f64; 3], ground: [f64; 3], point: [f64; 3], step: f64) -> Option<Excess> {
        let start = Start { velocity: [0.0, -30.0, 0.0], ..Start::at(at) };
        let model_spec = ModelSpec::new().body(1.0, [1.0; 3], start).tsda(
            [BodyIndex::WORLD, BodyIndex(0)],
            [ground, point],
            SPRING,
        );
        let model = model_spec.model_f64::<1, 1, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0>();
        assert_eq!(first_excess::<F64, _, _>(&model.view(), &model.initial, step), None);
        first_excess::<Fixed, _, _>(&model.view(), &model.initial, step)
    }

    #[test]
    fn each_part_is_held_to_its_limit() {
        let zero = [0.0; 3];
        let inside = excess([24.0, -24.0, 0.0], [-24.0, 24.0, 1.0], [0.0, 7.0, 0.0], 1e-3);
        assert_eq!(inside, None);
        let found = |excess: Option<Excess>| excess.map(|e| (e.part, e.value, e.limit));
        let body = BodyIndex(0);
        let far = found(excess([0.0, -24.5, 0.0], zero, zero, 1e-3));
        assert_eq!(far, Some((Part::Body(body), 24.5, 24.0)));
        let fast = found(excess(zero, zero, zero, 1.0 / 64.0));
        assert_eq!(fast, Some((Part::Drift(body), 30.0 / 64.0, 0.125)));
        let point = found(excess(zero, zero, [6.0, 0.0, 8.0], 1e-3));
        assert_eq!(point, Some((Part::Point { body, group: Some(GroupIndex(0)) }, 10.0, 7.0)));
        let ground = found(excess(zero, [0.0, 0.0, 25.0], zero, 1e-3));
        assert_eq!(ground, Some((Part::Ground { group: GroupIndex(0) }, 25.0, 24.0)));
    }
}
