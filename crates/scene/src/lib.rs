//! The scene graph and its contents. Independent of formats, drawing and the window.
//!
//! # What a scene is
//!
//! A [`Scene`] is everything at rest, in flat lists that are joined by small ids ([`NodeId`], [`MeshId`], …): a [`Graph`] of [`Node`]s, each with a
//! [`Transform`] and with what hangs on it, and the meshes, skins, morphs, materials, images, lights and cameras that the nodes share.
//!
//! World: right-handed, +Y up, metres. A loaded file hangs under an *asset* node that carries its unit and up axis, so local values stay as the file
//! wrote them. Transforms are composed in `f64`; geometry is `f32`.
//!
//! # How it moves
//!
//! An [`animation::Clip`] holds channels: a curve, and the numbers of the scene that it sets. [`animation::Clip::sample`] writes the values of a moment
//! into an [`animation::Pose`], which gives the local matrices, and [`Graph::world_from_local`] composes them:
//!
//! ```
//! use sinew_scene::animation::{Clip, Pose};
//! use sinew_scene::{Node, Scene};
//!
//! let mut scene = Scene::default();
//! scene.graph.add(None, Node::new("hip"));
//! let (mut pose, mut local, mut world) = (Pose::rest(&scene), Vec::new(), Vec::new());
//! Clip::default().sample(0.5, &mut pose);
//! pose.locals(&mut local);
//! scene.graph.world_from_local(&local, &mut world);
//! assert_eq!(world.len(), 1);
//! ```
//!
//! Posed and deformed, the scene is a [`Frame`]: what a renderer or an exporter reads. It owes nothing to the clip or the file any more.
//!
//! # What readers report
//!
//! Libraries have no language. What they tell people is an enum that implements [`message::ToMessage`]: a key of a catalogue, typed parameters, a place.
//! A [`diagnostics::Diagnostic`] is a finding with its file, line and element; findings add up instead of stopping the reading. [`limits`] lists every bound
//! on what a file may ask for, [`progress::Progress`] tells how far a long task is and lets it be stopped.

pub mod animation;
mod bounds;
mod camera;
mod coincident_faces;
pub mod diagnostics;
mod frame;
mod graph;
pub mod import;
mod light;
pub mod limits;
mod material;
mod mesh;
pub mod message;
mod name;
pub mod progress;
mod skin;
mod transform;
pub mod visible;

pub use bounds::Bounds;
pub use camera::{Camera, FileCamera, OrbitCamera, Projection, ViewDirection};
pub use coincident_faces::backed_triangles;
pub use frame::{Fibers, Frame, FrameJoint, Ghost, OverlayLine, Surface, SurfaceGeometry};
pub use graph::{Content, Graph, Node, NodeId, NodeKind};
pub use light::{Light, LightKind};
pub use material::{AlphaSource, Image, Material, MaterialBinding, Paint, Pixels, ShadingModel, TextureRef, TextureTransform, WrapMode};
pub use mesh::{Mesh, Part, smooth_normals};
pub use name::{BodyPart, Label, OwnedLabel, Unnamed};
pub use skin::{Deformer, Influence, MeshInstance, Morph, MorphMethod, MorphTarget, Skin, SkinJoint, SkinnedTarget};
pub use transform::{Transform, TransformOp, affine, compose};

use std::sync::Arc;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the scene's list.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}
id!(
    /// A mesh in [`Scene::meshes`].
    MeshId
);
id!(
    /// A skin in [`Scene::skins`].
    SkinId
);
id!(
    /// A morph in [`Scene::morphs`].
    MorphId
);
id!(
    /// A material in [`Scene::materials`].
    MaterialId
);
id!(
    /// An image in [`Scene::images`].
    ImageId
);
id!(
    /// A light in [`Scene::lights`].
    LightId
);
id!(
    /// A camera in [`Scene::cameras`].
    CameraId
);
id!(
    /// A muscle in the document's list; the scene knows only where it hangs.
    MuscleId
);

/// Everything that is shown, at rest. A [`Frame`] is the scene posed at one moment.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The nodes, parents before children.
    pub graph: Graph,
    /// Geometry, shared by the frames.
    pub meshes: Vec<Arc<Mesh>>,
    /// Skins: inverse bind matrices and weights.
    pub skins: Vec<Skin>,
    /// Morphs: targets and weights.
    pub morphs: Vec<Morph>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Images that textures refer to.
    pub images: Vec<Image>,
    /// Lights of the file.
    pub lights: Vec<Light>,
    /// Cameras of the file.
    pub cameras: Vec<FileCamera>,
}
