//! Features of a document that glTF cannot express.

use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Something that was left out or only comes close.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum UnsupportedFeature {
    /// A node shears while it moves, which no key of the format can say.
    Shear {
        /// The node's name.
        node: String,
    },
    /// A morph above a skin, or of skinned shapes: the format morphs first and skins then. The surface is written as it stands at the start.
    Mixed {
        /// The mesh's name.
        mesh: String,
    },
    /// Colours, highlights or lights change over time; the format animates transforms and morph weights.
    Colours {
        /// The clip's name.
        clip: String,
    },
    /// An image that is not there or could not be read.
    Image {
        /// Its reference in the file.
        name: String,
    },
    /// A light from everywhere, which the format has not.
    AmbientLight {
        /// The light's name.
        name: String,
    },
    /// The muscles have so many vertices, or clips so many keys, that fewer shapes or moments of them are kept than their movement needs.
    Shapes {
        /// How many shapes a muscle has at most; none = they keep one shape.
        kept: usize,
    },
    /// A skin follows muscles and is morphed too, or is not bent by one skeleton alone: it is written as its skeleton and its morphs move it.
    FollowingSkin {
        /// The mesh's name.
        mesh: String,
    },
    /// Skins that follow muscles have so many vertices, or clips so many keys, that fewer shapes or moments are kept than their movement needs.
    SkinShapes {
        /// How many shapes a mesh has at most.
        kept: usize,
    },
    /// A clip that starts before zero; its times are moved.
    Moved {
        /// The clip's name.
        clip: String,
        /// By how much, thousandths of a second.
        milliseconds: i64,
    },
}

impl ToMessage for UnsupportedFeature {
    fn message(&self) -> Message {
        match self {
            Self::Shear { node } => message!("gltf-shear", node = node),
            Self::Mixed { mesh } => message!("gltf-mixed", mesh = mesh),
            Self::Colours { clip } => message!("gltf-colours", clip = clip),
            Self::Image { name } => message!("gltf-image", name = name),
            Self::AmbientLight { name } => message!("gltf-ambient", name = name),
            Self::Shapes { kept } => message!("gltf-shapes", count = kept),
            Self::FollowingSkin { mesh } => message!("gltf-following-skin", mesh = mesh),
            Self::SkinShapes { kept } => message!("gltf-skin-shapes", count = kept),
            Self::Moved { clip, milliseconds } => message!("gltf-moved", clip = clip, milliseconds = milliseconds),
        }
    }
}
