//! A glTF file as it grows.
//!
//! `meshes, materials, nodes, channels => GLB`. One buffer, a view for each accessor; every number is
//! a little-endian word of four bytes, so all of them are aligned.

use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::animation::{Channel, Interpolation, Property, Sampler, Target};
use gltf::json::buffer::{self, View};
use gltf::json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Accessor, Animation, Buffer, Index, Material, Mesh, Node, Root, Scene};

use super::solids::Solids;

/// The written content.
#[derive(Default)]
pub(super) struct File {
    root: Root,
    bytes: Vec<u8>,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
    /// sRGB, of each material.
    #[cfg(feature = "mcap")]
    colours: Vec<[u8; 3]>,
}

/// Target of a channel.
pub(super) enum Moves {
    /// \[m\].
    Translation(Vec<[f32; 3]>),
    /// Unit quaternions, scalar last.
    Rotation(Vec<[f32; 4]>),
    /// Factors.
    Scale(Vec<[f32; 3]>),
}

impl File {
    fn view(
        &mut self,
        words: impl Iterator<Item = [u8; 4]>,
        target: Option<buffer::Target>,
    ) -> Index<View> {
        let offset = self.bytes.len();
        self.bytes.extend(words.flatten());
        self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(self.bytes.len() - offset),
            byte_offset: Some(USize64::from(offset)),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: Default::default(),
        })
    }

    fn accessor(
        &mut self,
        view: Index<View>,
        count: usize,
        (component, shape): (ComponentType, Type),
        bounds: Option<[Vec<f32>; 2]>,
    ) -> Index<Accessor> {
        let [min, max] = match bounds {
            Some(bounds) => bounds.map(|bound| Some(bound.into())),
            None => [None, None],
        };
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: Some(USize64(0)),
            count: USize64::from(count),
            component_type: Checked::Valid(GenericComponentType(component)),
            extensions: None,
            extras: Default::default(),
            type_: Checked::Valid(shape),
            min,
            max,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    /// Rows of numbers, with their least and largest where `bounded`.
    fn numbers<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        target: Option<buffer::Target>,
        bounded: bool,
    ) -> Index<Accessor> {
        let words = rows.iter().flatten().map(|number| number.to_le_bytes());
        let view = self.view(words, target);
        let shape = match N {
            1 => Type::Scalar,
            3 => Type::Vec3,
            _ => Type::Vec4,
        };
        let bound = |f: fn(f32, f32) -> f32, from: f32| {
            (0..N).map(|column| rows.iter().map(|row| row[column]).fold(from, f)).collect()
        };
        let bounds =
            bounded.then(|| [bound(f32::min, f32::INFINITY), bound(f32::max, f32::NEG_INFINITY)]);
        self.accessor(view, rows.len(), (ComponentType::F32, shape), bounds)
    }

    /// A material of a colour, sRGB, seen from both sides.
    pub(super) fn material(&mut self, name: &str, colour: [u8; 3]) -> Index<Material> {
        // glTF's factors are linear.
        let linear = colour.map(|part| {
            let part = f32::from(part) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        });
        let [red, green, blue] = linear;
        #[cfg(feature = "mcap")]
        self.colours.push(colour);
        self.root.push(Material {
            name: Some(name.into()),
            double_sided: true,
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor([red, green, blue, 1.0]),
                metallic_factor: StrengthFactor(0.1),
                roughness_factor: StrengthFactor(0.6),
                ..Default::default()
            },
            ..Default::default()
        })
    }

    /// The colour of a material, sRGB.
    #[cfg(feature = "mcap")]
    pub(super) fn colour(&self, material: Index<Material>) -> [u8; 3] {
        self.colours[material.value()]
    }

    /// A mesh of solids; `None` if there are none.
    pub(super) fn mesh(
        &mut self,
        name: &str,
        parts: &[(Solids, Index<Material>)],
    ) -> Option<Index<Mesh>> {
        let mut primitives = Vec::new();
        for (solids, material) in parts.iter().filter(|(solids, _)| !solids.triangles.is_empty()) {
            let vertices = Some(buffer::Target::ArrayBuffer);
            let positions = self.numbers(&solids.positions, vertices, true);
            let normals = self.numbers(&solids.normals, vertices, false);
            let words = solids.triangles.iter().map(|row| row.to_le_bytes());
            let view = self.view(words, Some(buffer::Target::ElementArrayBuffer));
            let shape = (ComponentType::U32, Type::Scalar);
            let indices = self.accessor(view, solids.triangles.len(), shape, None);
            let attributes = [(Semantic::Positions, positions), (Semantic::Normals, normals)];
            primitives.push(Primitive {
                attributes: attributes.map(|(name, row)| (Checked::Valid(name), row)).into(),
                extensions: None,
                extras: Default::default(),
                indices: Some(indices),
                material: Some(*material),
                mode: Checked::Valid(Mode::Triangles),
                targets: None,
            });
        }
        let mesh = Mesh {
            extensions: None,
            extras: Default::default(),
            name: Some(name.into()),
            primitives,
            weights: None,
        };
        (!mesh.primitives.is_empty()).then(|| self.root.push(mesh))
    }

    /// A node.
    pub(super) fn node(&mut self, node: Node) -> Index<Node> {
        self.root.push(node)
    }

    /// The times \[s\] of channels.
    pub(super) fn times(&mut self, times: &[f32]) -> Index<Accessor> {
        let rows: Vec<[f32; 1]> = times.iter().map(|time| [*time]).collect();
        self.numbers(&rows, None, true)
    }

    /// Moves a node, linearly from time to time.
    pub(super) fn channel(&mut self, node: Index<Node>, input: Index<Accessor>, moves: &Moves) {
        let (path, output) = match moves {
            Moves::Translation(rows) => (Property::Translation, self.numbers(rows, None, false)),
            Moves::Rotation(rows) => (Property::Rotation, self.numbers(rows, None, false)),
            Moves::Scale(rows) => (Property::Scale, self.numbers(rows, None, false)),
        };
        self.samplers.push(Sampler {
            extensions: None,
            extras: Default::default(),
            input,
            interpolation: Checked::Valid(Interpolation::Linear),
            output,
        });
        self.channels.push(Channel {
            sampler: Index::new(self.samplers.len() as u32 - 1),
            target: Target {
                extensions: None,
                extras: Default::default(),
                node,
                path: Checked::Valid(path),
            },
            extensions: None,
            extras: Default::default(),
        });
    }

    /// The file, with one scene of one node.
    ///
    /// # Errors
    /// If it is larger than 4 GiB, the limit of the format.
    pub(super) fn glb(mut self, name: &str, top: Index<Node>) -> std::io::Result<Vec<u8>> {
        if !self.channels.is_empty() {
            let (channels, samplers) = (self.channels, self.samplers);
            self.root.push(Animation {
                extensions: None,
                extras: Default::default(),
                channels,
                name: Some(name.into()),
                samplers,
            });
        }
        let scene = self.root.push(Scene {
            extensions: None,
            extras: Default::default(),
            name: Some(name.into()),
            nodes: vec![top],
        });
        self.root.scene = Some(scene);
        self.root.asset.generator = Some(concat!("dbd-report ", env!("CARGO_PKG_VERSION")).into());
        if !self.bytes.is_empty() {
            self.root.push(Buffer {
                byte_length: USize64::from(self.bytes.len()),
                name: None,
                uri: None,
                extensions: None,
                extras: Default::default(),
            });
        }
        let json = self.root.to_vec()?;
        let length = |bytes: usize| 8 + bytes.next_multiple_of(4);
        let whole = 12 + length(json.len()) + length(self.bytes.len());
        let whole = u32::try_from(whole).map_err(std::io::Error::other)?;
        let header = gltf::binary::Header { magic: *b"glTF", version: 2, length: whole };
        let bin = (!self.bytes.is_empty()).then(|| self.bytes.into());
        let glb = gltf::binary::Glb { header, json: json.into(), bin };
        glb.to_vec().map_err(std::io::Error::other)
    }
}
