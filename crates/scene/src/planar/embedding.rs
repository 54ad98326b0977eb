//! Conversion from the plane to the world: models, read-outs and their values.
//!
//! `model of the plane => the same elements in the world's axes; read-out => read-out of the plane;
//! reading of the plane => reading`. States in the world belong to the model in the world: energies, tensions and
//! forces of a planar run are those of its elements there.

use dbd_kernel::elements::input::{Input, InputKind};
use dbd_kernel::elements::source::{Sensor, Source, SourceLaw};
use dbd_kernel::model::Law;
use dbd_kernel::readouts::{Reading, Readout, Slide};
use dbd_kernel::{
    Body, BodyIndex, BodyState, F64, Load, LoadFrame, PointOnLine, TorsionSpring, Vec3,
};

use crate::planar::Planar;
use crate::runtime::SceneModel;

impl Planar {
    /// A model of the plane, this one or a rounding of it, in the world's axes. `whole` is the spatial model, which has
    /// the moments of inertia that the plane lacks.
    #[must_use]
    pub fn in_world(&self, whole: &SceneModel<F64>, flat: &SceneModel<F64>) -> SceneModel<F64> {
        let plane = &self.plane;
        let bodies = flat.bodies.iter().zip(&whole.bodies).enumerate();
        let states = flat.initial.iter().enumerate();
        let load = |load: &Load<f64>| Load {
            force: self.outward(load.body, load.frame, load.force),
            torque: self.outward(load.body, load.frame, load.torque),
            ..*load
        };
        let torsion = |spring: &TorsionSpring<f64>| TorsionSpring {
            axis: plane.of_body_outward(spring.a.row(), spring.axis),
            reference: plane.turn_outward(spring.a.row(), spring.b.row(), spring.reference),
            ..*spring
        };
        let input = |input: &Input<F64>| Input { kind: self.kind_outward(input.kind), ..*input };
        SceneModel {
            bodies: bodies.map(|(row, (flat, whole))| self.body(row, flat, whole)).collect(),
            initial: states.map(|(row, state)| plane.state_outward(row, state)).collect(),
            gravity: flat.gravity.iter().map(|g| plane.outward(*g)).collect(),
            points: self.points_outward(flat),
            lines: self.lines_outward(flat),
            torsions: flat.torsions.iter().map(torsion).collect(),
            loads: flat.loads.iter().map(load).collect(),
            inputs: flat.inputs.iter().map(input).collect(),
            // There the sources read in the world's axes.
            sources: whole.sources.clone(),
            laws: whole.laws.clone(),
            ..flat.clone()
        }
    }

    /// Converts a state in the plane to the world, bodies in order.
    pub fn states_outward(&self, states: &mut [BodyState<F64>]) {
        for (row, state) in states.iter_mut().enumerate() {
            *state = self.plane.state_outward(row, state);
        }
    }

    /// Converts a read-out of the scene to the model in the plane.
    #[must_use]
    pub fn readout(&self, readout: &Readout<F64>) -> Readout<F64> {
        let flat = |body: BodyIndex, point| {
            let point = self.plane.point_inward(body.row(), point);
            Vec3::new(point.x, point.y, 0.0)
        };
        let slide_in = |slide: Slide<F64>| {
            let ([a, b], [at_a, at_b]) = (slide.bodies, slide.points);
            let axis = self.plane.of_body_inward(a.row(), slide.axis);
            let axis = Vec3::new(axis.x, axis.y, 0.0);
            Slide { points: [flat(a, at_a), flat(b, at_b)], axis, ..slide }
        };
        match *readout {
            Readout::Point { body, point } => Readout::Point { body, point: flat(body, point) },
            Readout::PointVelocity { body, point } => {
                Readout::PointVelocity { body, point: flat(body, point) }
            }
            Readout::Imu { body, point } => Readout::Imu { body, point: flat(body, point) },
            Readout::JointTravel { slide, offset } => {
                Readout::JointTravel { slide: slide_in(slide), offset }
            }
            Readout::JointTravelRate { slide } => {
                Readout::JointTravelRate { slide: slide_in(slide) }
            }
            other => other,
        }
    }

    /// Converts a source of the scene to the model in the plane.
    pub(crate) fn source(&self, source: &Source<F64>) -> Source<F64> {
        let SourceLaw::Over { sensor, weights, offset } = source.law else { return *source };
        let readout = match sensor {
            Sensor::Point { body, point } => Readout::Point { body, point },
            Sensor::Velocity { body, point } => Readout::PointVelocity { body, point },
            // A number is the same in the plane.
            Sensor::Angle { .. } | Sensor::Rate { .. } => return *source,
        };
        let shown = |v: Vec3<f64>| match self.reading(&readout, Reading::Vector(v)) {
            Reading::Vector(v) => weights[0] * v.x + weights[1] * v.y + weights[2] * v.z,
            _ => 0.0,
        };
        let origin = shown(Vec3::ZERO);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let weights = axes.map(|[x, y, z]| shown(Vec3::new(x, y, z)) - origin);
        let sensor = self.readout(&readout).sensor().unwrap_or(sensor);
        let law = SourceLaw::Over { sensor, weights, offset: origin + offset };
        Source { law, ..*source }
    }

