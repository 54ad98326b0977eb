//! Elements and inputs along coordinates.
//!
//! `coordinate, law => torsion spring, TSDA or point on a line; input`.

use nalgebra::Vector3;

use crate::coordinate::{Coordinate, Law};
use crate::interaction::{Sides, bushing};
use crate::mechanism::{Interaction, Line, Mechanism, Rail, Torsion, rounded};
use crate::notation::{text, vector};
use crate::part::Side;
use crate::place::Source;

/// An input on a coordinate: its type, its keys, the sign of its value.
pub(crate) type Drive = (&'static str, Vec<String>, f64);

impl Coordinate {
    /// Adds the element of a law; returns its name.
    pub(crate) fn spring(
        &self,
        mechanism: &mut Mechanism<'_>,
        wanted: &str,
        law: Law,
        source: Source,
    ) -> String {
        let name = mechanism.own_name(wanted);
        let Law { stiffness, damping, rest, bias } = law;
        match *self {
            Self::Turn { between, axis, is_of_second, .. } => {
                // At the torsion angle θ the torque is k·(rest − θ) + bias; as seen from the second body θ has the
                // opposite sign.
                let preload = stiffness * rest + bias;
                let [first, second] = between;
                let (between, preload) =
                    if is_of_second { ([second, first], -preload) } else { (between, preload) };
                let name = name.clone();
                mechanism.torsions.push(Torsion {
                    name,
                    between,
                    axis,
                    stiffness,
                    damping,
                    preload,
                    source,
                });
            }
            Self::Slide { between, at, axis, travel, .. } => {
                // The endpoint on the first body lies ahead on the axis, beyond the travel of the slide: the length is
                // then linear in the coordinate, the force acts along the axis, and both endpoints lie on it, so that
                // the force has no moment.
                let zero = law.zero();
                let reach = (2.0 * mechanism.size()).max(2.0 * travel);
                let length = rounded(reach.max(4.0 * zero.abs()));
                if travel == 0.0 {
                    mechanism.notes.push(format!(
                        "`{name}` acts along a slide without a range: exact up to a travel of {length} m"
                    ));
                }
                mechanism.lines.push(Line {
                    name: name.clone(),
                    between,
                    points: [at + axis * length, at],
                    free_length: length - zero,
                    stiffness,
                    damping,
                    source,
                });
            }
            Self::Length { between, points } => {
                let free_length = (points[1] - points[0]).norm() + law.zero();
                mechanism.lines.push(Line {
                    name: name.clone(),
                    between,
                    points,
                    free_length,
                    stiffness,
                    damping,
                    source,
                });
            }
            Self::Shift { part, at, axis, across } => {
                let line = at + axis * law.zero();
                let name = name.clone();
                mechanism.rails.push(Rail {
                    name,
                    part,
                    line,
                    across,
                    at,
                    stiffness,
                    damping,
                    source,
                });
            }
            Self::Level { between, at, axis, across } => {
                let sides = Sides { between, at: [at + axis * law.zero(), at] };
                let along = [[stiffness, 0.0, 0.0], [damping, 0.0, 0.0]];
                let keys = bushing(mechanism, &sides, [axis, across], along, [[0.0; 3]; 2]);
                let (name, law) = (name.clone(), "bushing");
                mechanism.interactions.push(Interaction { name, law, between, keys, source });
            }
        }
        name
    }

    /// Type and keys of an input along it; `element` is the TSDA along which it acts.
    pub(crate) fn drive(&self, mechanism: &Mechanism<'_>, element: &str) -> Drive {
        let vector = |v: Vector3<f64>| vector(v, 1.0);
        match self {
            Self::Turn { joint: Some((joint, about)), .. } => {
                let mut keys = vec![format!("target = {}", text(joint))];
                keys.extend(about.map(|about| format!("about = \"{about}\"")));
                ("joint_torque", keys, 1.0)
            }
            Self::Turn { between, axis, .. } => {
                let body = text(mechanism.name(between[1]));
                ("torque", vec![format!("body = {body}"), format!("axis = {}", vector(*axis))], 1.0)
            }
            Self::Slide { joint: Some((joint, is_reversed)), .. } => {
                let sign = if *is_reversed { -1.0 } else { 1.0 };
                ("joint_force", vec![format!("target = {}", text(joint))], sign)
            }
            Self::Slide { .. } => ("actuator", vec![format!("target = {}", text(element))], 1.0),
            // A TSDA pulls its endpoints together.
            Self::Length { .. } => ("actuator", vec![format!("target = {}", text(element))], -1.0),
            Self::Shift { part, at, axis, .. } => force(mechanism, Some(*part), *at, *axis),
            Self::Level { between, at, axis, .. } => force(mechanism, between[1], *at, *axis),
        }
    }
}

/// A force on a point of a part along an axis of the world.
fn force(mechanism: &Mechanism<'_>, part: Side, at: Vector3<f64>, axis: Vector3<f64>) -> Drive {
    let point = mechanism.within(part, at);
    let keys = vec![
        format!("body = {}", text(mechanism.name(part))),
        format!("point = {}", vector(point, mechanism.size())),
        format!("axis = {}", vector(axis, 1.0)),
    ];
    ("force", keys, 1.0)
}
