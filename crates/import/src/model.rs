//! From the elements of a file to the scene.
//!
//! `root => settings, defaults, tree => mechanism => text`. In a planar scene a body that moves freely in the plane
//! needs no joint: this is tried first and abandoned if the scene is not planar.

use std::path::Path;

use dbd_scene::Scene;
use nalgebra::Vector3;

use crate::body::Freedom;
use crate::chain::{self, ALIKE, Circumstances, Stage, Way};
use crate::contact::{self, Touch};
use crate::defaults::Defaults;
use crate::element::Element;
use crate::error::Fault;
use crate::mechanism::Mechanism;
use crate::mesh::Meshes;
use crate::omission::{Kind, Omissions};
use crate::options::Options;
use crate::part::{Parts, Unfit};
use crate::place::Texts;
use crate::pose::Pose;
use crate::settings::{self, Settings};
use crate::tree::{self, Tree};
use crate::{actuators, assembled, inertia, joints, loops, schema, signals, tendons, write};

/// The contents of a file.
pub(crate) struct Model<'m> {
    root: &'m Element,
    settings: Settings,
    defaults: Defaults,
    tree: Tree,
    touches: Vec<Touch>,
    omissions: Omissions,
}

/// A scene's text and notes.
pub(crate) type Made = (String, Vec<String>);

impl<'m> Model<'m> {
    /// Reads the elements.
    pub(crate) fn read(
        root: &'m Element,
        folder: &Path,
        mut omissions: Omissions,
    ) -> Result<Self, Fault> {
        schema::check(root, &mut omissions)?;
        let settings = settings::read(root, &mut omissions)?;
        let defaults = Defaults::read(root)?;
        let mut meshes = Meshes::read(root, &settings, &defaults, folder)?;
        let tree = tree::read(root, &settings, &defaults, &mut meshes, &mut omissions)?;
        let touches = contact::find(root, &tree, &settings, &defaults, &mut omissions)?;
        Ok(Self { root, settings, defaults, tree, touches, omissions })
    }

    /// The scene.
    pub(crate) fn scene(
        &self,
        texts: &Texts,
        file: &str,
        options: &Options,
    ) -> Result<(Made, Omissions), Fault> {
        let around = |planar| Circumstances {
            driven: actuators::driven(self.root, &self.settings).collect(),
            planar,
        };
        let stages = chain::stages(&self.tree, &around(true));
        let mut unplanar = None;
        if stages.iter().any(|stage| stage.way == Way::Plane) {
            let made = self.made(texts, file, options, &around(true), None)?;
            match Scene::parse(&made.0.0, "").map(|scene| scene.planar) {
                Ok(Some(planar)) if self.is_normal(&stages, planar.plane.normal().to_f64()) => {
                    return Ok(made);
                }
                Ok(_) => unplanar = Some("other bodies leave its plane".to_owned()),
                Err(error) => unplanar = Some(error.to_string()),
            }
        }
        self.made(texts, file, options, &around(false), unplanar.as_deref())
    }

    /// Whether planar motion of bodies is in the plane with this normal.
    fn is_normal(&self, stages: &[Stage], normal: [f64; 3]) -> bool {
        let normal = Vector3::from(normal);
        let mut planes = stages.iter().filter(|stage| stage.way == Way::Plane);
        // The poses do not matter: relative to the world, a hinge after two slides keeps its axis.
        planes.all(|stage| {
            let turn = self.tree.bodies[self.tree.bodies[stage.body].chain].pose.rotation;
            let joints =
                stage.joints.iter().filter_map(|body| self.tree.bodies[*body].joint.as_ref());
            let mut hinges = joints.filter(|joint| joint.freedom == Freedom::Hinge);
            hinges.all(|hinge| normal.cross(&(turn * hinge.axis.into_inner())).norm() < ALIKE)
        })
    }

    /// The scene, planar or spatial; `unplanar`: why it is not planar.
    fn made(
        &self,
        texts: &Texts,
        file: &str,
        options: &Options,
        around: &Circumstances,
        unplanar: Option<&str>,
    ) -> Result<(Made, Omissions), Fault> {
        let (mut tree, mut omissions) = (self.tree.clone(), self.omissions.clone());
        let (stages, parts) = loop {
            let stages = chain::stages(&tree, around);
            match Parts::of(&tree, &stages, &self.settings, options) {
                Ok(parts) => break (stages, parts),
                Err(Unfit::Fault(fault)) => return Err(fault),
                Err(Unfit::Carriers(body)) => lock(&mut tree, body, unplanar, &mut omissions),
            }
        };
        let pose = Pose::of(&tree, self.root, options.keyframe.as_deref())?;
        let mut mechanism = Mechanism::new(&tree, &parts, &pose, options);
        mechanism.planar = stages.iter().any(|stage| stage.way == Way::Plane);
        mechanism.driven = inertia::driven(&tree, &pose.first);
        let (root, settings, defaults) = (self.root, &self.settings, &self.defaults);
        joints::add(&mut mechanism, &stages, settings, &mut omissions);
        joints::armatures(&mechanism, &mut omissions);
        loops::add(&mut mechanism, root, settings, &mut omissions)?;
        tendons::add(&mut mechanism, root, settings, defaults, &mut omissions)?;
        actuators::add(&mut mechanism, root, settings, defaults, &mut omissions)?;
        signals::add(&mut mechanism, root)?;
        contact::add(&mut mechanism, &self.touches);
        mechanism.notes.extend(self.tree.notes.iter().cloned());
        let head = write::Head { settings, texts };
        let mut scene = write::scene(&mechanism, &head, omissions.list(), file);
        if assembled::settle(&mut mechanism, &scene) {
            scene = write::scene(&mechanism, &head, omissions.list(), file);
        }
        Ok(((scene, mechanism.notes), omissions))
    }
}

/// Omits all joints of a body except the first.
fn lock(tree: &mut Tree, body: usize, unplanar: Option<&str>, omissions: &mut Omissions) {
    let chain = tree.bodies[body].chain;
    let joints: Vec<_> = (chain..=body).filter_map(|one| tree.bodies[one].joint.as_ref()).collect();
    let called: Vec<String> = joints.iter().map(|joint| joint.called()).collect();
    let place = joints.get(1).map_or(tree.bodies[body].place, |joint| joint.place);
    let planar =
        unplanar.map_or(String::new(), |why| format!(" and the model is not planar ({why})"));
    let what = format!(
        "body `{}` has {}: a scene has no exact equivalent{planar}; `--carriers 0.01` is accurate to \
         about 1 % of its mass; if ignored, only the first joint is kept",
        tree.bodies[body].name,
        called.join(", ")
    );
    omissions.add(Kind::Joints, place, what);
    for one in chain + 1..=body {
        tree.bodies[one].joint.iter_mut().for_each(|joint| joint.locked = true);
    }
}
