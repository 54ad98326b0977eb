//! A model's elements, one by one, as a flat list.
//!
//! `model => plain loop`, or what it has that a plain loop lacks.

use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyIndex, F64, LoadFrame};
use dbd_scene::SceneModel;
use thiserror::Error;

use crate::vectors::Vector;

use super::body::{Body, Load};
use super::elements::{Deformation, End, Spring, Torsion};
use super::run::Plain;

/// Why there is no plain loop of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Lacks {
    /// It has no inputs.
    #[error("the plain loop has no inputs")]
    Inputs,
    /// It has no clearances.
    #[error("the plain loop has no clearances")]
    Clearances,
    /// A joint is springs between points, not one law for point and axes.
    #[error("the plain loop has no revolute or universal joints of bushings")]
    Axes,
}

impl Plain {
    /// A model at t = 0, with the step `step` \[s\].
    ///
    /// # Errors
    /// [`Lacks`] where the model has what a plain loop does not.
    pub fn of_model(model: &SceneModel<F64>, step: f64) -> Result<Self, Lacks> {
        if !model.inputs.is_empty() {
            return Err(Lacks::Inputs);
        }
        if !model.clearances.is_empty() {
            return Err(Lacks::Clearances);
        }
        let springs = model.groups.iter();
        let springs =
            springs.flat_map(|group| (0..group.elements()).map(|i| spring(model, group, i)));
        let springs = springs.collect::<Result<_, _>>()?;
        Ok(Self {
            bodies: bodies(model),
            gravity: model.gravity.first().map_or([0.0; 3], |gravity| gravity.to_f64()),
            springs,
            torsions: torsions(model),
            loads: loads(model),
            step,
            steps: 0,
            has_forces: false,
        })
    }
}

fn end(body: BodyIndex) -> End {
    (!body.is_world()).then(|| body.row())
}

fn bodies(model: &SceneModel<F64>) -> Vec<Body> {
    let rows = model.bodies.iter().zip(&model.initial);
    rows.map(|(body, state)| Body {
        mass: body.mass,
        inertia: body.inertia.to_f64(),
        position: state.position.to_f64(),
        orientation: state.orientation.to_f64(),
        velocity: state.velocity.to_f64(),
        rate: state.angular_velocity.to_f64(),
        rotation: [[0.0; 3]; 3],
        spin: [0.0; 3],
        force: [0.0; 3],
        torque: [0.0; 3],
    })
    .collect()
}

/// Element `i` of a group: star by star, arm by arm.
fn spring(model: &SceneModel<F64>, group: &Group, i: usize) -> Result<Spring, Lacks> {
    let (triples, arms) = (usize::from(group.triples), usize::from(group.arms));
    let tip = if group.shared { i % arms } else { i };
    let point = |row: usize| -> Vector { model.points[usize::from(group.point) + row].to_f64() };
    let row = usize::from(group.element) + i;
    let (deformation, stiffness) = match group.law {
        Law::Tsda => {
            let tsda = &model.tsdas[row];
            (Deformation::Length(tsda.free_length), tsda.stiffness)
        }
        Law::PointBushing => (Deformation::Anywhere, model.bushings[row].stiffness),
        Law::PointOnLine => {
            let line = &model.lines[row];
            (Deformation::Across(line.direction.to_f64(), line.free_length), line.stiffness)
        }
        Law::Revolute | Law::Universal => return Err(Lacks::Axes),
    };
    Ok(Spring {
        ends: [end(group.a), end(group.b)],
        points: [point(i / arms), point(triples + tip)],
        deformation,
        stiffness,
        damping: group.damper.row().map_or(0.0, |first| model.dampers[first + i]),
    })
}

fn torsions(model: &SceneModel<F64>) -> Vec<Torsion> {
    let torsion = |spring: &dbd_kernel::TorsionSpring<f64>| Torsion {
        ends: [end(spring.a), end(spring.b)],
        axis: spring.axis.to_f64(),
        reference: spring.reference.to_f64(),
        stiffness: spring.stiffness,
        damping: spring.damper.row().map_or(0.0, |row| model.dampers[row]),
        preload: spring.preload,
        torsion_angle: 0.0,
    };
    model.torsions.iter().map(torsion).collect()
}

fn loads(model: &SceneModel<F64>) -> Vec<Load> {
    let load = |load: &dbd_kernel::Load<f64>| Load {
        body: load.body.row(),
        in_body_axes: load.frame == LoadFrame::Body,
        force: load.force.to_f64(),
        torque: load.torque.to_f64(),
        from: load.from,
        until: load.until,
    };
    model.loads.iter().map(load).collect()
}
