//! The materials of a posed surface as Wavefront MTL, textures named by their place relative to the file.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};

use super::obj::{group_name, unique};
use super::world_mesh::visible;
use sinew_engine::input;
use sinew_scene::{Frame, Label, MaterialId, Paint, Scene, Surface, TextureRef, Unnamed};

/// The file with the materials of an OBJ file: beside it, with the ending `.mtl`.
pub fn library(obj: &Path) -> PathBuf {
    obj.with_extension("mtl")
}

/// The materials that a frame's visible surfaces use, with their names in the file.
#[derive(Debug, Clone, Default)]
pub struct MtlLibrary {
    names: HashMap<MaterialId, String>,
    order: Vec<MaterialId>,
}

impl MtlLibrary {
    /// Finds them.
    pub fn of(frame: &Frame) -> Self {
        let bound = visible(frame).flat_map(|surface| surface.materials.iter().flatten()).map(|binding| binding.material);
        let ids: BTreeSet<u32> = bound.map(|material| material.0).collect();
        let mut taken = HashSet::new();
        let mut found = Self::default();
        for id in ids.into_iter().map(MaterialId) {
            if let Some(material) = frame.materials.get(id.index()) {
                let label = material.label();
                let is_part = matches!(label, Label::Unnamed(Unnamed::Part(_) | Unnamed::Muscle(_)));
                let own = Some(material.id.as_str()).filter(|id| material.name.trim().is_empty() && !id.is_empty() && !is_part);
                let name = own.map_or_else(|| label.plain(), Cow::Borrowed);
                found.names.insert(id, unique(&group_name(&name), &mut taken));
                found.order.push(id);
            }
        }
        found
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// The name of a material in the file.
    pub fn name(&self, material: MaterialId) -> Option<&str> {
        self.names.get(&material).map(String::as_str)
    }

    /// The material of triangle `index` of a surface.
    pub fn of_triangle(&self, surface: &Surface, index: u32) -> Option<MaterialId> {
        let parts = surface.mesh.parts.iter().zip(surface.materials.iter());
        let bound = parts.filter(|(part, _)| part.triangles.contains(&index)).find_map(|(_, binding)| binding.as_ref());
        bound.map(|binding| binding.material).filter(|material| self.names.contains_key(material))
    }

    /// The texture coordinates that a surface is written with, one a vertex: those of the diffuse texture of its part, moved as that says, since the
    /// format knows no turn; else those of its first set. `None` where it has none.
    pub fn uvs(&self, frame: &Frame, surface: &Surface) -> Option<Vec<Vec2>> {
        let mesh = &surface.mesh;
        let whole = |set: usize| mesh.uv_sets.get(set).filter(|uvs| uvs.len() == mesh.positions.len());
        let mut uvs = whole(0)?.clone();
        for (part, binding) in mesh.parts.iter().zip(surface.materials.iter()) {
            let Some(binding) = binding else { continue };
            let Some(texture) = frame.materials.get(binding.material.index()).and_then(|material| material.diffuse.texture.as_ref()) else {
                continue;
            };
            let Some(own) = whole(binding.uv_set(texture) as usize) else { continue };
            let placing = texture.transform.map(|placing| placing.matrix()).unwrap_or_default();
            // A vertex belongs to one part: what differs between two is split.
            for corner in mesh.triangles.get(part.triangles.start as usize..part.triangles.end as usize).unwrap_or(&[]).iter().flatten() {
                if let (Some(uv), Some(own)) = (uvs.get_mut(*corner as usize), own.get(*corner as usize)) {
                    *uv = placing.transform_point2(*own);
                }
            }
        }
        Some(uvs)
    }

    /// Writes the materials for an OBJ file that will lie at `obj`.
    ///
    /// # Errors
    /// What `out` returns.
    pub fn write(&self, out: &mut impl Write, scene: &Scene, frame: &Frame, obj: &Path) -> io::Result<()> {
        writeln!(out, "# Sinew {}", env!("CARGO_PKG_VERSION"))?;
        for id in &self.order {
            let (Some(material), Some(name)) = (frame.materials.get(id.index()), self.name(*id)) else { continue };
            writeln!(out, "\nnewmtl {name}")?;
            // A texture multiplies its colour here as there.
            let mut color = |keyword: &str, Vec3 { x, y, z }: Vec3| writeln!(out, "{keyword} {x} {y} {z}");
            color("Ka", material.ambient.color)?;
            color("Kd", material.diffuse.color)?;
            color("Ks", material.specular.color)?;
            color("Ke", material.emission.color)?;
            writeln!(out, "Ns {}", material.shininess)?;
            writeln!(out, "d {}", material.opacity)?;
            writeln!(out, "illum {}", if material.specular.color == Vec3::ZERO { 1 } else { 2 })?;
            let maps: [(&str, &Paint); 3] = [("map_Kd", &material.diffuse), ("map_Ks", &material.specular), ("map_Ke", &material.emission)];
            for (keyword, paint) in maps {
                if let Some(file) = paint.texture.as_ref().and_then(|texture| image(scene, texture, obj)) {
                    writeln!(out, "{keyword} {file}")?;
                }
            }
            if let Some(file) = material.opacity_texture.as_ref().and_then(|(texture, _)| image(scene, texture, obj)) {
                writeln!(out, "map_d {file}")?;
            }
        }
        Ok(())
    }
}

/// A texture's file as seen from the folder of `obj`; `None` where it was not found.
fn image(scene: &Scene, texture: &TextureRef, obj: &Path) -> Option<String> {
    let file = scene.images.get(texture.image.index())?.path.as_ref()?;
    Some(input::named_from(obj.parent().unwrap_or(Path::new("")), file).replace('\\', "/"))
}
