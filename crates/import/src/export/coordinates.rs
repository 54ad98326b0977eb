//! What acts on the coordinates of joints: limits, damping, friction, motors, couplings.
//!
//! `scene, tree => values of each joint, elements without a counterpart`.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::laws::CoordinateKind;
use dbd_kernel::{BodyIndex, F64, Vec3};
use dbd_scene::{InteractionInfo, Scene};
use nalgebra::Vector3;

use super::lack::{Lack, LeftOut};
use super::tree::{Motion, Tree};

/// Larger than any angle or travel of a limit.
const NONE: f64 = 1e29;

/// Axes are the same up to this sine.
const ALIKE: f64 = 1e-6;

/// What acts on the coordinate of a joint; angles in rad, travels in m.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Coordinate {
    /// \[rad, m\] its range.
    pub(super) range: Option<[f64; 2]>,
    /// \[N·m·s/rad, N·s/m\].
    pub(super) damping: f64,
    /// \[N·m, N\] sliding friction.
    pub(super) friction: f64,
    /// Its motors.
    pub(super) motors: Vec<Motor>,
    /// The joint it follows.
    pub(super) mimic: Option<Mimic>,
}

/// A force or torque that a controller sets.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Motor {
    pub(super) name: String,
    /// \[N·m, N\] the largest; infinite without bounds.
    pub(super) effort: f64,
    /// 1, or −1 where a positive value decreases the coordinate.
    pub(super) sign: f64,
}

/// `coordinate = multiplier·(coordinate of the other joint) + offset`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mimic {
    pub(super) joint: usize,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

/// The coordinates in the order of the joints.
pub(super) struct Coordinates(pub(super) Vec<Coordinate>);

/// Collects elements of a scene.
struct Reader<'r> {
    scene: &'r Scene,
    tree: &'r Tree,
    all: Vec<Coordinate>,
    left_out: Vec<LeftOut>,
}

impl Coordinates {
    /// All of them, and what has no counterpart, in the order of the scene's tables.
    pub(super) fn of(scene: &Scene, tree: &Tree) -> (Self, Vec<LeftOut>) {
        let all = vec![Coordinate::default(); tree.joints.len()];
        let mut reader = Reader { scene, tree, all, left_out: Vec::new() };
        reader.loops();
        reader.springs();
        reader.laws();
        reader.inputs();
        for (row, body) in scene.model.bodies.iter().enumerate() {
            if body.is_driven() {
                let what = format!("driven body `{}`", scene.body_name(row));
                reader.lack(Lack::Input, scene.line_of_body(row), what);
            }
        }
        for load in &scene.model.loads {
            let body = scene.body_name(load.body.row());
            reader.lack(Lack::Load, None, format!("load on `{body}`"));
        }
        reader.left_out.sort_by_key(|item| item.line);
        (Self(reader.all), reader.left_out)
    }
}

