//! The links of a URDF and the joints that hold them.
//!
//! `bodies and joints of a scene => tree from the ground`. The frame of each link has the world's axes where the joints
//! are assembled, with its origin at the joint that holds it. A universal, cylindrical or spherical joint becomes
//! several joints with links between them; these have no mass but that of a spider.

use std::collections::{BTreeSet, VecDeque};

use dbd_scene::{JointInfo, Scene};
use nalgebra::Vector3;

/// The ground's link.
pub(super) const WORLD: usize = 0;

/// A link.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) name: String,
    /// The body of the model; `None` for the ground and links without mass.
    pub(super) body: Option<usize>,
    /// \[m\] its frame's origin, world.
    pub(super) at: Vector3<f64>,
}

/// What a joint of a URDF permits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    Fixed,
    Free,
    Turn,
    Slide,
}

/// A joint of a URDF.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) motion: Motion,
    /// Its two links.
    pub(super) parent: usize,
    pub(super) child: usize,
    /// Unit axis, world; its coordinate has the sign of the scene's.
    pub(super) axis: Vector3<f64>,
    /// The scene's joint if this is its only rotation or translation.
    pub(super) of: Option<usize>,
}

/// Links and joints; every link but the ground's is the child of one joint.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
    /// The scene's joints that close loops.
    pub(super) loops: Vec<usize>,
}

impl Tree {
    /// Breadth first from the ground, joints in scene order; a body without a way to it is free.
    pub(super) fn of(scene: &Scene) -> Self {
        let ground = Link { name: "world".into(), body: None, at: Vector3::zeros() };
        let mut tree = Self { links: vec![ground], joints: Vec::new(), loops: Vec::new() };
        let row = |name: &String| scene.body_names.iter().position(|body| body == name);
        let ends: Vec<_> =
            scene.joints.iter().map(|joint| joint.between.each_ref().map(row)).collect();
        let spiders: BTreeSet<_> =
            scene.joints.iter().filter_map(|joint| row(joint.spider.as_ref()?)).collect();
        let roots = (0..scene.body_names.len()).filter(|body| !spiders.contains(body)).map(Some);
        let mut used = vec![false; ends.len()];
        // The link of each body.
        let mut link_of = vec![None; scene.body_names.len()];
        for root in std::iter::once(None).chain(roots) {
            if let Some(body) = root {
                if link_of[body].is_some() {
                    continue;
                }
                link_of[body] = Some(tree.free(scene, body));
            }
            let mut queue = VecDeque::from([root]);
            while let Some(base) = queue.pop_front() {
                for (number, joint) in scene.joints.iter().enumerate() {
                    let [a, b] = ends[number];
                    let (other, reversed) = match () {
                        () if a == base => (b, false),
                        () if b == base => (a, true),
                        () => continue,
                    };
                    if std::mem::replace(&mut used[number], true) {
                        continue;
                    }
                    let Some(body) = other.filter(|body| link_of[*body].is_none()) else {
                        tree.loops.push(number);
                        continue;
                    };
                    let parent = base.and_then(|base| link_of[base]).unwrap_or(WORLD);
                    let spider = joint.spider.as_ref().and_then(row);
                    let end = (body, scene.body_names[body].clone());
                    link_of[body] =
                        Some(tree.hold((number, joint), reversed, parent, (end, spider)));
                    queue.push_back(other);
                }
            }
        }
        tree.loops.sort_unstable();
        tree
    }

    fn link(&mut self, name: String, body: Option<usize>, at: Vector3<f64>) -> usize {
        let name = unique(name, |name| self.links.iter().any(|link| link.name == name));
        self.links.push(Link { name, body, at });
        self.links.len() - 1
    }

    fn join(&mut self, joint: Joint) {
        let is_taken = |name: &str| self.joints.iter().any(|joint| joint.name == name);
        let name = unique(joint.name, is_taken);
        self.joints.push(Joint { name, ..joint });
    }

    /// A body that no joint holds.
    fn free(&mut self, scene: &Scene, body: usize) -> usize {
        let at = scene.assembled_states()[body].position.to_f64().into();
        let name = scene.body_names[body].clone();
        let joint = format!("{name}-free");
        let child = self.link(name, Some(body), at);
        let (motion, axis) = (Motion::Free, Vector3::x());
        self.join(Joint { name: joint, motion, parent: WORLD, child, axis, of: None });
        child
    }

    /// Adds the joints of a joint and the link of its further body.
    fn hold(
        &mut self,
        (number, joint): (usize, &JointInfo),
        reversed: bool,
        mut parent: usize,
        ((body, name), spider): ((usize, String), Option<usize>),
    ) -> usize {
        let at = joint.at.to_f64().into();
        let mut steps = steps(joint);
        if reversed {
            // The same coordinates seen from the second body.
            steps.reverse();
            steps.iter_mut().for_each(|step| step.axis = -step.axis);
        }
        let last = steps.len() - 1;
        for (place, Step { end, motion, axis }) in steps.into_iter().enumerate() {
            let child = match place == last {
                true => self.link(name.clone(), Some(body), at),
                false => self.link(format!("{}{end}.carrier", joint.name), spider, at),
            };
            let name = format!("{}{end}", joint.name);
            let of = matches!(joint.kind, "revolute" | "translational" | "cylindrical");
            let of = of.then_some(number);
            self.join(Joint { name, motion, parent, child, axis, of });
            parent = child;
        }
        parent
    }
}

/// A name that is not taken: `arm`, `arm-2`.
fn unique(name: String, is_taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2_u32..).map(|number| format!("{name}-{number}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    names.find(|name| !is_taken(name)).unwrap_or(name)
}

/// A rotation or translation of a joint.
struct Step {
    /// Appended to the joint's name.
    end: &'static str,
    motion: Motion,
    axis: Vector3<f64>,
}

/// The motions that a joint permits, from its first body to its second.
fn steps(joint: &JointInfo) -> Vec<Step> {
    let [first, second] = joint.axes.map(|axis| Vector3::from(axis.to_f64()));
    let one = |end, motion, axis| Step { end, motion, axis };
    match joint.kind {
        "revolute" => vec![one("", Motion::Turn, first)],
        "translational" => vec![one("", Motion::Slide, first)],
        "cylindrical" => {
            vec![one("-slide", Motion::Slide, first), one("-turn", Motion::Turn, first)]
        }
        "universal" => vec![one("-1", Motion::Turn, first), one("-2", Motion::Turn, second)],
        "spherical" => vec![
            one("-x", Motion::Turn, Vector3::x()),
            one("-y", Motion::Turn, Vector3::y()),
            one("-z", Motion::Turn, Vector3::z()),
        ],
        _ => vec![one("", Motion::Fixed, Vector3::x())],
    }
}
