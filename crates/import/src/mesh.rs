//! Meshes of `<asset>`: where they come from, what they hold.
//!
//! `<mesh>, file => triangles => volume, centre and inertia`, read when a body's mass needs them, within the
//! model's folder. Numbers are single precision and go through `refpos`, `refquat`, `scale`, as in MuJoCo.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use dbd_scene::file::{MAX_BYTES, read};
use nalgebra::{UnitQuaternion, Vector3};

use crate::bulk::{Bulk, Rule, Surface};
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::element::Element;
use crate::error::Fault;
use crate::file;
use crate::settings::{Settings, quaternion};

/// The way to the mass of a mesh that is not read here.
pub(crate) const REMEDY: &str = "an <inertial>; MuJoCo writes those of meshes: <compiler saveinertial=\"true\"/>, \
                                 then `mj_saveLastXML`";

/// A mesh as the file names it.
struct Asset {
    file: Option<PathBuf>,
    vertices: Vec<f64>,
    faces: Vec<f64>,
    rule: Rule,
    scale: Vector3<f64>,
    shift: Vector3<f64>,
    turn: UnitQuaternion<f64>,
    generated: bool,
}

/// All meshes by their names.
pub(crate) struct Meshes {
    folder: PathBuf,
    assets: BTreeMap<String, Asset>,
    bulks: BTreeMap<String, Result<Bulk, String>>,
}

impl Meshes {
    /// Reads the elements; no files.
    pub(crate) fn read(
        root: &Element,
        settings: &Settings,
        defaults: &Defaults,
        folder: &Path,
    ) -> Result<Self, Fault> {
        let mut assets = BTreeMap::new();
        let sections = root.sections("asset").flat_map(|section| &section.children);
        for element in sections.filter(|child| child.name == "mesh") {
            let given = defaults.of(element, MAIN)?;
            let (name, asset) = asset(&given, settings)?;
            assets.insert(name, asset);
        }
        Ok(Self { folder: folder.to_owned(), assets, bulks: BTreeMap::new() })
    }

    /// What a mesh holds; `Err`: why that is not known.
    pub(crate) fn bulk(&mut self, name: &str) -> Result<&Bulk, &str> {
        if !self.bulks.contains_key(name) {
            let found = match self.assets.get(name) {
                Some(asset) => asset.bulk(&self.folder),
                None => Err(format!("there is no mesh `{name}`")),
            };
            self.bulks.insert(name.to_owned(), found);
        }
        match self.bulks.get(name) {
            Some(Ok(bulk)) => Ok(bulk),
            Some(Err(why)) => Err(why),
            None => Err(""),
        }
    }
}

/// Reads a `<mesh>`.
fn asset(given: &Attributes<'_>, settings: &Settings) -> Result<(String, Asset), Fault> {
    const RULES: [(&str, Rule); 4] = [
        ("legacy", Rule::Legacy),
        ("convex", Rule::Convex),
        ("exact", Rule::Exact),
        ("shell", Rule::Shell),
    ];
    let file = given.text("file").filter(|file| !file.trim().is_empty());
    let stem = file.and_then(|file| Path::new(file).file_stem()).and_then(|stem| stem.to_str());
    let name = given.element.text("name").or(stem).unwrap_or_default().to_owned();
    let rule = given.word("inertia", &RULES.map(|(word, _)| word))?.map_or(0, |rule| rule);
    let numbers = |name| Ok(given.numbers(name, 0, usize::MAX)?.unwrap_or_default());
    let turn = match given.numbers("refquat", 4, 4)?.as_deref() {
        Some(&[w, x, y, z]) => quaternion([w, x, y, z]),
        _ => None,
    };
    let asset = Asset {
        file: file.map(|file| settings.mesh_path(file)),
        vertices: numbers("vertex")?,
        faces: numbers("face")?,
        rule: RULES[rule].1,
        scale: given.vector("scale")?.unwrap_or_else(|| Vector3::repeat(1.0)),
        shift: given.vector("refpos")?.unwrap_or_default(),
        turn: turn.unwrap_or_else(UnitQuaternion::identity),
        generated: given.get("builtin").is_some(),
    };
    Ok((name, asset))
}

impl Asset {
    fn bulk(&self, folder: &Path) -> Result<Bulk, String> {
        if self.generated {
            return Err("MuJoCo makes it, it is not in the file".into());
        }
        let mut surface = match &self.file {
            Some(file) => surface(folder, file)?,
            None => Surface::of_numbers(&self.vertices, &self.faces)?,
        };
        for point in &mut surface.points {
            *point = (self.turn.inverse() * (*point - self.shift)).component_mul(&self.scale);
        }
        if self.scale.product() < 0.0 {
            surface.faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        surface.bulk(self.rule)
    }
}

/// The triangles of a file.
fn surface(folder: &Path, file: &Path) -> Result<Surface, String> {
    let shown = file.display();
    let path = file::within(folder, &file.to_string_lossy());
    let bytes = path.and_then(|path| read(path, MAX_BYTES));
    let bytes = bytes.map_err(|reason| format!("cannot read {shown}: {reason}"))?;
    let kind = file.extension().and_then(|kind| kind.to_str()).unwrap_or_default();
    let surface = match kind.to_ascii_lowercase().as_str() {
        "stl" => stl(&bytes),
        "obj" => obj(&bytes),
        _ => Err("it is no STL and no OBJ".to_owned()),
    };
    surface.map_err(|reason| format!("cannot read {shown}: {reason}"))
}

fn point([x, y, z]: [f32; 3]) -> Vector3<f64> {
    Vector3::new(x, y, z).cast()
}

fn stl(bytes: &[u8]) -> Result<Surface, String> {
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|reason| reason.to_string())?;
    let points = mesh.vertices.iter().map(|vertex| point(vertex.0)).collect();
    let faces = mesh.faces.iter().map(|face| face.vertices).collect();
    Ok(Surface { points, faces, others: 0 })
}

fn obj(bytes: &[u8]) -> Result<Surface, String> {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    // Materials are other files, which no mass needs.
    let materials = |_: &Path| Ok((Vec::new(), Default::default()));
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, materials)
        .map_err(|reason| reason.to_string())?;
    let mut surface = Surface::default();
    // MuJoCo takes the faces of the first object, which here is one model for each of its materials.
    let first = models.first().map(|model| model.name.clone()).unwrap_or_default();
    let mut names: Vec<String> = models.iter().map(|model| model.name.clone()).collect();
    names.dedup();
    surface.others = names.len().saturating_sub(1);
    let mut is_first = true;
    for model in models {
        let before = surface.points.len();
        let points = model.mesh.positions.chunks_exact(3);
        surface.points.extend(points.map(|p| point([p[0], p[1], p[2]])));
        is_first &= model.name == first;
        if is_first {
            let faces = model.mesh.indices.chunks_exact(3);
            surface.faces.extend(faces.map(|f| [f[0], f[1], f[2]].map(|i| before + i as usize)));
        }
    }
    Ok(surface)
}