impl Reader<'_> {
    fn lack(&mut self, kind: Lack, line: Option<usize>, what: String) {
        self.left_out.push(LeftOut { kind, line, what });
    }

    /// The joint whose coordinate is that of two bodies about or along an axis of A, and 1, or −1 where its sign is the
    /// opposite.
    fn joint(
        &self,
        motion: Motion,
        bodies: [BodyIndex; 2],
        axis: [f64; 3],
    ) -> Option<(usize, f64)> {
        let row = |body: BodyIndex| (!body.is_world()).then(|| body.row());
        let axis = Vec3::from_f64(axis);
        let axis = match row(bodies[0]).and_then(|row| self.scene.assembled_states().get(row)) {
            Some(state) => state.orientation.rotation().to_world(axis),
            None => axis,
        };
        let axis = Vector3::from(axis.to_f64());
        self.tree.joints.iter().enumerate().find_map(|(place, joint)| {
            let of = &self.scene.joints[joint.of.filter(|_| joint.motion == motion)?];
            let at = |end: &String| self.scene.body_names.iter().position(|name| name == end);
            let ends = of.between.each_ref().map(at);
            let order = match bodies.map(row) {
                order if order == ends => 1.0,
                [a, b] if [b, a] == ends => -1.0,
                _ => return None,
            };
            // The coordinate has the sign of the scene's joint, from its first body to its second.
            let own = Vector3::from(of.axes[0].to_f64());
            let is_same = own.cross(&axis).norm() <= ALIKE;
            is_same.then(|| (place, order * own.dot(&axis).signum()))
        })
    }

    fn loops(&mut self) {
        for &number in &self.tree.loops {
            let joint = &self.scene.joints[number];
            let [a, b] = &joint.between;
            let what = format!("joint `{}` ({a}–{b})", joint.name);
            self.lack(Lack::Loop, self.scene.line_of_joint(number), what);
        }
    }

    /// Raw springs and torsion springs.
    fn springs(&mut self) {
        let scene = self.scene;
        let first = scene.joints.len();
        for (row, name) in scene.raw_names().iter().enumerate() {
            self.lack(Lack::Spring, scene.line_of_element(first + row), name.clone());
        }
        let first = first + scene.raw_names().len();
        let named = scene.torsion_names.iter().take(scene.torsion_springs());
        for (row, (spring, name)) in scene.model.torsions.iter().zip(named).enumerate() {
            let of = self.joint(Motion::Turn, [spring.a, spring.b], spring.axis.to_f64());
            let damping = spring.damper.row().and_then(|row| scene.model.dampers.get(row));
            if let Some((joint, _)) = of {
                self.all[joint].damping += damping.copied().unwrap_or(0.0);
            }
            if of.is_none() || spring.stiffness != 0.0 || spring.preload != 0.0 {
                let mut what = name.clone();
                if of.is_some() && damping.is_some() {
                    what += ": all but its damping";
                }
                self.lack(Lack::Spring, scene.line_of_element(first + row), what);
            }
        }
    }

    fn laws(&mut self) {
        let scene = self.scene;
        for (row, law) in dbd_scene::interactions(scene).iter().enumerate() {
            let Some((table, number)) = scene.table_of_interaction(row) else { continue };
            let line = scene.line_of_interaction(row);
            let lack = match table {
                "coupling" => self.couple(law).err(),
                "input" => self.drive(law, number),
                // A sensor exerts no force; it is left out as read-outs are.
                _ if law.law.ends_with("-sensor") => None,
                _ => self.law(law),
            };
            if let Some((kind, why)) = lack {
                self.lack(kind, line, format!("{}{why}", law.label));
            }
        }
    }

    /// A law of a joint, or one between two bodies; why it has no counterpart.
    fn law(&mut self, law: &InteractionInfo) -> Option<(Lack, &'static str)> {
        let motion = if law.law.contains("hinge") { Motion::Turn } else { Motion::Slide };
        let joint = axis_of(law).and_then(|axis| self.joint(motion, law.bodies, axis));
        match (law.law, joint) {
            (
                "hinge-stop" | "soft-hinge-stop" | "end-stop" | "soft-end-stop",
                Some((joint, sign)),
            ) => {
                let mut range = [law.number("from"), law.number("to")].map(|end| sign * end);
                range.sort_by(f64::total_cmp);
                let of = &mut self.all[joint].range;
                let [from, to] = of.unwrap_or([-f64::INFINITY, f64::INFINITY]);
                *of = Some([from.max(range[0]), to.min(range[1])]);
                None
            }
            ("hinge-friction" | "slide-friction", Some((joint, _))) => {
                self.all[joint].friction += law.number("coulomb");
                self.all[joint].damping += law.number("viscous");
                None
            }
            ("hinge-friction-load" | "slide-friction-load", Some((joint, _))) => {
                self.all[joint].friction += law.number("coulomb");
                self.all[joint].damping += law.number("viscous");
                Some((Lack::Spring, ": all but its friction without load"))
            }
            ("hinge-damper", Some((joint, _))) => {
                self.all[joint].damping += law.number("damping");
                None
            }
            (law, _) if law.contains("contact") => Some((Lack::Contact, "")),
            (law, _) if law.contains("drive") => Some((Lack::Rotor, "")),
            _ => Some((Lack::Spring, "")),
        }
    }

    /// A drive or an input with a signal chain: its torque or force at the joint.
    fn drive(&mut self, law: &InteractionInfo, input: usize) -> Option<(Lack, &'static str)> {
        let motion = if law.law.contains("hinge") { Motion::Turn } else { Motion::Slide };
        match axis_of(law).and_then(|axis| self.joint(motion, law.bodies, axis)) {
            Some((joint, sign)) => {
                let name = self.scene.inputs[input].name.clone();
                let has_chain = law.law.ends_with("-actuator");
                // The signal of a drive may be a voltage or a speed.
                let effort = match has_chain {
                    true => law.number("least").abs().max(law.number("most").abs()),
                    false => f64::INFINITY,
                };
                self.all[joint].motors.push(Motor { name, effort, sign });
                let kind = if has_chain { Lack::Input } else { Lack::Rotor };
                Some((kind, ": all but its torque or force"))
            }
            None => Some((Lack::Input, "")),
        }
    }

    fn couple(&mut self, law: &InteractionInfo) -> Result<(), (Lack, &'static str)> {
        let lack = |why| (Lack::Coupling, why);
        let [first, second] = law.terms[..] else {
            return Err(lack(": not of two coordinates"));
        };
        if law.number("play") != 0.0 {
            return Err(lack(": has play"));
        }
        if law.number("pulls") == 0.0 || law.number("pushes") == 0.0 {
            return Err(lack(": acts on one side"));
        }
        let of = |term: &dbd_kernel::laws::Term<F64>| match &term.way {
            CoordinateKind::Turn(hinge) => {
                self.joint(Motion::Turn, term.bodies, hinge.axis.to_f64())
            }
            CoordinateKind::Travel { axis, .. } => {
                self.joint(Motion::Slide, term.bodies, axis.to_f64())
            }
        };
        let found = (of(&first), of(&second));
        let (Some((follower, one)), Some((leader, two))) = found else {
            return Err(lack(": of a joint that closes a loop"));
        };
        // Each joint follows at most one, and none itself.
        let mut next = Some(leader);
        while let Some(joint) = next.filter(|joint| *joint != follower) {
            next = self.all[joint].mimic.as_ref().map(|mimic| mimic.joint);
        }
        if next.is_some() || self.all[follower].mimic.is_some() {
            return Err(lack(": the joint has another coupling"));
        }
        let [a, b] = [one * first.factor, two * second.factor];
        let (multiplier, offset) = (-b / a, law.number("offset") / a);
        self.all[follower].mimic = Some(Mimic { joint: leader, multiplier, offset });
        Ok(())
    }

    fn inputs(&mut self) {
        let scene = self.scene;
        for (row, info) in scene.inputs.iter().enumerate() {
            let input = scene.model.inputs.get(usize::from(info.index.0)).map(|input| &input.kind);
            let joint = match input {
                Some(InputKind::JointTorque { a, b, axes }) => {
                    self.joint(Motion::Turn, [*a, *b], axes[0].to_f64())
                }
                Some(InputKind::JointForce { a, b, axis, .. }) => {
                    self.joint(Motion::Slide, [*a, *b], axis.to_f64())
                }
                // Drives and signal chains are among the laws.
                Some(InputKind::Signal)
                    if ["drive", "joint_torque", "joint_force"].contains(&info.kind) =>
                {
                    continue;
                }
                _ => None,
            };
            let (name, kind) = (info.name.clone(), info.kind);
            match joint {
                Some((joint, sign)) => {
                    let effort = info.range[0].abs().max(info.range[1].abs());
                    self.all[joint].motors.push(Motor { name, effort, sign });
                }
                None => {
                    let what = format!("{kind} `{name}`");
                    self.lack(Lack::Input, scene.line_of_input(row), what);
                }
            }
        }
    }
}

/// The axis of a law, or its direction.
fn axis_of(law: &InteractionInfo) -> Option<[f64; 3]> {
    law.axis.or(law.normal)
}

/// Whether an end of a range bounds anything.
pub(super) fn bounds(end: f64) -> bool {
    end.abs() < NONE
}