    /// The value of a read-out of the scene, from the value in the plane.
    #[must_use]
    pub fn reading(&self, readout: &Readout<F64>, reading: Reading<f64>) -> Reading<f64> {
        let plane = &self.plane;
        match (reading, *readout) {
            (Reading::Vector(v), Readout::Point { body, point }) => {
                let off = plane.point_inward(body.row(), point).z;
                Reading::Vector(plane.place_outward(Vec3::new(v.x, v.y, off)))
            }
            (Reading::Vector(v), _) => Reading::Vector(plane.outward(v)),
            (Reading::Imu { specific_force, rate }, Readout::Imu { body, .. }) => Reading::Imu {
                specific_force: plane.of_body_outward(body.row(), specific_force),
                rate: plane.of_body_outward(body.row(), rate),
            },
            (other, _) => other,
        }
    }

    /// A body with the mass and the moment about the normal of the planar one.
    fn body(&self, row: usize, flat: &Body<f64>, whole: &Body<f64>) -> Body<f64> {
        let normal = self.plane.of_body_outward(row, Vec3::new(0.0, 0.0, 1.0));
        let mut inertia = whole.inertia.to_f64();
        for (moment, along) in inertia.iter_mut().zip(normal.to_f64()) {
            if along.abs() == 1.0 {
                *moment = flat.inertia.z;
            }
        }
        let body = Body::from_f64(flat.mass, inertia);
        if flat.is_driven() { body.driven() } else { body }
    }

    fn point_outward(&self, body: BodyIndex, point: Vec3<f64>) -> Vec3<f64> {
        if body.is_world() {
            self.plane.place_outward(point)
        } else {
            self.plane.of_body_outward(body.row(), point)
        }
    }

    fn points_outward(&self, flat: &SceneModel<F64>) -> Vec<Vec3<f64>> {
        let mut points = flat.points.clone();
        for group in &flat.groups {
            let first = usize::from(group.point);
            let own = &mut points[first..first + group.points()];
            let (centres, tips) = own.split_at_mut(usize::from(group.triples));
            centres.iter_mut().for_each(|point| *point = self.point_outward(group.a, *point));
            tips.iter_mut().for_each(|point| *point = self.point_outward(group.b, *point));
        }
        points
    }

    fn lines_outward(&self, flat: &SceneModel<F64>) -> Vec<PointOnLine<f64>> {
        let mut lines = flat.lines.clone();
        for group in flat.groups.iter().filter(|group| group.law == Law::PointOnLine) {
            let first = usize::from(group.element);
            for line in &mut lines[first..first + group.elements()] {
                line.direction = self.plane.of_body_outward(group.a.row(), line.direction);
            }
        }
        lines
    }

    fn outward(&self, body: BodyIndex, frame: LoadFrame, v: Vec3<f64>) -> Vec3<f64> {
        match frame {
            LoadFrame::World => self.plane.outward(v),
            LoadFrame::Body => self.plane.of_body_outward(body.row(), v),
        }
    }

    fn kind_outward(&self, kind: InputKind<F64>) -> InputKind<F64> {
        match kind {
            InputKind::Force { body, point, direction, frame } => InputKind::Force {
                body,
                point: self.point_outward(body, point),
                direction: self.outward(body, frame, direction),
                frame,
            },
            InputKind::Torque { body, axis, frame } => {
                InputKind::Torque { body, axis: self.outward(body, frame, axis), frame }
            }
            InputKind::JointTorque { a, b, axes: [in_a, in_b] } => {
                let outward = |body: BodyIndex, axis| self.plane.of_body_outward(body.row(), axis);
                InputKind::JointTorque { a, b, axes: [outward(a, in_a), outward(b, in_b)] }
            }
            InputKind::JointForce { a, b, point, axis } => InputKind::JointForce {
                a,
                b,
                point: self.point_outward(b, point),
                axis: self.outward(a, LoadFrame::Body, axis),
            },
            InputKind::Actuator { .. } | InputKind::Signal => kind,
            InputKind::Gravity { direction } => {
                InputKind::Gravity { direction: self.plane.outward(direction) }
            }
            InputKind::Velocity { body, direction } => {
                InputKind::Velocity { body, direction: self.plane.outward(direction) }
            }
            InputKind::AngularVelocity { body, axis } => {
                InputKind::AngularVelocity { body, axis: self.plane.outward(axis) }
            }
            InputKind::Anchor { direction } => {
                InputKind::Anchor { direction: self.plane.outward(direction) }
            }
        }
    }
}
